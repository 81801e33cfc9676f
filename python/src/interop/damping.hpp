// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/assumptions.hpp>
#include <string>
#include <vector>

namespace salebra::python {

/// A damping constant with the assumptions behind it.
struct JudgedDamping : DampingResult {
  std::optional<Assumptions> assumptions;
};

constexpr void describe(auto&& visit, std::type_identity<JudgedDamping>) {
  describe(visit, std::type_identity<DampingResult>{});
  visit(&JudgedDamping::assumptions, Kept{"assumptions",
                                       "whether the contact may be taken for one without slip, "
                                       "yielding and inertia; None where they were not asked for"});
}

/// The same as Python knows it. The assumptions take far longer than the constant and are therefore
/// judged when they are read for the first time.
struct BoundDamping : DampingResult {
  mutable std::optional<Assumptions> assumptions;
  mutable std::function<Assumptions()>
      judge;  ///< empty: the assumptions are known, or were not asked for

  JudgedDamping judged() const {
    if (judge) assumptions = judge();
    judge = nullptr;
    return {*this, assumptions};
  }
};

/// Losses over one quantity, as pickles hold them and as Python knows them: a sequence of results with
/// an array for each of their numbers.
struct DampingCurve {
  std::string coordinate;  ///< the quantity: "pressure", "force", …
  std::vector<double> values;
  std::vector<JudgedDamping> results;
};

constexpr void describe(auto&& visit, std::type_identity<DampingCurve>) {
  keep(visit, &DampingCurve::coordinate, &DampingCurve::values, &DampingCurve::results);
}

struct BoundDampingCurve {
  std::string coordinate;
  std::vector<double> values;
  std::vector<BoundDamping> results;
};

inline ContactParameters known(const ContactParameters* parameters) { return parameters ? *parameters : ContactParameters{}; }

/// Warns of a loss that is NaN because friction is known and another input is not.
void warn_of_unknown(const Motion& motion, const ContactParameters* parameters, bool force_given = false);

/// "slip_of_opening_springs broken, amplitude doubtful", or that none is.
std::string verdicts(const Assumptions& assumptions);

}  // namespace salebra::python
