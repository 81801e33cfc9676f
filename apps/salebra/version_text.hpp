// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "launch.hpp"

namespace salebra::cli {

/// The commit of the program's sources; empty: not known.
std::string_view source_revision();

/// What `--version --verbose` prints, which a report of a fault needs: a line each of revision,
/// compiler, libraries, processor, processes and system.
std::string version_text(const Launch& launch);

}  // namespace salebra::cli
