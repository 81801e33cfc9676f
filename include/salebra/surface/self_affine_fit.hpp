// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/spectrum.hpp>

namespace salebra {

/// The self-affine model of a surface: a plateau down to the roll-off wavelength, a power law C ∝
/// q^{−2(1+H)} down to the shortest wavelength, nothing below.
struct SelfAffineFit {
  HurstEstimate hurst;
  /// λ_r, m. NaN unless a plateau is seen: a law without one is less likely by more than the limit
  /// of the interval.
  IntervalEstimate rolloff;
  /// λ_s, m. NaN unless the spectrum ends within the lattice, falling to less than a thousandth of
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

/// H as estimate_hurst, with the same shortest_wavelength. The roll-off is that of greatest quasi-likelihood, plateau and slope being
/// free, over all modes up to the end of the fitted range (of a windowed spectrum without its three
/// longest waves); its interval holds what a likelihood-ratio test at 5 % does not reject, powers
/// being exponentially distributed and correlated as the window has it. The shortest wavelength
/// lies between the last mode that has power and the first that has none; a window spreads power by
/// some modes, up to four of which the interval allows for. Cost: as estimate_hurst.
SelfAffineFit fit_self_affine(const PowerSpectrum& spectrum, double shortest_wavelength = 0);

}  // namespace salebra
