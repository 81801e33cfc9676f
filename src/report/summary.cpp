// SPDX-License-Identifier: GPL-3.0-or-later
// Main results and verdict of a report as plain HTML, for readers without JavaScript.
#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <salebra/base/units.hpp>
#include <sstream>
#include <vector>

namespace salebra::detail {
namespace {

/// The member of a JSON object at the end of a path of names; nullptr if there is none.
const Json* find(const Json& object, const std::vector<std::string>& path) {
  const Json* inner = &object;
  for (const std::string& name : path) {
    if (!inner->is_object() || !inner->contains(name)) return nullptr;
    inner = &(*inner)[name];
  }
  return inner;
}

double number(const Json* value) {
  return value && value->is_number() ? value->number() : std::numeric_limits<double>::quiet_NaN();
}

std::string shown(const Json* value, Dimension dimension) {
  return format_quantity(number(value), dimension, 3);
}

std::string row(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, cell);
  return text + "</tr>";
}

/// Formats an estimate (mean, low, high) as "4.2 nm (95 %: 4.1 nm … 4.3 nm)".
std::string with_interval(const Json* estimate, Dimension dimension) {
  if (estimate == nullptr) return "n/a";
  std::string text = shown(find(*estimate, {"mean"}), dimension);
  const Json *low = find(*estimate, {"low"}), *high = find(*estimate, {"high"});
  if (!std::isnan(number(low)) && !std::isnan(number(high)))
    text += fmt::format(" (95 %: {} … {})", shown(low, dimension), shown(high, dimension));
  return text;
}

std::string law(const Json& point) {
  const Json* fit = find(point, {"fit", "models", "bem"});
  if (fit == nullptr) return "";
  std::string text = fmt::format(
      "<p>Decay length l of F ∝ exp(−ū/l): {}, {} times the rms height.</p>",
      with_interval(find(*fit, {"decay_length"}), Dimension::length),
      with_interval(find(*fit, {"decay_length_over_rms_height"}), Dimension::dimensionless));
  const double fair = number(find(*fit, {"fair"}));
  if (std::isnan(fair)) return text;
  return text + (fair > 0
                     ? "<p><strong>The law is a fair description.</strong></p>"
                     : "<p><strong>The law is a poor description.</strong> Do not use Eq. (16) "
                       "here; use the computed curve.</p>");
}

/// The overall verdict, and a paragraph for each line about an assumption.
std::string validity(const Json& point) {
  const Json* word = find(point, {"validity"});
  const Json* verdicts = find(point, {"verdicts"});
  if (word == nullptr || verdicts == nullptr) return "";
  std::string text = "<p><strong>Validity: " + escaped(word->text()) + ".</strong></p>";
  std::istringstream stream(verdicts->text());
  for (std::string line; std::getline(stream, line);) {
    std::erase(line, '`');
    if (!line.empty()) text += "<p>" + escaped(line) + "</p>";
  }
  return text;
}

std::string adhesion(const Json& point) {
  const Json* found = find(point, {"adhesion"});
  if (found == nullptr) return "";
  return fmt::format(
      "<p>Adhesion: pull-off at {}, by up to {} more (error of its steps); a cycle "
      "loses {} ± {} (error of its steps).</p>",
      with_interval(find(*found, {"pull_off_pressure"}), Dimension::pressure),
      shown(find(*found, {"pull_off_error", "mean"}), Dimension::pressure),
      with_interval(find(*found, {"adhesion_work_per_cycle"}), Dimension::energy),
      shown(find(*found, {"adhesion_work_error", "mean"}), Dimension::energy));
}

std::string damping(const Json& point) {
  const Json* forces = find(point, {"damping", "force"});
  const Json* pressures = find(point, {"pressure"});
  if (forces == nullptr || pressures == nullptr) return "";
  const auto column = [&](const char* route) {
    return find(point, {"damping", route, "damping_constant", "bem", "mean"});
  };
  const auto at = [](const Json* list, std::size_t i) {
    return list && i < list->size() ? &(*list)[i] : nullptr;
  };
  const Json* followed = find(point, {"slip_followed"});
  const bool slips = followed && followed->text() == "yes";
  std::vector<std::string> heads{"pressure", "force", "closed form, fitted l", "without slip"};
  const Json* regimes = find(point, {"solution", "regime"});
  const Json* max_forces = find(point, {"damping", "max_force"});
  const Json* contact_times = find(point, {"damping", "contact_time"});
  if (slips) heads.push_back("with slip");
  if (max_forces) heads.push_back("largest force");
  if (contact_times) heads.push_back("contact time");
  if (regimes) heads.push_back("regime");
  const Json* direction = find(point, {"damping", "direction_in_words"});
  std::string text = "<table><caption>Damping constant by boundary elements" +
                     (direction ? ", motion " + direction->text() : "") + "</caption><thead>" +
                     row(heads, "th") + "</thead><tbody>";
  for (std::size_t i = 0; i < forces->size(); ++i) {
    std::vector<std::string> cells{shown(at(pressures, i), Dimension::pressure),
                                   shown(at(forces, i), Dimension::force),
                                   shown(at(column("law"), i), Dimension::damping),
                                   shown(at(column("curve"), i), Dimension::damping)};
    if (slips)
      cells.push_back(
          shown(at(find(point, {"solution", "damping_constant", "mean"}), i), Dimension::damping));
    if (max_forces) cells.push_back(shown(at(max_forces, i), Dimension::force));
    if (contact_times) cells.push_back(shown(at(contact_times, i), Dimension::dimensionless));
    if (const Json* regime = at(regimes, i)) cells.push_back(regime->text());
    text += row(cells, "td");
  }
  return text + "</tbody></table>";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += letter;
    }
  }
  return result;
}

std::string summary_of(const Json& payload) {
  std::string text;
  std::size_t i = 0;
  for (const Json& point : payload["points"].elements()) {
    const bool several = payload["points"].size() > 1;
    text +=
        fmt::format("<section><h2>Results{}</h2>", several ? fmt::format(", point {}", ++i) : "");
    text += law(point) + adhesion(point) + validity(point) + damping(point);
    if (const Json* others = find(point, {"other_directions"}))
      for (const Json& other : others->elements()) text += damping(other) + validity(other);
    text += "</section>";
  }
  return text;
}

}  // namespace salebra::detail
