// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/contact/half_space/body.hpp>

#include "toml_reader.hpp"

namespace salebra::detail {

/// Reads the table [body] of a study: the keys of read_body(), or `file` alone, a file with them,
/// whose path is relative to `folder`.
Body read_body_table(TomlTable& table, const std::filesystem::path& folder);

}  // namespace salebra::detail
