// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of a loss by the samples of the table from which its law comes.
#include "table_error.hpp"

#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>

#include "continued_law.hpp"

namespace salebra::detail {
namespace {

// Largest relative change of a loss by the springs below the lowest sample.
constexpr double max_change = 0.2;

double relative_change(double loss, double other) {
  return loss == other ? 0 : std::abs(other / loss - 1);
}

}  // namespace

ErrorBudget error_of_table(const ContactLaw& law, double lowest, double work, double measure,
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
  if (const auto coarser = law.coarser())
    error.intervals = relative_change(measure, loss_of(*coarser)) * std::abs(work);
  return error;
}

}  // namespace salebra::detail
