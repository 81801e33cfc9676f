// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/communicator.hpp>

namespace salebra {

/// Throws InvalidInput on all processes unless all of them read the same bytes under this name, or
/// none has a file of this name. Processes whose files have the same inode number, size and time
/// share a copy; one process of them reads it. With a single copy nothing is read. All processes
/// must call.
void require_one_file(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace salebra
