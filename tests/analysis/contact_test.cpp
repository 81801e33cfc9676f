// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/generators/shapes.hpp>
#include <utility>
#include <vector>

using namespace salebra;

namespace {

const Material body = Material::of_contact_modulus(1e9, 0.3);

/// A power law F = F0 (δ/δ0)^{3/2} with stiffnesses, as a model would return it.
ForceCurve power_curve() {
  ForceCurve curve{.model = "power", .nominal_area = 1e-6, .rms_height = 1e-6, .samples = {}};
  for (int i = 1; i <= 40; ++i) {
    const double indentation = 1e-8 * i, force = 1e10 * std::pow(indentation, 1.5);
    const double stiffness = 1.5 * force / indentation;
    curve.samples.push_back({.indentation = indentation,
                             .mean_gap = 5e-6 - indentation,
                             .force = force,
                             .pressure = force / curve.nominal_area,
                             .normal_stiffness = stiffness,
                             .tangential_stiffness = body.modulus_ratio() * stiffness});
  }
  return curve;
}

ContactSolution on_curve(ControlQuantity quantity, double value) {
  return solve(CurveContact{power_curve(), body.modulus_ratio(), {quantity, {value}}, "curve.h5"});
}

double indentation_of(const ContactSolution& contact) {
  return salebra::indentation_of(*contact.law, contact.points.at(0));
}

std::string refusal(auto&& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Force, pressure, indentation and mean gap name the same state of a curve",
          "[analysis]") {
  const ForceCurve curve = power_curve();
  const ForceSample& sample = curve.samples[20];
  // The spline passes through its samples, and its inverse is accurate to some 1e-12.
  for (const auto& [quantity, value] : {std::pair{ControlQuantity::normal_force, sample.force},
                                        {ControlQuantity::indentation, sample.indentation},
                                        {ControlQuantity::pressure, sample.pressure},
                                        {ControlQuantity::mean_gap, sample.mean_gap}})
    CHECK(indentation_of(on_curve(quantity, value)) == Approx(sample.indentation).epsilon(1e-9));
  CHECK(on_curve(ControlQuantity::pressure, sample.pressure).nominal_area() == 1e-6);
}

TEST_CASE("A position beyond a curve is refused in the quantity that was given", "[analysis]") {
  CHECK_THAT(refusal([] { on_curve(ControlQuantity::pressure, 1e12); }),
             Catch::StartsWith("pressure: 1 TPa lies outside the curve's range"));
  CHECK_THAT(refusal([] { on_curve(ControlQuantity::mean_gap, 6e-6); }),
             Catch::StartsWith("mean_gap: 6 µm lies outside"));
  CHECK_THAT(
      refusal([] {
        solve(IndenterContact{paraboloid_profile(1e-2), body, {ControlQuantity::pressure, {1e6}}});
      }),
      Catch::StartsWith("pressure: given"));
  CHECK_THAT(refusal([] { solve(ExponentialContact{1e-7, 1, {1, -1}}); }),
             Catch::StartsWith("normal_force: -1"));
}

TEST_CASE("A curve and moduli that do not fit it are doubted", "[analysis]") {
  CHECK(on_curve(ControlQuantity::indentation, 1e-7).warnings.empty());
  const auto other =
      solve(CurveContact{power_curve(), 1, {ControlQuantity::indentation, {1e-7}}, "curve.h5"});
  REQUIRE(other.warnings.size() == 1);
  CHECK_THAT(other.warnings[0], Catch::Contains("gives G*/E* = 1, but"));
}

TEST_CASE("A paraboloid as an indenter and as a surface is one contact", "[analysis]") {
  const Grid2D grid{128, 128, 1e-3, 1e-3};
  const SurfaceContact surface{
      .surface = paraboloid_surface(grid, 1e-2), .body = body, .pressure = {1e3}};
  const ContactSolution cells = solve(surface);
  REQUIRE(cells.curve);
  // Thirteen contacts are solved around the pressure, which is one of them.
  CHECK(cells.curve->samples.size() == 13);
  const auto hertz = solve(IndenterContact{
      paraboloid_profile(1e-2), body, {ControlQuantity::normal_force, {1e3 * grid.area()}}});
  const double stiffness = hertz.law->normal_stiffness(indentation_of(hertz));
  // The contact radius is a = 20 µm. Contacts that repeat at L = 1 mm are stiffer by some 2.8 a/L =
  // 6 %, and a is known to a fraction of its 2.5 cells.
  CHECK(cells.law->normal_stiffness(indentation_of(cells)) == Approx(stiffness).epsilon(0.15));
  const ContactParameters parameters =
      hertz.parameters_at({}, indentation_of(hertz), indentation_of(hertz));
  CHECK(parameters.contact_modulus == Approx(1e9).epsilon(1e-12));
  CHECK(parameters.loaded_size == Approx(stiffness / 2e9).epsilon(1e-9));
}

TEST_CASE("A pressure of full contact is named, and loads of full contact make no law",
          "[analysis]") {
  // A sine wave of amplitude a closes at the mean pressure πE*a/λ for waves along one axis.
  const Grid2D grid{64, 4, 1, 1.0 / 16};
  Field heights(grid.nx, grid.ny);
  for (Index i = 0; i < grid.nx; ++i)
    heights.row(i) = 1e-3 * std::cos(2 * std::numbers::pi * double(i) / double(grid.nx));
  const double closing = std::numbers::pi * 1e-3;
  const auto solved = [&](double share) {
    return solve(SurfaceContact{.surface = {grid, heights, true, "wave"},
                                .body = Material::of_contact_modulus(1, 0.3),
                                .pressure = {0.5 * closing, share * closing}});
  };
  CHECK_THROWS_WITH(solved(1.5), Catch::Contains("pressure: ") && Catch::Contains("full contact"));
  // The sweep about 0.9 reaches beyond closing.
  const ContactSolution open = solved(0.9);
  CHECK(open.points.size() == 2);
  for (const ForceSample& sample : open.curve->samples) CHECK(sample.contact_area_fraction < 1);
}

TEST_CASE("Where a law is evaluated the caller's wish to stop is looked at", "[analysis]") {
  bool stop = false;
  const Context context{.stopped = [&] { return stop; }};
  const auto contact = solve(ExponentialContact{1e-7, 1, {1}}, context);
  CHECK(contact.law->force(0) == 1);
  stop = true;
  CHECK_THROWS_AS(contact.law->force(0), Interrupted);
  CHECK_THROWS_AS(law_of(IndenterContact{paraboloid_profile(1e-2), body, {}}, context)->force(1e-6),
                  Interrupted);
}

TEST_CASE("A curve of two directions makes two solutions, and one where a direction is chosen",
          "[analysis]") {
  ForceCurve across = power_curve(), along = across;
  for (ForceSample& sample : across.samples) sample.direction = 1.5;
  for (ForceSample& sample : along.samples) {
    sample.direction = 0.1;
    sample.tangential_stiffness *= 0.8;
  }
  // Files list the loads in order, so that rows of both directions alternate.
  ForceCurve both = joined({across, along});
  std::ranges::stable_sort(both.samples, {}, &ForceSample::force);
  const std::vector<ForceCurve> parts = by_direction(both);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].direction() == 1.5);
  CHECK(parts[1].column(&ForceSample::tangential_stiffness) ==
        along.column(&ForceSample::tangential_stiffness));
  CHECK(by_direction(power_curve()).size() == 1);

  CurveContact contact{both, body.modulus_ratio(), {ControlQuantity::normal_force, {0.1}}, "it"};
  const std::vector<ContactSolution> solutions = solve_directions(contact);
  REQUIRE(solutions.size() == 2);
  const double indentation = indentation_of(solutions[0]);
  CHECK(solutions[0].direction() == 1.5);
  CHECK(solutions[1].law->tangential_stiffness(indentation) ==
        Approx(0.8 * solutions[0].law->tangential_stiffness(indentation)).epsilon(1e-12));
  CHECK_THAT(refusal([&] { return solve(contact); }), Catch::Contains("direction"));
  contact.direction = 0.1;
  CHECK(solve(contact).direction() == 0.1);
  contact.direction = 0.2;
  CHECK_THAT(refusal([&] { return solve(contact); }),
             Catch::Contains("direction: 11.4592deg is not in the curve, which has 85.9437deg and "
                             "5.72958deg"));
  contact.direction = LayDirection::across;
  CHECK_THAT(refusal([&] { return solve(contact); }), Catch::Contains("needs a surface"));
}
