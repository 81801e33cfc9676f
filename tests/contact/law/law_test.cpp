// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/law.hpp>

using namespace salebra;

namespace {

/// ln F = 1.5 δ − 0.05 δ² + 0.1 sin δ: F, F', F'' > 0 on [0, 4], and it bends like the curve of a
/// rough surface.
struct Bent {
  static double log_slope(double x) { return 1.5 - 0.1 * x + 0.1 * std::cos(x); }
  static double force(double x) { return std::exp(1.5 * x - 0.05 * x * x + 0.1 * std::sin(x)); }
  static double stiffness(double x) { return force(x) * log_slope(x); }
  static double force_curvature(double x) {
    return force(x) * (log_slope(x) * log_slope(x) - 0.1 - 0.1 * std::sin(x));
  }
};

/// `intervals` unequal steps over [0, 4]; the spacing alternates, so that no cancellation of a
/// uniform grid helps.
ForceCurve bent_curve(int intervals, bool with_stiffness) {
  ForceCurve curve;
  for (int i = 0; i <= intervals; ++i) {
    const double x = 4.0 * (i + (i % 2 ? 0.2 : 0.0)) / intervals;
    ForceSample sample{.indentation = x, .force = Bent::force(x)};
    if (with_stiffness) sample.normal_stiffness = Bent::stiffness(x);
    curve.samples.push_back(sample);
  }
  return curve;
}

/// Maximum relative error in the middle of the table, which the one-sided differences at the ends
/// do not affect.
double worst(const std::function<double(double)>& law, const std::function<double(double)>& exact) {
  double error = 0;
  for (double x = 0.5; x < 3.5; x += 0.00137)
    error = std::max(error, std::abs(law(x) / exact(x) - 1));
  return error;
}

}  // namespace

TEST_CASE("A paraboloid's power law is Hertz: K = 2E*a, F'' = E*R/a", "[law]") {
  const double modulus = 1e9, radius = 1e-2, indentation = 3e-6;
  const double contact_radius = std::sqrt(radius * indentation);
  const PowerLaw hertz(4.0 / 3 * modulus * std::sqrt(radius), 1.5, 0.8);
  CHECK(hertz.force(indentation) ==
        Approx(4.0 / 3 * modulus * std::pow(contact_radius, 3) / radius).epsilon(1e-14));
  CHECK(hertz.normal_stiffness(indentation) == Approx(2 * modulus * contact_radius).epsilon(1e-14));
  CHECK(hertz.force_curvature(indentation) ==
        Approx(modulus * radius / contact_radius).epsilon(1e-14));
  CHECK(hertz.tangential_stiffness(indentation) ==
        Approx(0.8 * 2 * modulus * contact_radius).epsilon(1e-14));
  CHECK(hertz.tangential_curvature(indentation) ==
        Approx(0.8 * modulus * radius / contact_radius).epsilon(1e-14));
  CHECK(hertz.indentation_of(hertz.force(indentation)) == Approx(indentation).epsilon(1e-14));
  // Out of contact there is neither force nor stiffness.
  CHECK(hertz.force(-indentation) == 0);
  CHECK(hertz.normal_stiffness(-indentation) == 0);
  CHECK(hertz.force_curvature(0) == 0);
}

TEST_CASE("The exponential law has F'' = K/l = F/l² and its own inverse", "[law]") {
  const ExponentialLaw law(2.0, 1e-7, 0.9);
  const double indentation = GENERATE(-3e-7, 0.0, 2e-7);
  CHECK(law.normal_stiffness(indentation) == Approx(law.force(indentation) / 1e-7).epsilon(1e-15));
  CHECK(law.force_curvature(indentation) == Approx(law.force(indentation) / 1e-14).epsilon(1e-15));
  CHECK(law.indentation_of(law.force(indentation)) == Approx(indentation).margin(1e-22));
}

TEST_CASE("A table of an exponential law is the exponential law", "[law]") {
  const ExponentialLaw exact(1.0, 1e-7, 0.9);
  ForceCurve curve;
  for (double gap : {5e-7, 3.5e-7, 3e-7, 1.2e-7, 1e-7})
    curve.samples.push_back({.mean_gap = gap, .force = exact.force(-gap)});
  const TabulatedLaw law(curve, 0.9);
  CHECK(law.lowest_indentation() == -5e-7);
  CHECK(law.highest_indentation() == -1e-7);
  for (double indentation : {-5e-7, -4.1e-7, -3.2e-7, -2e-7, -1e-7}) {
    // ln F is a straight line: only round-off of the slopes remains, which F'' divides by a
    // spacing.
    CHECK(law.force(indentation) == Approx(exact.force(indentation)).epsilon(1e-13));
    CHECK(law.normal_stiffness(indentation) ==
          Approx(exact.normal_stiffness(indentation)).epsilon(1e-12));
    CHECK(law.force_curvature(indentation) ==
          Approx(exact.force_curvature(indentation)).epsilon(1e-11));
    CHECK(law.indentation_of(exact.force(indentation)) == Approx(indentation).epsilon(1e-13));
  }
}

TEST_CASE("Force, stiffness and curvature of a table converge at orders 4, 3, 2", "[law]") {
  const bool with_stiffness = GENERATE(false, true);
  const TabulatedLaw coarse(bent_curve(40, with_stiffness), 1);
  const TabulatedLaw fine(bent_curve(160, with_stiffness), 1);
  auto order = [&](double (TabulatedLaw::*quantity)(double) const, double (*exact)(double)) {
    auto error = [&](const TabulatedLaw& law) {
      return worst([&](double x) { return (law.*quantity)(x); }, exact);
    };
    return std::log(error(coarse) / error(fine)) / std::log(4.0);
  };
  // At h = 0.1 and 0.025 the next term of the error is h times the first: a quarter of an order at
  // most.
  CHECK(order(&TabulatedLaw::force, &Bent::force) == Approx(4).margin(0.25));
  CHECK(order(&TabulatedLaw::normal_stiffness, &Bent::stiffness) == Approx(3).margin(0.25));
  CHECK(order(&TabulatedLaw::force_curvature, &Bent::force_curvature) == Approx(2).margin(0.25));
}

TEST_CASE("The table's stiffness integrates to the difference of its forces", "[law]") {
  const TabulatedLaw law(bent_curve(12, true), 1);
  // Midpoint rule, error about h² F'''/24 per length: 1e-9 with 2e4 steps over two units.
  const int steps = 20000;
  double integral = 0;
  for (int i = 0; i < steps; ++i) integral += law.normal_stiffness(1 + 2 * (i + 0.5) / steps);
  CHECK(integral * 2 / steps == Approx(law.force(3) - law.force(1)).epsilon(1e-8));
}

TEST_CASE("A table grows wherever its samples do", "[law]") {
  ForceCurve curve;
  const double force[] = {1, 1.0001, 50, 50.001, 60, 4000, 4000.5};
  for (int i = 0; i < 7; ++i) curve.samples.push_back({.indentation = 1.0 * i, .force = force[i]});
  const TabulatedLaw law(curve, 1);
  double last = 0;
  for (double x = 0; x <= 6; x += 0.001) {
    REQUIRE(law.force(x) >= last);
    last = law.force(x);
    CHECK(law.force(law.indentation_of(last)) == Approx(last).epsilon(1e-12));
  }
}

TEST_CASE("A table's own tangential stiffness is used, and is interpolated in its own right",
          "[law]") {
  ForceCurve curve = bent_curve(40, true);
  for (ForceSample& sample : curve.samples)
    sample.tangential_stiffness = 0.8 * (1 + 0.01 * sample.indentation) * sample.normal_stiffness;
  const TabulatedLaw own(curve, 0.5), shared(bent_curve(40, true), 0.5);
  const double x = 1.63;
  // h = 0.1: the interpolation errors of the order test are below 1e-5 in K_t and 1e-3 in K_t'.
  CHECK(own.tangential_stiffness(x) ==
        Approx(0.8 * (1 + 0.01 * x) * Bent::stiffness(x)).epsilon(1e-5));
  CHECK(own.tangential_curvature(x) ==
        Approx(0.8 * ((1 + 0.01 * x) * Bent::force_curvature(x) + 0.01 * Bent::stiffness(x)))
            .epsilon(1e-3));
  CHECK(shared.tangential_stiffness(x) == 0.5 * shared.normal_stiffness(x));
  CHECK(shared.tangential_curvature(x) == 0.5 * shared.force_curvature(x));
}

TEST_CASE("A table opens below its first sample like a sphere, and all its numbers agree there",
          "[law]") {
  ForceCurve curve = bent_curve(9, false);
  for (ForceSample& sample : curve.samples)
    sample.tangential_stiffness = 0.7 * Bent::stiffness(sample.indentation);
  const TabulatedLaw law(curve, 1);
  const double first = law.lowest_indentation(), force = law.force(first),
               stiffness = law.normal_stiffness(first), touch = law.first_touch();
  CHECK(touch == Approx(first - 1.5 * force / stiffness).epsilon(1e-14));
  for (const double share : {0.999999, 0.7, 0.2, 1e-3}) {
    const double at = touch + share * (first - touch), step = 1e-4 * (at - touch);
    CAPTURE(share);
    CHECK(law.force(at) == Approx(force * std::pow(share, 1.5)).epsilon(1e-9));
    // Central differences have a relative error of the order of the square of the step.
    const auto slope = [&](auto number) {
      return ((law.*number)(at + step) - (law.*number)(at - step)) / (2 * step);
    };
    if (share < 0.9) {
      CHECK(law.normal_stiffness(at) == Approx(slope(&ContactLaw::force)).epsilon(1e-6));
      CHECK(law.force_curvature(at) == Approx(slope(&ContactLaw::normal_stiffness)).epsilon(1e-6));
      CHECK(law.tangential_curvature(at) ==
            Approx(slope(&ContactLaw::tangential_stiffness)).epsilon(1e-6));
    }
    CHECK(law.stiffness_ratio(at) == Approx(law.stiffness_ratio(first)).epsilon(1e-12));
    CHECK(law.tangential_stiffness(at) ==
          Approx(law.stiffness_ratio(at) * law.normal_stiffness(at)).epsilon(1e-9));
    CHECK(law.indentation_of(law.force(at)) == Approx(at).margin(1e-12 * (first - touch)));
  }
  // F and K are continuous at the first sample.
  CHECK(law.force(first * (1 - 1e-13)) == Approx(force).epsilon(1e-9));
  CHECK(law.normal_stiffness(first - 1e-12) == Approx(stiffness).epsilon(1e-9));
  for (const double apart : {touch, touch - 1, -1e300}) {
    CHECK(law.force(apart) == 0);
    CHECK(law.normal_stiffness(apart) == 0);
    CHECK(law.force_curvature(apart) == 0);
    CHECK(law.tangential_stiffness(apart) == 0);
    CHECK(law.tangential_curvature(apart) == 0);
  }
}

TEST_CASE("Either half of the samples of a table makes a coarser law", "[law]") {
  const ForceCurve curve = bent_curve(12, true);
  const TabulatedLaw law(curve, 1);
  const std::vector<double> nodes = law.break_points();  // first touch, then the samples
  for (const bool odd : {false, true}) {
    const auto coarser = law.coarser(odd);
    REQUIRE(coarser);
    CHECK(coarser->lowest_indentation() == law.lowest_indentation());
    CHECK(coarser->highest_indentation() == law.highest_indentation());
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const bool kept = i == 1 || i + 1 == nodes.size() || (i % 2 == 0) == odd;
      CHECK((std::abs(coarser->force(nodes[i]) / law.force(nodes[i]) - 1) < 1e-12) == kept);
    }
  }
  CHECK_FALSE(TabulatedLaw(bent_curve(5, true), 1).coarser(false));
  CHECK_FALSE(PowerLaw(1, 2, 1).coarser(true));
}

TEST_CASE("A table says what it cannot use", "[law]") {
  ForceCurve curve = bent_curve(5, false);
  const TabulatedLaw law(curve, 1);
  CHECK_THROWS_WITH(law.force(4.5),
                    Catch::Contains("indentation: 4.5") && Catch::Contains("range"));
  CHECK_THROWS_AS(law.force(std::nan("")), InvalidInput);
  CHECK_THROWS_WITH(law.indentation_of(1e9), Catch::Contains("force: 1000000000"));
  CHECK_THROWS_AS(law.indentation_of(-1), InvalidInput);
  CHECK_THROWS_AS(TabulatedLaw(curve, 0), InvalidInput);

  // Samples before first touch and samples that did not converge do not count, wherever they lie.
  curve.samples.insert(curve.samples.begin(), {.indentation = -1, .force = 0});
  curve.samples.push_back({.indentation = 2, .force = 1e6, .converged = false});
  CHECK(TabulatedLaw(curve, 1).force(2.2) == law.force(2.2));
  SECTION("too few") {
    curve.samples.resize(4);
    CHECK_THROWS_WITH(TabulatedLaw(curve, 1), Catch::Contains("at least four"));
  }
  SECTION("not growing") {
    curve.samples[3].force = curve.samples[2].force;
    CHECK_THROWS_WITH(TabulatedLaw(curve, 1), Catch::Contains("does not grow"));
  }
  SECTION("two at one place") {
    curve.samples[3].indentation = curve.samples[2].indentation;
    CHECK_THROWS_WITH(TabulatedLaw(curve, 1), Catch::Contains("twice"));
  }
}

TEST_CASE("A curve known by its pressures alone gives the same law", "[law]") {
  ForceCurve by_force = bent_curve(10, false), by_pressure = by_force;
  by_pressure.nominal_area = 0.25;
  for (ForceSample& sample : by_pressure.samples) {
    sample.pressure = sample.force / 0.25;
    sample.force = ForceSample::unknown;
  }
  CHECK(TabulatedLaw(by_pressure, 1).force_curvature(1.7) ==
        TabulatedLaw(by_force, 1).force_curvature(1.7));
}

TEST_CASE("Closed laws refuse what has no meaning", "[law]") {
  CHECK_THROWS_AS(PowerLaw(1, 0.5, 1), InvalidInput);
  CHECK_THROWS_AS(PowerLaw(-1, 2, 1), InvalidInput);
  CHECK_THROWS_AS(ExponentialLaw(1, 0, 1), InvalidInput);
  CHECK_THROWS_AS(ExponentialLaw(1, 1, -1), InvalidInput);
  CHECK_THROWS_AS(ExponentialLaw(1, 1, 1).indentation_of(0), InvalidInput);
}
