// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>

namespace salebra {

/// The trend to subtract from the heights before any evaluation.
enum class Detrend {
  none,
  mean,       ///< the mean of the defined heights
  plane,      ///< the least-squares plane a + b·x + c·y through the defined heights
  quadratic,  ///< the least-squares paraboloid, with x², xy and y²: the bow of a scanner or of a
              ///< lens
  // The methods `lines` and `median_differences` flatten a scan, whose fast axis is x, line by
  // line. They remove jumps and drift between lines, and with them all roughness longer than a
  // line: statistics along y change, statistics along x do not. The first and the last line do not
  // match: a periodic continuation has a seam between them, as for any scan.
  /// Subtracts from each scan line its least-squares straight line (offset and slope). A feature
  /// that covers part of a scan line therefore shifts the rest of that line.
  lines,
  /// Subtracts from each scan line an offset such that the median of its differences from the
  /// previous line is zero, and then the least-squares plane. A feature does not shift a line
  /// unless one of its edges covers half of the line. If the previous point at the same x is
  /// undefined, the last defined point before it is used.
  median_differences
};

template <>
struct EnumNames<Detrend> {
  static constexpr auto values = std::to_array<std::pair<Detrend, std::string_view>>(
      {{Detrend::none, "none"},
       {Detrend::mean, "mean"},
       {Detrend::plane, "plane"},
       {Detrend::quadratic, "quadratic"},
       {Detrend::lines, "lines"},
       {Detrend::median_differences, "median_differences"}});
};

/// Returns `plane` for a measured surface, which includes the tilt of the stage, and `mean` for a
/// periodic one, because subtracting a plane would destroy its periodicity.
Detrend default_detrend(const Surface& surface);

/// Subtracts the trend:
///     const Surface level = detrended(surface, Detrend::plane);
/// Undefined points stay undefined and do not enter the fit. If the fit is not unique, because too
/// many points are undefined or the grid has one row, the solution with the smallest coefficients
/// is subtracted. A surface distributed over processes cannot be detrended line by line. Throws
/// InvalidInput if the heights do not have the shape of the grid or no height is defined. Cost: two
/// passes over the heights; four with median_differences.
Surface detrended(Surface surface, Detrend method);

}  // namespace salebra
