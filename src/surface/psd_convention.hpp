// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/surface/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Conventions for writing a power spectral density, each with the mean square height of the same
/// surface. C is the density over the wave vector, L the side of a square surface, dx its cell. "C"
/// in the second line, W and P are what the convention writes, n = qL/2π counts modes and f = q
/// dx/2π cycles per sample.
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

/// A spectrum written in one of the conventions, with its units and normalisation.
struct ConvertedPsd {
  std::vector<double> wavenumber;
  std::vector<double> psd;
  std::string wavenumber_unit;  ///< "rad/m", "1"
  std::string psd_unit;         ///< "m^4", "m^3", "m^2"
  std::string normalisation;    ///< formula of the mean square height
};

constexpr void describe(auto&& visit, std::type_identity<ConvertedPsd>) {
  using S = ConvertedPsd;
  visit(&S::wavenumber, Kept{"wavenumber", "wave number, in wavenumber_unit"});
  visit(&S::psd, Kept{"psd", "power spectral density, in psd_unit"});
  visit(&S::wavenumber_unit, Kept{"wavenumber_unit", "unit of the wave number"});
  visit(&S::psd_unit, Kept{"psd_unit", "unit of the power spectral density"});
  visit(&S::normalisation, Kept{"normalisation", "what the mean square height is"});
}

/// Converts a radial spectrum. Throws InvalidInput for Tamaas, which counts modes by integers, if
/// lx and ly differ, and for rfgen, which uses cycles per sample, if dx and dy differ.
ConvertedPsd converted(const RadialSpectrum& spectrum, const Grid2D& grid,
                       PsdConvention convention);

/// Converts a spectrum of profiles C₁. The conventions salebra and Gwyddion write C₁ with h_rms² =
/// ∫C₁ dq over all q; SurfaceTopography writes C = 2πC₁ with h_rms² = (1/π)∫C dq over q > 0. Throws
/// InvalidInput for all other conventions, which define no spectrum of profiles.
ConvertedPsd converted(const ProfilePsd& spectrum, PsdConvention convention);

}  // namespace salebra
