// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace salebra::detail {

/// Path of the JSON file (sidecar) next to a NumPy array, which contains size, unit and period of
/// the surface.
inline std::filesystem::path sidecar_of(const std::filesystem::path& file) {
  return file.string() + ".json";
}

}  // namespace salebra::detail
