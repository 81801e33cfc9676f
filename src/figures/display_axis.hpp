// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/figures/figure.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace salebra::figures {

/// An axis in the numbers that the picture shows: with an SI prefix and, if it is logarithmic, as
/// logarithms.
struct DisplayAxis {
  std::string label;  ///< text beside the axis, with the unit
  std::string unit;   ///< with its prefix
  /// Factor from the unit of the data to the unit that the picture shows.
  double factor = 1;
  bool logarithmic = false;         ///< the picture shows the decimal logarithm of the data
  std::optional<double> low, high;  ///< limits, in the numbers of the picture
  std::string tics;  ///< gnuplot's list of labelled and small tics; empty: gnuplot chooses
  std::size_t longest_tic = 5;  ///< characters of the longest number along the axis

  /// Converts a value of the data to the number in the picture; NaN for a value <= 0 on a
  /// logarithmic axis.
  double display(double value) const;
};

/// The unit with the prefix that suits a value, and the factor to this unit.
std::pair<std::string, double> prefixed(const std::string& unit, double value);

/// The axis for these data. Throws InvalidInput for a logarithmic axis with a limit <= 0, or with
/// data of which none is > 0. labels: the most tics with a label that have room.
DisplayAxis display_axis(const Axis& axis, const std::vector<std::span<const double>>& data,
                         int labels = 10);

/// Sets the distance of the tics of a linear axis with known limits.
void set_linear_tics(DisplayAxis& axis, int labels);

}  // namespace salebra::figures
