// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/io/json.hpp>

/// --hardness of the commands that press a surface.
namespace salebra::cli {

/// Help of the option.
inline constexpr const char* hardness_help =
    "of the softer body. A surface is first loaded to its largest pressure, with local pressures "
    "up to the hardness, and the results are those of the unloading curve; a law is only judged "
    "by it";

/// Puts the residual surface of the first loading in place of the surface, and returns what flowed;
/// without a hardness nothing. contact: boundary, tolerance and progress. Throws NotConverged,
/// Interrupted, and as after_first_loading().
std::optional<FirstLoading> load_first(Surface& surface, const std::optional<double>& hardness,
                                       double contact_modulus, double nominal_pressure,
                                       NormalContactOptions contact, double normal_amplitude = 0);

/// Adds its columns under "first_loading", where there was one.
void add_first_loading(Json& answer, const std::optional<FirstLoading>& loading);

}  // namespace salebra::cli
