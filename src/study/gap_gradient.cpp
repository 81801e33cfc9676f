// SPDX-License-Identifier: GPL-3.0-or-later
// Response of the mean gap of contacts to small changes of the heights, by flat punches on the
// contact sets.
#include "gap_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/punch.hpp>
#include <salebra/contact/sweep.hpp>

namespace salebra::detail {

void GapGradient::solve(const Surface& surface, const Body& body,
                        const std::vector<double>& pressures, const NormalContactOptions& options) {
  if (pressures.empty()) return;
  SweepOptions sweep{.contact = options, .stiffness = false};
  std::vector<Contact> solved(pressures.size());
  sweep.on_state = [&](std::size_t k, const NormalContactState& state) {
    Contact& contact = solved[k];
    contact.sample = force_sample(state, surface, body, sweep);
    Field punch;
    if (state.contact_area_fraction == 1) return;
    // The response is linear in the error of w, while K and the gap are quadratic in theirs.
    const PunchStiffness found = punch_stiffness(
        contact_set(state), surface.grid, body,
        {.tolerance = std::sqrt(options.tolerance), .on_progress = options.on_progress}, &punch);
    if (found.termination == Termination::interrupted) throw Interrupted("study: interrupted");
    if (!found.converged()) return;
    contact.sample.normal_stiffness = found.normal_stiffness;
    const double sum = punch.sum();
    for (Index i = 0; i < punch.size(); ++i)
      if (punch.data()[i] != 0) contact.weights.emplace_back(i, punch.data()[i] / sum);
  };
  if (sweep_pressures(surface, body, pressures, sweep).samples.size() < pressures.size())
    throw Interrupted("study: interrupted");
  std::ranges::copy_if(solved, std::back_inserter(contacts_), [](const Contact& contact) {
    return std::isfinite(contact.sample.normal_stiffness) && !contact.weights.empty();
  });
  std::ranges::sort(contacts_, {}, [](const Contact& contact) { return contact.sample.force; });
}

std::vector<double> GapGradient::response(const Field& change) const {
  const double mean = change.mean();
  std::vector<double> response;
  for (const Contact& contact : contacts_) {
    double sum = -mean;
    for (const auto& [cell, weight] : contact.weights) sum += weight * change.data()[cell];
    response.push_back(sum);
  }
  return response;
}

}  // namespace salebra::detail
