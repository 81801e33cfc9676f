// SPDX-License-Identifier: GPL-3.0-or-later
// Self-affine spectrum with roll-off and cut-offs, scaled to an RMS height or RMS slope.
#include "self_affine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/spectrum.hpp>
#include <sstream>

#include "base/powers.hpp"
#include "radial_moments.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

}  // namespace

void detail::validate(const SelfAffineParameters& p) {
  require(p.hurst > 0 && p.hurst <= 1, "hurst", p.hurst, "must lie in 0 < hurst <= 1");
  require_positive(p.short_cutoff, "short_cutoff");
  require_that(p.rolloff || p.long_cutoff, "rolloff",
               "not given, nor is `long_cutoff`; give one of them, such as the size of the cell");
  if (p.long_cutoff) require_positive(*p.long_cutoff, "long_cutoff");
  if (p.rolloff) require_positive(*p.rolloff, "rolloff");
  if (p.long_cutoff && p.rolloff)
    require(*p.rolloff <= *p.long_cutoff, "rolloff", *p.rolloff,
            "must not exceed `long_cutoff` (wavelengths); exchange them");
  const double longest = p.rolloff ? *p.rolloff : *p.long_cutoff;
  require(p.short_cutoff <= longest, "short_cutoff", p.short_cutoff,
          p.rolloff ? "must not exceed `rolloff` (wavelengths)"
                    : "must not exceed `long_cutoff` (wavelengths)");
  require(!p.long_cutoff || p.short_cutoff < *p.long_cutoff, "short_cutoff", p.short_cutoff,
          "must be shorter than `long_cutoff`, or the spectrum has no width");
  require_one(p.rms_height.has_value(), "rms_height", p.rms_slope.has_value(), "`rms_slope`");
  if (p.rms_height) require_square(*p.rms_height, "rms_height");
  if (p.rms_slope) require_square(*p.rms_slope, "rms_slope");
}

std::string detail::describe(const SelfAffineParameters& p) {
  std::ostringstream text;
  text.precision(12);
  text << "self-affine hurst=" << p.hurst;
  const auto append = [&text](const char* name, const std::optional<double>& value) {
    if (value) text << ' ' << name << '=' << *value;
  };
  append("long_cutoff", p.long_cutoff);
  append("rolloff", p.rolloff);
  append("short_cutoff", p.short_cutoff);
  append("rms_height", p.rms_height);
  append("rms_slope", p.rms_slope);
  return text.str();
}

SelfAffineSpectrum::SelfAffineSpectrum(const SelfAffineParameters& parameters)
    : parameters_(parameters) {
  detail::validate(parameters_);
  q_long_ = parameters_.long_cutoff ? 2 * pi / *parameters_.long_cutoff : 0;
  q_rolloff_ = parameters_.rolloff ? 2 * pi / *parameters_.rolloff : q_long_;
  q_short_ = 2 * pi / parameters_.short_cutoff;
  plateau_ = parameters_.rms_height
                 ? *parameters_.rms_height * *parameters_.rms_height / unscaled_integral(0)
                 : *parameters_.rms_slope * *parameters_.rms_slope / unscaled_integral(2);
}

double SelfAffineSpectrum::radial_density(double q) const {
  if (q < q_long_ * (1 - detail::limit_tolerance) || q > q_short_ * (1 + detail::limit_tolerance))
    return 0;
  if (q <= q_rolloff_) return plateau_;
  return plateau_ * std::pow(q / q_rolloff_, -2 * (1 + parameters_.hurst));
}

void SelfAffineSpectrum::density_row(Index first, double step_x, double qy,
                                     std::span<double> densities) const {
  // Squared wave numbers are in units of the squared roll-off q_r²; on the plateau they are
  // replaced by 1, whose powers are 1.
  const double scale = 1 / (q_rolloff_ * q_rolloff_);
  const double lowest = scale * std::pow(q_long_ * (1 - detail::limit_tolerance), 2);
  const double highest = scale * std::pow(q_short_ * (1 + detail::limit_tolerance), 2);
  const auto square_of = [=](std::size_t k) {
    const double qx = static_cast<double>(first + static_cast<Index>(k)) * step_x;
    return scale * (qx * qx + qy * qy);
  };
  for (std::size_t k = 0; k < densities.size(); ++k) densities[k] = std::max(square_of(k), 1.0);
  raise_to_power(densities, -(1 + parameters_.hurst));
  for (std::size_t k = 0; k < densities.size(); ++k) {
    const double square = square_of(k);
    const bool within = square >= lowest && square <= highest;
    densities[k] = within ? plateau_ * densities[k] : 0.0;
  }
}

double SelfAffineSpectrum::unscaled_integral(int order) const {
  const double n = order;
  const double flat = (std::pow(q_rolloff_, n + 2) - std::pow(q_long_, n + 2)) / (n + 2);
  const double fractal = std::pow(q_rolloff_, n + 2) *
                         detail::power_integral(q_short_ / q_rolloff_, n - 2 * parameters_.hurst);
  return 2 * pi * (flat + fractal);
}

SpectralMoments SelfAffineSpectrum::moments() const {
  return detail::isotropic_moments(
      [this](int order) { return plateau_ * unscaled_integral(order); });
}

std::string SelfAffineSpectrum::description() const { return detail::describe(parameters_); }

}  // namespace salebra
