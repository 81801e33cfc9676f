// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

const Material material = Material::of_moduli(1e9, 8e8);

struct Shape {
  const char* name;
  std::shared_ptr<const IndenterProfile> profile;
  std::function<double(double)> slope;  // f'
  std::vector<double> breaks = {};
};

std::vector<Shape> shapes() {
  const double angle = 0.2, radius = 1e-2, flat = 1e-4;
  std::vector<Shape> list;
  list.push_back({"cone", cone_profile(angle), [=](double) { return std::tan(angle); }});
  list.push_back({"paraboloid", paraboloid_profile(radius), [=](double r) { return r / radius; }});
  list.push_back({"r^4", power_profile(1e6, 4), [](double r) { return 4e6 * r * r * r; }});
  list.push_back(
      {"r^0.7", power_profile(1e-2, 0.7), [](double r) { return 0.7e-2 * std::pow(r, -0.3); }});
  list.push_back({"sphere", sphere_profile(radius),
                  [=](double r) { return r / std::sqrt(radius * radius - r * r); }});
  list.push_back({"rounded punch",
                  rounded_punch_profile(flat, radius),
                  [=](double r) { return r > flat ? (r - flat) / radius : 0; },
                  {flat}});
  return list;
}

// Midpoint rule; the caller substitutes variables. It is a plain independent route.
double midpoint(const std::function<double(double)>& f, double low, double high, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += f(low + (high - low) * (i + 0.5) / n);
  return sum * (high - low) / n;
}

}  // namespace

TEST_CASE("Eq (3): closed images are the transform of the profile's slope", "[mdr]") {
  for (const Shape& shape : shapes())
    for (const double x : {1.001e-4, 2e-4, 1e-3, 5e-3}) {
      CAPTURE(shape.name, x);
      const Estimate image = mdr_transform(shape.slope, x, shape.breaks);
      // The quadrature aims at 1e-12; the image of the rounded punch is a small difference near its
      // edge.
      CHECK(shape.profile->image(x) ==
            Approx(image.value).epsilon(1e-9).margin(10 * image.error + 1e-20));
      CHECK(image.error <= 1e-9 * std::abs(image.value) + 1e-18);
    }
}

TEST_CASE("Eqs (4), (5): the image of a cone is a wedge of slope (π/2)tanθ", "[mdr]") {
  const auto cone = cone_profile(0.2);
  CHECK(cone->height(3e-3) == Approx(3e-3 * std::tan(0.2)).epsilon(1e-14));
  CHECK(cone->image(2e-3) == Approx(pi / 2 * std::tan(0.2) * 2e-3).epsilon(1e-14));
  CHECK(cone->image_slope(2e-3) == Approx(pi / 2 * std::tan(0.2)).epsilon(1e-14));
  CHECK(paraboloid_profile(0.01)->image(1e-3) == Approx(1e-6 / 0.01).epsilon(1e-14));
}

TEST_CASE("The inverse transform gives the profile back", "[mdr]") {
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    for (const double r : {1.5e-4, 1e-3, 4e-3}) {
      const Estimate height =
          mdr_inverse([&](double x) { return shape.profile->image(x); }, r, shape.breaks);
      CHECK(height.value == Approx(shape.profile->height(r)).epsilon(1e-9));
    }
  }
}

TEST_CASE("Slope and integral of an image are its derivative and its area", "[mdr]") {
  for (const Shape& shape : shapes())
    for (const double x : {1.01e-4, 3e-4, 2.9e-3, 3.1e-3, 6e-3}) {
      CAPTURE(shape.name, x);
      const IndenterProfile& profile = *shape.profile;
      const double step = 1e-4 * (x - (shape.breaks.empty() ? 0 : shape.breaks[0]));
      // Central difference, relative error (1e-4)²; midpoint rule on 4000 cells.
      CHECK(profile.image_slope(x) ==
            Approx((profile.image(x + step) - profile.image(x - step)) / (2 * step)).epsilon(1e-6));
      CHECK(profile.image_integral(x) == Approx(midpoint([&](double t) { return profile.image(t); },
                                                         profile.flat_radius(), x, 4000))
                                             .epsilon(2e-5));
    }
}

TEST_CASE("Forces of cone, paraboloid and sphere are Sneddon's and Hertz's", "[mdr]") {
  const double contact_modulus = 1e9, indentation = 1e-6, radius = 1e-2, angle = 0.2;
  const IndenterLaw cone(cone_profile(angle), material);
  CHECK(cone.force(indentation) ==
        Approx(2 / pi * contact_modulus * indentation * indentation / std::tan(angle))
            .epsilon(1e-13));
  const IndenterLaw hertz(paraboloid_profile(radius), material);
  CHECK(hertz.force(indentation) ==
        Approx(4.0 / 3 * contact_modulus * std::sqrt(radius) * std::pow(indentation, 1.5))
            .epsilon(1e-13));
  CHECK(hertz.contact_radius(indentation) ==
        Approx(std::sqrt(radius * indentation)).epsilon(1e-13));
  // Sneddon (1965): F = E*[(a² + R²) artanh(a/R) − aR], δ = a artanh(a/R), here with a = R/2.
  const IndenterLaw sphere(sphere_profile(radius), material);
  const double a = radius / 2, deep = a * std::atanh(0.5);
  CHECK(sphere.contact_radius(deep) == Approx(a).epsilon(1e-13));
  CHECK(sphere.force(deep) ==
        Approx(contact_modulus * ((a * a + radius * radius) * std::atanh(0.5) - a * radius))
            .epsilon(1e-12));
  // A shallow sphere is a paraboloid: the relative difference is about a²/R², and no digits are
  // lost.
  CHECK(sphere.force(1e-12) == Approx(hertz.force(1e-12)).epsilon(1e-9));
  const IndenterLaw punch(flat_punch_profile(1e-3), material);
  CHECK(punch.force(indentation) == Approx(2e9 * 1e-3 * indentation).epsilon(1e-14));
  CHECK(punch.force_curvature(indentation) == 0);
}

TEST_CASE("K is the derivative of F and F'' that of K, for every profile", "[mdr]") {
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    const IndenterLaw law(shape.profile, material);
    for (const double indentation : {1e-7, 1e-6, 1e-5}) {
      const double step = 1e-4 * indentation;
      CHECK(law.normal_stiffness(indentation) ==
            Approx((law.force(indentation + step) - law.force(indentation - step)) / (2 * step))
                .epsilon(1e-7));
      CHECK(law.force_curvature(indentation) == Approx((law.normal_stiffness(indentation + step) -
                                                        law.normal_stiffness(indentation - step)) /
                                                       (2 * step))
                                                    .epsilon(1e-6));
      CHECK(law.indentation_of(law.force(indentation)) == Approx(indentation).epsilon(1e-12));
    }
    CHECK(law.force(-1e-9) == 0);
    CHECK(law.normal_stiffness(0) == 0);
  }
}

TEST_CASE("A power profile is PowerLaw", "[mdr]") {
  const double exponent = GENERATE(0.7, 1.0, 2.0, 4.0);
  const IndenterLaw law(power_profile(3, exponent), material);
  const double n = 1 + 1 / exponent;
  const PowerLaw power(law.force(1e-6) / std::pow(1e-6, n), n, material.modulus_ratio());
  for (const double indentation : {1e-8, 3e-6}) {
    CHECK(law.force(indentation) == Approx(power.force(indentation)).epsilon(1e-12));
    CHECK(law.force_curvature(indentation) ==
          Approx(power.force_curvature(indentation)).epsilon(1e-12));
  }
}

TEST_CASE("Eq (17) for the normal load: Hertz, cone and flat punch", "[mdr]") {
  const double contact_modulus = 1e9, indentation = 1e-6, radius = 1e-2;
  const IndenterLaw hertz(paraboloid_profile(radius), material);
  const double a = hertz.contact_radius(indentation);
  const double mean = hertz.force(indentation) / (pi * a * a);
  for (const double part : {0.0, 0.3, 0.9, 0.9999})
    CHECK(hertz.pressure(indentation, part * a) ==
          Approx(1.5 * mean * std::sqrt(1 - part * part)).epsilon(1e-9));
  CHECK(hertz.pressure(indentation, 1.0001 * a) == 0);
  const IndenterLaw cone(cone_profile(0.2), material);
  const double b = cone.contact_radius(indentation);
  CHECK(cone.pressure(indentation, 0.4 * b) ==
        Approx(contact_modulus * std::tan(0.2) / 2 * std::acosh(1 / 0.4)).epsilon(1e-9));
  const IndenterLaw punch(flat_punch_profile(1e-3), material);
  CHECK(punch.pressure(indentation, 6e-4) ==
        Approx(contact_modulus * indentation / (pi * 8e-4)).epsilon(1e-9));
}

TEST_CASE("Outside the contact the surface is Hertz's, and far away a point force's", "[mdr]") {
  const double radius = 1e-2, indentation = 1e-6, edge = std::sqrt(radius * indentation);
  const IndenterLaw law(paraboloid_profile(radius), Material::of_moduli(1e9, 0.8e9));
  for (const double ratio : {0.3, 1.0, 1.01, 2.0, 10.0}) {
    const double r = ratio * edge;
    const double hertz =
        ratio <= 1
            ? indentation - r * r / (2 * radius)
            : indentation / pi *
                  ((2 - ratio * ratio) * std::asin(1 / ratio) + std::sqrt(ratio * ratio - 1));
    // The closed form itself cancels to (r/a)⁴ ulp of 1.
    CHECK(law.surface_displacement(indentation, r) == Approx(hertz).epsilon(1e-10));
  }
  // u_z = F/(πE*r); Hertz's pressure has no dipole, so the next term is (a/r)² times a number of
  // order 1.
  const IndenterLaw cone(cone_profile(0.1), Material::of_moduli(1e9, 0.8e9));
  const double far = 1e3 * cone.contact_radius(indentation);
  CHECK(cone.surface_displacement(indentation, far) ==
        Approx(cone.force(indentation) / (pi * 1e9 * far)).epsilon(1e-5));
  CHECK(cone.surface_displacement(-1e-6, 1e-6) == 0);
}

TEST_CASE("The pressure carries the force, for every profile", "[mdr]") {
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    const IndenterLaw law(shape.profile, material);
    const double indentation = 2e-6, a = law.contact_radius(indentation);
    // r = a sin ψ makes the root at the edge smooth in ψ; at the axis p is at most logarithmic or
    // r^{−0.3}.
    const double force = midpoint(
        [&](double angle) {
          const double r = a * std::sin(angle);
          return 2 * pi * r * law.pressure(indentation, r) * a * std::cos(angle);
        },
        0, pi / 2, 2000);
    CHECK(force == Approx(law.force(indentation)).epsilon(2e-5));
  }
}

TEST_CASE("A table of a profile converges to it", "[mdr]") {
  const double radius = 1e-2, largest = 2e-3;
  auto table = [&](int points) {
    std::vector<double> radii, heights;
    for (int i = 0; i < points; ++i) {
      radii.push_back(largest * i / (points - 1));
      heights.push_back(std::pow(radii.back(), 3) / radius - 5e-6);
    }
    return std::make_shared<const TabulatedProfile>(radii, heights);
  };
  const auto exact = power_profile(1 / radius, 3);
  auto error = [&](int points) {
    const auto profile = table(points);
    return std::abs(profile->image(1.23e-3) / exact->image(1.23e-3) - 1);
  };
  // A cubic is interpolated exactly except next to the axis, where monotonicity limits the slopes.
  CHECK(error(41) < 1e-3);
  CHECK(error(161) < 1e-4);
  const auto profile = table(81);
  CHECK(profile->height(largest) == Approx(exact->height(largest)).epsilon(1e-12));
  const double x = 1.3e-3, step = 1e-7;
  CHECK(profile->image_slope(x) ==
        Approx((profile->image(x + step) - profile->image(x - step)) / (2 * step)).epsilon(1e-5));
  CHECK(profile->image_integral(x) ==
        Approx(midpoint([&](double t) { return profile->image(t); }, 0, x, 4000)).epsilon(1e-6));
  const IndenterLaw law(profile, material), smooth(power_profile(1 / radius, 3), material);
  CHECK(law.force(1e-7) == Approx(smooth.force(1e-7)).epsilon(1e-3));
  CHECK(profile->contact_radius(profile->image(1.1e-3)) == Approx(1.1e-3).epsilon(1e-12));
  CHECK(profile->image_error(1.5e-3) < 1e-3);
  // Every other point of an even number of points leaves out the last one, but the coarser table
  // needs it.
  CHECK(table(80)->image_error(largest) < 1e-3);
  CHECK_THROWS_WITH(law.force(1e-3), Catch::Contains("deeper"));
  CHECK_THROWS_WITH(law.indentation_of(1e6), Catch::Contains("force"));
}

TEST_CASE("The image of a table of a parabola is that of the paraboloid, wherever the edge is",
          "[mdr]") {
  // A parabola is interpolated exactly. The widths of the pieces vary by 8, so that wide pieces lie
  // below narrow ones and above them.
  std::vector<double> radii{0}, heights{0};
  for (int i = 0; i < 90; ++i) {
    radii.push_back(radii.back() + 1e-5 * (i % 10 == 3 ? 8 : 1));
    heights.push_back(radii.back() * radii.back() / (2 * 0.01));
  }
  const TabulatedProfile table(radii, heights);
  const auto exact = paraboloid_profile(0.01);
  // Quadrature leaves 2e-14; slopes at the nodes come from differences of heights, which lose a
  // factor of about 100.
  for (int i = 1; i <= 400; ++i) {
    const double x = table.max_radius() * i / 400.;
    CAPTURE(x);
    CHECK(table.image(x) == Approx(exact->image(x)).epsilon(1e-12));
    CHECK(table.image_slope(x) == Approx(exact->image_slope(x)).epsilon(1e-11));
    CHECK(table.image_integral(x) == Approx(exact->image_integral(x)).epsilon(1e-12));
    CHECK(table.contact_radius(exact->image(x) * (1 - 1e-9)) ==
          Approx(x * (1 - 0.5e-9)).epsilon(1e-12));
  }
}

TEST_CASE("A table with a flat end is a punch at first", "[mdr]") {
  std::vector<double> radii, heights;
  for (int i = 0; i <= 60; ++i) {
    radii.push_back(2e-5 * i);
    heights.push_back(i <= 20 ? 0 : std::pow(2e-5 * (i - 20), 2) / 2e-2);
  }
  const IndenterLaw table(std::make_shared<const TabulatedProfile>(radii, heights), material);
  const IndenterLaw exact(rounded_punch_profile(4e-4, 1e-2), material);
  CHECK(table.contact_radius(1e-15) == Approx(4e-4).epsilon(1e-4));
  CHECK(table.force(1e-6) == Approx(exact.force(1e-6)).epsilon(1e-3));
}

TEST_CASE("Unusable profiles are refused with the row", "[mdr]") {
  std::vector<double> radii{0, 1, 2, 3, 4, 5, 6, 7, 8}, heights{0, 1, 4, 9, 16, 25, 36, 49, 64};
  auto refuse = [&](auto&& spoil, const std::string& reason) {
    auto r = radii, h = heights;
    spoil(r, h);
    CHECK_THROWS_WITH(TabulatedProfile(r, h), Catch::Contains(reason));
  };
  using Column = std::vector<double>;
  refuse([](Column&, Column& h) { h[4] = 8; }, "5 is a row whose height");
  refuse([](Column& r, Column&) { r[3] = 2; }, "4 is a row whose radius");
  refuse([](Column& r, Column&) { r[0] = 0.5; }, "axis");
  refuse([](Column&, Column& h) { h[2] = NAN; }, "3 is a row");
  refuse([](Column& r, Column& h) { r.resize(6), h.resize(6); }, "at least seven");
  refuse([](Column&, Column& h) { h.assign(9, 2.0); }, "flat punch");
  refuse([](Column&, Column& h) { h = {0, 0, 0, 0, 0, 10, 10, 10, 200}; }, "give more points");
  CHECK_THROWS_AS(cone_profile(pi / 2), InvalidInput);
  CHECK_THROWS_AS(paraboloid_profile(0), InvalidInput);
  CHECK_THROWS_AS(power_profile(1, -1), InvalidInput);
  CHECK_THROWS_AS(sphere_profile(std::nan("")), InvalidInput);
  CHECK_THROWS_AS(rounded_punch_profile(1, 0), InvalidInput);
  const IndenterLaw sphere(sphere_profile(1e-2), material);
  CHECK_THROWS_AS(sphere.force(1), InvalidInput);
}
