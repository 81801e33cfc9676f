// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/normal/normal.hpp>

#include "interop/arrays.hpp"
#include "interop/choice.hpp"

namespace salebra::python {

/// A state that knows its grid and its modulus, so that Python need not give them again.
struct BoundContact : NormalContactState {
  Grid2D grid;
  double contact_modulus = 0;
  Boundary boundary = Boundary::periodic;
};

}  // namespace salebra::python
