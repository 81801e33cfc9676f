// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/configuration.hpp>

#include "toml_reader.hpp"

namespace salebra::detail {

/// The keys of a measured surface, of a study or of one of several scans. folder: of the document.
MeasuredSurface read_measured(TomlTable& table, const std::filesystem::path& folder);

}  // namespace salebra::detail
