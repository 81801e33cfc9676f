// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/premises.hpp>
#include <span>
#include <string>
#include <vector>

/// Whether a result may be used, in one word and in the words of a user: the same on the terminal,
/// in JSON and files, in the report and in Python.
namespace salebra {

enum class Validity {
  valid,            ///< all conditions hold: 5 % of the loss at most
  valid_with_care,  ///< one or more are between their limits of 5 and 20 %
  not_valid,        ///< one or more are beyond their limit of 20 %
  not_checked       ///< those that could be judged hold, and others could not
};
template <>
struct Words<Validity> {
  static constexpr auto values = std::to_array<std::pair<Validity, std::string_view>>(
      {{Validity::valid, "valid"},
       {Validity::valid_with_care, "valid with care"},
       {Validity::not_valid, "not valid"},
       {Validity::not_checked, "not checked"}});
};

/// A premise in words, judged over all cases of a result.
struct Condition {
  std::string name = {};       ///< of the member of Premises
  Verdict verdict = {};        ///< the worst of the cases; one that is unknown comes after doubtful
  std::string condition = {};  ///< "slow: at least 8.74 normal cycles in an excursion"
  std::string here = {};       ///< "2, at 2.04 MPa to 102 MPa"; "`hardness` not given"
  std::string remedy = {};     ///< what to do; empty where it holds
};

constexpr void describe(auto&& visit, std::type_identity<Condition>) {
  using S = Condition;
  visit(&S::name, Kept{"name", "name of the premise"});
  visit(&S::verdict, Kept{"verdict", "holds, doubtful, broken or unknown"});
  visit(&S::condition, Kept{"condition", "what must hold for the loss to change by less than 5 %"});
  visit(&S::here, Kept{"here", "what holds in the worst case"});
  visit(&S::remedy, Kept{"remedy", "what to do; empty where it holds"});
}

/// The conditions of a damping constant, worst first. pressures: of the cases, Pa, to be named;
/// empty: they are counted. slip_followed: the loss is that with slip, which then is no condition.
/// The amplitude of the closed forms is none: see closed_form_condition().
std::vector<Condition> conditions_of(std::span<const Premises> cases, bool slip_followed,
                                     std::span<const double> pressures = {});

/// What Eqs (12), (15) and (16) need in addition.
Condition closed_form_condition(std::span<const Premises> cases,
                                std::span<const double> pressures = {});

/// Of the worst condition.
Validity validity_of(std::span<const Condition> conditions);

/// A line for each condition, "  !   slow: at least … here 2, …", of at most 78 columns, with its
/// remedy below where it does not hold. Names of facts stand in backticks.
std::string in_words(std::span<const Condition> conditions);

/// The largest motions without slip, "no excursion (µ up to 0.3), 89.6 pm at 5.75 µm/s (µ = 1)", of the
/// case that bears least; empty where none is known.
std::string motion_without_slip(std::span<const Premises> cases);

}  // namespace salebra
