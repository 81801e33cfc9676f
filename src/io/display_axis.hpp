// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plot.hpp"

namespace salebra::detail {

/// An axis as it is drawn: SI prefix chosen, logarithm taken.
struct DisplayAxis {
  std::string label;                ///< with its unit
  double factor = 1;                ///< from the data's unit to the one shown
  bool logarithmic = false;         ///< what is drawn is the decimal logarithm
  std::optional<double> low, high;  ///< as drawn
  std::string tics;  ///< gnuplot's list of labelled and small tics; empty: its own choice

  /// Where a value of the data is drawn; NaN for what a logarithmic axis cannot show.
  double display(double value) const;
};

/// Throws InvalidInput where a logarithmic axis has data but none > 0, and for limits that are not.
DisplayAxis display_axis(const PlotAxis& axis, const std::vector<std::span<const double>>& data);

}  // namespace salebra::detail
