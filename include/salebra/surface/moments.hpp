// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/spectral_moments.hpp>

namespace salebra {

/// Moments of the height distribution over all defined points. They are population moments (divided
/// by the number of points), and no filter is applied.
struct HeightStatistics {
  Index defined_points = 0;  ///< number of defined points
  double minimum = 0;        ///< lowest height, m
  double maximum = 0;        ///< highest height, m
  double mean = 0;           ///< ⟨h⟩, m
  double rms_height = 0;     ///< √⟨(h − ⟨h⟩)²⟩, m
  double skewness = 0;       ///< ⟨(h − ⟨h⟩)³⟩/rms_height³; NaN for a flat surface
  double kurtosis =
      0;  ///< ⟨(h − ⟨h⟩)⁴⟩/rms_height⁴, 3 for a Gaussian surface; NaN for a flat surface
};

constexpr void describe(auto&& visit, std::type_identity<HeightStatistics>) {
  using enum Dimension;
  using S = HeightStatistics;
  visit(&S::defined_points, Kept{"defined_points", "points with a height"});
  visit(&S::minimum, Kept{"minimum", "lowest height", length});
  visit(&S::maximum, Kept{"maximum", "highest height", length});
  visit(&S::mean, Kept{"mean", "mean height", length});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::skewness, Quantity{"skewness", dimensionless, "skewness of heights"});
  visit(&S::kurtosis, Quantity{"kurtosis", dimensionless, "kurtosis of heights, 3 for a Gaussian"});
}

/// Computes the height statistics:
///     const double rms_height = height_statistics(surface).rms_height;
/// Throws InvalidInput if the heights do not have the shape of the grid, contain an infinity, or
/// none is defined. Cost: two passes over the heights. Collective; the result has the same bits for
/// any number of threads and of processes that share the surface.
HeightStatistics height_statistics(const Surface& surface);

/// Computes the moments of a periodic surface from its spectrum, with the convention h_rms² = ∫C
/// d²q:
///     m2_x = Σ q_x² |ĥ|²/N², m4_x = Σ q_x⁴ |ĥ|²/N² over the full spectrum without q = 0,
/// and likewise along y; ĥ is the discrete Fourier transform of the N heights. They are the moments
/// of the trigonometric interpolant; a Nyquist mode is counted once, with |q| = π/dx. Throws
/// InvalidInput unless the surface is periodic and complete. Cost: FFTs of all rows and columns.
/// The surface may be distributed over processes, as in height_statistics.
SpectralMoments spectral_moments(const Surface& surface);

/// Computes the moments by finite differences of neighbouring points:
///     m2_x = ⟨((h_{i+1} − h_i)/dx)²⟩, m4_x = ⟨((h_{i+1} − 2h_i + h_{i−1})/dx²)²⟩,
/// and likewise along y. m4 is a mean over all stencils without undefined points (continued
/// periodically if the surface is periodic). m2_x and m2_y are means over the points whose
/// differences along x and along y are both defined, so that rms slope squared is the mean of |∇h|²
/// over one set of points, as in SurfaceTopography. These moments are smaller than the spectral
/// ones if the surface has structure at the scale of the grid: a mode of wave number q contributes
/// (2 sin(q dx/2)/dx)² instead of q². Throws InvalidInput if an axis has fewer than three points,
/// or if no stencil for a moment is free of undefined points. Cost: one pass over the heights. The
/// surface may be distributed over processes, as in height_statistics.
SpectralMoments difference_moments(const Surface& surface);

/// Calls spectral_moments for a periodic surface and difference_moments for any other.
SpectralMoments surface_moments(const Surface& surface);

}  // namespace salebra
