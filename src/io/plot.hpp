// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/io/output.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Pictures of results: lines, bands, markers and maps in panels, as PNG, SVG or PDF. gnuplot draws
/// them, but this interface does not depend on it.
///
///     Figure figure;
///     PlotPanel& panel = figure.panels.emplace_back();
///     panel.x = {.label = "indentation δ", .unit = "m"};
///     panel.y = {.label = "force F", .unit = "N", .logarithmic = true};
///     panel.curves.push_back({.name = "boundary elements", .x = indentation, .y = force});
///     panel.curves.push_back(
///         {.name = "Hertz", .x = indentation, .y = hertz, .style = PlotStyle::dashed});
///     write_plot("force.png", figure);
///
/// Data are in SI units; an axis with a unit gets the SI prefix that suits its values, "indentation
/// δ (nm)". Text is UTF-8 with markup for subscripts and powers, u_z, W_{max}, 10^{-3}. Pass file
/// names and other texts of the user through plot_text() first.
namespace salebra {

struct PlotAxis {
  std::string label = {};  ///< without the unit
  std::string unit = {};   ///< of the data, such as m, N s/m, rad/s; empty: a plain number
  bool logarithmic = false;
  /// Limits in the unit of the data; empty: chosen to fit the data.
  std::optional<double> low = {}, high = {};
};

enum class PlotStyle { line, dashed, dotted, points, line_and_points };

struct PlotCurve {
  std::string name = {};               ///< name in the legend; empty: the curve is not listed there
  std::vector<double> x = {}, y = {};  ///< NaN interrupts the line
  /// Limits of a band around the line, such as a confidence interval, or of the error bars of
  /// points. Either both are given or none.
  std::vector<double> low = {}, high = {};
  PlotStyle style = PlotStyle::line;
  /// Number of the colour: 0 blue, 1 vermilion, 2 green, 3 purple, 4 orange, 5 light blue, 6 black,
  /// 7 grey, 8 wine; −1: the next of the colours 0 to 6, in turn.
  int color = -1;
};

/// Colours of an image. sequential: from dark to bright; diverging: from blue over white to red,
/// for signed values, symmetric about 0 unless the scale has limits; grey: from white to black.
enum class PlotPalette { sequential, diverging, grey };

struct PlotImage {
  std::vector<double> x = {}, y = {};  ///< centres of the cells, increasing; equally spaced or not
  Field values = {};                   ///< (x, y); NaN is left white
  PlotAxis scale = {};                 ///< quantity and limits of the colour scale
  PlotPalette palette = PlotPalette::sequential;
  std::vector<double> contours = {};  ///< values of contour lines, each labelled with its value
  bool color_bar = true;
};

/// A thin line across the whole panel.
struct PlotLine {
  double at = 0;
  bool vertical = false;
  std::string name = {};  ///< written next to the line; empty: none
};

enum class PlotLegend { top_right, top_left, bottom_right, bottom_left, right_of_panel };

struct PlotPanel {
  std::string title = {};
  PlotAxis x = {}, y = {};
  /// A second scale along the top, if x is logarithmic; none if it has no label.
  PlotAxis top = {};
  double top_factor = 1;  ///< value on the top scale divided by the value of x at the same place
  std::optional<PlotImage> image = {};  ///< drawn under the curves
  std::vector<PlotCurve> curves = {};
  std::vector<PlotLine> lines = {};
  PlotLegend legend = PlotLegend::top_right;
  bool equal_scales = false;  ///< a metre has the same length along x and y
};

struct Figure {
  std::string title = {};
  std::deque<PlotPanel> panels = {};  ///< references to panels stay valid when panels are added

  int columns = 0;  ///< number of panels in a row; 0: chosen so that the figure is about square
};

/// Escapes the characters of a text that are markup, so that the text (such as a file name) is
/// drawn as it is.
std::string plot_text(std::string_view plain);

/// Throws the errors that write_plot() would throw before it draws, for callers that compute for a
/// long time before: InvalidInput for a suffix other than .png, .svg and .pdf, and as
/// require_output() does; IoError if gnuplot is not installed.
void require_plot(const std::filesystem::path& file, const WriteOptions& options = {});

/// Draws a figure to a .png (at twice the size on the screen), .svg or .pdf file. Large images are
/// averaged to at most 1200 cells per side. The file appears only when it is complete. Throws as
/// require_plot() does; InvalidInput for columns of different lengths, for a logarithmic axis whose
/// values are all <= 0, and for a figure without data; IoError with gnuplot's message if gnuplot
/// fails. Cost: 0.1 to 1 s, and one gnuplot process.
void write_plot(const std::filesystem::path& file, const Figure& figure,
                const WriteOptions& options = {});

}  // namespace salebra
