// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of a loss by the samples of the table from which its law comes.
#include "table_error.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <vector>

#include "continued_law.hpp"

namespace salebra::detail {
namespace {

// Largest relative change of a loss by the springs below the lowest sample.
constexpr double max_change = 0.2;

double relative_change(double loss, double other) {
  return loss == other ? 0 : std::abs(other / loss - 1);
}

// The loss of a motion that is narrower than the distance between two samples is proportional to the
// slope of K there. Contact patches that touch one after the other make this slope scatter, which
// an interpolation does not show. Returns the scatter of the slope of ln K over the five intervals
// about the motion, from a straight line through them, as a fraction of this slope; 0 for motions
// over several samples, in which it averages out.
double scatter_of_slope(const ContactLaw& law, std::pair<double, double> swing) {
  const std::vector<double> nodes = law.break_points();  // first touch, then the samples
  constexpr std::ptrdiff_t count = 5, first = 1;
  const auto samples = std::ssize(nodes) - first;
  const double middle = 0.5 * (swing.first + swing.second);
  if (samples < count + 1 || middle < nodes[first] || middle > nodes.back()) return 0;
  const auto above = std::ranges::upper_bound(nodes, middle) - nodes.begin();
  const auto begin = std::clamp(above - 1 - count / 2, first, first + samples - 1 - count);
  const double spacing = nodes[std::size_t(std::min(above, std::ssize(nodes) - 1))] -
                         nodes[std::size_t(std::min(above, std::ssize(nodes) - 1) - 1)];
  if (swing.second - swing.first > 2 * spacing) return 0;
  Eigen::Matrix<double, count, 1> slope, at;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double low = nodes[std::size_t(begin + i)], high = nodes[std::size_t(begin + i + 1)];
    slope(i) = std::log(law.normal_stiffness(high) / law.normal_stiffness(low)) / (high - low);
    at(i) = 0.5 * (low + high) - middle;
  }
  const auto out = (at.array() - at.mean()).matrix().eval();
  const double rise = out.dot(slope) / out.squaredNorm();
  const auto rest = (slope.array() - slope.mean() - rise * out.array()).matrix();
  // Two of the five numbers determine the line.
  return std::sqrt(rest.squaredNorm() / (count - 2)) / std::abs(slope.mean() - rise * at.mean());
}

}  // namespace

ErrorBudget error_of_table(const ContactLaw& law, std::pair<double, double> swing, double lowest,
                           double work, double measure,
                           const std::function<double(const ContactLaw&)>& loss_of) {
  const double end = law.lowest_indentation();
  if (!std::isfinite(end)) return {};
  ErrorBudget error{.cells = 0, .noise = 0, .stiffness_ratio = 0, .solver = 0};
  if (lowest < end - 1e-12 * std::abs(end)) {
    const double change =
        relative_change(measure, loss_of(ContinuedLaw(law, BelowTable::exponential)));
    require(!(change > max_change), "curve", format_quantity(law.force(end), Dimension::force, 3),
            "is its lowest load, and the springs below this load decide on the loss; extend the "
            "curve to lower loads, or change the motion");
    error.first_touch = change * std::abs(work);
  }
  for (const bool odd : {false, true})
    if (const auto coarser = law.coarser(odd))
      error.intervals =
          std::fmax(error.intervals, relative_change(measure, loss_of(*coarser)) * std::abs(work));
  error.intervals = std::hypot(error.intervals, scatter_of_slope(law, swing) * std::abs(work));
  return error;
}

double stiffness_ratio_exponent(const ContactLaw& law, double indentation) {
  const double force = law.force(indentation), lowest = law.lowest_indentation();
  const double least = std::isfinite(lowest) ? law.force(lowest) : 0;
  const double below = law.indentation_of(std::max(force / 2, least));
  return std::log(law.stiffness_ratio(below) / law.stiffness_ratio(indentation)) /
         std::log(law.force(below) / force);
}

}  // namespace salebra::detail
