// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "launch.hpp"

namespace salebra::cli {

/// The commit of the sources from which the program was built; empty if not known.
std::string_view source_revision();

/// Text of `--version --verbose`, which a bug report needs: a line each for revision, compiler,
/// libraries, build, processor, processes and system.
std::string version_text(const Launch& launch);

}  // namespace salebra::cli
