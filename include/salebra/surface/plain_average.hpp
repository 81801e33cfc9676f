// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// Spectrum of the profiles of one scan, or its plain mean over several, in ten bins a decade.
struct PlainSpectrum {
  std::vector<Index> bin;          ///< number of each bin that holds a wave, counted from q = 1/m
  std::vector<double> wavenumber;  ///< mean of the waves in it, rad/m
  std::vector<double> psd;   ///< mean C₁ in it, h_rms² = ∫C₁ dq over −∞ < q < ∞, m³
  std::vector<Index> scans;  ///< that have waves in it
};

constexpr void describe(auto&& visit, std::type_identity<PlainSpectrum>) {
  using enum Dimension;
  using S = PlainSpectrum;
  visit(&S::bin, Kept{"bin", "number of the bin"});
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd, Kept{"psd", "power spectral density of profiles", length_cubed});
  visit(&S::scans, Kept{"scans", "scans with waves in the bin"});
}

/// C₁ = |dx Σ w h e^{−iqx}|²/(2πl) of the profiles along x, q = 2πk/l, k = 1 … nx/2 − 1, mean over
/// all of them and over bins, w = √(8/3)·½(1 − cos 2πi/nx). No mean and no plane is subtracted. The
/// limits of the bins divide the decades from that of the longest wave to that of the shortest,
/// widened by 0.01 decades at either end, as SurfaceTopography 1.x has it, whose C is 2πC₁.
/// heights (nx, ny), m; a line has ny = 1. Throws InvalidInput unless all heights are defined and
/// nx >= 4. Cost: one FFT.
PlainSpectrum plain_spectrum(const Field& heights, const Grid2D& grid);

/// What a container of scans is reduced to without instruments, weights or variance: in each bin
/// the mean of the scans' means and of their wave numbers. A comparison for fit_twin, which knows
/// that a tip or a lens takes power away. Throws InvalidInput for no scan.
PlainSpectrum plain_average(const std::vector<PlainSpectrum>& scans);

}  // namespace salebra
