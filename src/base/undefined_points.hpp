// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>

namespace salebra {

/// Thrown by Surface::require_complete() if an operation needs complete data. It has its own type,
/// which lets a program explain how to fill undefined points.
class UndefinedPoints : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

}  // namespace salebra
