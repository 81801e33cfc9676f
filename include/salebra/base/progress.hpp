// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/enum_names.hpp>
#include <string_view>

namespace salebra {

/// What a long computation tells its caller, from the thread that called it.
struct ProgressReport {
  std::string_view stage;  ///< such as "contact", "sweep", "realisation"
  double fraction = 0;     ///< of this stage, 0 … 1; a guess where the end is not known
  int step = 0;            ///< iterations or items done
  double residual = 0;     ///< of an iteration; 0 where there is none
};

/// Returns false to stop the work as soon as it can. An empty Progress is silent and never stops.
using Progress = std::function<bool(const ProgressReport&)>;

/// How an iteration ended; of several the greatest.
enum class Termination {
  converged,        ///< to its tolerance
  stalled,          ///< further iterations come no closer to it
  iteration_limit,  ///< after as many iterations as were allowed
  out_of_range,     ///< with numbers that a double does not hold
  interrupted       ///< the progress callback said stop
};

template <>
struct EnumNames<Termination> {
  static constexpr auto values = std::to_array<std::pair<Termination, std::string_view>>(
      {{Termination::converged, "converged"},
       {Termination::stalled, "stalled"},
       {Termination::iteration_limit, "iteration_limit"},
       {Termination::out_of_range, "out_of_range"},
       {Termination::interrupted, "interrupted"}});
};

/// What to tell a user, with options in backticks: "did not reach the tolerance; raise
/// `max_iterations`".
constexpr std::string_view message(Termination termination) {
  switch (termination) {
    case Termination::stalled:
      return "did not reach the tolerance; allow a larger `tolerance`";
    case Termination::iteration_limit:
      return "did not reach the tolerance; raise `max_iterations`";
    case Termination::out_of_range:
      return "left the range of numbers; look at the units of heights and load";
    default:
      return name_of(termination);
  }
}

}  // namespace salebra
