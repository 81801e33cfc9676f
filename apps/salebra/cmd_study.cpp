// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra study`: the path from surfaces to damping for an ensemble.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/study/study.hpp>

#include "compare_figure.hpp"
#include "program.hpp"
#include "study_command.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

Json study_json(const StudyResult& result, const StudyPremises& premises, const StudyFiles& files) {
  Json comparison;
  for (const StudyModel& model : result.models()) {
    comparison[model.name] = {
        {"decay_length", to_json(result.decay_length(model.id))},
        {"decay_length_over_rms_height", to_json(result.decay_length_over_rms_height(model.id))}};
  }
  Json damping =
      columns_json<DampingPoint>([&](const auto& number) { return result.damping(number); });
  damping["deviation"] = to_json(result.deviation());
  std::vector<double> forces;
  for (const double pressure : result.pressures) forces.push_back(pressure * result.grid.area());
  damping["pressure"] = result.pressures;
  damping["force"] = forces;
  damping.erase("damping_constant_error");
  damping["damping_constant"] = to_json(result.stated_damping());
  damping["damping_constant_eq16"]["error"] = std::vector<Json>(forces.size());
  Json answer = {{"decay_length", to_json(result.decay_length())},
                 {"decay_length_over_rms_height", to_json(result.decay_length_over_rms_height())},
                 {"damping", damping},
                 {"comparison", comparison},
                 {"realisations", result.realisations.size()},
                 {"flags", flags_json(result)},
                 {"files", files.json()}};
  add_first_loading(answer, result);
  add_premises(answer, premises);
  return answer;
}

/// What the difference between the law and the curve amounts to, in one sentence.
std::string verdict(const StudyResult& result, const std::string& law) {
  const auto [low, high] = result.deviation_range();
  if (std::isnan(low))
    return law + " could not be compared: no damping constant is known at any force.";
  return fmt::format(
      "{} with the fitted decay length is between {:+.0f} % and {:+.0f} % off the damping constant "
      "computed.",
      law, 100 * low, 100 * high);
}

/// What one surface has in place of an interval: how l varies along its curve, and with the part of
/// the window that is fitted.
std::vector<std::string> one_surface_row(const std::string& title, const std::string& length,
                                         const std::string& relative, const ModelResult& model) {
  const auto range = [](double from, double to) {
    return from > 0 && to > 0 ? fmt::format("{:.3f} … {:.3f}", from, to) : "n/a";
  };
  return {
      title, length, relative,
      range(model.decay_length_closest_over_rms_height(),
            model.decay_length_farthest_over_rms_height()),
      range(model.decay_length_min_over_rms_height(), model.decay_length_max_over_rms_height())};
}

/// With as many digits as the error leaves.
std::string damping_text(const StatedMean& estimate) {
  const double relative = estimate.error / std::abs(estimate.mean);
  double value = estimate.mean;
  if (relative > 0 && value != 0) {
    const double digits = std::clamp(std::ceil(-std::log10(relative)) + 1, 1.0, 4.0);
    const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - digits);
    value = std::round(value / unit) * unit;
  }
  return format_quantity(value, Dimension::damping);
}

std::string decay_length_table(const StudyResult& result) {
  const bool sample = result.realisations.size() > 1;
  std::vector<std::vector<std::string>> rows{
      sample ? std::vector<std::string>{"model", "l", "95 % interval", "l/h_rms", "95 % interval"}
             : std::vector<std::string>{"model", "l", "l/h_rms", "closest … farthest",
                                        "parts of the window"}};
  for (const StudyModel& model : result.models()) {
    const EnsembleMean length = result.decay_length(model.id);
    const EnsembleMean ratio = result.decay_length_over_rms_height(model.id);
    const std::string l = format_quantity(length.mean, Dimension::length);
    const std::string relative = std::isnan(ratio.mean) ? "n/a" : fmt::format("{:.3f}", ratio.mean);
    if (sample)
      rows.push_back({model.title, l, interval(length, Dimension::length), relative,
                      interval(ratio, Dimension::dimensionless)});
    else
      rows.push_back(
          one_surface_row(model.title, l, relative, result.realisations.front().of(model.id)));
  }
  return "Decay length l of pressure = p0 exp(-mean gap/l)\n" + to_table(rows, 2, true) +
         (sample ? "  (" + result.interval_method() + ")\n"
                 : "  (l/h_rms at the closest and the farthest gap of the window, and of fits to "
                   "parts of it; an interval needs several surfaces)\n");
}

std::string damping_table(const StudyResult& result, const StudyPremises& premises,
                          const std::string& law) {
  const bool sample = result.realisations.size() > 1,
             slip = !std::isnan(result.configuration.known.friction_coefficient);
  std::vector<std::vector<std::string>> rows{{"pressure", "force", law, "computed", "error"}};
  if (sample) rows[0].push_back("95 % interval");
  rows[0].push_back(law + " is off by");
  if (slip) rows[0].push_back("with slip");
  const auto by_law = result.damping(&DampingPoint::damping_constant_eq16);
  const auto computed = result.stated_damping();
  int unstated = 0;
  const auto deviation = result.deviation();
  for (std::size_t i = 0; i < result.pressures.size(); ++i) {
    const double relative = computed[i].error / std::abs(computed[i].mean);
    rows.push_back({format_quantity(result.pressures[i], Dimension::pressure),
                    format_quantity(result.pressures[i] * result.grid.area(), Dimension::force),
                    format_quantity(by_law[i].mean, Dimension::damping), damping_text(computed[i]),
                    std::isfinite(relative) ? fmt::format("{:.2g} %", 100 * relative) : "n/a"});
    unstated += std::isnan(computed[i].mean) && !std::isnan(computed[i].error);
    if (sample) rows.back().push_back(interval(computed[i], Dimension::damping));
    rows.back().push_back(
        std::isnan(deviation[i].mean) ? "n/a" : fmt::format("{:+.1f} %", 100 * deviation[i].mean));
    if (slip)
      rows.back().push_back(
          format_quantity(premises.damping_constant_with_slip[i], Dimension::damping));
  }
  std::string text = "Damping constant: " + describe_motion(result.configuration.motion) + "\n" +
                     to_table(rows) + "\n";
  if (unstated > 0)
    text += fmt::format(
        "n/a at {} of {} pressures: the error is larger than the number, because too few cells "
        "touch and part in the oscillation; a finer grid or --relative-error may help.\n",
        unstated, result.pressures.size());
  return text;
}

std::string study_text(const StudyResult& result, const StudyPremises& premises,
                       const StudyFiles& files) {
  const PremiseReport judged{premises.premises, true, result.pressures};
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  const std::string law = drag ? "Eq. (16)" : "Eq. (12)";
  std::string text = heading(result) + judged.above() + decay_length_table(result) +
                     law_verdict(result) + "\n" + damping_table(result, premises, law) +
                     verdict(result, law) + "\n";
  if (const std::string slips = regimes(premises, result.pressures); !slips.empty())
    text += "Regime: " + slips + "\n";
  text += judged.open_points();
  if (const std::string remarks = ensemble_remarks(result); !remarks.empty())
    text += "\n" + remarks;
  if (const std::string where = files.text(); !where.empty()) text += "\n" + where;
  return text;
}

Json with_processes(Json answer, const StudyArguments& arguments, const Session& session) {
  if (!session.ranks().alone()) answer["groups"] = std::max(1, arguments.groups);
  return session.with_processes(std::move(answer));
}

void run(const StudyArguments& arguments, Session& session) {
  for (const auto& [given, option] : {std::pair(arguments.merge, "--merge"),
                                      {arguments.shard.has_value(), "--shard"},
                                      {arguments.shard_seconds.has_value(), "--shard-seconds"},
                                      {session.has_plot(), "--plot"}})
    if (given) session.require_one_process(option);
  StudyConfiguration configuration;
  collectively(session.ranks(), [&] { configuration = arguments.study(); });
  name_surface(configuration, session);
  if (run_without_results(configuration, arguments, session)) return;
  StudyReport report(arguments, session);
  const std::vector<StudyResult> results = run_and_keep(configuration, arguments, report, session);
  if (results.empty()) return;
  if (session.has_plot()) session.plot(compare_figure(results, configuration.ensemble));
  const StudyFiles files{session.has_output() ? session.output().string() : "", report.write()};
  if (results.size() == 1 && configuration.ensemble.empty()) {
    const StudyPremises premises = premises_of(results.front());
    session.answer(with_processes(study_json(results.front(), premises, files), arguments, session),
                   study_text(results.front(), premises, files));
  } else {
    Json points = Json::array();
    std::string text;
    for (const StudyResult& result : results) {
      const std::string name = describe_point(configuration.ensemble, result.configuration);
      const StudyPremises premises = premises_of(result);
      Json point = study_json(result, premises, files);
      point.erase("files");
      point["point"] = name;
      points.push_back(std::move(point));
      text += "== " + name + " ==\n" + study_text(result, premises, {}) + "\n";
    }
    session.answer(
        with_processes({{"points", points}, {"files", files.json()}}, arguments, session),
        text + files.text());
  }
  report.require_written();
  if (std::ranges::any_of(results, &StudyResult::interrupted))
    throw Interrupted("study: interrupted; the surfaces that were finished are in the answer");
}

}  // namespace

void add_study_command(Program& program) {
  auto arguments = std::make_shared<StudyArguments>();
  Command& command = program.add_command(
      "study", "from surfaces to damping constants: the whole job",
      {"salebra study data/quickstart.toml -o quickstart.h5",
       "salebra study --surface scan.txt --contact-modulus 115GPa --poisson 0.3 "
       "--normal-amplitude 1nm --drag-velocity 100nm/s --frequency 20kHz"},
      [arguments](Session& session) { run(*arguments, session); },
      "force, area, stiffness and damping of all models", study_output);
  arguments->add_to(command, true);
}

}  // namespace salebra::cli
