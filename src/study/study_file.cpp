// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <salebra/base/quantity.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/study/study_file.hpp>

namespace salebra {
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

void put_models(ResultGroup& group) {
  Names names;
  for (const StudyModel& model : study_models) names.emplace_back(model.name);
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
  put_models(group);
  put_realisations(group, result);
  put_pressures(group, result);
  const auto column = [&](const std::string& name, double ForceSample::*quantity) {
    std::vector<double> values;
    for (const StudyModel& model : study_models) {
      for (const Realisation& realisation : result.realisations) {
        const auto& samples = (realisation.*model.result).curve.samples;
        std::ranges::transform(samples, std::back_inserter(values), quantity);
      }
    }
    put(group, name, values, {"model", "realisation", "pressure"});
  };
  column("mean_gap", &ForceSample::mean_gap);
  column("indentation", &ForceSample::indentation);
  column("separation", &ForceSample::separation);
  column("force", &ForceSample::force);
  column("contact_area_fraction", &ForceSample::contact_area_fraction);
  column("normal_stiffness", &ForceSample::normal_stiffness);
  column("tangential_stiffness", &ForceSample::tangential_stiffness);
  std::vector<bool> converged;
  for (const StudyModel& model : study_models) {
    for (const Realisation& realisation : result.realisations) {
      for (const ForceSample& sample : (realisation.*model.result).curve.samples)
        converged.push_back(sample.converged);
    }
  }
  group.flags("converged", converged, {"model", "realisation", "pressure"},
              "whether the contact converged");
}

void write_local_decay_lengths(ResultGroup group, const StudyResult& result) {
  put_models(group);
  put_realisations(group, result);
  // Samples that did not converge shorten a list; the rest of its row stays unknown.
  const std::size_t midpoints = result.pressures.size() - 1;
  group.index("midpoint", midpoints, "between consecutive pressures");
  const auto column = [&](const std::string& name,
                          std::vector<double> LocalDecayLength::*quantity) {
    std::vector<double> values;
    for (const StudyModel& model : study_models) {
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
  put_models(group);
  put_realisations(group, result);
  const auto column = [&](const std::string& name,
                          const std::function<double(const ExponentialFit&)>& value) {
    std::vector<double> values;
    for (const StudyModel& model : study_models) {
      for (const Realisation& realisation : result.realisations)
        values.push_back(value((realisation.*model.result).fit));
    }
    put(group, name, values, {"model", "realisation"});
  };
  column("decay_length", [](const ExponentialFit& fit) { return fit.decay_length; });
  column("decay_length_low", [](const ExponentialFit& fit) { return fit.decay_length_low; });
  column("decay_length_high", [](const ExponentialFit& fit) { return fit.decay_length_high; });
  column("decay_length_over_rms_height",
         [](const ExponentialFit& fit) { return fit.decay_length_over_rms_height; });
  column("reference_pressure", [](const ExponentialFit& fit) { return fit.reference_pressure; });
  column("r_squared", [](const ExponentialFit& fit) { return fit.r_squared; });
  column("pressure_min", [](const ExponentialFit& fit) { return fit.window.pressure_min; });
  column("pressure_max", [](const ExponentialFit& fit) { return fit.window.pressure_max; });
  const auto bend = [&](const std::string& suffix, double ExponentialTest::*quantity) {
    std::vector<double> values;
    for (const StudyModel& model : study_models) {
      for (const Realisation& realisation : result.realisations) {
        values.push_back((realisation.*model.result).test.*quantity);
      }
    }
    put(group, "decay_length", values, {"model", "realisation"}, "", suffix);
  };
  bend("_closest", &ExponentialTest::decay_length_closest);
  bend("_farthest", &ExponentialTest::decay_length_farthest);
  std::vector<EnsembleMean> lengths, ratios;
  for (const StudyModel& model : study_models) {
    lengths.push_back(result.decay_length(model.result));
    ratios.push_back(result.decay_length_over_rms_height(model.result));
  }
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
  put_realisations(group, result);
  put_pressures(group, result);
  std::vector<double> forces;
  for (const double pressure : result.pressures) forces.push_back(pressure * result.grid.area());
  put(group, "force", forces, {"pressure"});
  const auto column = [&](const std::string& prefix, const std::string& name,
                          double DampingPoint::*quantity) {
    std::vector<double> values;
    for (const Realisation& realisation : result.realisations) {
      std::ranges::transform(realisation.damping, std::back_inserter(values), quantity);
    }
    put(group, name, values, {"realisation", "pressure"}, prefix);
    put(group, name, result.damping(quantity), {"pressure"}, prefix + "ensemble_");
  };
  column("law_", "work_per_cycle", &DampingPoint::law_work);
  column("curve_", "work_per_cycle", &DampingPoint::curve_work);
  column("law_", "damping_constant", &DampingPoint::law_damping_constant);
  column("curve_", "damping_constant", &DampingPoint::curve_damping_constant);
  put(group, "deviation", result.damping_deviation(), {"pressure"}, "ensemble_");
  group.attribute("interval_method", result.interval_method());
  group.attribute(
      "law",
      "Eq. (16) (drag) or Eq. (12) with F'' = F/l^2, l fitted to the boundary-element curve");
  group.attribute("curve", "W = 1/2 oint s^2 dK_t on the boundary-element curve itself");
  const bool stick =
      result.configuration.stick && std::isfinite(result.configuration.material.cerruti_isotropic);
  group.attribute("tangential_stiffness", stick ? "stick solves on the contacts" : "(G*/E*)K");
  write_motion(group, result);
}

}  // namespace

void write_study(const std::filesystem::path& file, const StudyResult& result,
                 Provenance provenance, const WriteOptions& options) {
  provenance.configuration = result.configuration.text;
  if (!result.realisations.empty()) provenance.seed = result.realisations.front().seed;
  ResultFile output(file, provenance, options);
  write_surfaces(output.group("surface"), result);
  write_curves(output.group("curve"), result);
  write_local_decay_lengths(output.group("local"), result);
  write_fits(output.group("fit"), result);
  write_damping(output.group("damping"), result);
  std::string warnings;
  for (const std::string& warning : result.warnings) warnings += warning + "\n";
  output.group("surface").attribute("warnings", warnings);
  output.commit();
}

}  // namespace salebra
