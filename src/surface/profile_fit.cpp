// SPDX-License-Identifier: GPL-3.0-or-later
// Isotropic self-affine surface from a line profile, by integration of its spectrum.
#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <ranges>
#include <salebra/base/error.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/profile_fit.hpp>
#include <span>
#include <vector>

#include "base/quiet_gsl.hpp"
#include "surface/asymmetry.hpp"
#include "surface/profile_law.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr std::size_t cosine_nodes = 16;

struct FreeTable {
  void operator()(gsl_integration_glfixed_table* table) const {
    gsl_integration_glfixed_table_free(table);
  }
};
/// ∫cos^power θ dθ between two angles, by a Gauss–Legendre rule.
double cosine_integral(double power, double from, double to) {
  static const std::unique_ptr<gsl_integration_glfixed_table, FreeTable> table(
      gsl_integration_glfixed_table_alloc(cosine_nodes));
  double sum = 0;
  for (std::size_t i = 0; i < cosine_nodes; ++i) {
    double angle, weight;
    gsl_integration_glfixed_point(from, to, i, &angle, &weight, table.get());
    sum += weight * std::pow(std::cos(angle), power);
  }
  return sum;
}

constexpr double endless = detail::ProfileLaw::endless;

/// Power spectral density of profiles under a window.
detail::SelfAffineDensity windowed_density(const detail::WaveMixing& mixing, double q_short) {
  const double reach = std::ranges::max(mixing | std::views::keys);
  return [&mixing, reach, q_short](double q, double hurst, double q_rolloff) {
    // Without a plateau the power law begins at a wave much longer than the profile.
    const double begin = q_rolloff > 0 ? q_rolloff : 1e-3 * reach;
    const auto at = [&](double q) { return profile_density(q, hurst, begin, q_short); };
    // At this wave number the window changes the density by less than the bins can resolve.
    if (q > 24 * reach) return at(q);
    double sum = 0;
    for (const auto& [displacement, share] : mixing) sum += share * at(std::abs(q + displacement));
    return sum;
  };
}

/// Number of the bin in which the power falls below a quarter of the law, if it falls below a
/// twentieth, and a tenth of what it was, soon after; the number of bins if there is no such bin.
std::size_t end_of_law(std::span<const detail::SpectrumBin> bins, const detail::PowerLawRange& law,
                       const detail::SelfAffineDensity& density) {
  // The first bins are left out: they have so few modes that some of them lack power by chance.
  for (std::size_t i = std::max<std::size_t>(bins.size() / 3, 2); i < bins.size(); ++i) {
    const auto share = [&](const detail::SpectrumBin& bin) {
      return bin.power / (law.amplitude * density(bin.wavenumber, law.hurst.value, law.q_rolloff));
    };
    if (share(bins[i]) > 0.25) continue;
    // The blur of a lens takes away power more slowly than this.
    constexpr double soon = 1.3, part = 0.1;
    for (std::size_t k = i; k < bins.size() && bins[k].wavenumber < soon * bins[i].wavenumber; ++k)
      if (share(bins[k]) < std::min(0.05, part * share(bins[i - 2]))) return i;
    break;
  }
  return bins.size();
}

/// Wavelength below which the waves of a profile come from interpolation: twice its longest
/// straight piece. 0 if fewer than four fifths of the points lie on straight pieces.
double interpolated_wavelength(const Surface& profile) {
  const Index n = profile.grid.nx;
  const double least = 1e-12 * profile.heights.abs().maxCoeff();
  Index straight = 0, run = 0, longest = 0;
  for (Index i = 1; i + 1 < n; ++i) {
    const double bend =
        profile.heights(i + 1, 0) - 2 * profile.heights(i, 0) + profile.heights(i - 1, 0);
    run = std::abs(bend) <= least ? run + 1 : 0;
    straight += run > 0;
    longest = std::max(longest, run);
  }
  if (5 * straight < 4 * n) return 0;
  return 2 * static_cast<double>(longest + 1) * profile.grid.dx();
}

std::vector<detail::SpectrumBin> profile_bins(const ProfilePsd& psd) {
  constexpr std::size_t mixed = 3;
  // Neighbouring modes under Hann's window are correlated: 35/18 modes count as one independent
  // mode.
  constexpr double independent = 18. / 35;
  constexpr double ratio = 1.12;
  std::vector<detail::SpectrumBin> bins;
  double end = 0;
  for (std::size_t k = mixed; k + 1 < psd.wavenumber.size(); ++k) {
    if (psd.wavenumber[k] >= end) {
      bins.push_back({0, 0, 0});
      end = ratio * psd.wavenumber[k];
    }
    bins.back().wavenumber += std::log(psd.wavenumber[k]);
    bins.back().power += psd.psd[k];
    bins.back().modes += 1;
  }
  // Relative error of the mean power of a bin that is tolerated, because no law describes a
  // spectrum more closely.
  constexpr double forgiven = 0.03;
  for (detail::SpectrumBin& bin : bins) {
    bin.wavenumber = std::exp(bin.wavenumber / bin.modes);
    bin.power /= bin.modes;
    bin.modes = 1 / (1 / (independent * bin.modes) + forgiven * forgiven);
  }
  return bins;
}

}  // namespace

double profile_density(double q, double hurst, double q_rolloff, double q_short) {
  if (q >= q_short) return 0;
  double density = 0;
  if (q < q_rolloff) density += 2 * std::sqrt(q_rolloff * q_rolloff - q * q);
  const double from = std::acos(q / std::max(q, q_rolloff)), to = std::acos(q / q_short);
  // The integral of cos^{2H} over a full quarter turn has the closed form √π Γ(H+½)/(2 Γ(H+1)),
  // with the Hurst exponent H.
  const double integral =
      q >= q_rolloff && q < 1e-9 * q_short
          ? std::sqrt(pi) / 2 * std::tgamma(hurst + 0.5) / std::tgamma(hurst + 1)
          : cosine_integral(2 * hurst, from, to);
  return density + 2 * std::pow(q_rolloff / q, 2 + 2 * hurst) * q * integral;
}

detail::ProfileLaw detail::fit_profile_law(const std::vector<SpectrumBin>& bins, double highest,
                                           const WaveMixing& mixing) {
  const auto below = [&](double limit) {
    return std::span(bins).first(static_cast<std::size_t>(
        std::ranges::count_if(bins, [&](const auto& bin) { return bin.wavenumber < limit; })));
  };
  ProfileLaw law;
  for (int round = 0;; ++round) {
    constexpr double steep = 0.85;
    const auto density = windowed_density(mixing, law.q_short);
    static_cast<PowerLawRange&>(law) =
        fit_power_law_range(below(std::min(highest, steep * law.q_short)), density, 4);
    if (!law.found() || round == 2) return law;
    const std::size_t end = end_of_law(bins, law, windowed_density(mixing, endless));
    const double q_short = end < bins.size() ? bins[end].wavenumber : endless;
    if (q_short == law.q_short) return law;
    law.q_short = q_short;
    law.q_short_low = end < bins.size() ? bins[end - 1].wavenumber : IntervalEstimate::unknown;
    // The powers of profiles fall gradually towards the end, so that it lies above the bin found.
    law.q_short_high = end + 2 < bins.size() ? bins[end + 2].wavenumber : q_short;
  }
}

ProfileFit fit_profile(const Surface& profile, double shortest_wavelength) {
  profile.require_complete("the spectrum of a profile");
  require(profile.grid.ny == 1 && profile.grid.nx >= 2, "profile",
          std::to_string(profile.grid.nx) + " x " + std::to_string(profile.grid.ny) + " points",
          "must be one line of at least two points");
  detail::quiet_gsl();
  const Surface level = detrended(profile, Detrend::plane);
  ProfileFit fit;
  fit.rms_height = height_statistics(level).rms_height;
  const Index n = level.grid.nx;
  fit.rms_slope =
      std::sqrt(((level.heights.bottomRows(n - 1) - level.heights.topRows(n - 1)) / level.grid.dx())
                    .square()
                    .mean());
  fit.surface_slope = std::numbers::sqrt2 * fit.rms_slope;
  constexpr Index fewest = 32;
  if (!(fit.rms_height > 1e-9 * profile.heights.abs().maxCoeff()) || n < fewest) return fit;
  if (shortest_wavelength == 0) shortest_wavelength = detail::asymmetric_wavelength(level);
  const double unreliable = std::max(shortest_wavelength, interpolated_wavelength(profile));
  // Waves shorter than two and a half cells suffer most from aliasing, and no law describes their
  // power.
  const double highest =
      std::min(0.8 * pi / level.grid.dx(), unreliable > 0 ? 2 * pi / unreliable : endless);
  std::vector<detail::SpectrumBin> bins = profile_bins(profile_psd(level, Axis::x, Window::hann));
  if (unreliable > 0)
    std::erase_if(bins, [&](const auto& bin) { return bin.wavenumber > highest; });
  if (std::ranges::any_of(bins, [](const auto& bin) { return !(bin.power > 0); })) return fit;

  // Hann's window mixes each wave with its two neighbours.
  const double step = 2 * pi / level.grid.lx;
  const detail::ProfileLaw law =
      detail::fit_profile_law(bins, highest, {{-step, 1. / 6}, {0, 4. / 6}, {step, 1. / 6}});
  if (!law.found()) return fit;
  if (law.q_short != endless) fit.short_cutoff = 2 * pi / law.q_short;
  fit.rolloff = law.rolloff().value;
  fit.hurst = law.hurst;
  return fit;
}

}  // namespace salebra
