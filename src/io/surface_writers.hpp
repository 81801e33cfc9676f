// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/grid.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <string>

#include "json.hpp"

/// Functions that the writers of surface formats share. write_surface() checks the surface before
/// it calls a writer.
namespace salebra::detail {

/// Size, unit, origin and provenance of a surface as a JSON object, for formats that have no fields
/// for them.
Json description_of(const Surface& surface, const Provenance& provenance);

/// Appends a number with as few digits as give the same double when read back, or "nan".
void append_number(std::string& text, double value);

}  // namespace salebra::detail
