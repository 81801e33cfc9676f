// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/figures/figure.hpp>
#include <string>

namespace salebra::figures {

enum class PictureFormat { png, svg, pdf };

/// The gnuplot program that draws a figure to its standard output. width: of the printed figure, m;
/// empty: the size of a screen. It contains no name of an output
/// file, because gnuplot runs a name that starts with '|' as a command. Throws InvalidInput for a
/// figure that cannot be drawn.
std::string gnuplot_script(const Figure& figure, PictureFormat format,
                           std::optional<double> width = {}, bool caption = true);

}  // namespace salebra::figures
