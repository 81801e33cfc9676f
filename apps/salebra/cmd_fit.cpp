// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/fit.hpp>
#include <salebra/io/force_curve_file.hpp>

#include "answer_file.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct FitArguments {
  std::string curve;
  std::vector<double> window;
};

void run(const FitArguments& arguments, Session& session) {
  const ForceCurve curve = read_force_curve(arguments.curve);
  std::optional<PressureWindow> window;
  if (!arguments.window.empty()) {
    require(arguments.window.size() == 2 && arguments.window[0] < arguments.window[1],
            "--pressure-window", arguments.window.size(), "values must be two, LOWER,UPPER");
    window = PressureWindow{arguments.window[0], arguments.window[1], 0};
  }
  const ExponentialFit fit = fit_exponential(curve, window);
  const Json answer{{"decay_length", fit.decay_length},
                    {"decay_length_low", fit.decay_length_low},
                    {"decay_length_high", fit.decay_length_high},
                    {"reference_pressure", fit.reference_pressure},
                    {"r_squared", fit.r_squared},
                    {"window",
                     {{"pressure_min", fit.window.pressure_min},
                      {"pressure_max", fit.window.pressure_max},
                      {"points", fit.window.points}}},
                    {"decay_length_over_rms_height", fit.decay_length_over_rms_height}};
  write_answer(session, "fit", answer);
  session.answer(answer);
}

}  // namespace

void add_fit_command(Program& program) {
  auto arguments = std::make_shared<FitArguments>();
  CLI::App& command = program.add_command(
      "fit", "decay length l of p = p0 exp(-mean gap/l) from a curve",
      {"salebra fit curve.h5", "salebra fit curve.h5 --pressure-window 1MPa,50MPa --json"},
      [arguments](Session& session) { run(*arguments, session); });
  command.add_option("CURVE", arguments->curve, "file of sweep or gw, or a text table")
      ->required()
      ->type_name("FILE");
  add_values(command, "--pressure-window", arguments->window, Dimension::pressure,
             "LOWER,UPPER; default: mean gaps of 1 to 2.5 rms heights");
}

}  // namespace salebra::cli
