// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
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

}  // namespace salebra
