// SPDX-License-Identifier: GPL-3.0-or-later
// Result file of a study, with one dataset for each column in the descriptions of its results. Also
// finds out whether an existing file is a result of the same study.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/error.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/study/study_file.hpp>
#include <salebra/study/study_solution.hpp>
#include <set>

#include "realisation_record.hpp"
#include "results/describe.hpp"
#include "results/quantity_group.hpp"

namespace salebra::detail {
namespace {

using Names = std::vector<std::string>;
using Means = std::vector<EnsembleMean>;

/// A group of the file with its coordinates, and functions that write described results into it.
class Table {
 public:
  explicit Table(ResultGroup group) : group_(std::move(group)) {}
  ResultGroup& group() { return group_; }

  void models(const StudyResult& result) {
    Names names;
    for (const StudyModel& model : result.models()) names.emplace_back(model.name);
    group_.labels("model", names, "contact model");
  }
  void realisations(const StudyResult& result) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < result.realisations.size(); ++i) numbers.push_back(double(i));
    group_.coordinate("realisation", numbers, "1", "number of the surface");
  }
  void pressures(const StudyResult& result) {
    group_.coordinate("pressure", result.pressures, "Pa", "nominal pressure");
    taken_.insert("pressure");
  }

  void put(const Quantity& quantity, const std::vector<double>& values, const Names& axes) {
    const std::string name(quantity.name);
    taken_.insert(name);
    group_.dataset(name, values, axes, std::string(si_unit(quantity.dimension)),
                   std::string(quantity.long_name));
  }

  /// Writes the mean and the limits of estimates as the datasets NAME_mean, NAME_low and NAME_high.
  void put(const std::string& name, const Quantity& quantity, const Means& means,
           const Names& axes) {
    describe(
        [&](auto member, const Kept& part) {
          if constexpr (std::is_member_object_pointer_v<decltype(member)>) {
            std::vector<double> values;
            std::ranges::transform(means, std::back_inserter(values), member);
            const std::string end(part.name);
            group_.dataset(name + "_" + end, values, axes, std::string(si_unit(quantity.dimension)),
                           std::string(quantity.long_name) + ", " + end);
          }
        },
        std::type_identity<EnsembleMean>{});
  }

  /// Writes one dataset for every column of T that has no dataset yet, with one value per item.
  template <class T>
  void columns(const std::vector<const T*>& items, const Names& axes) {
    columns(items, axes, [](const NumberOf<T>&, std::string_view) { return Means(); }, {});
  }
  /// Does the same and, for each number, also writes the estimates means(number, name) as
  /// ensemble_NAME, with the coordinates axes_of_means.
  template <class T, class MeansOf>
  void columns(const std::vector<const T*>& items, const Names& axes, const MeansOf& means,
               const Names& axes_of_means) {
    for_each_column<T>([&](const auto& access, const Quantity& quantity) {
      using Value = std::remove_cvref_t<std::invoke_result_t<decltype(access), const T&>>;
      const std::string name(quantity.name), units(si_unit(quantity.dimension));
      if (taken_.contains(name)) return;
      if constexpr (std::is_same_v<Value, bool>) {
        group_.flags(name, all_of<bool>(items, access), axes, std::string(quantity.long_name));
      } else if constexpr (std::is_integral_v<Value>) {
        group_.dataset(name, all_of<std::int64_t>(items, access), axes, units,
                       std::string(quantity.long_name));
      } else if constexpr (Number<Value>) {
        const auto number = [&](const T& item) { return as_number(access(item)); };
        put(quantity, all_of<double>(items, number), axes);
        if (const Means found = means(number, quantity.name); !found.empty())
          put("ensemble_" + name, quantity, found, axes_of_means);
      }
    });
  }

  /// Writes each column of one item as an attribute of the group.
  template <class T>
  void attributes(const T& item) {
    for_each_column<T>([&](const auto& access, const Quantity& quantity) {
      using Value = std::remove_cvref_t<decltype(access(item))>;
      using Stored = std::conditional_t<std::is_integral_v<Value>, std::int64_t, double>;
      group_.attribute(std::string(quantity.name), static_cast<Stored>(access(item)));
    });
  }

 private:
  template <class Value, class T, class Access>
  static std::vector<Value> all_of(const std::vector<const T*>& items, const Access& access) {
    std::vector<Value> values;
    for (const T* item : items) values.push_back(static_cast<Value>(access(*item)));
    return values;
  }

  ResultGroup group_;
  std::set<std::string> taken_;  ///< names of the coordinates and datasets written so far
};

/// The results of all models on all surfaces: those of the first model on each surface, then those
/// of the second, and so on.
std::vector<const ModelResult*> model_results(const StudyResult& result) {
  std::vector<const ModelResult*> items;
  for (const StudyModel& model : result.models())
    for (const Realisation& realisation : result.realisations)
      items.push_back(&realisation.of(model.id));
  return items;
}

/// Joins the lists means(model) of all models; each list has one mean, or one for each pressure.
template <class MeansOf>
Means of_models(const StudyResult& result, const MeansOf& means) {
  Means all;
  for (const StudyModel& model : result.models()) {
    const auto found = means(model.id);
    if constexpr (std::is_same_v<decltype(found), const EnsembleMean>)
      all.push_back(found);
    else
      all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

void write_surfaces(Table table, const StudyResult& result) {
  table.realisations(result);
  std::vector<const Realisation*> items;
  for (const Realisation& realisation : result.realisations) items.push_back(&realisation);
  table.columns(items, {"realisation"});
  table.attributes(result.grid);
  table.group().attribute("contact_modulus", result.configuration.material.contact_modulus);
  table.group().attribute("modulus_ratio", result.configuration.pressed().modulus_ratio());
  table.group().attribute("contact_scale", result.contact_scale);
  std::string warnings, ensemble;
  for (const std::string& warning : result.warnings) warnings += warning + "\n";
  for (const EnsembleWarning& found : result.ensemble_warnings)
    ensemble += found.name + ": " + found.text + "\n";
  table.group().attribute("warnings", warnings);
  table.group().attribute("ensemble_warnings", ensemble);
}

void write_curves(Table table, const StudyResult& result) {
  if (const std::optional<Body>& body = result.configuration.body)
    table.group().attribute("body", body->fingerprint());
  table.models(result);
  table.realisations(result);
  table.pressures(result);
  std::vector<const ForceSample*> items;
  for (const ModelResult* model : model_results(result))
    for (const ForceSample& sample : model->curve.samples) items.push_back(&sample);
  table.columns(items, {"model", "realisation", "pressure"},
                [&](const NumberOf<ForceSample>& number, std::string_view) {
                  return of_models(result,
                                   [&](ContactModel model) { return result.curve(number, model); });
                },
                {"model", "pressure"});
}

void write_local_decay_lengths(Table table, const StudyResult& result) {
  table.models(result);
  table.realisations(result);
  // If a sample did not converge, the list of a surface is shorter; the rest of its row becomes
  // unknown.
  const std::size_t midpoints = result.pressures.size() - 1;
  table.group().index("midpoint", midpoints, "between consecutive pressures");
  for_each_column<LocalDecayLength>([&](const auto& access, const Quantity& quantity) {
    std::vector<double> values;
    for (const ModelResult* model : model_results(result)) {
      std::vector<double> row = access(model->local);
      row.resize(midpoints, ForceSample::unknown);
      values.insert(values.end(), row.begin(), row.end());
    }
    table.put(quantity, values, {"model", "realisation", "midpoint"});
  });
}

void write_fits(Table table, const StudyResult& result) {
  table.models(result);
  table.realisations(result);
  table.columns(model_results(result), {"model", "realisation"},
                [&](const NumberOf<ModelResult>&, std::string_view name) {
                  return of_models(result,
                                   [&](ContactModel model) { return result.fitted(name, model); });
                },
                {"model"});
  std::vector<std::optional<LawDescription>> laws;
  for (const StudyModel& model : result.models()) laws.push_back(result.law_description(model.id));
  for_each_column<LawDescription>([&](const auto& access, const Quantity& quantity) {
    std::vector<double> values;
    for (const std::optional<LawDescription>& law : laws)
      values.push_back(law ? static_cast<double>(access(*law)) : ForceSample::unknown);
    table.put(quantity, values, {"model"});
  });
  table.group().attribute("interval_method", result.interval_method());
}

void write_damping(Table table, const StudyResult& result) {
  table.models(result);
  table.realisations(result);
  table.pressures(result);
  std::vector<double> forces;
  for (const double pressure : result.pressures) forces.push_back(pressure * result.grid.area());
  table.put({"force", Dimension::force, "normal force"}, forces, {"pressure"});
  std::vector<const DampingPoint*> items;
  for (const ModelResult* model : model_results(result))
    for (const DampingPoint& point : model->damping) items.push_back(&point);
  table.columns(items, {"model", "realisation", "pressure"},
                [&](const NumberOf<DampingPoint>&, std::string_view name) {
                  return of_models(result,
                                   [&](ContactModel model) { return result.damping(name, model); });
                },
                {"model", "pressure"});
  for_each_column<DeviationRange>([&](const auto& access, const Quantity& quantity) {
    std::vector<double> values;
    for (const StudyModel& model : result.models())
      values.push_back(access(result.deviation_range(model.id)));
    table.put(quantity, values, {"model"});
  });
  ResultGroup& group = table.group();
  if (const double direction = result.direction(); !std::isnan(direction))
    group.attribute("direction", direction);
  group.attribute("interval_method", result.interval_method());
  group.attribute("law",
                  "Eq. (16) (drag) or Eq. (12) with F'' = F/l^2, l fitted to the model's curve");
  group.attribute("small_amplitude", "Eq. (15) (drag) or Eq. (12) with F'' of the model's curve");
  group.attribute("curve", "W = 1/2 oint s^2 dK_t on the model's curve itself");
  group.attribute("tangential_stiffness", stick_solves(result.configuration)
                                              ? "boundary elements: stick solves on the contacts"
                                              : "(G*/E*)K");
  const StudyConfiguration& configuration = result.configuration;
  std::visit([&](const auto& motion) { table.attributes(motion); }, configuration.motion);
  group.attribute("mode",
                  std::holds_alternative<Drag>(configuration.motion) ? "drag" : "equal-frequency");
  group.attribute("hold", std::string(name_of(configuration.hold())));
  group.attribute("modulus_ratio", configuration.pressed().modulus_ratio());
  group.attribute("contact_modulus", configuration.material.contact_modulus);
  if (configuration.body)
    group.attribute("datum", std::string(name_of(configuration.body->datum())));
  for (const auto& [name, value] :
       {std::pair("friction_coefficient", configuration.known.friction_coefficient),
        {"excursion", configuration.known.excursion}})
    if (!std::isnan(value)) group.attribute(name, value);
}

void write_solution(Table table, const StudyResult& result, const StudySolution& answer) {
  table.pressures(result);
  for_each_column<StudySolution>([&](const auto& access, const Quantity& quantity) {
    const auto& means = access(answer);
    if (!means.empty())
      table.put(std::string(quantity.name), quantity, Means(means.begin(), means.end()),
                {"pressure"});
  });
  std::vector<double> errors, regimes;
  for (const StatedMean& stated : answer.damping_constant) errors.push_back(stated.error);
  for (const Assumptions& one : answer.assumptions) regimes.push_back(double(one.regime));
  table.put(
      {"damping_constant_error", Dimension::damping, "numerical error of the damping constant"},
      errors, {"pressure"});
  for (const auto& [name, values] : {std::pair("relaxation_share", &answer.relaxation_share),
                                     {"slip_share", &answer.slip_share},
                                     {"regime", &regimes}})
    table.put(find_quantity(name), *values, {"pressure"});
  ResultGroup& group = table.group();
  group.attribute("validity", std::string(name_of(answer.validity)));
  group.attribute("verdicts", in_words(answer.verdicts));
  group.attribute("slip_followed", answer.slip_followed ? "yes" : "no");
}

void write_assumptions(ResultGroup group, const StudyResult& result, const StudySolution& answer) {
  group.coordinate("pressure", result.pressures, "Pa", "nominal pressure");
  for (const AssumptionName& name : assumption_names())
    for_each_column<Assumption>([&](const auto& column, const Quantity& quantity) {
      // Plasticity has an onset and no other limit; the other assumptions have limits and no onset.
      const bool flows = name.assumption == &Assumptions::plasticity;
      if (quantity.name == (flows ? "limit_5_percent" : "onset") ||
          (flows && quantity.name == "limit_20_percent"))
        return;
      std::string dataset(name.name), meaning(name.meaning), unit(si_unit(name.value_dimension));
      if (quantity.name != "value") {
        dataset += "_" + std::string(quantity.name);
        meaning += ", " + std::string(quantity.long_name);
      }
      if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(column(Assumption()))>>) {
        unit = "1";
        meaning = "0 holds, 1 doubtful, 2 broken, 3 unknown";
      }
      std::vector<double> values;
      for (const Assumptions& one : answer.assumptions)
        values.push_back(double(column(one.*name.assumption)));
      group.dataset(dataset, values, {"pressure"}, unit, meaning);
    });
}

void write_spots(Table table, const StudyResult& result) {
  table.realisations(result);
  table.pressures(result);
  std::vector<const SpotStatistics*> items;
  std::size_t bins = 0;
  for (const Realisation& realisation : result.realisations)
    for (const SpotStatistics& spots : realisation.spots) {
      items.push_back(&spots);
      bins = std::max(bins, spots.spots_by_size.size());
    }
  table.columns(items, {"realisation", "pressure"},
                [&](const NumberOf<SpotStatistics>& number, std::string_view) {
                  return result.spots(number);
                },
                {"pressure"});
  std::vector<double> cells;
  for (std::size_t bin = 0; bin < bins; ++bin) cells.push_back(std::exp2(double(bin)));
  table.group().coordinate("min_cells", cells, "1", "cells of the smallest spot that is counted");
  for_each_column<SpotStatistics>([&](const auto& access, const Quantity& quantity) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(access(*items.front()))>,
                                 std::vector<double>>) {
      std::vector<double> values;
      for (const SpotStatistics* spots : items) {
        std::vector<double> row = access(*spots);
        row.resize(bins, ForceSample::unknown);
        values.insert(values.end(), row.begin(), row.end());
      }
      table.put(quantity, values, {"realisation", "pressure", "min_cells"});
    }
  });
}

void write_flow(Table table, const StudyResult& result) {
  table.realisations(result);
  table.pressures(result);
  std::vector<const FlowFactors*> items;
  for (const Realisation& realisation : result.realisations)
    for (const FlowFactors& flow : realisation.flow) items.push_back(&flow);
  table.columns(
      items, {"realisation", "pressure"},
      [&](const NumberOf<FlowFactors>& number, std::string_view) { return result.flow(number); },
      {"pressure"});
}

/// Writes the loading cycles of adhesive contacts.
void write_adhesion(Table table, const StudyResult& result) {
  table.realisations(result);
  table.group().coordinate("mean_gap", result.configuration.adhesion->cycle, "m",
                           std::string(quantity_of<ForceSample>("mean_gap").long_name));
  std::vector<const AdhesiveCycleNumbers*> cycles;
  std::vector<const AdhesionSample*> samples;
  for (const Realisation& realisation : result.realisations) {
    cycles.push_back(&realisation.adhesion);
    for (const AdhesionSample& sample : realisation.adhesion.samples) samples.push_back(&sample);
  }
  table.columns(samples, {"realisation", "mean_gap"},
                [&](const NumberOf<AdhesionSample>& number, std::string_view) {
                  return result.adhesion(number);
                },
                {"mean_gap"});
  table.columns(cycles, {"realisation"});
  for_each_number<AdhesiveCycleNumbers>([&](const auto& number, const Quantity& quantity) {
    const EnsembleMean mean = result.adhesion_cycle(number);
    for (const auto& [end, value] :
         {std::pair("mean", mean.mean), {"low", mean.low}, {"high", mean.high}})
      table.group().attribute(fmt::format("ensemble_{}_{}", quantity.name, end), value);
  });
}

/// Writes the results of every model divided by those of boundary elements on the same surfaces.
void write_comparison(Table table, const StudyResult& result) {
  table.models(result);
  table.pressures(result);
  std::map<std::string, Means> ratios;
  for (const StudyModel& model : result.models())
    for (auto& [name, means] : result.comparison(model.id))
      ratios[name].insert(ratios[name].end(), means.begin(), means.end());
  for (const auto& [name, means] : ratios) {
    const std::string meaning = name + " over that of boundary elements";
    table.put(name, {name, Dimension::dimensionless, meaning}, means, {"model", "pressure"});
  }
}

void write_convergence(Table table, const StudyResult& result) {
  std::vector<double> counts;
  for (const std::size_t count : result.convergence_counts()) counts.push_back(double(count));
  table.group().coordinate("surfaces", counts, "1", "number of surfaces in the mean");
  const Quantity ratio = quantity_of<ModelResult>("decay_length_over_rms_height");
  table.put(std::string(ratio.name), ratio, result.convergence(), {"surfaces"});
}

void write_picture(ResultGroup group, const SurfacePicture& picture) {
  QuantityGroup maps(group);
  maps.coordinate("x", positions(picture.nx, picture.step_x));
  maps.coordinate("y", positions(picture.ny, picture.step_y));
  if (!picture.gap.empty()) group.attribute("mapped_load", std::int64_t(picture.mapped_load));
  std::string axis;  // coordinate of the lists that come after it in the description
  for_each_column<SurfacePicture>([&](const auto& column, const Quantity& quantity) {
    const auto& value = column(picture);
    using Value = std::remove_cvref_t<decltype(value)>;
    const std::string name(quantity.name), unit(si_unit(quantity.dimension)),
        meaning(quantity.long_name);
    if constexpr (std::is_same_v<Value, std::vector<double>>) {
      if (name == "wavenumber" || name == "height")
        group.coordinate(axis = name, value, unit, meaning);
      else
        group.dataset(name, value, {axis}, unit, meaning);
    } else if constexpr (std::is_integral_v<Value>) {
      group.attribute(name, std::int64_t(value));
    } else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::string>) {
      group.attribute(name, value);
    } else if (!value.empty()) {
      group.dataset(name, value, {"x", "y"}, unit, meaning);
    }
  });
}

/// Writes the results that depend on the direction of the tangential motion, in a further direction.
void write_direction(ResultFile& output, const std::string& where, const StudyResult& result) {
  const auto table = [&](const char* name) { return Table(output.group(where + name)); };
  write_curves(table("curve"), result);
  if (result.configuration.adhesion) return;
  const StudySolution answer = solution_of(result);
  write_damping(table("damping"), result);
  write_solution(table("solution"), result, answer);
  write_assumptions(output.group(where + "assumptions"), result, answer);
}

/// Writes the groups of one point of the parameter grid. where: path in front of their names ("" or
/// "points/3/").
void write_study_groups(ResultFile& output, const std::string& where, const StudyResult& result) {
  const auto table = [&](const char* name) { return Table(output.group(where + name)); };
  write_surfaces(table("surface"), result);
  write_curves(table("curve"), result);
  write_local_decay_lengths(table("local"), result);
  write_fits(table("fit"), result);
  if (!result.configuration.adhesion) {
    const StudySolution answer = solution_of(result);
    write_damping(table("damping"), result);
    write_solution(table("solution"), result, answer);
    write_assumptions(output.group(where + "assumptions"), result, answer);
  } else if (!result.configuration.adhesion->cycle.empty()) {
    write_adhesion(table("adhesion"), result);
  }
  write_spots(table("spots"), result);
  if (result.configuration.flow_factors) write_flow(table("flow"), result);
  write_comparison(table("comparison"), result);
  if (result.realisations.size() >= 2) write_convergence(table("convergence"), result);
  const SurfacePicture& picture = result.realisations.front().picture;
  if (!picture.empty()) write_picture(output.group(where + "picture"), picture);
  // in_directions() copies all surfaces.
  if (result.realisations.front().other_directions.empty()) return;
  const std::vector<StudyResult> directions = result.in_directions();
  for (std::size_t k = 1; k < directions.size(); ++k)
    write_direction(output, fmt::format("{}directions/{}/", where, k), directions[k]);
}

/// Writes the main results of several points of the parameter grid in one group.
void write_study_overview(ResultGroup group, const std::vector<StudyResult>& results) {
  Table table(group);
  group.index("point", results.size(), "point of the parameter grid, group points/N");
  std::vector<const SelfAffineParameters*> spectra;
  std::vector<const Grid2D*> grids;
  std::vector<double> counts;
  for (const StudyResult& result : results) {
    spectra.push_back(&std::get<GeneratedSurfaces>(result.configuration.surfaces).spectrum);
    grids.push_back(&result.grid);
    counts.push_back(double(result.realisations.size()));
  }
  table.columns(spectra, {"point"});
  table.columns(grids, {"point"});
  table.put({"realisations", Dimension::dimensionless, "number of surfaces"}, counts, {"point"});
  for (const char* name : {"decay_length_over_rms_height", "area_slope"}) {
    Means means;
    for (const StudyResult& result : results)
      means.push_back(result.fitted(name, ContactModel::bem));
    table.put(std::string("ensemble_") + name, quantity_of<ModelResult>(name), means, {"point"});
  }
}

}  // namespace
}  // namespace salebra::detail

namespace salebra {
namespace {

std::string key_text(const std::vector<StudyConfiguration>& points) {
  return fmt::format("{:016x}", detail::study_key(points));
}

}  // namespace

bool is_result_of(const std::filesystem::path& file, const StudyConfiguration& study) {
  if (!std::filesystem::is_regular_file(file)) return false;
  try {
    const ResultReader reader(file);
    const std::string key = key_text(parameter_combinations(study));
    for (const char* group : {"surface", "ensemble"})
      if (reader.has(group) && reader.text_attribute(group, "study") == key) return true;
  } catch (const InvalidInput&) {
    // The file is no result file.
  }
  return false;
}

void write_ensembles(const std::filesystem::path& file, const std::vector<StudyResult>& results,
                     Provenance provenance, const WriteOptions& options) {
  require_that(!results.empty(), "study", "no surface was finished, so there is nothing to write");
  provenance.configuration = results.front().configuration.text;
  if (!results.front().realisations.empty())
    provenance.seed = results.front().realisations.front().seed;
  ResultFile output(file, provenance, options);
  std::vector<StudyConfiguration> points;
  for (const StudyResult& result : results) points.push_back(result.configuration);
  if (results.size() == 1) {
    detail::write_study_groups(output, "", results.front());
    output.group("surface").attribute("study", key_text(points));
  } else {
    ResultGroup overview = output.group("ensemble");
    detail::write_study_overview(overview, results);
    overview.attribute("study", key_text(points));
    for (std::size_t i = 0; i < results.size(); ++i)
      detail::write_study_groups(output, "points/" + std::to_string(i) + "/", results[i]);
  }
  output.commit();
}

void write_study(const std::filesystem::path& file, const StudyResult& result,
                 Provenance provenance, const WriteOptions& options) {
  write_ensembles(file, {result}, std::move(provenance), options);
}

}  // namespace salebra
