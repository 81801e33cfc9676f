// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/surface/detrend.hpp>

#include "test_surfaces.hpp"

using namespace salebra;

TEST_CASE("A tilted plane is nothing once its plane is subtracted", "[detrend]") {
  const Surface tilted =
      sampled({20, 31, 2e-3, 1e-3}, false, [](double x, double y) { return 1 + 0.3 * x - 2 * y; });
  // The heights are of order 1 m; only their round-off remains.
  CHECK(detrended(tilted, Detrend::plane).heights.abs().maxCoeff() < 1e-14);
  CHECK(std::abs(detrended(tilted, Detrend::mean).heights.mean()) < 1e-14);
  CHECK((detrended(tilted, Detrend::none).heights == tilted.heights).all());
}

TEST_CASE("The residual of the plane is orthogonal to 1, x and y, undefined points apart",
          "[detrend]") {
  Surface surface = white({24, 17, 3.0, 1.0}, false);
  surface.heights(3, 5) = surface.heights(20, 0) = std::numeric_limits<double>::quiet_NaN();
  surface.heights.col(1) += 100;
  const Surface flat = detrended(surface, Detrend::plane);
  CHECK(flat.undefined_points() == 2);
  double constant = 0, along_x = 0, along_y = 0;
  for (Index ix = 0; ix < 24; ++ix) {
    for (Index iy = 0; iy < 17; ++iy) {
      const double height = flat.heights(ix, iy);
      if (std::isnan(height)) continue;
      constant += height;
      along_x += height * static_cast<double>(ix);
      along_y += height * static_cast<double>(iy);
    }
  }
  // Sums of 406 terms up to 100 · 24: 1e-9 is 1e-15 of the sum of magnitudes.
  CHECK(std::abs(constant) < 1e-9);
  CHECK(std::abs(along_x) < 1e-9);
  CHECK(std::abs(along_y) < 1e-9);
}

TEST_CASE("A single row of points has a tilt along one axis only", "[detrend]") {
  const Surface line = sampled({9, 1, 9.0, 1.0}, false, [](double x, double) { return 2 * x; });
  CHECK(detrended(line, Detrend::plane).heights.abs().maxCoeff() < 1e-13);
}

TEST_CASE("Nothing is subtracted from a surface without a defined height", "[detrend]") {
  Surface surface = white({4, 4, 1, 1}, false);
  surface.heights.setConstant(std::nan(""));
  CHECK_THROWS_AS(detrended(surface, Detrend::mean), InvalidInput);
  CHECK_THROWS_AS(detrended(surface, Detrend::plane), InvalidInput);
}

TEST_CASE("Jumps and slopes of scan lines go, each line by itself", "[detrend]") {
  // The wave is even about the middle of each line and has mean 0, so it has no slope of its own.
  const auto wave = [](double x, double) { return std::cos(2 * 3.14159265358979 * (x - 0.5)); };
  const Surface rough = sampled({64, 21, 1.0, 2.0}, false, wave);
  Surface scanned = rough;
  for (Index iy = 0; iy < 21; ++iy)
    for (Index ix = 0; ix < 64; ++ix)
      scanned.heights(ix, iy) += std::sin(5.0 * double(iy)) + 0.1 * double(iy) * double(ix);
  scanned.heights.col(7).tail(60).setConstant(std::nan(""));  // leaves four points
  scanned.heights.col(8).setConstant(std::nan(""));
  scanned.heights.col(9).tail(63).setConstant(std::nan(""));  // leaves one point
  const Surface flat = detrended(scanned, Detrend::lines), alone = detrended(rough, Detrend::lines);
  CHECK(flat.undefined_points() == 60 + 64 + 63);
  CHECK(flat.heights(0, 9) == 0);
  for (const Index iy : {Index{0}, Index{6}, Index{20}}) {
    // Round-off of heights up to 100 m.
    CHECK((flat.heights.col(iy) - alone.heights.col(iy)).abs().maxCoeff() < 1e-12);
    double along_x = 0;
    for (Index ix = 0; ix < 64; ++ix) along_x += flat.heights(ix, iy) * double(ix);
    CHECK(std::abs(along_x) < 1e-9);
    CHECK(std::abs(flat.heights.col(iy).sum()) < 1e-11);
  }
}

namespace {

double rms(const Surface& surface) { return std::sqrt(surface.heights.square().mean()); }

// Thirty waves of equal amplitude with quasi-random directions and phases, 6 to 20 of them per
// side.
Surface hilly(Index n) {
  return sampled({n, n, 1.0, 1.0}, false, [](double x, double y) {
    double height = 0;
    for (int k = 0; k < 30; ++k) {
      const double direction = 2.399963 * k, q = 2 * 3.14159265358979 * (6 + 0.47 * k);
      height += std::cos(q * (std::cos(direction) * x + std::sin(direction) * y) + 1.7 * k * k);
    }
    return height / std::sqrt(15.0);  // 1 m rms
  });
}

}  // namespace

TEST_CASE("Offsets of scan lines are found by the median of differences, whatever they are",
          "[detrend]") {
  const Surface rough = hilly(64);
  const Surface alone = detrended(rough, Detrend::median_differences);
  Surface scanned = rough;
  for (Index iy = 0; iy < 64; ++iy) scanned.heights.col(iy) += 40 * std::sin(7.0 * double(iy * iy));
  // Adding a constant to a line preserves the order of its differences. The tolerance is the
  // round-off of 64 accumulated offsets with heights up to 40 m.
  const Surface flat = detrended(scanned, Detrend::median_differences);
  CHECK((flat.heights - alone.heights).abs().maxCoeff() < 1e-11);

  // Undefined points: part of a line, a whole line, and lines without a common x with the line
  // before.
  const double undefined = std::nan("");
  Surface torn = rough, torn_scan = scanned;
  for (Surface* surface : {&torn, &torn_scan}) {
    surface->heights.col(0).tail(20).setConstant(undefined);
    surface->heights.col(9).tail(60).setConstant(undefined);
    surface->heights.col(10).setConstant(undefined);
    surface->heights.col(20).head(32).setConstant(undefined);
    surface->heights.col(21).tail(32).setConstant(undefined);
  }
  const Surface flat_torn = detrended(torn_scan, Detrend::median_differences);
  const Surface torn_alone = detrended(torn, Detrend::median_differences);
  CHECK(flat_torn.undefined_points() == 20 + 60 + 64 + 32 + 32);
  double worst = 0;
  for (Index i = 0; i < flat_torn.heights.size(); ++i)
    if (const double error = flat_torn.heights(i) - torn_alone.heights(i); !std::isnan(error))
      worst = std::max(worst, std::abs(error));
  CHECK(worst < 1e-11);
}

TEST_CASE("The median of an even number of differences is the mean of the two in the middle",
          "[detrend]") {
  // The second line differs from the first by 0, 1, 3 and 10, so its median offset is 2; the third
  // is the second less these 2. With other offsets the error would not be a plane, and removing the
  // plane, which follows, would not hide it. Rounding errors are a few 1e-16 of 10.
  Surface scan{{4, 3, 4.0, 3.0}, Field::Zero(4, 3), false, "three lines"};
  scan.heights.col(1) << 10, 0, 3, 1;
  scan.heights.col(2) = scan.heights.col(1) - 2;
  Surface levelled = scan;
  levelled.heights.col(1) -= 2;
  const Field flat = detrended(scan, Detrend::median_differences).heights;
  CHECK((flat - detrended(levelled, Detrend::plane).heights).abs().maxCoeff() < 1e-14);
}

TEST_CASE("What stands out of a flat ground comes out of its scan as it is", "[detrend]") {
  // Tilted ground with a block over 45 % of lines 20 to 39, a hole, and an edge along x that covers
  // a third of a line.
  const Surface truth = sampled({60, 50, 60.0, 50.0}, false, [](double x, double y) {
    const double block = x >= 5 && x < 32 && y >= 20 && y < 40 ? 8 : 0;
    const double hole = x >= 40 && x < 45 && y >= 10 && y < 30 ? -3 : 0;
    return 0.01 * x - 0.02 * y + block + hole + (x >= 50 && y >= 35 ? 1 : 0);
  });
  Surface scanned = truth;
  for (Index iy = 0; iy < 50; ++iy) scanned.heights.col(iy) += std::cos(3.0 * double(iy));
  const Surface expected = detrended(truth, Detrend::plane);
  // More than half of each line's differences belong to the ground, so the result is exact but for
  // the round-off of heights up to 10 m.
  CHECK((detrended(scanned, Detrend::median_differences).heights - expected.heights)
            .abs()
            .maxCoeff() < 1e-12);
  // The block shifts least-squares lines by 45 % of its height or more.
  const Surface squares = detrended(scanned, Detrend::lines);
  CHECK((squares.heights - expected.heights).abs().maxCoeff() > 0.45 * 8);
}

TEST_CASE("Flattening harms a surface without jumps along y only, and by a known part",
          "[detrend]") {
  const Surface rough = detrended(hilly(128), Detrend::plane);
  const auto along_x = [](const Surface& surface) {
    return Field(surface.heights.bottomRows(127) - surface.heights.topRows(127));
  };
  for (const Detrend method : {Detrend::lines, Detrend::median_differences}) {
    const Surface flat = detrended(rough, method);
    const Field lost = flat.heights - rough.heights;
    // A mean over a line of at least six wavelengths keeps 1/6 of a wave; 127 accumulated medians
    // exceed that. An error of the method, such as a remaining tilt, would be of order 1.
    INFO("method " << int(method));
    CHECK(std::sqrt(lost.square().mean()) < 0.4 * rms(rough));
    // The removed heights are constant or straight along each line, so all differences along x
    // within a line change by one common number.
    const Field change = along_x(flat) - along_x(rough);
    CHECK((change.rowwise() - change.row(0)).abs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("A single line loses its plane, a surface without heights is refused", "[detrend]") {
  const Surface line = sampled({9, 1, 9.0, 1.0}, false, [](double x, double) { return 2 * x; });
  CHECK(detrended(line, Detrend::median_differences).heights.abs().maxCoeff() < 1e-13);
  Surface empty = white({4, 4, 1, 1}, false);
  empty.heights.setConstant(std::nan(""));
  CHECK_THROWS_AS(detrended(empty, Detrend::median_differences), InvalidInput);
}
