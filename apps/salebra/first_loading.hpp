// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/questions/contact.hpp>

#include "results/columns.hpp"

/// --hardness of the commands that press a surface.
namespace salebra::cli {

/// Help of the option.
inline constexpr const char* hardness_help =
    "of the softer body. A surface is first loaded to its largest pressure, with local pressures "
    "up to the hardness, and the results are those of the unloading curve; a law is only judged "
    "by it";

/// Adds its columns under "first_loading", where there was one.
inline void add_first_loading(Json& answer, const std::optional<FirstLoading>& loading) {
  if (loading) answer["first_loading"] = json_of(*loading);
}

}  // namespace salebra::cli
