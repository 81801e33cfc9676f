// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_file.hpp>

#include "options.hpp"
#include "program.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct StudyArguments {
  std::string configuration;
  SurfaceOptions surface;
  MaterialOptions material;
  MotionOptions motion;
  std::vector<double> pressures;
  bool no_stick = false;
};

std::string title_of(std::string_view model) {
  if (model == "bem") return "boundary elements";
  if (model == "gw_moments") return "GW, summits from spectral moments";
  return "GW, the surface's own summits";
}

Json to_json(const EnsembleMean& estimate) {
  return {{"mean", estimate.mean}, {"low", estimate.low}, {"high", estimate.high}};
}

Json to_json(const std::vector<EnsembleMean>& estimates, double scale = 1) {
  Json mean = Json::array(), low = Json::array(), high = Json::array();
  for (const EnsembleMean& estimate : estimates) {
    mean.push_back(scale * estimate.mean);
    low.push_back(scale * estimate.low);
    high.push_back(scale * estimate.high);
  }
  return {{"mean", mean}, {"low", low}, {"high", high}};
}

Json to_json(const StudyResult& result, const std::string& file) {
  Json comparison;
  for (const StudyModel& model : study_models) {
    comparison[model.name] = {{"decay_length", to_json(result.decay_length(model.result))},
                              {"decay_length_over_rms_height",
                               to_json(result.decay_length_over_rms_height(model.result))}};
  }
  comparison["law_deviation_percent"] = to_json(result.damping_deviation(), 100);
  std::vector<double> forces;
  for (const double pressure : result.pressures) forces.push_back(pressure * result.grid.area());
  return {{"decay_length", to_json(result.decay_length(&Realisation::bem))},
          {"decay_length_over_rms_height",
           to_json(result.decay_length_over_rms_height(&Realisation::bem))},
          {"damping",
           {{"pressure", result.pressures},
            {"force", forces},
            {"law_work_per_cycle", to_json(result.damping(&DampingPoint::law_work))},
            {"curve_work_per_cycle", to_json(result.damping(&DampingPoint::curve_work))},
            {"law_damping_constant", to_json(result.damping(&DampingPoint::law_damping_constant))},
            {"curve_damping_constant",
             to_json(result.damping(&DampingPoint::curve_damping_constant))}}},
          {"comparison", comparison},
          {"files", {{"results", file.empty() ? Json() : Json(file)}, {"report", nullptr}}}};
}

std::string interval(const EnsembleMean& estimate, Dimension dimension) {
  if (std::isnan(estimate.low)) return "";
  return fmt::format("{} … {}", format_quantity(estimate.low, dimension),
                     format_quantity(estimate.high, dimension));
}

std::string describe_motion(const Oscillation& motion) {
  if (const auto* drag = std::get_if<Drag>(&motion)) {
    return fmt::format(
        "drag at {}, normal oscillation of {} at {}",
        format_quantity(drag->drag_velocity, Dimension::velocity),
        format_quantity(drag->normal_amplitude, Dimension::length),
        format_quantity(drag->angular_frequency / (2 * std::numbers::pi), Dimension::frequency));
  }
  const auto& equal = std::get<EqualFrequency>(motion);
  return fmt::format(
      "equal frequencies, normal {}, tangential {}, phase {}, {}",
      format_quantity(equal.normal_amplitude, Dimension::length),
      format_quantity(equal.tangential_amplitude, Dimension::length),
      format_quantity(equal.phase, Dimension::angle),
      format_quantity(equal.angular_frequency / (2 * std::numbers::pi), Dimension::frequency));
}

/// What the difference between the law and the curve amounts to, in one sentence.
std::string verdict(const std::vector<EnsembleMean>& deviation, const std::string& law) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const EnsembleMean& estimate : deviation) {
    if (std::isnan(estimate.mean)) continue;
    low = std::min(low, estimate.mean);
    high = std::max(high, estimate.mean);
  }
  if (!(low <= high))
    return law + " could not be compared with the curve: the oscillation leaves it at every force.";
  return fmt::format(
      "{} with the fitted decay length is between {:+.0f} % and {:+.0f} % off the damping that the "
      "computed force curve itself gives; where they differ, the curve is right.",
      law, 100 * low, 100 * high);
}

/// Whether the law holds at all, in one sentence.
std::string bend(const StudyResult& result) {
  std::vector<double> closest, farthest;
  for (const Realisation& realisation : result.realisations) {
    const ExponentialTest& test = realisation.bem.test;
    if (test.window.points < 4) continue;
    closest.push_back(test.decay_length_closest / realisation.heights.rms_height);
    farthest.push_back(test.decay_length_farthest / realisation.heights.rms_height);
  }
  if (closest.empty()) return "";
  return fmt::format(
      "  Over the fitted window the local l of boundary elements runs from {:.2f} h_rms (closest) "
      "to {:.2f} h_rms (farthest).\n",
      student_mean(closest).mean, student_mean(farthest).mean);
}

std::string to_text(const StudyResult& result, const std::string& file) {
  std::vector<double> rms_heights, rms_slopes;
  for (const Realisation& realisation : result.realisations) {
    rms_heights.push_back(realisation.heights.rms_height);
    rms_slopes.push_back(realisation.moments.rms_slope());
  }
  const Grid2D& grid = result.grid;
  std::string text = fmt::format(
      "surface     {} x {} points, {} x {}, {}\nrms height  {}\nrms slope   {}\nE*, G*      {}, "
      "{}\n\n",
      grid.nx, grid.ny, format_quantity(grid.lx, Dimension::length),
      format_quantity(grid.ly, Dimension::length),
      result.realisations.size() == 1 ? "1 surface"
                                      : fmt::format("{} surfaces", result.realisations.size()),
      format_quantity(student_mean(rms_heights).mean, Dimension::length),
      format_quantity(student_mean(rms_slopes).mean, Dimension::dimensionless),
      format_quantity(result.configuration.material.contact_modulus, Dimension::pressure),
      format_quantity(result.configuration.material.tangential_modulus, Dimension::pressure));

  text += "Decay length l of pressure = p0 exp(-mean gap/l)\n";
  std::vector<std::vector<std::string>> rows{
      {"model", "l", "95 % interval", "l/h_rms", "95 % interval"}};
  for (const StudyModel& model : study_models) {
    const EnsembleMean length = result.decay_length(model.result);
    const EnsembleMean ratio = result.decay_length_over_rms_height(model.result);
    rows.push_back({title_of(model.name), format_quantity(length.mean, Dimension::length),
                    interval(length, Dimension::length), fmt::format("{:.3f}", ratio.mean),
                    interval(ratio, Dimension::dimensionless)});
  }
  text += to_table(rows, 2, true) + "  (" + result.interval_method() + ")\n" + bend(result) + "\n";

  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  const std::string law = drag ? "Eq. (16)" : "Eq. (12)";
  text += "Damping constant: " + describe_motion(result.configuration.motion) + "\n";
  rows = {{"pressure", "force", law, "measured curve", "95 % interval", law + " is off by"}};
  const auto by_law = result.damping(&DampingPoint::law_damping_constant);
  const auto by_curve = result.damping(&DampingPoint::curve_damping_constant);
  const auto deviation = result.damping_deviation();
  for (std::size_t i = 0; i < result.pressures.size(); ++i) {
    rows.push_back({format_quantity(result.pressures[i], Dimension::pressure),
                    format_quantity(result.pressures[i] * grid.area(), Dimension::force),
                    format_quantity(by_law[i].mean, Dimension::damping),
                    format_quantity(by_curve[i].mean, Dimension::damping),
                    interval(by_curve[i], Dimension::damping),
                    std::isnan(deviation[i].mean)
                        ? "n/a"
                        : fmt::format("{:+.1f} %", 100 * deviation[i].mean)});
  }
  text += to_table(rows) + "\n" + verdict(deviation, law) + "\n";
  if (!file.empty()) text += fmt::format("\nresults: {}\n", file);
  return text;
}

/// The study file, or what a measured surface needs without one, with the options in place of what either says.
StudyConfiguration configuration_of(const StudyArguments& arguments) {
  const bool from_file = !arguments.configuration.empty();
  if (!from_file && !arguments.surface.given())
    throw InvalidInput("CONFIG: none; give a study file, or --surface with material and motion");
  StudyConfiguration configuration;
  if (from_file) {
    configuration = read_study_configuration(arguments.configuration);
  } else {
    configuration.pressures = parse_values("5e-4:0.2:16", Dimension::dimensionless, "pressures");
    configuration.relative_pressures = true;
  }
  if (arguments.surface.given()) {
    configuration =
        with_surface(std::move(configuration),
                     {arguments.surface.file, arguments.surface.size_x, arguments.surface.size_y,
                      arguments.surface.detrend_method(), arguments.surface.height_unit});
  }
  if (!from_file || arguments.material.given())
    configuration.material = arguments.material.material_with_tangential_modulus();
  if (!from_file || arguments.motion.given()) {
    const auto motions = arguments.motion.motions();
    require(motions.size() == 1, arguments.motion.varied().first, motions.size(),
            "values; a study has one motion");
    configuration.motion = motions.front();
  }
  if (!arguments.pressures.empty()) {
    configuration.pressures = arguments.pressures;
    configuration.relative_pressures = false;
  }
  if (arguments.no_stick) configuration.stick = false;
  return configuration;
}

void run(const StudyArguments& arguments, Session& session) {
  const StudyResult result = run_study(configuration_of(arguments), session.progress());
  for (const std::string& warning : result.warnings) session.warn(warning);
  if (result.realisations.empty())
    throw Interrupted("study: interrupted before the first surface was finished");
  const std::string file = session.has_output() ? session.output().string() : "";
  if (!file.empty()) {
    write_study(session.output(), result, session.provenance(), session.write_options());
  } else {
    session.note("no file was written; add --output FILE to keep the results");
  }
  session.answer(to_json(result, file), to_text(result, file));
  if (result.interrupted) {
    throw Interrupted(
        fmt::format("study: interrupted; the {} surfaces that were finished are in the result",
                    result.realisations.size()));
  }
}

}  // namespace

void add_study_command(Program& program) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App& command = program.add_command(
      "study", "from surfaces to damping constants: the whole job",
      {"salebra study data/quickstart.toml -o quickstart.h5",
       "salebra study --surface scan.txt --contact-modulus 115GPa --poisson 0.3 "
       "--normal-amplitude 1nm --drag-velocity 1mm/s --frequency 20kHz"},
      [arguments](Session& session) { run(*arguments, session); });
  command
      .add_option("CONFIG", arguments->configuration,
                  "study file (TOML); options take the place of what it says")
      ->type_name("FILE");
  arguments->surface.add_to(command, false, "--surface");
  arguments->material.add_to(command);
  arguments->motion.add_to(command);
  add_values(command, "--pressures", arguments->pressures, Dimension::pressure,
             "loads of the boundary elements, such as 1MPa:1GPa:16");
  command.add_flag(
      "--no-stick", arguments->no_stick,
      "K_t = (G*/E*)K in place of a stick solve on each contact: faster, exact at nu = 0");
}

}  // namespace salebra::cli
