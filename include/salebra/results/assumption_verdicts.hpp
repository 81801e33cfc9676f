// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/damping/assumptions.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// One assumption of Assumptions, as data for texts: its name, its meaning, its statement with {}
/// for the 5 % limit, the words for its value with {} for the value, the remedy where it fails, and
/// the dimension of limit and value.
///     for (const AssumptionName& one : assumption_names()) std::cout << one.statement << '\n';
struct AssumptionName {
  Assumption Assumptions::*assumption;
  std::string_view name, meaning, statement, here, remedy;
  Dimension value_dimension = Dimension::dimensionless;
};

/// Returns all assumptions, in the order of their members in Assumptions.
std::span<const AssumptionName> assumption_names();

/// An assumption in words, judged over all cases (for example loads) of a result.
struct AssumptionVerdict {
  std::string name = {};        ///< name of the member of Assumptions
  Verdict verdict = {};         ///< worst verdict of all cases: broken, doubtful, unknown, holds
  std::string assumption = {};  ///< e.g. "slow: at least 8.74 normal cycles in an excursion"
  std::string here = {};    ///< value of the worst case: "2, at 2.04 MPa", "`hardness` not given"
  std::string remedy = {};  ///< what to do; empty if the assumption holds
};

constexpr void describe(auto&& visit, std::type_identity<AssumptionVerdict>) {
  using S = AssumptionVerdict;
  visit(&S::name, Kept{"name", "name of the assumption"});
  visit(&S::verdict, Kept{"verdict", "holds, doubtful, broken or unknown"});
  visit(&S::assumption,
        Kept{"assumption", "what must hold for the loss to change by less than 5 %"});
  visit(&S::here, Kept{"here", "what holds in the worst case"});
  visit(&S::remedy, Kept{"remedy", "what to do; empty where it holds"});
}

/// Returns the name of the argument that supplies the contact parameter named by Assumption::needs.
std::string given_as(const std::string& parameter);

/// Returns the assumptions of a damping constant in words, worst first. `cases` holds the checked
/// assumptions of each case, for example of each load.
///
///     std::vector<AssumptionVerdict> verdicts = verdicts_of(cases, false, pressures);
///
/// pressures      nominal pressure of each case, Pa; the text then names the pressures at which an
///                assumption fails; empty: it states the number of such cases
/// slip_followed  true: the loss includes slip, so the assumptions of no slip are left out; instead
///                the text says if a contact slides as a whole, because it is then no damper
/// The assumption of a small amplitude, which only the closed forms need, is not included: see
/// closed_form_verdict().
std::vector<AssumptionVerdict> verdicts_of(std::span<const Assumptions> cases, bool slip_followed,
                                           std::span<const double> pressures = {});

/// Sorts verdicts, worst first; those of one kind keep their order.
void sort_worst_first(std::vector<AssumptionVerdict>& verdicts);

/// Returns, in words, the additional assumption of the closed forms, Eqs (12), (15) and (16): a
/// small normal amplitude.
AssumptionVerdict closed_form_verdict(std::span<const Assumptions> cases,
                                      std::span<const double> pressures = {});

/// Returns the validity of a result, which the worst of its assumptions decides.
Validity validity_of(std::span<const AssumptionVerdict> verdicts);

/// Formats one line of at most 78 columns per assumption, with what must hold and what the worst
/// case has, and below it the remedy if the assumption does not hold. Names of parameters are in
/// backticks.
std::string in_words(std::span<const AssumptionVerdict> verdicts);

/// Formats the slip regimes of the cases, for example "partial slip at 1 MPa to 5 MPa, sliding at
/// 20 MPa"; empty if no regime is known.
std::string regimes_in_words(std::span<const Assumptions> cases,
                             std::span<const double> pressures = {});

/// Formats the largest motions without slip in the case that allows least, for example "no
/// excursion (µ up to 0.3), 89.6 pm at 5.75 µm/s (µ = 1)"; empty if no such motion is known.
std::string motion_without_slip(std::span<const Assumptions> cases);

}  // namespace salebra
