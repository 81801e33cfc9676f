// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/lay.hpp>
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
/// Without a window the roll-off maximises the quasi-likelihood, with free plateau and slope, over
/// all modes up to the end of the fitted range; with a window it is that of the law that
/// estimate_hurst fits, with floor and attenuation. Its interval contains all λ_r that a
/// likelihood-ratio test at 5 % does not reject. The shortest wavelength lies between the last mode
/// with power and the first mode without power; a window spreads power over neighbouring modes, so
/// the interval allows for up to four modes. An end that the power approaches gradually, as under a
/// lens, is none. Cost: that of estimate_hurst.
SelfAffineFit fit_self_affine(const PowerSpectrum& spectrum, double shortest_wavelength = 0);

/// The self-affine laws across and along a lay.
struct DirectionalSelfAffineFit {
  SelfAffineFit across, along;
};

constexpr void describe(auto&& visit, std::type_identity<DirectionalSelfAffineFit>) {
  using S = DirectionalSelfAffineFit;
  visit(&S::across, Kept{"across", "law of profiles across the lay"});
  visit(&S::along, Kept{"along", "law of profiles along the lay"});
}

/// Fits the self-affine model across and along the lay of a surface:
///     const auto fit = fit_self_affine(power_spectrum(surface, Window::hann), surface_lay(surface));
/// Roll-off and shortest wavelength depend on the direction, and the law of the mean over all
/// directions, which the other fit_self_affine() finds, is that of none of them. The spectrum C₁(q)
/// = ∫C dq_⊥ of profiles along a direction is fitted as in fit_profile(): with the wavelengths of
/// the direction it has the same form for an elliptic spectrum, C(√(q² + s²q_⊥²)), as for an
/// isotropic one. A strip of wave vectors counts as (2(ΣC)²/ΣC² − 1)/correlated_modes independent
/// powers. The intervals of H and of the roll-off are those of likelihood-ratio tests at 5 %; the
/// interval of the shortest wavelength is that of the strips, a fifth wide. Profiles along
/// the lay get their power from waves across it, three times `ratio` as short: unless the law across
/// the lay ends within the grid, the law along it uses only those waves for which the grid and the
/// instrument show the short waves across it.
/// throws  InvalidInput for a spectrum without a window, and for a lay with unknown angle or ratio
/// cost    0.1 to 0.5 s for the fits, and two passes over the modes. Collective
DirectionalSelfAffineFit fit_self_affine(const PowerSpectrum& spectrum, const SurfaceLay& lay,
                                         double shortest_wavelength = 0);

}  // namespace salebra
