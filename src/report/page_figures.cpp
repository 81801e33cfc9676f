// SPDX-License-Identifier: GPL-3.0-or-later
// Figures that a page draws as the library makes them, from the groups of a results file.
#include "page_figures.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <initializer_list>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/study/realisation.hpp>
#include <string_view>
#include <utility>

#include "figures/axes.hpp"
#include "figures/figure_object.hpp"
#include "map_bytes.hpp"

namespace salebra::detail {
namespace {

using figures::Axis;
using figures::axis_of;
using figures::Curve;
using figures::Figure;
using figures::Panel;
using figures::Style;

class PageFigures {
 public:
  PageFigures(const ResultReader& file, const std::string& where,
              const std::vector<double>& pressures)
      : file_(file), where_(where), pressures_(pressures) {}

  Json all(Index map_side) {
    of_picture(map_side);
    of_spots();
    if (file_.has(where_ + "adhesion/mean_gap"))
      add("adhesion-loop", "Pressure over mean gap in a cycle",
          "Adhesive surfaces approach and separate in steps of the gap. At negative pressures the "
          "contact pulls the surfaces together. The area between the two branches is the work lost "
          "in a cycle.",
          {.x = axis_of("mean_gap", false, "mean gap ū"),
           .y = axis_of("pressure", false, "pressure p"),
           .curves = {
               estimate("approach", "adhesion/", "loading_pressure", "adhesion/mean_gap", 0),
               estimate("separation", "adhesion/", "unloading_pressure", "adhesion/mean_gap", 1)}});
    if (file_.has(where_ + "convergence/surfaces")) {
      Panel panel{.x = {.quantity = "surfaces", .label = "surfaces"},
                  .y = axis_of("decay_length_over_rms_height", false, "l/h_{rms}")};
      panel.curves = {estimate("mean of the first surfaces, 95 %", "convergence/",
                               "decay_length_over_rms_height", "convergence/surfaces", 0, "")};
      add("convergence", "Convergence of the mean",
          "Mean of l/h_{rms} of boundary elements over the first 2, 3, … surfaces, with its 95 % "
          "interval. If the band still drifts at the end, use more seeds.",
          std::move(panel));
    }
    return std::move(all_);
  }

 private:
  std::vector<double> list(const std::string& name, std::size_t size) const {
    std::vector<double> values = file_.numbers(where_ + name);
    if (values.size() != size)
      throw InvalidInput(file_.file().string(),
                         fmt::format("{}{} has {} values, {} are needed; the file is damaged",
                                     where_, name, values.size(), size));
    return values;
  }

  /// The mean of a quantity with its limits, over a coordinate.
  Curve estimate(const char* name, const std::string& group, const std::string& quantity,
                 const std::string& coordinate, int color,
                 const std::string& prefix = "ensemble_") const {
    Curve curve{.name = name,
                .quantity = quantity,
                .x = file_.numbers(where_ + coordinate),
                .style = Style::line_and_points,
                .color = color};
    const std::string path = group + prefix + quantity;
    curve.y = list(path + "_mean", curve.x.size());
    if (file_.has(where_ + path + "_low") && file_.has(where_ + path + "_high")) {
      curve.low = list(path + "_low", curve.x.size());
      curve.high = list(path + "_high", curve.x.size());
    }
    return curve;
  }

  void add(const char* name, const char* title, std::string caption, Panel panel) {
    std::optional<figures::Image> image = std::move(panel.image);
    const std::vector<Index> size{image ? image->values.rows() : 0,
                                  image ? image->values.cols() : 0};
    std::vector<float> map;
    if (image) {
      for (Index i = 0; i < size[0]; ++i)
        for (Index j = 0; j < size[1]; ++j) map.push_back(float(image->values(i, j)));
      image->values.resize(0, 0);
      panel.image = std::move(image);
    }
    Figure figure{.kind = name, .title = title, .caption = std::move(caption)};
    figure.panels.push_back(std::move(panel));
    Json object = figures::figure_object(figure);
    if (!map.empty()) object["panels"][0]["image"]["values"] = base64(map);
    all_.push_back(std::move(object));
  }

  /// The picture as the study kept it, with every stride-th point of its maps.
  SurfacePicture picture(Index map_side) const {
    const std::string group = where_ + "picture";
    const auto text = [&](const char* name) {
      return file_.text_attribute(group, name).value_or("");
    };
    const auto number = [&](const char* name) {
      return file_.number_attribute(group, name).value_or(ForceSample::unknown);
    };
    const auto lists = [&](const char* name) {
      const std::string path = group + "/" + name;
      return file_.has(path) ? file_.numbers(path) : std::vector<double>();
    };
    const std::vector<double> x = lists("x"), y = lists("y");
    const auto rows = Index(x.size()), columns = Index(y.size());
    const Index stride = stride_of(rows, columns, map_side);
    SurfacePicture picture;
    picture.law = text("law");
    picture.stride = stride;
    picture.nx = (rows + stride - 1) / stride;
    picture.ny = (columns + stride - 1) / stride;
    picture.step_x = rows > 1 ? double(stride) * (x[1] - x[0]) : 0;
    picture.step_y = columns > 1 ? double(stride) * (y[1] - y[0]) : 0;
    for (const auto& [name, map] : {std::pair("heights", &picture.heights),
                                    {"contact_pressure", &picture.contact_pressure},
                                    {"gap", &picture.gap}})
      if (file_.has(group + "/" + name))
        *map =
            every(stride, rows, columns, list(std::string("picture/") + name, x.size() * y.size()),
                  [](double value) { return float(value); });
    picture.mapped_load = Index(file_.number_attribute(group, "mapped_load").value_or(-1));
    picture.hurst = number("hurst");
    picture.hurst_low = number("hurst_low");
    picture.hurst_high = number("hurst_high");
    picture.wavenumber = lists("wavenumber");
    picture.psd = lists("psd");
    picture.law_psd = lists("law_psd");
    picture.height = lists("height");
    picture.height_density = lists("height_density");
    if (picture.psd.size() != picture.wavenumber.size() ||
        picture.law_psd.size() != picture.wavenumber.size() ||
        picture.height.size() != picture.height_density.size())
      throw InvalidInput(file_.file().string(), group +
                                                    " has lists of other lengths than their "
                                                    "coordinates; the file is damaged");
    return picture;
  }

  /// The caption with the load in place of "{}".
  static std::string captioned(std::string caption, const std::string& load) {
    if (const std::size_t place = caption.find("{}"); place != std::string::npos)
      caption.replace(place, 2, load);
    return caption;
  }

  void of_picture(Index map_side) {
    if (!file_.has(where_ + "picture/heights")) return;
    struct Place {
      std::string_view quantity;
      const char *name, *title, *caption;
    };
    constexpr Place places[] = {
        {"heights", "height-map", "Heights",
         "Heights of the first surface above its mean; hills are bright."},
        {"contact_pressure", "pressure-map", "Contact pressure",
         "Contact pressure at the nominal pressure {}, the only load stored in the file, by "
         "boundary elements; points "
         "without contact are blank. The highest pressures depend on the size of the cells."},
        {"gap", "gap-map", "Gap",
         "Gap after deformation at the nominal pressure {}, the only load stored in the file, by "
         "boundary elements; points in contact are blank."},
        {"psd", "spectrum", "Power spectral density",
         "C(q), averaged over rings of wave vectors; its integral over the plane of wave vectors "
         "is "
         "h_{rms}^{2}. Wavelengths are 2π/q."},
        {"height_density", "distribution", "Distribution of heights",
         "Density of the points over their height, compared with a Gaussian of the same rms "
         "height. "
         "Only the highest points make contact, so the right end matters most; a logarithmic axis "
         "shows it best."}};
    const SurfacePicture shown = picture(map_side);
    const auto load = std::size_t(shown.mapped_load);
    const std::string pressed = format_quantity(
        load < pressures_.size() ? pressures_[load] : ForceSample::unknown, Dimension::pressure, 3);
    for (Panel& panel : figures::figure_of(shown, pressures_).panels)
      for (const Place& place : places)
        if (place.quantity == (panel.image ? panel.image->scale : panel.y).quantity)
          add(place.name, place.title, captioned(place.caption, pressed), std::move(panel));
  }

  void of_spots() {
    const auto panel = [&](const Axis& y,
                           std::initializer_list<std::pair<const char*, const char*>> curves) {
      Panel one{.x = axis_of("pressure", true, "nominal pressure p"), .y = y};
      for (const auto& [name, quantity] : curves)
        if (file_.has(where_ + "spots/ensemble_" + quantity + "_mean"))
          one.curves.push_back(
              estimate(name, "spots/", quantity, "curve/pressure", int(one.curves.size())));
      return one;
    };
    Panel count = panel({.quantity = "spot_count", .label = "number of spots", .logarithmic = true},
                        {{"spots", "spot_count"}}),
          area = panel({.quantity = "mean_spot_area",
                        .label = "area of a spot",
                        .unit = "m^2",
                        .logarithmic = true},
                       {{"mean", "mean_spot_area"}, {"largest", "max_spot_area"}});
    if (!count.curves.empty())
      add("spots", "Contact spots",
          "Contact spots by boundary elements; a spot consists of neighbouring points in contact. "
          "Statistical laws need many spots.",
          std::move(count));
    if (!area.curves.empty())
      add("spot-areas", "Areas of contact spots",
          "Mean area of a contact spot and area of the largest, by boundary elements.",
          std::move(area));
  }

  const ResultReader& file_;
  const std::string& where_;
  const std::vector<double>& pressures_;
  Json all_ = Json::array();
};

}  // namespace

Json page_figures(const ResultReader& file, const std::string& where,
                  const std::vector<double>& pressures, Index map_side) {
  return PageFigures(file, where, pressures).all(map_side);
}

}  // namespace salebra::detail
