// SPDX-License-Identifier: GPL-3.0-or-later
// JSON and text of the sensitivities of a study.
#include "sensitivity_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>

#include "option_words.hpp"
#include "results/answer_json.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

std::string length_text(double value) { return format_quantity(value, Dimension::length, 3); }

std::string name_of(const ParameterSensitivity& one) {
  if (one.parameter != "waves") return one.parameter;
  return one.shortest > 0
             ? fmt::format("waves {} to {}", length_text(one.shortest), length_text(one.longest))
             : "waves below " + length_text(one.longest);
}

/// The mean with half its interval, such as "-1.21 ± 0.08".
std::string with_interval(const EnsembleMean& slope) {
  if (std::isnan(slope.mean)) return "n/a";
  // Removes the sign of a zero.
  return fmt::format("{:.2f} ± {:.2f}", std::round(100 * slope.mean) / 100 + 0.0,
                     (slope.high - slope.low) / 2);
}

}  // namespace

Json sensitivity_json(const StudySensitivity& found) {
  Json json = Json::object();
  json["pressure"] = found.pressures;
  json["left_out"] = found.left_out;
  for (const ParameterSensitivity& one : found.parameters)
    for (const OutputSensitivity& output : one.outputs) {
      Json slopes = to_json(output.at_pressures);
      if (one.parameter != "waves") {
        json[output.output][one.parameter] = std::move(slopes);
        continue;
      }
      slopes["shortest"] = one.shortest;
      slopes["longest"] = one.longest;
      Json& list = json[output.output]["waves"];
      if (!list.is_array()) list = Json::array();
      list.push_back(std::move(slopes));
    }
  return json;
}

std::string sensitivity_text(const StudySensitivity& found) {
  const std::size_t middle = found.pressures.size() / 2;
  std::vector<std::string> outputs = found.outputs();
  // The work per cycle responds as the damping constant does, but for the amplitude.
  if (outputs.size() > 1 && outputs.back() == "damping_constant") outputs.erase(outputs.end() - 2);
  std::vector<std::vector<std::string>> rows{{"parameter"}};
  rows.front().insert(rows.front().end(), outputs.begin(), outputs.end());
  for (const ParameterSensitivity& one : found.parameters) {
    std::vector<std::string>& row = rows.emplace_back(std::vector{name_of(one)});
    for (const std::string& name : outputs) {
      const auto output = std::ranges::find(one.outputs, name, &OutputSensitivity::output);
      row.push_back(output == one.outputs.end() ? "n/a"
                                                : with_interval(output->at_pressures[middle]));
    }
  }
  std::string text =
      fmt::format("Sensitivity d ln(result)/d ln(parameter) at {}, with {}\n",
                  format_quantity(found.pressures[middle], Dimension::pressure, 3),
                  found.surfaces > 1 ? "95 % intervals over the surfaces" : "numerical errors");
  text += to_table(rows, 2, true);
  for (const std::string& reason : found.left_out) text += "  left out: " + reason + "\n";
  if (!outputs.empty())
    if (const std::string sentence = found.sentence(outputs.back(), middle); !sentence.empty())
      text += "  " + sentence + "\n";
  return text;
}

Tolerances tolerances_of(const std::vector<std::string>& texts) {
  Tolerances tolerances;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    const auto parameter = parse_enum<StudyParameter>(text.substr(0, equals));
    require(parameter && equals != std::string::npos, "--tolerance", text,
            "must be a parameter of the table of sensitivities and its tolerance, such as "
            "rms_height=10%");
    const double value =
        parse_quantity(text.substr(equals + 1), Dimension::dimensionless, "--tolerance");
    require(value > 0 && value < 1, "--tolerance", text, "must be between 0 and 100 %");
    require(std::ranges::find(tolerances, *parameter, &Tolerances::value_type::first) ==
                tolerances.end(),
            "--tolerance", text, "is the second tolerance of this parameter; give one");
    tolerances.emplace_back(*parameter, value);
  }
  return tolerances;
}

std::string add_tolerances(Json& json, const StudySensitivity& found,
                           const Tolerances& tolerances) {
  std::string unknown;
  for (const auto& [parameter, tolerance] : tolerances)
    if (std::ranges::find(found.parameters, salebra::name_of(parameter),
                          &ParameterSensitivity::parameter) == found.parameters.end())
      unknown += fmt::format("  {} is left out above, so that no limit is known\n",
                             salebra::name_of(parameter));
  std::vector<std::vector<std::string>> rows{{"result", "within"}};
  const std::size_t middle = found.pressures.size() / 2;
  for (const std::string& output : found.outputs()) {
    std::vector<double> factors;
    for (std::size_t k = 0; k < found.pressures.size(); ++k)
      factors.push_back(found.factor_of(tolerances, output, k));
    const double factor = factors[middle];
    rows.push_back({output, std::isnan(factor)
                                ? "n/a"
                                : fmt::format("-{:.0f} … +{:.0f} %", 100 * (1 - 1 / factor),
                                              100 * (factor - 1))});
    json["tolerance"][output] = factors;
  }
  return fmt::format(
             "With these tolerances, at {}, to first order and without the errors of the "
             "sensitivities\n",
             format_quantity(found.pressures[middle], Dimension::pressure, 3)) +
         to_table(rows, 2, true) + unknown;
}

}  // namespace salebra::cli
