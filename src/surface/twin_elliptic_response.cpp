// SPDX-License-Identifier: GPL-3.0-or-later
// Expected power spectrum of tapered and levelled maps of a surface with a lay, in elliptic rings.
#include <salebra/base/parallel.hpp>

#include "surface/twin_kernels.hpp"
#include "surface/twin_windows.hpp"

namespace salebra::twin_detail {
namespace {

/// Fourier transforms at the modes lowest … highest along one side, with one taper, of a wave, of its
/// mean and of its least-squares slope: those of combined(), with one sine and cosine for each wave.
struct SideWaves {
  Taper taper;
  double step;  ///< κ of one mode along this side
  Index lowest, highest;
  std::vector<double> of_one, of_position;
  // Set by take() for one wave:
  std::vector<double> wave, mean_part, slope_part;

  SideWaves(Taper kind, double mode_step, Index from, Index to)
      : taper(kind), step(mode_step), lowest(from), highest(to) {
    for (Index k = lowest; k <= highest; ++k) {
      of_one.push_back(combined(taper, -static_cast<double>(k), sinc));
      of_position.push_back(combined(taper, -static_cast<double>(k), sinc_slope) / (2 * pi));
    }
    wave.resize(of_one.size());
    mean_part.resize(of_one.size());
    slope_part.resize(of_one.size());
  }

  /// Sets the transforms at the modes from … to of a wave with this κ along the side.
  void take(double kappa, Index from, Index to) {
    const double cycles = kappa / step, z = pi * cycles, sine = std::sin(z), cosine = std::cos(z);
    const double mean = sinc(cycles);
    const double slope =
        std::abs(z) < 1e-2 ? 2 * z * (1 - z * z / 10) : 6 * (sine / z - cosine) / z;
    for (Index k = std::max(from, lowest); k <= std::min(to, highest); ++k) {
      const auto at = static_cast<std::size_t>(k - lowest);
      const double sign = k % 2 == 0 ? 1 : -1;
      wave[at] = transform(cycles - static_cast<double>(k), sign * sine, sign * cosine);
      mean_part[at] = mean * of_one[at];
      slope_part[at] = slope * of_position[at];
    }
  }

 private:
  /// combined(taper, d, sinc) in closed form, with sin πd and cos πd.
  double transform(double d, double sine, double cosine) const {
    const double square = d * d;
    const double below = taper == Taper::first_sine    ? square - 0.25
                         : taper == Taper::second_sine ? square - 1
                                                       : d * (square - 1);
    if (std::abs(below) < 1e-4) return combined(taper, d, sinc);
    switch (taper) {
      case Taper::first_sine:
        return -std::numbers::sqrt2 / (2 * pi) * cosine / below;
      case Taper::second_sine:
        return std::numbers::sqrt2 / pi * sine / below;
      case Taper::hann:
        break;
    }
    return -std::sqrt(8.0 / 3) / (2 * pi) * sine / below;
  }
};

/// The wave vector (κ_x, κ_y) of an elliptic one.
struct Physical {
  double x, y;
};
Physical physical(const Lay& lay, double across, double along) {
  const double c = std::cos(lay.angle), s = std::sin(lay.angle), root = std::sqrt(lay.stretch);
  return {c * along / root - s * across * root, s * along / root + c * across * root};
}

/// The modes (k_x, k_y) with k_y >= 0 in elliptic rings from inner to outer, and the power in them.
struct HalfPlane {
  ScanModes modes;
  const Lay& lay;
  bool hann;
  Index count_x, count_y;
  std::vector<SideWaves> along_x, along_y;
  std::vector<Index> first, last;  // k_y of the outer ellipse, for each k_x
  std::vector<double> power;       // [k_x][k_y]

  HalfPlane(const Grid2D& grid, const Lay& of, double outer, const std::vector<Taper>& tapers)
      : modes(grid, of), lay(of), hann(tapers.front() == Taper::hann) {
    const double c = std::cos(lay.angle), s = std::sin(lay.angle), stretch = lay.stretch;
    const double half_x = outer * std::sqrt(c * c / stretch + s * s * stretch),
                 half_y = outer * std::sqrt(s * s / stretch + c * c * stretch);
    count_x = static_cast<Index>(half_x / modes.step_x);
    count_y = static_cast<Index>(half_y / modes.step_y);
    if (!hann) {
      count_x = std::min(count_x, tapered_modes(grid.nx, modes.step_x));
      count_y = std::min(count_y, tapered_modes(grid.ny, modes.step_y));
    }
    for (const Taper taper : tapers) {
      along_x.emplace_back(taper, modes.step_x, -count_x, count_x);
      along_y.emplace_back(taper, modes.step_y, Index{0}, count_y);
    }
    // u² = g_xx x² + 2 g_xy xy + g_yy y² = outer², solved for y.
    const Lay::Vector ex = lay.elliptic(1, 0), ey = lay.elliptic(0, 1);
    const double xx = ex.across * ex.across + ex.along * ex.along,
                 xy = ex.across * ey.across + ex.along * ey.along,
                 yy = ey.across * ey.across + ey.along * ey.along;
    for (Index k = -count_x; k <= count_x; ++k) {
      const double x = static_cast<double>(k) * modes.step_x;
      const double root =
          std::sqrt(std::max(0.0, x * x * (xy * xy - xx * yy) + yy * outer * outer)) / yy;
      const double middle = -xy / yy * x;
      first.push_back(
          std::max(Index{0}, static_cast<Index>(std::floor((middle - root) / modes.step_y))));
      last.push_back(
          std::min(count_y, static_cast<Index>(std::ceil((middle + root) / modes.step_y))));
    }
    power.resize(first.size() * static_cast<std::size_t>(count_y + 1));
  }

  /// Adds to each mode the mean power, over the directions of the elliptic wave number κ, that it has
  /// from waves of κ, times a weight.
  void add_waves(double kappa, double weight) {
    const double finest = std::min(modes.step_x, modes.step_y), root = std::sqrt(lay.stretch);
    const int angles = std::max(32, static_cast<int>(std::ceil(5.2 * kappa * root / finest)));
    const double share = weight / (angles * static_cast<double>(along_x.size() * along_y.size()));
    for (int a = 0; a < angles; ++a) {
      const double angle = (a + 0.5) / angles * 2 * pi;
      const auto [x, y] = physical(lay, kappa * std::cos(angle), kappa * std::sin(angle));
      const bool narrow = hann && std::hypot(x, y) > flat_above;
      Index from_x = -count_x, to_x = count_x, from_y = 0, to_y = count_y;
      if (narrow) {
        from_x = std::max(from_x, static_cast<Index>(std::ceil(x / modes.step_x - window_reach)));
        to_x = std::min(to_x, static_cast<Index>(std::floor(x / modes.step_x + window_reach)));
        from_y = std::max(from_y, static_cast<Index>(std::ceil(y / modes.step_y - window_reach)));
        to_y = std::min(to_y, static_cast<Index>(std::floor(y / modes.step_y + window_reach)));
        if (from_x > to_x || from_y > to_y) continue;
      }
      for (SideWaves& side : along_x) side.take(x, from_x, to_x);
      for (SideWaves& side : along_y) side.take(y, from_y, to_y);
      for (Index k = from_x; k <= to_x; ++k) {
        const auto row = static_cast<std::size_t>(k + count_x);
        const Index begin = std::max(first[row], from_y), end = std::min(last[row], to_y);
        if (end < begin) continue;
        const auto from = static_cast<std::size_t>(begin);
        const std::span powers(power.data() + row * static_cast<std::size_t>(count_y + 1) + from,
                               static_cast<std::size_t>(end - begin + 1));
        for (const SideWaves& sx : along_x)
          for (const SideWaves& sy : along_y)
            add_squares(
                {sx.wave[row], sx.mean_part[row] + sx.slope_part[row], sx.mean_part[row]},
                {sy.wave.data() + from, sy.mean_part.data() + from, sy.slope_part.data() + from},
                share, powers);
      }
    }
  }
};

/// Adds the response of the bins first … last − 1, which all use the same tapers, to all cells.
void add_full_response(const Grid2D& grid, const std::vector<double>& limits, bool drifts,
                       const Lay& lay, const std::vector<Taper>& tapers, std::size_t first,
                       std::size_t last, Response& response) {
  if (first >= last) return;
  const double inner = limits[first], outer = limits[last];
  const double max_source = tapers.front() == Taper::hann ? max_hann : max_tapered;
  const std::size_t cells = std::min(response.middle.size(), cell_of(response, max_source) + 1);
  // Waves are at most a mode apart in each direction: closer is no better, since the transforms of
  // products of two windows have no lag beyond the side.
  const double apart = std::min(0.35, 1 / std::sqrt(lay.stretch));
  parallel::for_slabs(static_cast<Index>(cells), [&](Index begin, Index end) {
    HalfPlane plane(grid, lay, outer, tapers);
    for (Index cell = begin; cell < end; ++cell) {
      const auto at = static_cast<std::size_t>(cell);
      const double low = response.limits[at], high = response.limits[at + 1];
      std::ranges::fill(plane.power, 0.0);
      const int parts = std::max(1, static_cast<int>(std::ceil((high - low) / apart)));
      for (int part = 0; part < parts; ++part) {
        const double a = low + (high - low) * part / parts,
                     b = low + (high - low) * (part + 1) / parts;
        plane.add_waves(parts == 1 ? response.middle[at] : (a + b) / 2,
                        ring(a, b, response.middle[at]));
      }
      std::vector<double> sums(last - first), counts(last - first);
      for (Index k = -plane.count_x; k <= plane.count_x; ++k) {
        if (drifts && std::abs(k) <= drift_modes) continue;
        for (Index j = 0; j <= plane.count_y; ++j) {
          // A mode stands for its conjugate, too.
          if (j == 0 && k <= 0) continue;
          const Lay::Vector u = lay.elliptic(static_cast<double>(k) * plane.modes.step_x,
                                             static_cast<double>(j) * plane.modes.step_y);
          const double kappa = std::hypot(u.across, u.along);
          if (kappa < inner || kappa >= outer) continue;
          const auto bin =
              static_cast<std::size_t>(std::ranges::upper_bound(limits, kappa) - limits.begin()) -
              1 - first;
          sums[bin] +=
              plane.power[static_cast<std::size_t>((k + plane.count_x) * (plane.count_y + 1) + j)];
          counts[bin] += 1;
        }
      }
      for (std::size_t bin = first; bin < last; ++bin)
        if (counts[bin - first] > 0)
          response.weights[at * response.bins + bin] = sums[bin - first] / counts[bin - first];
    }
  });
}

/// Adds the response of a bin above κ = 36: the mean of the spectrum over the bin, whose limits are
/// as sharp as the window allows in each direction, and over the waves that sampling folds into it.
void add_mean(const Grid2D& grid, const ScanModes& modes, const Lay& lay,
              const std::vector<double>& limits, std::size_t bin, Response& response) {
  constexpr int directions = 16;
  const double low = limits[bin], high = limits[bin + 1], area = pi * (high * high - low * low);
  // The width of the window in the direction φ of the elliptic wave number.
  const Lay::Vector x = lay.elliptic(modes.step_x, 0), y = lay.elliptic(0, modes.step_y);
  std::vector<double> steps;
  double widest = 0;
  for (int direction = 0; direction < directions; ++direction) {
    const double angle = (direction + 0.5) / directions * pi, c = std::cos(angle),
                 s = std::sin(angle);
    steps.push_back(std::hypot(c * x.across + s * x.along, c * y.across + s * y.along));
    widest = std::max(widest, steps.back());
  }
  for (std::size_t cell = 0; cell < response.middle.size(); ++cell) {
    const double from = response.limits[cell], to = response.limits[cell + 1];
    if (to < low - 6 * widest || from > high + 6 * widest) continue;
    const int parts = static_cast<int>(std::ceil((to - from) / 0.35));
    for (int part = 0; part < parts; ++part) {
      const double a = from + (to - from) * part / parts,
                   b = from + (to - from) * (part + 1) / parts, kappa = (a + b) / 2;
      double within = 0;
      for (const double step : steps)
        within += hann_below((high - kappa) / step) - hann_below((low - kappa) / step);
      response.weights[cell * response.bins + bin] +=
          ring(a, b, response.middle[cell]) / area * within / directions;
    }
  }
  if (high < modes.nyquist / 2) return;
  constexpr int radii = 6, angles = 48;
  const double period_x = static_cast<double>(grid.nx) * modes.step_x,
               period_y = static_cast<double>(grid.ny) * modes.step_y;
  for (int r = 0; r < radii; ++r)
    for (int a = 0; a < angles; ++a) {
      const double kappa = std::sqrt(low * low + (high * high - low * low) * (r + 0.5) / radii),
                   angle = (a + 0.5) / angles * pi;
      const auto [kx, ky] = physical(lay, kappa * std::cos(angle), kappa * std::sin(angle));
      for (const int i : {-1, 0, 1})
        for (const int j : {-1, 0, 1}) {
          if (i == 0 && j == 0) continue;
          const Lay::Vector u = lay.elliptic(kx + i * period_x, ky + j * period_y);
          const double image = std::hypot(u.across, u.along);
          const std::size_t cell = cell_of(response, image);
          response.weights[cell * response.bins + bin] +=
              std::pow(image / response.middle[cell], -tilt) / (radii * angles);
        }
    }
}

}  // namespace

Response elliptic_response(const Grid2D& grid, bool drifts, const Lay& lay) {
  const ScanModes modes(grid, lay);
  const std::vector<double> limits = bin_limits(modes.nyquist);
  const std::size_t bins = limits.size() - 1;
  Response response = empty_response(std::max(max_hann, 4.5 * modes.nyquist), bins);
  const std::size_t tapered = tapered_bins(limits), full = std::max(tapered, response_bins(limits));
  add_full_response(grid, limits, drifts, lay, {Taper::first_sine, Taper::second_sine}, 0, tapered,
                    response);
  add_full_response(grid, limits, drifts, lay, {Taper::hann}, tapered, full, response);
  for (std::size_t bin = full; bin < bins; ++bin) add_mean(grid, modes, lay, limits, bin, response);
  return response;
}

}  // namespace salebra::twin_detail
