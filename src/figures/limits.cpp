// SPDX-License-Identifier: GPL-3.0-or-later
// Limits and SI prefixes of axes and letters of panels, the same for all renderers.
#include <fmt/format.h>

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
  for (Panel& panel : figure.panels) {
    // The symbols of many points would hide their line.
    for (Curve& curve : panel.curves)
      if (curve.style == Style::line_and_points && curve.x.size() > 40) curve.style = Style::line;
    for (Axis Panel::*const axis : {&Panel::x, &Panel::y}) {
      // An image ends at the edges of its cells.
      if (!panel.image) set_limits({&panel}, axis);
      Axis& one = panel.*axis;
      if (!one.quantity.empty() && one.low && one.high) same[one.quantity].push_back(&one);
    }
  }
  // A quantity has one unit in all panels: that of its headline or else of its largest number.
  for (const auto& [quantity, axes] : same) {
    std::optional<double> value;
    double least = HUGE_VAL, largest = 0;
    for (const Axis* axis : axes) {
      least = std::min(least, *axis->low);
      largest = std::max({largest, std::abs(*axis->low), std::abs(*axis->high)});
      if (axis->prefix_of) value = axis->prefix_of;
    }
    // The middle of a logarithmic axis has the short numbers.
    if (!value)
      value = std::ranges::all_of(axes, &Axis::logarithmic) ? std::sqrt(least) * std::sqrt(largest)
                                                            : largest;
    for (Axis* axis : axes) axis->prefix_of = value;
  }
  // Equations have the numbers of the paper.
  constexpr std::string_view source = " Equations are those of Popov et al. (2015).";
  const auto numbered = [](std::string_view text) { return text.find("Eq. ") != text.npos; };
  const bool by_equations =
      numbered(figure.caption) || std::ranges::any_of(figure.panels, [&](const Panel& panel) {
        return numbered(panel.y.label) || numbered(panel.title) || numbered(panel.caption) ||
               std::ranges::any_of(panel.curves, numbered, &Curve::name) ||
               std::ranges::any_of(panel.lines, numbered, &ReferenceLine::name);
      });
  if (by_equations && figure.caption.find(source) == std::string::npos) figure.caption += source;
  char letter = 'a';
  for (Panel& panel : figure.panels) {
    // A density has the inverse of the unit along x.
    if (panel.y.unit == "1/m" && panel.x.unit == "m" && panel.x.high)
      panel.y.prefix_of =
          std::pow(10, -3 * std::floor(std::log10(std::max(*panel.x.high, -*panel.x.low)) / 3));
    const std::string mark = fmt::format("({})", letter++);
    const bool several = figure.panels.size() > 1;
    if (several && !panel.title.starts_with(mark))
      panel.title = mark + (panel.title.empty() ? "" : " ") + panel.title;
    if (panel.caption.empty()) continue;
    figure.caption += fmt::format("{}{}{}", figure.caption.empty() ? "" : " ",
                                  several ? mark + " " : "", panel.caption);
    panel.caption.clear();
  }
  return figure;
}

Figure for_width(Figure figure, std::optional<double> width) {
  constexpr double two_columns = 0.12;
  if (width)
    for (Panel& panel : figure.panels) panel.second_y = {};
  if (width.value_or(1) < two_columns) {
    std::erase_if(figure.panels, &Panel::detail);
    // One column has room for the second scale at its top only.
    for (std::size_t k = 1; k < figure.panels.size(); ++k) figure.panels[k].second_x = {};
  }
  return with_limits(std::move(figure));
}

}  // namespace salebra::figures
