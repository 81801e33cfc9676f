// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// Power spectral density C₁ of the profiles of one scan, or its mean over several scans, in ten
/// bins per decade of the wave number q.
struct PlainSpectrum {
  std::vector<Index> bin;          ///< indices of the bins that contain a wave, counted from q =
                                   ///< 1/m
  std::vector<double> wavenumber;  ///< mean wave number in each bin, rad/m
  std::vector<double> psd;  ///< mean C₁ in each bin, h_rms² = ∫C₁ dq over −∞ < q < ∞, m³
  std::vector<Index> scans;  ///< number of scans with waves in each bin
};

constexpr void describe(auto&& visit, std::type_identity<PlainSpectrum>) {
  using enum Dimension;
  using S = PlainSpectrum;
  visit(&S::bin, Kept{"bin", "number of the bin"});
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd, Kept{"psd", "power spectral density of profiles", length_cubed});
  visit(&S::scans, Kept{"scans", "scans with waves in the bin"});
}

/// Computes the power spectral density C₁ = |dx Σ w h e^{−iqx}|²/(2πl) of the profiles along x, of
/// length l and with the window w, averaged over all profiles and within bins of q:
///     const PlainSpectrum spectrum = plain_spectrum(surface.heights, surface.grid);
/// Here q = 2πk/l with k from 1 to nx/2 − 1, and the window at point i is w = √(8/3)·½(1 − cos
/// 2πi/nx). Neither the mean nor a plane is subtracted. The bins divide the range from the longest
/// to the shortest wave, widened by 0.01 decades at each end, as in SurfaceTopography 1.x, whose
/// spectrum is 2πC₁. heights has the shape (nx, ny), m; a line has ny = 1. Throws InvalidInput
/// unless all heights are defined and nx >= 4. Cost: one FFT.
PlainSpectrum plain_spectrum(const Field& heights, const Grid2D& grid);

/// Averages the spectra of several scans without weights and without a model of the instruments: in
/// each bin, psd and wavenumber are the means over the scans with waves in that bin. It serves as a
/// comparison for fit_twin, which models the power that a tip or a lens removes. Throws
/// InvalidInput for an empty list.
PlainSpectrum plain_average(const std::vector<PlainSpectrum>& scans);

}  // namespace salebra
