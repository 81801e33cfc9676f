// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/premises.hpp>
#include <string>

namespace salebra::python {

/// A damping constant with the premises behind it.
struct BoundDamping : DampingResult {
  std::optional<Premises> premises;
};

constexpr void describe(auto&& visit, std::type_identity<BoundDamping>) {
  describe(visit, std::type_identity<DampingResult>{});
  visit(&BoundDamping::premises, Kept{"premises",
                                      "whether the contact may be taken for one without slip, "
                                      "yielding and inertia; None where they were not asked for"});
}

inline ContactFacts known(const ContactFacts* facts) { return facts ? *facts : ContactFacts{}; }

/// "slip_of_opening_levels broken, amplitude doubtful", or that none is.
std::string verdicts(const Premises& premises);

}  // namespace salebra::python
