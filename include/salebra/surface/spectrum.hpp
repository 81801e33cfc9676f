// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// Two-dimensional power spectral density of a surface in the convention
///     C(q) = (2π)⁻² ∫⟨h(0)h(x)⟩ e^{−iq·x} d²x,   h_rms² = ∫C d²q,   q in rad/m,
/// on the half-spectrum of wave vectors (i, j), j = 0 … ny/2; C(−q) = C(q). The mean height is left out.
struct PowerSpectrum {
  Grid2D grid;
  Field density;          ///< C, (nx, ny/2+1), m⁴
  bool windowed = false;  ///< a Hann window made the heights fade out at the edges

  double wavenumber_x(Index i) const;  ///< q_x, rad/m; −π/dx < q_x <= π/dx
  double wavenumber_y(Index j) const;  ///< q_y >= 0, rad/m
  double multiplicity(Index j) const;  ///< 1 where column j holds its own conjugates, 2 elsewhere
  double cell() const;                 ///< d²q of one mode, (2π)²/(lx ly), m⁻²
};

/// C of a periodic surface is exact on its modes: Σ C d²q = h_rms². A surface that is not periodic is multiplied by a Hann window,
/// w = ½(1 − cos 2π(i+½)/nx)·½(1 − cos 2π(j+½)/ny), against the leakage from its edges, after its weighted mean has been
/// subtracted, and C is divided by ⟨w²⟩, so that the expectation of a short-waved C is kept; tilt should be subtracted before.
/// Throws InvalidInput unless the surface is complete. Cost: one FFT.
PowerSpectrum power_spectrum(const Surface& surface);

/// C averaged over rings of wave vectors. Every bin holds at least one mode.
struct RadialSpectrum {
  std::vector<double> wavenumber;  ///< mean |q| of the modes in the bin, rad/m, increasing
  std::vector<double> density;     ///< mean C, m⁴
  std::vector<Index> modes;  ///< in the bin, of the full spectrum; h_rms² = Σ modes·C·d²q
};

/// Rings whose limits are in the ratio 2^(1/bins_per_octave), from the longest wave on; empty ones are left out. All modes are in:
/// beyond π/max(dx, dy) only those in the corners of the lattice remain.
RadialSpectrum radial_spectrum(const PowerSpectrum& spectrum, int bins_per_octave = 4);

/// Hurst exponent of the self-affine range of a surface, C ∝ q^{−2(1+H)}, with its 95 % interval.
struct HurstEstimate {
  double value = 0;  ///< NaN where the spectrum has no such range
  double low = 0;
  double high = 0;
  double wavenumber_min = 0;  ///< the range that was fitted, rad/m
  double wavenumber_max = 0;
  Index modes = 0;  ///< in it

  bool found() const { return modes > 0; }
};

/// The range is the middle of up to three pieces (plateau, power law, and a tail of other slope: noise, or what a tip or filter
/// left) that describe ln C of the radial spectrum up to π/max(dx, dy) best by Bayes' information criterion, deviations of
/// 10 % in C being forgiven; bins without power end it, and a bin at either limit is left out. In it, ln C = a − 2(1+H) ln q is
/// fitted to all modes by maximum quasi-likelihood, the power of a mode being exponentially distributed about C (as for a Gaussian
/// surface). The interval is Student's, from the scatter of the bins about the fit: it holds the statistical error, correlation of
/// windowed modes and bins that are off a power law, but not the choice of the range.
/// Of a windowed spectrum the three longest waves are left out, into which the window mixes their neighbours.
/// No range (less than a factor of three in q, or H outside −0.25 … 1.5) is a result with NaN, not an error.
/// Cost: some ten passes over the modes of the range.
HurstEstimate estimate_hurst(const PowerSpectrum& spectrum);

}  // namespace salebra
