// SPDX-License-Identifier: GPL-3.0-or-later
// Figures that a page draws as the library makes them, from the groups of a results file.
#include "page_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <salebra/base/error.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/lay.hpp>
#include <string_view>
#include <utility>

#include "figures/axes.hpp"
#include "figures/figure_object.hpp"
#include "figures/study_numbers.hpp"
#include "map_bytes.hpp"
#include "study_groups.hpp"

namespace salebra::detail {
namespace {

using figures::Axis;
using figures::axis_of;
using figures::Curve;
using figures::Figure;
using figures::Panel;
using figures::Style;

class PageFigures : StudyGroups {
 public:
  PageFigures(const ResultReader& file, const std::string& where,
              const std::vector<double>& pressures)
      : StudyGroups(file, where), pressures_(pressures) {}

  Json all(Index map_side) {
    of_picture(map_side);
    const figures::StudyNumbers numbers = study_numbers();
    for (Figure& picture : figures::study_pictures(numbers)) {
      if (picture.kind == "damping-curve") add_other_directions(picture);
      all_.push_back(figures::figure_object(picture));
    }
    of_spots();
    if (has("adhesion/mean_gap"))
      add("adhesion-loop", "Pressure over mean gap in a cycle",
          "Adhesive surfaces approach and separate in steps of the gap. At negative pressures the "
          "contact pulls the surfaces together. The area between the two branches is the work lost "
          "in a cycle.",
          {.x = axis_of("mean_gap", false, "mean gap ū"),
           .y = axis_of("pressure", false, "pressure p"),
           .curves = {
               estimate("approach", "adhesion/", "loading_pressure", "adhesion/mean_gap", 0),
               estimate("separation", "adhesion/", "unloading_pressure", "adhesion/mean_gap", 1)}});
    if (has("convergence/surfaces")) {
      Panel panel{.x = {.quantity = "surfaces", .label = "surfaces"},
                  .y = axis_of("decay_length_over_rms_height", false, "l/h_{rms}")};
      panel.curves = {estimate("mean of the first surfaces, 95 %", "convergence/",
                               "decay_length_over_rms_height", "convergence/surfaces", 0, "")};
      add("convergence", "Convergence of the mean",
          "Mean of l/h_{rms} of boundary elements over the first 2, 3, … surfaces, with its 95 % "
          "interval. If the band still drifts at the end, use more seeds.",
          std::move(panel));
    }
    Json page;
    page["figures"] = std::move(all_);
    if (numbers.motion) page["motion"] = figures::motion_sentence(numbers);
    return page;
  }

  /// l/h_{rms} of all points of the parameter grid.
  Json overview(const std::vector<std::string>& names) {
    Curve curve = estimate("", "", "decay_length_over_rms_height", "point", 0);
    curve.style = Style::points;
    std::string points;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      curve.x[i] = double(i + 1);
      if (i < names.size() && !names[i].empty())
        points += fmt::format("{}{}: {}", points.empty() ? "; point " : ", ", i + 1, names[i]);
    }
    add("overview", "The points of the parameter grid",
        "l/h_{rms} of boundary elements at each point, with 95 % intervals" +
            figures::plain_text(points) + ". Choose a point above to see its results.",
        {.x = {.quantity = "point", .label = "point"},
         .y = axis_of("decay_length_over_rms_height", false, "l/h_{rms}"),
         .curves = {std::move(curve)}});
    return std::move(all_);
  }

 private:
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
    curve.y = part(path + "_mean", 0, curve.x.size());
    if (has(path + "_low") && has(path + "_high")) {
      curve.low = part(path + "_low", 0, curve.x.size());
      curve.high = part(path + "_high", 0, curve.x.size());
    }
    return curve;
  }

  /// The means of a quantity at the pressures, of one of several models.
  std::vector<StatedMean> means(const std::string& name, std::size_t model = 0) const {
    std::vector<StatedMean> means;
    for (const auto& [end, member] :
         {std::pair<const char*, double StatedMean::*>("_mean", &StatedMean::mean),
          {"_low", &StatedMean::low},
          {"_high", &StatedMean::high},
          {"_error", &StatedMean::error}}) {
      if (!has(name + end)) continue;
      const std::vector<double> values = part(name + end, model, pressures_.size());
      means.resize(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) means[k].*member = values[k];
    }
    return means;
  }

  /// A dataset with one row for each surface; empty if there is none.
  std::vector<std::vector<double>> rows(const std::string& name, std::size_t surfaces,
                                        std::size_t number = 0, std::size_t parts = 1) const {
    std::vector<std::vector<double>> rows;
    if (!has(name)) return rows;
    const std::size_t values = file_.numbers(where_ + name).size(),
                      size = values / parts / surfaces;
    const std::vector<double> all = part(name, number, size * surfaces);
    for (auto row = all.begin(); rows.size() < surfaces; row += std::ptrdiff_t(size))
      rows.emplace_back(row, row + std::ptrdiff_t(size));
    return rows;
  }

  /// The numbers of the pictures that the program draws of a study in memory.
  figures::StudyNumbers study_numbers() const {
    figures::StudyNumbers numbers{.pressures = pressures_};
    if (!has("surface/rms_height")) return numbers;
    numbers.rms_height = file_.numbers(where_ + "surface/rms_height");
    const std::size_t surfaces = numbers.rms_height.size();
    if (surfaces == 0) refuse_damaged("surface/rms_height", "has no values");
    numbers.rms_slope = part("surface/rms_slope", 0, surfaces);
    numbers.nominal_area = attribute("surface", "size_x") * attribute("surface", "size_y");
    numbers.contact_scale = attribute("surface", "contact_scale");
    // Files of earlier versions have the moduli only with damping.
    for (const char* group : {"damping", "surface"})
      for (const auto& [name, member] : {std::pair("contact_modulus", &numbers.contact_modulus),
                                         {"modulus_ratio", &numbers.modulus_ratio}})
        *member = std::fmax(*member, attribute(group, name));
    numbers.twin = text("fit", "interval_method").find("prediction") != std::string::npos;
    const std::vector<std::string> models = file_.labels(where_ + "curve/model");
    for (std::size_t m = 0; m < models.size(); ++m) {
      numbers.models.push_back(model(models[m], m, surfaces));
      if (models[m] == "bem") add_boundary_elements(numbers, m, models.size());
    }
    numbers.corrected_area_fraction = rows("spots/corrected_area_fraction", surfaces);
    if (has("damping/force")) add_motion(numbers);
    return numbers;
  }

  figures::StudyNumbers::Model model(const std::string& name, std::size_t m,
                                     std::size_t surfaces) const {
    const auto known = std::ranges::find(contact_models(), name, &StudyModel::name);
    figures::StudyNumbers::Model model;
    model.title =
        figures::plain_text(known == contact_models().end() ? name : std::string(known->title));
    if (known != contact_models().end()) model.color = int(known->id);
    const std::size_t loads = pressures_.size();
    model.curves.assign(surfaces, std::vector<ForceSample>(loads));
    const auto fill = [&](const char* column, const auto& set) {
      const std::vector<double> values = part(std::string("curve/") + column, m, surfaces * loads);
      for (std::size_t i = 0; i < values.size(); ++i)
        set(model.curves[i / loads][i % loads], values[i]);
    };
    fill("converged", [](ForceSample& one, double value) { one.converged = value != 0; });
    for (const auto& [column, member] :
         {std::pair("mean_gap", &ForceSample::mean_gap),
          {"force", &ForceSample::force},
          {"contact_area_fraction", &ForceSample::contact_area_fraction},
          {"normal_stiffness", &ForceSample::normal_stiffness},
          {"tangential_stiffness", &ForceSample::tangential_stiffness}})
      if (has(std::string("curve/") + column))
        fill(column, [member](ForceSample& one, double value) { one.*member = value; });
    // Files of version 1.0 store a loss without slip without the ending "_without_slip".
    const auto without_slip = [&](const std::string& loss) {
      return of_model(loss + (has(loss + "_without_slip_mean") ? "_without_slip" : ""), m);
    };
    model.damping_constant = without_slip("damping/ensemble_damping_constant");
    model.over_bem = without_slip("comparison/work_per_cycle");
    return model;
  }

  std::vector<EnsembleMean> of_model(const std::string& name, std::size_t m) const {
    const std::vector<StatedMean> all = means(name, m);
    return {all.begin(), all.end()};
  }

  void add_boundary_elements(figures::StudyNumbers& numbers, std::size_t m,
                             std::size_t models) const {
    const std::size_t surfaces = numbers.rms_height.size();
    numbers.closed_form = of_model("damping/ensemble_damping_constant_closed_form", m);
    numbers.small_amplitude = of_model("damping/ensemble_small_amplitude_damping_constant", m);
    numbers.deviation = of_model("damping/ensemble_deviation", m);
    const auto fit = [&](const char* name) {
      return has(std::string("fit/") + name) ? part(std::string("fit/") + name, m, surfaces)
                                             : std::vector(surfaces, ForceSample::unknown);
    };
    const auto length = fit("decay_length"), reference = fit("reference_pressure"),
               least = fit("pressure_min"), most = fit("pressure_max");
    if (has("fit/fair") && !std::isnan(part("fit/law_off_at_min_gap", m, 1)[0]))
      numbers.law = figures::poor_law({.fair = part("fit/fair", m, 1)[0] != 0});
    const auto gaps = rows("local/mean_gap", surfaces, m, models),
               lengths = rows("local/local_decay_length", surfaces, m, models);
    for (std::size_t i = 0; i < surfaces; ++i) {
      numbers.fits.push_back({.decay_length = length[i],
                              .reference_pressure = reference[i],
                              .window = {.pressure_min = least[i], .pressure_max = most[i]}});
      if (!gaps.empty() && gaps.size() == lengths.size())
        numbers.local.push_back({gaps[i], lengths[i]});
    }
  }

  void add_motion(figures::StudyNumbers& numbers) const {
    const auto given = [&](const char* name) { return attribute("damping", name); };
    const double amplitude = given("normal_amplitude"), frequency = given("angular_frequency");
    numbers.motion =
        EqualFrequency{amplitude, given("tangential_amplitude"), given("phase"), frequency};
    if (text("damping", "mode") == "drag")
      numbers.motion = Drag{amplitude, given("drag_velocity"), frequency};
    numbers.hold = parse_enum<Hold>(text("damping", "hold")).value_or(Hold::indentation);
    numbers.excursion = given("excursion");
    numbers.friction_coefficient = given("friction_coefficient");
    numbers.direction = given("direction");
    numbers.damping_constant = means("solution/damping_constant");
    // The summary of the page says why.
    if (const std::string word = text("solution", "validity");
        word == name_of(Validity::not_valid) || word == name_of(Validity::valid_with_care))
      numbers.validity = word;
    numbers.slips = text("solution", "slip_followed") == "yes";
  }

  /// The damping constants of motions in further directions, as points.
  void add_other_directions(Figure& picture) const {
    constexpr int colors[] = {3, 4, 5};
    for (std::size_t k = 1; has(fmt::format("directions/{}/solution/damping_constant_mean", k));
         ++k) {
      const std::string group = fmt::format("directions/{}/", k);
      const std::string way = direction_in_words(attribute(group + "damping", "direction"));
      Curve points{.name = way,
                   .quantity = "damping_constant",
                   .x = pressures_,
                   .style = Style::points,
                   .color = colors[(k - 1) % std::size(colors)]};
      for (const StatedMean& one : means(group + "solution/damping_constant")) {
        const bool limits = !std::isnan(one.low);
        points.y.push_back(one.mean);
        points.low.push_back(limits ? one.low : one.mean - one.error);
        points.high.push_back(limits ? one.high : one.mean + one.error);
      }
      picture.panels[0].curves.push_back(std::move(points));
      picture.caption += fmt::format(" The points “{}” are for the motion in that direction.", way);
    }
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
    const auto lists = [&](const char* name) {
      const std::string path = group + "/" + name;
      return file_.has(path) ? file_.numbers(path) : std::vector<double>();
    };
    const std::vector<double> x = lists("x"), y = lists("y");
    const auto rows = Index(x.size()), columns = Index(y.size());
    const Index stride = stride_of(rows, columns, map_side);
    SurfacePicture picture;
    picture.law = text("picture", "law");
    picture.stride = stride;
    picture.nx = (rows + stride - 1) / stride;
    picture.ny = (columns + stride - 1) / stride;
    picture.step_x = rows > 1 ? double(stride) * (x[1] - x[0]) : 0;
    picture.step_y = columns > 1 ? double(stride) * (y[1] - y[0]) : 0;
    for (const auto& [name, map] : {std::pair("heights", &picture.heights),
                                    {"contact_pressure", &picture.contact_pressure},
                                    {"gap", &picture.gap}})
      if (file_.has(group + "/" + name))
        *map = every(stride, rows, columns,
                     part(std::string("picture/") + name, 0, x.size() * y.size()),
                     [](double value) { return float(value); });
    picture.mapped_load = Index(file_.number_attribute(group, "mapped_load").value_or(-1));
    picture.hurst = attribute("picture", "hurst");
    picture.hurst_low = attribute("picture", "hurst_low");
    picture.hurst_high = attribute("picture", "hurst_high");
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

  /// The spectra of profiles across and along the lay; nothing for a surface without a lay, and for
  /// a file that has only a part of the points.
  std::optional<Panel> spectra_of_lay(const std::string& group) const {
    if (attribute("picture", "stride") != 1) return {};
    const std::vector<double> x = file_.numbers(group + "/x"), y = file_.numbers(group + "/y");
    if (x.size() < 2 || y.size() < 2) return {};
    const auto rows = Index(x.size()), columns = Index(y.size());
    const std::vector<double> heights = part("picture/heights", 0, x.size() * y.size());
    Surface surface;
    surface.grid = {rows, columns, double(rows) * (x[1] - x[0]), double(columns) * (y[1] - y[0])};
    surface.heights = Eigen::Map<const Field>(heights.data(), rows, columns);
    const figures::SurfaceSpectrum spectrum = figures::spectrum_of(surface);
    if (!spectrum.of_lay) return {};
    Panel panel = figures::figure_of(surface, spectrum).panels.at(1);
    panel.caption = "";
    return panel;
  }

  /// The caption with the load in place of "{}".
  static std::string captioned(std::string caption, const std::string& load) {
    if (const std::size_t place = caption.find("{}"); place != std::string::npos)
      caption.replace(place, 2, load);
    return caption;
  }

  void of_picture(Index map_side) {
    if (!has("picture/heights")) return;
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
    std::optional<Panel> of_lay = spectra_of_lay(where_ + "picture");
    for (Panel& panel : figures::figure_of(shown, pressures_).panels)
      for (const Place& place : places)
        if (of_lay && place.name == std::string_view("spectrum") && panel.y.quantity == "psd")
          add(place.name, place.title,
              "C_1 of profiles across and along the lay, with 95 % bands and, where found, "
              "the fitted laws. "
              "Wavelengths are 2π/q.",
              *of_lay);
        else if (place.quantity == (panel.image ? panel.image->scale : panel.y).quantity)
          add(place.name, place.title, captioned(place.caption, pressed), std::move(panel));
  }

  void of_spots() {
    const auto panel = [&](const Axis& y,
                           std::initializer_list<std::pair<const char*, const char*>> curves) {
      Panel one{.x = axis_of("pressure", true, "nominal pressure p"), .y = y};
      for (const auto& [name, quantity] : curves)
        if (has(std::string("spots/ensemble_") + quantity + "_mean"))
          one.curves.push_back(
              estimate(name, "spots/", quantity, "curve/pressure", int(one.curves.size())));
      return one;
    };
    Panel count = panel(axis_of("spot_count", true), {{"spots", "spot_count"}}),
          area = panel(axis_of("mean_spot_area", true, "area of a spot"),
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

  const std::vector<double> pressures_;
  Json all_ = Json::array();
};

}  // namespace

Json page_figures(const ResultReader& file, const std::string& where,
                  const std::vector<double>& pressures, Index map_side) {
  return PageFigures(file, where, pressures).all(map_side);
}

Json grid_figures(const ResultReader& file, const std::vector<std::string>& names) {
  return PageFigures(file, "ensemble/", {}).overview(names);
}

}  // namespace salebra::detail
