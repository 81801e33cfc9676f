// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/composite.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/generators/random_phase.hpp>
#include <vector>

#include "ranks_in_threads.hpp"

using namespace salebra;
using salebra::testing::run_ranks;
using salebra::testing::stop_one;

namespace {

using Make =
    std::function<Surface(const Grid2D&, const Spectrum&, const Progress&, const Communicator&)>;

// All generators of a surface.
std::vector<Make> ways() {
  constexpr std::uint64_t seed = 12;
  const auto noise = [](const Grid2D& grid, const Spectrum& spectrum, const Progress& told,
                        const Communicator& ranks) {
    return filtered_noise(grid, spectrum, seed, told, ranks);
  };
  std::vector<Make> all{noise, [](const Grid2D& grid, const Spectrum& spectrum,
                                  const Progress& told, const Communicator& ranks) {
                          return random_phase(grid, spectrum, seed, told, ranks);
                        }};
  for (const Rms which : {Rms::height, Rms::slope}) {
    all.push_back([=](const Grid2D& grid, const Spectrum& spectrum, const Progress& told,
                      const Communicator& ranks) {
      return exact_rms(grid, spectrum, seed, which, told, ranks);
    });
    all.push_back([=](const Grid2D& grid, const Spectrum& spectrum, const Progress& told,
                      const Communicator& ranks) {
      return scale_to_rms(noise(grid, spectrum, told, ranks), which, 0.1);
    });
  }
  return all;
}

// Cells have the size 1/points. The shortest wave spans two of the longer cells, which gives a
// Nyquist line power.
std::shared_ptr<const Spectrum> spectrum_of(int kind, const Grid2D& grid) {
  const double shortest = 2 * std::max(grid.dx(), grid.dy()),
               highest = 2 * std::numbers::pi / shortest;
  const auto self_affine = std::make_shared<SelfAffineSpectrum>(
      SelfAffineParameters{.hurst = 0.7,
                           .rolloff = 0.5,
                           .short_cutoff = shortest * (1 + (kind == 1)),
                           .rms_slope = 0.1});
  switch (kind) {
    case 0:
      return self_affine;
    case 1:
      return std::make_shared<AnisotropicSpectrum>(
          self_affine, Anisotropy{.along = 1.5, .across = 1, .angle = 0.4});
    case 2:
      return std::make_shared<TabulatedSpectrum>(std::vector{3.0, 0.4 * highest, highest},
                                                 std::vector{1e-3, 1e-4, 1e-6});
    default:
      return std::make_shared<FunctionSpectrum>(
          exponential_correlation_spectrum(1e-6, 0.1, shortest));
  }
}

}  // namespace

TEST_CASE("A surface made by several processes has the bits of one process",
          "[generators][share]") {
  const Grid2D grid = GENERATE(Grid2D{64, 64, 1, 1}, Grid2D{96, 50, 1.5, 1}, Grid2D{101, 64, 1, 1},
                               Grid2D{16, 16, 1, 1});
  const int kind = GENERATE(0, 1, 2, 3);
  const auto spectrum = spectrum_of(kind, grid);
  for (const Make& make : ways()) {
    const Surface alone = make(grid, *spectrum, {}, {});
    REQUIRE(alone.heights.square().sum() > 0);
    for (const int ranks : {1, 2, 3, 4, 5, 8})
      for (const int threads : {1, 2}) {
        CAPTURE(grid.nx, grid.ny, kind, ranks, threads, alone.origin);
        parallel::set_threads(threads);
        std::atomic<int> right = 0;
        run_ranks(ranks, [&](const Communicator& together) {
          const Surface mine = make(grid, *spectrum, {}, together);
          const RowPartition rows = mine.partition();
          right +=
              mine.communicator.size() == ranks && mine.grid == alone.grid &&
              mine.periodic == alone.periodic && mine.origin == alone.origin &&
              mine.heights.rows() == rows.count() && mine.heights.cols() == grid.ny &&
              (rows.count() == 0 ||
               std::memcmp(mine.heights.data(), alone.heights.data() + rows.begin() * grid.ny,
                           static_cast<std::size_t>(mine.heights.size()) * sizeof(double)) == 0);
        });
        CHECK(right == ranks);
      }
  }
  parallel::set_threads(0);
}

TEST_CASE("Moments of the lattice have the bits of one process", "[generators][share]") {
  const Grid2D grid = GENERATE(Grid2D{96, 50, 1.5, 1}, Grid2D{64, 320, 1, 1});
  const auto spectrum = spectrum_of(GENERATE(0, 1), grid);
  const SpectralMoments alone = spectrum->lattice_moments(grid);
  for (const int ranks : {2, 3, 8}) {
    std::atomic<int> right = 0;
    run_ranks(ranks, [&](const Communicator& together) {
      const SpectralMoments moments = spectrum->lattice_moments(grid, {}, together);
      right += std::memcmp(&moments, &alone, sizeof alone) == 0;
    });
    CHECK(right == ranks);
  }
}

TEST_CASE("The rms slope of the modes is that of the surface", "[generators][exact_rms]") {
  const Grid2D grid = GENERATE(Grid2D{64, 64, 1, 1}, Grid2D{96, 50, 1.5, 1}, Grid2D{101, 64, 1, 1});
  const auto spectrum = spectrum_of(GENERATE(0, 1, 2), grid);
  // exact_rms scales by the sum over the modes, scale_to_rms by transforms of the heights. Waves
  // span at least two cells, so rounding errors of the heights, whose slope is π·eps per cell, are
  // below 1e-12 of the slope.
  const Surface by_modes = exact_rms(grid, *spectrum, 3, Rms::slope);
  const Surface by_heights =
      scale_to_rms(random_phase(grid, *spectrum, 3), Rms::slope, spectrum->moments().rms_slope());
  const double largest = by_modes.heights.abs().maxCoeff();
  CHECK((by_modes.heights - by_heights.heights).abs().maxCoeff() < 1e-12 * largest);
}

TEST_CASE("A stop of one process ends a generator on all", "[generators][share]") {
  const Grid2D grid{64, 64, 1, 1};
  const auto spectrum = spectrum_of(0, grid);
  const int ranks = 3, culprit = GENERATE(0, 2);
  parallel::set_threads(1);
  for (const Make& make : ways()) {
    const auto work = [&](const Communicator& together, const Progress& on_progress) {
      make(grid, *spectrum, on_progress, together);
    };
    const int reports = stop_one(ranks, culprit, 0, work).reports;
    REQUIRE(reports > 2);
    for (int stop = 1; stop <= reports; ++stop)
      CHECK(stop_one(ranks, culprit, stop, work).interrupted == ranks);
  }
  parallel::set_threads(0);
}

TEST_CASE("What one process refuses, all refuse", "[generators][share]") {
  const Grid2D grid{64, 64, 1, 1};
  const auto spectrum = spectrum_of(0, grid);
  const auto all_refuse = [&](const std::function<void(const Communicator&)>& work,
                              const std::string& message) {
    std::atomic<int> refused = 0;
    run_ranks(4, [&](const Communicator& together) {
      try {
        work(together);
      } catch (const InvalidInput& error) {
        refused += std::string(error.what()).find(message) != std::string::npos;
      }
    });
    return refused == 4;
  };
  // One process has an undefined point in its rows.
  for (const Rms which : {Rms::height, Rms::slope})
    CHECK(all_refuse(
        [&](const Communicator& together) {
          Surface mine = filtered_noise(grid, *spectrum, 1, {}, together);
          if (together.rank() == 2) mine.heights(3, 5) = std::numeric_limits<double>::quiet_NaN();
          scale_to_rms(std::move(mine), which, 1);
        },
        "undefined points"));
  CHECK(all_refuse(
      [&](const Communicator& together) {
        filtered_noise({1 << 22, 1 << 22, 1, 1}, *spectrum, 1, {}, together);
      },
      "of memory for a surface"));
  CHECK(all_refuse(
      [&](const Communicator& together) {
        filtered_noise({16, 16, 1, 1}, *spectrum, 1, {}, together);
      },
      "short_cutoff"));
  // Functions that need the whole surface refuse a distributed one.
  CHECK(all_refuse(
      [&](const Communicator& together) {
        const Surface mine = filtered_noise(grid, *spectrum, 1, {}, together);
        composite_surface(mine, mine);
      },
      "is spread over 4 processes"));
  CHECK(all_refuse(
      [&](const Communicator& together) {
        crop_surface(filtered_noise(grid, *spectrum, 1, {}, together), 0, 0, 8, 8);
      },
      "is spread over 4 processes"));
}

TEST_CASE("The memory of a generator is that of one process", "[generators][share]") {
  const Grid2D grid{1024, 1024, 1, 1};
  const double alone = double(generation_memory(grid));
  std::atomic<int> right = 0;
  run_ranks(4, [&](const Communicator& together) {
    // A quarter of the heights, and up to as much again for a batch of columns.
    const double memory = double(generation_memory(grid, together));
    right += memory > 0.25 * alone && memory < 0.6 * alone;
  });
  CHECK(right == 4);
}
