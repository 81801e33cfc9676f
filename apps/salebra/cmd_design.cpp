// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra design`: parameters of a contact for a wanted result.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/study/design.hpp>

#include "program.hpp"
#include "results/answer_json.hpp"
#include "study_command.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

Json design_json(const DesignProblem& problem, const Design& found) {
  Json json = Json::object();
  json["output"] = problem.target.output;
  json["met"] = found.met;
  json["deviation"] = found.deviation;
  for (const DesignedParameter& one : found.parameters) {
    Json& parameter = json["parameters"][one.parameter];
    parameter["value"] = one.value;
    parameter["low"] = one.low;
    parameter["high"] = one.high;
    parameter["sensitivity"] = one.sensitivity;
    parameter["at_limit"] = one.at_limit;
    parameter["matters"] = one.matters;
  }
  Json points = Json::array();
  for (const DesignPoint& one : found.points) {
    Json point = Json::object();
    point["force"] = one.force;
    point["pressure"] = one.pressure;
    Json& result = point[problem.target.output] = to_json(one.output);
    result["target"] = one.target;
    result["surface_low"] = one.surface.low;
    result["surface_high"] = one.surface.high;
    points.push_back(std::move(point));
  }
  json["points"] = std::move(points);
  return json;
}

std::string design_text(const DesignProblem& problem, const Design& found) {
  const Dimension dimension = dimension_of_output(problem.target.output);
  const auto text_of = [&](double value) { return format_quantity(value, dimension, 3); };
  std::vector<std::vector<std::string>> rows{
      {"force", "wanted", problem.target.output, "95 % interval", "one surface"}};
  for (const DesignPoint& one : found.points)
    rows.push_back({format_quantity(one.force, Dimension::force, 3), text_of(one.target),
                    text_of(one.output.mean), interval(one.output, dimension, 3),
                    interval(one.surface, dimension, 3)});
  std::vector<std::vector<std::string>> values{{"parameter", "value", "limits", "sensitivity", ""}};
  for (const DesignedParameter& one : found.parameters) {
    const Dimension own = dimension_of(*parse_enum<StudyParameter>(one.parameter));
    values.push_back({one.parameter, format_quantity(one.value, own, 3),
                      fmt::format("{} to {}", format_quantity(one.low, own, 3),
                                  format_quantity(one.high, own, 3)),
                      std::isnan(one.sensitivity) ? "n/a" : fmt::format("{:.2f}", one.sensitivity),
                      one.at_limit   ? "at its limit"
                      : !one.matters ? "hardly matters"
                                     : ""});
  }
  const bool certain = std::ranges::all_of(found.points, [&](const DesignPoint& one) {
    return std::max(one.output.high / one.target, 2 - one.output.low / one.target) <=
           1 + problem.target.tolerance;
  });
  const std::string deviation =
      std::isnan(found.deviation)
          ? "some means are not known"
          : fmt::format("the largest deviation from the target is {:.1f} %", 100 * found.deviation);
  return fmt::format("{}: {}, allowed are {:.0f} %\n",
                     found.met ? "The target is met"
                               : "The target is not met, this is the nearest that was found",
                     deviation, 100 * problem.target.tolerance) +
         to_table(values, 2, true) + to_table(rows, 2) +
         fmt::format("  on surfaces that the search did not use; {} studies were computed\n",
                     found.studies) +
         (found.met && !certain ? "  The intervals of the means reach beyond the tolerance; more "
                                  "seeds make it sure.\n"
                                : "");
}

void run(const std::string& file, Session& session) {
  session.require_no_output("design");
  const DesignProblem problem = read_design_problem(file);
  const Design found = design(problem, session.progress());
  if (found.interrupted) throw Interrupted("design: interrupted");
  session.answer(design_json(problem, found), design_text(problem, found));
  if (!found.met) throw Error("design: the target was not met; widen the limits or the tolerance");
}

}  // namespace

void add_design_command(Program& program) {
  auto file = std::make_shared<std::string>();
  Command& command = program.add_command(
      "design", "roughness and motion for a wanted damping or stiffness",
      {"salebra design data/damper.design.toml", "salebra design data/damper.design.toml --json"},
      [file](Session& session) { run(*file, session); });
  command.add_option("FILE", *file, "target and limits of the free parameters (TOML)")
      ->required()
      ->file(FileUse::input);
}

}  // namespace salebra::cli
