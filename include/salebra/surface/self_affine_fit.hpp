// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/spectrum.hpp>

namespace salebra {

/// Self-affine model of a surface: a plateau down to the roll-off wavelength, a power law C ∝
/// q^{−2(1+H)} down to the shortest wavelength, nothing below.
struct SelfAffineFit {
  HurstEstimate hurst;
  /// λ_r, m; NaN unless a plateau is seen, i.e. unless omitting it reduces the likelihood by more
  /// than the limit of the interval.
  IntervalEstimate rolloff;
  /// λ_s, m; NaN unless the spectrum ends within the lattice, falling to less than a thousandth of
  /// the law within four modes.
  IntervalEstimate short_cutoff;
};

constexpr void describe(auto&& visit, std::type_identity<SelfAffineFit>) {
  using enum Dimension;
  using S = SelfAffineFit;
  visit(&S::hurst, Kept{"hurst", "Hurst exponent"});
  visit(&S::rolloff, Kept{"rolloff", "wavelength; NaN unless a plateau is seen", length});
  visit(
      &S::short_cutoff,
      Kept{"short_cutoff", "wavelength; NaN unless the spectrum ends within the lattice", length});
}

/// Fits the self-affine model to a spectrum, with H from estimate_hurst and its
/// shortest_wavelength:
///     const SelfAffineFit fit = fit_self_affine(power_spectrum(surface));
/// The roll-off maximises the quasi-likelihood, with free plateau and slope, over all modes up to
/// the end of the fitted range (without the three longest waves if windowed). Its interval contains
/// what a likelihood-ratio test at 5 % does not reject, for exponentially distributed powers
/// correlated by the window. The shortest wavelength lies between the last mode with power and the
/// first without; a window spreads power over some modes, and the interval allows for up to four.
/// Cost: as estimate_hurst.
SelfAffineFit fit_self_affine(const PowerSpectrum& spectrum, double shortest_wavelength = 0);

}  // namespace salebra
