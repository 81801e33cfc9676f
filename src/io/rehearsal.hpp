// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

namespace salebra::detail {

/// Does the work first in a child process whose effects are discarded, and throws InvalidInput naming the file if that dies of a signal
/// or takes more than `seconds`. For libraries with memory errors of their own on damaged files, such as HDF5 1.10: the caller goes
/// on only where the same work, from the same state, has come to its end. What the work throws does not matter here.
/// Where the system grants no process, there is no rehearsal.
/// cost   of a fork (0.1 ms, and 5 ms per GB that the process holds) and of the work
void rehearse(const std::filesystem::path& file, const std::function<void()>& work,
              unsigned seconds = 30);

}  // namespace salebra::detail
