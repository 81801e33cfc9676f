// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>

using namespace salebra;

namespace {

const Material soft = Material::of_contact_modulus(1.0, 0.3);

SummitEnsemble ensemble_of(SummitDistribution distribution) {
  SummitEnsemble ensemble{.summit_density = 300,
                          .radius = 2,
                          .summit_rms = 1,
                          .mean_height = 3,
                          .distribution = distribution};
  if (distribution == SummitDistribution::tabulated)
    ensemble.table = {{-1, 0.5}, {0, 2}, {2, 0}, {2.5, 0}, {3, 0.1}};
  return ensemble;
}

}  // namespace

TEST_CASE("Drawn summits press as their ensemble does, within the scatter that they show",
          "[sampling]") {
  const auto distribution = GENERATE(SummitDistribution::gaussian, SummitDistribution::exponential,
                                     SummitDistribution::tabulated);
  const SummitEnsemble ensemble = ensemble_of(distribution);
  const MonteCarloCurve drawn =
      monte_carlo_curve(ensemble, soft, 1, {1.2, 0, 0.5}, {.realisations = 200, .seed = 3});
  const StatisticalSummits exact(ensemble, soft, 1);
  REQUIRE(drawn.mean.samples.size() == 3);
  CHECK(drawn.summits == 300);
  for (std::size_t i = 0; i < 3; ++i) {
    const ForceSample& mean = drawn.mean.samples[i];
    const AsperityContact expected = exact.at(mean.separation);
    // The 95 % interval is two standard errors; one of 16,000 comparisons exceeds four of them.
    // comparisons.
    CHECK(mean.force ==
          Approx(expected.force).margin(2 * drawn.interval(drawn.deviation[i].force)));
    CHECK(mean.normal_stiffness ==
          Approx(expected.normal_stiffness)
              .margin(2 * drawn.interval(drawn.deviation[i].normal_stiffness)));
    CHECK(
        mean.contact_area_fraction ==
        Approx(expected.contact_area).margin(2 * drawn.interval(drawn.deviation[i].contact_area)));
    // N is binomial: its variance is known, and 200 values estimate a deviation to 1/√400 = 5 %.
    const double share = expected.contacts / 300;
    CHECK(drawn.deviation[i].contacts ==
          Approx(std::sqrt(300 * share * (1 - share))).epsilon(0.2).margin(1e-12));
    CHECK(mean.mean_gap == Approx(mean.separation + 3));
    CHECK(mean.indentation == -mean.separation);
  }
  CHECK(drawn.mean.samples[0].separation == 1.2);
  CHECK(std::isnan(drawn.deviation[0].force_curvature));
  // Student's t for 199 degrees of freedom.
  CHECK(drawn.interval(1) == Approx(1.971957 / std::sqrt(200.0)).epsilon(1e-6));
}

TEST_CASE("Drawn heights have the moments of their density", "[sampling]") {
  const int count = 40000;
  auto moments = [&](SummitDistribution distribution) {
    double mean = 0, square = 0;
    for (const Summit& summit : draw_summits(ensemble_of(distribution), count, 5, 1)) {
      mean += summit.height / count;
      square += summit.height * summit.height / count;
      REQUIRE((summit.x > 0 && summit.x < 5 && summit.y > 0 && summit.y < 5));
    }
    return std::pair{mean, square};
  };
  // Standard errors: 1/200 of the deviation for the mean, √(⟨z⁴⟩ − ⟨z²⟩²)/200 for the square. The
  // test allows four of them.
  const auto gaussian = moments(SummitDistribution::gaussian);
  CHECK(gaussian.first == Approx(0).margin(0.02));
  CHECK(gaussian.second == Approx(1).margin(0.03));
  const auto exponential = moments(SummitDistribution::exponential);
  CHECK(exponential.first == Approx(1).margin(0.02));
  CHECK(exponential.second == Approx(2).margin(0.09));
}

TEST_CASE("Realisations do not depend on threads, and differ from each other", "[sampling]") {
  const SummitEnsemble ensemble = ensemble_of(SummitDistribution::gaussian);
  auto force = [&](int threads) {
    parallel::set_threads(threads);
    const MonteCarloCurve curve = monte_carlo_curve(ensemble, soft, 1, {0.4}, {.realisations = 9});
    parallel::set_threads(0);
    return std::pair{curve.mean.samples[0].force, curve.deviation[0].force};
  };
  CHECK(force(1) == force(2));
  CHECK(force(1).second > 0);
  CHECK(draw_summits(ensemble, 1, 1, 1, 0)[0].height !=
        draw_summits(ensemble, 1, 1, 1, 1)[0].height);
  CHECK(draw_summits(ensemble, 1, 1, 1)[0].height != draw_summits(ensemble, 1, 1, 2)[0].height);
}

TEST_CASE("Heights of drawn summits have nothing to do with their places", "[sampling]") {
  const auto distribution = GENERATE(SummitDistribution::gaussian, SummitDistribution::exponential);
  const int count = 4000;
  const std::vector<Summit> summits = draw_summits(ensemble_of(distribution), count, 1, 5);
  double height = 0;
  for (const Summit& summit : summits) height += summit.height / count;
  double with_x = 0, with_y = 0, x_with_y = 0;
  for (const Summit& summit : summits) {
    with_x += (summit.x - 0.5) * (summit.height - height) * std::sqrt(12) / count;
    with_y += (summit.y - 0.5) * (summit.height - height) * std::sqrt(12) / count;
    x_with_y += (summit.x - 0.5) * (summit.y - 0.5) * 12 / count;
  }
  // Correlation coefficients (σ = 1) have the standard deviation 1/√4000 = 0.016; the test allows
  // four.
  CHECK(std::abs(with_x) < 0.064);
  CHECK(std::abs(with_y) < 0.064);
  CHECK(std::abs(x_with_y) < 0.064);
}

TEST_CASE("The scatter of two realisations is their difference over √2", "[sampling]") {
  const SummitEnsemble ensemble = ensemble_of(SummitDistribution::gaussian);
  const MonteCarloCurve curve =
      monte_carlo_curve(ensemble, soft, 1, {0.4}, {.realisations = 2, .seed = 6});
  double force[2];
  for (int realisation = 0; realisation < 2; ++realisation) {
    const DeterministicSummits drawn(draw_summits(ensemble, 300, 1, 6, realisation), soft, 1);
    force[realisation] = drawn.at(0.4 - drawn.common().mean_height).force;
  }
  CHECK(curve.mean.samples[0].force == Approx((force[0] + force[1]) / 2).epsilon(1e-13));
  CHECK(curve.deviation[0].force ==
        Approx(std::abs(force[0] - force[1]) / std::sqrt(2)).epsilon(1e-10));
}

TEST_CASE("Sampling says what it cannot draw", "[sampling]") {
  const SummitEnsemble ensemble = ensemble_of(SummitDistribution::gaussian);
  CHECK_THROWS_AS(draw_summits(ensemble, 0, 1, 1), InvalidInput);
  CHECK_THROWS_AS(monte_carlo_curve(ensemble, soft, 1, {0}, {.realisations = 1}), InvalidInput);
  CHECK_THROWS_WITH(monte_carlo_curve(ensemble, soft, 1e9, {0}), Catch::Contains("too many"));
}
