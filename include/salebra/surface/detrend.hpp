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
  // The next two methods flatten a scan, whose fast axis is x, line by line. Both remove jumps and
  // drift between lines, and with them roughness longer than a line: statistics along y change,
  // those along x do not. The first and last line do not match: a periodic continuation has a seam
  // there, as for any scan.
  /// Subtracts the least-squares straight line, offset and slope, from each line. A feature that
  /// covers part of a line shifts the rest of it.
  lines,
  /// Subtracts an offset from each line, such that the median of its differences from the previous
  /// line is zero, and then the plane. A feature shifts nothing unless its edge along y covers half
  /// of a line. Each point is compared with the last one defined before it at the same x.
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
/// Undefined points stay undefined and do not enter the fit. If they, or a grid of one row, leave
/// the fit undetermined, the smallest trend that fits is subtracted. A surface distributed over
/// processes cannot be detrended line by line. Throws InvalidInput if the heights do not have the
/// shape of the grid or no height is defined. Cost: two passes; four with median_differences.
Surface detrended(Surface surface, Detrend method);

}  // namespace salebra
