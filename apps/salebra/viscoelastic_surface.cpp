// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra viscoelastic SURFACE`: losses and creep of a rough contact on a viscoelastic body.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>  // analysis/ has no problem for it
#include <salebra/figures/figures.hpp>
#include <salebra/study/body_file.hpp>

#include "result_tables.hpp"
#include "viscoelastic_command.hpp"

namespace salebra::cli {
namespace {

// What a command line says of a rough contact on a viscoelastic body.
struct RoughContact {
  ViscoelasticBody viscoelastic;
  Surface surface;
  OperatingPoint point;
};

void require_no_option_of_indenters(const ViscoelasticArguments& arguments) {
  for (const auto& [given, option] :
       {std::pair(!arguments.indenter.law.empty(), "--law"),
        {!arguments.prony.empty(), "--prony"},
        {arguments.material.given(),
         "--young, --poisson, --contact-modulus or --tangential-modulus"},
        {arguments.springs.has_value(), "--springs"},
        {arguments.assumptions.friction_coefficient.has_value(), "--friction-coefficient"},
        {arguments.assumptions.hardness.has_value(), "--hardness"},
        {arguments.assumptions.density.has_value(), "--density"},
        {arguments.assumptions.excursion.has_value(), "--excursion"}})
    require(!given, option, "", "applies to an indenter; leave it out with SURFACE");
  arguments.indenter.require_only({}, "SURFACE");
}

// missing: options of the motion that were not given. what: what needs them.
RoughContact contact_of(const ViscoelasticArguments& arguments, std::vector<std::string> missing,
                        const std::string& what, Session& session) {
  if (arguments.body_file.empty()) missing.insert(missing.begin(), "--body");
  if (arguments.point.count() == 0)
    missing.emplace_back("--pressure (or --normal-force, --mean-gap, --indentation)");
  require_options(missing, what);
  require_that(arguments.point.count() == 1,
               "--pressure, --normal-force, --mean-gap, --indentation",
               "several are given; give one of them");
  session.require_one_process("SURFACE");
  RoughContact contact{
      read_viscoelastic_body(arguments.body_file), arguments.surface.read(session), {}};
  require(!contact.viscoelastic.relaxation.terms.empty(), "--body", arguments.body_file,
          "does not relax; give it [[relaxation]] tables, or use `salebra oscillate`");
  if (!contact.surface.periodic)
    session.warn("the surface is continued periodically, because it is not stated to repeat");
  const auto pressure = arguments.point.nominal_pressure(contact.surface.grid);
  contact.point = pressure ? at_pressure(*pressure)
                  : arguments.point.mean_gap
                      ? at_mean_gap(*arguments.point.mean_gap)
                      : at_indentation(*arguments.point.indentation);
  return contact;
}

ViscoelasticPath creep_of(const ViscoelasticArguments& arguments, const RoughContact& contact,
                          Session& session) {
  const std::vector<double>& times = arguments.creep;
  for (std::size_t k = 0; k < times.size(); ++k)
    require(times[k] >= 0 && std::isfinite(times[k]) && (k == 0 || times[k] > times[k - 1]),
            "--creep", format_quantity(times[k], Dimension::time),
            "must be >= 0 and later than the time before");
  // The load is applied at the time 0.
  const bool begins = times.front() == 0;
  std::vector<double> time = times;
  if (!begins) time.insert(time.begin(), 0);
  ViscoelasticPathOptions options;
  options.on_progress = session.progress();
  if (arguments.steps) options.steps = *arguments.steps;
  ViscoelasticPath path =
      viscoelastic_path(contact.surface, contact.viscoelastic.body, contact.viscoelastic.relaxation,
                        time, {contact.point.control, {contact.point.value}}, options);
  if (!path.converged)
    throw NotConverged("viscoelastic: a contact of the path did not reach its tolerance");
  if (!begins) path.points.erase(path.points.begin());
  return path;
}

void creep(const ViscoelasticArguments& arguments, Session& session) {
  for (const auto& [given, option] :
       {std::pair(arguments.motion.given(), "options of the motion"),
        {arguments.hold != "auto", "--hold"},
        {arguments.tolerance.has_value(), "--tolerance"},
        {arguments.point.mean_gap.has_value(), "--mean-gap"}})
    require_that(!given, "--creep",
                 std::string("holds a load or an indentation; leave out ") + option);
  require_tables(session, {"creep"});
  const RoughContact contact =
      contact_of(arguments, {}, "the creep of a rough contact on a viscoelastic body", session);
  const ViscoelasticPath path = creep_of(arguments, contact, session);
  Json answer;
  answer["datum"] = name_of(contact.viscoelastic.body.datum());
  const ResultTable table = table_of("creep", path.points);
  write_tables(session, "viscoelastic", answer, {table});
  for (const ResultColumn& column : table.columns) answer[column.name] = column.values;
  if (session.has_plot()) session.plot(figures::figure_of(path));
  session.answer(answer);
}

// Computes the steady cycles of motions that differ at most in their frequency, or of each motion.
std::vector<ViscoelasticCycle> cycles_of(const ViscoelasticArguments& arguments,
                                         const RoughContact& contact, Session& session) {
  const auto& [body, relaxation] = contact.viscoelastic;
  ViscoelasticCycleOptions options;
  options.hold = *parse_enum<Hold>(arguments.hold);
  options.on_progress = session.progress();
  if (arguments.steps) options.steps = *arguments.steps;
  if (arguments.tolerance) options.tolerance = *arguments.tolerance;
  const std::vector<Oscillation> motions = arguments.motion.motions();
  const std::string varied = arguments.motion.varied().first;
  std::vector<ViscoelasticCycle> cycles;
  if (varied == "frequency" || varied == "angular_frequency") {
    cycles = viscoelastic_sweep(contact.surface, body, relaxation, motions.front(), contact.point,
                                arguments.motion.frequency.angular(), options);
  } else {
    for (const Oscillation& motion : motions)
      cycles.push_back(
          viscoelastic_cycle(contact.surface, body, relaxation, motion, contact.point, options));
  }
  if (const auto lost = std::ranges::count_if(
          cycles, [](const ViscoelasticCycle& one) { return !one.converged(); });
      lost > 0)
    throw NotConverged(
        fmt::format("viscoelastic: {} of {} steady states were not found; allow a larger "
                    "--tolerance, or leave out relaxation times beyond 1e3 periods",
                    lost, cycles.size()));
  if (const auto lost = std::ranges::count_if(
          cycles, [](const ViscoelasticCycle& one) { return std::isnan(one.work_per_cycle); });
      lost > 0)
    session.warn(
        fmt::format("n/a at {} of {} motions: the error of the loss is not smaller than "
                    "the loss; give more --steps",
                    lost, cycles.size()));
  return cycles;
}

void oscillate(const ViscoelasticArguments& arguments, Session& session) {
  require_tables(session, {"motions"});
  std::vector<std::string> missing = arguments.motion.missing();
  if (!arguments.motion.frequency.given())
    missing.emplace_back("--frequency (or --angular-frequency)");
  const RoughContact contact = contact_of(
      arguments, missing, "the loss of a rough contact on a viscoelastic body", session);
  const std::vector<ViscoelasticCycle> cycles = cycles_of(arguments, contact, session);
  ResultTable table = table_of("motions", cycles);
  const auto [quantity, values] = arguments.motion.varied();
  if (!values.empty() && quantity != "angular_frequency" && quantity != "frequency")
    table.columns.insert(table.columns.begin(), {quantity, values});
  Json answer;
  answer["datum"] = name_of(contact.viscoelastic.body.datum());
  write_tables(session, "viscoelastic", answer, {table});
  for (const ResultColumn& column : table.columns) answer[column.name] = column.values;
  if (session.has_plot())
    session.plot(
        figures::figure_of(table.columns.front().name, table.columns.front().values, cycles));
  // The assumptions are checked by springs, which rough contacts with memory do not have.
  AssumptionReport assumptions{.cases = std::vector<Assumptions>(cycles.size()), .list = true};
  assumptions.answer(session, answer);
}

}  // namespace

void run_on_surface(const ViscoelasticArguments& arguments, Session& session) {
  require_no_option_of_indenters(arguments);
  arguments.creep.empty() ? oscillate(arguments, session) : creep(arguments, session);
}

}  // namespace salebra::cli
