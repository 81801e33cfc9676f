// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A figure as data: what is drawn, with its units, and not how. The program, Python and the report
/// draw the same figures, each with its own library; none of them knows what it draws.
///     Figure figure{.kind = "force", .title = "Hertz"};
///     Panel& panel = figure.panels.emplace_back();
///     panel.x = {.quantity = "indentation", .label = "indentation δ", .unit = "m"};
///     panel.y = {.label = "force F", .unit = "N", .logarithmic = true};
///     panel.curves.push_back({.name = "Hertz", .quantity = "force", .x = depths, .y = forces});
///     const std::string json = figure_json(figure);
/// Data are in SI units; a renderer chooses the prefix, "indentation δ (nm)". Text is UTF-8 with
/// markup for subscripts and powers, u_z, W_{max}, 10^{-3}; a backslash makes the next character
/// plain. Texts of the user, such as names of files, go through plain_text() first. figures.hpp
/// makes the figures of results.
namespace salebra::figures {

struct Axis {
  std::string quantity = {};  ///< name in JSON and files, such as "mean_gap"; empty: none
  std::string label = {};     ///< without the unit
  std::string unit = {};      ///< of the data, such as m, N s/m, rad/s; empty: a plain number
  bool logarithmic = false;
  /// Limits in the unit of the data; empty: chosen to fit the data.
  std::optional<double> low = {}, high = {};
  std::optional<double> prefix_of = {};  ///< value whose SI prefix the unit gets; empty: the limits
};

constexpr void describe(auto&& visit, std::type_identity<Axis>) {
  using S = Axis;
  visit(&S::quantity, Kept{"quantity", "name of the quantity in JSON and files"});
  visit(&S::label, Kept{"label", "text without the unit"});
  visit(&S::unit, Kept{"unit", "SI unit of the data"});
  visit(&S::logarithmic, Kept{"logarithmic", "whether the scale is logarithmic"});
  visit(&S::low, Kept{"low", "lower limit"});
  visit(&S::high, Kept{"high", "upper limit"});
  visit(&S::prefix_of, Kept{"prefix_of", "value whose SI prefix the unit gets"});
}

/// A second scale of the same axis, on the opposite side of the panel.
struct SecondAxis {
  std::string quantity = {}, label = {}, unit = {};  ///< as of an Axis
  double factor = 1;  ///< value on this scale divided by the value of the axis at the same place
};

constexpr void describe(auto&& visit, std::type_identity<SecondAxis>) {
  using S = SecondAxis;
  visit(&S::quantity, Kept{"quantity", "name of the quantity in JSON and files"});
  visit(&S::label, Kept{"label", "text without the unit"});
  visit(&S::unit, Kept{"unit", "SI unit"});
  visit(&S::factor, Kept{"factor", "value on this scale over the value of the axis"});
}

enum class Style { line, dashed, dotted, points, line_and_points };

struct Curve {
  std::string name = {};               ///< in the legend; empty: the curve is not listed there
  std::string quantity = {};           ///< name of y in JSON and files; empty: that of the axis
  std::vector<double> x = {}, y = {};  ///< NaN interrupts the line
  /// Limits of a band around the line, such as a confidence interval, or of the error bars of
  /// points. Either both are given or none.
  std::vector<double> low = {}, high = {};
  Style style = Style::line;
  /// Number of the colour: 0 blue, 1 vermilion, 2 green, 3 purple, 4 orange, 5 light blue, 6 black,
  /// 7 grey, 8 wine; −1: the next of the colours 0 to 6, in turn. Each colour has a marker of its
  /// own.
  int color = -1;
};

constexpr void describe(auto&& visit, std::type_identity<Curve>) {
  using S = Curve;
  visit(&S::name, Kept{"name", "name in the legend"});
  visit(&S::quantity, Kept{"quantity", "name of y in JSON and files"});
  visit(&S::x, Kept{"x", "values along the axis x"});
  visit(&S::y, Kept{"y", "values along the axis y"});
  visit(&S::low, Kept{"low", "lower limits of the band or of the error bars"});
  visit(&S::high, Kept{"high", "upper limits of the band or of the error bars"});
  visit(&S::style, Kept{"style", "line, dashed, dotted, points or line_and_points"});
  visit(&S::color, Kept{"color", "number of the colour; -1: the next in turn"});
}

/// Colours of an image. sequential: from dark to bright; diverging: from blue over white to red,
/// for signed values, symmetric about 0 unless the scale has limits; grey: from white to black.
enum class Palette { sequential, diverging, grey };

struct Image {
  std::vector<double> x = {}, y = {};  ///< centres of the cells, increasing; equally spaced or not
  Field values = {};                   ///< (x, y); NaN is left white
  Axis scale = {};                     ///< quantity and limits of the colour scale
  Palette palette = Palette::sequential;
  std::vector<double> contours = {};  ///< values of contour lines, each labelled with its value
  bool color_bar = true;
};

constexpr void describe(auto&& visit, std::type_identity<Image>) {
  using S = Image;
  visit(&S::x, Kept{"x", "centres of the cells along x"});
  visit(&S::y, Kept{"y", "centres of the cells along y"});
  visit(&S::values, Kept{"values", "value of each cell, (x, y)"});
  visit(&S::scale, Kept{"scale", "quantity and limits of the colour scale"});
  visit(&S::palette, Kept{"palette", "sequential, diverging or grey"});
  visit(&S::contours, Kept{"contours", "values of contour lines"});
  visit(&S::color_bar, Kept{"color_bar", "whether the colour scale is drawn"});
}

/// A thin line across the whole panel.
struct ReferenceLine {
  double at = 0;
  bool vertical = false;
  std::string name = {};      ///< written next to the line or in the legend; empty: none
  std::string quantity = {};  ///< name of the value in JSON and files
};

constexpr void describe(auto&& visit, std::type_identity<ReferenceLine>) {
  using S = ReferenceLine;
  visit(&S::at, Kept{"at", "value on the axis"});
  visit(&S::vertical, Kept{"vertical", "whether the value is one of x"});
  visit(&S::name, Kept{"name", "what the line shows"});
  visit(&S::quantity, Kept{"quantity", "name of the value in JSON and files"});
}

/// A range of one axis, shaded across the whole panel, such as the window of a fit.
struct ShadedRange {
  double low = 0, high = 0;
  bool vertical = false;  ///< a range of x
  std::string name = {};  ///< in the legend
};

constexpr void describe(auto&& visit, std::type_identity<ShadedRange>) {
  using S = ShadedRange;
  visit(&S::low, Kept{"low", "lower limit on the axis"});
  visit(&S::high, Kept{"high", "upper limit on the axis"});
  visit(&S::vertical, Kept{"vertical", "whether the range is one of x"});
  visit(&S::name, Kept{"name", "name in the legend"});
}

/// Where a renderer puts the legend inside a panel if it finds no place outside the data.
enum class Legend { top_right, top_left, bottom_right, bottom_left, right_of_panel };

struct Panel {
  std::string title = {};
  std::string caption = {};  ///< its part of the caption; with_limits() puts it there
  Axis x = {}, y = {};
  std::optional<SecondAxis> second_x = {}, second_y = {};
  std::optional<Image> image = {};  ///< drawn under the curves
  std::vector<Curve> curves = {};
  std::vector<ReferenceLine> lines = {};
  std::vector<ShadedRange> ranges = {};
  Legend legend = Legend::top_right;
  bool equal_scales = false;  ///< a metre has the same length along x and y
  bool detail = false;        ///< left out of a picture for one column of a journal
};

constexpr void describe(auto&& visit, std::type_identity<Panel>) {
  using S = Panel;
  visit(&S::title, Kept{"title", "text above the panel"});
  visit(&S::caption, Kept{"caption", "its part of the caption"});
  visit(&S::x, Kept{"x", "horizontal axis"});
  visit(&S::y, Kept{"y", "vertical axis"});
  visit(&S::second_x, Kept{"second_x", "second scale of x, along the top"});
  visit(&S::second_y, Kept{"second_y", "second scale of y, along the right"});
  visit(&S::image, Kept{"image", "map under the curves"});
  visit(&S::curves, Kept{"curves", "curves, points and bands"});
  visit(&S::lines, Kept{"lines", "lines across the whole panel"});
  visit(&S::ranges, Kept{"ranges", "shaded ranges"});
  visit(&S::legend, Kept{"legend", "corner of the legend, or right_of_panel"});
  visit(&S::equal_scales, Kept{"equal_scales", "whether x and y have the same scale"});
  visit(&S::detail, Kept{"detail", "whether a narrow picture leaves it out"});
}

struct Figure {
  std::string kind = {};     ///< name of this kind of figure, such as "study"
  std::string title = {};    ///< above all panels; empty: none
  std::string caption = {};  ///< what is drawn, and for which motion
  std::vector<Panel> panels = {};
  int columns = 0;  ///< number of panels in a row; 0: chosen so that the figure is about square
  bool one_legend = false;  ///< one legend below all panels, in place of one for each
};

constexpr void describe(auto&& visit, std::type_identity<Figure>) {
  using S = Figure;
  visit(&S::kind, Kept{"kind", "name of this kind of figure"});
  visit(&S::title, Kept{"title", "text above all panels"});
  visit(&S::caption, Kept{"caption", "what is drawn, and for which motion"});
  visit(&S::panels, Kept{"panels", "panels, row by row"});
  visit(&S::columns, Kept{"columns", "panels in a row; 0: about a square"});
  visit(&S::one_legend, Kept{"one_legend", "whether all panels share one legend"});
}

/// The figure with limits for all its axes except those of images, with one SI prefix for a quantity
/// that several panels have, and with a letter for each of several panels, "(a) ", in its title and
/// before its part of the caption. An axis of values that are constant to within a percent does not
/// magnify their differences. figure_json() and the pictures have these limits and letters.
Figure with_limits(Figure figure);

/// The figure as a picture of this width shows it, with limits: one column of a journal (below
/// 120 mm) has no room for panels of details. Empty: any room.
Figure for_width(Figure figure, std::optional<double> width);

/// Escapes the characters of a text that are markup, so that the text (such as a file name) is
/// drawn as it is.
std::string plain_text(std::string_view text);

/// The figure as JSON text: an object of the members above, in their order, with enumerations by
/// name; images as a list of columns, values[x][y]; without members that are absent; null for NaN.
/// `salebra COMMAND --plot FILE.json` writes it.
std::string figure_json(const Figure& figure);

}  // namespace salebra::figures

namespace salebra {

template <>
struct EnumNames<figures::Style> {
  static constexpr std::array<std::pair<figures::Style, std::string_view>, 5> values{
      {{figures::Style::line, "line"},
       {figures::Style::dashed, "dashed"},
       {figures::Style::dotted, "dotted"},
       {figures::Style::points, "points"},
       {figures::Style::line_and_points, "line_and_points"}}};
};

template <>
struct EnumNames<figures::Palette> {
  static constexpr std::array<std::pair<figures::Palette, std::string_view>, 3> values{
      {{figures::Palette::sequential, "sequential"},
       {figures::Palette::diverging, "diverging"},
       {figures::Palette::grey, "grey"}}};
};

template <>
struct EnumNames<figures::Legend> {
  static constexpr std::array<std::pair<figures::Legend, std::string_view>, 5> values{
      {{figures::Legend::top_right, "top_right"},
       {figures::Legend::top_left, "top_left"},
       {figures::Legend::bottom_right, "bottom_right"},
       {figures::Legend::bottom_left, "bottom_left"},
       {figures::Legend::right_of_panel, "right_of_panel"}}};
};

}  // namespace salebra
