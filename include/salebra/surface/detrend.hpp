// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// What is subtracted from the heights before anything is measured on them.
enum class Detrend {
  none,
  mean,       ///< the mean of the defined heights
  plane,      ///< the least-squares plane a + b·x + c·y through the defined heights
  quadratic,  ///< the least-squares paraboloid, with x², xy and y²: the bow of a scanner or of a lens
  /// Of each line along x, as a microscope scans, its least-squares straight line: the jumps and the drift from line to line. What the
  /// roughness itself has of them, its long waves along y, goes with them.
  lines
};

/// The plane for a measured surface, which carries the tilt of its stage; the mean for a periodic
/// one, where a plane would break the period.
Detrend default_detrend(const Surface& surface);

/// The surface less its trend. Undefined points stay undefined and take no part in the fit; where
/// they, or a grid of one row, leave the trend undetermined, the smallest one that fits is
/// subtracted. Throws InvalidInput if the heights have not the shape of the grid or no height is
/// defined. Cost: two passes.
Surface detrended(Surface surface, Detrend method);

}  // namespace salebra
