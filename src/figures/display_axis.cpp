// SPDX-License-Identifier: GPL-3.0-or-later
// Axis of a picture: range, SI prefix, logarithm and tics.
#include "display_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <string_view>
#include <tuple>

namespace salebra::figures {
namespace {

// Units that can take an SI prefix. m² is not among them, since its prefix would be squared, nor is
// kg.
constexpr std::array<std::string_view, 14> scalable = {
    "m", "N", "Pa", "J", "W", "s", "Hz", "N/m", "N/m²", "N s/m", "rad/s", "m/s", "J/m", "N/m^2"};
// Units of densities and wave numbers: the prefix belongs to the metre, so that it is inverted.
constexpr std::array<std::string_view, 2> inverse = {"1/m", "rad/m"};

std::string number(double value) { return fmt::format("{:g}", value); }

/// The least step of 1, 2 or 5 times a power of ten that is not below this one.
double round_step(double least) {
  double step = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {2.0, 2.5, 2.0})
    if (step < least) step *= factor;
  return step;
}

// Gnuplot's list of tics for a logarithmic axis. Labels the decades; if there are few decades, also
// their 2nd and 5th multiples; and if the axis has fewer than two of these, round numbers at equal
// distances. The other multiples get small tics without label.
void set_logarithmic_tics(DisplayAxis& axis, int labels) {
  const double low = *axis.low - 1e-9, high = *axis.high + 1e-9;
  const int first = static_cast<int>(std::ceil(low)),
            decades = static_cast<int>(std::floor(high)) - first + 1;
  const bool few = high - low < 1.7 || decades < 2;
  const int stride = std::clamp(static_cast<int>(std::ceil((high - low) / (labels - 1))), 1,
                                std::max(1, decades - 1));
  int labelled = 0;
  std::string& tics = axis.tics;
  axis.longest_tic = 0;
  const auto add = [&](double at, const std::string& text) {
    if (at < low || at > high) return;
    labelled += !text.empty();
    // The digits of a power are half as wide, and its base has two.
    axis.longest_tic = std::max(axis.longest_tic, std::min<std::size_t>(text.size(), 5));
    tics += fmt::format("{}'{}' {:.9g}{}", tics.empty() ? "(" : ",", text, at,
                        text.empty() ? " 1" : "");
  };
  for (int decade = static_cast<int>(std::floor(low)); decade <= std::ceil(high); ++decade)
    for (int digit = 1; digit <= 9; ++digit) {
      const bool named =
          digit == 1 ? (decade - first) % stride == 0 : few && (digit == 2 || digit == 5);
      if (!named && digit > 1 && stride > 1) continue;
      const bool power = decade < -3 || decade > 4;
      add(decade + std::log10(digit), !named                ? ""
                                      : power && digit == 1 ? fmt::format("10^{{{}}}", decade)
                                      : power ? fmt::format("{}×10^{{{}}}", digit, decade)
                                              : number(digit * std::pow(10.0, decade)));
    }
  if (labelled < 2) {
    const double least = std::pow(10, low), most = std::pow(10, high),
                 step = round_step((most - least) / 4);
    tics.clear();
    for (double k = std::ceil(least / step); k * step <= most; ++k)
      add(std::log10(k * step), number(k * step));
  }
  if (!tics.empty()) tics += ")";
}

}  // namespace

std::pair<std::string, double> prefixed(const std::string& unit, double value) {
  constexpr std::array<std::string_view, 10> prefixes = {"a", "f", "p", "n", "µ",
                                                         "m", "",  "k", "M", "G"};
  const bool inverted = std::ranges::find(inverse, unit) != inverse.end();
  if (!(value > 0) || (!inverted && std::ranges::find(scalable, unit) == scalable.end()))
    return {unit, 1};
  // The factor keeps numbers that three digits round to a power of 1000 from the lower prefix.
  const double thousands = std::floor(std::log10(value * (1 + 5e-4)) / 3);
  const int power = static_cast<int>(std::clamp(inverted ? -thousands : thousands, -6.0, 3.0));
  const std::string prefix(prefixes[static_cast<std::size_t>(power + 6)]);
  return inverted
             ? std::pair(unit.substr(0, unit.size() - 1) + prefix + "m", std::pow(10.0, 3 * power))
             : std::pair(prefix + unit, std::pow(10.0, -3 * power));
}

double DisplayAxis::display(double value) const {
  const double shown = value * factor;
  if (!std::isfinite(shown) || (logarithmic && !(shown > 0)))
    return std::numeric_limits<double>::quiet_NaN();
  return logarithmic ? std::log10(shown) : shown;
}

DisplayAxis display_axis(const Axis& axis, const std::vector<std::span<const double>>& data,
                         int labels) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  bool any = false;
  const auto see = [&](double value) {
    if (!std::isfinite(value)) return;
    any = true;
    if (axis.logarithmic && !(value > 0)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  };
  for (const auto& column : data)
    for (const double value : column) see(value);
  if (axis.low) least = *axis.low;
  if (axis.high) most = *axis.high;
  const std::string field = "axis '" + axis.label + "'";
  require_that(any, field, "no value is finite, so there is nothing to draw");
  require(least <= most && (!axis.logarithmic || least > 0), field,
          number(least) + " to " + number(most), "is not a valid range for this axis");

  DisplayAxis out;
  out.logarithmic = axis.logarithmic;
  // The middle of a logarithmic axis has the short numbers.
  std::tie(out.unit, out.factor) =
      prefixed(axis.unit, axis.prefix_of     ? *axis.prefix_of
                          : axis.logarithmic ? std::sqrt(least) * std::sqrt(most)
                                             : std::max(std::abs(least), std::abs(most)));
  out.label = out.unit.empty() ? axis.label : axis.label + " (" + out.unit + ")";
  if (axis.low) out.low = out.display(*axis.low);
  if (axis.high) out.high = out.display(*axis.high);
  if (axis.logarithmic) {
    const double from = out.display(least), to = out.display(most);
    const double padding = to > from ? 0.03 * (to - from) : 0.5;
    if (!out.low) out.low = from - padding;
    if (!out.high) out.high = to + padding;
    set_logarithmic_tics(out, labels);
  }
  return out;
}

void set_linear_tics(DisplayAxis& axis, int labels) {
  if (axis.logarithmic || !axis.low || !axis.high || !(*axis.low < *axis.high)) return;
  double step = round_step((*axis.high - *axis.low) / labels);
  // A scale needs two numbers, and a range about zero may have one multiple of the step only.
  while (std::floor(*axis.high / step) - std::ceil(*axis.low / step) < 1)
    step = round_step(step / 2.6);  // from 5 to 2, from 2 to 1, from 1 to 0.5
  axis.tics = fmt::format("{:.9g}", step);
  axis.longest_tic = 0;
  for (double k = std::ceil(*axis.low / step); k <= *axis.high / step; ++k)
    axis.longest_tic = std::max(axis.longest_tic, number(k * step).size());
}

}  // namespace salebra::figures
