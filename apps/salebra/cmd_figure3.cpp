// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra figure3`: the paper's Fig. 3, contact regions and work of a cycle for four shapes.
#include <fmt/format.h>

#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>

#include "options.hpp"
#include "oscillation_case.hpp"
#include "premise_options.hpp"
#include "program.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct Figure3Arguments {
  MaterialOptions material;
  std::string mode = "equal-frequency";
  std::optional<double> phase;
  int points = 128, steps = 64;
};

constexpr double size = 1e-3;  // m; the ratios do not depend on it

// u_x = u_z, and v/ω = u_z for drag: the ratios do not depend on the tangential motion.
Oscillation motion_of(const Figure3Arguments& arguments, double amplitude) {
  if (arguments.mode == "drag") {
    require_that(!arguments.phase, "--phase", "given for drag, which has none; leave it out");
    return Drag{amplitude, amplitude, 1.0};
  }
  return EqualFrequency{amplitude, amplitude, arguments.phase.value_or(std::numbers::pi / 2)};
}

void run(const Figure3Arguments& arguments, Session& session) {
  require(arguments.points >= 16, "--points", arguments.points, "must be >= 16");
  const Material material = arguments.material.material_with_tangential_modulus();
  const Grid2D grid{arguments.points, arguments.points, size, size};
  const std::vector<std::string> shapes(shape_names().begin(), shape_names().begin() + 4);

  std::vector<OscillationOutcome> outcomes;
  for (const std::string& shape : shapes) {
    const Body body = shape_body(shape, grid);
    OscillationCase contact{body, material, motion_of(arguments, body.normal_amplitude),
                            body.indentation};
    const Progress bar = session.progress();
    const Progress progress = [&](const ProgressReport& report) {
      ProgressReport whole = report;
      // Levels and steps take about as long as each other.
      const double half = report.stage == "cycle" ? 0.5 : 0;
      whole.fraction = (static_cast<double>(outcomes.size()) + half + report.fraction / 2) /
                       static_cast<double>(shapes.size());
      return !bar || bar(whole);
    };
    OscillationRoutes routes;
    routes.levels.stick.boundary = contact.body.boundary;
    routes.levels.on_progress = progress;
    routes.cycle.steps = arguments.steps;
    routes.cycle.stick.boundary = contact.body.boundary;
    routes.cycle.on_progress = progress;
    outcomes.push_back(run_routes(std::move(contact), routes));
    if (outcomes.back().cycle->interrupted)
      throw Interrupted("figure3: interrupted; nothing was written");
  }

  if (session.has_output()) {
    ResultFile file(session.output(), session.provenance(), session.write_options());
    for (std::size_t k = 0; k < shapes.size(); ++k)
      write_outcome(file, shapes[k] + "/", outcomes[k]);
    file.commit();
  }
  Figure figure{.title = "Contact regions and work over a cycle", .columns = 4};
  Json object;
  std::vector<std::vector<std::string>> rows{{"shape", "W", "W over Eq. (12) or (15)",
                                              "W over finite amplitude", "W over elastic energy"}};
  bool converged = true;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    figure.panels.push_back(contact_panel(outcomes[k], shapes[k]));
    object[shapes[k]] = to_json(outcomes[k]);
    PremiseReport{{premises_of(outcomes[k], {})}}.add_to(object[shapes[k]]);
    const OscillationOutcome& outcome = outcomes[k];
    const auto text = [&](double reference) {
      const std::optional<double> ratio = outcome.over(reference);
      return ratio ? fmt::format("{:.4f}", *ratio) : std::string("no loss");
    };
    rows.push_back({shapes[k], format_quantity(outcome.work_per_cycle(), Dimension::energy),
                    text(outcome.levels.small_amplitude_work), text(outcome.levels.work_by_force),
                    fmt::format("{:.1e}", outcome.work_per_cycle() / outcome.elastic_energy())});
    converged = converged && outcome.converged();
  }
  for (std::size_t k = 0; k < shapes.size(); ++k)
    figure.panels.push_back(work_panel(outcomes[k], ""));
  if (session.has_plot()) session.plot(figure);
  session.answer(object, to_table(rows, 2, true));
  if (!converged)
    throw NotConverged("figure3: a contact or a stick solve did not reach its tolerance");
}

}  // namespace

void add_figure3_command(Program& program) {
  auto arguments = std::make_shared<Figure3Arguments>();
  Command& command = program.add_command(
      "figure3", "the paper's Fig. 3: four shapes, their contact regions and the work of a cycle",
      {"salebra figure3 --contact-modulus 1GPa --poisson 0.3 --plot figure3.png",
       "salebra figure3 --young 70GPa --poisson 0.33 --mode drag --points 256 -o figure3.h5 "
       "--json"},
      [arguments](Session& session) { run(*arguments, session); },
      "contact regions above the work over a cycle, a column for each shape");
  arguments->material.add_to(command);
  add_choice(command, "--mode", arguments->mode, {"equal-frequency", "drag"},
             "what moves; default equal-frequency");
  add_quantity(command, "--phase", arguments->phase, Dimension::angle,
               "of equal frequencies; default 90deg");
  command.add_option("--points", arguments->points, "cells along each side; default 128");
  command.add_option("--steps", arguments->steps, "changes of the contact in a cycle; default 64");
}

}  // namespace salebra::cli
