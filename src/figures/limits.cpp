// SPDX-License-Identifier: GPL-3.0-or-later
// Limits and SI prefixes of axes, the same for all renderers.
#include <algorithm>
#include <cmath>
#include <map>

#include "axes.hpp"

namespace salebra::figures {

void set_limits(const std::vector<Panel*>& panels, Axis Panel::*axis) {
  const bool across = axis == &Panel::x;
  const Axis first = panels.front()->*axis;
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto hold = [&](double value) {
    if (!std::isfinite(value) || (first.logarithmic && !(value > 0))) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const Panel* panel : panels) {
    const auto drawn = [&](double y) {
      return std::isfinite(y) && (y > 0 || !panel->y.logarithmic);
    };
    for (const Curve& curve : panel->curves) {
      for (std::size_t k = 0; k < curve.y.size(); ++k)
        if (drawn(curve.y[k])) hold(across ? curve.x[k] : curve.y[k]);
      if (across) continue;
      std::ranges::for_each(curve.high, hold);
      // An error bar that ends near zero would extend a logarithmic axis by decades.
      if (!(first.logarithmic && curve.style == Style::points))
        std::ranges::for_each(curve.low, hold);
    }
    // A reference outside the data extends the axis to itself.
    for (const ReferenceLine& line : panel->lines)
      if (!across && !line.vertical && !line.name.empty()) hold(line.at);
  }
  low = first.low.value_or(low);
  high = first.high.value_or(high);
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(low <= high) || !(size > 0)) return;
  // A value that is constant to within a percent is not magnified.
  const bool constant = high - low < 0.01 * size;
  const double span = first.logarithmic ? std::log(high / low) : high - low;
  const double margin = !constant ? 0.04 * span : first.logarithmic ? std::log(3) : 0.02 * size;
  for (Panel* panel : panels) {
    Axis& one = panel->*axis;
    if (!one.low)
      one.low = first.logarithmic ? low * std::exp(-margin)
                : low >= 0        ? std::max(0.0, low - margin)
                                  : low - margin;
    if (!one.high)
      one.high = first.logarithmic ? high * std::exp(margin)
                 : high <= 0       ? std::min(0.0, high + margin)
                                   : high + margin;
  }
}

Figure with_limits(Figure figure) {
  std::map<std::string, std::vector<Axis*>> same;
  for (Panel& panel : figure.panels)
    for (Axis Panel::*const axis : {&Panel::x, &Panel::y}) {
      // An image ends at the edges of its cells.
      if (!panel.image) set_limits({&panel}, axis);
      Axis& one = panel.*axis;
      if (!one.quantity.empty() && one.low && one.high) same[one.quantity].push_back(&one);
    }
  // A quantity has one unit in all panels, that of its largest number.
  for (const auto& [quantity, axes] : same) {
    double largest = 0;
    for (const Axis* axis : axes)
      largest = std::max({largest, std::abs(*axis->low), std::abs(*axis->high)});
    if (!std::ranges::all_of(axes, &Axis::logarithmic))
      for (Axis* axis : axes) axis->prefix_of = largest;
  }
  return figure;
}

}  // namespace salebra::figures
