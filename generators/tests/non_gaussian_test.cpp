// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/generators/random_phase.hpp>
#include <vector>

#include "mode_power.hpp"

using namespace salebra;

namespace {

struct Shape {
  double skewness, kurtosis;
};

template <class Values>
Shape shape_of(const Values& values) {
  double mean = 0, m2 = 0, m3 = 0, m4 = 0;
  for (const double x : values) mean += x / double(values.size());
  for (const double x : values) {
    const double square = (x - mean) * (x - mean);
    m2 += square, m3 += square * (x - mean), m4 += square * square;
  }
  const double n = double(values.size());
  return {m3 / n / std::pow(m2 / n, 1.5), m4 / n / std::pow(m2 / n, 2)};
}

std::vector<double> quantiles(const HeightDistribution& distribution, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(distribution.quantile((k + 0.5) / count));
  return values;
}

std::vector<double> sorted(const Field& heights) {
  std::vector<double> values(heights.data(), heights.data() + heights.size());
  std::sort(values.begin(), values.end());
  return values;
}

const Grid2D grid{64, 81, 1.0, 1.0};

SelfAffineSpectrum rough() {
  return SelfAffineSpectrum({.rolloff = 0.25, .short_cutoff = 1.0 / 16, .rms_height = 2e-6});
}

}  // namespace

TEST_CASE("The normal quantile is the inverse of the normal distribution",
          "[generators][non_gaussian]") {
  for (const double u : {1e-300, 1e-20, 1e-5, 0.02425, 0.3, 0.5, 0.7, 0.99, 1 - 1e-10}) {
    const double x = normal_quantile(u);
    CHECK(std::erfc(-x / std::sqrt(2.0)) / 2 == Approx(u).epsilon(1e-13 * (1 + x * x)));
  }
  CHECK(normal_quantile(0.5) == Approx(0).margin(1e-15));
  // The 97.5 % point is published to ten figures.
  CHECK(normal_quantile(0.975) == Approx(1.959963985).epsilon(1e-9));
  CHECK_THROWS_AS(normal_quantile(0.0), InvalidInput);
}

TEST_CASE("Johnson's curves have the skewness and kurtosis asked", "[generators][non_gaussian]") {
  // Cases: S_U, S_B with one and two humps, both sides of the lognormal line, the line itself, the
  // normal curve, negative skewness.
  const Shape asked = GENERATE(Shape{0, 5}, Shape{0, 1.8}, Shape{0, 1.2}, Shape{0, 3},
                               Shape{0, 2.999}, Shape{1, 4.83}, Shape{1, 3}, Shape{-1, 4},
                               Shape{-0.8, 3.5}, Shape{0.5, 3}, Shape{0.3, 3.16029}, Shape{1.5, 8});
  CAPTURE(asked.skewness, asked.kurtosis);
  const Shape found = shape_of(quantiles(johnson_heights(asked.skewness, asked.kurtosis), 100000));
  // 1e5 quantiles omit tails beyond 4.4 standard deviations, up to 1 % of the fourth moment of the
  // heaviest curve here.
  CHECK(found.skewness == Approx(asked.skewness).epsilon(5e-3).margin(1e-6));
  CHECK(found.kurtosis == Approx(asked.kurtosis).epsilon(0.015));
}

TEST_CASE("No distribution has less kurtosis than its skewness needs",
          "[generators][non_gaussian]") {
  CHECK_THROWS_WITH(johnson_heights(1, 2), Catch::Contains("kurtosis: 2 must exceed"));
  CHECK_THROWS_AS(johnson_heights(2, 5.01), InvalidInput);
  CHECK_THROWS_AS(johnson_heights(std::nan(""), 3), InvalidInput);
  CHECK_THROWS_AS(weibull_heights(0), InvalidInput);
  CHECK_THROWS_AS(sampled_heights({1.0, 1.0}), InvalidInput);
  CHECK_THROWS_AS(sampled_heights({1.0, std::nan("")}), InvalidInput);
}

TEST_CASE("Weibull heights have the moments of their shape", "[generators][non_gaussian]") {
  // Shape 1 is the exponential distribution (skewness 2, kurtosis 9); shape 2 is Rayleigh's
  // (0.6311, 3.2451).
  const Shape exponential = shape_of(quantiles(weibull_heights(1), 200000));
  CHECK(exponential.skewness == Approx(2).epsilon(2e-3));
  CHECK(exponential.kurtosis == Approx(9).epsilon(1e-2));
  const Shape rayleigh = shape_of(quantiles(weibull_heights(2), 200000));
  CHECK(rayleigh.skewness == Approx(0.6311).epsilon(1e-3));
  CHECK(rayleigh.kurtosis == Approx(3.2451).epsilon(1e-3));
}

TEST_CASE("A sampled distribution gives its heights back", "[generators][non_gaussian]") {
  const HeightDistribution distribution = sampled_heights({3.0, 1.0, 2.0, 7.0});
  CHECK(quantiles(distribution, 4) == std::vector<double>{1, 2, 3, 7});
  CHECK(distribution.quantile(0.01) == 1.0);
  CHECK(distribution.quantile(0.75) == 5.0);
}

TEST_CASE("A non-Gaussian surface has the distribution exactly and the spectrum nearly",
          "[generators][non_gaussian]") {
  const auto distribution =
      GENERATE(weibull_heights(1.5), johnson_heights(-0.8, 3.5), gaussian_heights());
  const SelfAffineSpectrum spectrum = rough();
  const NonGaussianSurface result = non_gaussian(grid, spectrum, distribution, 5);
  CHECK(result.converged());
  const double rms = spectrum.lattice_moments(grid).rms_height();
  CHECK(std::abs(result.surface.heights.mean()) < 1e-13 * rms);
  CHECK(std::sqrt(result.surface.heights.square().mean()) == Approx(rms).epsilon(1e-12));
  const Shape expected = shape_of(quantiles(distribution, int(grid.points())));
  const Shape found = shape_of(sorted(result.surface.heights));
  CHECK(found.skewness == Approx(expected.skewness).margin(1e-9));
  CHECK(found.kurtosis == Approx(expected.kurtosis).epsilon(1e-9));

  // Check independently by comparing amplitudes with those of the random-phase surface.
  const FourierCoefficients a(result.surface), target(random_phase(grid, spectrum, 5));
  double difference = 0, total = 0;
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < grid.ny; ++j) {
      difference += std::pow(std::abs(a(i, j)) - std::abs(target(i, j)), 2);
      total += std::norm(target(i, j));
    }
  CHECK(std::sqrt(difference / total) == Approx(result.spectrum_mismatch).epsilon(1e-9));
  const NonGaussianSurface once =
      non_gaussian(grid, spectrum, distribution, 5, {.max_iterations = 1});
  CHECK(result.spectrum_mismatch < 0.7 * once.spectrum_mismatch);
  CHECK(result.spectrum_mismatch < 0.05);
}

TEST_CASE("A non-Gaussian surface can have its spectrum exactly", "[generators][non_gaussian]") {
  const SelfAffineSpectrum spectrum = rough();
  const HeightDistribution distribution = weibull_heights(1.5);
  const NonGaussianSurface result =
      non_gaussian(grid, spectrum, distribution, 5, {.exact = Exact::spectrum});
  const FourierCoefficients a(result.surface), target(random_phase(grid, spectrum, 5));
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < grid.ny; ++j)
      REQUIRE(std::abs(a(i, j)) == Approx(std::abs(target(i, j))).epsilon(1e-11).margin(1e-20));
  const Shape expected = shape_of(quantiles(distribution, int(grid.points())));
  const Shape found = shape_of(sorted(result.surface.heights));
  // Heights deviate by the mismatch, a few per cent of their rms value.
  CHECK(found.skewness == Approx(expected.skewness).margin(0.1));
  CHECK(found.kurtosis == Approx(expected.kurtosis).epsilon(0.1));
}

TEST_CASE(
    "A non-Gaussian surface has the same bits for every number of threads, and can be stopped",
    "[generators][non_gaussian]") {
  const SelfAffineSpectrum spectrum = rough();
  parallel::set_threads(1);
  const Field serial = non_gaussian(grid, spectrum, weibull_heights(2), 1).surface.heights;
  parallel::set_threads(3);
  CHECK((non_gaussian(grid, spectrum, weibull_heights(2), 1).surface.heights == serial).all());
  parallel::set_threads(0);
  const NonGaussianSurface stopped =
      non_gaussian(grid, spectrum, weibull_heights(2), 1,
                   {.on_progress = [](const ProgressReport& report) { return report.step < 2; }});
  CHECK(stopped.termination == Termination::interrupted);
  CHECK(stopped.iterations == 2);
  CHECK_FALSE(stopped.converged());
  // A stop at any report of the third iteration returns the surface of two iterations.
  const Field two =
      non_gaussian(grid, spectrum, weibull_heights(2), 1, {.max_iterations = 2}).surface.heights;
  CHECK((stopped.surface.heights == two).all());
  int reports = 0;
  const auto second = [&](const ProgressReport& report) {
    return report.step < 2 || ++reports < 2;
  };
  CHECK((non_gaussian(grid, spectrum, weibull_heights(2), 1, {.on_progress = second})
             .surface.heights == two)
            .all());
  CHECK(reports == 2);
  CHECK_THROWS_AS(non_gaussian(grid, spectrum, weibull_heights(2), 1,
                               {.on_progress = [](const ProgressReport&) { return false; }}),
                  Interrupted);
}

TEST_CASE("Of all its iterates a non-Gaussian surface is the one nearest to the spectrum",
          "[generators][non-gaussian]") {
  // Ten small cells, each iterated until no step improves the mismatch; the last step of some makes
  // it worse.
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 0.5, .short_cutoff = 0.25, .rms_height = 1});
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    INFO(seed);
    double least = 1e9;
    const NonGaussianSurface found = non_gaussian(
        {16, 16, 1, 1}, spectrum, weibull_heights(1.2), seed,
        {.max_iterations = 200, .tolerance = 0, .on_progress = [&](const ProgressReport& report) {
           // Before the first step there is no mismatch.
           if (report.step > 0) least = std::min(least, report.residual);
           return true;
         }});
    REQUIRE(found.converged());
    CHECK(found.spectrum_mismatch == least);
  }
}

TEST_CASE("A process has its distribution and its spectrum in the mean of its surfaces",
          "[generators][non_gaussian]") {
  const Grid2D square{96, 96, 1.0, 1.0};
  const SelfAffineSpectrum spectrum({.rolloff = 0.1, .short_cutoff = 1.0 / 24, .rms_height = 2e-6});
  const HeightDistribution distribution = johnson_heights(-1.2, 5);
  constexpr int seeds = 60;
  double square_sum = 0, cube = 0, fourth = 0;
  std::vector<double> inner(2, 0), outer(2, 0);  // power of the surfaces, and of the spectrum
  const double of_mode = std::pow(2 * std::numbers::pi, 2);
  for (int seed = 1; seed <= seeds; ++seed) {
    const NonGaussianSurface made = non_gaussian(square, spectrum, distribution,
                                                 std::uint64_t(seed), {.exact = Exact::process});
    CHECK(made.converged());
    const Field& h = made.surface.heights;
    CHECK(std::abs(h.mean()) < 1e-20);
    square_sum += h.square().mean(), cube += h.cube().mean(), fourth += h.square().square().mean();
    const FourierCoefficients modes(made.surface);
    for (Index i = -24; i <= 24; ++i)
      for (Index j = -24; j <= 24; ++j) {
        const double wave = std::hypot(double(i), double(j));
        if (wave == 0 || wave > 23.5) continue;
        std::vector<double>& ring = wave < 10 ? inner : outer;
        ring[0] += std::norm(modes(i, j)) / seeds;
        ring[1] +=
            of_mode *
            spectrum.density(2 * std::numbers::pi * double(i), 2 * std::numbers::pi * double(j)) /
            seeds;
      }
  }
  // 300 independent modes (outer ring: 1400) in each of 60 surfaces give the powers a standard
  // error of 1 % (0.5 %), and the corrected spectrum is off by up to 1 % there. A surface has some
  // 100 independent hills, so that the mean skewness and kurtosis of 60 have the errors 0.03, 0.2.
  CHECK(inner[0] == Approx(inner[1]).epsilon(0.04));
  CHECK(outer[0] == Approx(outer[1]).epsilon(0.03));
  const double variance = square_sum / seeds;
  CHECK(std::sqrt(variance) == Approx(spectrum.lattice_moments(square).rms_height()).epsilon(0.02));
  CHECK(cube / seeds / std::pow(variance, 1.5) == Approx(-1.2).margin(0.12));
  CHECK(fourth / seeds / (variance * variance) == Approx(5).margin(0.6));
}

TEST_CASE("A process has the same surface for any number of threads and on a finer grid",
          "[generators][non_gaussian]") {
  const auto made_on = [](Index n) {
    const SelfAffineSpectrum spectrum({.rolloff = 0.25, .short_cutoff = 1.0 / 12, .rms_height = 1});
    return non_gaussian({n, n, 1.0, 1.0}, spectrum, johnson_heights(-1, 4), 3,
                        {.exact = Exact::process})
        .surface.heights;
  };
  const Field once = made_on(64), fine = made_on(128);
  const int before = parallel::threads();
  parallel::set_threads(before == 1 ? 2 : 1);
  const Field again = made_on(64);
  parallel::set_threads(before);
  CHECK((once == again).all());
  // The harmonics of the transform differ where the coarse grid does not carry them.
  const Field common = fine(Eigen::seqN(0, 64, 2), Eigen::seqN(0, 64, 2));
  CHECK((common - once).abs().maxCoeff() < 0.02);
}
