// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/surface/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// How a power spectral density is written down. L a square surface's side, dx its step; the same
/// surface in each:
enum class PsdConvention {
  salebra,             ///< C over q in rad/m, m⁴:                     h_rms² = 2π ∫ q C dq
  surface_topography,  ///< (2π)² C over q in rad/m, m⁴:               h_rms² = (1/2π) ∫ q C dq
  gwyddion,            ///< 2πq C over q in rad/m, m³, a radial PSDF:  h_rms² = ∫ W dq
  tamaas,              ///< (2π/L)² C over qL/2π, m², power of a mode: h_rms² = 2π ∫ n P dn
  rfgen,  ///< (2π/dx)² C over q dx/2π, m², f <= ½ cycles in a sample: h_rms² = 2π ∫ f P df
};

template <>
struct EnumNames<PsdConvention> {
  static constexpr auto values = std::to_array<std::pair<PsdConvention, std::string_view>>(
      {{PsdConvention::salebra, "salebra"},
       {PsdConvention::surface_topography, "surface_topography"},
       {PsdConvention::gwyddion, "gwyddion"},
       {PsdConvention::tamaas, "tamaas"},
       {PsdConvention::rfgen, "rfgen"}});
};

/// One in any convention, with what it takes to read it.
struct ConvertedPsd {
  std::vector<double> wavenumber;
  std::vector<double> psd;
  std::string wavenumber_unit;  ///< "rad/m", "1"
  std::string psd_unit;         ///< "m^4", "m^3", "m^2"
  std::string normalisation;    ///< what the mean square height is
};

constexpr void describe(auto&& visit, std::type_identity<ConvertedPsd>) {
  using S = ConvertedPsd;
  visit(&S::wavenumber, Kept{"wavenumber", "wave number, in wavenumber_unit"});
  visit(&S::psd, Kept{"psd", "power spectral density, in psd_unit"});
  visit(&S::wavenumber_unit, Kept{"wavenumber_unit", "unit of the wave number"});
  visit(&S::psd_unit, Kept{"psd_unit", "unit of the power spectral density"});
  visit(&S::normalisation, Kept{"normalisation", "what the mean square height is"});
}

/// Throws InvalidInput for Tamaas' integers where lx and ly differ, and for cycles in a sample
/// where dx and dy do.
ConvertedPsd converted(const RadialSpectrum& spectrum, const Grid2D& grid,
                       PsdConvention convention);

/// Profiles have C₁ with h_rms² = ∫C₁ dq over all q in salebra and Gwyddion; 2πC₁ with h_rms² =
/// (1/π)∫C dq over q > 0 in SurfaceTopography. Throws InvalidInput for the others, which have none.
ConvertedPsd converted(const ProfilePsd& spectrum, PsdConvention convention);

}  // namespace salebra
