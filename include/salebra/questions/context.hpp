// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/progress.hpp>

namespace salebra {

/// The caller of a question while it is being answered.
struct Context {
  Progress on_progress = {};
  /// Looked at wherever a law is evaluated, so that every search and quadrature over it stops,
  /// whether or not it reports progress: true throws Interrupted. Empty: never.
  std::function<bool()> stopped = {};
};

}  // namespace salebra
