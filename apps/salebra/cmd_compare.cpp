// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra compare`: contact models side by side on the same surfaces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/study/study.hpp>
#include <utility>

#include "compare_figure.hpp"
#include "dry_run.hpp"
#include "program.hpp"
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

/// "0.42 ± 0.01", half the width of the interval.
std::string with_error(const EnsembleMean& estimate, double scale = 1) {
  if (std::isnan(estimate.mean)) return "n/a";
  if (std::isnan(estimate.low)) return fmt::format("{:.3g}", scale * estimate.mean);
  return fmt::format("{:.3g} ± {:.2g}", scale * estimate.mean,
                     scale * (estimate.high - estimate.low) / 2);
}

EnsembleMean over_rms_height(const StudyResult& result, double Realisation::*length) {
  return result.mean([&](const Realisation& r) { return r.*length / r.heights.rms_height; });
}

std::vector<EnsembleMean> spots(const StudyResult& result, double SpotStatistics::*quantity) {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < result.pressures.size(); ++k)
    estimates.push_back(result.mean([&](const Realisation& r) { return r.spots[k].*quantity; }));
  return estimates;
}

std::vector<EnsembleMean> bearing_area(const StudyResult& result) {
  return at_pressures(result, [](const Realisation& r, std::size_t k) {
    return bearing_area_fraction(r.bem.curve.samples[k].mean_gap, r.heights.rms_height);
  });
}

/// K of Campañá, Persson and Müser, pA0/u0.
std::vector<EnsembleMean> simple_stiffness(const StudyResult& result) {
  return at_pressures(result, [&](const Realisation& r, std::size_t k) {
    return result.pressures[k] * result.grid.area() / r.persson_decay_length;
  });
}

Json model_json(const StudyResult& result, const StudyModel& model) {
  Json answer{{"title", model.title}};
  Json& curve = answer["curve"];
  curve["pressure"] = result.pressures;
  for (const auto& [name, quantity] :
       {std::pair{"mean_gap", &ForceSample::mean_gap},
        {"separation", &ForceSample::separation},
        {"force", &ForceSample::force},
        {"contact_area_fraction", &ForceSample::contact_area_fraction},
        {"normal_stiffness", &ForceSample::normal_stiffness},
        {"tangential_stiffness", &ForceSample::tangential_stiffness}})
    curve[name] = to_json(result.curve(model.result, quantity));
  answer["decay_length"] = to_json(result.decay_length(model.result));
  answer["decay_length_over_rms_height"] =
      to_json(result.decay_length_over_rms_height(model.result));
  answer["law_bend"] = to_json(result.law_bend(model.result));
  answer["area_slope"] = to_json(result.area_slope(model.result));
  const auto damping = [&](double DampingPoint::*quantity) {
    return to_json(result.damping(quantity, model.result));
  };
  answer["damping_constant"] = {{"law", damping(&DampingPoint::law_damping_constant)},
                                {"small_amplitude", damping(&DampingPoint::small_damping_constant)},
                                {"curve", damping(&DampingPoint::curve_damping_constant)}};
  const auto ratio = [&](double DampingPoint::*quantity) {
    return to_json(result.damping_over_bem(model.result, quantity));
  };
  answer["over_bem"] = {
      {"mean_gap", to_json(result.over_bem(model.result, &ForceSample::mean_gap))},
      {"contact_area_fraction",
       to_json(result.over_bem(model.result, &ForceSample::contact_area_fraction))},
      {"normal_stiffness", to_json(result.over_bem(model.result, &ForceSample::normal_stiffness))},
      {"damping_constant",
       {{"law", ratio(&DampingPoint::law_work)},
        {"small_amplitude", ratio(&DampingPoint::small_work)},
        {"curve", ratio(&DampingPoint::curve_work)}}}};
  return answer;
}

Json comparison_json(const StudyResult& result) {
  Json models = Json::object();
  for (const StudyModel& model : result.models())
    models[name_of(model.model)] = model_json(result, model);
  std::vector<double> relative;
  for (const double pressure : result.pressures)
    relative.push_back(pressure / result.contact_scale);
  return {{"realisations", result.realisations.size()},
          {"pressure", result.pressures},
          {"relative_pressure", relative},
          {"models", models},
          {"theories",
           {{"bgt_area_slope", bgt_slope},
            {"persson_area_slope", persson_slope},
            {"bearing_area_fraction", to_json(bearing_area(result))},
            {"campana_persson_muser",
             {{"decay_length_over_rms_height",
               to_json(over_rms_height(result, &Realisation::persson_decay_length))},
              {"normal_stiffness", to_json(simple_stiffness(result))}}}}},
          {"spots",
           {{"count", to_json(spots(result, &SpotStatistics::count))},
            {"largest_area", to_json(spots(result, &SpotStatistics::largest_area))},
            {"mean_area", to_json(spots(result, &SpotStatistics::mean_area))},
            {"corrected_area_fraction",
             to_json(spots(result, &SpotStatistics::corrected_area_fraction))},
            {"corrected_area_slope",
             to_json(result.mean([](const Realisation& r) { return r.corrected_area_slope; }))}}},
          {"flags", flags_json(result)},
          {"interval_method", result.interval_method()}};
}

/// At most `count` of the pressures, evenly spread, and only those for which the boundary elements have a damping.
std::vector<std::size_t> shown_pressures(const StudyResult& result, std::size_t count) {
  const auto damping = result.damping(&DampingPoint::curve_work);
  std::vector<std::size_t> known, shown;
  for (std::size_t k = 0; k < damping.size(); ++k)
    if (!std::isnan(damping[k].mean)) known.push_back(k);
  if (known.size() <= count) return known;
  for (std::size_t i = 0; i < count; ++i)
    shown.push_back(known[i * (known.size() - 1) / (count - 1)]);
  return shown;
}

std::string slopes_table(const StudyResult& result) {
  std::vector<std::vector<std::string>> rows{
      {"model", "l/h_rms", "95 % interval", "bend of l", "area slope", "95 % interval"}};
  for (const StudyModel& model : result.models()) {
    const EnsembleMean ratio = result.decay_length_over_rms_height(model.result);
    const EnsembleMean slope = result.area_slope(model.result);
    const double bend = result.law_bend(model.result).mean;
    rows.push_back({model.title, number(ratio.mean), limits(ratio),
                    std::isnan(bend) ? "n/a" : fmt::format("{:+.0f} %", 100 * bend),
                    number(slope.mean), limits(slope)});
  }
  const EnsembleMean corrected =
      result.mean([](const Realisation& r) { return r.corrected_area_slope; });
  const EnsembleMean simple = over_rms_height(result, &Realisation::persson_decay_length);
  rows.push_back({"boundary elements, area less its edge", "", "", "", number(corrected.mean),
                  limits(corrected)});
  rows.push_back({"Bush, Gibson, Thomas (p -> 0)", "", "", "", number(bgt_slope, 4), ""});
  rows.push_back({"Persson (p -> 0)", "", "", "", number(persson_slope, 4), ""});
  rows.push_back(
      {"Campañá, Persson, Müser: K = p/u0", number(simple.mean), limits(simple), "", "", ""});
  return "Decay length of force with mean gap, and slope of A/A0 over p/(E* h')\n" +
         to_table(rows, 2, true) + "  (" + result.interval_method() + ")\n";
}

std::string loads_table(const StudyResult& result) {
  std::vector<std::vector<std::string>> rows{{"p/(E* h')", "gap/h_rms", "A/A0 %", "less edge",
                                              "Persson", "bearing", "K h_rms/F", "spots",
                                              "largest/all"}};
  const auto area = result.curve(&Realisation::bem, &ForceSample::contact_area_fraction);
  const auto corrected = spots(result, &SpotStatistics::corrected_area_fraction);
  const auto persson = result.curve(&Realisation::persson, &ForceSample::contact_area_fraction);
  const auto bearing = bearing_area(result);
  const auto count = spots(result, &SpotStatistics::count);
  const auto gap = at_pressures(result, [](const Realisation& r, std::size_t k) {
    return r.bem.curve.samples[k].mean_gap / r.heights.rms_height;
  });
  const auto stiffness = at_pressures(result, [](const Realisation& r, std::size_t k) {
    const ForceSample& sample = r.bem.curve.samples[k];
    return sample.normal_stiffness * r.heights.rms_height / sample.force;
  });
  const auto largest = at_pressures(result, [](const Realisation& r, std::size_t k) {
    return r.spots[k].largest_area / (r.spots[k].count * r.spots[k].mean_area);
  });
  for (const std::size_t k : shown_pressures(result, 8)) {
    rows.push_back({number(result.pressures[k] / result.contact_scale, 2), with_error(gap[k]),
                    with_error(area[k], 100), number(100 * corrected[k].mean),
                    number(100 * persson[k].mean), number(100 * bearing[k].mean),
                    with_error(stiffness[k]), number(count[k].mean), number(largest[k].mean, 2)});
  }
  return "Boundary elements at some loads; areas by Persson at the same load, above the same "
         "gap\n" +
         to_table(rows);
}

std::string damping_table(const StudyResult& result) {
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  std::vector<std::vector<std::string>> rows{{"model", "route"}};
  const auto shown = shown_pressures(result, 5);
  for (const std::size_t k : shown)
    rows.front().push_back(number(result.pressures[k] / result.contact_scale, 2));
  const std::pair<const char*, double DampingPoint::*> routes[] = {
      {drag ? "Eq. (16)" : "Eq. (12), l", &DampingPoint::law_work},
      {drag ? "Eq. (15)" : "Eq. (12)", &DampingPoint::small_work},
      {"theorem", &DampingPoint::curve_work}};
  for (const StudyModel& model : result.models()) {
    std::string title = model.title;
    for (const auto& [route, quantity] : routes) {
      const auto ratio = result.damping_over_bem(model.result, quantity);
      std::vector<std::string> row{std::exchange(title, ""), route};
      for (const std::size_t k : shown) row.push_back(with_error(ratio[k]));
      rows.push_back(std::move(row));
    }
  }
  return "Damping over that of the boundary-element curve (theorem), at p/(E* h') = …\n" +
         to_table(rows, 2, true);
}

std::string comparison_text(const StudyResult& result) {
  return heading(result) + slopes_table(result) + law_verdict(result) + "\n" + loads_table(result) +
         "\n" + damping_table(result) + "\n" + ensemble_remarks(result);
}

struct CompareArguments {
  StudyArguments study;
  std::vector<std::string> models;
};

void run(const CompareArguments& arguments, Session& session) {
  StudyConfiguration configuration = arguments.study.study();
  configuration.models =
      arguments.models.empty() ? configuration.compared_models : contact_models(arguments.models);
  if (arguments.study.dry_run) return answer_dry_run(configuration, session);
  StudyReport report(arguments.study, session);
  const std::vector<StudyResult> results =
      run_and_keep(configuration, arguments.study.resume, report, session);
  if (results.empty()) return;
  const StudyFiles files{session.has_output() ? session.output().string() : "", report.write()};
  session.plot(compare_figure(results, configuration.ensemble));
  Json answer = Json::object();
  std::string text;
  if (configuration.ensemble.empty()) {
    answer = comparison_json(results.front());
    text = comparison_text(results.front());
  } else {
    for (const StudyResult& result : results) {
      const std::string name = describe_point(configuration.ensemble, result.configuration);
      Json point{{"point", name}};
      point.update(comparison_json(result));
      answer["points"].push_back(std::move(point));
      text += "== " + name + " ==\n" + comparison_text(result) + "\n";
    }
  }
  answer["files"] = files.json();
  if (const std::string where = files.text(); !where.empty()) text += "\n" + where;
  session.answer(answer, text);
  report.require_written();
  if (std::ranges::any_of(results, &StudyResult::interrupted))
    throw Interrupted("compare: interrupted; the surfaces that were finished are in the answer");
}

}  // namespace

void add_compare_command(Program& program) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App& command = program.add_command(
      "compare", "every contact model on the same surfaces, down to the damping constant",
      {"salebra compare data/paper.toml -o paper.h5 --plot paper.png",
       "salebra compare data/quickstart.toml --precision 5% --json"},
      [arguments](Session& session) { run(*arguments, session); },
      "force over gap, area, stiffness and damping of all models, with bands", study_output);
  arguments->study.add_to(command);
  command
      .add_option("--models", arguments->models,
                  "those to compare with the boundary elements, of gw_moments, gw_deterministic, "
                  "gw_monte_carlo, gw_interacting and persson; default: all")
      ->delimiter(',')
      ->type_name("NAME,...");
}

}  // namespace salebra::cli
