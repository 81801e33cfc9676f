// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of quantities and maps over grids.
#include "axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <salebra/analysis/damping.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/assumption_verdicts.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/study/realisation.hpp>

#include "display_axis.hpp"
#include "results/columns.hpp"
#include "results/describe.hpp"

namespace salebra::figures {

namespace {

std::string unit_of(Dimension dimension) {
  const std::string unit(si_unit(dimension));
  return unit == "1" ? "" : unit;
}

}  // namespace

Axis axis_of(std::string_view name, bool logarithmic, std::string_view label) {
  Quantity quantity = find_quantity(name);
  if (!is_quantity(name))
    if (const Column* own = find_column<DampingProblem, DampingSolution, SpotStatistics>(name))
      quantity = {own->name, own->dimension, own->long_name};
  // No described struct has frequencies, which are angular in all of them.
  for (const auto& [frequency, meaning] :
       {std::pair("frequency", "frequency of the normal motion"),
        {"tangential_frequency", "frequency of the tangential motion"}})
    if (name == frequency) quantity = {frequency, Dimension::frequency, meaning};
  // Terms and symbols of the glossary, the same in all figures.
  constexpr auto terms = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"damping_constant", "damping constant γ"},
       {"drag_velocity", "velocity v of the slow shear"},
       {"excursion", "excursion X"},
       {"force", "normal force F"},
       {"friction_coefficient", "coefficient of friction µ"},
       {"indentation", "indentation δ"},
       {"mean_gap", "mean gap ū"},
       {"normal_amplitude", "normal amplitude u_z"},
       {"phase", "phase φ_0"},
       {"pressure", "nominal pressure p"},
       {"tangential_amplitude", "tangential amplitude u_x"},
       {"tangential_force", "tangential force F_x"},
       {"velocity", "sliding velocity v"},
       {"work_per_cycle", "loss W"}});
  if (const auto term = std::ranges::find(terms, name, [](const auto& one) { return one.first; });
      label.empty() && term != terms.end())
    label = term->second;
  return {.quantity = std::string(name),
          .label = !label.empty()
                       ? std::string(label)
                       : plain_text(quantity.long_name.empty() ? name : quantity.long_name),
          .unit = unit_of(quantity.dimension),
          .logarithmic = logarithmic};
}

std::string motion_text(const Motion& motion, std::string_view varied, double excursion) {
  const auto with = [&](const char* before, std::string_view name, double value,
                        Dimension dimension) {
    return name == varied || std::isnan(value)
               ? std::string()
               : before + (dimension == Dimension::angle
                               ? fmt::format("{:.4g}°", value * 180 / std::numbers::pi)
                               : format_quantity(value, dimension, 4));
  };
  const auto at = [&](std::string_view name, double angular_frequency) {
    return angular_frequency > 0 ? with(" at ", name, angular_frequency / (2 * std::numbers::pi),
                                        Dimension::frequency)
                                 : "";
  };
  if (const auto* drag = std::get_if<Drag>(&motion))
    return "slow shear" + with(" over ", "excursion", excursion, Dimension::length) +
           with(" at ", "drag_velocity", drag->drag_velocity, Dimension::velocity) +
           with(" under ", "normal_amplitude", drag->normal_amplitude, Dimension::length) +
           at("angular_frequency", drag->angular_frequency);
  std::vector<std::string> parts;
  const auto add = [&](std::string text, const char* what, const std::string& frequency) {
    if (!text.empty()) parts.push_back(text + what + frequency);
  };
  const auto add_both = [&](const auto& one, const std::string& normal,
                            const std::string& tangential) {
    add(with("", "tangential_amplitude", one.tangential_amplitude, Dimension::length),
        " tangential", tangential);
    add(with("", "normal_amplitude", one.normal_amplitude, Dimension::length), " normal", normal);
    const std::string apart = with(", ", "phase", one.phase, Dimension::angle);
    return fmt::format("{}{}", fmt::join(parts, " and "), apart.empty() ? "" : apart + " apart");
  };
  if (const auto* two = std::get_if<TwoFrequencies>(&motion))
    return add_both(*two, at("normal_angular_frequency", two->normal_angular_frequency),
                    at("tangential_angular_frequency", two->tangential_angular_frequency));
  const auto& equal = std::get<EqualFrequency>(motion);
  const std::string frequency = at("angular_frequency", equal.angular_frequency);
  return add_both(equal, "", "") + (frequency.empty() ? "" : "," + frequency);
}

std::string setting_text(const std::string& motion, double friction_coefficient, double force) {
  std::string text = " Motion: " + motion;
  text += std::isfinite(friction_coefficient) ? fmt::format(", µ = {:.3g}", friction_coefficient)
                                              : ", no slip";
  if (!std::isnan(force)) text += ", F = " + format_quantity(force, Dimension::force, 4);
  return text;
}

std::string value_text(double value, const std::string& in) {
  if (std::isnan(value)) return "n/a";
  const auto [unit, factor] = prefixed(in, std::abs(value));
  return fmt::format("{:.3g}{}{}", value * factor, unit.empty() ? "" : " ", unit);
}

std::string interval_text(double value, double low, double high, Dimension dimension) {
  const std::string text = value_text(value, unit_of(dimension));
  if (!std::isfinite(low) || !std::isfinite(high)) return text;
  const double factor = prefixed(unit_of(dimension), std::abs(value)).second;
  return fmt::format("{} ({:.3g} … {:.3g})", text, low * factor, high * factor);
}

std::string error_text(double value, double error, Dimension dimension) {
  const std::string text = value_text(value, unit_of(dimension));
  if (!std::isfinite(error) || !std::isfinite(value)) return text;
  if (error >= std::abs(value))
    return "below its error of " + value_text(error, unit_of(dimension));
  return fmt::format("{} ± {:.2g} %", text, 100 * error / std::abs(value));
}

std::string validity_text(std::span<const AssumptionVerdict> verdicts) {
  const Validity validity = validity_of(verdicts);
  if (validity == Validity::valid) return "";
  if (validity == Validity::not_checked) return "validity not checked";
  const AssumptionVerdict& worst = verdicts.front();
  const auto known = std::ranges::find(assumption_names(), worst.name, &AssumptionName::name);
  // "γ = µF/v: Coulomb friction, not a damper; at all loads" gives the reason in its middle.
  const std::string& here = worst.here;
  std::string reason = worst.assumption;
  if (known != assumption_names().end())
    reason = known->meaning;
  else if (const auto colon = here.find(": "); colon != std::string::npos)
    reason = here.substr(colon + 2, here.find(';') - colon - 2);
  return fmt::format("{}: {}", name_of(validity), reason);
}

void state_validity(Figure& figure, std::span<const AssumptionVerdict> verdicts) {
  std::string text = verdicts.empty() ? "validity not checked" : validity_text(verdicts);
  if (text.empty()) return;
  bool stated = false;
  for (Panel& panel : figure.panels)
    if (std::ranges::any_of(std::array{"γ = ", "Γ = ", "W = "}, [&](const char* headline) {
          return panel.title.find(headline) != std::string::npos;
        })) {
      panel.title += " (" + text + ")";
      stated = true;
    }
  if (stated) return;
  text[0] -= 'a' - 'A';
  figure.caption += " " + text + ".";
}

void state_validity(Figure& figure, std::span<const Assumptions> cases, bool slip_followed) {
  state_validity(
      figure, cases.empty() ? std::vector<AssumptionVerdict>() : verdicts_of(cases, slip_followed));
}

std::string poor_law(const LawDescription& law) {
  return law.fair ? "" : " (poor law: do not use Eq. (16))";
}

std::string title_of(std::string_view name) {
  const auto model = std::ranges::find(contact_models(), name, &StudyModel::name);
  return model == contact_models().end() ? plain_text(name) : model->title;
}

bool spans_decades(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return low > 0 && high > 30 * low;
}

bool grows_by_factors(const std::vector<double>& values) {
  if (spans_decades(values)) return true;
  if (values.size() < 4 || !(values[0] > 0) || !(values[1] > 1.2 * values[0])) return false;
  const double factor = values[1] / values[0];
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(std::abs(values[k] / values[k - 1] / factor - 1) < 1e-6)) return false;
  return true;
}

std::vector<double> cells(Index count, double step) {
  std::vector<double> centres = positions(count, step);
  for (double& centre : centres) centre += 0.5 * step;
  return centres;
}

Panel map_panel(const Grid2D& grid, const Field& values, const std::string& title,
                const Axis& scale) {
  return {.title = title,
          .x = {.label = "x", .unit = "m", .prefix_of = grid.lx},
          .y = {.label = "y", .unit = "m", .prefix_of = grid.lx},
          .image = Image{.x = cells(grid.nx, grid.dx()),
                         .y = cells(grid.ny, grid.dy()),
                         .values = values,
                         .scale = scale},
          .equal_scales = true};
}

}  // namespace salebra::figures
