// SPDX-License-Identifier: GPL-3.0-or-later
// Expected power spectrum of scans that are tapered and levelled, as a matrix over cells of the
// surface's spectrum.
#include "surface/twin_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <salebra/base/parallel.hpp>

#include "surface/twin_kernels.hpp"
#include "surface/twin_windows.hpp"

namespace salebra::twin_detail {
namespace {

/// Fourier transforms, with one taper along one side of a scan, of a wave, of its mean and of its
/// least-squares slope, at the modes 0 … count.
struct SideModes {
  Taper taper;
  double step;  ///< κ of one mode along this side
  std::vector<double> of_one, of_position;
  // Set by take() for one wave:
  std::vector<double> wave, mean_part, slope_part;

  SideModes(Taper kind, double mode_step, Index count) : taper(kind), step(mode_step) {
    for (Index k = 0; k <= count; ++k) {
      const double delta = -static_cast<double>(k);
      of_one.push_back(combined(taper, delta, sinc));
      of_position.push_back(combined(taper, delta, sinc_slope) / (2 * pi));
    }
    wave.resize(of_one.size());
    mean_part.resize(of_one.size());
    slope_part.resize(of_one.size());
  }

  void take(double kappa) {
    const double cycles = kappa / step, z = pi * cycles;
    const double mean = sinc(cycles);
    const double slope =
        std::abs(z) < 1e-2 ? 2 * z * (1 - z * z / 10) : 6 * (std::sin(z) / z - std::cos(z)) / z;
    for (std::size_t k = 0; k < wave.size(); ++k) {
      wave[k] = combined(taper, cycles - static_cast<double>(k), sinc);
      mean_part[k] = mean * of_one[k];
      slope_part[k] = slope * of_position[k];
    }
  }
};

/// The modes (k_x, k_y) of a scan with k_x, k_y >= 0 and κ between inner and outer, and the power
/// in them.
struct Quadrant {
  ScanModes modes;
  double inner, outer;
  Index count_x, count_y;
  std::vector<SideModes> along_x, along_y;
  std::vector<double> power;  // [k_x][k_y]

  Quadrant(const ScanModes& of, double from, double to, const std::vector<Taper>& tapers)
      : modes(of),
        inner(from),
        outer(to),
        count_x(static_cast<Index>(to / of.step_x)),
        count_y(static_cast<Index>(to / of.step_y)) {
    for (const Taper taper : tapers) {
      along_x.emplace_back(taper, modes.step_x, count_x);
      along_y.emplace_back(taper, modes.step_y, count_y);
    }
  }
};

/// Adds to each mode of the quadrant the mean power, over all directions, that it has from waves of
/// wave number κ, times a weight.
void add_waves(double kappa, double weight, bool narrow, Quadrant& quadrant) {
  const ScanModes& modes = quadrant.modes;
  auto &along_x = quadrant.along_x, &along_y = quadrant.along_y;
  const double inner = quadrant.inner, outer = quadrant.outer;
  const double finest = std::min(modes.step_x, modes.step_y);
  const int angles = std::max(8, static_cast<int>(std::ceil(1.3 * kappa / finest)));
  for (int a = 0; a < angles; ++a) {
    const double angle = (a + 0.5) / angles * pi / 2;
    for (const int sign_x : {1, -1}) {
      const double kappa_x = sign_x * kappa * std::cos(angle);
      if (narrow && kappa_x < -window_reach * modes.step_x) continue;
      for (SideModes& side : along_x) side.take(kappa_x);
      for (const int sign_y : {1, -1}) {
        const double kappa_y = sign_y * kappa * std::sin(angle);
        if (narrow && kappa_y < -window_reach * modes.step_y) continue;
        for (SideModes& side : along_y) side.take(kappa_y);
        const double share =
            weight / (4.0 * angles * static_cast<double>(along_x.size() * along_y.size()));
        for (Index k = 0; k <= quadrant.count_x; ++k) {
          const double x = static_cast<double>(k) * modes.step_x;
          if (narrow && std::abs(x - kappa_x) > window_reach * modes.step_x) continue;
          double low = std::sqrt(std::max(0.0, inner * inner - x * x)),
                 high = std::sqrt(std::max(0.0, outer * outer - x * x));
          if (narrow) {
            low = std::max(low, kappa_y - window_reach * modes.step_y);
            high = std::min(high, kappa_y + window_reach * modes.step_y);
          }
          const auto first = static_cast<Index>(low / modes.step_y);
          const auto last =
              std::min(quadrant.count_y, static_cast<Index>(std::ceil(high / modes.step_y)));
          if (last < first) continue;
          const auto from = static_cast<std::size_t>(first), at = static_cast<std::size_t>(k);
          const std::span powers(quadrant.power.data() + k * (quadrant.count_y + 1) + first,
                                 static_cast<std::size_t>(last - first + 1));
          for (const SideModes& sx : along_x)
            for (const SideModes& sy : along_y)
              add_squares(
                  {sx.wave[at], sx.mean_part[at] + sx.slope_part[at], sx.mean_part[at]},
                  {sy.wave.data() + from, sy.mean_part.data() + from, sy.slope_part.data() + from},
                  share, powers);
        }
      }
    }
  }
}

/// The bins first … last − 1, which all use the same tapers.
struct TaperedBins {
  std::size_t first, last;
  std::vector<Taper> tapers;
};

/// Adds the response of the bins in `some`, with their tapers, to all cells of the spectrum.
void add_full_response(const ScanModes& modes, const std::vector<double>& limits, bool drifts,
                       const TaperedBins& some, Response& response) {
  const std::size_t first = some.first, last = some.last;
  const std::vector<Taper>& tapers = some.tapers;
  if (first >= last) return;
  const bool hann = tapers.front() == Taper::hann;
  const double inner = limits[first], outer = limits[last];
  const double max_source = hann ? max_hann : max_tapered;
  const std::size_t cells = std::min(response.middle.size(), cell_of(response, max_source) + 1);
  parallel::for_slabs(static_cast<Index>(cells), [&](Index begin, Index end) {
    Quadrant quadrant(modes, inner, outer, tapers);
    for (Index cell = begin; cell < end; ++cell) {
      const auto at = static_cast<std::size_t>(cell);
      const double low = response.limits[at], high = response.limits[at + 1];
      quadrant.power.assign(
          static_cast<std::size_t>((quadrant.count_x + 1) * (quadrant.count_y + 1)), 0.0);
      // Represent a cell by waves whose κ are at most 0.35 modes apart.
      const int parts = std::max(1, static_cast<int>(std::ceil((high - low) / 0.35)));
      for (int part = 0; part < parts; ++part) {
        const double a = low + (high - low) * part / parts,
                     b = low + (high - low) * (part + 1) / parts;
        const double kappa = parts == 1 ? response.middle[at] : (a + b) / 2;
        add_waves(kappa, ring(a, b, response.middle[at]), hann && kappa > flat_above, quadrant);
      }
      std::vector<double> sums(last - first), counts(last - first);
      for (Index k = drifts ? drift_modes + 1 : 0; k <= quadrant.count_x; ++k)
        for (Index j = 0; j <= quadrant.count_y; ++j) {
          const double kappa = std::hypot(static_cast<double>(k) * modes.step_x,
                                          static_cast<double>(j) * modes.step_y);
          if (kappa < inner || kappa >= outer) continue;
          const auto bin =
              static_cast<std::size_t>(std::ranges::upper_bound(limits, kappa) - limits.begin()) -
              1 - first;
          const double count = (k > 0 ? 2 : 1) * (j > 0 ? 2 : 1);
          sums[bin] +=
              count * quadrant.power[static_cast<std::size_t>(k * (quadrant.count_y + 1) + j)];
          counts[bin] += count;
        }
      for (std::size_t bin = first; bin < last; ++bin)
        if (counts[bin - first] > 0)
          response.weights[at * response.bins + bin] = sums[bin - first] / counts[bin - first];
    }
  });
}

/// Adds the response of a bin above κ = 36: the mean of the spectrum C over the bin, whose limits
/// are as sharp as the window allows, and over the waves that sampling folds into the bin.
void add_mean(const ScanModes& modes, const Grid2D& grid, const std::vector<double>& limits,
              std::size_t bin, Response& response) {
  const double low = limits[bin], high = limits[bin + 1];
  const double area = pi * (high * high - low * low), step = std::sqrt(modes.step_x * modes.step_y);
  for (std::size_t cell = 0; cell < response.middle.size(); ++cell) {
    const double from = response.limits[cell], to = response.limits[cell + 1];
    if (to < low - 6 * step || from > high + 6 * step) continue;
    const int parts = static_cast<int>(std::ceil((to - from) / 0.35));
    for (int part = 0; part < parts; ++part) {
      const double a = from + (to - from) * part / parts,
                   b = from + (to - from) * (part + 1) / parts, kappa = (a + b) / 2;
      response.weights[cell * response.bins + bin] +=
          ring(a, b, response.middle[cell]) / area *
          (hann_below((high - kappa) / step) - hann_below((low - kappa) / step));
    }
  }
  if (high < modes.nyquist / 2) return;
  constexpr int radii = 6, angles = 12;
  const double period_x = static_cast<double>(grid.nx) * modes.step_x,
               period_y = static_cast<double>(grid.ny) * modes.step_y;
  for (int r = 0; r < radii; ++r)
    for (int a = 0; a < angles; ++a) {
      const double kappa = std::sqrt(low * low + (high * high - low * low) * (r + 0.5) / radii),
                   angle = (a + 0.5) / angles * pi / 2;
      for (const int i : {-1, 0, 1})
        for (const int j : {-1, 0, 1}) {
          if (i == 0 && j == 0) continue;
          const double image = std::hypot(kappa * std::cos(angle) + i * period_x,
                                          kappa * std::sin(angle) + j * period_y);
          const std::size_t cell = cell_of(response, image);
          response.weights[cell * response.bins + bin] +=
              std::pow(image / response.middle[cell], -tilt) / (radii * angles);
        }
    }
}

/// Area ∫dκ_x dκ_y of each cell of the spectrum between two κ_x >= 0, for both signs of κ_y.
std::vector<double> strips(const Response& response, double from, double to) {
  std::vector<double> areas;
  double before = 0;
  for (std::size_t cell = 0; cell < response.middle.size(); ++cell) {
    const double limit = response.limits[cell + 1];
    const auto primitive = [&](double x) {
      return x < limit ? x * std::sqrt(limit * limit - x * x) + limit * limit * std::asin(x / limit)
                       : limit * limit * pi / 2;
    };
    const double below = from < limit ? primitive(to) - primitive(from) : 0;
    areas.push_back(below - before);
    before = below;
  }
  return areas;
}

/// Adds the response of all bins of a line profile: the fraction of each wave κ_x, of either sign,
/// that the tapers leave in a bin, times the profile's density C₁ at κ_x, an integral over the
/// cells of C.
void add_profile(const ScanModes& modes, const std::vector<double>& limits, Response& response) {
  const double unit = 2 * pi / modes.side;
  const std::size_t tapered = tapered_bins(limits), full = std::max(tapered, response_bins(limits));
  const auto add = [&](std::size_t bin, const std::vector<double>& areas, double share) {
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
      response.weights[cell * response.bins + bin] += unit * share * areas[cell];
  };
  const auto last = static_cast<Index>(std::ceil(limits[full])) - 1;
  std::vector<SideModes> sides;
  for (const Taper taper : {Taper::first_sine, Taper::second_sine, Taper::hann})
    sides.emplace_back(taper, 1, last);
  // The steps of κ_x are fine at small κ_x, where the least-squares line removes most of a wave and
  // what remains grows as κ_x⁴.
  std::vector<double> positions{0};
  while (positions.back() < max_hann)
    positions.push_back(positions.back() + std::clamp(positions.back() / 20, 0.002, 0.04));
  for (std::size_t step = 0; step + 1 < positions.size(); ++step) {
    const double middle = (positions[step] + positions[step + 1]) / 2;
    const std::vector<double> areas = strips(response, positions[step], positions[step + 1]);
    std::vector<double> shares(full);
    for (const double kappa_x : {middle, -middle})
      for (SideModes& side : sides) {
        side.take(kappa_x);
        const bool hann = side.taper == Taper::hann;
        for (std::size_t bin = hann ? tapered : 0; bin < (hann ? full : tapered); ++bin) {
          const auto first = static_cast<std::size_t>(std::ceil(limits[bin])),
                     after = static_cast<std::size_t>(std::ceil(limits[bin + 1]));
          for (std::size_t k = first; k < after; ++k) {
            const double amplitude = side.wave[k] - side.mean_part[k] - side.slope_part[k];
            shares[bin] +=
                amplitude * amplitude / static_cast<double>((after - first) * (hann ? 1 : 2));
          }
        }
      }
    for (std::size_t bin = 0; bin < full; ++bin) add(bin, areas, shares[bin]);
  }
  // In the bins above κ = 36, means over the bin and over the waves that sampling folds into it.
  const double period = 2 * modes.nyquist;
  for (std::size_t bin = full; bin < response.bins; ++bin) {
    const double low = limits[bin], high = limits[bin + 1], share = 1 / (high - low);
    add(bin, strips(response, low, high), share);
    for (const double fold : {period, 2 * period}) {
      add(bin, strips(response, fold - high, fold - low), share);
      add(bin, strips(response, fold + low, fold + high), share);
    }
  }
}

}  // namespace

Response response_of(const Grid2D& grid, bool drifts, const Lay& lay) {
  if (lay.stretch != 1) return elliptic_response(grid, drifts, lay);
  const ScanModes modes(grid);
  const std::vector<double> limits = bin_limits(modes.nyquist);
  const std::size_t bins = limits.size() - 1;
  if (grid.ny == 1) {
    // The spectrum of a profile contains waves that run across it, however short they are.
    Response response = empty_response(40 * modes.nyquist, bins);
    add_profile(modes, limits, response);
    return response;
  }
  Response response = empty_response(std::max(max_hann, 4.5 * modes.nyquist), bins);
  const std::size_t tapered = tapered_bins(limits), full = std::max(tapered, response_bins(limits));
  add_full_response(modes, limits, drifts, {0, tapered, {Taper::first_sine, Taper::second_sine}},
                    response);
  add_full_response(modes, limits, drifts, {tapered, full, {Taper::hann}}, response);
  for (std::size_t bin = full; bin < bins; ++bin) add_mean(modes, grid, limits, bin, response);
  return response;
}

}  // namespace salebra::twin_detail
