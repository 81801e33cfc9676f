// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra fit`: exponential law of a force curve from a file, with its test.
#include <fmt/format.h>

#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <tuple>
#include <utility>

#include "answers.hpp"
#include "options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "results/answer_json.hpp"
#include "study_command.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct FitArguments {
  std::string curve;
  std::vector<double> window;
  std::string weights = "spacing";
};

std::string length_text(double value) { return format_quantity(value, Dimension::length, 3); }

/// Explains the results of the test in words. noisy: the samples scatter independently, as those of
/// a load cell do. The residuals of a computed curve are the misfit of the law; they have no
/// probability.
std::string in_words(const ExponentialTest& test, const WindowSensitivity& parts,
                     const LawDescription& law, bool noisy) {
  return fmt::format(
      "{}{}\nOver the window l changes from {} (smallest gap) to {} (largest gap), by {:+.0f} %.\n"
      "Fits to parts of the window, of at least half its samples, give l from {} to {}.\n",
      cli::in_words(law, "this curve"),
      noisy ? fmt::format(" Scatter alone would bend ln F this much with a probability of {:.2g}.",
                          test.significance)
            : "",
      length_text(test.decay_length_at_min_gap), length_text(test.decay_length_at_max_gap),
      100 * (test.decay_length_at_max_gap / test.decay_length_at_min_gap - 1),
      length_text(parts.decay_length_min), length_text(parts.decay_length_max));
}

void run(const FitArguments& arguments, Session& session) {
  // The force over the gap is the same in all directions of the tangential motion.
  const ForceCurve all = read_force_curve(arguments.curve), curve = by_direction(all).front();
  std::optional<PressureWindow> window;
  if (!arguments.window.empty()) {
    require(arguments.window.size() == 2, "--pressure-window", arguments.window.size(),
            "values given; it takes two, LOWER,UPPER");
    require(arguments.window[0] < arguments.window[1], "--pressure-window",
            format_quantity(arguments.window[0], Dimension::pressure),
            "is the lower pressure and must be below the upper one");
    window = PressureWindow{arguments.window[0], arguments.window[1], 0};
  }
  const FitWeights weights = *parse_enum<FitWeights>(arguments.weights);
  const ExponentialFit fit = fit_exponential(curve, window, weights);
  const bool noisy = weights != FitWeights::spacing;
  Json answer = json_of(fit);
  for (const char* name : {"pressure_min", "pressure_max"}) answer.erase(name);
  if (!noisy)
    for (const char* name : {"decay_length_low", "decay_length_high"}) answer.erase(name);
  answer["window"] = json_of(fit.window);
  answer["window"]["points"] = fit.window.points;
  const auto length_by = [&](FitWeights other) {
    return fit_exponential(curve, window, other).decay_length;
  };
  const WindowSensitivity parts = window_sensitivity(curve, window, weights);
  answer.add(answer_json(FitChoices{
      weights,
      {length_by(FitWeights::spacing), length_by(FitWeights::equal), length_by(FitWeights::force)},
      parts}));
  std::string verdict = "To test the law, the window must hold at least four samples.\n";
  if (fit.window.points >= 4) {
    const ExponentialTest test = test_exponential(curve, window, weights);
    const LawDescription law =
        describe_law(fit.decay_length, test.decay_length_at_min_gap, test.decay_length_at_max_gap);
    answer["test"] = {{"fair", law.fair},
                      {"decay_length_at_min_gap", test.decay_length_at_min_gap},
                      {"decay_length_at_max_gap", test.decay_length_at_max_gap}};
    if (noisy) answer["test"]["significance"] = test.significance;
    verdict = in_words(test, parts, law, noisy);
  }
  write_tables(session, "fit", answer, {});
  // The local decay lengths only go into the file: they are too long for the text of the answer.
  Json complete = answer;
  complete["local"] = lists_of(local_decay_length(curve));
  if (session.has_plot()) {
    // Without noise the range of l is that of parts of the window, as in the answer.
    ExponentialFit drawn = fit;
    if (!noisy)
      std::tie(drawn.decay_length_low, drawn.decay_length_high) =
          std::pair(parts.decay_length_min, parts.decay_length_max);
    figures::Figure figure = figures::figure_of(all, drawn);
    figure.caption +=
        noisy ? " The interval of the decay length has a confidence of 95 %."
              : " The range of the decay length is that of fits to parts of the window.";
    session.plot(figure);
  }
  session.answer(complete, to_text(answer) + "\n" + verdict);
}

}  // namespace

void add_fit_command(Program& program) {
  auto arguments = std::make_shared<FitArguments>();
  Command& command = program.add_command(
      "fit", "decay length l of p = p0 exp(-mean gap/l) from a curve",
      {"salebra fit curve.h5", "salebra fit curve.h5 --pressure-window 1MPa,50MPa --plot fit.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "pressure over gap with the fitted law, area, stiffness");
  command
      .add_option("CURVE", arguments->curve,
                  "result of contact or of a study of one surface, or a text table")
      ->required()
      ->file(FileUse::input);
  add_values(command, "--pressure-window", arguments->window, Dimension::pressure,
             "pressures LOWER,UPPER of the fit; default: mean gaps of 1 to 2.5 rms heights");
  add_choice<FitWeights>(command, "--weights", arguments->weights,
                         "weight of a sample: spacing, the range of gap that it represents "
                         "(computed curves); equal (noise in proportion to F); force, F^2 (noise "
                         "of one size). The last two also give a 95 % interval of l");
}

}  // namespace salebra::cli
