// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>

namespace salebra {

/// Thrown when an operation needs complete data, by Surface::require_complete(). A separate type,
/// so that a program can say how it fills undefined points.
class UndefinedPoints : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

}  // namespace salebra
