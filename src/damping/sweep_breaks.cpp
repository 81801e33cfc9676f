// SPDX-License-Identifier: GPL-3.0-or-later
// Indentations within a sweep at which a contact law is not smooth.
#include "sweep_breaks.hpp"

#include <algorithm>

namespace salebra::detail {

std::vector<double> sweep_breaks(const ContactLaw& law, double low, double high) {
  constexpr std::size_t most = 400;
  std::vector<double> breaks;
  for (const double point : law.break_points())
    if (point > low && point < high) breaks.push_back(point);
  if (breaks.size() > most) breaks.clear();
  if (!(law.force(low) > 0) && law.force(high) > 0) {
    double open = low, closed = high;
    for (int halving = 0; halving < 100; ++halving) {
      const double middle = 0.5 * (open + closed);
      (law.force(middle) > 0 ? closed : open) = middle;
    }
    breaks.push_back(closed);
  }
  breaks.push_back(low);
  breaks.push_back(high);
  std::ranges::sort(breaks);
  const double least = 1e-14 * (high - low);
  std::vector<double> distinct;
  for (const double point : breaks)
    if (distinct.empty() || point - distinct.back() > least) distinct.push_back(point);
  distinct.back() = high;
  return distinct;
}

}  // namespace salebra::detail
