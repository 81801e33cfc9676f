// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <string>
#include <vector>

#include "ranks_in_threads.hpp"
#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

/// Surfaces that are no work of the library's generators: sums of plane waves of any wave vector,
/// hence not periodic, and scratches.
class Workshop {
 public:
  explicit Workshop(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double normal() { return normal_(engine_); }

  struct Wave {
    double wavenumber, amplitude;
  };

  /// A sum of waves on a grid of the unit square. The stretch makes the waves of an isotropic
  /// surface longer along the lay.
  Surface waves(Index nx, Index ny, const std::function<Wave()>& wave, double stretch,
                double angle) {
    constexpr Index count = 200;
    Eigen::MatrixXd real_x(nx, count), imag_x(nx, count), real_y(ny, count), imag_y(ny, count);
    for (Index k = 0; k < count; ++k) {
      const auto [q, amplitude] = wave();
      const double direction = uniform(0, 2 * pi);
      const double along = q * std::cos(direction) / stretch, across = q * std::sin(direction);
      const double qx = std::cos(angle) * along - std::sin(angle) * across;
      const double qy = std::sin(angle) * along + std::cos(angle) * across;
      const double a = amplitude * normal(), b = amplitude * normal();
      for (Index i = 0; i < nx; ++i) {
        const double phase = qx * static_cast<double>(i) / static_cast<double>(nx);
        real_x(i, k) = a * std::cos(phase) + b * std::sin(phase);
        imag_x(i, k) = b * std::cos(phase) - a * std::sin(phase);
      }
      for (Index j = 0; j < ny; ++j) {
        const double phase = qy * static_cast<double>(j) / static_cast<double>(ny);
        real_y(j, k) = std::cos(phase);
        imag_y(j, k) = std::sin(phase);
      }
    }
    Surface surface{{nx, ny, 1, 1}, Field(nx, ny), false, ""};
    surface.heights = (real_x * real_y.transpose() + imag_x * imag_y.transpose()).array();
    return surface;
  }

  /// Wave numbers of a Gaussian autocorrelation exp(−r²/ℓ²): the components of q are normal with the
  /// variance 2/ℓ².
  std::function<Wave()> gaussian(double length) {
    return [this, length] {
      return Wave{std::sqrt(2.0) / length * std::hypot(normal(), normal()), 1};
    };
  }
  /// Waves of equal number in each octave from the wave number `low` to `high`, with C ∝ q^(−2−2H).
  std::function<Wave()> self_affine(double hurst, double low, double high) {
    return [=, this] {
      const double q = low * std::pow(high / low, uniform(0, 1));
      return Wave{q, std::pow(q, -hurst)};
    };
  }

  /// A flat with scratches of random place, width and depth, and an angle with a spread.
  Surface scratches(Index n, int count, double angle, double spread) {
    Surface surface{{n, n, 1, 1}, Field::Zero(n, n), false, ""};
    for (int k = 0; k < count; ++k) {
      const double turn = angle + spread * normal(), place = uniform(-0.75, 0.75);
      const double width = uniform(1.5, 5) / static_cast<double>(n), depth = uniform(0.3, 1);
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const double x = static_cast<double>(i) / static_cast<double>(n) - 0.5;
          const double y = static_cast<double>(j) / static_cast<double>(n) - 0.5;
          const double distance = (std::cos(turn) * y - std::sin(turn) * x - place) / width;
          surface.heights(i, j) -= depth * std::exp(-distance * distance);
        }
    }
    return surface;
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// Heights of a surface turned by an angle, between its points on straight lines: the middle half of
/// the surface.
Surface turned(const Surface& whole, double angle) {
  const Index n = whole.grid.nx / 2;
  Surface surface{{n, n, 0.5, 0.5}, Field(n, n), false, ""};
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double x = static_cast<double>(i) - static_cast<double>(n) / 2;
      const double y = static_cast<double>(j) - static_cast<double>(n) / 2;
      const double u = std::cos(angle) * x + std::sin(angle) * y + static_cast<double>(n);
      const double v = std::cos(angle) * y - std::sin(angle) * x + static_cast<double>(n);
      const auto k = static_cast<Index>(u), l = static_cast<Index>(v);
      const double a = u - static_cast<double>(k), b = v - static_cast<double>(l);
      const Field& h = whole.heights;
      surface.heights(i, j) = (1 - a) * ((1 - b) * h(k, l) + b * h(k, l + 1)) +
                              a * ((1 - b) * h(k + 1, l) + b * h(k + 1, l + 1));
    }
  return surface;
}

Surface honed(Surface surface) {
  surface.heights = surface.heights.min(0.3 * height_statistics(surface).rms_height);
  return surface;
}

/// Lognormal depths, with a skewness of −1.5 as after running in.
Surface skew(Surface surface) {
  surface.heights = -(-0.45 / height_statistics(surface).rms_height * surface.heights).exp();
  return surface;
}

double off(const SurfaceLay& lay, double angle) {
  return std::abs(std::remainder(lay.angle - angle, pi));
}

}  // namespace

TEST_CASE("Isotropic surfaces of few and of many hills have no lay", "[lay]") {
  Workshop shop(1);
  int surfaces = 0, found = 0;
  for (int k = 0; k < 12; ++k)
    for (const double length : {0.4, 0.15, 0.06}) {
      const Surface surface = shop.waves(96, 96, shop.gaussian(length), 1, 0);
      for (const Surface& made : {surface, honed(surface), skew(surface)}) {
        found += surface_lay(detrended(made, Detrend::plane)).found();
        ++surfaces;
      }
    }
  for (int k = 0; k < 12; ++k)
    for (const double hurst : {0.3, 0.8}) {
      // Cells of any shape: the shorter waves along one axis are no lay.
      found += surface_lay(detrended(shop.waves(48, 192, shop.self_affine(hurst, 2, 600), 1, 0),
                                     Detrend::plane))
                   .found();
      found +=
          surface_lay(detrended(turned(shop.waves(192, 192, shop.self_affine(hurst, 2, 1200), 1, 0),
                                       shop.uniform(0, pi)),
                                Detrend::plane))
              .found();
      surfaces += 2;
    }
  // The limit is 99 % for Gaussian heights; ratios below 1.5 do not count.
  CHECK(surfaces == 156);
  CHECK(found < 0.05 * surfaces);
}

TEST_CASE("Stretched surfaces have the lay, the ratio and the angle of their stretch", "[lay]") {
  Workshop shop(2);
  const double stretch = GENERATE(2, 3, 5, 10);
  int surfaces = 0, found = 0, ratio = 0, angle_in = 0;
  for (int k = 0; k < 12; ++k) {
    const double angle = shop.uniform(0, pi);
    const Surface surface = shop.waves(96, 96, shop.gaussian(0.05), stretch, angle);
    for (const Surface& made : {surface, honed(surface), skew(surface)}) {
      const SurfaceLay lay = surface_lay(detrended(made, Detrend::plane));
      ++surfaces;
      found += lay.found();
      ratio += lay.ratio_low <= stretch && stretch <= lay.ratio_high;
      angle_in += off(lay, angle) < 2 * lay.angle_error;
    }
  }
  CAPTURE(stretch);
  CHECK(found >= 0.9 * surfaces);
  // Of 60 other surfaces of each kind and stretch 83 to 100 % were in the 95 % limits, and 80 to
  // 100 % of the angles; the three surfaces made of each sum of waves fail together.
  CHECK(ratio >= 0.7 * surfaces);
  CHECK(angle_in >= 0.7 * surfaces);
}

TEST_CASE("A resampled surface keeps its ratio and turns its lay", "[lay]") {
  Workshop shop(3);
  const double angle = 0.4;
  const Surface whole = shop.waves(256, 256, shop.gaussian(0.03), 4, angle);
  const double turn = 0.6;
  const SurfaceLay lay = surface_lay(detrended(turned(whole, turn), Detrend::plane));
  REQUIRE(lay.found());
  CHECK(off(lay, angle + turn) < 3 * lay.angle_error);
  CHECK(lay.ratio_low < 4);
  CHECK(lay.ratio_high > 4);
}

TEST_CASE("Parallel scratches are a lay, and scratches in all directions or alone are none",
          "[lay]") {
  Workshop shop(4);
  const double angle = GENERATE(0.0, 0.5, 2.2);
  const SurfaceLay ground =
      surface_lay(detrended(shop.scratches(128, 60, angle, 0.01), Detrend::plane));
  REQUIRE(ground.found());
  // Scratches of random width have their own mean direction, with an error of 0.01/√60.
  CHECK(off(ground, angle) < 0.01);
  CHECK(ground.ratio > 10);
  CHECK_THAT(lay_in_words(ground), Catch::StartsWith("ground-like: lay "));
  CHECK_FALSE(surface_lay(detrended(shop.scratches(128, 1, angle, 0), Detrend::plane)).found());
  // Of 50 surfaces with 100 such scratches none had a lay, with 12 every fourth: a few long
  // scratches in all directions have different slopes by chance.
  for (int k = 0; k < 3; ++k)
    CHECK_FALSE(surface_lay(detrended(shop.scratches(96, 100, 0, 100), Detrend::plane)).found());
}

TEST_CASE(
    "Slopes along and across the lay are the eigenvalues of the mean products of the gradient",
    "[lay]") {
  // A periodic sum of waves along and across a lay, with the gradient in closed form: the
  // products are means over whole periods, Σ a²q²/2.
  const Surface waves = sampled({128, 128, 1.0, 1.0}, true, [](double x, double y) {
    double height = 0;
    for (const int k : {3, 5, 6, 7, 9, 11, 13})
      height += std::cos(2 * pi * (k * x + 2 * k * y) + k * k) / k;
    return height + 0.2 * std::cos(2 * pi * (8 * x - 4 * y));
  });
  const SurfaceLay lay = surface_lay(waves);
  const double across = 2 * pi * std::sqrt(7 * 5 / 2.0), along = 2 * pi * 0.2 * std::sqrt(80 / 2.0);
  CHECK(lay.rms_slope_across == Approx(across).epsilon(1e-10));
  CHECK(lay.rms_slope_along == Approx(along).epsilon(1e-10));
  CHECK(lay.ratio == Approx(across / along).epsilon(1e-10));
  CHECK(lay.angle == Approx(pi + std::atan2(-1, 2)).epsilon(1e-10));
  CHECK(std::hypot(lay.rms_slope_along, lay.rms_slope_across) ==
        Approx(surface_moments(waves).rms_slope()).epsilon(1e-12));
}

TEST_CASE("The angle of a surface of equal slopes is unknown", "[lay]") {
  const Surface waves = sampled({32, 32, 1.0, 1.0}, true, [](double x, double y) {
    return std::cos(2 * pi * 3 * x) + std::cos(2 * pi * 3 * y);
  });
  const SurfaceLay lay = surface_lay(waves);
  CHECK(lay.ratio == Approx(1));
  CHECK(lay.ratio_low == 1);
  CHECK(lay.angle_error == Approx(pi / std::sqrt(12)));
  CHECK_FALSE(lay.found());
  // A flat surface has no slopes.
  CHECK(std::isnan(
      surface_lay(sampled({32, 32, 1.0, 1.0}, true, [](double, double) { return 1.0; })).ratio));
}

TEST_CASE("Processes find the lay of the whole surface", "[lay]") {
  Workshop shop(5);
  const Surface whole = shop.waves(64, 48, shop.gaussian(0.06), 3, 1);
  const SurfaceLay alone = surface_lay(whole);
  salebra::testing::run_ranks(3, [&](const Communicator& ranks) {
    Surface surface = whole;
    surface.communicator = ranks;
    const RowPartition partition = surface.partition();
    surface.heights = whole.heights.middleRows(partition.begin(), partition.count()).eval();
    const SurfaceLay lay = surface_lay(surface);
    REQUIRE(lay.ratio == alone.ratio);
    REQUIRE(lay.ratio_low == alone.ratio_low);
    REQUIRE(lay.angle_error == alone.angle_error);
    REQUIRE(lay.significant == alone.significant);
  });
}

TEST_CASE("Only a lay and skew heights that matter are warned of", "[lay]") {
  SurfaceLay lay;
  CHECK(lay_in_words(lay).empty());
  CHECK(warnings_of_lay(lay, 0.4, "a", "b").empty());
  lay = {.ratio = 6.04, .ratio_low = 5, .ratio_high = 7, .angle = 0.21, .significant = true};
  CHECK(lay_in_words(lay) == "ground-like: lay 12° from x, 6 to 1");
  CHECK(warnings_of_lay(lay, -1.24, "a", "b") ==
        std::vector<std::string>{"ground-like: lay 12° from x, 6 to 1: a",
                                 "the skewness of the heights is -1.2: b"});
  CHECK(warnings_of_lay(lay, -1.24, "", "").empty());
  lay.ratio = lay.ratio_high = std::numeric_limits<double>::infinity();
  lay.angle = 3.14;
  CHECK(lay_in_words(lay) == "ground-like: lay 0° from x, above 5 to 1");
  lay.ratio = 1.4;
  CHECK_FALSE(lay.found());
}

TEST_CASE("Directions are angles, or those of a lay, which the surface must have", "[lay]") {
  const SurfaceLay lay{
      .ratio = 6, .ratio_low = 5, .ratio_high = 7, .angle = 0.2, .significant = true};
  const SurfaceLay none{.ratio = 1.1, .ratio_low = 1, .ratio_high = 1.3};
  using enum LayDirection;
  CHECK(directions_of(automatic, lay) == std::vector<double>{0.2 + pi / 2, 0.2});
  CHECK(directions_of(both, lay) == directions_of(automatic, lay));
  CHECK(directions_of(across, lay) == std::vector<double>{0.2 + pi / 2});
  CHECK(directions_of(along, lay) == std::vector<double>{0.2});
  CHECK(directions_of(automatic, none) == std::vector<double>{0});
  for (const LayDirection direction : {across, along, both}) {
    CHECK_THROWS_WITH(
        directions_of(direction, none),
        Catch::Contains("ratio of slopes above 1.5; that of this surface is 1.1 (1 to 1.3)"));
    CHECK_THROWS_WITH(directions_of(direction, SurfaceLay{}), Catch::Contains("cannot be found"));
  }
  // Opposite directions are the same.
  CHECK(directions_of(-pi / 4, none).front() == Approx(3 * pi / 4).epsilon(1e-15));
  CHECK(directions_of(3 * pi, none).front() == Approx(0).margin(1e-14));
  CHECK_THROWS_AS(directions_of(std::nan(""), none), InvalidInput);
  CHECK(direction_choice("across", "direction") == DirectionChoice(across));
  CHECK(direction_choice("auto", "direction") == DirectionChoice(automatic));
  CHECK(std::get<double>(direction_choice("30deg", "direction")) == Approx(pi / 6));
  CHECK_THROWS_WITH(
      direction_choice("upwards", "--direction"),
      Catch::Contains("--direction: 'upwards': must be across, along, both, or an angle"));
  CHECK_THROWS_AS(direction_choice("30mm", "direction"), InvalidInput);
  CHECK(direction_in_words(0) == "along x");
  CHECK(direction_in_words(pi / 2) == "along y");
  CHECK(direction_in_words(pi / 6) == "at 30° to x");
}

TEST_CASE("The skewness of a few Gaussian hills is chance, that of a worn surface is not",
          "[lay]") {
  // Hills as wide as a fifth of the side: of 40 such Gaussian surfaces a third have |skewness| > 0.5.
  int called = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Surface surface{Grid2D{48, 48, 1, 1}, Field::Zero(48, 48), true};
    for (int kx = 0; kx <= 5; ++kx)
      for (int ky = -5; ky <= 5; ++ky) {
        if (kx * kx + ky * ky > 25 || (kx == 0 && ky <= 0)) continue;
        const double a = normal(random), b = normal(random);
        for (Index j = 0; j < 48; ++j)
          for (Index i = 0; i < 48; ++i) {
            const double phase = 2 * std::numbers::pi * (kx * double(i) + ky * double(j)) / 48;
            surface.heights(i, j) += a * std::cos(phase) + b * std::sin(phase);
          }
      }
    called += significant_skewness(surface) != 0;
    if (seed > 0) continue;
    // Worn: the hills above a quarter of the rms height are cut off.
    const double rms = std::sqrt(surface.heights.square().mean());
    surface.heights = surface.heights.min(0.25 * rms);
    CHECK(significant_skewness(surface) < -0.5);
  }
  CHECK(called <= 2);
}
