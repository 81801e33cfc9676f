// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/cycle.hpp>

namespace salebra::python {

/// ContactLevels as a Python object, and the grid that they belong to.
struct BoundLevels {
  ContactLevels levels;
  Grid2D grid;
};

}  // namespace salebra::python
