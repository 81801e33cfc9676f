// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>

namespace salebra {

/// Some heights are undefined where each is needed, as Surface::require_complete() finds out. An InvalidInput of its own, so that a
/// program can say how it fills them.
class UndefinedPoints : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

}  // namespace salebra
