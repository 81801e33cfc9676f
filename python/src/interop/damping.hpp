// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/dissipation.hpp>
#include <span>
#include <string>
#include <vector>

#include "interop/curves.hpp"

namespace salebra::python {

/// A damping constant and its assumptions.
struct JudgedDamping : DampingResult {
  std::optional<Assumptions> assumptions;
};

constexpr void describe(auto&& visit, std::type_identity<JudgedDamping>) {
  describe(visit, std::type_identity<DampingResult>{});
  visit(&JudgedDamping::assumptions,
        Kept{"assumptions",
             "assumptions: no slip, no yielding, no inertia; None if they "
             "were not judged"});
}

/// The Python object of a damping result. To judge the assumptions takes far longer than to compute
/// the damping constant, so they are judged when they are first read.
struct BoundDamping : DampingResult {
  mutable std::optional<Assumptions> assumptions;
  /// Empty: the assumptions are known, or were not requested. Is called without the interpreter's
  /// lock.
  mutable std::function<Assumptions()> judge;

  JudgedDamping judged() const;
};

/// Judges the assumptions of all results that need it, in parallel. The caller must hold the
/// interpreter's lock.
void judge_all(std::span<const BoundDamping> results);
/// The assumptions of all results that have them. The caller must hold the interpreter's lock.
std::vector<Assumptions> assumptions_of(std::span<const BoundDamping> results);
/// Whether a result includes slip, which is then no assumption.
bool follow_slip(std::span<const BoundDamping> results);

/// Damping results for several values of one quantity. Pickles store them as
/// CurveOf<JudgedDamping>.
using BoundDampingCurve = CurveOf<BoundDamping>;

inline ContactParameters known(const ContactParameters* parameters) {
  return parameters ? *parameters : ContactParameters{};
}

/// Warns if the loss is NaN because the coefficient of friction was given and another input that is
/// then needed was not. force_given: whether the motion was given by a force amplitude.
void warn_of_unknown(const Motion& motion, const ContactParameters* parameters,
                     bool force_given = false);

/// Text with the assumptions that do not hold, such as "slip_of_opening_springs broken, amplitude
/// doubtful"; if there is none, a text that none is broken.
std::string verdicts(const Assumptions& assumptions);

}  // namespace salebra::python
