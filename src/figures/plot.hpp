// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/figures/figure.hpp>
#include <salebra/io/output.hpp>

/// Pictures of figures by gnuplot, as PNG, SVG or PDF; as JSON without it.
///     write_plot("force.png", figure);
namespace salebra::figures {

/// Throws the errors that write_plot() would throw before it draws, for callers that compute for a
/// long time before: InvalidInput for a suffix other than .png, .svg, .pdf and .json, and as
/// require_output() does; IoError if gnuplot is needed and not installed.
void require_plot(const std::filesystem::path& file, const WriteOptions& options = {});

/// Draws a figure to a .png (at twice the size on the screen), .svg or .pdf file, or writes its
/// numbers to a .json file (figure_json()). width: of the printed figure, m, with texts of 7 points, such as 85 and 170 mm for
/// one and two columns of a journal; empty: the size of a screen. Large images are averaged to at most 1200 cells per side
/// of a picture. The file appears only when it is complete. Throws as require_plot() does;
/// InvalidInput for columns of different lengths, for a logarithmic axis whose values are all <= 0,
/// and for a figure without data; IoError with gnuplot's message if gnuplot fails. Cost: 0.1 to 1 s,
/// and one gnuplot process.
void write_plot(const std::filesystem::path& file, const Figure& figure,
                const WriteOptions& options = {}, std::optional<double> width = {},
                bool caption = true);

}  // namespace salebra::figures
