// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/twin_bins.hpp"

namespace salebra::twin_detail {

/// Expected power of a scan in bin b, E_b = Σ_j C(q_j) weight_jb, as a matrix over cells j of the
/// spectrum C in the mode κ. The limits of the cells are in the ratio 1.15^⅓ and include those of
/// the bins above κ = 8.5. C is taken at the geometric middle q_j of a cell and varies within it as
/// κ^−3.4.
struct Response {
  std::vector<double> limits;  ///< κ of the cells' limits; the first cell begins at 0
  std::vector<double> middle;  ///< κ of the cells' geometric middles
  std::size_t bins = 0;
  std::vector<double> weights;  ///< E_b/C(q_j): [cell j][bin b]

  double weight(std::size_t cell, std::size_t bin) const { return weights[cell * bins + bin]; }
};

/// Computes the response of a scan. Bins below κ = 36 average, over their modes and over
/// directions, the power that the taper finds in a plane wave less the wave's own least-squares
/// plane. This includes the convolution with the window, the removal of the plane and the leakage
/// of waves longer than the scan. All terms are products of one-dimensional transforms, which have
/// closed forms in the limit of closely spaced points. Bins above κ = 36 average the spectrum C
/// over the bin and, beyond half of the Nyquist mode, over the waves that sampling folds into the
/// bin. A profile's C₁ = ∫C dq_y comes from the same cells of C; the integral over q_y has a closed
/// form.
/// grid     of the scan
/// drifts   whether the modes |k_x| <= drift_modes, which drift of lines spoils, are left out
/// lay      of the surface; then rings and cells are elliptic
/// Cost: 0.1 s for a map, 0.5 s with a lay, less for a profile.
Response response_of(const Grid2D& grid, bool drifts, const Lay& lay = {});

/// The same for a map of a surface with a lay: bins and cells are rings of the elliptic wave number.
/// A bin contains the modes that are in its ring, of which there are few near the direction along
/// the lay.
Response elliptic_response(const Grid2D& grid, bool drifts, const Lay& lay);

}  // namespace salebra::twin_detail
