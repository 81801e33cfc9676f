// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/io/result_file.hpp>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace salebra::detail {

/// The figures of one point of the parameter grid, as the library makes them, read from the groups of a
/// results file. `figures` is a list of the objects of figure_json() with one panel each, whose kind
/// is the name of the figure on the page; `motion` is a sentence, if the study has damping. The values of a map are the bytes of its
/// 32-bit numbers in base64, (x, y). Figures without data in the file are left out.
/// where: path in front of the names of the groups. map_side: most points of a map along an axis.
/// Throws InvalidInput for a file whose lists do not match.
Json page_figures(const ResultReader& file, const std::string& where,
                  const std::vector<double>& pressures, Index map_side);

/// The figures of a whole parameter grid, as `figures` above: l/h_rms of its points, which have these names.
Json grid_figures(const ResultReader& file, const std::vector<std::string>& names);

}  // namespace salebra::detail
