// SPDX-License-Identifier: GPL-3.0-or-later
// Isotropic self-affine surface of a line profile, by integration of its spectrum.
#include <gsl/gsl_integration.h>
#include <gsl/gsl_multimin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/profile_fit.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/quiet_gsl.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr std::size_t cosine_nodes = 16;

struct FreeTable {
  void operator()(gsl_integration_glfixed_table* table) const {
    gsl_integration_glfixed_table_free(table);
  }
};
struct FreeMinimizer {
  void operator()(gsl_multimin_fminimizer* minimizer) const {
    gsl_multimin_fminimizer_free(minimizer);
  }
};
struct FreeVector {
  void operator()(gsl_vector* vector) const { gsl_vector_free(vector); }
};

/// ∫cos^power θ dθ by a Gauss–Legendre rule.
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

/// Means of P over bins of wave numbers, with the number of independent modes in each.
struct ProfileBin {
  double wavenumber, power, modes;
};

/// The law within the first bins of a spectrum: its amplitude is the most likely one.
class ProfileRange {
 public:
  /// q_short: where C ends; infinity where it does not within the profile.
  ProfileRange(std::span<const ProfileBin> bins, double q_short) : bins_(bins), q_short_(q_short) {}

  struct Law {
    double deviance = 1e300;  ///< −ln L over that of a law through every bin
    double hurst = 0.7, q_rolloff = 0, amplitude = 0;

    double density(double q, double q_short) const {
      return amplitude * profile_density(q, hurst, q_rolloff, q_short);
    }
  };

  /// The most likely law; hurst: held. Without a plateau, the power law begins beyond the profile.
  Law fit(bool plateau, std::optional<double> hurst = {}) const {
    Law best;
    const double first = std::log(bins_.front().wavenumber),
                 span = std::log(bins_.back().wavenumber) - first;
    for (const double place : {0.0, 0.3, 0.6}) {
      if (!plateau && place > 0) continue;
      const Law found = descend(hurst, hurst.value_or(0.6), plateau, first + place * span);
      if (found.deviance < best.deviance) best = found;
    }
    return best;
  }

 private:
  Law at(double hurst, double q_rolloff) const {
    Law law{.hurst = hurst, .q_rolloff = q_rolloff};
    if (!(hurst > 0.01 && hurst < 1.3 && q_rolloff < bins_.back().wavenumber)) return law;
    double weighted = 0, modes = 0, logarithms = 0;
    for (const ProfileBin& bin : bins_) {
      const double ratio = bin.power / profile_density(bin.wavenumber, hurst, q_rolloff, q_short_);
      weighted += bin.modes * ratio;
      modes += bin.modes;
      logarithms -= bin.modes * std::log(ratio);
    }
    law.amplitude = weighted / modes;
    law.deviance = logarithms + modes * std::log(law.amplitude);
    return law;
  }

  /// What a minimum is searched over.
  struct Search {
    const ProfileRange* range;
    std::optional<double> hurst;
    bool plateau;

    Law law(const gsl_vector* place) const {
      std::size_t next = 0;
      const double free = hurst ? *hurst : gsl_vector_get(place, next++);
      const double begin = 1e-3 * range->bins_.front().wavenumber;
      return range->at(free, plateau ? std::exp(gsl_vector_get(place, next)) : begin);
    }
  };

  Law descend(std::optional<double> held, double hurst, bool plateau, double log_rolloff) const {
    const Search search{this, held, plateau};
    std::vector<std::pair<double, double>> from;  // and how far the first step goes
    if (!held) from.emplace_back(hurst, 0.1);
    if (plateau) from.emplace_back(log_rolloff, 0.4);
    const std::unique_ptr<gsl_vector, FreeVector> place(
        gsl_vector_alloc(std::max<std::size_t>(1, from.size()))),
        step(gsl_vector_alloc(std::max<std::size_t>(1, from.size())));
    for (std::size_t i = 0; i < from.size(); ++i) {
      gsl_vector_set(place.get(), i, from[i].first);
      gsl_vector_set(step.get(), i, from[i].second);
    }
    if (from.empty()) return search.law(place.get());
    gsl_multimin_function function{[](const gsl_vector* x, void* data) {
                                     return static_cast<const Search*>(data)->law(x).deviance;
                                   },
                                   from.size(), const_cast<Search*>(&search)};
    const std::unique_ptr<gsl_multimin_fminimizer, FreeMinimizer> minimizer(
        gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, from.size()));
    gsl_multimin_fminimizer_set(minimizer.get(), &function, place.get(), step.get());
    constexpr int most = 150;
    for (int i = 0; i < most; ++i) {
      if (gsl_multimin_fminimizer_iterate(minimizer.get()) != 0) break;
      if (gsl_multimin_fminimizer_size(minimizer.get()) < 3e-4) break;
    }
    return search.law(minimizer->x);
  }

  std::span<const ProfileBin> bins_;
  double q_short_;
};

constexpr double endless = 1e300;

/// The bins that the law describes, at least a third: one that it misses costs more than to leave
/// it and all shorter waves out.
std::size_t described_bins(std::span<const ProfileBin> bins) {
  constexpr double left_out = 2;
  std::size_t best = bins.size();
  double least = 1e300;
  for (std::size_t count = std::max<std::size_t>(6, bins.size() / 3); count <= bins.size();
       count += 2) {
    const double cost = ProfileRange(bins.first(count), endless).fit(true).deviance +
                        left_out * static_cast<double>(bins.size() - count);
    if (cost < least) {
      least = cost;
      best = count;
    }
  }
  return best;
}

/// Where the power falls below a quarter of the law, and soon to a twentieth; endless where it does
/// not.
double end_of_law(std::span<const ProfileBin> bins, const ProfileRange::Law& law) {
  // Long waves are too few: some of them lack power by chance.
  for (std::size_t i = bins.size() / 3; i < bins.size(); ++i) {
    const auto share = [&](const ProfileBin& bin) {
      return bin.power / law.density(bin.wavenumber, endless);
    };
    if (share(bins[i]) > 0.25) continue;
    constexpr double soon = 1.6;
    for (std::size_t k = i; k < bins.size() && bins[k].wavenumber < soon * bins[i].wavenumber; ++k)
      if (share(bins[k]) < 0.05) return bins[i].wavenumber;
    return endless;
  }
  return endless;
}

std::vector<ProfileBin> profile_bins(const ProfilePsd& psd) {
  constexpr std::size_t mixed = 2;
  // Neighbours under Hann's window are correlated: 35/18 of them count as one.
  constexpr double independent = 18. / 35;
  constexpr double ratio = 1.12;
  std::vector<ProfileBin> bins;
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
  // A spectrum that no law describes to better than a twentieth.
  constexpr double forgiven = 0.05;
  for (ProfileBin& bin : bins) {
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
  return density +
         2 * std::pow(q_rolloff / q, 2 + 2 * hurst) * q * cosine_integral(2 * hurst, from, to);
}

ProfileFit fit_profile(const Surface& profile) {
  profile.require_complete("the spectrum of a profile");
  require(profile.grid.ny == 1 && profile.grid.nx >= 2, "profile",
          std::to_string(profile.grid.nx) + " x " + std::to_string(profile.grid.ny) + " points",
          "must be one line of two points at least");
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
  const std::vector<ProfileBin> bins = profile_bins(profile_psd(level, Axis::x, Window::hann));
  if (std::ranges::any_of(bins, [](const ProfileBin& bin) { return !(bin.power > 0); })) return fit;

  const std::span<const ProfileBin> all(bins);
  std::size_t count = described_bins(all);
  double q_short = endless;
  ProfileRange::Law law = ProfileRange(all.first(count), q_short).fit(true);
  // Short of its end, the law's own profiles lack what lies beyond.
  for (int round = 0; round < 2; ++round) {
    q_short = end_of_law(all, law);
    if (q_short == endless) break;
    constexpr double steep = 0.85;
    count = static_cast<std::size_t>(std::ranges::count_if(
        all, [&](const ProfileBin& bin) { return bin.wavenumber < steep * q_short; }));
    law = ProfileRange(all.first(count), q_short).fit(true);
  }
  const ProfileRange range(all.first(count), q_short);
  if (q_short != endless) fit.short_cutoff = 2 * pi / q_short;
  constexpr double limit = 1.92;  // half of the 95 % point of χ² with one degree of freedom
  if (range.fit(false).deviance - law.deviance > limit && law.q_rolloff > all.front().wavenumber)
    fit.rolloff = 2 * pi / law.q_rolloff;
  fit.hurst.value = law.hurst;
  // Outwards until the likelihood has fallen by the limit, then between.
  const auto end = [&](double direction) {
    double inside = law.hurst;
    for (double step = 0.02; step > 1e-3 && inside > 0.02 && inside < 1.28;) {
      if (range.fit(true, inside + direction * step).deviance - law.deviance > limit)
        step /= 3;
      else
        inside += direction * step;
    }
    return inside;
  };
  fit.hurst.low = end(-1);
  fit.hurst.high = end(1);
  return fit;
}

}  // namespace salebra
