// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace salebra::detail {

/// Where the size, the unit and the period of an NPY array stand.
inline std::filesystem::path sidecar_of(const std::filesystem::path& file) {
  return file.string() + ".json";
}

}  // namespace salebra::detail
