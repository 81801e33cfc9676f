// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <salebra/base/grid.hpp>

namespace salebra {

/// A field that is not initialised, on large pages where the system has them: the first touch of a field of ordinary pages can
/// take longer than its Fourier transform.
Field uninitialised_field(Index nx, Index ny);

/// Bytes that new data can take without swapping, as the system estimates it; all that the machine has where /proc is not
/// mounted, and 0 where the system does not say.
std::size_t available_memory();

}  // namespace salebra
