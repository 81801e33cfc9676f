// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra viscoelastic SURFACE`: losses and creep of a rough contact on a viscoelastic body.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>  // analysis/ has no problem for it
#include <salebra/figures/figures.hpp>
#include <salebra/study/body_file.hpp>
#include <salebra/surface/moments.hpp>

#include "result_tables.hpp"
#include "several_files.hpp"
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
  contact.point = arguments.point.pressure   ? at_pressure(*arguments.point.pressure)
                  : arguments.point.force    ? at_force(*arguments.point.force)
                  : arguments.point.mean_gap ? at_mean_gap(*arguments.point.mean_gap)
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
  for (const auto& [given, option] : {std::pair(arguments.motion.given(), "options of the motion"),
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
          cycles,
          [](const ViscoelasticCycle& one) {
            return one.converged() &&
                   (std::isnan(one.work_per_cycle) ||
                    (std::isnan(one.damping_constant) && one.tangential_work != 0));
          });
      lost > 0)
    session.warn(
        fmt::format("n/a at {} of {} motions: the error of the loss is not smaller than "
                    "the loss, or than its tangential part; give more --steps",
                    lost, cycles.size()));
  return cycles;
}

// What is known of the assumptions. Most of them are checked by springs, which rough contacts with
// memory do not have.
AssumptionReport known_assumptions(const ViscoelasticArguments& arguments,
                                   const RoughContact& contact,
                                   const std::vector<ViscoelasticCycle>& cycles) {
  Assumptions known;
  if (arguments.motion.mode != "drag") known.slow_motion.verdict = Verdict::holds;
  const Body& body = contact.viscoelastic.body;
  // A half-space of Poisson's ratio 1/2 does not couple normal and tangential directions.
  if (body.half_space_material() && body.compliance(1).coupling == 0)
    known.coupling = {
        .value = 0, .limit_5_percent = 0.05, .limit_20_percent = 0.2, .verdict = Verdict::holds};
  AssumptionReport report{.cases = std::vector<Assumptions>(cycles.size(), known), .list = true};
  // A slope h' makes the surface longer by h'²/2, which is 5 % at 0.32 and 20 % at 0.63.
  const double slope = surface_moments(contact.surface).rms_slope();
  const Verdict verdict = slope > 0.63   ? Verdict::broken
                          : slope > 0.32 ? Verdict::doubtful
                                         : Verdict::holds;
  report.others.push_back({.name = "small_slope",
                           .verdict = verdict,
                           .assumption = "small slopes: rms slope below 0.32",
                           .here = fmt::format("{:.3g}", slope),
                           .remedy = verdict == Verdict::holds ? "" : "a filter of short waves"});
  double area = 0;
  for (const ViscoelasticCycle& cycle : cycles) area = std::fmax(area, cycle.contact_area_max);
  if (area > 0)
    report.others.push_back(
        {.name = "open_contact",
         .verdict = area < contact.surface.grid.area() ? Verdict::holds : Verdict::broken,
         .assumption = "below full contact",
         .here = fmt::format("{:.3g} of the area", area / contact.surface.grid.area())});
  return report;
}

// Throws NotConverged, with the frequencies, unless all steady states were found.
void require_steady(const std::vector<ViscoelasticCycle>& cycles) {
  std::vector<std::string> lost;
  for (const ViscoelasticCycle& one : cycles)
    if (!one.converged())
      lost.push_back(
          format_quantity(one.angular_frequency / (2 * std::numbers::pi), Dimension::frequency));
  if (!lost.empty())
    throw NotConverged(
        fmt::format("viscoelastic: {} of {} steady states were not found (at {}); allow a larger "
                    "--tolerance, or leave out relaxation times beyond 1e3 periods",
                    lost.size(), cycles.size(), fmt::join(lost, ", ")));
}

void oscillate(const ViscoelasticArguments& arguments, Session& session) {
  require_tables(session, {"motions"});
  std::vector<std::string> missing = arguments.motion.missing();
  if (!arguments.motion.frequency.given())
    missing.emplace_back("--frequency (or --angular-frequency)");
  const RoughContact contact =
      contact_of(arguments, missing, "the loss of a rough contact on a viscoelastic body", session);
  const std::vector<ViscoelasticCycle> cycles = cycles_of(arguments, contact, session);
  ResultTable table = table_of("motions", cycles);
  const auto [quantity, values] = arguments.motion.varied();
  if (!values.empty() && quantity != "angular_frequency" && quantity != "frequency")
    table.columns.insert(table.columns.begin(), {quantity, values});
  Json answer;
  answer["datum"] = name_of(contact.viscoelastic.body.datum());
  answer["nominal_area"] = contact.surface.grid.area();
  write_tables(session, "viscoelastic", answer, {table});
  for (const ResultColumn& column : table.columns) answer[column.name] = column.values;
  const AssumptionReport assumptions = known_assumptions(arguments, contact, cycles);
  if (session.has_plot()) {
    figures::Figure figure =
        figures::figure_of(table.columns.front().name, table.columns.front().values, cycles);
    figure.caption += motion_of_caption(arguments);
    assumptions.state_in(figure);
    session.plot(figure);
  }
  assumptions.answer(session, answer);
  require_steady(cycles);
}

}  // namespace

void run_on_surface(const ViscoelasticArguments& arguments, Session& session) {
  require_no_option_of_indenters(arguments);
  arguments.creep.empty() ? oscillate(arguments, session) : creep(arguments, session);
}

void lose_of_files(ViscoelasticArguments arguments, const std::vector<std::string>& files,
                   Session& session) {
  require_options_of_one(session, {{!arguments.creep.empty(), "--creep"}});
  require_that(arguments.point.pressure.has_value(), "--pressure",
               "not given; several surfaces are compared at the same nominal pressure");
  const auto [varied, values] = arguments.motion.varied();
  FileTable table{.columns = {},
                  .loads = std::max<std::size_t>(1, values.size()),
                  .interval = true,
                  .csv = arguments.csv};
  if (!values.empty()) {
    table.load_heading = varied == "frequency" ? "angular_frequency" : varied;
    table.columns.push_back(
        column(table.load_heading, table.load_heading, table.load_heading, false));
  }
  const auto add = [&](const std::string& heading, const std::string& name, const std::string& unit,
                       double scale, const char* number, const char* over, bool averaged) {
    table.columns.push_back({.heading = heading,
                             .name = name,
                             .value = [=](const Json& answer, std::size_t load) -> Json {
                               const Json above = member(answer, number, load),
                                          below = member(answer, over, load);
                               if (!above.is_number() || !below.is_number()) return {};
                               const double found = above.number() / below.number();
                               return std::isnan(found) ? Json() : Json(found);
                             },
                             .averaged = averaged,
                             .scale = scale,
                             .unit = unit});
  };
  add("γ/A0, N s/m per mm²", "damping_constant_per_area", "N s/m^3", 1e-6, "damping_constant",
      "nominal_area", true);
  add("W/A0, nJ per mm²", "work_per_cycle_per_area", "J/m^2", 1e3, "work_per_cycle", "nominal_area",
      true);
  add("error of W, %", "work_per_cycle_relative_error", "1", 100, "work_per_cycle_error",
      "work_per_cycle", false);
  add("error of γ, %", "damping_constant_relative_error", "1", 100, "work_per_cycle_error",
      "tangential_work", false);
  add("tangential, %", "tangential_share", "1", 100, "tangential_work", "work_per_cycle", true);
  add("largest A/A0", "contact_area_fraction_max", "1", 1, "contact_area_max", "nominal_area",
      true);
  answer_files(files, table, session, [&](const std::string& file) {
    arguments.surface.file = file;
    run_on_surface(arguments, session);
  });
}

}  // namespace salebra::cli
