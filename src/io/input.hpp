// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/communicator.hpp>

namespace salebra {

/// Throws InvalidInput on all processes unless each of them would read the same bytes under this
/// name, or none has such a file. A file of one file system is known by its number, size and time;
/// where these differ, one process for each copy reads it whole. Collective.
void require_one_file(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace salebra
