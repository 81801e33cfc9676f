// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/adaptive_quadrature.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/shapes.hpp>

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double contact_modulus = 3e9;
const Grid2D coarsest{32, 32, 1e-3, 1e-3};

template <class Shape>
ContactSetsOnGrid free_contact_sets(const Shape& shape) {
  return [=](const Grid2D& grid) {
    return boundary_element_contact_sets(shape(grid), contact_modulus,
                                         {.tolerance = 1e-9, .boundary = Boundary::free});
  };
}

AdaptiveQuadratureOptions to_error(double relative_error) {
  AdaptiveQuadratureOptions options;
  options.relative_error = relative_error;
  options.max_points = 256;
  options.quadrature.stick.boundary = Boundary::free;
  return options;
}

// The trapezoidal rule over a period, exact to round-off.
template <class F>
double around(F integrand) {
  double sum = 0;
  for (int k = 0; k < 400; ++k) sum += integrand(std::cos(pi * k / 200), std::sin(pi * k / 200));
  return sum;
}

// Hertz' contact of x²/(2R_x) + y²/(2R_y) with R_x > R_y: b/a of its ellipses, and C in F = C
// δ^(3/2).
struct HertzEllipse {
  double axes = 0, coefficient = 0;

  HertzEllipse(double radius_x, double radius_y) {
    const double curvature_x = 0.5 / radius_x, curvature_y = 0.5 / radius_y;
    // With b = 1: δ = p0 b 𝐊/E*, curvatures p0/E* · b/(e²a²) · (𝐊 − 𝐄) along a, (a²/b² 𝐄 − 𝐊) along
    // b.
    double low = 1e-6, high = 1 - 1e-6;
    const auto ratio = [](double e) {
      const double k = std::comp_ellint_1(e), ee = std::comp_ellint_2(e);
      return (ee / (1 - e * e) - k) / (k - ee);
    };
    for (int i = 0; i < 200; ++i) {
      const double e = 0.5 * (low + high);
      (ratio(e) < curvature_y / curvature_x ? low : high) = e;
    }
    const double e = low, k = std::comp_ellint_1(e), ee = std::comp_ellint_2(e);
    axes = std::sqrt(1 - e * e);
    // p0/E* = s at b = 1, a = 1/axes; δ = s·𝐊 there, curvature_x = s e⁻² axes² (𝐊 − 𝐄). With fixed
    // R everything scales with b, for example δ/b².
    const double shape = axes * axes * (k - ee) / (e * e);
    const double slope_per_b = curvature_x / shape;                                   // p0/(E* b)
    const double depth_per_b2 = slope_per_b * k;                                      // δ/b²
    const double force_per_b3 = 2.0 / 3 * pi / axes * slope_per_b * contact_modulus;  // F/b³
    coefficient = force_per_b3 / std::pow(depth_per_b2, 1.5);
  }
};

}  // namespace

TEST_CASE("A requested error is reached and holds against the exact loss of round contacts",
          "[levels]") {
  const double poisson = GENERATE(0.0, 0.5);
  const bool cone = GENERATE(false, true);
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const double ratio = material.modulus_ratio();
  // Contact radii from 0.2 to 0.35 mm.
  const double depth = cone ? 27.5e-6 * pi / 2 : 0.3e-6;
  const double amplitude = cone ? 7.5e-6 * pi / 2 : 0.1e-6;
  const PowerLaw cone_law(2 * contact_modulus / (pi * 0.1), 2, ratio);
  const PowerLaw sphere_law(4.0 / 3 * contact_modulus * std::sqrt(0.3), 1.5, ratio);
  const ContactSetsOnGrid intervals =
      cone ? free_contact_sets([](const Grid2D& grid) {
        return cone_surface(grid, std::atan(0.1), off_grid_center(grid));
      })
           : free_contact_sets([](const Grid2D& grid) {
               return paraboloid_surface(grid, 0.3, off_grid_center(grid));
             });
  for (const Oscillation& motion : {Oscillation(EqualFrequency{amplitude, 2e-7, 0.8}),
                                    Oscillation(Drag{amplitude, 1e-3, 2e3})}) {
    const AdaptiveQuadratureResult result =
        adaptive_interval_quadrature(intervals, coarsest, material, motion, depth, to_error(0.01));
    const double exact =
        relaxation_damping(cone ? cone_law : sphere_law, at_indentation(depth), motion)
            .work_per_cycle;
    CHECK(result.reached);
    CHECK(result.error_estimate <= 0.01 * exact * 1.01);
    CHECK(std::abs(result.quadrature.work_per_cycle - exact) <= result.error_estimate);
    CHECK(result.trials.size() >= 3);
    // The control variate: round contacts have the ratio 1 at any ν, on any grid that resolves
    // them.
    CHECK(result.quadrature.stiffness_ratio == Approx(1).margin(poisson == 0 ? 1e-8 : 0.004));
  }
}

TEST_CASE("The stated error holds for ellipses, whose loss elliptic integrals give", "[levels]") {
  const double poisson = 0.5;
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const double radius_x = 0.4, radius_y = 0.08;
  const HertzEllipse hertz(radius_x, radius_y);
  const double direction = GENERATE(0.0, pi / 2);
  // K_t and K of an ellipse with the traction of the punch, which full stick on an ellipse has too;
  // semi-axes 1 and `axes`, motion along a or b.
  const auto size = [&](double c, double s) { return std::hypot(c, hertz.axes * s); };
  const double normal = around([&](double c, double s) { return (1 - poisson) / size(s, c); });
  const double tangential = around([&](double c, double s) {
    const double along = direction == 0 ? c : s;
    // The angle of the kernel is that of the ray: (1 − ν + ν cos²) = 1 − ν sin².
    return (1 - poisson * (1 - along * along)) / size(s, c);
  });
  const double expected = normal / tangential / material.modulus_ratio();
  const PowerLaw law(hertz.coefficient, 1.5, material.modulus_ratio() * expected);
  AdaptiveQuadratureOptions options = to_error(0.015);
  options.quadrature.direction = direction;
  const Oscillation motion = EqualFrequency{0.08e-6, 2e-7, pi / 2};
  const AdaptiveQuadratureResult result = adaptive_interval_quadrature(
      free_contact_sets([&](const Grid2D& grid) {
        return elliptic_paraboloid_surface(grid, radius_x, radius_y, off_grid_center(grid));
      }),
      coarsest, material, motion, 0.25e-6, options);
  const double exact = relaxation_damping(law, at_indentation(0.25e-6), motion).work_per_cycle;
  CHECK(result.reached);
  CHECK(std::abs(result.quadrature.work_per_cycle - exact) <= result.error_estimate);
  CHECK(result.quadrature.stiffness_ratio ==
        Approx(expected).epsilon(result.error_estimate / result.quadrature.work_per_cycle));
  CHECK(std::abs(expected - 1) > 0.05);
}

TEST_CASE("An error that cannot be reached is not called reached", "[levels]") {
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const ContactSetsOnGrid intervals = free_contact_sets(
      [](const Grid2D& grid) { return paraboloid_surface(grid, 0.3, off_grid_center(grid)); });
  const Oscillation motion = EqualFrequency{0.1e-6, 2e-7, pi / 2};
  AdaptiveQuadratureOptions options = to_error(1e-7);
  options.max_points = 32;
  options.max_intervals = 16;
  const AdaptiveQuadratureResult result = adaptive_interval_quadrature(
      intervals(coarsest), coarsest, material, motion, 0.3e-6, options);
  CHECK_FALSE(result.reached);
  CHECK(result.grid.nx == 32);
  CHECK(result.intervals == 16);
  CHECK(result.trials.size() == 2);
  options.relative_error = 0;
  CHECK_THROWS_WITH(
      adaptive_interval_quadrature(intervals, coarsest, material, motion, 0.3e-6, options),
      Catch::StartsWith("relative_error: 0"));
}
