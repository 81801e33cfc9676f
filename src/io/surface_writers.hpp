// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/grid.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <string>

#include "json.hpp"

/// What the writers behind write_surface share. It has checked the surface.
namespace salebra::detail {

/// Size, unit, origin and provenance as a JSON object, for formats that have no place of their own
/// for them.
Json description_of(const Surface& surface, const Provenance& provenance);

/// Appends the shortest digits that read back as the same double, or "nan".
void append_number(std::string& text, double value);

}  // namespace salebra::detail
