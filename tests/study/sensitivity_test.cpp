// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/study/design.hpp>
#include <salebra/study/sensitivity.hpp>
#include <vector>

#include "contact/half_space/half_space.hpp"
#include "study/boundary_element_numbers.hpp"

using namespace salebra;

namespace {

constexpr double side = 64e-6;

StudyConfiguration study_of(Index points, std::vector<std::uint64_t> seeds) {
  StudyConfiguration study;
  study.surfaces = GeneratedSurfaces{
      .grid = {points, points, side, side},
      .spectrum = {.hurst = 0.7, .rolloff = 10e-6, .short_cutoff = 4e-6, .rms_height = 100e-9},
      .seeds = std::move(seeds)};
  study.material = Material::of_contact_modulus(3e9, 0.3);
  study.pressures = {8e6, 16e6, 32e6, 64e6};
  study.models = {ContactModel::bem};
  study.motion = EqualFrequency{2e-9, 1e-9, std::numbers::pi / 2, 1e3};
  return study;
}

double slope(const StudySensitivity& found, std::string_view parameter, std::string_view output,
             std::size_t pressure) {
  const OutputSensitivity* one = found.find(parameter, output);
  REQUIRE(one);
  CHECK(one->at_pressures[pressure].low <= one->at_pressures[pressure].mean);
  CHECK(one->at_pressures[pressure].high >= one->at_pressures[pressure].mean);
  return one->at_pressures[pressure].mean;
}

// The pressure of a flat punch on a contact set, up to a factor, by plain conjugate gradients.
Field punch_pressure(const Grid2D& grid, const ContactSet& contact) {
  auto compliance = normal_compliance<double>(grid, 1.0, Boundary::periodic);
  const Field mask = contact.cast<double>();
  Field pressure = Field::Zero(grid.nx, grid.ny), residual = mask, direction = mask, moved = mask;
  double square = residual.square().sum();
  for (int step = 0; step < 2000 && square > 1e-24 * mask.sum(); ++step) {
    compliance.apply(direction.data(), moved.data());
    moved *= mask;
    const double length = square / (direction * moved).sum();
    pressure += length * direction;
    residual -= length * moved;
    const double next = residual.square().sum();
    direction = residual + next / square * direction;
    square = next;
  }
  return pressure;
}

}  // namespace

TEST_CASE("Scaled studies obey the laws of similarity", "[sensitivity]") {
  using enum StudyParameter;
  const StudyConfiguration study = study_of(32, {1, 2});
  const double s = 1.7;
  const auto of = [](const StudyConfiguration& configuration) { return run_study(configuration); };
  const StudyResult base = of(study),
                    high = of(scaled(scaled(scaled(study, rms_height, s), pressure, s),
                                     normal_amplitude, s)),
                    stiff = of(scaled(scaled(study, contact_modulus, s), pressure, s));
  for (std::size_t k = 0; k < 4; ++k) {
    const auto ratio = [&](const StudyResult& other, const NumberOf<ForceSample>& number) {
      return other.curve(number)[k].mean / base.curve(number)[k].mean;
    };
    // The tolerance of the contacts, 1e-8 of the energy.
    CHECK(ratio(high, &ForceSample::mean_gap) == Approx(s).epsilon(1e-8));
    CHECK(ratio(high, &ForceSample::normal_stiffness) == Approx(1).epsilon(1e-6));
    CHECK(ratio(high, &ForceSample::tangential_stiffness) == Approx(1).epsilon(1e-5));
    CHECK(ratio(high, &ForceSample::contact_area_fraction) == 1);
    CHECK(ratio(stiff, &ForceSample::mean_gap) == Approx(1).epsilon(1e-8));
    CHECK(ratio(stiff, &ForceSample::normal_stiffness) == Approx(s).epsilon(1e-6));
    CHECK(ratio(stiff, &ForceSample::tangential_stiffness) == Approx(s).epsilon(1e-5));
    const auto loss = [&](const StudyResult& other) {
      return other.damping(&DampingPoint::work_per_cycle)[k].mean /
             base.damping(&DampingPoint::work_per_cycle)[k].mean;
    };
    CHECK(loss(high) == Approx(1).epsilon(1e-4));
    CHECK(loss(stiff) == Approx(s).epsilon(1e-4));
  }
  CHECK_THROWS_WITH(scaled(study, friction_coefficient, 2), Catch::Contains("friction"));
  CHECK_THROWS_WITH(scaled(study, hurst, 2), Catch::Contains("hurst"));
}

TEST_CASE("Responses to heights, loads, amplitudes and moduli obey the laws of similarity",
          "[sensitivity]") {
  const StudySensitivity found = study_sensitivity(study_of(48, {1, 2, 3}));
  CHECK(found.surfaces == 3);
  CHECK(found.left_out.empty());
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k);
    const auto of = [&](std::string_view parameter, std::string_view output) {
      return slope(found, parameter, output, k);
    };
    // h → sh, p → sp, u_z → su_z: lengths across the surface grow, areas and stiffnesses stay; the
    // loss without slip is that of K_t. The rest is the third derivative over a step of 1e-3.
    for (const auto& [output, power] : {std::pair("mean_gap", 1.0),
                                        {"contact_area_fraction", 0.0},
                                        {"normal_stiffness", 0.0},
                                        {"tangential_stiffness", 0.0},
                                        {"work_per_cycle", 0.0},
                                        {"damping_constant", 0.0}}) {
      CAPTURE(output);
      CHECK(of("rms_height", output) + of("pressure", output) + of("normal_amplitude", output) ==
            Approx(power).margin(1e-3));
      // E* → sE*, p → sp: stresses and stiffnesses grow alike.
      CHECK(of("contact_modulus", output) + of("pressure", output) ==
            Approx(output[0] == 'm' || output[0] == 'c' ? 0.0 : 1.0).margin(1e-3));
      // All bands of waves together are the heights.
      double sum = 0;
      for (const ParameterSensitivity& one : found.parameters)
        if (one.parameter == "waves")
          for (const OutputSensitivity& band : one.outputs)
            if (band.output == output) sum += band.at_pressures[k].mean;
      // Bands respond by the punch of each contact, all heights by similarity of the smooth law, and
      // single cells are noise of the former. The area is that of contacts.
      CHECK(sum == Approx(of("rms_height", output))
                       .margin(output[0] == 'm'                       ? 0.03
                               : output[0] == 'w' || output[0] == 'd' ? 0.3
                               : output[0] == 'c'                     ? 0.2
                                                                      : 0.05));
    }
    // Without slip forces are linear in the tangential motion. The gap does not know it.
    CHECK(of("tangential_amplitude", "work_per_cycle") == Approx(2).margin(1e-9));
    CHECK(of("tangential_amplitude", "damping_constant") == Approx(0).margin(1e-9));
    CHECK(of("normal_amplitude", "mean_gap") == 0);
    CHECK(of("rms_height", "mean_gap") > 0);
  }
  CHECK_THAT(found.sentence("damping_constant", 1), Catch::Contains("the waves"));
}

namespace {

// Compares responses by laws with differences between scaled studies of the same surfaces.
void compare_with_scaled_studies(Index points, std::size_t surfaces, double friction) {
  std::vector<std::uint64_t> seeds(surfaces);
  std::iota(seeds.begin(), seeds.end(), 100);
  StudyConfiguration study = study_of(points, seeds);
  study.known.friction_coefficient = friction;
  const StudySensitivity found = study_sensitivity(study, {.waves = false});
  const detail::BoundaryElementNumbers numbers(study, {});
  int beyond = 0, count = 0;
  for (const ParameterSensitivity& one : found.parameters) {
    const auto parameter = parse_enum<StudyParameter>(one.parameter).value();
    const auto scaled_by = [&](double step) {
      return detail::StudyVariant{scaled(numbers.base(), parameter, std::exp(step))};
    };
    const auto sides = numbers.of({scaled_by(found.step), scaled_by(-found.step)});
    REQUIRE(one.outputs.size() == detail::BoundaryElementNumbers::outputs.size());
    for (std::size_t output = 0; output < one.outputs.size(); ++output)
      for (std::size_t k = 0; k < found.pressures.size(); ++k) {
        Eigen::ArrayXd above(surfaces), below(surfaces);
        for (std::size_t s = 0; s < surfaces; ++s) {
          above(Index(s)) = sides[0][s][output][k];
          below(Index(s)) = sides[1][s][output][k];
        }
        const double slope = std::log(above.mean() / below.mean()) / (2 * found.step);
        const Eigen::ArrayXd slopes =
            (above / above.mean() - below / below.mean()) / (2 * found.step);
        const auto n = double(surfaces);
        const EnsembleMean& by_law = one.outputs[output].at_pressures[k];
        // Half of the 95 % interval, and K_t/K of 0.04 in it; powers have no scatter.
        const double error = std::hypot(std::sqrt(slopes.square().sum() / n / (n - 1)),
                                        (by_law.high - by_law.low) / 4, 2e-3);
        CAPTURE(one.parameter, one.outputs[output].output, k, by_law.mean, slope, error);
        CHECK(by_law.mean == Approx(slope).margin(4 * error));
        beyond += std::abs(by_law.mean - slope) > 2 * error;
        ++count;
      }
  }
  // By chance one of twenty is.
  CHECK(beyond <= 0.05 * count);
  CHECK(count >= 168);
}

}  // namespace

TEST_CASE("Responses by laws are those by differences of studies", "[sensitivity]") {
  compare_with_scaled_studies(32, 24, ContactParameters::unknown);
}

TEST_CASE("Responses by laws are those by differences of studies of 50 surfaces",
          "[.][sensitivity]") {
  compare_with_scaled_studies(64, 50, GENERATE(ContactParameters::unknown, 0.3));
}

TEST_CASE("Responses of contacts with plasticity are differences of studies", "[sensitivity]") {
  StudyConfiguration study = study_of(32, {1, 2});
  study.known.hardness = 400e6;
  const StudySensitivity found = study_sensitivity(study, {.waves = false});
  // Nothing changes if heights, loads, and amplitudes grow alike, but the hardness does not: the
  // surfaces yield more.
  double sum = 0;
  for (const std::string_view parameter : {"rms_height", "pressure", "normal_amplitude"})
    sum += slope(found, parameter, "mean_gap", 3);
  CHECK(sum < 0.999);
  CHECK(sum > 0.9);
}

TEST_CASE("The response of the mean gap to waves is their mean under the pressure of a flat punch",
          "[sensitivity]") {
  // At a given force, d(mean gap) = Σw dh/Σw with the pressure w of a flat punch on the contact set.
  const StudyConfiguration study = study_of(64, {5, 6});
  const StudySensitivity found = study_sensitivity(study, {.step = 2e-3});
  const auto& recipe = std::get<GeneratedSurfaces>(study.surfaces);
  for (const std::size_t k : {0u, 3u}) {
    double gap = 0, by_punch = 0;
    std::vector<double> of_band(found.parameters.size());
    for (const std::uint64_t seed : recipe.seeds) {
      const Surface surface = study_surface(study, seed);
      const NormalContactState state =
          press(surface, study.material.contact_modulus, at_pressure(study.pressures[k]));
      const Field w = punch_pressure(surface.grid, contact_set(state));
      gap += state.mean_gap;
      by_punch += (w * (surface.heights - surface.heights.mean())).sum() / w.sum();
    }
    // All heights respond by the slope of the smooth law, without the noise of the cells of one
    // contact in K; the bands by the punch of each contact, with a smooth law through them.
    CHECK(slope(found, "rms_height", "mean_gap", k) == Approx(by_punch / gap).epsilon(1e-2));
    double sum = 0;
    for (const ParameterSensitivity& one : found.parameters)
      if (one.parameter == "waves") sum += one.outputs.front().at_pressures[k].mean;
    CHECK(sum == Approx(by_punch / gap).epsilon(5e-3));
  }
}

TEST_CASE("Limits of a result by tolerances are those of studies at the limits of the parameters",
          "[sensitivity]") {
  using enum StudyParameter;
  const StudyConfiguration study = study_of(48, {1, 2, 3});
  const StudySensitivity found = study_sensitivity(study, {.waves = false});
  const std::vector<std::pair<StudyParameter, double>> tolerances{{rms_height, 0.1},
                                                                  {pressure, 0.15}};
  const auto stiffness = [&](double height, double load) {
    return run_study(scaled(scaled(study, rms_height, height), pressure, load))
        .curve(&ForceSample::normal_stiffness);
  };
  const auto soft = stiffness(1.1, 1 / 1.15), stiff = stiffness(1 / 1.1, 1.15);
  for (const std::size_t k : {1u, 2u}) {
    // The two ends are the square of the factor apart; the curvature of ln K and single cells.
    const double factor = found.factor_of(tolerances, "normal_stiffness", k);
    CHECK(std::log(stiff[k].mean / soft[k].mean) == Approx(2 * std::log(factor)).epsilon(0.15));
    CHECK(factor > 1.2);
  }
  CHECK(std::isnan(found.factor_of({{friction_coefficient, 0.1}}, "normal_stiffness", 0)));
}

TEST_CASE("A parameter at its limit is left out of the responses, with the reason",
          "[sensitivity]") {
  StudyConfiguration study = study_of(32, {1, 2});
  std::get<GeneratedSurfaces>(study.surfaces).spectrum.hurst = 1;
  const StudySensitivity found = study_sensitivity(study, {.waves = false});
  REQUIRE(found.left_out.size() >= 1);
  CHECK_THAT(found.left_out.front(), Catch::Contains("hurst"));
  CHECK_FALSE(found.find("hurst", "mean_gap"));
  CHECK(found.find("rolloff", "mean_gap"));
  CHECK(found.sentence("mean_gap", 0).empty());
  // Between a cut-off and a roll-off at the side there is no wave, or one band of all.
  StudyConfiguration one = study_of(32, {1, 2});
  std::get<GeneratedSurfaces>(one.surfaces).spectrum.rolloff = side;
  std::get<GeneratedSurfaces>(one.surfaces).spectrum.short_cutoff = side;
  const StudySensitivity single = study_sensitivity(one);
  CHECK(single.parameters.back().parameter == "waves");
  CHECK(single.parameters.back().longest == side);
  study.ensemble.hurst = {0.5, 0.7};
  CHECK_THROWS_WITH(study_sensitivity(study), Catch::Contains("ensemble"));
  CHECK_THROWS_WITH(study_sensitivity(study_of(32, {1, 2}), {.step = 1}), Catch::Contains("step"));
}

TEST_CASE("Sensitivities near full contact have their sign and limits, or are not known",
          "[sensitivity]") {
  // Loads from light ones to full contact, where a smooth law of the gap no longer holds.
  for (const std::vector<std::uint64_t>& seeds : {std::vector<std::uint64_t>{1}, {1, 2, 3, 4}}) {
    StudyConfiguration study = study_of(32, seeds);
    study.pressures = {4e6, 20e6, 100e6, 300e6, 500e6, 1e9, 3e9};
    const StudySensitivity found = study_sensitivity(study, {.waves = false});
    int known = 0, all = 0;
    for (const ParameterSensitivity& parameter : found.parameters)
      for (const OutputSensitivity& output : parameter.outputs)
        for (const EnsembleMean& slope : output.at_pressures) {
          ++all;
          if (std::isnan(slope.mean)) continue;
          ++known;
          CAPTURE(parameter.parameter, output.output, seeds.size());
          CHECK(std::isfinite(slope.low));
          CHECK(std::isfinite(slope.high));
        }
    CHECK(known > all / 4);
    CHECK(known < all);
    const OutputSensitivity* gap = found.find("pressure", "mean_gap");
    REQUIRE(gap);
    for (const EnsembleMean& slope : gap->at_pressures) CHECK(!(slope.mean >= 0));
  }
}

TEST_CASE("Sensitivities that are stopped say so and have no numbers", "[sensitivity]") {
  int calls = 0;
  const StudySensitivity found = study_sensitivity(
      study_of(32, {1, 2}), {.on_progress = [&](const ProgressReport&) { return ++calls < 3; }});
  CHECK(found.interrupted);
  CHECK(found.parameters.empty());
}

TEST_CASE("A design finds parameters that meet a target which other parameters made", "[design]") {
  const auto which = GENERATE(0, 1, 2, 3, 4, 5, 6, 7, 8, 9);
  CAPTURE(which);
  const bool loss = which >= 8;
  StudyConfiguration study = study_of(32, {11, 12, 13, 14, 15, 16, 17, 18});
  // The hidden parameters, and the means that they make on other surfaces.
  const double height = (70 + 13 * which) * 1e-9, hurst = 0.5 + 0.04 * which,
               amplitude = (1.5 + 0.2 * which) * 1e-9;
  StudyConfiguration hidden = study;
  auto& spectrum = std::get<GeneratedSurfaces>(hidden.surfaces).spectrum;
  spectrum.rms_height = height;
  spectrum.hurst = hurst;
  hidden.motion = EqualFrequency{amplitude, 1e-9, std::numbers::pi / 2, 1e3};
  std::get<GeneratedSurfaces>(hidden.surfaces).seeds = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const StudyResult made = run_study(hidden);
  DesignProblem problem{
      .study = study,
      .target = {.output = loss ? "damping_constant" : "normal_stiffness",
                 .values = {},
                 .tolerance = 0.25,
                 .force = {}},
      .free = {{StudyParameter::rms_height, 30e-9, 400e-9}, {StudyParameter::hurst, 0.3, 0.95}}};
  if (loss) problem.free.push_back({StudyParameter::normal_amplitude, 0.5e-9, 5e-9});
  const auto means = loss ? made.damping(&DampingPoint::damping_constant)
                          : made.curve(&ForceSample::normal_stiffness);
  for (std::size_t k = 0; k < study.pressures.size(); ++k) {
    problem.target.force.push_back(study.pressures[k] * side * side);
    problem.target.values.push_back(means[k].mean);
  }
  const Design found = design(problem);
  CAPTURE(found.deviation, found.studies);
  CHECK(found.met);
  CHECK(found.studies < 100);
  REQUIRE(found.points.size() == 4);
  for (const DesignPoint& point : found.points) {
    CHECK(point.output.low < point.output.mean);
    CHECK(point.surface.high > point.output.high);
  }
  for (std::size_t p = 0; p < problem.free.size(); ++p)
    CHECK(value_of(found.study, problem.free[p].parameter) ==
          Approx(found.parameters[p].value).epsilon(1e-12));
  CHECK(found.study.models == study.models);
  // What the design says is what a study of it finds; the loss of its first surface is computed
  // with other contacts in the oscillation, and differs by the error of that.
  StudyConfiguration designed = found.study;
  std::get<GeneratedSurfaces>(designed.surfaces).seeds = {19, 20, 21, 22, 23, 24, 25, 26};
  const StudyResult again = run_study(designed);
  const auto found_again = loss ? again.damping(&DampingPoint::damping_constant)
                                : again.curve(&ForceSample::normal_stiffness);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(found.points[k].output.mean == Approx(found_again[k].mean).epsilon(0.02));
}

TEST_CASE("A design that cannot be is not met, and says what binds it", "[design]") {
  const double pressure = 4e6, force = pressure * side * side;
  DesignProblem problem{.study = study_of(32, {11, 12, 13}),
                        .target = {.output = "normal_stiffness",
                                   .values = {},
                                   .tolerance = 0.2,
                                   .force = {force, 1.5 * force, 2 * force, 3 * force}},
                        .free = {{StudyParameter::rms_height, 50e-9, 200e-9}}};
  // K falls with the height. It cannot be the same at all loads either.
  SECTION("too stiff") {
    problem.target.values = {1e9};
    const Design found = design(problem);
    CHECK_FALSE(found.met);
    CHECK(found.parameters.front().at_limit);
    CHECK(found.parameters.front().value == Approx(50e-9).epsilon(0.02));
    CHECK(found.parameters.front().sensitivity < 0);
  }
  SECTION("too soft") {
    problem.target.values = {1e3};
    const Design found = design(problem);
    CHECK_FALSE(found.met);
    CHECK(found.parameters.front().value == Approx(200e-9).epsilon(0.02));
  }
  SECTION("constant over the loads") {
    problem.target.values = {5e5};
    problem.target.force.back() = 20 * force;
    const Design found = design(problem);
    CHECK_FALSE(found.met);
    CHECK(found.deviation > 0.2);
  }
}

TEST_CASE("A problem of design that is no problem is refused by name", "[design]") {
  DesignProblem problem{.study = study_of(32, {11, 12}),
                        .target = {.output = "normal_stiffness",
                                   .values = {1e6},
                                   .tolerance = 0.2,
                                   .force = {1, 2, 3, 4}},
                        .free = {{StudyParameter::rms_height, 50e-9, 200e-9}}};
  const auto refused = [&](const char* what) {
    CHECK_THROWS_WITH(design(problem), Catch::Contains(what));
  };
  SECTION("output") { problem.target.output = "color", refused("color"); }
  SECTION("value") { problem.target.values = {0}, refused("value"); }
  SECTION("force") { problem.target.force = {1, 2, 3}, refused("at least 4"); }
  SECTION("limits") { problem.free = {{StudyParameter::hurst, 0.8, 0.5}}, refused("hurst"); }
  SECTION("limit of H") { problem.free = {{StudyParameter::hurst, 0.8, 1.5}}, refused("hurst"); }
  SECTION("pressure") { problem.free = {{StudyParameter::pressure, 1, 2}}, refused("pressure"); }
  SECTION("friction") {
    problem.free = {{StudyParameter::friction_coefficient, 0.1, 0.3}};
    refused("friction_coefficient");
  }
}
