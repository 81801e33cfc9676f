// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/spectral_moments.hpp>

namespace salebra {

/// Moments of the height distribution over all defined points; undefined points take no part.
/// The divisor is the number of points (population moments), and no filter is applied.
struct HeightStatistics {
  Index defined_points = 0;
  double minimum = 0;     ///< m
  double maximum = 0;     ///< m
  double mean = 0;        ///< ⟨h⟩, m
  double rms_height = 0;  ///< √⟨(h − ⟨h⟩)²⟩, m
  double skewness = 0;    ///< ⟨(h − ⟨h⟩)³⟩/rms_height³; NaN for a flat surface
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

/// Throws InvalidInput if the heights have not the shape of the grid, hold an infinity, or none of
/// them is defined. Cost: two passes. Same bits for every number of threads and of processes over
/// which a surface is spread; collective.
HeightStatistics height_statistics(const Surface& surface);

/// Moments of a periodic surface from its spectrum, whose convention is h_rms² = ∫C d²q:
///     m2_x = Σ q_x² |ĥ|²/N², m4_x = Σ q_x⁴ |ĥ|²/N² over the full spectrum, q = 0 left out,
/// which are those of the trigonometric interpolant; a Nyquist mode counts once, with |q| = π/dx.
/// Throws InvalidInput unless the surface is periodic and complete. Cost: transforms of all rows
/// and columns. A surface may be spread over processes, as in height_statistics.
SpectralMoments spectral_moments(const Surface& surface);

/// Moments by finite differences of neighbouring points:
///     m2_x = ⟨((h_{i+1} − h_i)/dx)²⟩, m4_x = ⟨((h_{i+1} − 2h_i + h_{i−1})/dx²)²⟩,
/// m4 a mean over all stencils on the grid (with wrap where the surface is periodic) that touch no
/// undefined point, m2 over all points whose neighbours of both differences exist, so that the rms
/// slope is the mean of |∇h|² over one set of points, as SurfaceTopography has it. Where the
/// surface has structure at the scale of the grid they are smaller than the spectral moments: a
/// mode of wave number q counts with (2 sin(q dx/2)/dx)² in place of q². Throws InvalidInput if an
/// axis has fewer than three points or a moment has no stencil left. Cost: one pass. Of a surface
/// spread over processes as height_statistics.
SpectralMoments difference_moments(const Surface& surface);

/// spectral_moments of a periodic surface, difference_moments of any other.
SpectralMoments surface_moments(const Surface& surface);

}  // namespace salebra
