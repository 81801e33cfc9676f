// SPDX-License-Identifier: GPL-3.0-or-later
// Data of a report page as JSON, from the results of a study and of direct simulations.
#include "payload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/results/assumption_verdicts.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/lay.hpp>
#include <span>
#include <string>
#include <vector>

#include "map_bytes.hpp"
#include "page_figures.hpp"
#include "study/estimate.hpp"
#include "study_groups.hpp"

namespace salebra::detail {
namespace {

using Names = std::vector<std::string>;

/// Rounds to seven digits: more than a figure shows, and half as long as all digits.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  const std::string text = fmt::format("{:.7g}", value);
  double rounded = value;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

Json list(std::span<const double> values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(number(value));
  return json;
}

/// Number of points of all surface maps of a page. With several points of the parameter grid, each
/// map has its share.
constexpr double map_budget = 256. * 256.;

/// Reads the groups of one study, or of one point of its parameter grid, and makes their part of
/// the payload.
class Point : StudyGroups {
 public:
  Point(const ResultReader& file, const std::string& where)
      : StudyGroups(file, where),
        models_(file_.labels(where_ + "curve/model")),
        pressures_(file_.numbers(where_ + "curve/pressure")) {}

  Json payload(Index map_side) const {
    Json json;
    json["pressure"] = list(pressures_);
    json["models"] = Json::array();
    for (const std::string& model : models_)
      json["models"].push_back({{"name", model}, {"title", title(model)}});
    add(json, "surface", surface());
    add(json, "picture", picture(map_side));
    const Json page = page_figures(file_, where_, pressures_, map_side);
    for (const auto& [name, part] : page.items()) add(json, name.c_str(), part);
    add(json, "curve",
        of_bem("curve/ensemble_", {"mean_gap", "normal_stiffness", "tangential_stiffness"}));
    add(json, "fit", fit());
    add(json, "adhesion", adhesion());
    add_damping(json);
    for (std::size_t k = 1; file_.has(fmt::format("{}directions/{}/damping/force", where_, k));
         ++k) {
      Json other{{"pressure", list(pressures_)}};
      Point(file_, fmt::format("{}directions/{}/", where_, k)).add_damping(other);
      if (json["other_directions"].is_null()) json["other_directions"] = Json::array();
      json["other_directions"].push_back(std::move(other));
    }
    add(json, "assumptions", assumptions());
    return json;
  }

 private:
  /// The results that depend on the direction of the tangential motion.
  void add_damping(Json& json) const {
    add(json, "damping", damping());
    if (has(solution("pressure"))) {
      for (const char* name : {"validity", "verdicts", "slip_followed"})
        if (const auto text = file_.text_attribute(where_ + "solution", name)) json[name] = *text;
      json["solution"] = {
          {"damping_constant", estimate(solution("damping_constant"), 0, pressures_.size())}};
      json["solution"]["damping_constant"]["error"] =
          list(required(solution("damping_constant_error")));
      json["solution"]["slip_share"] = list(required(solution("slip_share")));
      if (has(solution("regime"))) json["solution"]["regime"] = regimes();
    }
  }

  std::string solution(const std::string& name) const { return "solution/" + name; }

  /// Returns the name of the dataset of a loss without slip. Files of version 1.0 store it without
  /// the ending "_without_slip".
  std::string without_slip(const std::string& loss) const {
    const std::string name = loss + "_without_slip";
    return has("damping/" + name) ? name : loss;
  }

  /// The name of the regime (no slip, partial slip, lifts off, sliding) at each pressure.
  Json regimes() const {
    Json words = Json::array();
    for (const double value : part(solution("regime"), 0, pressures_.size())) {
      const auto known = std::ranges::find(EnumNames<Regime>::values, value,
                                           [](const auto& one) { return double(one.first); });
      words.push_back(std::string(
          name_of(known == EnumNames<Regime>::values.end() ? Regime::unknown : known->first)));
    }
    return words;
  }

  static void add(Json& json, const char* key, Json part) {
    if (!part.is_null() && !part.empty()) json[key] = std::move(part);
  }

  static std::string title(const std::string& model) {
    const auto known = std::ranges::find(contact_models(), model, &StudyModel::name);
    return known == contact_models().end() ? model : known->title;
  }

  /// {mean, low, high} from the datasets NAME_mean, NAME_low and NAME_high; null if the file has
  /// none of them.
  Json estimate(const std::string& name, std::size_t block, std::size_t size) const {
    Json json;
    for (const char* member : {"mean", "low", "high"})
      if (has(name + "_" + member)) json[member] = list(part(name + "_" + member, block, size));
    return json;
  }

  /// {mean, low, high} of one value as numbers; `location` is its index in the datasets of
  /// estimate().
  Json single(const std::string& name, std::size_t location) const {
    Json json = estimate(name, location, 1);
    for (auto& [member, values] : json.items()) values = Json(values[0]);
    return json;
  }

  /// Nested objects: quantity → "bem" → estimates of the boundary elements over the pressures.
  Json of_bem(const std::string& prefix, const Names& quantities) const {
    Json json;
    for (const std::string& quantity : quantities)
      if (bem() < models_.size() && has(prefix + quantity + "_mean"))
        json[quantity]["bem"] = estimate(prefix + quantity, bem(), pressures_.size());
    return json;
  }

  std::size_t realisations() const {
    const auto numbers = column("curve/realisation");
    return numbers ? numbers->size() : 0;
  }

  std::size_t bem() const {
    return std::size_t(std::ranges::find(models_, "bem") - models_.begin());
  }

  Json surface() const {
    Json json;
    for (const char* name : {"nx", "ny", "size_x", "size_y"})
      if (const auto value = file_.number_attribute(where_ + "surface", name)) json[name] = *value;
    for (const char* name : {"warnings", "ensemble_warnings"})
      if (const auto text = file_.text_attribute(where_ + "surface", name)) json[name] = *text;
    if (!has("surface/realisation")) return json;
    json["realisations"] = required("surface/realisation").size();
    if (const auto seeds = column("surface/seed")) json["seed"] = *seeds;
    Json& statistics = json["statistics"];
    for (const char* name : {"rms_height", "rms_slope", "skewness", "kurtosis", "nayak", "moment0",
                             "moment2", "moment4", "summit_density", "mean_radius", "summit_rms"}) {
      const auto values = column(std::string("surface/") + name);
      if (!values) continue;
      const Quantity quantity = find_quantity(name);
      const EnsembleMean mean = bootstrap_.mean(*values);
      statistics.push_back({{"name", name},
                            {"title", quantity.long_name},
                            {"unit", si_unit(quantity.dimension)},
                            {"mean", number(mean.mean)},
                            {"low", number(mean.low)},
                            {"high", number(mean.high)}});
    }
    return json;
  }

  Json picture(Index map_side) const {
    Json json;
    if (!has("picture/heights")) return json;
    const std::vector<double> x = required("picture/x"), y = required("picture/y");
    const auto rows = Index(x.size()), columns = Index(y.size());
    const std::vector<double> loads = part("picture/first_load", 0, x.size() * y.size());
    const Index stride = stride_of(rows, columns, map_side);
    // Clamps to 16 bits, because a damaged file may hold NaN or larger numbers.
    const auto whole = [](double value) {
      return std::int16_t(std::isnan(value) ? 0 : std::clamp(value, -32768., 32767.));
    };
    json["nx"] = (rows + stride - 1) / stride;
    json["ny"] = (columns + stride - 1) / stride;
    json["step_x"] = number(rows > 1 ? double(stride) * (x[1] - x[0]) : 0);
    json["step_y"] = number(columns > 1 ? double(stride) * (y[1] - y[0]) : 0);
    json["stride"] =
        double(stride) * file_.number_attribute(where_ + "picture", "stride").value_or(1);
    json["first_load"] = base64(every(stride, rows, columns, loads, whole));
    if (const auto load = file_.number_attribute(where_ + "picture", "mapped_load"))
      json["mapped_load"] = *load;
    json["origin"] = file_.text_attribute(where_ + "picture", "origin").value_or("");
    return json;
  }

  Json fit() const {
    Json json;
    if (!has("fit/decay_length") || bem() == models_.size()) return json;
    json["interval_method"] = file_.text_attribute(where_ + "fit", "interval_method").value_or("");
    for (std::size_t m = 0; m < models_.size(); ++m)
      for (const char* name :
           {"decay_length", "decay_length_over_rms_height", "area_slope", "law_bend",
            "decay_length_at_min_gap_over_rms_height", "decay_length_at_max_gap_over_rms_height"})
        if (has(std::string("fit/ensemble_") + name + "_mean"))
          json["models"][models_[m]][name] = single(std::string("fit/ensemble_") + name, m);
    for (const char* name : {"law_off_at_min_gap", "law_off_at_max_gap", "fair"})
      if (const std::string column = std::string("fit/") + name; has(column))
        json["models"]["bem"][name] = number(part(column, bem(), 1)[0]);
    return json;
  }

  Json damping() const {
    Json json;
    if (!has("damping/force")) return json;
    json["force"] = list(part("damping/force", 0, pressures_.size()));
    for (const auto& [route, name] :
         {std::pair<const char*, std::string>{"law", "damping_constant_closed_form"},
          {"curve", without_slip("damping_constant")}})
      if (Json means = of_bem("damping/ensemble_", {name}); !means.is_null())
        json[route]["damping_constant"] = means[name];
    for (const char* name : {"max_force", "contact_time"})
      if (const std::string means = std::string("damping/ensemble_") + name + "_mean";
          has(means) && bem() < models_.size())
        json[name] = list(part(means, bem(), pressures_.size()));
    if (const std::string errors =
            "damping/ensemble_" + without_slip("damping_constant") + "_error_mean";
        has(errors) && bem() < models_.size() && json.contains("curve"))
      json["curve"]["damping_constant"]["bem"]["error"] =
          list(part(errors, bem(), pressures_.size()));
    for (const char* name : {"deviation_min", "deviation_max"})
      if (has(std::string("damping/") + name) && bem() < models_.size())
        json[name] = number(part(std::string("damping/") + name, bem(), 1)[0]);
    for (const char* name : {"mode", "hold", "tangential_stiffness", "interval_method"})
      if (const auto text = file_.text_attribute(where_ + "damping", name)) json[name] = *text;
    for (const char* name :
         {"normal_amplitude", "angular_frequency", "drag_velocity", "tangential_amplitude", "phase",
          "modulus_ratio", "contact_modulus", "friction_coefficient"})
      if (const auto value = file_.number_attribute(where_ + "damping", name))
        json[name] = number(*value);
    if (const double direction = attribute("damping", "direction"); !std::isnan(direction))
      json["direction_in_words"] = direction_in_words(direction);
    return json;
  }

  /// Adhesive contact: the pull-off pressure, and the work lost in a loading cycle.
  Json adhesion() const {
    Json json;
    for (const char* name :
         {"pull_off_pressure", "pull_off_error", "adhesion_work_per_cycle", "adhesion_work_error"})
      for (const char* member : {"mean", "low", "high"})
        if (const auto value = file_.number_attribute(where_ + "adhesion",
                                                      fmt::format("ensemble_{}_{}", name, member)))
          json[name][member] = number(*value);
    return json;
  }

  /// Numbers and texts with which the page can judge the assumptions for a motion that the reader
  /// enters.
  Json assumptions() const {
    Json json;
    for (const AssumptionName& name : assumption_names()) {
      const std::string location = "assumptions/" + std::string(name.name);
      if (!has(location + "_verdict")) continue;
      Json& assumption = json[std::string(name.name)];
      assumption = {{"assumption", std::string(name.statement)},
                    {"here", std::string(name.here)},
                    {"remedy", std::string(name.remedy)},
                    {"unit", std::string(si_unit(name.value_dimension))},
                    {"value", list(required(location))},
                    {"verdict", list(required(location + "_verdict"))}};
      if (has(location + "_onset")) assumption["onset"] = list(required(location + "_onset"));
    }
    return json;
  }

  const Names models_;
  const std::vector<double> pressures_;
  const Bootstrap bootstrap_;
};

/// A name for each point of a parameter grid, made of the parameters that differ between the
/// points.
Names point_names(const ResultReader& file, std::size_t count) {
  Names names(count);
  for (const auto& [name, title] : {std::pair{"hurst", "H"},
                                    {"rolloff", "roll-off"},
                                    {"short_cutoff", "shortest wave"},
                                    {"size_x", "size"},
                                    {"nx", "points"}}) {
    const std::string path = std::string("ensemble/") + name;
    if (!file.has(path)) continue;
    const std::vector<double> values = file.numbers(path);
    if (values.size() != count ||
        std::ranges::count(values, values.front()) == std::ptrdiff_t(count))
      continue;
    const Dimension dimension = find_quantity(name).dimension;
    for (std::size_t i = 0; i < count; ++i) {
      if (std::isnan(values[i])) continue;
      names[i] += fmt::format("{}{} = {}", names[i].empty() ? "" : ", ", title,
                              format_quantity(values[i], dimension));
    }
  }
  return names;
}

}  // namespace

Json report_payload(const ResultReader& results) {
  Names where;
  if (results.has("curve/model")) {
    where = {""};
  } else if (results.has("points")) {
    for (std::size_t i = 0; i < results.groups("points").size(); ++i)
      where.push_back(fmt::format("points/{}/", i));
  }
  if (where.empty())
    throw InvalidInput(results.file().string(),
                       "does not contain a study; give the result file of a study or comparison");
  Json json;
  for (const char* name : {"program", "version", "revision", "libraries", "started", "created",
                           "command_line", "configuration"})
    if (const auto text = results.text_attribute("/", name)) json["provenance"][name] = *text;
  if (where.size() > 1) {
    const Names names = point_names(results, where.size());
    json["names"] = names;
    if (results.has("ensemble/ensemble_decay_length_over_rms_height_mean"))
      json["figures"] = grid_figures(results, names);
  }
  const auto side = Index(std::sqrt(map_budget / double(where.size())));
  json["points"] = Json::array();
  for (const std::string& location : where)
    json["points"].push_back(Point(results, location).payload(std::max<Index>(side, 32)));
  return json;
}

void add_direct(Json& payload, const ResultReader& oscillation) {
  const std::string file = oscillation.file().string();
  if (payload["points"].size() != 1 || !payload["points"][0].contains("damping"))
    throw InvalidInput(
        file, "cannot be combined with these results, which have no damping or several points");
  Json& damping = payload["points"][0]["damping"];
  // A simulated cycle contains the smallest and the largest indentation; the nodes of a quadrature
  // end a little before both, so the cycle is preferred.
  const bool stepped = oscillation.has("cycle/indentation");
  const std::string group = stepped ? "cycle" : "intervals";
  // Steps store the force as that of a cycle, contacts of a quadrature as that of a force curve.
  const std::string forces = group + (stepped ? "/normal_force" : "/force");
  if (!oscillation.has(group + "/indentation") || !oscillation.has(forces) ||
      !oscillation.number_attribute(group, "work_per_cycle"))
    throw InvalidInput(
        file, "does not contain an oscillation; give the result file of a simulated cycle");
  const std::vector<double> indentation = oscillation.numbers(group + "/indentation"),
                            force = oscillation.numbers(forces);
  if (indentation.size() != force.size() || indentation.size() < 2)
    throw InvalidInput(file, "has forces that do not match its indentations; it is damaged");
  const auto [low, high] = std::ranges::minmax(indentation);
  const double amplitude = (high - low) / 2, middle = (high + low) / 2;
  const Json& stated = damping["normal_amplitude"];
  const double wanted = stated.is_number() ? stated.number() : ForceSample::unknown;
  if (!(std::abs(amplitude / wanted - 1) < (stepped ? 0.02 : 0.2)))
    throw InvalidInput(file, fmt::format("oscillates by {}, but the study by {}; give direct "
                                         "results for the motion of the study",
                                         format_quantity(amplitude, Dimension::length),
                                         format_quantity(wanted, Dimension::length)));
  double mean_force = ForceSample::unknown;
  for (std::size_t i = 1; i < force.size(); ++i) {
    const double before = indentation[i - 1] - middle, after = indentation[i] - middle;
    if (before * after > 0 || before == after) continue;
    mean_force = force[i - 1] + (force[i] - force[i - 1]) * before / (before - after);
    break;
  }
  const double work = *oscillation.number_attribute(group, "work_per_cycle");
  damping["direct"].push_back({{"file", oscillation.file().filename().string()},
                               {"force", number(mean_force)},
                               {"work_per_cycle", number(work)}});
  for (Json& figure : payload["points"][0]["figures"].elements()) {
    if (figure["kind"].text() != "damping-curve") continue;
    Json& panel = figure["panels"][0];
    panel["curves"].push_back(
        {{"name", "direct simulation"},
         {"quantity", "damping_constant"},
         {"x", list(std::vector{mean_force / panel["second_x"]["factor"].number()})},
         {"y", list(std::vector{work / panel["second_y"]["factor"].number()})},
         {"low", Json::array()},
         {"high", Json::array()},
         {"style", "points"},
         {"color", 8}});
  }
}

}  // namespace salebra::detail
