// SPDX-License-Identifier: GPL-3.0-or-later
// Piecewise polynomial table of K_t(δ) of a law, with exact moments of its derivative.
#include "stiffness_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>

#include "sweep_breaks.hpp"

namespace salebra::detail {
namespace {

constexpr std::size_t block = 32;
constexpr int degree = 5;

double horner(const std::array<double, degree + 1>& c, double s) {
  return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
}

double horner_derivative(const std::array<double, degree + 1>& c, double s) {
  return c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * 5 * c[5])));
}

// Chebyshev–Lobatto nodes of a cell. They include both ends of the cell, so that the polynomials of
// neighbouring cells meet.
std::array<double, degree + 1> nodes() {
  std::array<double, degree + 1> s{};
  for (int i = 0; i <= degree; ++i)
    s[static_cast<std::size_t>(i)] = -std::cos(std::numbers::pi * i / degree);
  return s;
}

std::array<double, degree + 1> monomials(const std::array<double, degree + 1>& s,
                                         std::array<double, degree + 1> values) {
  for (std::size_t order = 1; order <= degree; ++order)
    for (std::size_t i = degree; i >= order; --i)
      values[i] = (values[i] - values[i - 1]) / (s[i] - s[i - order]);
  std::array<double, degree + 1> c{};
  for (std::size_t i = degree + 1; i-- > 0;) {
    for (std::size_t j = degree; j > 0; --j) c[j] = c[j - 1] - s[i] * c[j];
    c[0] = values[i] - s[i] * c[0];
  }
  return c;
}

}  // namespace

void StiffnessTable::Moments::append(const Moments& next, double offset) {
  second += next.second + offset * (2 * next.first + offset * next.zeroth);
  first += next.first + offset * next.zeroth;
  zeroth += next.zeroth;
}

StiffnessTable::StiffnessTable(const ContactLaw& law, double lowest, double highest,
                               double relative_tolerance)
    : core_(law.tangential_stiffness(lowest)), highest_(highest) {
  const double change = law.tangential_stiffness(highest) - core_;
  require(std::isfinite(highest - lowest) && std::isfinite(core_ + change), "indentation", highest,
          "m makes the contact stiffness overflow; reduce the motion");
  // Tolerance for the polynomials, not smaller than the round-off of the law.
  const double tolerance =
      std::max(relative_tolerance * std::abs(change), 1e-15 * (core_ + std::abs(change)));
  if (highest > lowest) {
    const std::vector<double> breaks = sweep_breaks(law, lowest, highest);
    for (std::size_t i = 1; i < breaks.size(); ++i)
      add_cells(law, breaks[i - 1], breaks[i], tolerance, 0);
  } else {
    cells_.push_back({.middle = lowest, .half_width = 1});
    starts_.push_back(lowest);
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double end = i + 1 < cells_.size() ? starts_[i + 1] : highest_;
    whole_cells_.push_back(within(cells_[i], starts_[i], end));
    if (i % block == 0) whole_blocks_.emplace_back();
    whole_blocks_.back().append(whole_cells_.back(), starts_[i] - starts_[i - i % block]);
  }
}

void StiffnessTable::add_cells(const ContactLaw& law, double low, double high, double tolerance,
                               int depth) {
  static const std::array<double, degree + 1> s = nodes();
  Cell cell{.middle = 0.5 * (low + high), .half_width = 0.5 * (high - low)};
  auto exact = [&](double position) {
    const double indentation = cell.middle + cell.half_width * position;
    return law.tangential_stiffness(std::clamp(indentation, low, high)) - core_;
  };
  std::array<double, degree + 1> values{};
  std::ranges::transform(s, values.begin(), exact);
  cell.coefficients = monomials(s, values);
  // A jump of K_t needs some fifty halvings of its cell; the remaining steep ramp has no effect.
  constexpr int deepest = 50;
  // Indentations are rounded. Where K_t rises steeply, as at first touch far from indentation 0, this
  // alone changes it by more than the tolerance, and narrower cells would follow the rounding errors.
  const double rounding = std::numeric_limits<double>::epsilon() *
                          std::max(std::abs(low), std::abs(high)) *
                          std::abs((values.back() - values.front()) / (high - low));
  bool fits = true;
  for (std::size_t i = 0; i < degree && fits && depth < deepest; ++i) {
    const double between = 0.5 * (s[i] + s[i + 1]);
    fits = std::abs(horner(cell.coefficients, between) - exact(between)) <= tolerance + rounding;
  }
  // Limits the number of cells: if a law scatters by more than the tolerance, each cell would be
  // halved as often as possible.
  constexpr std::size_t max_cells = std::size_t{1} << 20;
  if (fits || !(cell.middle > low && cell.middle < high) || cells_.size() >= max_cells) {
    cells_.push_back(cell);
    starts_.push_back(low);
    return;
  }
  add_cells(law, low, cell.middle, tolerance, depth + 1);
  add_cells(law, cell.middle, high, tolerance, depth + 1);
}

std::size_t StiffnessTable::cell_of(double indentation) const {
  const auto above = std::upper_bound(starts_.begin() + 1, starts_.end(), indentation);
  return static_cast<std::size_t>(above - starts_.begin()) - 1;
}

double StiffnessTable::at(double indentation) const {
  const Cell& cell = cells_[cell_of(indentation)];
  return horner(cell.coefficients,
                std::clamp((indentation - cell.middle) / cell.half_width, -1.0, 1.0));
}

// Moments of K_t' over [low, high] within one cell. The four Gauss points are exact for polynomials
// up to degree 7, and the integrand has degree 6. The sum has no cancellation, however short the
// range is.
StiffnessTable::Moments StiffnessTable::within(const Cell& cell, double low, double high) const {
  constexpr double node[2] = {0.3399810435848563, 0.8611363115940526};
  constexpr double weight[2] = {0.6521451548625461, 0.3478548451374538};
  const double half = 0.5 * (high - low);
  const double middle = (0.5 * (low + high) - cell.middle) / cell.half_width;
  const double reach = half / cell.half_width;
  Moments sum;
  for (int i = 0; i < 2; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double slope =
          weight[i] * horner_derivative(cell.coefficients, middle + side * reach * node[i]);
      const double distance = half * (1 + side * node[i]);
      sum.zeroth += slope;
      sum.first += slope * distance;
      sum.second += slope * distance * distance;
    }
  return {sum.zeroth * reach, sum.first * reach, sum.second * reach};
}

StiffnessTable::Moments StiffnessTable::moments(double low, double high) const {
  const std::size_t first = cell_of(low), last = cell_of(high);
  if (first == last) return within(cells_[first], low, high);
  Moments sum = within(cells_[first], low, starts_[first + 1]);
  for (std::size_t i = first + 1; i < last;) {
    const bool block_fits = i % block == 0 && i + block <= last;
    sum.append(block_fits ? whole_blocks_[i / block] : whole_cells_[i], starts_[i] - low);
    i += block_fits ? block : 1;
  }
  sum.append(within(cells_[last], starts_[last], high), starts_[last] - low);
  return sum;
}

}  // namespace salebra::detail
