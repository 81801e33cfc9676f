// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

const Material soft = Material::of_contact_modulus(1.5, 0.3);

}  // namespace

TEST_CASE("Equal sides give Greenwood and Tripp's (16√2/15)π(ηβσ)²E*√(σ/β)F_{5/2}",
          "[greenwood-tripp]") {
  const double density = 40, radius = 0.7, sigma = 0.2;  // σ of the sum
  const SummitEnsemble side{.summit_density = density,
                            .radius = radius,
                            .summit_rms = sigma / std::sqrt(2.0),
                            .mean_height = 1};
  const GreenwoodTripp contact(side, side, soft, 3);
  const double number = density * radius * sigma;
  // F_n(0) = 2^{n/2} Γ((n+1)/2)/(2√π)
  auto at_zero = [](double n) {
    return std::pow(2, n / 2) * std::tgamma((n + 1) / 2) / (2 * std::sqrt(pi));
  };
  const AsperityContact touch = contact.at(0);
  CHECK(touch.force == Approx(3 * 16 * std::sqrt(2.0) / 15 * pi * number * number * 1.5 *
                              std::sqrt(sigma / radius) * at_zero(2.5))
                           .epsilon(1e-11));
  CHECK(touch.contact_area == Approx(3 * pi * pi * number * number * at_zero(2)).epsilon(1e-11));
  CHECK(touch.contacts ==
        Approx(3 * 4 * pi * density * density * radius * sigma * at_zero(1)).epsilon(1e-11));
  CHECK(contact.mean_gap(0.3) == Approx(2.3));
}

TEST_CASE("Two rough sides are an integral of one over the offset of their summits",
          "[greenwood-tripp]") {
  const SummitEnsemble first{.summit_density = 5, .radius = 0.7, .summit_rms = 0.2};
  const SummitEnsemble second{.summit_density = 8, .radius = 1.9, .summit_rms = 0.35};
  const GreenwoodTripp contact(first, second, soft, 1);
  // A pair at the offset r acts as one summit of the summed height on a plane that is r²/(2(R1+R2))
  // farther away.
  const double radii = first.radius + second.radius;
  const StatisticalSummits at_offset(
      {.summit_density = first.summit_density * second.summit_density,
       .radius = first.radius * second.radius / radii,
       .summit_rms = std::hypot(0.2, 0.35)},
      soft, 1);
  const double separation = GENERATE(-0.3, 0.1, 0.8);
  AsperityContact sum;
  // Simpson's rule in r; the integrand is smooth, and below 1e-14 beyond r²/(2·2.6) = 4.
  const int steps = 400;
  const double step = 4.6 / steps;
  for (int i = 0; i <= steps; ++i) {
    const double r = i * step, weight = (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * step / 3;
    const AsperityContact part = at_offset.at(separation + r * r / (2 * radii));
    sum.contacts += weight * 2 * pi * r * part.contacts;
    sum.contact_area += weight * 2 * pi * r * part.contact_area;
    sum.force += weight * 2 * pi * r * part.force;
    sum.normal_stiffness += weight * 2 * pi * r * part.normal_stiffness;
    sum.force_curvature += weight * 2 * pi * r * part.force_curvature;
  }
  const AsperityContact exact = contact.at(separation);
  CHECK(exact.contacts == Approx(sum.contacts).epsilon(1e-8));
  CHECK(exact.contact_area == Approx(sum.contact_area).epsilon(1e-8));
  CHECK(exact.force == Approx(sum.force).epsilon(1e-8));
  CHECK(exact.normal_stiffness == Approx(sum.normal_stiffness).epsilon(1e-8));
  CHECK(exact.force_curvature == Approx(sum.force_curvature).epsilon(1e-8));
}

TEST_CASE("The two sides may be exchanged, but not be other than Gaussian", "[greenwood-tripp]") {
  SummitEnsemble first{.summit_density = 5, .radius = 0.7, .summit_rms = 0.2};
  const SummitEnsemble second{.summit_density = 8, .radius = 1.9, .summit_rms = 0.35};
  CHECK(GreenwoodTripp(first, second, soft, 1).force(0.2) ==
        Approx(GreenwoodTripp(second, first, soft, 1).force(0.2)).epsilon(1e-14));
  // The heights of two independent sides add, and so do their variances.
  first.mean_height = 0.3;
  first.rms_height = 0.3;
  SummitEnsemble other = second;
  other.mean_height = 0.5;
  other.rms_height = 0.4;
  const GreenwoodTripp both(first, other, soft, 1);
  CHECK(both.common().rms_height == Approx(0.5).epsilon(1e-14));
  CHECK(both.common().mean_height == Approx(0.8).epsilon(1e-14));
  first.distribution = SummitDistribution::exponential;
  CHECK_THROWS_WITH(GreenwoodTripp(first, second, soft, 1), Catch::Contains("distribution"));
  first = {};
  CHECK_THROWS_AS(GreenwoodTripp(second, first, soft, 1), InvalidInput);
}
