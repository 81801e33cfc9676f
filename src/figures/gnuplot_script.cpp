// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot script of a figure: panels, curves, bands, images and legends.
#include "gnuplot_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <salebra/base/error.hpp>
#include <span>
#include <utility>

#include "display_axis.hpp"
#include "plot_raster.hpp"

namespace salebra::figures {
namespace {

// Colours of Okabe and Ito, which colour-blind readers can distinguish, and also grey and wine.
constexpr std::array colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00",
                               "#56B4E9", "#000000", "#808080", "#882255"};
// Number of colours that curves get by default; grey and wine are used only on request.
constexpr int cycle = 7;
constexpr std::array markers = {7, 5, 9, 13, 11, 15, 2, 1, 3};
/// Dash patterns of lines across a panel, so that the legend can tell them apart.
constexpr std::array line_dashes = {"(2,4)", "(10,5)", "(10,4,2,4)", "(2,10)", "(16,4)"};

/// Width of a panel, height of its frame and size of its text, in pixels of 1/96 inch.
struct Layout {
  double width = 520, frame_height = 303.6, font = 12;

  double character() const { return 0.617 * font; }  ///< upper limit of the mean width
  double mean_character() const { return 0.6 * font; }
  double line() const { return 1.5 * font; }
  /// About that of most panels.
  double frame_width() const { return width - 9.2 * font; }
  /// Room below a frame for the numbers and the label of x.
  double bottom() const { return 4.8 * font; }
  /// Numbers that have room along an axis. square: whether the frame is as wide as it is high.
  int labels(bool across, bool square = false) const {
    const double wide = square ? std::min(frame_width(), frame_height) : frame_width();
    return across ? static_cast<int>(std::clamp(wide / (5.5 * character()), 3.0, 10.0))
                  : static_cast<int>(std::clamp(frame_height / (1.4 * line()), 3.0, 10.0));
  }
};

std::string literal(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + "'";
}

/// Upper estimate of the number of characters of a text; markup has no width.
double characters(std::string_view text) {
  return double(std::ranges::count_if(text, [](char c) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    return !continues && std::string_view("_^{}\\").find(c) == std::string_view::npos;
  }));
}

/// The text in lines of at most so many characters where a space allows it.
std::vector<std::string> wrapped(std::string_view text, double most) {
  std::vector<std::string> lines{""};
  std::string word;
  int braces = 0;
  const auto end_word = [&] {
    const bool room = characters(lines.back()) + 1 + characters(word) <= most;
    if (!room && !lines.back().empty()) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + std::exchange(word, "");
  };
  // A number stays with its unit, a symbol with its value, and a formula in one line.
  const auto joined = [&](std::string_view next) {
    const std::string_view last = std::string_view(word).substr(word.rfind(' ') + 1);
    constexpr auto links = std::to_array<std::string_view>({"/", "−", "+", "±", "…", "ln"});
    const bool symbol =
        (last.size() == 1 && std::isalpha(static_cast<unsigned char>(last[0])) && last != "a") ||
        std::ranges::find(links, last) != links.end();
    return (!word.empty() &&
            (std::isdigit(static_cast<unsigned char>(word.back())) || word.back() == '=')) ||
           symbol || next.starts_with("= ") || next.starts_with("s/m") || next.starts_with("ln") ||
           next.starts_with("/ ") || next.starts_with("− ") || next.starts_with("± ") ||
           next.starts_with("… ");
  };
  for (std::size_t k = 0; k < text.size(); ++k) {
    braces += (text[k] == '{') - (text[k] == '}');
    if (text[k] == ' ' && braces <= 0 && !joined(text.substr(k + 1)))
      end_word();
    else
      word += text[k];
  }
  end_word();
  return lines;
}

/// The lines as one text of gnuplot.
std::string literal(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& one : lines) out += (out.empty() ? "" : ".\"\\n\".") + literal(one);
  return out;
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

/// In pixels, with the samples of the lines.
double width_of_entries(const std::vector<std::string>& names, const Layout& layout) {
  double longest = 0;
  for (const std::string& name : names) longest = std::max(longest, characters(name));
  return layout.character() * longest + 4.6 * layout.font;
}

class PanelScript {
 public:
  /// own_legend: whether the legend is in or below the panel. line_names: of the lines across all
  /// panels, which give them their patterns.
  PanelScript(const Panel& panel, int number, const Layout& layout, bool own_legend,
              const std::vector<std::string>& line_names, std::string& out)
      : panel_(panel),
        number_(number),
        layout_(layout),
        own_legend_(own_legend),
        line_names_(line_names),
        out_(out) {
    for (const Curve& curve : panel.curves) check(curve);
    if (panel.image) check_raster(*panel.image);
    std::vector<std::span<const double>> x, y;
    for (const Curve& curve : panel.curves) {
      x.emplace_back(curve.x);
      y.emplace_back(curve.y);
    }
    if (panel.image) {
      x.emplace_back(panel.image->x);
      y.emplace_back(panel.image->y);
    }
    const int across = layout.labels(true, panel.equal_scales);
    x_ = display_axis(panel.x, x, across);
    y_ = display_axis(panel.y, y, layout.labels(false));
    if (panel.image) {
      raster_ = rasterise(*panel.image, x_, y_);
      end_at_cells(x_, panel.x, raster_->x0, raster_->dx, raster_->values.rows());
      end_at_cells(y_, panel.y, raster_->y0, raster_->dy, raster_->values.cols());
    }
    set_linear_tics(x_, across);
    set_linear_tics(y_, layout.labels(false));
    top_ = second_axis(panel.second_x, panel.x, x_, across);
    right_ = second_axis(panel.second_y, panel.y, y_, layout.labels(false));
    const double high = layout.frame_height / layout.mean_character();
    y_label_ = wrapped(y_.label, high);
    if (right_) right_label_ = wrapped(right_->label, high);
    if (raster_) scale_label_ = wrapped(raster_->scale.label, high);
  }

  /// Whether the panel of this script, right below, has the same axis x.
  bool shares_x(const PanelScript& below) const {
    return !panel_.image && !below.panel_.image && !below.top_ && x_.label == below.x_.label &&
           x_.low == below.x_.low && x_.high == below.x_.high;
  }
  /// Leaves the numbers and the label of x to the panel below.
  void hide_x() {
    x_.label.clear();
    if (!x_.logarithmic) x_.tics += " format ''";
    // Labels of a logarithmic axis stand between quotes, before their places.
    bool inside = false;
    if (x_.logarithmic)
      std::erase_if(x_.tics, [&](char c) {
        if (c == '\'') inside = !inside;
        return inside && c != '\'';
      });
    x_hidden_ = true;
  }
  bool x_hidden() const { return x_hidden_; }

  /// The entries of the legend.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const ReferenceLine* mark : unplaced_) names.push_back(mark->name);
    for (const Curve& curve : panel_.curves) names.push_back(curve.name);
    for (const ShadedRange& range : panel_.ranges) names.push_back(range.name);
    std::erase(names, "");
    return names;
  }
  /// What draws them, each with its text; known after write().
  const std::vector<std::pair<std::string, std::string>>& entries() const { return entries_; }

  /// Chooses the places of names and legend in a frame with this room at its sides, in pixels.
  void arrange(double left, double right) {
    width_ = layout_.width - left - right;
    // The frame of a map is as wide as its scale asks, in the middle of the room that it has.
    if (panel_.equal_scales && x_.low && x_.high && y_.low && y_.high)
      aside_ = std::max(
          0.0, (width_ - layout_.frame_height * (*x_.high - *x_.low) / (*y_.high - *y_.low)) / 2);
    // The title is in the middle of the frame, which is not that of the panel.
    const double middle = left + width_ / 2;
    title_ = wrapped(panel_.title,
                     2 * std::min(middle, layout_.width - middle) / layout_.mean_character());
    find_obstacles();
    place_names();
  }

  /// Lines of text that the legend needs below the panel; 0: it is inside.
  int legend_rows() const {
    if (legend_ != below) return 0;
    const double wide = legend_width(), entries = double(names().size());
    return static_cast<int>(std::ceil(entries / std::max(1.0, std::floor(width_ / wide - 0.1))));
  }

  /// Moves the names of lines that the legend of all panels has to that legend.
  void leave_to_legend(const std::vector<std::string>& names) {
    for (const PlacedName& placed : names_)
      if (std::ranges::find(names, placed.mark->name) != names.end())
        unplaced_.push_back(placed.mark);
    std::erase_if(names_, [&](const PlacedName& placed) {
      return std::ranges::find(names, placed.mark->name) != names.end();
    });
  }

  /// Room on the left of the frame for the label, the numbers and the tics of y, in pixels.
  double left() const { return beside(y_, y_label_); }

  /// Room on the right for a second scale of y or the colour scale, and for the last number of x.
  double right() const {
    // A colour scale is a twentieth of the frame wide.
    if (raster_ && panel_.image->color_bar)
      return beside(raster_->scale, scale_label_) + 0.7 * layout_.font +
             0.05 * layout_.frame_width();
    if (right_) return beside(*right_, right_label_);
    // A label of x may be longer than the frame.
    const double longer = layout_.character() * characters(x_.label) - layout_.frame_width();
    return 1.7 * layout_.font + std::max(0.0, longer / 2);
  }

  /// Distance of the frame of a map from the sides of its room, in pixels.
  double aside() const { return aside_; }

  /// Room above the frame for the title and the second scale of x, in pixels.
  double top() const {
    const double title = panel_.title.empty() ? 0.8 : 1 + 1.4 * double(title_.size());
    return (title + (top_ ? 3.7 : 0)) * layout_.font;
  }

  /// place: commands that set the place of the panel.
  void write(const std::string& place) {
    write_frame();
    out_ += place;
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

  /// An image is drawn to the edges of its cells.
  static void end_at_cells(DisplayAxis& axis, const Axis& given, double first, double step,
                           Index count) {
    if (!given.low) axis.low = first - 0.5 * step;
    if (!given.high) axis.high = first + (static_cast<double>(count) - 0.5) * step;
  }

  /// The second scale of an axis: the same limits, times the factor.
  static std::optional<DisplayAxis> second_axis(const std::optional<SecondAxis>& second,
                                                const Axis& axis, const DisplayAxis& main,
                                                int labels) {
    if (!second || !main.low || !main.high) return {};
    const auto value = [&](double shown) {
      return (axis.logarithmic ? std::pow(10.0, shown) : shown) / main.factor * second->factor;
    };
    const std::vector<double> ends{value(*main.low), value(*main.high)};
    DisplayAxis out = display_axis({.label = second->label,
                                    .unit = second->unit,
                                    .logarithmic = axis.logarithmic,
                                    .low = ends[0],
                                    .high = ends[1]},
                                   {ends}, labels);
    set_linear_tics(out, labels);
    return out;
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
    height_ = layout_.frame_height;
    const auto segment = [&](double x0, double y0, double x1, double y1) {
      const double steps = std::ceil(std::hypot(x1 - x0, y1 - y0) / 3);
      if (!std::isfinite(steps)) return;
      for (double i = 0; i <= steps; ++i) {
        const double along = steps > 0 ? i / steps : 0;
        obstacles_.push_back({x0 + along * (x1 - x0), y0 + along * (y1 - y0)});
      }
    };
    const auto across = [&](double value) { return width_ * part(x_, value); };
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
        segment(0, up(mark.at), width_, up(mark.at));
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
      if (mark.name.empty() || !seen(mark)) continue;
      if (mark.vertical || height_ == 0 || panel_.image) {
        unplaced_.push_back(&mark);
        continue;
      }
      const double width = layout_.character() * characters(mark.name),
                   line = height_ * part(y_, mark.at);
      bool placed = false;
      for (double right = 0.98; !placed && right * width_ > width; right -= 0.05)
        for (const double offset : {0.5, -0.5}) {
          const double bottom = line - (offset > 0 ? 0 : layout_.line()), edge = right * width_;
          const Box box{edge - width, edge, bottom, bottom + layout_.line()};
          if (box.bottom < 0 || box.top > height_ || !free(box)) continue;
          taken_.push_back(box);
          names_.push_back({&mark, right, offset});
          placed = true;
          break;
        }
      if (!placed) unplaced_.push_back(&mark);
    }
    legend_ = legend_place(panel_.legend);
    const double rows = double(names().size());
    if (rows == 0 || !own_legend_ || panel_.legend == Legend::right_of_panel) return;
    const double wide = legend_width(), high = layout_.line() * rows + 0.7 * layout_.font;
    // Nothing is drawn in a corner of an image that is not on it.
    if (panel_.image || height_ == 0) {
      legend_ = below;
      return;
    }
    using enum Legend;
    for (const Legend corner : {panel_.legend, top_right, top_left, bottom_right, bottom_left}) {
      const bool right = corner == top_right || corner == bottom_right,
                 top = corner == top_right || corner == top_left;
      if (!free({right ? width_ - wide : 0, right ? width_ : wide, top ? height_ - high : 0,
                 top ? height_ : high}))
        continue;
      legend_ = legend_place(corner);
      return;
    }
    legend_ = below;
  }

  /// In pixels, of one column with the samples of the lines.
  double legend_width() const { return width_of_entries(names(), layout_); }

  /// The pattern of the line; lines with the same name have the same.
  const char* dash_of(const ReferenceLine& mark) const {
    const auto first = std::ranges::find(line_names_, mark.name);
    return line_dashes[static_cast<std::size_t>(first - line_names_.begin()) % line_dashes.size()];
  }

  double beside(const DisplayAxis& axis, const std::vector<std::string>& label) const {
    return (axis.label.empty() ? 1.6 : 2.9 + 1.4 * double(label.size())) * layout_.font +
           layout_.character() * double(axis.longest_tic);
  }

  /// An entry of the legend that is no curve.
  void add_entry(const std::string& name, const std::string& drawn) {
    entries_.emplace_back(name, drawn);
    if (own_legend_) plots_.push_back(drawn + " title " + literal(name));
  }

  /// From side to side of the frame, between two values on an axis.
  static std::string side_to_side(bool vertical, double from, double to) {
    return vertical ? fmt::format("from first {:.9g},graph 0 to first {:.9g},graph 1", from, to)
                    : fmt::format("from graph 0,first {:.9g} to graph 1,first {:.9g}", from, to);
  }

  void write_frame() {
    line("reset");
    line("set encoding utf8\nset minussign");
    // gnuplot draws error bars with a white halo around their point, which would hide short bars.
    line("set pointintervalbox 0.01");
    line("set border lw 0.8\nset tics out nomirror scale 0.7,0.35\nset mxtics\nset mytics");
    line("set title {} offset 0,-0.4", literal(title_));
    // Otherwise gnuplot may need more rows than have room.
    line("set key {} {} samplen 2.4 spacing 1.05 width 0.5", legend_,
         legend_rows() > 0 ? fmt::format("vertical maxrows {}", legend_rows()) : "");
    if (names().empty() || !own_legend_) line("unset key");
    if (panel_.equal_scales) line("set size ratio -1");
    write_axis("x", x_, {x_.label});
    write_axis("y", y_, y_label_);
    if (top_) write_axis("x2", *top_, {top_->label});
    if (right_) write_axis("y2", *right_, right_label_);
    for (const ShadedRange& range : panel_.ranges) {
      const DisplayAxis& axis = range.vertical ? x_ : y_;
      const double low = std::max(axis.display(range.low), axis.low.value_or(-HUGE_VAL)),
                   high = std::min(axis.display(range.high), axis.high.value_or(HUGE_VAL));
      if (!(low < high)) continue;
      line("set object rectangle {} behind fc rgb '#808080' fs solid 0.15 noborder",
           side_to_side(range.vertical, low, high));
      if (!range.name.empty())
        add_entry(range.name,
                  "NaN with boxes lc rgb '#808080' fs solid 0.15 border lc rgb '#808080'");
    }
    for (const ReferenceLine& mark : panel_.lines) {
      if (!seen(mark)) continue;
      const double at = mark.vertical ? x_.display(mark.at) : y_.display(mark.at);
      line("set arrow {} nohead dt {} lw 1 lc '#404040' front", side_to_side(mark.vertical, at, at),
           dash_of(mark));
    }
    for (const auto& [mark, right, offset] : names_)
      line("set label {} at graph {:.2f},first {:.9g} right offset 0,{} tc '#404040' front",
           literal(mark->name), right, y_.display(mark->at), offset);
    for (const ReferenceLine* mark : unplaced_)
      add_entry(mark->name, fmt::format("NaN with lines dt {} lw 1 lc '#404040'", dash_of(*mark)));
  }

  void write_axis(std::string_view name, const DisplayAxis& axis,
                  const std::vector<std::string>& label) {
    // gnuplot centres the lines of a label where one line would be, half of them on the numbers.
    const std::string offset =
        name == "x2"  ? " offset 0,-0.5"
        : name == "y" ? fmt::format(" offset {:.2f},0", 1.05 * (1 - double(label.size())))
                      : "";
    line("set {}label {}{}", name, literal(label), offset);
    const bool tight = name != "y" || panel_.image;
    const auto bound = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.9g}", *value) : std::string("*");
    };
    line("set {}range [{}:{}]", name, bound(axis.low), bound(axis.high));
    if (tight) line("set autoscale {}fix", name);
    if (!axis.tics.empty()) line("set {}tics {}", name, axis.tics);
  }

  void write_image() {
    const Image& image = *panel_.image;
    const Raster& raster = *raster_;
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
    line("set cblabel {} offset 0.8,0", literal(scale_label_));
    // The default format fills up short numbers with zeros if a limit has many digits.
    line("set format cb '%g'");
    if (!scale.tics.empty()) line("set cbtics {}", scale.tics);
    if (!image.color_bar) line("unset colorbox");
    const std::string columns = fmt::format("({:.12g}+{:.12g}*$1):({:.12g}+{:.12g}*$2):3",
                                            raster.x0, raster.dx, raster.y0, raster.dy);
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
      const std::string one =
          fmt::format("$curve{}_{} using {} lc '{}'", number_, k,
                      bars ? fmt::format("1:2:3:4 with yerrorbars {}", marker_of(which))
                           : "1:2 with " + style_of(curve.style, which),
                      color);
      const bool named = !curve.name.empty();
      if (named) entries_.emplace_back(curve.name, one);
      drawn.push_back(one + (named && own_legend_ ? " title " + literal(curve.name) : " notitle"));
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
  Layout layout_;
  bool own_legend_, x_hidden_ = false;
  const std::vector<std::string>& line_names_;
  std::string& out_;
  std::vector<std::string> title_, y_label_, right_label_, scale_label_;
  std::vector<std::pair<std::string, std::string>> entries_;
  struct PlacedName {
    const ReferenceLine* mark;
    /// right: right end of the name, as a fraction of the frame's width; offset: its distance from
    /// the line, in text lines.
    double right, offset;
  };

  static constexpr const char* below = "below Left reverse";
  DisplayAxis x_, y_;
  std::optional<DisplayAxis> top_, right_;
  std::optional<Raster> raster_;
  /// Size of the frame in pixels. height_ is 0 if the limits are unknown, so that texts cannot
  /// avoid curves.
  double width_ = 0, height_ = 0, aside_ = 0;
  std::vector<std::array<double, 2>> obstacles_;
  std::vector<Box> taken_;
  std::vector<PlacedName> names_;
  std::vector<const ReferenceLine*> unplaced_;
  std::string legend_;
  std::vector<std::string> plots_, labels_;
};

}  // namespace

namespace {

/// The number of columns, and the size of panels and text. width: of the print, in pixels.
Layout layout_of(const Figure& figure, std::optional<double> width, int& columns) {
  if (!width) return {};
  // Heights are in texts of 7 points. Above and below a frame are its title, numbers and label.
  constexpr double least_panel = 300, page = 190.0 / 25.4 * 96, font = 7.0 / 72 * 96,
                   around = 8 * font;
  const int panels = static_cast<int>(figure.panels.size()), wanted = columns;
  const auto rows = [&] { return (panels + columns - 1) / columns; };
  columns = std::min(wanted, std::max(1, static_cast<int>(*width / least_panel)));
  // Many small panels, such as the maps of several contacts, stay beside each other.
  const std::optional<Image>& map = figure.panels.front().image;
  if (rows() > (map && !map->color_bar ? 3 : 5)) columns = std::min(wanted, 2 * columns);
  const double across = *width / columns,
               caption = 0.75 * font * font * double(figure.caption.size()) / *width;
  return {
      .width = across,
      .frame_height = std::clamp((page - caption) / rows() - around, 0.27 * across, 0.6 * across),
      .font = font};
}

/// One legend for all panels, below them. bottom, height: its place, as shares of the picture.
std::string common_legend(const std::vector<PanelScript>& scripts, int columns, double bottom,
                          double height) {
  std::vector<std::string> seen, keys;
  for (const PanelScript& one : scripts)
    for (const auto& [name, drawn] : one.entries()) {
      if (std::ranges::find(seen, name) != seen.end()) continue;
      seen.push_back(name);
      keys.push_back(fmt::format("{} title {}", drawn, literal(name)));
    }
  // No data are within these ranges.
  return fmt::format(
      "reset\nset encoding utf8\nunset tics\nunset border\nset origin 0,{:.6f}\nset size 1,{:.6f}\n"
      "set lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n"
      "set key center center horizontal Left reverse maxcols {} samplen 2.4 width 0.5\n"
      "plot [1e30:2e30] [1e30:2e30] {}\n",
      bottom, height, columns, fmt::join(keys, ", \\\n     "));
}

}  // namespace

std::string gnuplot_script(const Figure& given, PictureFormat format, std::optional<double> width,
                           bool with_caption) {
  require(!given.panels.empty(), "figure", given.panels.size(), "panels given; give at least one");
  Figure figure = for_width(given, width);
  if (!with_caption) figure.caption.clear();
  const int panels = static_cast<int>(figure.panels.size());
  int columns =
      std::min(panels, figure.columns > 0
                           ? figure.columns
                           : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(panels)))));
  constexpr double dots_per_metre = 96 / 0.0254;
  const Layout layout =
      layout_of(figure, width ? std::optional(*width * dots_per_metre) : std::nullopt, columns);
  const int rows = (panels + columns - 1) / columns;
  const double across = columns * layout.width;
  std::string body;
  std::vector<std::string> line_names;
  for (const Panel& panel : figure.panels)
    for (const ReferenceLine& mark : panel.lines)
      if (std::ranges::find(line_names, mark.name) == line_names.end())
        line_names.push_back(mark.name);
  std::vector<PanelScript> scripts;
  // Frames of a row have the same height, with room for the longest legend below them; those of a
  // column have the same edges.
  std::vector<double> tops(static_cast<std::size_t>(rows), 0),
      bottoms = tops, lefts(static_cast<std::size_t>(columns), 0), rights = lefts;
  for (int k = 0; k < panels; ++k) {
    scripts.emplace_back(figure.panels[static_cast<std::size_t>(k)], k + 1, layout,
                         !figure.one_legend, line_names, body);
    const auto column = static_cast<std::size_t>(k % columns);
    lefts[column] = std::max(lefts[column], scripts.back().left());
    // A map has the room of its own colour scale.
    if (!figure.panels[static_cast<std::size_t>(k)].image)
      rights[column] = std::max(rights[column], scripts.back().right());
  }
  for (int k = 0; columns == 1 && k + 1 < panels; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (scripts[at].shares_x(scripts[at + 1])) scripts[at].hide_x();
  }
  const auto right_of = [&](int k) {
    return figure.panels[static_cast<std::size_t>(k)].image
               ? scripts[static_cast<std::size_t>(k)].right()
               : rights[static_cast<std::size_t>(k % columns)];
  };
  // Lines of a legend are farther apart in an SVG, and the label of x is lower.
  const double line = (format == PictureFormat::svg ? 1.65 : 1.4) * layout.font,
               gap = (format == PictureFormat::svg ? 1.5 : 0.4) * layout.font,
               low = format == PictureFormat::svg ? 0.8 * layout.font : 0;
  for (int k = 0; k < panels; ++k) {
    PanelScript& one = scripts[static_cast<std::size_t>(k)];
    one.arrange(lefts[static_cast<std::size_t>(k % columns)], right_of(k));
    const auto row = static_cast<std::size_t>(k / columns);
    const int legend = one.legend_rows();
    tops[row] = std::max(tops[row], one.top());
    bottoms[row] = std::max(bottoms[row], (one.x_hidden() ? layout.font : layout.bottom()) + low +
                                              (legend > 0 ? legend * line + gap : 0));
  }
  const auto height_of = [&](int row) {
    const auto at = static_cast<std::size_t>(row);
    return tops[at] + layout.frame_height + bottoms[at];
  };
  // Below the panels are the legend of all, and the caption.
  std::vector<std::string> names;
  if (figure.one_legend)
    for (const PanelScript& one : scripts)
      for (const std::string& name : one.names())
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  for (PanelScript& one : scripts) one.leave_to_legend(names);
  const int in_row =
      std::max(1, static_cast<int>(across / (1.2 * width_of_entries(names, layout))));
  const double legend =
      names.empty() ? 0 : line * std::ceil(double(names.size()) / in_row) + layout.font;
  const std::vector<std::string> caption =
      wrapped(figure.caption, (across - 2 * layout.font) / layout.mean_character());
  const double text =
      figure.caption.empty() ? 0 : (1.35 * double(caption.size()) + 1) * layout.font;
  const double title = figure.title.empty() ? 0 : 2.2 * layout.font;
  double down = title + legend + text;
  for (int row = 0; row < rows; ++row) down += height_of(row);
  double top = down - title;
  for (int k = 0; k < panels; ++k) {
    const int row = k / columns, column = k % columns;
    if (column == 0) top -= height_of(row);
    // A last row that is not full is in the middle.
    const double from = column + 0.5 * std::max(0, (row + 1) * columns - panels);
    const double bottom = top + bottoms[static_cast<std::size_t>(row)],
                 aside = scripts[static_cast<std::size_t>(k)].aside();
    scripts[static_cast<std::size_t>(k)].write(
        fmt::format("set origin {:.6f},{:.6f}\nset size {:.6f},{:.6f}\n", from / columns,
                    top / down, 1.0 / columns, height_of(row) / down) +
        fmt::format("set lmargin at screen {:.6f}\nset bmargin at screen {:.6f}\n"
                    "set tmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n",
                    from / columns + (lefts[static_cast<std::size_t>(column)] + aside) / across,
                    bottom / down, (bottom + layout.frame_height) / down,
                    (from + 1) / columns - (right_of(k) + aside) / across) +
        (k == 0 && title > 0 ? fmt::format("set label {} at screen 0.5,{:.6f} center\n",
                                           literal(figure.title), 1 - 0.5 * title / down)
                             : "") +
        (k == 0 && text > 0
             ? fmt::format("set label {} at screen {:.6f},{:.6f} left\n", literal(caption),
                           layout.font / across, (text - layout.font) / down)
             : ""));
  }
  if (legend > 0) body += common_legend(scripts, in_row, text / down, legend / down);
  std::string out;
  // Sizes of pdfcairo are in inches; a picture for a screen has 100 pixels to an inch.
  const double points = width ? 96 : 100;
  if (format == PictureFormat::png) {
    const double fine = width ? 300.0 / 96 : 2;
    out += fmt::format(
        "set terminal pngcairo enhanced size {:.0f},{:.0f} font 'Sans,{:.3g}' fontscale {:.4g} "
        "linewidth {:.3g} pointscale {:.3g} dashlength 1.6 background '#ffffff'\n",
        fine * across, fine * down, layout.font / 1.2, fine, fine, fine);
  } else if (format == PictureFormat::pdf) {
    out += fmt::format(
        "set terminal pdfcairo enhanced size {:.4f}in,{:.4f}in font 'Sans,{:.3g}' linewidth {} "
        "pointscale {} dashlength 0.8 background '#ffffff'\n",
        across / points, down / points, 0.75 * layout.font, width ? 0.7 : 1, width ? 0.5 : 0.7);
  } else {
    out += fmt::format(
        "set terminal svg enhanced size {:.0f},{:.0f} {} standalone font 'sans-serif,{:.4g}' "
        "linewidth {} dashlength 0.8 background '#ffffff'\n",
        across, down, width ? "fixed" : "dynamic", layout.font, width ? 0.8 : 1);
  }
  out += "set encoding utf8\n";
  return out + "set multiplot\n" + body + "unset multiplot\n";
}

}  // namespace salebra::figures
