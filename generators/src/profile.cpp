// SPDX-License-Identifier: GPL-3.0-or-later
// Random line profiles: self-affine spectrum of a profile, filtered noise and random phase.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/profile.hpp>
#include <sstream>

#include "base/column_fft.hpp"
#include "base/random.hpp"
#include "modes.hpp"
#include "radial_moments.hpp"
#include "self_affine.hpp"

namespace salebra {
namespace {

using std::numbers::pi;
// Profiles use their own random stream; surfaces use stream 0.
constexpr std::uint32_t profile_stream = 1;

Index last_wave(Index points, double length, const ProfileSpectrum& spectrum) {
  const double waves = spectrum.highest_wavenumber() * (1 + 2e-9) * length / (2 * pi);
  return static_cast<Index>(std::min(waves, static_cast<double>(points / 2)));
}

// Profile h(x) = Σ a(i) e^{2πiix/length} with random amplitudes a of the waves, by a backward
// transform.
Profile synthesise(Index points, double length, const ProfileSpectrum& spectrum, std::uint64_t seed,
                   detail::Chance chance) {
  spectrum.require_carried_by(points, length);
  const Index last = last_wave(points, length, spectrum);
  const double step = 2 * pi / length;
  const auto fill = [&](Index, std::span<std::complex<double>> modes) {
    std::fill(modes.begin(), modes.end(), 0.0);
    const auto positive = modes.subspan(1, static_cast<std::size_t>(last));
    const bool gaussian = chance == detail::Chance::gaussian_amplitude;
    if (gaussian)
      fill_gaussian(seed, 1, 0, positive, profile_stream);
    else
      fill_phase_factors(seed, 1, 0, positive, profile_stream);
    for (Index i = 1; i <= last; ++i) {
      std::complex<double>& mode = modes[static_cast<std::size_t>(i)];
      const double amplitude = std::sqrt(spectrum.density(static_cast<double>(i) * step) * step);
      if (2 * i == points) {  // own conjugate: real, with the whole power
        mode = amplitude * (gaussian ? mode.real() : std::copysign(1.0, mode.real()));
        continue;
      }
      mode *= gaussian ? amplitude * std::numbers::sqrt2 / 2 : amplitude;
      modes[static_cast<std::size_t>(points - i)] = std::conj(mode);
    }
  };
  const Field line = backward_by_columns(points, 1, 1, fill);
  return {length, {line.data(), line.data() + points}, {}};
}

}  // namespace

void ProfileSpectrum::require_carried_by(Index points, double length) const {
  require(points >= 2, "points", points, "must be >= 2");
  require_positive(length, "length");
  const double shortest = 2 * pi / highest_wavenumber();
  const double step = length / static_cast<double>(points);
  std::ostringstream limits;
  limits << "must lie between two steps, " << 2 * step << " m, and the length, " << length << " m";
  require(shortest >= 2 * step * (1 - 1e-9) && shortest <= length * (1 + 1e-9), "short_cutoff",
          shortest, limits.str());
}

SpectralMoments ProfileSpectrum::lattice_moments(Index points, double length) const {
  require_carried_by(points, length);
  const double step = 2 * pi / length;
  SpectralMoments sum;
  for (Index i = 1; i <= last_wave(points, length, *this); ++i) {
    const double q = static_cast<double>(i) * step, square = q * q;
    const double power = (2 * i == points ? 1 : 2) * density(q) * step;
    sum.moment0 += power;
    sum.moment2_x += square * power;
    sum.moment4_x += square * square * power;
  }
  return sum;
}

SelfAffineProfileSpectrum::SelfAffineProfileSpectrum(const SelfAffineParameters& parameters)
    : parameters_(parameters) {
  detail::validate(parameters_);
  q_long_ = parameters_.long_cutoff ? 2 * pi / *parameters_.long_cutoff : 0;
  q_rolloff_ = parameters_.rolloff ? 2 * pi / *parameters_.rolloff : q_long_;
  q_short_ = 2 * pi / parameters_.short_cutoff;
  plateau_ = parameters_.rms_height
                 ? *parameters_.rms_height * *parameters_.rms_height / unscaled_integral(0)
                 : *parameters_.rms_slope * *parameters_.rms_slope / unscaled_integral(2);
}

double SelfAffineProfileSpectrum::density(double q) const {
  if (q < q_long_ * (1 - detail::limit_tolerance) || q > q_short_ * (1 + detail::limit_tolerance))
    return 0;
  if (q <= q_rolloff_) return plateau_;
  return plateau_ * std::pow(q / q_rolloff_, -(1 + 2 * parameters_.hurst));
}

double SelfAffineProfileSpectrum::unscaled_integral(int order) const {
  const double n = order;
  const double flat = (std::pow(q_rolloff_, n + 1) - std::pow(q_long_, n + 1)) / (n + 1);
  return 2 * (flat + std::pow(q_rolloff_, n + 1) *
                         detail::power_integral(q_short_ / q_rolloff_, n - 2 * parameters_.hurst));
}

SpectralMoments SelfAffineProfileSpectrum::moments() const {
  return {.moment0 = plateau_ * unscaled_integral(0),
          .moment2_x = plateau_ * unscaled_integral(2),
          .moment4_x = plateau_ * unscaled_integral(4)};
}

std::string SelfAffineProfileSpectrum::description() const {
  return "profile, " + detail::describe(parameters_);
}

Profile filtered_noise_profile(Index points, double length, const ProfileSpectrum& spectrum,
                               std::uint64_t seed) {
  Profile profile = synthesise(points, length, spectrum, seed, detail::Chance::gaussian_amplitude);
  profile.origin = "filtered noise, seed " + std::to_string(seed) + ", " + spectrum.description();
  return profile;
}

Profile random_phase_profile(Index points, double length, const ProfileSpectrum& spectrum,
                             std::uint64_t seed) {
  Profile profile = synthesise(points, length, spectrum, seed, detail::Chance::phase);
  profile.origin = "random phase, seed " + std::to_string(seed) + ", " + spectrum.description();
  return profile;
}

}  // namespace salebra
