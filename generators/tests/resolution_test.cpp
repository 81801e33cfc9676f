// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>

using namespace salebra;

namespace {

using Generator = Surface (*)(const Grid2D&, const Spectrum&, std::uint64_t, const Progress&,
                              const Communicator&);

double rms(const Field& field) { return std::sqrt(field.square().mean()); }

}  // namespace

TEST_CASE("A surface has the same bits for every number of threads", "[generators][threads]") {
  const Generator generate = GENERATE(&filtered_noise, &random_phase);
  const Grid2D grid = GENERATE(Grid2D{128, 96, 1.0, 1.0}, Grid2D{75, 81, 1.0, 1.0});
  const SelfAffineSpectrum spectrum(
      {.rolloff = 0.5, .short_cutoff = 2 * std::max(grid.dx(), grid.dy()), .rms_height = 1.0});
  parallel::set_threads(1);
  const Field serial = generate(grid, spectrum, 12, {}, {}).heights;
  for (const int threads : {2, 3, 7}) {
    parallel::set_threads(threads);
    CHECK((generate(grid, spectrum, 12, {}, {}).heights == serial).all());
  }
  parallel::set_threads(0);
}

TEST_CASE("Refining the grid keeps the heights at common points", "[generators][resolution]") {
  const Generator generate = GENERATE(&filtered_noise, &random_phase);
  struct Pair {
    Grid2D coarse;
    Index factor_x, factor_y;
  };
  const Pair pair = GENERATE(Pair{{256, 256, 1e-3, 1e-3}, 2, 2}, Pair{{81, 75, 1e-3, 8e-4}, 3, 2},
                             Pair{{64, 45, 1e-3, 1e-3}, 1, 5});
  const SelfAffineSpectrum spectrum(
      {.rolloff = 5e-4,
       .short_cutoff = 2.01 * std::max(pair.coarse.dx(), pair.coarse.dy()),
       .rms_height = 1e-6});
  Grid2D fine = pair.coarse;
  fine.nx *= pair.factor_x;
  fine.ny *= pair.factor_y;
  const Field coarse_heights = generate(pair.coarse, spectrum, 8, {}, {}).heights;
  const Field fine_heights = generate(fine, spectrum, 8, {}, {}).heights;
  double worst = 0;
  for (Index x = 0; x < pair.coarse.nx; ++x)
    for (Index y = 0; y < pair.coarse.ny; ++y)
      worst = std::max(worst, std::abs(coarse_heights(x, y) -
                                       fine_heights(x * pair.factor_x, y * pair.factor_y)));
  // Two transforms compute the same sum, each to a few 1e-16 of the rms height.
  CHECK(worst < 1e-13 * rms(coarse_heights));
}

TEST_CASE("Extending the spectrum adds short waves and leaves the long ones",
          "[generators][resolution]") {
  const Grid2D grid{128, 128, 1.0, 1.0};
  SelfAffineParameters parameters{.rolloff = 0.25, .short_cutoff = 1.0 / 16, .rms_height = 1.0};
  const SelfAffineSpectrum narrow(parameters);
  // The rms height with which the wider spectrum has the same plateau.
  parameters.short_cutoff = 1.0 / 64;
  const double trial = SelfAffineSpectrum(parameters).plateau();
  parameters.rms_height = std::sqrt(narrow.plateau() / trial);
  const SelfAffineSpectrum wide(parameters);
  parameters.long_cutoff = 1.0 / 16 * (1 - 1e-6);
  const Field difference =
      filtered_noise(grid, wide, 4).heights - filtered_noise(grid, narrow, 4).heights;
  const double added = wide.lattice_moments(grid).moment0 - narrow.lattice_moments(grid).moment0;
  // The added Gaussian band has some 12000 modes, so its mean square scatters by √(2/12000), 1.3 %,
  // and more because a few modes hold most of the power.
  CHECK(difference.square().mean() == Approx(added).epsilon(0.1));
}

TEST_CASE("Seeds make different surfaces, 0 and 1 and the upper half of the bits included",
          "[generators][seed]") {
  const Grid2D grid{64, 64, 1.0, 1.0};
  const SelfAffineSpectrum spectrum({.rolloff = 0.25, .short_cutoff = 1.0 / 16, .rms_height = 1.0});
  const Field first = filtered_noise(grid, spectrum, 0).heights;
  for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{1} << 32}) {
    const Field other = filtered_noise(grid, spectrum, seed).heights;
    const double correlation = (first * other).mean() / (rms(first) * rms(other));
    // About 60 independent modes carry most of the power, so a chance correlation is about 1/√60.
    CHECK(std::abs(correlation) < 0.5);
  }
}
