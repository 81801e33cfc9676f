// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 groups of a study's result: surfaces, curves, fits, damping, spots, comparison, convergence.
#include "study_groups.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <salebra/base/quantity.hpp>

namespace salebra::detail {
namespace {

using Names = std::vector<std::string>;

/// Adds a dataset whose unit follows from its name.
void put(ResultGroup& group, const std::string& name, const std::vector<double>& values,
         const Names& coordinates, const std::string& prefix = "", const std::string& suffix = "") {
  const Quantity quantity = find_quantity(name);
  group.dataset(prefix + name + suffix, values, coordinates,
                std::string(si_unit(quantity.dimension)),
                std::string(quantity.long_name) + (suffix.empty() ? "" : ", " + suffix.substr(1)));
}

void put(ResultGroup& group, const std::string& name, const std::vector<EnsembleMean>& estimates,
         const Names& coordinates, const std::string& prefix = "") {
  for (const auto& [suffix, member] : {std::pair{"_mean", &EnsembleMean::mean},
                                       {"_low", &EnsembleMean::low},
                                       {"_high", &EnsembleMean::high}}) {
    std::vector<double> values;
    for (const EnsembleMean& estimate : estimates) values.push_back(estimate.*member);
    put(group, name, values, coordinates, prefix, suffix);
  }
}

void put_realisations(ResultGroup& group, const StudyResult& result) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < result.realisations.size(); ++i) numbers.push_back(double(i));
  group.coordinate("realisation", numbers, "1", "number of the surface");
}

void put_pressures(ResultGroup& group, const StudyResult& result) {
  group.coordinate("pressure", result.pressures, "Pa", "nominal pressure");
}

void put_models(ResultGroup& group, const StudyResult& result) {
  Names names;
  for (const StudyModel& model : result.models()) names.emplace_back(name_of(model.model));
  group.labels("model", names, "contact model");
}

void write_surfaces(ResultGroup group, const StudyResult& result) {
  put_realisations(group, result);
  const auto column = [&](const std::string& name,
                          const std::function<double(const Realisation&)>& value) {
    std::vector<double> values;
    std::ranges::transform(result.realisations, std::back_inserter(values), value);
    put(group, name, values, {"realisation"});
  };
  std::vector<std::int64_t> seeds;
  for (const Realisation& realisation : result.realisations)
    seeds.push_back(std::int64_t(realisation.seed));
  group.dataset("seed", seeds, {"realisation"}, "1",
                "seed of the generator; 0 for a measured surface");
  column("rms_height", [](const Realisation& r) { return r.heights.rms_height; });
  column("skewness", [](const Realisation& r) { return r.heights.skewness; });
  column("kurtosis", [](const Realisation& r) { return r.heights.kurtosis; });
  column("rms_slope", [](const Realisation& r) { return r.moments.rms_slope(); });
  column("moment0", [](const Realisation& r) { return r.moments.moment0; });
  column("moment2", [](const Realisation& r) { return r.moments.moment2(); });
  column("moment4", [](const Realisation& r) { return r.moments.moment4(); });
  column("nayak", [](const Realisation& r) { return r.moments.nayak(); });
  column("density", [](const Realisation& r) { return r.summits.density; });
  column("mean_height", [](const Realisation& r) { return r.summits.mean_height; });
  column("summit_rms", [](const Realisation& r) { return r.summits.rms_height; });
  column("mean_radius", [](const Realisation& r) { return r.summits.mean_radius; });
  group.attribute("nx", std::int64_t(result.grid.nx));
  group.attribute("ny", std::int64_t(result.grid.ny));
  group.attribute("size_x", result.grid.lx);
  group.attribute("size_y", result.grid.ly);
}

void write_curves(ResultGroup group, const StudyResult& result) {
  put_models(group, result);
  put_realisations(group, result);
  put_pressures(group, result);
  const auto column = [&](const std::string& name, double ForceSample::*quantity) {
    std::vector<double> values;
    for (const StudyModel& model : result.models()) {
      for (const Realisation& realisation : result.realisations) {
        const auto& samples = (realisation.*model.result).curve.samples;
        std::ranges::transform(samples, std::back_inserter(values), quantity);
      }
    }
    put(group, name, values, {"model", "realisation", "pressure"});
    std::vector<EnsembleMean> means;
    for (const StudyModel& model : result.models()) {
      const auto row = result.curve(model.result, quantity);
      means.insert(means.end(), row.begin(), row.end());
    }
    put(group, name, means, {"model", "pressure"}, "ensemble_");
  };
  column("mean_gap", &ForceSample::mean_gap);
  column("indentation", &ForceSample::indentation);
  column("separation", &ForceSample::separation);
  column("force", &ForceSample::force);
  column("contact_area_fraction", &ForceSample::contact_area_fraction);
  column("normal_stiffness", &ForceSample::normal_stiffness);
  column("tangential_stiffness", &ForceSample::tangential_stiffness);
  std::vector<bool> converged;
  for (const StudyModel& model : result.models()) {
    for (const Realisation& realisation : result.realisations) {
      for (const ForceSample& sample : (realisation.*model.result).curve.samples)
        converged.push_back(sample.converged);
    }
  }
  group.flags("converged", converged, {"model", "realisation", "pressure"},
              "whether the contact converged");
}

void write_local_decay_lengths(ResultGroup group, const StudyResult& result) {
  put_models(group, result);
  put_realisations(group, result);
  // Samples that did not converge shorten a list; the rest of its row stays unknown.
  const std::size_t midpoints = result.pressures.size() - 1;
  group.index("midpoint", midpoints, "between consecutive pressures");
  const auto column = [&](const std::string& name,
                          std::vector<double> LocalDecayLength::*quantity) {
    std::vector<double> values;
    for (const StudyModel& model : result.models()) {
      for (const Realisation& realisation : result.realisations) {
        std::vector<double> row = (realisation.*model.result).local.*quantity;
        row.resize(midpoints, ForceSample::unknown);
        values.insert(values.end(), row.begin(), row.end());
      }
    }
    put(group, name, values, {"model", "realisation", "midpoint"});
  };
  column("mean_gap", &LocalDecayLength::mean_gap);
  column("decay_length", &LocalDecayLength::decay_length);
}

void write_fits(ResultGroup group, const StudyResult& result) {
  put_models(group, result);
  put_realisations(group, result);
  const auto column = [&](const std::string& name,
                          const std::function<double(const ModelResult&)>& value) {
    std::vector<double> values;
    for (const StudyModel& model : result.models()) {
      for (const Realisation& realisation : result.realisations)
        values.push_back(value(realisation.*model.result));
    }
    put(group, name, values, {"model", "realisation"});
  };
  column("decay_length", [](const ModelResult& model) { return model.fit.decay_length; });
  column("decay_length_low", [](const ModelResult& model) { return model.fit.decay_length_low; });
  column("decay_length_high", [](const ModelResult& model) { return model.fit.decay_length_high; });
  column("decay_length_over_rms_height",
         [](const ModelResult& model) { return model.fit.decay_length_over_rms_height; });
  column("reference_pressure",
         [](const ModelResult& model) { return model.fit.reference_pressure; });
  column("r_squared", [](const ModelResult& model) { return model.fit.r_squared; });
  column("pressure_min", [](const ModelResult& model) { return model.fit.window.pressure_min; });
  column("significance", [](const ModelResult& model) { return model.test.significance; });
  column("decay_length_min",
         [](const ModelResult& model) { return model.sensitivity.decay_length_min; });
  column("decay_length_max",
         [](const ModelResult& model) { return model.sensitivity.decay_length_max; });
  column("pressure_max", [](const ModelResult& model) { return model.fit.window.pressure_max; });
  const auto bend = [&](const std::string& suffix, double ExponentialTest::*quantity) {
    std::vector<double> values;
    for (const StudyModel& model : result.models()) {
      for (const Realisation& realisation : result.realisations) {
        values.push_back((realisation.*model.result).test.*quantity);
      }
    }
    put(group, "decay_length", values, {"model", "realisation"}, "", suffix);
  };
  column("area_slope", [](const ModelResult& model) { return model.area_slope; });
  bend("_closest", &ExponentialTest::decay_length_closest);
  bend("_farthest", &ExponentialTest::decay_length_farthest);
  std::vector<EnsembleMean> lengths, ratios;
  for (const StudyModel& model : result.models()) {
    lengths.push_back(result.decay_length(model.result));
    ratios.push_back(result.decay_length_over_rms_height(model.result));
  }
  std::vector<EnsembleMean> slopes;
  for (const StudyModel& model : result.models()) slopes.push_back(result.area_slope(model.result));
  put(group, "area_slope", slopes, {"model"}, "ensemble_");
  put(group, "decay_length", lengths, {"model"}, "ensemble_");
  put(group, "decay_length_over_rms_height", ratios, {"model"}, "ensemble_");
  group.attribute("interval_method", result.interval_method());
}

void write_motion(ResultGroup& group, const StudyResult& result) {
  const auto attribute = [&](const std::string& name, double value) {
    group.attribute(name, value);
  };
  std::visit(
      [&](const auto& motion) {
        attribute("normal_amplitude", motion.normal_amplitude);
        attribute("angular_frequency", motion.angular_frequency);
        if constexpr (std::is_same_v<std::decay_t<decltype(motion)>, Drag>) {
          group.attribute("mode", "drag");
          attribute("drag_velocity", motion.drag_velocity);
        } else {
          group.attribute("mode", "equal-frequency");
          attribute("tangential_amplitude", motion.tangential_amplitude);
          attribute("phase", motion.phase);
        }
      },
      result.configuration.motion);
  const bool by_force = result.configuration.damping.hold == Hold::force;
  group.attribute("hold", by_force ? "force" : "indentation");
  attribute("modulus_ratio", result.configuration.material.modulus_ratio());
  attribute("contact_modulus", result.configuration.material.contact_modulus);
}

void write_damping(ResultGroup group, const StudyResult& result) {
  put_models(group, result);
  put_realisations(group, result);
  put_pressures(group, result);
  std::vector<double> forces;
  for (const double pressure : result.pressures) forces.push_back(pressure * result.grid.area());
  put(group, "force", forces, {"pressure"});
  const auto column = [&](const std::string& prefix, const std::string& name,
                          double DampingPoint::*quantity) {
    std::vector<double> values;
    std::vector<EnsembleMean> means;
    for (const StudyModel& model : result.models()) {
      for (const Realisation& realisation : result.realisations) {
        const auto& points = (realisation.*model.result).damping;
        std::ranges::transform(points, std::back_inserter(values), quantity);
      }
      const auto row = result.damping(quantity, model.result);
      means.insert(means.end(), row.begin(), row.end());
    }
    put(group, name, values, {"model", "realisation", "pressure"}, prefix);
    put(group, name, means, {"model", "pressure"}, prefix + "ensemble_");
  };
  column("law_", "work_per_cycle", &DampingPoint::law_work);
  column("small_", "work_per_cycle", &DampingPoint::small_work);
  column("curve_", "work_per_cycle", &DampingPoint::curve_work);
  column("law_", "damping_constant", &DampingPoint::law_damping_constant);
  column("small_", "damping_constant", &DampingPoint::small_damping_constant);
  column("curve_", "damping_constant", &DampingPoint::curve_damping_constant);
  std::vector<EnsembleMean> deviations;
  for (const StudyModel& model : result.models()) {
    const auto row = result.damping_deviation(model.result);
    deviations.insert(deviations.end(), row.begin(), row.end());
  }
  put(group, "deviation", deviations, {"model", "pressure"}, "ensemble_");
  group.attribute("interval_method", result.interval_method());
  group.attribute("law",
                  "Eq. (16) (drag) or Eq. (12) with F'' = F/l^2, l fitted to the model's curve");
  group.attribute("small", "Eq. (15) (drag) or Eq. (12) with F'' of the model's curve");
  group.attribute("curve", "W = 1/2 oint s^2 dK_t on the model's curve itself");
  group.attribute("tangential_stiffness", stick_solves(result.configuration)
                                              ? "boundary elements: stick solves on the contacts"
                                              : "(G*/E*)K");
  write_motion(group, result);
}

void write_spots(ResultGroup group, const StudyResult& result) {
  put_realisations(group, result);
  put_pressures(group, result);
  std::size_t bins = 0;
  for (const Realisation& realisation : result.realisations)
    for (const SpotStatistics& spots : realisation.spots) bins = std::max(bins, spots.sizes.size());
  std::vector<double> least_cells, sizes;
  for (std::size_t bin = 0; bin < bins; ++bin) least_cells.push_back(std::exp2(double(bin)));
  group.coordinate("least_cells", least_cells, "1", "cells of the smallest spot that is counted");
  const auto column = [&](const std::string& name, double SpotStatistics::*quantity) {
    std::vector<double> values;
    for (const Realisation& realisation : result.realisations)
      std::ranges::transform(realisation.spots, std::back_inserter(values), quantity);
    put(group, name, values, {"realisation", "pressure"});
    std::vector<EnsembleMean> means;
    for (std::size_t k = 0; k < result.pressures.size(); ++k)
      means.push_back(result.mean([&](const Realisation& r) { return r.spots[k].*quantity; }));
    put(group, name, means, {"pressure"}, "ensemble_");
  };
  column("spot_count", &SpotStatistics::count);
  column("corrected_area_fraction", &SpotStatistics::corrected_area_fraction);
  column("largest_spot_area", &SpotStatistics::largest_area);
  column("mean_spot_area", &SpotStatistics::mean_area);
  for (const Realisation& realisation : result.realisations)
    for (const SpotStatistics& spots : realisation.spots) {
      std::vector<double> row = spots.sizes;
      row.resize(bins, ForceSample::unknown);
      sizes.insert(sizes.end(), row.begin(), row.end());
    }
  put(group, "spots_by_size", sizes, {"realisation", "pressure", "least_cells"});
  std::vector<double> slopes;
  for (const Realisation& realisation : result.realisations)
    slopes.push_back(realisation.corrected_area_slope);
  put(group, "corrected_area_slope", slopes, {"realisation"});
}

/// Every model beside the boundary elements on the same surfaces.
void write_comparison(ResultGroup group, const StudyResult& result) {
  put_models(group, result);
  put_pressures(group, result);
  const auto ratio = [&](const std::string& name, const auto& estimate) {
    std::vector<EnsembleMean> means;
    for (const StudyModel& model : result.models()) {
      const std::vector<EnsembleMean> row = estimate(model.result);
      means.insert(means.end(), row.begin(), row.end());
    }
    for (const auto& [suffix, member] : {std::pair{"_mean", &EnsembleMean::mean},
                                         {"_low", &EnsembleMean::low},
                                         {"_high", &EnsembleMean::high}}) {
      std::vector<double> values;
      for (const EnsembleMean& mean : means) values.push_back(mean.*member);
      group.dataset(name + suffix, values, {"model", "pressure"}, "1",
                    name + " over that of boundary elements");
    }
  };
  using Model = ModelResult Realisation::*;
  for (const auto& [name, quantity] :
       {std::pair{"mean_gap", &ForceSample::mean_gap},
        {"contact_area_fraction", &ForceSample::contact_area_fraction},
        {"normal_stiffness", &ForceSample::normal_stiffness}})
    ratio(name, [&, of = quantity](Model model) { return result.over_bem(model, of); });
  for (const auto& [name, quantity] : {std::pair{"law_work_per_cycle", &DampingPoint::law_work},
                                       {"small_work_per_cycle", &DampingPoint::small_work},
                                       {"curve_work_per_cycle", &DampingPoint::curve_work}})
    ratio(name, [&, of = quantity](Model model) { return result.damping_over_bem(model, of); });
}

void write_convergence(ResultGroup group, const StudyResult& result) {
  std::vector<double> counts;
  for (const std::size_t count : result.convergence_counts()) counts.push_back(double(count));
  group.coordinate("surfaces", counts, "1", "number of surfaces in the mean");
  put(group, "decay_length_over_rms_height", result.convergence(), {"surfaces"});
}

void write_picture(ResultGroup group, const SurfacePicture& picture) {
  group.coordinate("x", positions(picture.nx, picture.step_x), "m", "position");
  group.coordinate("y", positions(picture.ny, picture.step_y), "m", "position");
  group.dataset("heights", picture.heights, {"x", "y"}, "m", "height above the mean");
  group.dataset("first_load", picture.first_load, {"x", "y"}, "1",
                "number of the least pressure of the curve at which the point touches; -1: none");
  group.coordinate("wavenumber", picture.wavenumber, "rad/m", "wave number");
  group.dataset("density", picture.density, {"wavenumber"}, "m^4",
                "power spectral density C, mean over a ring of wave vectors");
  group.dataset("law_density", picture.law_density, {"wavenumber"}, "m^4",
                "C of the self-affine law");
  group.coordinate("height", picture.height, "m", "height above the mean, middle of a bin");
  group.dataset("height_density", picture.height_density, {"height"}, "1/m",
                "share of the points in a bin over its width");
  group.attribute("origin", picture.origin);
  group.attribute("stride", std::int64_t(picture.stride));
  group.attribute("law", picture.law);
  group.attribute("hurst", picture.hurst);
  group.attribute("hurst_low", picture.hurst_low);
  group.attribute("hurst_high", picture.hurst_high);
}

}  // namespace

void write_study_groups(ResultFile& output, const std::string& where, const StudyResult& result) {
  write_surfaces(output.group(where + "surface"), result);
  write_curves(output.group(where + "curve"), result);
  write_local_decay_lengths(output.group(where + "local"), result);
  write_fits(output.group(where + "fit"), result);
  write_damping(output.group(where + "damping"), result);
  write_spots(output.group(where + "spots"), result);
  write_comparison(output.group(where + "comparison"), result);
  if (result.realisations.size() >= 2)
    write_convergence(output.group(where + "convergence"), result);
  const SurfacePicture& picture = result.realisations.front().picture;
  if (!picture.empty()) write_picture(output.group(where + "picture"), picture);
  std::string warnings, flags;
  for (const std::string& warning : result.warnings) warnings += warning + "\n";
  for (const StudyFlag& found : result.flags) flags += found.name + ": " + found.text + "\n";
  output.group(where + "surface").attribute("warnings", warnings);
  output.group(where + "surface").attribute("flags", flags);
}

void write_study_overview(ResultGroup group, const std::vector<StudyResult>& results) {
  group.index("point", results.size(), "point of the parameter grid, group points/N");
  const auto column = [&](const std::string& name,
                          const std::function<double(const StudyResult&)>& value) {
    std::vector<double> values;
    std::ranges::transform(results, std::back_inserter(values), value);
    put(group, name, values, {"point"});
  };
  const auto parameters = [](const StudyResult& result) -> const SelfAffineParameters& {
    return std::get<GeneratedSurfaces>(result.configuration.surfaces).spectrum;
  };
  column("hurst", [&](const StudyResult& r) { return parameters(r).hurst; });
  column("rolloff", [&](const StudyResult& r) {
    return parameters(r).rolloff.value_or(ForceSample::unknown);
  });
  column("short_cutoff", [&](const StudyResult& r) { return parameters(r).short_cutoff; });
  column("size_x", [](const StudyResult& r) { return r.grid.lx; });
  column("nx", [](const StudyResult& r) { return double(r.grid.nx); });
  column("realisations", [](const StudyResult& r) { return double(r.realisations.size()); });
  std::vector<EnsembleMean> ratios, slopes;
  for (const StudyResult& result : results) {
    ratios.push_back(result.decay_length_over_rms_height(&Realisation::bem));
    slopes.push_back(result.area_slope(&Realisation::bem));
  }
  put(group, "decay_length_over_rms_height", ratios, {"point"}, "ensemble_");
  put(group, "area_slope", slopes, {"point"}, "ensemble_");
}

}  // namespace salebra::detail
