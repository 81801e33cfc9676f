// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/spectrum.hpp>

namespace salebra {

/// Self-affine model of a surface: its spectrum C has a plateau at wavelengths above the roll-off
/// wavelength λ_r, follows the power law C ∝ q^{−2(1+H)} down to the shortest wavelength λ_s, and
/// is 0 below λ_s.
struct SelfAffineFit {
  HurstEstimate hurst;
  /// Roll-off wavelength λ_r, m; NaN unless a plateau is seen, i.e. unless a model without a
  /// plateau is rejected by the likelihood-ratio test at 5 %.
  IntervalEstimate rolloff;
  /// Shortest wavelength λ_s, m; NaN unless the spectrum ends at a wave number that the grid
  /// resolves, by falling to less than a thousandth of the power law within four modes.
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
/// all λ_r that a likelihood-ratio test at 5 % does not reject, for exponentially distributed
/// powers that the window correlates. The shortest wavelength lies between the last mode with power
/// and the first mode without power; a window spreads power over neighbouring modes, so the
/// interval allows for up to four modes. Cost: that of estimate_hurst.
SelfAffineFit fit_self_affine(const PowerSpectrum& spectrum, double shortest_wavelength = 0);

}  // namespace salebra
