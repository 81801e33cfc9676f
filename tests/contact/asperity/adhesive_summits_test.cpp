// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/adhesive_summits.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

const Material body = Material::of_contact_modulus(2.0, 0.3);
constexpr double work = 0.03, radius = 1.5, density = 4;

SummitEnsemble summits(double sigma,
                       SummitDistribution distribution = SummitDistribution::gaussian) {
  return {.summit_density = density,
          .radius = radius,
          .summit_rms = sigma,
          .distribution = distribution};
}

/// Distance by which a JKR summit is stretched before it comes off at a given position.
const double reach = 0.75 * std::cbrt(std::pow(pi * work / 2.0, 2) * radius);

/// JKR's force at an indentation, by bisection of δ(a) on the stable branch.
double jkr_force(double indentation) {
  double low = std::cbrt(pi * work * radius * radius / (8 * 2.0)), high = 10;
  for (int step = 0; step < 80; ++step) {
    const double a = (low + high) / 2;
    (a * a / radius - std::sqrt(2 * pi * work * a / 2.0) < indentation ? low : high) = a;
  }
  return 4 * 2.0 * low * low * low / (3 * radius) -
         std::sqrt(8 * pi * work * 2.0 * low * low * low);
}

}  // namespace

TEST_CASE("Adhesive summits of one height come off together", "[adhesive-summits]") {
  // Fuller and Tabor's limit for a smooth surface, and the DMT limit.
  const double all = density * pi * work * radius;
  CHECK(AdhesiveSummits(summits(1e-4 * reach), body, 3, SummitAdhesion::jkr, work, true)
            .pull_off_pressure() == Approx(1.5 * all).epsilon(1e-5));
  CHECK(AdhesiveSummits(summits(1e-4 * reach), body, 3, SummitAdhesion::dmt, work, true)
            .pull_off_pressure() == Approx(2 * all).epsilon(1e-3));
}

TEST_CASE("The force of adhesive summits is the integral of one over their heights",
          "[adhesive-summits]") {
  const double sigma = GENERATE(0.3, 1.0, 3.0) * reach,
               separation = GENERATE(-1.0, 0.4, 2.0) * sigma;
  const bool unloading = GENERATE(true, false);
  const AdhesiveSummits model(summits(sigma), body, 3, SummitAdhesion::jkr, work, unloading);
  // Simpson's rule in t with δ = δ_c + t², because the force starts from its end like a root.
  const double least = unloading ? -reach : 0;
  const double end = std::sqrt(9 * sigma - separation - least);
  constexpr int steps = 2000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double t = end * i / steps, z = separation + least + t * t;
    sum += (i == 0 || i == steps ? 1
            : i % 2              ? 4
                                 : 2) *
           2 * t * jkr_force(least + t * t) * std::exp(-z * z / (2 * sigma * sigma));
  }
  sum *= 3 * density * end / (3 * steps) / (std::sqrt(2 * pi) * sigma);
  CHECK(model.force(separation) ==
        Approx(sum).epsilon(1e-6).margin(1e-7 * 3 * density * pi * work * radius));
}

TEST_CASE("Adhesive summits without work are Greenwood and Williamson's", "[adhesive-summits]") {
  const StatisticalSummits hertz(summits(0.2), body, 3);
  for (const SummitAdhesion adhesion : {SummitAdhesion::jkr, SummitAdhesion::dmt}) {
    const AdhesiveSummits model(summits(0.2), body, 3, adhesion, 1e-12, false);
    const AsperityContact one = model.at(0.3), other = hertz.at(0.3);
    CHECK(one.force == Approx(other.force).epsilon(1e-4));
    CHECK(one.contact_area == Approx(other.contact_area).epsilon(1e-4));
    CHECK(one.normal_stiffness == Approx(other.normal_stiffness).epsilon(1e-4));
    CHECK(one.contacts == Approx(other.contacts).epsilon(1e-4));
  }
}

TEST_CASE("Exponential heights of DMT neither pull nor press at one work of adhesion",
          "[adhesive-summits]") {
  // ∫[(4/3)E*√R δ^{3/2} − 2πwR] e^{−δ/σ} dδ vanishes at every separation for w =
  // E*σ^{3/2}/(2√(πR)).
  const double sigma = 0.2, critical = 2.0 * std::pow(sigma, 1.5) / (2 * std::sqrt(pi * radius));
  const auto force = [&](double factor) {
    return AdhesiveSummits(summits(sigma, SummitDistribution::exponential), body, 3,
                           SummitAdhesion::dmt, factor * critical, false)
        .force(0.3);
  };
  CHECK(std::abs(force(1)) < 1e-8 * std::abs(force(0.5)));
  CHECK(force(0.9) > 0);
  CHECK(force(1.1) < 0);
}

TEST_CASE("The pull-off of Fuller and Tabor falls with roughness", "[adhesive-summits]") {
  // Relative to δ_c: as in their figure, a roughness of about one δ_c reduces the pull-off to a
  // half, three reduce it to a few hundredths.
  double before = 1;
  for (const double sigma : {0.25, 0.5, 1.0, 2.0, 3.0}) {
    const AdhesiveSummits model(summits(sigma * reach), body, 1, SummitAdhesion::jkr, work, true);
    const double relative = model.pull_off_pressure() / (density * 1.5 * pi * work * radius);
    CAPTURE(sigma, relative);
    CHECK(relative < before);
    before = relative;
    // Summits that approach pull no more than summits that are drawn apart.
    CHECK(AdhesiveSummits(summits(sigma * reach), body, 1, SummitAdhesion::jkr, work, false)
              .pull_off_pressure() <= model.pull_off_pressure());
  }
  CHECK(before < 0.1);
  CHECK_THROWS_AS(AdhesiveSummits(summits(1), body, 1, SummitAdhesion::jkr, 0, true), InvalidInput);
}
