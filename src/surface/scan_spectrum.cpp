// SPDX-License-Identifier: GPL-3.0-or-later
// Binned periodograms of scans and profiles, and heights by wavelength.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/scan_spectrum.hpp>

#include "base/fft.hpp"
#include "base/memory.hpp"
#include "surface/twin_bins.hpp"
#include "surface/twin_kernels.hpp"

namespace salebra {
namespace twin_detail {

using std::numbers::pi;

std::vector<double> bin_limits(double nyquist) {
  std::vector<double> limits;
  for (double limit = 0.5; limit < 9 && limit <= nyquist; limit += 1) limits.push_back(limit);
  for (double limit = 8.5 * 1.15; limit <= nyquist; limit *= 1.15) limits.push_back(limit);
  return limits;
}

std::size_t tapered_bins(const std::vector<double>& limits) {
  const auto bins = limits.size() - 1;
  return std::min(
      bins, static_cast<std::size_t>(std::ranges::lower_bound(limits, hann_from) - limits.begin()));
}

std::size_t response_bins(const std::vector<double>& limits) {
  return static_cast<std::size_t>(std::ranges::lower_bound(limits, response_below) -
                                  limits.begin()) -
         1;
}

Index tapered_modes(Index points, double step) {
  return std::min(static_cast<Index>(max_tapered_mode / step), (points - 1) / 2);
}

Lay::Vector Lay::elliptic(double x, double y) const {
  const double c = std::cos(angle), s = std::sin(angle), root = std::sqrt(stretch);
  return {(c * y - s * x) / root, (c * x + s * y) * root};
}

ScanModes::ScanModes(const Grid2D& grid, const Lay& lay)
    : side(grid.ny == 1 ? grid.lx : std::sqrt(grid.lx * grid.ly)),
      step_x(side / grid.lx),
      step_y(grid.ny == 1 ? 0 : side / grid.ly),
      nyquist(static_cast<double>(grid.nx) * step_x / 2) {
  if (grid.ny > 1) nyquist = std::min(nyquist, static_cast<double>(grid.ny) * step_y / 2);
  if (lay.stretch == 1) return;
  // The half width along x of the ellipse |u| = 1.
  const double c = std::pow(std::cos(lay.angle), 2), s = std::pow(std::sin(lay.angle), 2);
  const auto width = [&](double along, double across) {
    return std::sqrt(along / lay.stretch + across * lay.stretch);
  };
  nyquist = std::min(static_cast<double>(grid.nx) * step_x / 2 / width(c, s),
                     static_cast<double>(grid.ny) * step_y / 2 / width(s, c));
}

double ScanModes::wavenumber(double kappa) const { return 2 * pi * kappa / side; }

std::vector<double> sine_taper(Index n, int k) {
  std::vector<double> taper;
  for (Index i = 0; i < n; ++i)
    taper.push_back(std::numbers::sqrt2 *
                    std::sin(pi * k * (static_cast<double>(i) + 0.5) / static_cast<double>(n)));
  return taper;
}

std::vector<double> hann_taper(Index n) {
  std::vector<double> taper;
  for (Index i = 0; i < n; ++i) {
    const double sine = std::sin(pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    taper.push_back(std::sqrt(8.0 / 3) * sine * sine);
  }
  return taper;
}

namespace {

void require_instrument(const ScanInstrument& instrument, double weight) {
  if (instrument.kind == Instrument::optical) require_positive(instrument.resolution, "resolution");
  if (instrument.has_tip()) require_positive(instrument.tip_radius, "tip_radius");
  const auto fraction = [](double value, std::string_view field) {
    require(value >= 0 && value <= 1, field, value, "must lie in 0 … 1");
  };
  fraction(instrument.height_calibration, "height_calibration");
  fraction(instrument.scan_calibration, "scan_calibration");
  require(
      std::isnan(instrument.noise) || (instrument.noise >= 0 && std::isfinite(instrument.noise)),
      "noise", instrument.noise, "must be >= 0 and finite; leave it out to estimate it");
  require_positive(weight, "weight");
}

/// Least-squares slope of n values at the positions −(n−1)/2 … (n−1)/2.
template <class Values>
double slope_of(const Values& values, Index n) {
  double sum = 0;
  for (Index i = 0; i < n; ++i)
    sum += values[i] * (static_cast<double>(i) - 0.5 * static_cast<double>(n - 1));
  const double count = static_cast<double>(n);
  return n > 1 ? sum / (count * (count * count - 1) / 12) : 0;
}

/// The heights less their least-squares plane.
Field levelled(const Field& heights) {
  const Index nx = heights.rows(), ny = heights.cols();
  // On a complete grid, the slope of the plane along an axis is the slope of the means over the
  // other axis.
  const Eigen::ArrayXd rows = heights.rowwise().mean();
  Eigen::ArrayXd columns = Eigen::ArrayXd::Zero(ny);
  for (Index i = 0; i < nx; ++i) columns += heights.row(i).transpose();
  columns /= static_cast<double>(nx);
  const double mean = rows.mean(), along_x = slope_of(rows, nx), along_y = slope_of(columns, ny);
  Field level(nx, ny);
  Eigen::Array<double, 1, Eigen::Dynamic> tilt(ny);
  for (Index j = 0; j < ny; ++j)
    tilt[j] = mean + along_y * (static_cast<double>(j) - 0.5 * static_cast<double>(ny - 1));
  for (Index i = 0; i < nx; ++i)
    level.row(i) = heights.row(i) - tilt -
                   along_x * (static_cast<double>(i) - 0.5 * static_cast<double>(nx - 1));
  return level;
}

/// Sums of the power of modes, and numbers of modes, in each bin.
struct BinSums {
  std::vector<double> limits, power;
  std::vector<double> modes;

  explicit BinSums(std::vector<double> edges)
      : limits(std::move(edges)), power(limits.size() - 1), modes(limits.size() - 1) {}

  /// Number of the bin that contains the mode κ, given κ² and a bin to search upwards from; the
  /// number of bins if κ is above all bins.
  std::size_t bin_of(double square, std::size_t from) const {
    std::size_t bin = from;
    while (bin < power.size() && square >= limits[bin + 1] * limits[bin + 1]) ++bin;
    return bin;
  }
};

/// Adds to the bins from `first` on the power of the modes of the heights under Hann's taper, times
/// `scale`, and lists the powers of all modes of a map.
void add_hann(const Field& level, const ScanModes& modes, bool drifts, std::size_t first,
              double scale, BinSums& sums, std::vector<double>& powers) {
  const Index nx = level.rows(), ny = level.cols(), columns = ny / 2 + 1;
  const std::vector<double> wx = hann_taper(nx), wy = ny == 1 ? std::vector{1.0} : hann_taper(ny);
  const Eigen::Map<const Eigen::Array<double, 1, Eigen::Dynamic>> along_y(wy.data(), ny);
  Field tapered(nx, ny);
  for (Index i = 0; i < nx; ++i)
    tapered.row(i) = level.row(i) * along_y * wx[static_cast<std::size_t>(i)];
  RealFft2D<double> transform(nx, ny);
  const auto buffer = large_array<std::complex<double>>(static_cast<std::size_t>(nx) *
                                                        static_cast<std::size_t>(columns));
  transform.forward(tapered.data(), buffer.get());
  if (ny > 1)
    for (Index k = 0; k < nx * columns; ++k)
      powers.push_back(scale * std::norm(buffer[static_cast<std::size_t>(k)]));
  for (Index i = 0; i < nx; ++i) {
    const Index k = 2 * i <= nx ? i : i - nx;
    if (drifts && std::abs(k) <= drift_modes) continue;
    const double x = static_cast<double>(k) * modes.step_x;
    std::size_t bin = first;
    for (Index j = 0; j < columns; ++j) {
      const double y = static_cast<double>(j) * modes.step_y, square = x * x + y * y;
      if (square < sums.limits[first] * sums.limits[first]) continue;
      bin = sums.bin_of(square, bin);
      if (bin == sums.power.size()) break;
      const double count = j == 0 || 2 * j == ny ? 1 : 2;
      sums.power[bin] +=
          count * scale * std::norm(buffer[static_cast<std::size_t>(i * columns + j)]);
      sums.modes[bin] += count;
    }
  }
}

/// Adds to the bins before `last` the power of the modes of the heights, averaged over products of
/// two sine tapers along each axis, and lists the powers of the modes of a map that may be in such a
/// bin if the bins are elliptic. Only a few modes are needed, so sums along the axes cost less than
/// Fourier transforms.
void add_tapered(const Field& level, const ScanModes& modes, bool drifts, std::size_t last,
                 double scale, BinSums& sums, std::vector<double>& powers) {
  const Index nx = level.rows(), ny = level.cols();
  const bool map = ny > 1;
  const Index count_x =
      map ? tapered_modes(nx, modes.step_x) : static_cast<Index>(sums.limits[last] / modes.step_x);
  const Index count_y = map ? tapered_modes(ny, modes.step_y) : 0;
  if (map) powers.assign(static_cast<std::size_t>((2 * count_x + 1) * (count_y + 1)), 0.0);
  // For each point of an axis, its taper times cos and −sin of the modes k = 0 … count, for both
  // tapers.
  const auto waves = [](Index n, Index count) {
    const Index columns = n == 1 ? 1 : 4 * (count + 1);
    Field table = Field::Ones(n, columns);
    for (int t = 0; n > 1 && t < 2; ++t) {
      const std::vector<double> taper = sine_taper(n, t + 1);
      for (Index i = 0; i < n; ++i)
        for (Index k = 0; k <= count; ++k) {
          const double phase = 2 * pi * static_cast<double>((i * k) % n) / static_cast<double>(n);
          const Index at = 2 * (t * (count + 1) + k);
          table(i, at) = taper[static_cast<std::size_t>(i)] * std::cos(phase);
          table(i, at + 1) = -taper[static_cast<std::size_t>(i)] * std::sin(phase);
        }
    }
    return table;
  };
  const bool line = ny == 1;
  const Field of_x = waves(nx, count_x), of_y = waves(ny, count_y);
  // The matrix product is not Eigen's, whose order of addition may depend on the number of threads.
  Field both = Field::Zero(of_x.cols(), of_y.cols());
  std::vector<double> row(static_cast<std::size_t>(of_y.cols()));
  for (Index i = 0; i < nx; ++i) {
    std::ranges::fill(row, 0.0);
    add_products({level.row(i).data(), static_cast<std::size_t>(ny)}, of_y.data(), row);
    for (Index k = 0; k < of_x.cols(); ++k)
      add_products({&of_x(i, k), 1}, row.data(), {&both(k, 0), row.size()});
  }
  const int tapers_y = line ? 1 : 2;
  for (int t = 0; t < 2; ++t)
    for (int u = 0; u < tapers_y; ++u)
      for (Index k = 0; k <= count_x; ++k) {
        if (drifts && k <= drift_modes) continue;
        for (Index j = 0; j <= count_y; ++j) {
          const double x = static_cast<double>(k) * modes.step_x,
                       y = static_cast<double>(j) * modes.step_y, square = x * x + y * y;
          if (square < sums.limits[0] * sums.limits[0]) continue;
          const Index at_x = 2 * (t * (count_x + 1) + k),
                      at = line ? 0 : 2 * (u * (count_y + 1) + j);
          // The product (a + ib)(c + id) of the waves along x and y, and the one with −b, give both
          // signs of k.
          const double rr = both(at_x, at), ir = both(at_x + 1, at),
                       ri = line ? 0 : both(at_x, at + 1), ii = line ? 0 : both(at_x + 1, at + 1);
          const double plus = (rr - ii) * (rr - ii) + (ri + ir) * (ri + ir),
                       minus = (rr + ii) * (rr + ii) + (ri - ir) * (ri - ir);
          // The modes (k, j), (−k, j) and their conjugates; if k or j is 0, (−k, j) is the
          // conjugate of (k, j) or equal to it.
          const double pairs = k > 0 && j > 0 ? 2 : 1, of_pair = 2.0 / (2.0 * tapers_y);
          if (map) {
            const auto place = [&](Index of_x) {
              return static_cast<std::size_t>((count_x + of_x) * (count_y + 1) + j);
            };
            powers[place(k)] += scale * of_pair / 2 * plus;
            if (k > 0) powers[place(-k)] += scale * of_pair / 2 * minus;
          }
          const std::size_t bin = sums.bin_of(square, 0);
          if (bin >= last) continue;
          sums.power[bin] += scale * of_pair * (pairs == 2 ? plus + minus : plus);
          sums.modes[bin] += pairs * of_pair;
        }
      }
}

std::vector<HeightBand> height_bands(const Field& heights, double cell) {
  std::vector<HeightBand> bands;
  Field blocks = heights;
  const bool line = heights.cols() == 1;
  for (double side = cell;; side *= 2) {
    const Index nx = blocks.rows(), ny = blocks.cols();
    if (nx < 18 || (!line && ny < 18)) return bands;
    HeightBand band{.wavelength = 4 * side};
    double second = 0, third = 0, fourth = 0;
    Eigen::Array<double, 1, Eigen::Dynamic> sum(ny);
    const auto take = [&](double detail) {
      const double square = detail * detail;
      second += square;
      third += square * detail;
      fourth += square * square;
      ++band.blocks;
    };
    for (Index i = 1; i + 1 < nx; ++i) {
      sum = blocks.row(i - 1) + blocks.row(i) + blocks.row(i + 1);
      if (line) {
        take(blocks(i, 0) - sum[0] / 3);
        continue;
      }
      for (Index j = 1; j + 1 < ny; ++j)
        take(blocks(i, j) - (sum[j - 1] + sum[j] + sum[j + 1]) / 9);
    }
    const double count = static_cast<double>(band.blocks), variance = second / count;
    band.rms_height = std::sqrt(variance);
    band.skewness = third / count / (variance * band.rms_height);
    band.kurtosis = fourth / count / (variance * variance);
    bands.push_back(band);
    Field next(nx / 2, line ? 1 : ny / 2);
    for (Index i = 0; i < next.rows(); ++i)
      for (Index j = 0; j < next.cols(); ++j)
        next(i, j) = line ? (blocks(2 * i, 0) + blocks(2 * i + 1, 0)) / 2
                          : (blocks(2 * i, 2 * j) + blocks(2 * i, 2 * j + 1) +
                             blocks(2 * i + 1, 2 * j) + blocks(2 * i + 1, 2 * j + 1)) /
                                4;
    blocks = std::move(next);
  }
}

ScanSpectrum spectrum_of(const Field& heights, const Grid2D& grid, const ScanInstrument& instrument,
                         double weight, std::string name) {
  const ScanModes modes(grid);
  const bool line = grid.ny == 1, drifts = instrument.drifts() && !line;
  const Field level = levelled(heights);
  BinSums sums(bin_limits(modes.nyquist));
  const std::size_t tapered = tapered_bins(sums.limits);
  const double points = static_cast<double>(grid.points());
  const double scale =
      (line ? grid.lx / (2 * pi) : grid.area() / (4 * pi * pi)) / (points * points);
  std::vector<double> tapered_powers, hann_powers;
  add_tapered(level, modes, drifts, tapered, scale, sums, tapered_powers);
  add_hann(level, modes, drifts, tapered, scale, sums, hann_powers);

  ScanSpectrum spectrum{instrument, grid, weight, std::move(name), {}, {}, {}, {}, {}, {}, {}};
  for (std::size_t bin = 0; bin < sums.power.size(); ++bin) {
    spectrum.wavenumber.push_back(
        modes.wavenumber(std::sqrt(sums.limits[bin] * sums.limits[bin + 1])));
    spectrum.psd.push_back(sums.modes[bin] > 0 ? sums.power[bin] / sums.modes[bin] : 0);
    spectrum.modes.push_back(static_cast<Index>(std::lround(sums.modes[bin])));
  }
  spectrum.bands = height_bands(level, line ? grid.dx() : std::sqrt(grid.cell_area()));
  spectrum.tapered_powers = std::move(tapered_powers);
  spectrum.hann_powers = std::move(hann_powers);
  for (const int power : {2, 3, 4}) spectrum.height_moments.push_back(level.pow(power).mean());
  return spectrum;
}

ScanSpectrum spectrum_of_map(const Field& heights, const Grid2D& grid,
                             const ScanInstrument& instrument, double weight, std::string name) {
  grid.validate();
  require_instrument(instrument, weight);
  require(std::min(grid.nx, grid.ny) >= 32, "grid", std::min(grid.nx, grid.ny),
          "points along a side are too few for the spectrum of a map, which needs 32; give its "
          "lines as profiles");
  const double ratio = std::max(grid.lx, grid.ly) / std::min(grid.lx, grid.ly);
  require(ratio <= 4, "grid", ratio,
          "is the ratio of the sides, which must be <= 4; crop the scan, or give its lines as "
          "profiles");
  require_that(heights.rows() == grid.nx && heights.cols() == grid.ny, "heights",
               "do not have the shape of the grid");
  require_that(heights.allFinite(), "heights", "have undefined points; fill or crop them");
  return spectrum_of(heights, grid, instrument, weight, std::move(name));
}

ScanSpectrum spectrum_of_line(const std::vector<double>& heights, double length,
                              const ScanInstrument& instrument, double weight, std::string name) {
  require_instrument(instrument, weight);
  require_positive(length, "length");
  require(heights.size() >= 64, "heights", heights.size(), "points given; give 64 or more");
  const Field line =
      Eigen::Map<const Eigen::ArrayXd>(heights.data(), static_cast<Index>(heights.size()));
  require_that(line.allFinite(), "heights", "have undefined points; fill or crop them");
  return spectrum_of(line, {line.rows(), 1, length, length}, instrument, weight, std::move(name));
}

}  // namespace
}  // namespace twin_detail

ScanSpectrum scan_spectrum(const Field& heights, const Grid2D& grid,
                           const ScanInstrument& instrument, double weight, std::string name) {
  return twin_detail::spectrum_of_map(heights, grid, instrument, weight, std::move(name));
}

ScanSpectrum profile_spectrum(const std::vector<double>& heights, double length,
                              const ScanInstrument& instrument, double weight, std::string name) {
  return twin_detail::spectrum_of_line(heights, length, instrument, weight, std::move(name));
}

}  // namespace salebra
