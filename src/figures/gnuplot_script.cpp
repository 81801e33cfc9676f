// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot script of a figure: panels, curves, bands, images and legends.
#include "gnuplot_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <span>

#include "display_axis.hpp"
#include "plot_raster.hpp"

namespace salebra::figures {
namespace {

// Colours of Okabe and Ito, which colour-blind readers can distinguish, and also grey and wine.
constexpr std::array colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00",
                               "#56B4E9", "#000000", "#808080", "#882255"};
// Number of colours that curves get by default; grey and wine are used only on request.
constexpr int cycle = 7;
constexpr std::array markers = {7, 5, 9, 13, 11, 15, 3, 1, 2};
constexpr int panel_width = 520, panel_height = 390, title_height = 26;

std::string literal(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + "'";
}

const char* palette_stops(Palette palette) {
  switch (palette) {
    case Palette::diverging:
      return "0 '#053061',1 '#2166ac',2 '#4393c3',3 '#92c5de',4 '#d1e5f0',5 '#f7f7f7',"
             "6 '#fddbc7',7 '#f4a582',8 '#d6604d',9 '#b2182b',10 '#67001f'";
    case Palette::grey:
      return "0 '#ffffff',1 '#000000'";
    case Palette::sequential:
      break;
  }
  return "0 '#440154',1 '#472d7b',2 '#3b528b',3 '#2c728e',4 '#21918c',5 '#28ae80',"
         "6 '#5ec962',7 '#addc30',8 '#fde725'";
}

const char* legend_place(Legend legend) {
  switch (legend) {
    case Legend::top_left:
      return "top left Left reverse";
    case Legend::bottom_right:
      return "bottom right";
    case Legend::bottom_left:
      return "bottom left Left reverse";
    case Legend::right_of_panel:
      return "outside right top Left reverse";
    case Legend::top_right:
      break;
  }
  return "top right";
}

/// A rectangle in a panel, in pixels from the lower left corner of the panel's frame.
struct Box {
  double left, right, bottom, top;

  bool holds(double x, double y) const { return x > left && x < right && y > bottom && y < top; }
  bool meets(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
};

/// Upper estimate of the width of a text in pixels; the true width depends on the font. Markup has
/// no width.
double text_width(std::string_view text) {
  constexpr double character = 7.4;
  return character * double(std::ranges::count_if(text, [](char c) {
           const bool continues = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
           return !continues && std::string_view("_^{}\\").find(c) == std::string_view::npos;
         }));
}

void check(const Curve& curve) {
  const std::string field =
      "curve " + (curve.name.empty() ? std::string("without name") : curve.name);
  require(curve.x.size() == curve.y.size(), field,
          fmt::format("{} and {} values", curve.x.size(), curve.y.size()),
          "along x and y; give as many of each");
  const bool band = !curve.low.empty() || !curve.high.empty();
  require(!band || (curve.low.size() == curve.x.size() && curve.high.size() == curve.x.size()),
          field, fmt::format("{} and {} values", curve.low.size(), curve.high.size()),
          "of the band; give one for each x");
  require(curve.color >= -1 && curve.color < static_cast<int>(colors.size()), field, curve.color,
          "is not a colour; use -1 to 8");
}

class PanelScript {
 public:
  PanelScript(const Panel& panel, int number, std::string& out)
      : panel_(panel), number_(number), out_(out) {
    for (const Curve& curve : panel.curves) check(curve);
    if (panel.image) check_raster(*panel.image);
    std::vector<std::span<const double>> x, y;
    for (const Curve& curve : panel.curves) {
      x.emplace_back(curve.x);
      y.emplace_back(curve.y);
      y.emplace_back(curve.high);
      // The limits of error bars do not count on a logarithmic axis: a bar that ends near zero
      // would extend the axis by decades.
      if (!(panel.y.logarithmic && curve.style == Style::points)) y.emplace_back(curve.low);
    }
    if (panel.image) {
      x.emplace_back(panel.image->x);
      y.emplace_back(panel.image->y);
    }
    x_ = display_axis(panel.x, x);
    y_ = display_axis(panel.y, y);
    if (!panel.image) {
      const bool points = std::ranges::any_of(panel.curves, [](const Curve& curve) {
        return curve.style == Style::points || curve.style == Style::line_and_points;
      });
      set_limits(x_, x, points ? 0.03 : 0);
      set_limits(y_, y, 0.04);
    }
    if (!panel.second_x) return;
    std::vector<double> top;
    for (const auto& column : x)
      for (const double value : column) top.push_back(value * panel.second_x->factor);
    top_ = display_axis({.label = panel.second_x->label,
                         .unit = panel.second_x->unit,
                         .logarithmic = panel.x.logarithmic},
                        {top});
  }

  void write() {
    find_obstacles();
    place_names();
    write_frame();
    if (panel_.image) write_image();
    write_curves();
    fmt::format_to(std::back_inserter(out_), "plot {}\n", fmt::join(plots_, ", \\\n     "));
  }

 private:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
    out_ += '\n';
  }

  /// Sets the limits of a linear axis. They must be known to find where the curves lie in the
  /// frame.
  static void set_limits(DisplayAxis& axis, const std::vector<std::span<const double>>& data,
                         double margin) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const auto& column : data)
      for (const double value : column)
        if (const double shown = axis.display(value); std::isfinite(shown)) {
          least = std::min(least, shown);
          most = std::max(most, shown);
        }
    // If all values are equal up to round-off, gnuplot chooses the range.
    if (!(most - least > 1e-8 * std::max(std::abs(least), std::abs(most)))) return;
    const double padding = margin * (most - least);
    // If no value is negative the axis does not extend below zero; if none is positive, not above
    // zero.
    if (!axis.low) axis.low = least >= 0 ? std::max(0.0, least - padding) : least - padding;
    if (!axis.high) axis.high = most <= 0 ? std::min(0.0, most + padding) : most + padding;
  }

  static double part(const DisplayAxis& axis, double value) {
    return (axis.display(value) - *axis.low) / (*axis.high - *axis.low);
  }

  /// Whether the line lies within the limits of its axis; gnuplot would also draw it outside the
  /// frame.
  bool seen(const ReferenceLine& mark) const {
    const DisplayAxis& axis = mark.vertical ? x_ : y_;
    const double at = axis.display(mark.at);
    return !(at < axis.low.value_or(-HUGE_VAL)) && !(at > axis.high.value_or(HUGE_VAL));
  }

  void find_obstacles() {
    if (!x_.low || !x_.high || !y_.low || !y_.high) return;
    height_ = frame_height - (panel_.title.empty() ? 0 : 20) - (top_.label.empty() ? 0 : 40);
    const auto segment = [&](double x0, double y0, double x1, double y1) {
      const double steps = std::ceil(std::hypot(x1 - x0, y1 - y0) / 3);
      if (!std::isfinite(steps)) return;
      for (double i = 0; i <= steps; ++i) {
        const double along = steps > 0 ? i / steps : 0;
        obstacles_.push_back({x0 + along * (x1 - x0), y0 + along * (y1 - y0)});
      }
    };
    const auto across = [&](double value) { return frame_width * part(x_, value); };
    const auto up = [&](double value) { return height_ * part(y_, value); };
    for (const Curve& curve : panel_.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const double x = across(curve.x[i]), y = up(curve.y[i]);
        segment(x, y, x, y);
        if (!curve.low.empty()) segment(x, std::fmax(0, up(curve.low[i])), x, up(curve.high[i]));
        if (i == 0 || curve.style == Style::points) continue;
        segment(across(curve.x[i - 1]), up(curve.y[i - 1]), x, y);
        for (const auto* limit : {&curve.low, &curve.high})
          if (!limit->empty())
            segment(across(curve.x[i - 1]), up((*limit)[i - 1]), x, up((*limit)[i]));
      }
    for (const ReferenceLine& mark : panel_.lines)
      if (mark.vertical)
        segment(across(mark.at), 0, across(mark.at), height_);
      else
        segment(0, up(mark.at), frame_width, up(mark.at));
  }

  bool free(const Box& box) const {
    return std::ranges::none_of(obstacles_,
                                [&](const auto& at) { return box.holds(at[0], at[1]); }) &&
           std::ranges::none_of(taken_, [&](const Box& other) { return box.meets(other); });
  }

  /// Finds a position for the name of each marked line, along the line, from right to left, above
  /// or below it, where it covers no curve. A name without such a position goes to the legend. The
  /// legend gets the first free corner, or is placed below the panel if no corner is free.
  void place_names() {
    for (const ReferenceLine& mark : panel_.lines) {
      if (mark.vertical || mark.name.empty() || !seen(mark)) continue;
      if (height_ == 0) {
        names_.push_back({&mark, 0.98, 0.5});
        continue;
      }
      const double width = text_width(mark.name), line = height_ * part(y_, mark.at);
      bool placed = false;
      for (double right = 0.98; !placed && right * frame_width > width; right -= 0.05)
        for (const double offset : {0.5, -0.5}) {
          const double bottom = line - (offset > 0 ? 0 : 18), edge = right * frame_width;
          const Box box{edge - width, edge, bottom, bottom + 18};
          if (box.bottom < 0 || box.top > height_ || !free(box)) continue;
          taken_.push_back(box);
          names_.push_back({&mark, right, offset});
          placed = true;
          break;
        }
      if (!placed) unplaced_.push_back(&mark);
    }
    double rows = double(unplaced_.size()), width = 0;
    for (const ReferenceLine* mark : unplaced_)
      width = std::max(width, text_width(entry_of(*mark)));
    for (const Curve& curve : panel_.curves)
      if (!curve.name.empty()) {
        ++rows;
        width = std::max(width, text_width(curve.name));
      }
    legend_ = legend_place(panel_.legend);
    if (rows == 0 || height_ == 0 || panel_.legend == Legend::right_of_panel) return;
    const double wide = width + 55, high = 18 * rows + 8;
    using enum Legend;
    for (const Legend corner : {panel_.legend, top_right, top_left, bottom_right, bottom_left}) {
      const bool right = corner == top_right || corner == bottom_right,
                 top = corner == top_right || corner == top_left;
      if (!free({right ? frame_width - wide : 0, right ? frame_width : wide,
                 top ? height_ - high : 0, top ? height_ : high}))
        continue;
      legend_ = legend_place(corner);
      return;
    }
    legend_ = "below Left reverse";
  }

  static std::string entry_of(const ReferenceLine& mark) {
    return fmt::format("{}: {:.3g}", mark.name, mark.at);
  }

  void write_frame() {
    line("reset");
    line("set encoding utf8");
    line("set border lw 0.8\nset tics in scale 0.7,0.35\nset mxtics\nset mytics");
    line("set title {} offset 0,-0.4", literal(panel_.title));
    line("set key {} samplen 2.4 spacing 1.15 width 0.5", legend_);
    if (panel_.image) line("set key opaque box lw 0.5");
    if (unplaced_.empty() && std::ranges::all_of(panel_.curves, &std::string::empty, &Curve::name))
      line("unset key");
    if (panel_.equal_scales) line("set size ratio -1");
    write_axis("x", x_);
    write_axis("y", y_);
    if (!top_.label.empty()) {
      line("set xtics nomirror");
      write_axis("x2", top_);
    }
    for (const ReferenceLine& mark : panel_.lines) {
      if (!seen(mark)) continue;
      const double at = mark.vertical ? x_.display(mark.at) : y_.display(mark.at);
      if (mark.vertical) {
        line(
            "set arrow from first {0:.9g},graph 0 to first {0:.9g},graph 1 nohead dt 3 lw 1 lc "
            "'#404040' front",
            at);
        if (!mark.name.empty())
          line(
              "set label {} at first {:.9g},graph 0.03 rotate by 90 offset 0.8,0 tc '#404040' "
              "front",
              literal(mark.name), at);
      } else {
        line(
            "set arrow from graph 0,first {0:.9g} to graph 1,first {0:.9g} nohead dt 3 lw 1 lc "
            "'#404040' front",
            at);
      }
    }
    for (const auto& [mark, right, offset] : names_)
      line("set label {} at graph {:.2f},first {:.9g} right offset 0,{} tc '#404040' front",
           literal(mark->name), right, y_.display(mark->at), offset);
    for (const ReferenceLine* mark : unplaced_)
      plots_.push_back(
          fmt::format("NaN with lines dt 3 lw 1 lc '#404040' title {}", literal(entry_of(*mark))));
  }

  void write_axis(const char* name, const DisplayAxis& axis) {
    line("set {}label {}{}", name, literal(axis.label), &axis == &top_ ? " offset 0,-0.5" : "");
    const bool tight = name[0] == 'x' || panel_.image;
    const auto bound = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.9g}", *value) : std::string("*");
    };
    line("set {}range [{}:{}]", name, bound(axis.low), bound(axis.high));
    if (tight) line("set autoscale {}fix", name);
    if (!axis.tics.empty()) line("set {}tics {}", name, axis.tics);
  }

  void write_image() {
    const Image& image = *panel_.image;
    const Raster raster = rasterise(image, x_, y_);
    const DisplayAxis& scale = raster.scale;
    line("$image{} << EOD", number_);
    for (Index j = 0; j < raster.values.cols(); ++j) {
      for (Index i = 0; i < raster.values.rows(); ++i)
        fmt::format_to(std::back_inserter(out_), "{:.5g} ", raster.values(i, j));
      out_ += '\n';
    }
    line("EOD");
    line("set palette defined ({})", palette_stops(image.palette));
    line("set cbrange [{:.9g}:{:.9g}]", *scale.low, *scale.high);
    line("set cblabel {} offset 0.8,0", literal(scale.label));
    if (!scale.tics.empty()) line("set cbtics {}", scale.tics);
    if (!image.color_bar) line("unset colorbox");
    const std::string columns = fmt::format("({:.12g}+{:.12g}*$1):({:.12g}+{:.12g}*$2):3",
                                            raster.x0, raster.dx, raster.y0, raster.dy);
    for (const auto& [axis, first, step, count] :
         {std::tuple{'x', raster.x0, raster.dx, raster.values.rows()},
          std::tuple{'y', raster.y0, raster.dy, raster.values.cols()}}) {
      const DisplayAxis& display = axis == 'x' ? x_ : y_;
      const auto& given = axis == 'x' ? panel_.x : panel_.y;
      line("set {}range [{:.9g}:{:.9g}]", axis, given.low ? *display.low : first - 0.5 * step,
           given.high ? *display.high : first + (static_cast<double>(count) - 0.5) * step);
    }
    plots_.push_back(fmt::format("$image{} matrix using {} with image notitle", number_, columns));

    const auto [least, most] = finite_range(raster.values);
    for (std::size_t k = 0; k < image.contours.size(); ++k) {
      const double level = scale.display(image.contours[k]);
      if (!(level > least && level < most)) continue;
      const std::string block = fmt::format("$contour{}_{}", number_, k);
      line("set contour base\nunset surface\nset cntrparam levels discrete {:.9g}", level);
      line("set table {}\nsplot $image{} matrix using {} with lines notitle\nunset table", block,
           number_, columns);
      line("unset contour\nset surface\nstats {} using 1:2 nooutput\nmiddle = int(STATS_records/2)",
           block);
      plots_.push_back(fmt::format("{} using 1:2 with lines lw 1.2 lc '#202020' notitle", block));
      labels_.push_back(
          fmt::format("{} using ($0==middle_{}_{}?$1:NaN):2:({}) with labels boxed notitle", block,
                      number_, k, literal(fmt::format("{:g}", image.contours[k]))));
      line("middle_{}_{} = middle", number_, k);
    }
    if (!labels_.empty()) line("set style textbox opaque noborder margins 0.6,0.6");
  }

  void write_curves() {
    int next = 0;
    std::vector<std::string> bands, drawn;
    for (std::size_t k = 0; k < panel_.curves.size(); ++k) {
      const Curve& curve = panel_.curves[k];
      const int which = curve.color >= 0 ? curve.color : next++ % cycle;
      const char* color = colors[static_cast<std::size_t>(which)];
      const bool band = !curve.low.empty(), bars = band && curve.style == Style::points;
      line("$curve{}_{} << EOD", number_, k);
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        fmt::format_to(std::back_inserter(out_), "{:.9g} {:.9g}", x_.display(curve.x[i]),
                       y_.display(curve.y[i]));
        if (band) {
          double low = y_.display(curve.low[i]);
          // On a logarithmic axis an error bar that ends at zero or below is drawn down to the
          // frame.
          if (bars && std::isnan(low)) low = y_.low.value_or(low);
          fmt::format_to(std::back_inserter(out_), " {:.9g} {:.9g}", low,
                         y_.display(curve.high[i]));
        }
        out_ += '\n';
      }
      line("EOD");
      if (band && !bars)
        bands.push_back(
            fmt::format("$curve{}_{} using 1:3:4 with filledcurves lc '{}' fs transparent solid "
                        "0.2 noborder notitle",
                        number_, k, color));
      drawn.push_back(fmt::format("$curve{}_{} using {} lc '{}' {}", number_, k,
                                  bars ? fmt::format("1:2:3:4 with yerrorbars {}", marker_of(which))
                                       : "1:2 with " + style_of(curve.style, which),
                                  color,
                                  curve.name.empty() ? "notitle" : "title " + literal(curve.name)));
    }
    for (const auto* group : {&bands, &drawn, &labels_})
      plots_.insert(plots_.end(), group->begin(), group->end());
    require(!plots_.empty(), "panel", "'" + panel_.title + "'",
            "is empty; give a curve or an image");
  }

  static std::string marker_of(int which) {
    return fmt::format("pt {} ps 0.6", markers[static_cast<std::size_t>(which)]);
  }

  static std::string style_of(Style style, int which) {
    switch (style) {
      case Style::dashed:
        return "lines lw 1.8 dt (10,5)";
      case Style::dotted:
        return "lines lw 1.8 dt (2,4)";
      case Style::points:
        return "points " + marker_of(which);
      case Style::line_and_points:
        return "linespoints lw 1.4 " + marker_of(which);
      case Style::line:
        break;
    }
    return "lines lw 1.8";
  }

  const Panel& panel_;
  int number_;
  std::string& out_;
  struct PlacedName {
    const ReferenceLine* mark;
    /// right: right end of the name, as a fraction of the frame's width; offset: its distance from
    /// the line, in text lines.
    double right, offset;
  };

  // Size in pixels, a little less than that of gnuplot's frame in a panel without title.
  static constexpr double frame_width = 410, frame_height = 300;
  DisplayAxis x_, y_, top_;
  /// Height of the frame in pixels; 0: the limits are unknown, so texts cannot avoid curves.
  double height_ = 0;
  std::vector<std::array<double, 2>> obstacles_;
  std::vector<Box> taken_;
  std::vector<PlacedName> names_;
  std::vector<const ReferenceLine*> unplaced_;
  std::string legend_;
  std::vector<std::string> plots_, labels_;
};

}  // namespace

std::string gnuplot_script(const Figure& figure, PictureFormat format) {
  require(!figure.panels.empty(), "figure", figure.panels.size(),
          "panels given; give at least one");
  const int panels = static_cast<int>(figure.panels.size());
  const int columns =
      std::min(panels, figure.columns > 0
                           ? figure.columns
                           : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(panels)))));
  const int rows = (panels + columns - 1) / columns;
  const int width = columns * panel_width;
  const int height = rows * panel_height + (figure.title.empty() ? 0 : title_height);
  std::string out;
  if (format == PictureFormat::png) {
    out += fmt::format(
        "set terminal pngcairo enhanced size {},{} font 'Sans,10' fontscale 2 linewidth 2 "
        "pointscale 2 "
        "dashlength 1.6 background '#ffffff'\n",
        2 * width, 2 * height);
  } else if (format == PictureFormat::pdf) {
    constexpr double points_per_inch = 100;
    out += fmt::format(
        "set terminal pdfcairo enhanced size {:.2f}in,{:.2f}in font 'Sans,9' linewidth 1 "
        "pointscale 0.7 "
        "dashlength 0.8 background '#ffffff'\n",
        width / points_per_inch, height / points_per_inch);
  } else {
    out += fmt::format(
        "set terminal svg enhanced size {},{} dynamic standalone font 'sans-serif,12' linewidth 1 "
        "dashlength 0.8 background '#ffffff'\n",
        width, height);
  }
  out += "set encoding utf8\n";
  out += fmt::format("set multiplot layout {},{}", rows, columns);
  if (!figure.title.empty()) out += " title " + literal(figure.title);
  out += '\n';
  int number = 0;
  for (const Panel& panel : figure.panels) PanelScript(panel, ++number, out).write();
  out += "unset multiplot\n";
  return out;
}

}  // namespace salebra::figures
