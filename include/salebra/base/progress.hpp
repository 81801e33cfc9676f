// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/enum_names.hpp>
#include <string_view>

namespace salebra {

/// Progress of a long computation, reported in the calling thread.
struct ProgressReport {
  std::string_view stage;  ///< name of the stage, such as "contact" or "sweep"
  double fraction = 0;     ///< finished fraction of the stage, 0 to 1; may be an estimate
  int step = 0;            ///< iterations or items done
  double residual = 0;     ///< residual of an iteration; 0 without one
};

/// Progress callback; it returns false to stop the computation as soon as possible. An empty
/// callback never stops it.
///     const Progress progress = [](const ProgressReport& report) { return report.step < 1000; };
using Progress = std::function<bool(const ProgressReport&)>;

/// How an iteration ended. A result of several iterations has the greatest (worst) value of all.
enum class Termination {
  converged,        ///< reached its tolerance
  stalled,          ///< further iterations do not reduce the error
  iteration_limit,  ///< reached the maximum number of iterations
  out_of_range,     ///< produced numbers that a double cannot represent
  interrupted       ///< the progress callback stopped it
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

/// Returns a message for the user, with options in backticks, e.g. "did not reach the tolerance;
/// raise `max_iterations`".
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
