// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/generators/non_gaussian.hpp>

namespace salebra::detail {

/// Samples a translation process [Yamazaki and Shinozuka (1988)] for non_gaussian() with Exact::process: h = g(z)
/// of a Gaussian surface z by filtered_noise(), with the increasing function g that gives z the
/// distribution of heights. The correlation of h follows from that of z by Hermite's polynomials, and
/// the spectrum of z is corrected, mode by mode, until h has the given spectrum in the mean. Waves
/// that the spectrum lacks get the harmonics of g. Cost: two FFTs an iteration, without a sort.
NonGaussianSurface translation_process(const Grid2D& grid, const Spectrum& spectrum,
                                       const HeightDistribution& distribution, std::uint64_t seed,
                                       const NonGaussianOptions& options);

}  // namespace salebra::detail
