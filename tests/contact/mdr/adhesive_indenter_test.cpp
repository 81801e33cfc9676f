// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/adhesive_indenter.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {
constexpr double modulus = 5e6, work = 0.05, radius = 1e-4;
}

TEST_CASE("JKR of a paraboloid is the closed form of Johnson, Kendall and Roberts",
          "[adhesive_indenter]") {
  const auto paraboloid = paraboloid_profile(radius);
  for (const double a : {1e-6, 1e-5, 4e-5}) {
    const AdhesivePoint point = jkr_contact(*paraboloid, modulus, work, a);
    CHECK(point.force == Approx(4 * modulus * std::pow(a, 3) / (3 * radius) -
                                std::sqrt(8 * pi * work * modulus * std::pow(a, 3))));
    CHECK(point.indentation == Approx(a * a / radius - std::sqrt(2 * pi * work * a / modulus)));
    // The paper's equation of the load, a³ = (3R/4E*)(F + 3πwR + √(6πwRF + (3πwR)²)), on the stable
    // branch.
    const double scale = 3 * pi * work * radius;
    if (a > 1.3e-5)
      CHECK(std::pow(a, 3) ==
            Approx(3 * radius / (4 * modulus) *
                   (point.force + scale + std::sqrt(2 * scale * point.force + scale * scale))));
  }
  const AdhesivePoint off = jkr_pull_off(*paraboloid, modulus, work);
  CHECK(off.force == Approx(-1.5 * pi * work * radius).epsilon(1e-12));
  CHECK(std::pow(off.contact_radius, 3) ==
        Approx(9 * pi * work * radius * radius / (8 * modulus)).epsilon(1e-7));
}

TEST_CASE("JKR of power-law profiles comes off at the force of its exponent",
          "[adhesive_indenter]") {
  // With g = c aⁿ: n c aⁿ = (3/2) d, d = √(2πwa/E*), and F = 2E*a[cn aⁿ/(n + 1) − d] = −(2n − 1)/(n
  // + 1)·E*a·d, where (2n − 1)/(n + 1) is 1 for a paraboloid and 1/2 for a cone.
  const double n = GENERATE(1.0, 1.5, 2.0, 4.0);
  const double reference = 1e-5;
  const auto profile = power_profile(reference / std::pow(1e-4, n), n);
  const AdhesivePoint off = jkr_pull_off(*profile, modulus, work);
  const double a = off.contact_radius, d = std::sqrt(2 * pi * work * a / modulus);
  CHECK(n * profile->image(a) == Approx(1.5 * d).epsilon(1e-9));
  CHECK(off.force == Approx(-(2 * n - 1) / (n + 1) * modulus * a * d).epsilon(1e-9));
  // The force at pull-off is the minimum.
  for (const double factor : {0.9, 1.1})
    CHECK(jkr_contact(*profile, modulus, work, factor * a).force > off.force);
  if (n == 1) {
    // A cone of angle θ to the plane has F = −54 w²/(πE* tan³θ) [Maugis and Barquins].
    const auto cone = cone_profile(0.3);
    CHECK(jkr_pull_off(*cone, modulus, work).force ==
          Approx(-54 * work * work / (pi * modulus * std::pow(std::tan(0.3), 3))).epsilon(1e-9));
  }
}

TEST_CASE("A flat punch comes off at Kendall's force", "[adhesive_indenter]") {
  const auto punch = flat_punch_profile(radius);
  CHECK(jkr_pull_off(*punch, modulus, work).force ==
        Approx(-std::sqrt(8 * pi * modulus * work * std::pow(radius, 3))));
}

TEST_CASE("Maugis and Dugdale's adhesion goes from DMT to JKR", "[adhesive_indenter]") {
  const auto range_of = [](double tabor) {
    return std::cbrt(radius * work * work / (modulus * modulus)) / tabor;
  };
  double before = -2.0;
  for (const double tabor : {1e-4, 0.003, 0.03, 0.1, 0.3, 1.0, 3.0, 30.0, 300.0}) {
    const MaugisDugdale model(radius, modulus, work, range_of(tabor));
    CHECK(tabor_parameter(radius, modulus, work, range_of(tabor)) == Approx(tabor));
    // λ = (9/(2π))^(1/3) μ for the same range.
    CHECK(model.transition_parameter() == Approx(std::cbrt(9 / (2 * pi)) * tabor));
    const double off = model.pull_off().force / (pi * work * radius);
    CAPTURE(tabor, off);
    CHECK(off > before);
    CHECK(off < -1.5);
    before = off;
    for (const double a : {1e-5, 3e-5}) {
      const AdhesivePoint point = model.contact(a);
      CHECK(point.zone_radius > a);
      // The tension outside acts on the contact in proportion to the root of λ.
      if (tabor < 1e-3) {
        const AdhesivePoint dmt = dmt_contact(radius, modulus, work, a);
        CHECK(point.force == Approx(dmt.force).margin(0.02 * pi * work * radius));
        CHECK(point.indentation == Approx(dmt.indentation).margin(0.02 * dmt.indentation + 1e-8));
      }
      if (tabor > 100) {
        const AdhesivePoint jkr = jkr_contact(*paraboloid_profile(radius), modulus, work, a);
        CHECK(point.force == Approx(jkr.force).margin(0.02 * pi * work * radius));
        CHECK(point.indentation == Approx(jkr.indentation).epsilon(0.01));
      }
    }
  }
  CHECK(MaugisDugdale(radius, modulus, work, range_of(1e-3)).pull_off().force ==
        Approx(-2 * pi * work * radius).epsilon(2e-3));
  CHECK(MaugisDugdale(radius, modulus, work, range_of(1e3)).pull_off().force ==
        Approx(-1.5 * pi * work * radius).epsilon(2e-3));
}

TEST_CASE("The zone of Maugis and Dugdale ends where the gap is its range", "[adhesive_indenter]") {
  // An independent route to the gap at c: the displacement of half-space and indenter there.
  // Hertz's pressure of radius a gives u_1(c) = (1/πR)[a√(c² − a²) + (2a² − c²) asin(a/c)]. The
  // constant tension σ within c and its balance within a, Sneddon's crack, open the edge by
  // (4σ/πE*)[√(c² − a²) acos(a/c) + a − c]. The first equation is ρ = c²/2R − a²/R + u_1 + u_2.
  for (const double range : {1e-8, 1e-7, 1e-6}) {
    const MaugisDugdale model(radius, modulus, work, range);
    for (const double a : {5e-6, 2e-5}) {
      const double c = model.contact(a).zone_radius, sigma = work / range;
      const double s = std::sqrt(c * c - a * a);
      const double hertz = (a * s + (c * c - 2 * a * a) * std::acos(a / c)) / (pi * radius);
      const double opened = 4 * sigma / (pi * modulus) * (s * std::acos(a / c) + a - c);
      CHECK(hertz + opened == Approx(range).epsilon(1e-7));
    }
  }
}

TEST_CASE("Closed forms of adhesion refuse what has no meaning", "[adhesive_indenter]") {
  const auto paraboloid = paraboloid_profile(radius);
  CHECK_THROWS_AS(jkr_contact(*paraboloid, modulus, 0, 1e-5), InvalidInput);
  CHECK_THROWS_AS(jkr_contact(*paraboloid, modulus, work, 0), InvalidInput);
  CHECK_THROWS_AS(dmt_contact(radius, modulus, work, -1), InvalidInput);
  CHECK_THROWS_AS(MaugisDugdale(radius, modulus, work, 0), InvalidInput);
  CHECK_THROWS_AS(tabor_parameter(0, modulus, work, 1e-9), InvalidInput);
  CHECK(suggested_model(0.01) == AdhesionModel::dmt);
  CHECK(suggested_model(1) == AdhesionModel::maugis_dugdale);
  CHECK(suggested_model(10) == AdhesionModel::jkr);
}
