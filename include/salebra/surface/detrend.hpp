// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/base/words.hpp>

namespace salebra {

/// What is subtracted from the heights before anything is measured on them.
enum class Detrend {
  none,
  mean,       ///< the mean of the defined heights
  plane,      ///< the least-squares plane a + b·x + c·y through the defined heights
  quadratic,  ///< the least-squares paraboloid, with x², xy and y²: the bow of a scanner or of a
              ///< lens
  // Flattening of a scan, whose fast axis is x, line by line. Both take the jumps and the drift
  // between lines away, and with them the waves of the roughness itself that are longer than a
  // line: statistics along y change, those along x do not. The first and the last line do not meet:
  // continued periodically, the surface has a seam there, as any scan has.
  /// Takes off each line its least-squares straight line, offset and slope. A feature that covers a
  /// part of a line shifts the rest of it.
  lines,
  /// Takes off each line its offset alone, by which the median of its differences from the line
  /// before becomes zero; then the plane. A feature shifts nothing unless its edge along y takes
  /// half of a line. A point is compared with the last one defined before it at its x.
  median_differences
};

template <>
struct Words<Detrend> {
  static constexpr auto values = std::to_array<std::pair<Detrend, std::string_view>>(
      {{Detrend::none, "none"},
       {Detrend::mean, "mean"},
       {Detrend::plane, "plane"},
       {Detrend::quadratic, "quadratic"},
       {Detrend::lines, "lines"},
       {Detrend::median_differences, "median_differences"}});
};

/// The plane for a measured surface, which carries the tilt of its stage; the mean for a periodic
/// one, where a plane would break the period.
Detrend default_detrend(const Surface& surface);

/// The surface less its trend. Undefined points stay undefined and take no part in the fit; where
/// they, or a grid of one row, leave the trend undetermined, the smallest one that fits is
/// subtracted. A surface that is spread over processes is not detrended line by line. Throws
/// InvalidInput if the heights have not the shape of the grid or no height is defined. Cost: two
/// passes; four with median_differences.
Surface detrended(Surface surface, Detrend method);

}  // namespace salebra
