// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>

namespace salebra {

/// Areal parameters with the names and definitions of ISO 25178-2, computed from the surface as
/// given: use detrended() to remove form, and filtered() to remove noise and waviness. Means are taken over the
/// defined points, and heights h are measured from the mean height.
struct ArealParameters {
  double Sa = 0;   ///< ⟨|h|⟩, m
  double Sq = 0;   ///< √⟨h²⟩, m
  double Ssk = 0;  ///< ⟨h³⟩/Sq³; NaN for a flat surface
  double Sku = 0;  ///< ⟨h⁴⟩/Sq⁴; NaN for a flat surface
  double Sp = 0;   ///< highest peak, m
  double Sv = 0;   ///< deepest pit, > 0, m
  double Sz = 0;   ///< Sp + Sv, m
  /// Autocorrelation length, m: the shortest distance, over 720 directions, at which the
  /// autocorrelation (CorrelationMap, interpolated bilinearly) has fallen to 0.2 of its value at
  /// distance 0. NaN if it does not fall that far within half the surface.
  double Sal = 0;
  double Str = 0;  ///< Sal over the longest distance to 0.2, from 0 to 1; NaN if unknown
  /// Upper bound of Str: Str if it is known. If the autocorrelation stays above 0.2 up to half the
  /// surface in some direction, the length along the lay is beyond this distance, and the bound is
  /// Sal over it. NaN if Sal is.
  double Str_max = 0;
  /// Texture direction from the x axis, in [0, π) rad: where the angular spectrum ∫ q C dq is
  /// greatest (along 720 rays, C interpolated bilinearly). The lay is perpendicular to this
  /// direction. NaN if points are undefined or all heights are equal.
  double Std = 0;
  /// Sdq: root mean square gradient. Sdr: developed area over projected area, minus 1. Sdq and Sdr
  /// are means over triangles of neighbouring points: each cell of four points is divided along
  /// each of its two diagonals.
  double Sdq = 0;
  double Sdr = 0;
  double Sk = 0, Spk = 0, Svk = 0;  ///< by core_parameters() of the bearing curve, m
  double Smr1 = 0, Smr2 = 0;        ///< by core_parameters(), from 0 to 1
  /// Spd: peaks per area, 1/m². Spc: mean curvature of these peaks, 1/m (NaN without peaks). A peak
  /// counts if significant_peaks() finds it with a prominence of at least 5 % of Sz, the default of
  /// ISO 25178-2.
  double Spd = 0;
  double Spc = 0;
};

constexpr void describe(auto&& visit, std::type_identity<ArealParameters>) {
  using enum Dimension;
  using S = ArealParameters;
  visit(&S::Sa, Quantity{"Sa", length, "ISO 25178-2 arithmetic mean height"});
  visit(&S::Sq, Quantity{"Sq", length, "ISO 25178-2 root mean square height"});
  visit(&S::Ssk, Quantity{"Ssk", dimensionless, "ISO 25178-2 skewness"});
  visit(&S::Sku, Quantity{"Sku", dimensionless, "ISO 25178-2 kurtosis"});
  visit(&S::Sp, Quantity{"Sp", length, "ISO 25178-2 maximum peak height"});
  visit(&S::Sv, Quantity{"Sv", length, "ISO 25178-2 maximum pit depth"});
  visit(&S::Sz, Quantity{"Sz", length, "ISO 25178-2 maximum height"});
  visit(&S::Sal, Quantity{"Sal", length, "ISO 25178-2 autocorrelation length, s = 0.2"});
  visit(&S::Str, Quantity{"Str", dimensionless, "ISO 25178-2 texture aspect ratio, s = 0.2"});
  visit(&S::Str_max, Quantity{"Str_max", dimensionless,
                              "upper bound of Str, also where the lay is longer than the surface"});
  visit(&S::Std, Quantity{"Std", angle, "ISO 25178-2 texture direction"});
  visit(&S::Sdq, Quantity{"Sdq", dimensionless, "ISO 25178-2 root mean square gradient"});
  visit(&S::Sdr, Quantity{"Sdr", dimensionless, "ISO 25178-2 developed interfacial area ratio"});
  visit(&S::Sk, Quantity{"Sk", length, "ISO 25178-2 core height"});
  visit(&S::Spk, Quantity{"Spk", length, "ISO 25178-2 reduced peak height"});
  visit(&S::Svk, Quantity{"Svk", length, "ISO 25178-2 reduced valley depth"});
  visit(&S::Smr1, Quantity{"Smr1", dimensionless, "ISO 25178-2 material ratio of peaks and core"});
  visit(&S::Smr2,
        Quantity{"Smr2", dimensionless, "ISO 25178-2 material ratio of core and valleys"});
  visit(&S::Spd, Quantity{"Spd", inverse_length_squared,
                          "ISO 25178-2 density of peaks, pruned at 5 % of Sz"});
  visit(&S::Spc, Quantity{"Spc", inverse_length, "ISO 25178-2 mean peak curvature"});
}

class BearingCurve;
struct CorrelationMap;
struct PowerSpectrum;

/// Results that the caller already has for the surface; areal_parameters() computes those that are
/// nullptr.
struct ArealParts {
  const CorrelationMap* correlation = nullptr;
  const PowerSpectrum* spectrum = nullptr;  ///< power spectrum with the default window
  const BearingCurve* bearing = nullptr;
};

/// Computes the areal parameters of a surface:
///     const ArealParameters areal = areal_parameters(detrended(surface, Detrend::plane));
/// Throws InvalidInput wherever height_statistics does, and for fewer than 3 × 3 points.
/// Collective; for a surface distributed over processes Sal, Str, Std, Sk to Smr2, Spd and Spc are
/// NaN, because they need the whole surface. Cost: a correlation map, a power spectrum, a sort of
/// the heights and a search for peaks.
ArealParameters areal_parameters(const Surface& surface, const ArealParts& parts = {});

}  // namespace salebra
