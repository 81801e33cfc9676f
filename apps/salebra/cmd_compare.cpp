// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra compare`: contact models side by side on the same surfaces.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/study/study.hpp>
#include <utility>

#include "program.hpp"
#include "results/describe.hpp"
#include "study_command.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

std::string number(double value, int digits = 3) {
  return std::isnan(value) ? "n/a" : fmt::format("{:.{}g}", value, digits);
}

std::string limits(const EnsembleMean& estimate) {
  return interval(estimate, Dimension::dimensionless, 3);
}

/// Formats an estimate as "0.42 ± 0.01", where 0.01 is half the width of its interval.
std::string with_error(const EnsembleMean& estimate, double scale = 1) {
  if (std::isnan(estimate.mean)) return "n/a";
  if (std::isnan(estimate.low)) return fmt::format("{:.3g}", scale * estimate.mean);
  return fmt::format("{:.3g} ± {:.2g}", scale * estimate.mean,
                     scale * (estimate.high - estimate.low) / 2);
}

Json model_json(const StudyResult& result, const StudyModel& model) {
  Json answer = {{"title", model.title}};
  answer["curve"] =
      columns_json<ForceSample>([&](const auto& number) { return result.curve(number, model.id); });
  answer["curve"]["pressure"] = result.pressures;
  for_each_number<ModelResult>([&](const auto&, const Quantity& quantity) {
    answer[std::string(quantity.name)] = to_json(result.fitted(quantity.name, model.id));
  });
  answer["damping"] = damping_columns(result, model.id);
  for (const auto& [name, ratios] : result.comparison(model.id))
    answer["over_bem"][name] = to_json(ratios);
  return answer;
}

Json comparison_json(const StudyResult& result, const StudySolution& found) {
  const StudyTheories theories = result.theories();
  Json theory = answer_json(theories);
  // `relative_pressure` is already the coordinate of the whole answer.
  theory.erase("relative_pressure");
  const auto& stiffness = theories.normal_stiffness;
  theory["campana_persson_muser"] = {
      {"decay_length_over_rms_height", to_json(theories.decay_length_over_rms_height)},
      {"normal_stiffness", stiffness.empty() ? Json(nullptr) : to_json(stiffness)}};
  Json spots =
      columns_json<SpotStatistics>([&](const auto& number) { return result.spots(number); });
  spots["corrected_area_slope"] = to_json(result.mean(&Realisation::corrected_area_slope));
  Json answer = {{"pressure", result.pressures},
                 {"relative_pressure", theories.relative_pressure},
                 {"theories", theory},
                 {"spots", spots}};
  if (!result.configuration.adhesion) {
    answer["damping"] = damping_json(found);
    answer["damping"]["hold"] = std::string(name_of(result.configuration.hold()));
  }
  answer["interval_method"] = result.interval_method();
  for (const StudyModel& model : result.models())
    answer["models"][model.name] = model_json(result, model);
  add_ensemble(answer, result, found);
  return answer;
}

/// Indices of at most `count` pressures, evenly spread over those at which boundary elements have a
/// damping constant.
std::vector<std::size_t> shown_pressures(const StudyResult& result, std::size_t count) {
  const auto damping = result.damping(&DampingPoint::work_per_cycle_without_slip);
  std::vector<std::size_t> known, shown;
  for (std::size_t k = 0; k < damping.size(); ++k)
    if (result.configuration.adhesion || !std::isnan(damping[k].mean)) known.push_back(k);
  if (known.size() <= count) return known;
  for (std::size_t i = 0; i < count; ++i)
    shown.push_back(known[i * (known.size() - 1) / (count - 1)]);
  return shown;
}

std::string slopes_table(const StudyResult& result) {
  std::vector<std::vector<std::string>> rows{
      {"model", "l/h_rms", "95 % interval", "bend of l", "area slope", "95 % interval"}};
  for (const StudyModel& model : result.models()) {
    const EnsembleMean ratio = result.decay_length_over_rms_height(model.id);
    const EnsembleMean slope = result.fitted("area_slope", model.id);
    const double bend = result.fitted("law_bend", model.id).mean;
    rows.push_back({model.title, number(ratio.mean), limits(ratio),
                    std::isnan(bend) ? "n/a" : fmt::format("{:+.0f} %", 100 * bend),
                    number(slope.mean), limits(slope)});
  }
  const EnsembleMean corrected = result.mean(&Realisation::corrected_area_slope);
  const StudyTheories theories = result.theories();
  const EnsembleMean& simple = theories.decay_length_over_rms_height;
  rows.push_back({"boundary elements, area less its edge", "", "", "", number(corrected.mean),
                  limits(corrected)});
  rows.push_back(
      {"Bush, Gibson, Thomas (p -> 0)", "", "", "", number(theories.bgt_area_slope, 4), ""});
  rows.push_back({"Persson (p -> 0)", "", "", "", number(theories.persson_area_slope, 4), ""});
  rows.push_back(
      {"Campañá, Persson, Müser: K = p/u0", number(simple.mean), limits(simple), "", "", ""});
  return "Decay length of force with mean gap, and slope of A/A0 over p/(E* h')\n" +
         to_table(rows, 2, true) + "  (" + result.interval_method() + ")\n";
}

std::string loads_table(const StudyResult& result) {
  std::vector<std::vector<std::string>> rows{{"p/(E* h')", "gap/h_rms", "A/A0 %", "less edge",
                                              "Persson", "bearing", "K h_rms/F", "spots",
                                              "largest/all"}};
  const auto area = result.curve(&ForceSample::contact_area_fraction);
  const auto corrected = result.spots(&SpotStatistics::corrected_area_fraction);
  const bool by_persson = result.configuration.has(ContactModel::persson);
  const auto persson =
      by_persson ? result.curve(&ForceSample::contact_area_fraction, ContactModel::persson)
                 : std::vector<EnsembleMean>(result.pressures.size());
  const StudyTheories theories = result.theories();
  const auto& bearing = theories.bearing_area_fraction;
  const auto count = result.spots(&SpotStatistics::spot_count);
  const auto gap = result.at_pressures([](const Realisation& r, std::size_t k) {
    return r.of(ContactModel::bem).curve.samples[k].mean_gap / r.heights.rms_height;
  });
  const auto stiffness = result.at_pressures([](const Realisation& r, std::size_t k) {
    const ForceSample& sample = r.of(ContactModel::bem).curve.samples[k];
    return sample.normal_stiffness * r.heights.rms_height / sample.force;
  });
  const auto largest = result.spots(&SpotStatistics::max_spot_share);
  for (const std::size_t k : shown_pressures(result, 8)) {
    rows.push_back({number(theories.relative_pressure[k], 2), with_error(gap[k]),
                    with_error(area[k], 100), number(100 * corrected[k].mean),
                    number(100 * persson[k].mean), number(100 * bearing[k].mean),
                    with_error(stiffness[k]), number(count[k].mean), number(largest[k].mean, 2)});
  }
  return "Boundary elements at some loads; areas by Persson at the same load, above the same "
         "gap\n" +
         to_table(rows);
}

std::string damping_table(const StudyResult& result, const StudySolution& found) {
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  std::vector<std::vector<std::string>> rows{{"model", "route"}};
  const auto shown = shown_pressures(result, 5);
  for (const std::size_t k : shown)
    rows.front().push_back(number(result.pressures[k] / result.contact_scale, 2));
  const std::pair<const char*, double DampingPoint::*> routes[] = {
      {drag ? "Eq. (16)" : "Eq. (12), l", &DampingPoint::work_per_cycle_closed_form},
      {drag ? "Eq. (15)" : "Eq. (12)", &DampingPoint::small_amplitude_work},
      {"theorem", &DampingPoint::work_per_cycle_without_slip}};
  for (const StudyModel& model : result.models()) {
    std::string title = model.title;
    for (const auto& [route, quantity] : routes) {
      const auto ratio = result.damping_over_bem(quantity, model.id);
      std::vector<std::string> row{std::exchange(title, ""), route};
      for (const std::size_t k : shown) row.push_back(with_error(ratio[k]));
      rows.push_back(std::move(row));
    }
  }
  if (!std::isnan(result.configuration.known.friction_coefficient)) {
    const auto reference = result.damping(&DampingPoint::work_per_cycle_without_slip);
    std::vector<std::string> row{"boundary elements with slip", "springs"};
    for (const std::size_t k : shown)
      row.push_back(number(found.work_per_cycle[k].mean / reference[k].mean));
    rows.push_back(std::move(row));
  }
  return "Damping over that of the boundary-element curve (theorem), at p/(E* h') = …\n" +
         to_table(rows, 2, true);
}

/// Table of the pull-off pressures of the adhesive models.
std::string pull_off_table(const StudyResult& result) {
  std::vector<std::vector<std::string>> rows{{"model", "pull-off", "95 % interval"}};
  for (const StudyModel& model : result.models()) {
    const EnsembleMean mean = result.fitted("pull_off_pressure", model.id);
    if (!std::isnan(mean.mean))
      rows.push_back({model.title, format_quantity(mean.mean, Dimension::pressure, 3),
                      interval(mean, Dimension::pressure, 3)});
  }
  return rows.size() == 1 ? "" : "Pull-off\n" + to_table(rows) + "\n";
}

std::string comparison_text(const StudyResult& result, const StudySolution& found) {
  const std::string contact = heading(result) + slopes_table(result) + law_verdict(result) + "\n" +
                              loads_table(result) + "\n";
  if (result.configuration.adhesion)
    return contact + pull_off_table(result) + ensemble_warnings(result);
  const AssumptionReport assumptions = assumptions_of(found, result);
  return contact + assumptions.warning() + damping_table(result, found) + "\n" +
         assumptions.text() + "\n" + ensemble_warnings(result);
}

struct CompareArguments {
  StudyArguments study;
  std::vector<std::string> models;
};

void run(const CompareArguments& arguments, Session& session) {
  StudyConfiguration configuration = arguments.study.study();
  configuration.models =
      arguments.models.empty() ? configuration.compared_models : contact_models(arguments.models);
  run_study("compare", configuration, arguments.study, session, [](const StudyResult& result) {
    const StudySolution found = solution_of(result);
    return PointAnswer{comparison_json(result, found), comparison_text(result, found)};
  });
}

/// Names of all models except boundary elements: "gw_moments, gw_deterministic, … and persson".
std::string other_models() {
  std::vector<std::string_view> names;
  for (const StudyModel& model : contact_models().subspan(1)) names.emplace_back(model.name);
  return fmt::format("{}", fmt::join(names.begin(), names.end() - 1, ", ")) + " and " +
         std::string(names.back());
}

}  // namespace

void add_compare_command(Program& program) {
  auto arguments = std::make_shared<CompareArguments>();
  Command& command = program.add_command(
      "compare", "all contact models on the same surfaces",
      {"salebra compare data/paper.toml -o paper.h5 --plot paper.png",
       "salebra compare data/quickstart.toml --target-precision 5% --json"},
      [arguments](Session& session) { run(*arguments, session); },
      "force over gap, area, stiffness and damping of all models, with bands", study_output);
  arguments->study.add_to(command, false);
  command
      .add_option("--models", arguments->models,
                  "models to compare with the boundary elements: any of " + other_models() +
                      "; default: all")
      ->delimiter(',')
      ->type_name("NAME,...");
}

}  // namespace salebra::cli
