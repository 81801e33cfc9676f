// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/io/result_file.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_file.hpp>

#include "io/scratch.hpp"
#include "small_study.hpp"
#include "study/estimate.hpp"

using namespace salebra;

namespace {

/// Two surfaces through every model; one contact of one model is marked as not converged.
StudyResult compared_study() {
  StudyConfiguration configuration = small_study();
  configuration.stick = false;
  configuration.models = configuration.compared_models;
  std::get<GeneratedSurfaces>(configuration.surfaces).seeds = {4, 5};
  StudyResult result = run_study(configuration);
  result.realisations[1].of(ContactModel::gw_moments).curve.samples[3].converged = false;
  return result;
}

/// Compares bit by bit; two unknown values are the same.
bool same(const std::vector<double>& found, const std::vector<double>& expected) {
  return std::ranges::equal(found, expected, [](double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
  });
}

/// Compares the file with the study: name of a dataset, its axes, its values.
class FileCheck {
 public:
  FileCheck(const ResultReader& reader, const StudyResult& result)
      : reader_(reader), result_(result) {}

  void values(const std::string& dataset, const std::vector<std::string>& axes,
              const std::vector<double>& expected) const {
    INFO(dataset);
    REQUIRE(reader_.has(dataset));
    CHECK(reader_.coordinates(dataset) == axes);
    CHECK(same(reader_.numbers(dataset), expected));
    CHECK(std::ranges::any_of(expected, [](double value) { return !std::isnan(value); }));
  }

  void of_surfaces(const std::string& name,
                   const std::function<double(const Realisation&)>& value) const {
    std::vector<double> expected;
    for (const Realisation& r : result_.realisations) expected.push_back(value(r));
    values(name, {"realisation"}, expected);
  }

  void of_models(const std::string& name,
                 const std::function<double(const ModelResult&)>& value) const {
    std::vector<double> expected;
    for (const StudyModel& model : result_.models())
      for (const Realisation& r : result_.realisations) expected.push_back(value(r.of(model.id)));
    values(name, {"model", "realisation"}, expected);
  }

  using AtLoad = std::function<double(const ModelResult&, std::size_t)>;
  void of_loads(const std::string& name, const AtLoad& value) const {
    std::vector<double> expected;
    for (const StudyModel& model : result_.models())
      for (const Realisation& r : result_.realisations)
        for (std::size_t k = 0; k < result_.pressures.size(); ++k)
          expected.push_back(value(r.of(model.id), k));
    values(name, {"model", "realisation", "pressure"}, expected);
  }

  /// Checks name_mean, name_low and name_high along the axes, in the order of estimates.
  void interval(const std::string& name, const std::vector<std::string>& axes,
                const std::vector<EnsembleMean>& estimates) const {
    std::vector<double> mean, low, high;
    for (const EnsembleMean& estimate : estimates) {
      mean.push_back(estimate.mean);
      low.push_back(estimate.low);
      high.push_back(estimate.high);
    }
    values(name + "_mean", axes, mean);
    values(name + "_low", axes, low);
    values(name + "_high", axes, high);
  }

  using OfModel = std::function<std::vector<EnsembleMean>(ContactModel)>;
  void interval_of_loads(const std::string& name, const OfModel& estimate) const {
    std::vector<EnsembleMean> all;
    for (const StudyModel& model : result_.models())
      for (const EnsembleMean& one : estimate(model.id)) all.push_back(one);
    interval(name, {"model", "pressure"}, all);
  }

 private:
  const ResultReader& reader_;
  const StudyResult& result_;
};

}  // namespace

TEST_CASE("A study's file holds the curves, fits and surfaces that the study found",
          "[study file]") {
  const StudyResult result = compared_study();
  const Scratch scratch;
  write_study(scratch / "result.h5", result, {});
  const ResultReader reader(scratch / "result.h5");
  const FileCheck file(reader, result);

  file.of_surfaces("surface/seed", [](const auto& r) { return double(r.seed); });
  file.of_surfaces("surface/rms_height", [](const auto& r) { return r.heights.rms_height; });
  file.of_surfaces("surface/skewness", [](const auto& r) { return r.heights.skewness; });
  file.of_surfaces("surface/kurtosis", [](const auto& r) { return r.heights.kurtosis; });
  file.of_surfaces("surface/rms_slope", [](const auto& r) { return r.moments.rms_slope(); });
  file.of_surfaces("surface/moment0", [](const auto& r) { return r.moments.moment0; });
  file.of_surfaces("surface/moment2", [](const auto& r) { return r.moments.moment2(); });
  file.of_surfaces("surface/moment4", [](const auto& r) { return r.moments.moment4(); });
  file.of_surfaces("surface/nayak", [](const auto& r) { return r.moments.nayak(); });
  file.of_surfaces("surface/summit_density",
                   [](const auto& r) { return r.summits.summit_density; });
  file.of_surfaces("surface/mean_height", [](const auto& r) { return r.summits.mean_height; });
  file.of_surfaces("surface/summit_rms", [](const auto& r) { return r.summits.rms_height; });
  file.of_surfaces("surface/mean_radius", [](const auto& r) { return r.summits.mean_radius; });
  CHECK(reader.number_attribute("surface", "size_x") == 4e-6);
  CHECK(reader.number_attribute("surface", "ny") == 64);

  const std::pair<const char*, double ForceSample::*> curve[] = {
      {"mean_gap", &ForceSample::mean_gap},
      {"indentation", &ForceSample::indentation},
      {"separation", &ForceSample::separation},
      {"force", &ForceSample::force},
      {"contact_area_fraction", &ForceSample::contact_area_fraction},
      {"normal_stiffness", &ForceSample::normal_stiffness},
      {"tangential_stiffness", &ForceSample::tangential_stiffness}};
  for (const auto& [name, quantity] : curve) {
    const auto of = quantity;
    file.of_loads(std::string("curve/") + name,
                  [=](const auto& model, std::size_t k) { return model.curve.samples[k].*of; });
    file.interval_of_loads(std::string("curve/ensemble_") + name,
                           [&](auto model) { return result.curve(of, model); });
  }
  file.of_loads("curve/converged", [](const auto& model, std::size_t k) {
    return double(model.curve.samples[k].converged);
  });

  file.of_models("fit/decay_length", [](const auto& m) { return m.fit.decay_length; });
  file.of_models("fit/decay_length_low", [](const auto& m) { return m.fit.decay_length_low; });
  file.of_models("fit/decay_length_high", [](const auto& m) { return m.fit.decay_length_high; });
  file.of_models("fit/decay_length_over_rms_height",
                 [](const auto& m) { return m.fit.decay_length_over_rms_height; });
  file.of_models("fit/reference_pressure", [](const auto& m) { return m.fit.reference_pressure; });
  file.of_models("fit/r_squared", [](const auto& m) { return m.fit.r_squared; });
  file.of_models("fit/pressure_min", [](const auto& m) { return m.fit.window.pressure_min; });
  file.of_models("fit/pressure_max", [](const auto& m) { return m.fit.window.pressure_max; });
  file.of_models("fit/significance", [](const auto& m) { return m.test.significance; });
  file.of_models("fit/decay_length_at_min_gap",
                 [](const auto& m) { return m.test.decay_length_at_min_gap; });
  file.of_models("fit/decay_length_at_max_gap",
                 [](const auto& m) { return m.test.decay_length_at_max_gap; });
  file.of_models("fit/decay_length_min",
                 [](const auto& m) { return m.sensitivity.decay_length_min; });
  file.of_models("fit/decay_length_max",
                 [](const auto& m) { return m.sensitivity.decay_length_max; });
  file.of_models("fit/stiffness_coefficient",
                 [](const auto& m) { return m.stiffness_coefficient; });
  file.of_models("fit/area_slope", [](const auto& m) { return m.area_slope; });
  std::vector<EnsembleMean> lengths, ratios, slopes;
  for (const StudyModel& model : result.models()) {
    lengths.push_back(result.decay_length(model.id));
    ratios.push_back(result.decay_length_over_rms_height(model.id));
    slopes.push_back(result.fitted("area_slope", model.id));
  }
  file.interval("fit/ensemble_decay_length", {"model"}, lengths);
  file.interval("fit/ensemble_decay_length_over_rms_height", {"model"}, ratios);
  file.interval("fit/ensemble_area_slope", {"model"}, slopes);
  std::vector<double> off, fair;
  for (const StudyModel& model : result.models()) {
    const std::optional<LawDescription> law = result.law_description(model.id);
    off.push_back(law ? law->law_off_at_min_gap : ForceSample::unknown);
    fair.push_back(law ? law->fair : ForceSample::unknown);
  }
  REQUIRE(std::ranges::any_of(fair, [](double known) { return known == 0 || known == 1; }));
  file.values("fit/law_off_at_min_gap", {"model"}, off);
  file.values("fit/fair", {"model"}, fair);

  std::vector<double> gaps, local_lengths;
  for (const StudyModel& model : result.models())
    for (const Realisation& r : result.realisations) {
      LocalDecayLength local = r.of(model.id).local;
      local.mean_gap.resize(11, ForceSample::unknown);
      local.decay_length.resize(11, ForceSample::unknown);
      gaps.insert(gaps.end(), local.mean_gap.begin(), local.mean_gap.end());
      local_lengths.insert(local_lengths.end(), local.decay_length.begin(),
                           local.decay_length.end());
    }
  file.values("local/mean_gap", {"model", "realisation", "midpoint"}, gaps);
  file.values("local/local_decay_length", {"model", "realisation", "midpoint"}, local_lengths);

  // Two surfaces give one mean, that of both.
  CHECK(reader.numbers("convergence/surfaces") == std::vector<double>{2});
  file.interval("convergence/decay_length_over_rms_height", {"surfaces"},
                {result.decay_length_over_rms_height()});
}

TEST_CASE("A study's file holds the damping, the spots and the comparison that the study found",
          "[study file]") {
  const StudyResult result = compared_study();
  const Scratch scratch;
  write_study(scratch / "result.h5", result, {});
  const ResultReader reader(scratch / "result.h5");
  const FileCheck file(reader, result);

  const std::pair<const char*, double DampingPoint::*> damping[] = {
      {"work_per_cycle_closed_form", &DampingPoint::work_per_cycle_closed_form},
      {"small_amplitude_work", &DampingPoint::small_amplitude_work},
      {"work_per_cycle", &DampingPoint::work_per_cycle},
      {"damping_constant_closed_form", &DampingPoint::damping_constant_closed_form},
      {"small_amplitude_damping_constant", &DampingPoint::small_amplitude_damping_constant},
      {"damping_constant", &DampingPoint::damping_constant}};
  for (const auto& [name, quantity] : damping) {
    const auto of = quantity;
    file.of_loads(std::string("damping/") + name,
                  [=](const auto& model, std::size_t k) { return model.damping[k].*of; });
    file.interval_of_loads(std::string("damping/ensemble_") + name, [&, name = name](auto model) {
      if (of != &DampingPoint::damping_constant && of != &DampingPoint::work_per_cycle)
        return result.damping(of, model);
      const auto stated = result.stated(name, model);
      return std::vector<EnsembleMean>(stated.begin(), stated.end());
    });
  }
  file.interval_of_loads("damping/ensemble_deviation",
                         [&](auto model) { return result.deviation(model); });
  std::vector<double> forces;
  for (const double pressure : result.pressures) forces.push_back(pressure * result.grid.area());
  file.values("damping/force", {"pressure"}, forces);
  const auto number = [&](const char* name) { return reader.number_attribute("damping", name); };
  CHECK(reader.text_attribute("damping", "mode") == "drag");
  CHECK(number("normal_amplitude") == 1e-10);
  CHECK(number("drag_velocity") == 1e-3);
  CHECK(*number("angular_frequency") == Approx(2 * std::numbers::pi * 20e3).epsilon(1e-14));
  CHECK(number("contact_modulus") == 1e10);
  // G*/E* = 2(1 − ν)/(2 − ν).
  CHECK(*number("modulus_ratio") == Approx(1.4 / 1.7).epsilon(1e-14));

  const std::pair<const char*, double SpotStatistics::*> spots[] = {
      {"spot_count", &SpotStatistics::spot_count},
      {"corrected_area_fraction", &SpotStatistics::corrected_area_fraction},
      {"max_spot_area", &SpotStatistics::max_spot_area},
      {"mean_spot_area", &SpotStatistics::mean_spot_area}};
  for (const auto& [name, quantity] : spots) {
    const auto of = quantity;
    std::vector<double> values;
    std::vector<EnsembleMean> means;
    for (const Realisation& r : result.realisations)
      for (const SpotStatistics& load : r.spots) values.push_back(load.*of);
    // Three surfaces have Student's interval, of numbers that cannot be negative.
    for (std::size_t k = 0; k < result.pressures.size(); ++k) {
      std::vector<double> of_load;
      for (const Realisation& r : result.realisations) of_load.push_back(r.spots[k].*of);
      means.push_back(student_mean(of_load));
    }
    file.values(std::string("spots/") + name, {"realisation", "pressure"}, values);
    file.interval(std::string("spots/ensemble_") + name, {"pressure"}, means);
  }
  std::vector<double> sizes;
  for (const Realisation& r : result.realisations)
    for (const SpotStatistics& load : r.spots)
      sizes.insert(sizes.end(), load.spots_by_size.begin(), load.spots_by_size.end());
  file.values("spots/spots_by_size", {"realisation", "pressure", "min_cells"}, sizes);
  // 64² cells = 2^12: patches of at least 1, 2, 4 … 4096 cells.
  CHECK(reader.numbers("spots/min_cells").size() == 13);
  CHECK(reader.numbers("spots/min_cells").back() == 4096);
  file.of_surfaces("surface/corrected_area_slope",
                   [](const auto& r) { return r.corrected_area_slope; });

  for (const auto& [name, quantity] :
       {std::pair{"mean_gap", &ForceSample::mean_gap},
        {"contact_area_fraction", &ForceSample::contact_area_fraction},
        {"normal_stiffness", &ForceSample::normal_stiffness}})
    file.interval_of_loads(std::string("comparison/") + name,
                           [&, of = quantity](auto model) { return result.over_bem(of, model); });
  for (const auto& [name, quantity] :
       {std::pair{"work_per_cycle_closed_form", &DampingPoint::work_per_cycle_closed_form},
        {"small_amplitude_work", &DampingPoint::small_amplitude_work},
        {"work_per_cycle", &DampingPoint::work_per_cycle}})
    file.interval_of_loads(std::string("comparison/") + name, [&, of = quantity](auto model) {
      return result.damping_over_bem(of, model);
    });
}

TEST_CASE("The overview of a parameter grid holds each point's parameters and means",
          "[study file]") {
  StudyConfiguration configuration = small_study();
  configuration.stick = false;
  auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  surfaces.seeds = {4, 5};
  surfaces.grid.ny = 32;  // a strip, in which x and y differ
  surfaces.grid.ly = 2e-6;
  configuration.ensemble.hurst = {0.5, 0.8};
  configuration.ensemble.size_x = {2e-6, 4e-6};
  const std::vector<StudyResult> results = run_ensembles(configuration);
  REQUIRE(results.size() == 4);
  const Scratch scratch;
  write_ensembles(scratch / "grid.h5", results, {});
  const ResultReader reader(scratch / "grid.h5");
  const auto numbers = [&](const std::string& name) { return reader.numbers("ensemble/" + name); };
  CHECK(numbers("hurst") == std::vector<double>{0.5, 0.5, 0.8, 0.8});
  CHECK(numbers("size_x") == std::vector<double>{2e-6, 4e-6, 2e-6, 4e-6});
  CHECK(numbers("nx") == std::vector<double>{32, 64, 32, 64});
  CHECK(numbers("rolloff") == std::vector<double>(4, 1e-6));
  CHECK(numbers("short_cutoff") == std::vector<double>(4, 0.5e-6));
  CHECK(numbers("realisations") == std::vector<double>(4, 2));
  const FileCheck file(reader, results[2]);
  std::vector<EnsembleMean> ratios, slopes;
  for (const StudyResult& result : results) {
    ratios.push_back(result.decay_length_over_rms_height());
    slopes.push_back(result.fitted("area_slope"));
  }
  file.interval("ensemble/ensemble_decay_length_over_rms_height", {"point"}, ratios);
  file.interval("ensemble/ensemble_area_slope", {"point"}, slopes);
  file.of_surfaces("points/2/surface/rms_height",
                   [](const auto& r) { return r.heights.rms_height; });
  CHECK(reader.number_attribute("points/0/surface", "size_y") == 1e-6);
  CHECK(reader.number_attribute("points/1/surface", "size_x") == 4e-6);
  CHECK(reader.number_attribute("points/1/surface", "size_y") == 2e-6);
}
