// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/summits.hpp>
#include <string>
#include <vector>

#include "ranks_in_threads.hpp"
#include "test_surfaces.hpp"

using namespace salebra;
using salebra::testing::run_ranks;

namespace {

/// The rows of a surface that belong to this process.
Surface spread(const Surface& whole, const Communicator& ranks) {
  Surface surface = whole;
  surface.communicator = ranks;
  const RowPartition partition = surface.partition();
  surface.heights = whole.heights.middleRows(partition.begin(), partition.count()).eval();
  return surface;
}

/// Results that every process has of the whole, and parts of lists that are distributed over the
/// processes in order.
struct Numbers {
  std::vector<double> of_all;
  std::vector<std::vector<double>> parts;

  void add(std::initializer_list<double> values) {
    of_all.insert(of_all.end(), values.begin(), values.end());
  }
  void add(const std::vector<double>& values) {
    add({static_cast<double>(values.size())});
    of_all.insert(of_all.end(), values.begin(), values.end());
  }
  void add(const std::vector<Index>& values) {
    add(std::vector<double>(values.begin(), values.end()));
  }
  void add(const SpectralMoments& m) {
    add({m.moment0, m.moment2_x, m.moment2_y, m.moment4_x, m.moment4_y});
  }
  void add_part(const Field& field) {
    parts.emplace_back(field.data(), field.data() + field.size());
  }
};

using Measure = std::function<void(const Surface&, Numbers&)>;

void heights_of(const Surface& surface, Numbers& numbers) {
  const HeightStatistics h = height_statistics(surface);
  numbers.add({static_cast<double>(h.defined_points), h.minimum, h.maximum, h.mean, h.rms_height,
               h.skewness, h.kurtosis});
  for (const Detrend method : {Detrend::none, Detrend::mean, Detrend::plane, Detrend::quadratic})
    numbers.add_part(detrended(surface, method).heights);
}

void differences_of(const Surface& surface, Numbers& numbers) {
  numbers.add(difference_moments(surface));
  for (const Axis axis : {Axis::x, Axis::y}) {
    const ScaleDependence scales = scale_dependence(surface, axis);
    numbers.add(scales.spacing);
    numbers.add(scales.profile_slope);
    numbers.add(scales.profile_curvature);
    numbers.add(scales.min_curvature);
    numbers.add(scales.stencils);
  }
  const ReliabilityLimit limit = short_wavelength_limit(surface, {.tip_radius = 0.05});
  numbers.add({limit.pixel, *limit.tip});
  const ArealParameters areal = areal_parameters(surface);
  numbers.add({areal.Sa, areal.Sq, areal.Ssk, areal.Sku, areal.Sp, areal.Sv, areal.Sz, areal.Sdq,
               areal.Sdr});
}

void summits_of(const Surface& surface, Numbers& numbers) {
  const SummitList list = find_summits(surface);
  const SummitStatistics s = summit_statistics(list);
  numbers.add({list.searched_area, s.summit_density, s.mean_height, s.rms_height, s.mean_radius});
  std::vector<double>& part = numbers.parts.emplace_back();
  for (const Summit& summit : list.summits)
    for (const double value :
         {summit.x, summit.y, summit.height, summit.curvature1, summit.curvature2})
      part.push_back(value);
}

void spectra_of(const Surface& surface, Numbers& numbers) {
  if (surface.periodic) numbers.add(spectral_moments(surface));
  for (const Window window : {Window::none, Window::hann, Window::radial_hann}) {
    const PowerSpectrum spectrum = power_spectrum(surface, window);
    numbers.add_part(spectrum.psd.transpose());  // distributed by columns
    numbers.add({spectrum.correlated_modes, spectrum.asymmetric_wavelength});
    const RadialSpectrum radial = radial_spectrum(spectrum);
    numbers.add(radial.wavenumber);
    numbers.add(radial.psd);
    numbers.add(radial.modes);
    // The fit takes longer than all other statistics and depends on the window only through whether
    // there is one, so each case runs once.
    if (window == (surface.periodic ? Window::none : Window::hann)) {
      const SelfAffineFit fit = fit_self_affine(spectrum);
      numbers.add({fit.hurst.value, fit.hurst.low, fit.hurst.high, fit.hurst.wavenumber_min,
                   fit.hurst.wavenumber_max, static_cast<double>(fit.hurst.modes)});
      for (const IntervalEstimate& estimate : {fit.rolloff, fit.short_cutoff})
        numbers.add({estimate.value, estimate.low, estimate.high});
    }
    for (const Axis axis : {Axis::x, Axis::y}) {
      const ProfilePsd profiles = profile_psd(surface, axis, window);
      numbers.add(profiles.wavenumber);
      numbers.add(profiles.psd);
      numbers.add(profiles.modes);
    }
  }
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void check_same_bits(const Surface& whole, const Measure& measure) {
  Numbers alone;
  measure(whole, alone);
  REQUIRE(alone.of_all.size() > 4);
  // Whole blocks, uneven parts, and parts of two rows.
  for (const int ranks : {1, 2, 3, 8}) {
    for (const int threads : ranks % 2 == 1 ? std::vector{1, 2} : std::vector{1}) {
      CAPTURE(whole.grid.nx, whole.grid.ny, whole.periodic, ranks, threads);
      parallel::set_threads(threads);
      std::atomic<int> right = 0;
      std::vector<Numbers> found(static_cast<std::size_t>(ranks));
      run_ranks(ranks, [&](const Communicator& together) {
        Numbers& mine = found[static_cast<std::size_t>(together.rank())];
        measure(spread(whole, together), mine);
        right += same(mine.of_all, alone.of_all);
      });
      CHECK(right == ranks);
      for (std::size_t k = 0; k < alone.parts.size(); ++k) {
        std::vector<double> joined;
        for (const Numbers& mine : found)
          joined.insert(joined.end(), mine.parts[k].begin(), mine.parts[k].end());
        CHECK(same(joined, alone.parts[k]));
      }
    }
  }
  parallel::set_threads(0);
}

}  // namespace

TEST_CASE("Statistics of a spread surface have the bits of one process", "[statistics][share]") {
  const Grid2D grid = GENERATE(Grid2D{64, 64, 1, 1}, Grid2D{96, 50, 1.5, 1}, Grid2D{101, 64, 1, 1},
                               Grid2D{16, 16, 1, 1});
  const SelfAffineSpectrum law({.hurst = 0.7,
                                .rolloff = 0.5,
                                .short_cutoff = 3 * std::max(grid.dx(), grid.dy()),
                                .rms_height = 0.01});
  Surface whole = random_phase(grid, law, 5);
  whole.periodic = GENERATE(true, false);
  // An offset makes sums lose digits.
  whole.heights += 1;
  SECTION("of heights") { check_same_bits(whole, heights_of); }
  SECTION("of differences") { check_same_bits(whole, differences_of); }
  SECTION("of summits") { check_same_bits(whole, summits_of); }
  SECTION("of spectra") {
    if (grid.ny == 64)  // otherwise the test would compare results that were not found
      REQUIRE(fit_self_affine(power_spectrum(whole, Window::none)).hurst.found());
    check_same_bits(whole, spectra_of);
  }
  SECTION("with undefined points") {
    for (const Index ix : {Index{0}, grid.nx / 3, grid.nx / 3 + 1, grid.nx - 1})
      whole.heights(ix, grid.ny / 2) = std::numeric_limits<double>::quiet_NaN();
    check_same_bits(whole, heights_of);
    check_same_bits(whole, differences_of);
    check_same_bits(whole, summits_of);
  }
}

TEST_CASE("Spectra refuse an undefined point of any process in all of them",
          "[statistics][share]") {
  const Surface whole = white({64, 48, 1, 1}, true);
  const std::vector<std::function<void(const Surface&)>> calls{
      [](const Surface& surface) { power_spectrum(surface); },
      [](const Surface& surface) { profile_psd(surface, Axis::x); },
      [](const Surface& surface) { spectral_moments(surface); }};
  for (const auto& call : calls) {
    std::atomic<int> refused = 0;
    run_ranks(3, [&](const Communicator& together) {
      Surface mine = spread(whole, together);
      if (together.rank() == 1) mine.heights(2, 3) = std::numeric_limits<double>::quiet_NaN();
      try {
        call(mine);
      } catch (const InvalidInput& error) {
        refused += std::string(error.what()).find("undefined points") != std::string::npos;
      }
    });
    CHECK(refused == 3);
  }
}
