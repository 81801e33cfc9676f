// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/twin_bins.hpp"

namespace salebra::twin_detail {

/// What a scan's binned periodogram is expected to be, E_b = Σ_j C(q_j) weight_jb, as a matrix
/// over cells of the spectrum in |κ|. The cells have limits in the ratio 1.15^⅓ (those of the bins
/// above 8.5 are among them), C is taken at their geometric middle, and within a cell it is
/// weighted as κ^−3.4.
struct Response {
  std::vector<double> limits;  ///< κ of the cells' limits, the first cell from 0 on
  std::vector<double> middle;  ///< κ
  std::size_t bins = 0;
  std::vector<double> weights;  ///< [cell][bin]

  double weight(std::size_t cell, std::size_t bin) const { return weights[cell * bins + bin]; }
};

/// Below κ = 36 it is the mean over the modes of the bin and over directions of the power that the
/// taper finds of a plane wave less its own least-squares plane: it holds the convolution with the
/// window, the removal of the plane and the leakage of waves longer than the scan. All terms are
/// products of one-dimensional transforms, which have closed forms for points close together. Above
/// it is the mean of C over the bin and, beyond half of the Nyquist mode, over the waves that the
/// points fold into it.
/// A profile's C₁ = ∫C dq_y comes from the same cells of C, by the integral over q_y in closed form.
/// grid     of the scan
/// drifts   the modes |k_x| <= drift_modes are left out
/// Cost: 0.1 s for a map, less for a profile.
Response response_of(const Grid2D& grid, bool drifts);

}  // namespace salebra::twin_detail
