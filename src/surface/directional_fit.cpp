// SPDX-License-Identifier: GPL-3.0-or-later
// Self-affine law of the profiles of a surface along any direction, from its spectrum.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <span>
#include <vector>

#include "surface/profile_law.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

/// Strips of wave vectors at right angles to a direction. All waves of a strip have nearly the same
/// component q along the direction, so that the sum of their powers is the power of the profiles.
class Strips {
 public:
  /// step: smallest width of a strip, rad/m
  Strips(double lowest, double highest, double step) : limits_{lowest} {
    constexpr double ratio = 1.12;
    while (limits_.back() < highest)
      limits_.push_back(std::max(ratio * limits_.back(), limits_.back() + step));
  }
  std::size_t size() const { return limits_.size() - 1; }
  double width(std::size_t strip) const { return limits_[strip + 1] - limits_[strip]; }
  /// Number of the strip that contains q; size() if there is none.
  std::size_t number_of(double q) const {
    const auto above = std::ranges::upper_bound(limits_, q);
    return above == limits_.begin() || above == limits_.end()
               ? size()
               : static_cast<std::size_t>(above - limits_.begin()) - 1;
  }

 private:
  std::vector<double> limits_;
};

}  // namespace

std::vector<detail::SpectrumBin> detail::profile_bins(const PowerSpectrum& spectrum,
                                                      double direction, double lowest) {
  const double c = std::cos(direction), s = std::sin(direction);
  const Grid2D& grid = spectrum.grid;
  // The distance of wave numbers along the direction.
  const double step = 2 * pi * std::max(std::abs(c) / grid.lx, std::abs(s) / grid.ly);
  const Strips strips(lowest, pi / std::max(grid.dx(), grid.dy()), step);
  const RowPartition columns = spectrum.columns();
  constexpr std::size_t numbers = 4;
  const std::vector<double> sums = parallel::sum_blocks(
      columns, numbers * strips.size(), [&](Index begin, Index end, std::span<double> of_block) {
        for (Index i = 0; i < spectrum.grid.nx; ++i) {
          const double along_x = c * spectrum.wavenumber_x(i);
          for (Index k = begin; k < end; ++k) {
            const Index j = columns.begin() + k;
            const double q = std::abs(along_x + s * spectrum.wavenumber_y(j));
            const std::size_t strip = strips.number_of(q);
            if (strip == strips.size()) continue;
            const double weight = spectrum.multiplicity(j) / 2, power = weight * spectrum.psd(i, k);
            const auto sum = of_block.subspan(numbers * strip, numbers);
            sum[0] += power;
            sum[1] += power * spectrum.psd(i, k);
            sum[2] += power * std::log(q);
            sum[3] += weight;
          }
        }
      });
  // Relative error of the mean power of a strip that is tolerated, because no law describes a
  // spectrum more closely.
  constexpr double forgiven = 0.03;
  std::vector<detail::SpectrumBin> bins;
  for (std::size_t strip = 0; strip < strips.size(); ++strip) {
    const auto sum = std::span(sums).subspan(numbers * strip, numbers);
    if (!(sum[0] > 0)) break;
    // If n exponentially distributed powers had the same mean, the square of their sum over the sum
    // of their squares would be (n + 1)/2; powers of different means count as fewer.
    const double powers = std::max(1.0, 2 * sum[0] * sum[0] / sum[1] - 1);
    const double independent = powers / spectrum.correlated_modes;
    // C₁ is the power for q and −q together over the width, and `sum` is that of half the plane.
    bins.push_back({std::exp(sum[2] / sum[0]), sum[0] * spectrum.cell() / strips.width(strip),
                    1 / (1 / independent + forgiven * forgiven)});
  }
  return bins;
}

namespace {

/// The mixing of wave numbers along a direction by Hann's window, which mixes each wave vector with
/// its eight neighbours.
detail::WaveMixing mixing_along(const Grid2D& grid, double direction) {
  const double step_x = 2 * pi / grid.lx * std::cos(direction),
               step_y = 2 * pi / grid.ly * std::sin(direction);
  detail::WaveMixing mixing;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      mixing.emplace_back(i * step_x + j * step_y, (i == 0 ? 4 : 1) * (j == 0 ? 4 : 1) / 36.0);
  return mixing;
}

/// The law along one direction. shortest: wavelength below which no wave counts, m.
struct Along {
  SelfAffineFit fit;
  /// Wave number up to which the power is that of the law, rad/m; infinite if the law ends before
  /// the grid does.
  double unattenuated = 0;
};

Along fit_along(const PowerSpectrum& spectrum, double direction, double shortest) {
  const Grid2D& grid = spectrum.grid;
  const double c = std::abs(std::cos(direction)), s = std::abs(std::sin(direction));
  const double end = pi / std::max(grid.dx(), grid.dy());
  const double lowest = 4 * 2 * pi * std::hypot(c / grid.lx, s / grid.ly);
  // Waves shorter than two and a half cells suffer most from aliasing, and no law describes their
  // power.
  double highest = 0.8 * end;
  if (shortest > 0) highest = std::min(highest, 2 * pi / shortest);
  if (!(highest > lowest)) return {};
  const std::vector<detail::SpectrumBin> bins = detail::profile_bins(spectrum, direction, lowest);
  detail::ProfileLaw law = detail::fit_profile_law(bins, highest, mixing_along(grid, direction));
  spectrum.communicator.broadcast(&law, sizeof law);
  // Below 0 there is no law, but mostly a floor.
  if (!law.found() || law.hurst.low < 0) return {};
  double modes = 0;
  for (std::size_t k = law.begin; k < law.end; ++k) modes += bins[k].modes;
  const bool ends = law.q_short < 0.9 * end;
  const double last = bins[law.end - 1].wavenumber;
  constexpr double most_attenuation = 0.1;  ///< g q² that is left out of account
  Along found{{{law.hurst, bins[law.begin].wavenumber, last, static_cast<Index>(2 * modes)},
               law.rolloff(),
               {}},
              ends       ? std::numeric_limits<double>::infinity()
              : law.pure ? last
                         : last * std::sqrt(std::min(1.0, most_attenuation / law.attenuation))};
  if (ends)
    found.fit.short_cutoff = {2 * pi / law.q_short, 2 * pi / law.q_short_high,
                              2 * pi / law.q_short_low};
  return found;
}

}  // namespace

DirectionalSelfAffineFit fit_self_affine(const PowerSpectrum& spectrum, const SurfaceLay& lay,
                                         double shortest_wavelength) {
  require(spectrum.windowed, "spectrum", "no window", "must have a window, such as hann");
  require(std::isfinite(lay.angle) && lay.ratio >= 1, "lay", "unknown",
          "must be that of a surface");
  double shortest = shortest_wavelength > 0 ? shortest_wavelength : spectrum.asymmetric_wavelength;
  const Along across = fit_along(spectrum, lay.angle + pi / 2, shortest);
  DirectionalSelfAffineFit fit{across.fit, {}};
  if (!across.fit.hurst.found()) return fit;
  // A profile along the lay gets most of its power at q from waves with a component across the lay
  // of up to three times `ratio`·q, which have to follow the law.
  shortest = std::max(shortest, 3 * lay.ratio * 2 * pi / across.unattenuated);
  fit.along = fit_along(spectrum, lay.angle, shortest).fit;
  // The end of the grid across the lay looks like an end of the profiles along it.
  const double visible = 2.2 * std::max(spectrum.grid.dx(), spectrum.grid.dy());
  if (!(fit.along.short_cutoff.value > lay.ratio * visible)) fit.along.short_cutoff = {};
  return fit;
}

}  // namespace salebra
