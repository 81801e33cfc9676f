// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of `study`, `compare` and reports: curves of all models with 95 % bands.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <salebra/damping/closed_form.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/study/sensitivity.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>
#include <salebra/surface/lay.hpp>
#include <set>

#include "axes.hpp"
#include "study/estimate.hpp"
#include "study_numbers.hpp"

namespace salebra::figures {
namespace {

using Means = std::vector<EnsembleMean>;

/// Surfaces whose curves are drawn singly; more would only blur the picture.
constexpr std::size_t max_single_curves = 24;
/// Models whose bands are drawn; those of more would hide each other.
constexpr std::size_t few_models = 4;

std::vector<double> column(const Means& estimates, double EnsembleMean::*member) {
  std::vector<double> values;
  for (const EnsembleMean& estimate : estimates) values.push_back(estimate.*member);
  return values;
}

Curve band(const std::string& name, const std::vector<double>& x, const Means& y, int color,
           Style style = Style::line) {
  return {.name = name,
          .x = x,
          .y = column(y, &EnsembleMean::mean),
          .low = column(y, &EnsembleMean::low),
          .high = column(y, &EnsembleMean::high),
          .style = style,
          .color = color};
}

EnsembleMean mean_of(const StudyNumbers& numbers, const std::vector<double>& values) {
  return numbers.twin ? prediction(values) : Bootstrap().mean(values);
}

/// Means over the surfaces of a number at each pressure.
Means at_pressures(const StudyNumbers& numbers,
                   const std::function<double(std::size_t surface, std::size_t k)>& number) {
  Means means;
  for (std::size_t k = 0; k < numbers.pressures.size(); ++k) {
    std::vector<double> values;
    for (std::size_t i = 0; i < numbers.rms_height.size(); ++i) values.push_back(number(i, k));
    means.push_back(mean_of(numbers, values));
  }
  return means;
}

bool have_limits(const std::vector<StatedMean>& means) {
  return std::ranges::any_of(means, [](const StatedMean& one) { return std::isfinite(one.low); });
}

/// Points with the 95 % interval over the surfaces or, for one surface, the numerical error.
Curve points_of(const std::string& name, const std::vector<double>& x,
                const std::vector<StatedMean>& means, const char* quantity = "damping_constant") {
  Curve points{.name = name, .quantity = quantity, .x = x, .style = Style::points, .color = 0};
  const bool limits = have_limits(means);
  for (const StatedMean& one : means) {
    const double low = limits ? one.low : one.mean - one.error;
    points.y.push_back(one.mean);
    // A point without a bar is drawn too.
    points.low.push_back(std::isnan(low) ? one.mean : low);
    points.high.push_back(std::isnan(low) ? one.mean : limits ? one.high : one.mean + one.error);
  }
  return points;
}

/// Adds γ of the motion as the user described it, with the same numbers as the table of the study.
void add_answer(const StudyNumbers& numbers, Panel& damping) {
  const std::vector<StatedMean>& means = numbers.damping_constant;
  const auto last = std::ranges::find_if(
      means.rbegin(), means.rend(), [](const StatedMean& one) { return std::isfinite(one.mean); });
  if (last == means.rend()) return;
  const bool limits = have_limits(means);
  const auto at = std::size_t(means.rend() - last) - 1;
  const auto text = [&](const StatedMean& one) {
    if (!limits) return error_text(one.mean, one.error, Dimension::damping);
    const std::string interval = interval_text(one.mean, one.low, one.high, Dimension::damping);
    return one.error > 0 ? fmt::format("{}, numerical error {:.2g} %", interval,
                                       100 * one.error / std::abs(one.mean))
                         : interval;
  };
  const bool several = !numbers.other_directions.empty();
  const auto way = [&](double direction) {
    return several ? " " + direction_in_words(direction) : std::string();
  };
  // The headline of the table: γ at the highest pressure at which it is known.
  damping.title = "γ = " + text(*last) + way(numbers.direction);
  for (const auto& [direction, others] : numbers.other_directions)
    damping.title += ", " + text(others.at(at)) + way(direction);
  damping.title += (several ? ", at " : " at ") +
                   format_quantity(numbers.pressures[at], Dimension::pressure, 3) +
                   (numbers.validity.empty() ? "" : " (" + numbers.validity + ")");
  damping.y.prefix_of = last->mean;
  const bool errors = std::ranges::any_of(
      means, [](const StatedMean& one) { return !std::isnan(one.mean - one.error); });
  const std::string name =
      (numbers.slips ? fmt::format("with slip, µ = {:g}", numbers.friction_coefficient)
                     : "without slip");
  const std::string bars = limits ? ", 95 % interval" : errors ? ", ± error" : "";
  damping.curves.push_back(
      points_of(name + way(numbers.direction) + bars, numbers.pressures, means));
  for (const auto& [direction, others] : numbers.other_directions) {
    damping.curves.push_back(points_of(name + way(direction) + bars, numbers.pressures, others));
    damping.curves.back().color = 8;
  }
}

/// Leaves out values that are far from all others: those of the curvature of a curve may be.
std::vector<double> near(std::vector<double> values, const std::vector<Curve>& others) {
  double low = HUGE_VAL, high = 0;
  for (const Curve& curve : others)
    if (curve.color == 0 || curve.color == 7)
      for (const double value : curve.y)
        if (value > 0) {
          low = std::min(low, value);
          high = std::max(high, value);
        }
  for (double& value : values)
    if (!(value > low / 5 && value < 5 * high)) value = StudyNumbers::unknown;
  return values;
}

/// Whether a panel has a finite value to show; false if no model computes its quantity.
bool shows_anything(const Panel& panel) {
  return std::ranges::any_of(panel.curves, [&](const Curve& curve) {
    return std::ranges::any_of(curve.y, [&](double value) {
      return std::isfinite(value) && (value > 0 || !panel.y.logarithmic);
    });
  });
}

/// Gives panels the same scale and limits along y.
void share_limits(const std::vector<Panel*>& panels) {
  const bool logarithmic =
      std::ranges::all_of(panels, [](const Panel* panel) { return panel->y.logarithmic; });
  for (Panel* panel : panels) panel->y.logarithmic = logarithmic;
  set_limits(panels, &Panel::y);
}

/// Makes the pictures of one point of the parameter grid.
class Pictures {
 public:
  explicit Pictures(const StudyNumbers& numbers)
      : n_(numbers), slope_of_(numbers.contact_modulus) {}

  std::vector<Figure> all() {
    of_gap();
    of_curves("area-load", "Contact area",
              "True contact area over load. Summits of Greenwood–Williamson models do not interact "
              "unless the model says so. The theories (thin lines) hold for small loads. On a grid "
              "the contact area is too large by about half of the cells at its edge; the dotted "
              "curve is corrected for this.",
              "area over load, A E^{*}h'/F", [this](std::size_t i, const ForceSample& sample) {
                return sample.contact_area_fraction / sample.pressure * n_.rms_slope[i] * slope_of_;
              });
    add_theories(pictures_.back().panels.front());
    if (n_.motion) of_damping();
    of_curves(
        "stiffness-load", "Normal stiffness",
        "Normal stiffness over force, in units of 1/h_{rms}. For an exponential law it is the "
        "constant h_{rms}/l.",
        "stiffness K h_{rms}/F", [this](std::size_t i, const ForceSample& sample) {
          return sample.normal_stiffness * n_.rms_height[i] / sample.force;
        });
    of_curves("stiffness-ratio", "Tangential over normal stiffness",
              "The closed forms assume K_t = (G^{*}/E^{*})K, which holds for circular spots; "
              "stiffnesses computed for the real contacts show how accurate that is here.",
              "stiffness ratio K_t/K", [](std::size_t, const ForceSample& sample) {
                return sample.tangential_stiffness / sample.normal_stiffness;
              });
    finish_ratio(pictures_.back().panels.front());
    of_lengths();
    if (n_.motion) of_ratios();
    std::erase_if(pictures_,
                  [](const Figure& picture) { return !shows_anything(picture.panels.front()); });
    if (n_.models.size() > few_models)
      for (Figure& picture : pictures_)
        for (Curve& curve : picture.panels.front().curves)
          if (curve.style == Style::line_and_points && curve.color != int(ContactModel::bem))
            curve.low = curve.high = {};
    return std::move(pictures_);
  }

 private:
  Panel& add(const char* kind, const char* title, std::string caption, Axis y) {
    Panel panel{.x = axis_of("pressure", true, "nominal pressure p"), .y = std::move(y)};
    if (std::isfinite(n_.contact_scale))
      panel.second_x = SecondAxis{.label = "p/(E^{*}h')", .factor = 1 / n_.contact_scale};
    pictures_.push_back({.kind = kind,
                         .title = title,
                         .caption = std::move(caption),
                         .panels = {std::move(panel)}});
    return pictures_.back().panels.front();
  }

  /// A number of the force curve of each model over the pressure.
  Panel& of_curves(const char* kind, const char* title, std::string caption, const char* label,
                   const std::function<double(std::size_t, const ForceSample&)>& number) {
    Panel& panel = add(kind, title, std::move(caption), {.label = label});
    for (const StudyNumbers::Model& model : n_.models)
      panel.curves.push_back(
          band(model.title, n_.pressures,
               at_pressures(n_,
                            [&](std::size_t i, std::size_t k) {
                              const auto& samples = model.curves[i];
                              if (k >= samples.size() || !samples[k].converged) return n_.unknown;
                              ForceSample sample = samples[k];
                              sample.pressure = n_.pressures[k];  // without the rounding of its sum
                              return number(i, sample);
                            }),
               model.color, Style::line_and_points));
    // Where adhesion holds surfaces together, a number over the load grows without limit.
    std::vector<double> values = panel.curves.empty() ? std::vector<double>() : panel.curves[0].y;
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    panel.y.logarithmic = !values.empty() && spans_decades(values);
    return panel;
  }

  void of_gap() {
    Panel& panel = of_curves(
        "gap-load", "Mean gap",
        "Mean gap of the deformed surfaces. A straight line means an exponential law, of which the "
        "slope is −l/h_{rms}; the dashed line is the one fitted to the boundary elements in the "
        "shaded window.",
        "mean gap ū/h_{rms}", [this](std::size_t i, const ForceSample& sample) {
          return sample.mean_gap / n_.rms_height[i];
        });
    panel.y.quantity = "mean_gap_over_rms_height";
    panel.legend = Legend::bottom_left;
    const EnsembleMean length = decay_length();
    if (!std::isfinite(length.mean)) return;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < n_.fits.size(); ++i)
      ratios.push_back(n_.fits[i].decay_length / n_.rms_height[i]);
    panel.title =
        fmt::format("decay length l = {} = {:.3g} h_{{rms}}{}",
                    interval_text(length.mean, length.low, length.high, Dimension::length),
                    mean_of(n_, ratios).mean, n_.law);
    const auto window = [&](double PressureWindow::*end) {
      std::vector<double> ends;
      for (const ExponentialFit& fit : n_.fits) ends.push_back(fit.window.*end);
      return mean_of(n_, ends).mean;
    };
    panel.ranges = {{.low = window(&PressureWindow::pressure_min),
                     .high = window(&PressureWindow::pressure_max),
                     .vertical = true,
                     .name = "window of the fit"}};
    Curve law = band("exponential law, fitted", n_.pressures,
                     at_pressures(n_,
                                  [this](std::size_t i, std::size_t k) {
                                    const ExponentialFit& fit = n_.fits[i];
                                    return fit.decay_length / n_.rms_height[i] *
                                           std::log(fit.reference_pressure / n_.pressures[k]);
                                  }),
                     7, Style::dashed);
    law.quantity = "fitted_gap_over_rms_height";
    law.low = law.high = {};
    panel.curves.push_back(std::move(law));
  }

  /// The limits of theories for vanishing load, and the area without the cells in excess.
  void add_theories(Panel& panel) {
    panel.lines = {{.at = std::sqrt(2 * std::numbers::pi), .name = "Bush, Gibson, Thomas"}};
    if (std::ranges::none_of(n_.models, [](const StudyNumbers::Model& model) {
          return model.color == int(ContactModel::persson);
        }))
      panel.lines.push_back({.at = std::sqrt(8 / std::numbers::pi), .name = "Persson"});
    if (!n_.corrected_area_fraction.empty())
      panel.curves.push_back(band("boundary elements, less the edge", n_.pressures,
                                  at_pressures(n_,
                                               [this](std::size_t i, std::size_t k) {
                                                 return n_.corrected_area_fraction[i][k] /
                                                        n_.pressures[k] * n_.rms_slope[i] *
                                                        slope_of_;
                                               }),
                                  0, Style::dotted));
  }

  void of_damping() {
    const bool drag = std::holds_alternative<Drag>(*n_.motion);
    const char *fitted = "exponential law, fitted",
               *small = drag ? "Eq. (15), F″ of the curve" : "Eq. (12), F″ of the curve";
    Panel& panel = add(
        "damping-curve", "Damping",
        "Damping constant, as points for the motion as described; lines are without slip: by the "
        "theorem W = ½∮s²dK_t, which holds at any amplitude, by the closed form with the fitted "
        "law "
        "(dashed), and by the same form with the curvature of the boundary elements (dotted; "
        "points "
        "far from all others are left out). No value is shown where the curve of a model does not "
        "cover the cycle or the error is larger than the value." +
            std::string(" ") + motion_sentence(n_),
        axis_of("damping_constant", true, "damping constant γ"));
    panel.second_x = SecondAxis{.label = "normal force F", .unit = "N", .factor = n_.nominal_area};
    if (const double constant = closed_form::damping_constant(1, *n_.motion);
        std::isfinite(constant))
      panel.second_y = SecondAxis{.label = "work per cycle W", .unit = "J", .factor = 1 / constant};
    panel.legend = Legend::top_left;
    for (const StudyNumbers::Model& model : n_.models)
      panel.curves.push_back(
          band(model.title, n_.pressures, model.damping_constant, model.color,
               // The points in the same colour are those of the motion as described.
               model.color == int(ContactModel::bem) ? Style::line : Style::line_and_points));
    Curve law = band(fitted, n_.pressures, n_.closed_form, 7, Style::dashed);
    law.low = law.high = {};
    law.quantity = "damping_constant_closed_form";
    panel.curves.push_back(std::move(law));
    add_answer(n_, panel);
    Curve curvature = band(small, n_.pressures, n_.small_amplitude, 7, Style::dotted);
    curvature.low = curvature.high = {};
    curvature.quantity = "small_amplitude_damping_constant";
    curvature.y = near(std::move(curvature.y), panel.curves);
    panel.curves.push_back(std::move(curvature));
  }

  /// A ratio that a model does not compute but takes from the moduli is no result.
  void finish_ratio(Panel& panel) {
    panel.lines = {{.at = n_.modulus_ratio, .name = "G^{*}/E^{*}", .quantity = "modulus_ratio"}};
    std::erase_if(panel.curves, [&](const Curve& curve) {
      return std::ranges::none_of(
          curve.y, [&](double value) { return std::abs(value - n_.modulus_ratio) > 1e-6 * value; });
    });
  }

  EnsembleMean decay_length() const {
    std::vector<double> lengths;
    for (const ExponentialFit& fit : n_.fits) lengths.push_back(fit.decay_length);
    return mean_of(n_, lengths);
  }

  void of_lengths() {
    Panel& panel = add("local-length", "Local decay length",
                       "Local decay length of each surface between neighbouring loads. An "
                       "exponential law gives a horizontal line.",
                       axis_of("local_decay_length", false, "decay length −dū/d ln p"));
    panel.x = axis_of("mean_gap", false, "mean gap ū");
    panel.second_x = {};
    if (const double length = decay_length().mean; std::isfinite(length))
      panel.lines = {{.at = length, .name = "l of the fit", .quantity = "decay_length"}};
    for (std::size_t i = 0; i < std::min(n_.local.size(), max_single_curves); ++i)
      panel.curves.push_back({.name = i > 0 || n_.local.size() == 1 ? "" : "each surface",
                              .x = n_.local[i].mean_gap,
                              .y = n_.local[i].decay_length,
                              .style = Style::line_and_points,
                              .color = 0});
  }

  void of_ratios() {
    Panel& panel = add("damping-ratio", "Damping over that of boundary elements",
                       "Damping without slip over that computed for the boundary elements of the "
                       "same surfaces: by the closed form with the fitted law (dashed), and from "
                       "the force curves of other models. It shows the error of using either." +
                           std::string(" ") + motion_sentence(n_),
                       {.label = "γ over that of BEM"});
    Means ratio = n_.deviation;
    for (EnsembleMean& one : ratio) one = {one.mean + 1, one.low + 1, one.high + 1};
    panel.curves.push_back(band("exponential law, fitted", n_.pressures, ratio, 7, Style::dashed));
    for (const StudyNumbers::Model& model : n_.models)
      if (model.color != int(ContactModel::bem))
        panel.curves.push_back(
            band(model.title, n_.pressures, model.over_bem, model.color, Style::line_and_points));
    std::vector<double> values;
    for (const Curve& curve : panel.curves)
      std::ranges::copy_if(curve.y, std::back_inserter(values),
                           [](double value) { return std::isfinite(value); });
    panel.y.logarithmic = !values.empty() && spans_decades(values);
    panel.lines = {{.at = 1, .name = "equal to BEM"}};
  }

  const StudyNumbers& n_;
  const double slope_of_;  ///< E*, which makes h' a pressure
  std::vector<Figure> pictures_ = {};
};

}  // namespace

std::string motion_sentence(const StudyNumbers& numbers) {
  return "Motion: " +
         std::visit([&](const auto& motion) { return motion_text(motion, {}, numbers.excursion); },
                    *numbers.motion) +
         (numbers.hold == Hold::indentation ? ", mean indentation held"
          : numbers.hold == Hold::force     ? ", mean force held"
                                            : ", mean force held where the contact lifts off") +
         (std::isnan(numbers.direction) || !numbers.other_directions.empty()
              ? ""
              : ", " + direction_in_words(numbers.direction)) +
         (std::isnan(numbers.friction_coefficient)
              ? ", without slip"
              : fmt::format(", µ = {:g}", numbers.friction_coefficient)) +
         "." +
         (numbers.other_directions.empty()
              ? ""
              : " Lines are of the motion " + direction_in_words(numbers.direction) + ".");
}

StudyNumbers numbers_of(const StudyResult& result) {
  const StudyConfiguration& configuration = result.configuration;
  StudyNumbers numbers{.pressures = result.pressures,
                       .nominal_area = result.grid.area(),
                       .contact_modulus = configuration.material.contact_modulus,
                       .modulus_ratio = configuration.pressed().modulus_ratio(),
                       .contact_scale = result.contact_scale,
                       .twin = configuration.of_twin()};
  for (const StudyModel& model : result.models()) {
    auto& one = numbers.models.emplace_back(
        StudyNumbers::Model{.color = int(model.id), .title = model.title});
    for (const Realisation& surface : result.realisations)
      one.curves.push_back(surface.of(model.id).curve.samples);
    if (configuration.adhesion) continue;
    one.damping_constant = result.damping("damping_constant_without_slip", model.id);
    one.over_bem = result.damping_over_bem(&DampingPoint::work_per_cycle_without_slip, model.id);
  }
  for (const Realisation& surface : result.realisations) {
    const ModelResult& bem = surface.of(ContactModel::bem);
    numbers.rms_height.push_back(surface.heights.rms_height);
    numbers.rms_slope.push_back(surface.moments.rms_slope());
    numbers.fits.push_back(bem.fit);
    numbers.local.push_back(bem.local);
    auto& corrected = numbers.corrected_area_fraction.emplace_back();
    for (const SpotStatistics& spots : surface.spots)
      corrected.push_back(spots.corrected_area_fraction);
  }
  if (const auto law = result.law_description()) numbers.law = poor_law(*law);
  if (configuration.adhesion) return numbers;
  const StudySolution answer = solution_of(result);
  numbers.motion = configuration.motion;
  numbers.hold = configuration.hold();
  numbers.excursion = configuration.known.excursion;
  numbers.friction_coefficient = configuration.known.friction_coefficient;
  numbers.direction = answer.direction;
  numbers.slips = answer.slips();
  numbers.damping_constant = answer.damping_constant;
  const std::vector<StudyResult> directions = result.in_directions();
  for (std::size_t k = 1; k < directions.size(); ++k) {
    StudySolution other = solution_of(directions[k]);
    numbers.other_directions.emplace_back(other.direction, std::move(other.damping_constant));
  }
  numbers.validity = validity_text(answer.verdicts);
  numbers.closed_form = result.damping("damping_constant_closed_form");
  numbers.small_amplitude = result.damping("small_amplitude_damping_constant");
  numbers.deviation = result.deviation();
  return numbers;
}

std::vector<Figure> study_pictures(const StudyNumbers& numbers) { return Pictures(numbers).all(); }

Figure figure_of(const std::vector<StudyResult>& results, const ParameterLists& varied) {
  Figure figure{.kind = "study", .one_legend = true};
  constexpr std::array<std::string_view, 4> details{"stiffness-load", "stiffness-ratio",
                                                    "local-length", "damping-ratio"};
  figure.columns = results.size() == 1 ? 2 : int(results.size());
  std::vector<std::vector<Figure>> points;
  std::vector<StudyNumbers> answers;
  for (const StudyResult& result : results) {
    answers.push_back(numbers_of(result));
    points.push_back(study_pictures(answers.back()));
  }
  for (const Figure& first : points.front()) {
    std::vector<Panel*> row;
    for (std::vector<Figure>& point : points)
      if (const auto same = std::ranges::find(point, first.kind, &Figure::kind);
          same != point.end())
        row.push_back(&same->panels.front());
    // What a point cannot compute is not compared.
    if (row.size() < points.size()) continue;
    if (row.size() > 1) share_limits(row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      Panel& panel = *row[i];
      if (i == 0)
        panel.caption =
            first.title + (first.kind != "damping-curve" ? "."
                           : answers.front().slips
                               ? ": points, of the motion as described; lines, without slip."
                               : ": points, with the error of the surface; lines, by models.");
      else
        for (ReferenceLine& line : panel.lines) line.name.clear();
      panel.detail = std::ranges::find(details, first.kind) != details.end();
      if (figure.panels.size() < row.size() && row.size() > 1)
        panel.title = describe_point(varied, results[i].configuration) +
                      (panel.title.empty() ? "" : ", " + panel.title);
      // One row has the second scale that all rows share.
      const bool first_row = figure.panels.size() < std::size_t(figure.columns);
      if (!first_row && panel.second_x && panel.second_x->unit.empty()) panel.second_x = {};
      figure.panels.push_back(panel);
    }
  }
  figure.caption =
      std::string("Contact models of rough surfaces, with ") +
      (results.front().realisations.size() == 1 ? "numerical errors of the damping constants; a "
                                                  "bar that is not seen is shorter than its "
                                                  "symbol."
       : results.front().models().size() > few_models
           ? "95 % bands of boundary elements over the surfaces, without numerical errors."
           : "95 % bands over the surfaces, without numerical errors.") +
      (results.front().configuration.adhesion ? "" : " " + motion_sentence(answers.front()));
  std::set<std::string> warned;
  const auto warn = [&](const std::string& name, const std::string& text) {
    if (warned.insert(name).second)
      figure.caption += " Warning: " + plain_text(text.substr(0, text.find(';'))) + ".";
  };
  for (const StudyResult& result : results) {
    for (const std::string& warning : result.warnings) warn(warning, warning);
    for (const EnsembleWarning& warning : result.ensemble_warnings)
      warn(warning.name, warning.text);
  }
  return figure;
}

Figure figure_of(const StudyResult& result) {
  return figure_of(std::vector<StudyResult>{result}, ParameterLists{});
}

Figure figure_of(const StudySolution& solution) {
  Panel panel{.x = axis_of("pressure", true, "nominal pressure p"),
              .y = axis_of("damping_constant", true, "damping constant γ"),
              .curves = {points_of(solution.slips() ? "with slip" : "without slip",
                                   solution.pressures, solution.damping_constant)},
              .legend = Legend::top_left};
  if (solution.slips()) {
    panel.curves.push_back(points_of("without slip", solution.pressures,
                                     solution.damping_constant_without_slip,
                                     "damping_constant_without_slip"));
    panel.curves.back().color = 1;
  }
  return {.kind = "study_solution", .panels = {panel}};
}

Figure figure_of(const StudySensitivity& found, std::size_t index) {
  const std::string load = format_quantity(found.pressures.at(index), Dimension::pressure, 3);
  Figure figure{.kind = "sensitivity",
                .caption = "What decides the results at a nominal pressure of " + load +
                           ": their response to the amplitude of each octave of waves, with 95 % "
                           "limits."};
  Panel panel{.title = "Response to waves at " + load,
              .x = {.label = "wavelength λ", .unit = "m", .logarithmic = true},
              .y = {.quantity = "sensitivity", .label = "d ln(result)/d ln(amplitude)"},
              .lines = {{.at = 0}},
              .legend = Legend::right_of_panel};
  for (const auto& [output, name] : {std::pair("mean_gap", "mean gap ū"),
                                     {"contact_area_fraction", "contact area A"},
                                     {"normal_stiffness", "stiffness K"},
                                     {"damping_constant", "damping constant γ"}}) {
    Curve curve{.name = name, .quantity = output, .style = Style::line_and_points};
    for (const ParameterSensitivity& one : found.parameters)
      for (const OutputSensitivity& response : one.outputs)
        if (one.parameter == "waves" && response.output == output) {
          const EnsembleMean& slope = response.at_pressures.at(index);
          // The first band has all shorter waves; it is drawn as the octave that ends it.
          const double shortest = one.shortest > 0 ? one.shortest : one.longest / 2;
          curve.x.push_back(std::sqrt(shortest * one.longest));
          curve.y.push_back(slope.mean);
          curve.low.push_back(slope.low);
          curve.high.push_back(slope.high);
        }
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
  if (!panel.curves.empty()) figure.panels.push_back(std::move(panel));
  return figure;
}

Figure figure_of(const StudySensitivity& found) {
  return figure_of(found, found.pressures.size() / 2);
}

}  // namespace salebra::figures
