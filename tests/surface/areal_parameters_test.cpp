// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/peaks.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

TEST_CASE("A wedge has the developed area of its flank, 1/cos θ, and its slope", "[areal]") {
  const double angle = 0.6;
  // The edge lies on a row of points, which puts every triangle on one flank.
  const Surface wedge = sampled({33, 20, 33.0, 40.0}, false, [&](double x, double) {
    return -std::abs(x - 16) * std::tan(angle);
  });
  const ArealParameters wedge_parameters = areal_parameters(wedge);
  CHECK(wedge_parameters.Sdr == Approx(1 / std::cos(angle) - 1).epsilon(1e-13));
  CHECK(wedge_parameters.Sdq == Approx(std::tan(angle)).epsilon(1e-13));
}

TEST_CASE("A sinusoid has the heights of its formula", "[areal]") {
  const double amplitude = 2e-6;
  const Surface wave = sampled({240, 60, 1e-3, 1e-3}, true, [&](double x, double) {
    return 5e-6 + amplitude * std::sin(2 * pi * 4 * x / 1e-3);
  });
  const ArealParameters p = areal_parameters(wave);
  CHECK(p.Sq == Approx(amplitude / std::sqrt(2)).epsilon(1e-10));
  // The mean of |sin| over 60 points of a wave is (2/60) cot(π/60), i.e. 2/π less π²/(3·60²).
  CHECK(p.Sa == Approx(amplitude * 2 / 60 / std::tan(pi / 60)).epsilon(1e-10));
  CHECK(p.Ssk == Approx(0).margin(1e-10));
  CHECK(p.Sku == Approx(1.5).epsilon(1e-10));
  CHECK(p.Sp == Approx(amplitude).epsilon(1e-10));
  CHECK(p.Sv == Approx(amplitude).epsilon(1e-10));
  CHECK(p.Sz == Approx(2 * amplitude).epsilon(1e-10));
  // The correlation along x is cos(qx), which falls to 0.2; it is bilinear between 60 points of a
  // wave.
  CHECK(p.Sal == Approx(std::acos(0.2) / (2 * pi * 4 / 1e-3)).epsilon(1e-3));
  // The correlation never falls along y.
  CHECK(std::isnan(p.Str));
  // The longest distance within half of the surface leans from y by at most Sal.
  CHECK(p.Str_max == Approx(p.Sal / std::hypot(p.Sal, 0.5e-3)).epsilon(0.01));
  CHECK(p.Std == Approx(0).margin(1e-12));
}

TEST_CASE("Correlation lengths do not mind the shape of the cells", "[areal]") {
  // Steps of half the shorter side of a cell would be 10¹¹ steps along the longer side.
  const Index n = 240;
  Surface surface{{n, 4, 1e-3, 1e6}, Field(n, 4), true, ""};
  for (Index ix = 0; ix < n; ++ix)
    surface.heights.row(ix).setConstant(std::cos(2 * pi * 4 * static_cast<double>(ix) / n));
  CHECK(areal_parameters(surface).Sal ==
        Approx(std::acos(0.2) / (2 * pi * 4 / 1e-3)).epsilon(1e-3));
}

TEST_CASE("A stretched Gaussian correlation has the lengths, aspect and direction of its ellipse",
          "[areal]") {
  const double length = 0.02, angle = 0.5;
  const auto isotropic =
      std::make_shared<FunctionSpectrum>(gaussian_correlation_spectrum(1e-6, length));
  const AnisotropicSpectrum spectrum(isotropic, {.along = 2, .across = 0.8, .angle = angle});
  const ArealParameters p = areal_parameters(random_phase({512, 512, 2, 2}, spectrum, 3));
  // exp(−r²/ℓ²) = 0.2. A random-phase surface has exactly the correlation of its spectrum; steps of
  // 0.25 ℓ/5 shift bilinear values by 1 %.
  const double fall = length * std::sqrt(std::log(5.0));
  CHECK(p.Sal == Approx(0.8 * fall).epsilon(0.02));
  CHECK(p.Str == Approx(0.8 / 2).epsilon(0.02));
  CHECK(p.Str_max == p.Str);
  // The power lies across the lay. With fixed amplitudes, only the lattice of modes shifts the
  // maximum.
  CHECK(p.Std == Approx(angle + pi / 2).margin(pi / 180));
}

TEST_CASE("The texture direction of one wave is its own", "[areal]") {
  const int i = GENERATE(7, -7), j = GENERATE(0, 3);
  const double lx = GENERATE(1.0, 2.0), ly = 3 - lx;
  const Surface wave = sampled({64, 64, lx, ly}, true, [&](double x, double y) {
    return std::cos(2 * pi * (i * x / lx + j * y / ly) + 0.3);
  });
  const double exact = j == 0 ? 0 : std::atan2(j / ly, i / lx);
  // The error is a quarter of a degree from the spacing of rays, plus the steps of half a mode
  // along them.
  CHECK(areal_parameters(wave).Std ==
        Approx(exact < 0 ? exact + pi : exact).margin(1.5 * pi / 180));
}

TEST_CASE("A direction is as strong as the power in its sector, which widens with the wave number",
          "[areal]") {
  // The wave along y has twice the wave number and 0.64 of the power, hence 1.28 times the power of
  // the wave along x in a sector.
  const Surface waves = sampled({64, 64, 1.0, 1.0}, true, [](double x, double y) {
    return std::cos(2 * pi * 6 * x) + 0.8 * std::cos(2 * pi * 12 * y);
  });
  CHECK(areal_parameters(waves).Std == Approx(pi / 2).margin(1.5 * pi / 180));
}

TEST_CASE("The parameters of heights are those of their statistics and bearing curve", "[areal]") {
  // Skewed heights, which make hills and valleys differ.
  Surface surface = white({30, 20, 1, 1}, false);
  surface.heights = surface.heights.exp();
  const ArealParameters p = areal_parameters(surface);
  const CoreParameters core = core_parameters(BearingCurve(surface));
  CHECK(p.Smr1 == core.peak_fraction);
  CHECK(p.Smr2 == core.core_fraction);
  CHECK(p.Smr1 < 0.5);
  CHECK(p.Smr2 > 0.5);
  CHECK(p.Spk == core.peak_height);
  CHECK(p.Svk == core.valley_depth);
  const HeightStatistics heights = height_statistics(surface);
  CHECK(p.Ssk == heights.skewness);
  CHECK(p.Sku == heights.kurtosis);
  CHECK(p.Ssk > 0.1);
}

TEST_CASE("Hills in a chain of known saddles are pruned in the order of their prominence",
          "[peaks]") {
  // The heights along x form a ridge in one row; all other rows are lower, so every peak is a
  // single point.
  const std::vector<double> ridge{0, 5, 3, 4, 1, 9, 8, 8.5, 0, 2, 0};
  Surface surface = sampled({11, 5, 11, 5}, false, [&](double x, double y) {
    return ridge[static_cast<std::size_t>(x + 0.5)] - (std::abs(y - 2) > 0.5 ? 20 : 0);
  });
  // Prominences: 9, the highest, has no limit; 5 over its saddle 1 has 4; 2 over 0 has 2; 4 over 3
  // has 1; 8.5 over 8 has 0.5.
  CHECK(significant_peaks(surface, 0).size() == 5);
  CHECK(significant_peaks(surface, 0.5).size() == 5);
  CHECK(significant_peaks(surface, 0.6).size() == 4);
  CHECK(significant_peaks(surface, 1.5).size() == 3);
  CHECK(significant_peaks(surface, 3).size() == 2);
  const auto last = significant_peaks(surface, 5);
  REQUIRE(last.size() == 1);
  CHECK(last.front().ix == 5);
  // −½ (−8 − 1 + −40)/1.
  CHECK(last.front().mean_curvature == Approx(0.5 * (8 + 1 + 40)));
  // Two peaks next to an undefined point are not listed; the peak of height 5 still ends at its
  // saddle with one of them.
  surface.heights(6, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(significant_peaks(surface, 0.6).size() == 3);
  CHECK(significant_peaks(surface, 5).empty());
}

TEST_CASE("Peaks and prominences are those of water that falls point by point", "[peaks]") {
  // Heights are multiples of an eighth: many are equal and are ordered by their index.
  const bool periodic = GENERATE(true, false);
  Surface surface = white({22, 17, 22, 17}, periodic, 5);
  surface.heights = (8 * surface.heights).round() / 8;
  for (const Index k : {40, 41, 77, 200})
    surface.heights.data()[k] = std::numeric_limits<double>::quiet_NaN();
  const double* heights = surface.heights.data();
  const Index points = surface.grid.points(), nx = surface.grid.nx, ny = surface.grid.ny;
  std::vector<Index> order;
  for (Index k = 0; k < points; ++k)
    if (!std::isnan(heights[k])) order.push_back(k);
  std::ranges::stable_sort(order, std::greater{}, [&](Index k) { return heights[k]; });

  // By definition, a peak ends at the first height at which its hill contains a higher point.
  std::vector<std::tuple<Index, Index, double>> expected;
  for (std::size_t summit = 0; summit < order.size(); ++summit) {
    double prominence = std::numeric_limits<double>::infinity();
    std::vector<int> above(static_cast<std::size_t>(points), 0);
    for (std::size_t level = 0; level < order.size(); ++level) {
      above[static_cast<std::size_t>(order[level])] = 1;
      if (level < summit) continue;
      std::vector<Index> hill{order[summit]};
      std::vector<int> seen = above;
      seen[static_cast<std::size_t>(order[summit])] = 0;
      bool ended = false;
      for (std::size_t k = 0; k < hill.size() && !ended; ++k)
        for (Index ix = hill[k] / ny - 1; ix <= hill[k] / ny + 1; ++ix)
          for (Index iy = hill[k] % ny - 1; iy <= hill[k] % ny + 1; ++iy) {
            if (!periodic && (ix < 0 || iy < 0 || ix >= nx || iy >= ny)) continue;
            const Index next = (ix + nx) % nx * ny + (iy + ny) % ny;
            if (!std::exchange(seen[static_cast<std::size_t>(next)], 0)) continue;
            hill.push_back(next);
            ended = ended || std::ranges::find(order, next) - order.begin() <
                                 static_cast<std::ptrdiff_t>(summit);
          }
      if (!ended) continue;
      prominence = heights[order[summit]] - heights[order[level]];
      if (level == summit) prominence = -1;  // no peak: a neighbour is higher
      break;
    }
    const Index ix = order[summit] / ny, iy = order[summit] % ny;
    bool listed = prominence >= 0;
    for (Index a = -1; a <= 1; ++a)
      for (Index b = -1; b <= 1; ++b) {
        const bool inside = ix + a >= 0 && ix + a < nx && iy + b >= 0 && iy + b < ny;
        listed = listed && (periodic || inside) &&
                 !std::isnan(surface.heights((ix + a + nx) % nx, (iy + b + ny) % ny));
      }
    if (listed) expected.emplace_back(ix, iy, prominence);
  }
  REQUIRE(expected.size() > 20);
  std::ranges::sort(expected);
  for (const int threads : {1, 3, 7}) {
    parallel::set_threads(threads);
    std::vector<std::tuple<Index, Index, double>> found;
    for (const Peak& peak : significant_peaks(surface, 0))
      found.emplace_back(peak.ix, peak.iy, peak.prominence);
    std::ranges::sort(found);
    CHECK(found == expected);
  }
  parallel::set_threads(0);
}

TEST_CASE("An egg box has one peak to a hill, with the curvature of a cosine", "[areal]") {
  const double amplitude = 1e-6, l = 1e-3;
  const Surface box = sampled({120, 120, l, l}, true, [&](double x, double y) {
    return amplitude * std::cos(2 * pi * 3 * x / l) * std::cos(2 * pi * 5 * y / l);
  });
  const ArealParameters p = areal_parameters(box);
  CHECK(p.Spd == Approx(2 * 3 * 5 / (l * l)));
  // The second difference of a cosine is 2(1 − cos qΔ)/Δ².
  const double step = l / 120;
  const auto second = [&](int waves) {
    return 2 * (1 - std::cos(2 * pi * waves * step / l)) / (step * step);
  };
  CHECK(p.Spc == Approx(amplitude * (second(3) + second(5)) / 2).epsilon(1e-9));
}

TEST_CASE("Peaks count from a twentieth of the height range on", "[areal]") {
  Surface plain{{40, 40, 1, 1}, Field::Zero(40, 40), false, "plain"};
  plain.heights(10, 10) = 100;
  plain.heights(20, 20) = 5.1;
  plain.heights(30, 30) = 4.9;
  CHECK(areal_parameters(plain).Spd == 2);
}

TEST_CASE("Undefined points and flat surfaces have the parameters that exist", "[areal]") {
  Surface surface = white({20, 20, 1, 1}, false);
  surface.heights(10, 10) = std::numeric_limits<double>::quiet_NaN();
  const ArealParameters p = areal_parameters(surface);
  CHECK(std::isnan(p.Std));
  CHECK(p.Sdr > 0);
  CHECK(p.Sq > 0);
  surface.heights.setConstant(2);
  const ArealParameters flat = areal_parameters(surface);
  CHECK(flat.Sq == 0);
  CHECK(flat.Sk == 0);
  CHECK(std::isnan(flat.Sal));
  CHECK(std::isnan(flat.Ssk));
}
