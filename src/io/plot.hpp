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
/// them, nothing of it shows here.
///
///     Figure figure;
///     PlotPanel& panel = figure.panels.emplace_back();
///     panel.x = {.label = "indentation δ", .unit = "m"};
///     panel.y = {.label = "force F", .unit = "N", .logarithmic = true};
///     panel.curves.push_back({.name = "boundary elements", .x = indentation, .y = force});
///     panel.curves.push_back({.name = "Hertz", .x = indentation, .y = hertz, .style =
///     PlotStyle::dashed}); write_plot("force.png", figure);
///
/// Data are in SI units; an axis with a unit gets the SI prefix that suits its values, "indentation
/// δ (nm)". Text is UTF-8 with the markup of subscripts and powers, u_z, W_{max}, 10^{-3}; what a
/// user named goes through plot_text() first.
namespace salebra {

struct PlotAxis {
  std::string label = {};  ///< without the unit
  std::string unit = {};   ///< of the data, such as m, N s/m, rad/s; empty: a plain number
  bool logarithmic = false;
  std::optional<double> low = {}, high = {};  ///< in the data's unit; not given: as the data need
};

enum class PlotStyle { line, dashed, dotted, points, line_and_points };

struct PlotCurve {
  std::string name = {};               ///< in the legend; empty: not there
  std::vector<double> x = {}, y = {};  ///< NaN interrupts the line
  std::vector<double>
      low = {},
      high = {};  ///< a band around it, such as a confidence interval; both or none. Points have
                  ///< error bars in its place
  PlotStyle style = PlotStyle::line;
  /// 0 blue, 1 vermilion, 2 green, 3 purple, 4 orange, 5 light blue, 6 black, 7 grey, 8 wine; −1: the
  /// next one.
  int color = -1;
};

/// sequential: dark to bright; diverging: blue over white to red, for signed values, symmetric
/// about 0 unless the scale has limits; grey: white to black.
enum class PlotPalette { sequential, diverging, grey };

struct PlotImage {
  std::vector<double> x = {}, y = {};  ///< middles of the cells, increasing; equally spaced or not
  Field values = {};                   ///< (x, y); NaN is left white
  PlotAxis scale = {};                 ///< of the colours
  PlotPalette palette = PlotPalette::sequential;
  std::vector<double> contours = {};  ///< values to draw a line at, with their number
  bool color_bar = true;
};

/// A thin line across the whole panel.
struct PlotLine {
  double at = 0;
  bool vertical = false;
  std::string name = {};  ///< written beside it
};

enum class PlotLegend { top_right, top_left, bottom_right, bottom_left, right_of_panel };

struct PlotPanel {
  std::string title = {};
  PlotAxis x = {}, y = {};
  PlotAxis top = {};  ///< a second scale of a logarithmic x along the top; no label: there is none
  double top_factor = 1;                ///< its values are those of x times this
  std::optional<PlotImage> image = {};  ///< under the curves
  std::vector<PlotCurve> curves = {};
  std::vector<PlotLine> lines = {};
  PlotLegend legend = PlotLegend::top_right;
  bool equal_scales = false;  ///< a metre is as long along x as along y
};

struct Figure {
  std::string title = {};
  std::deque<PlotPanel> panels = {};  ///< a reference to one stays good while others are added

  int columns = 0;  ///< of panels; 0: as many as make the figure about square
};

/// A text without markup, for file names and the like.
std::string plot_text(std::string_view plain);

/// Throws what write_plot would throw at its start, for callers that compute for long before they
/// draw: InvalidInput for a suffix other than .png, .svg and .pdf and as require_output; IoError
/// where gnuplot is not installed.
void require_plot(const std::filesystem::path& file, const WriteOptions& options = {});

/// Draws a figure to a .png (at twice the size on the screen), .svg or .pdf. Large images are
/// averaged down to at most 1200 cells a side. The file appears complete or not at all. Throws as
/// require_plot; InvalidInput for columns of different lengths, values <= 0 only on a logarithmic
/// axis, or a figure without data; IoError where gnuplot fails, with what it said. Cost: 0.1 to 1
/// s, one gnuplot process.
void write_plot(const std::filesystem::path& file, const Figure& figure,
                const WriteOptions& options = {});

}  // namespace salebra
