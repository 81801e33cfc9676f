// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra damping`: energy loss of an oscillating contact in a cycle, and the contact as a damper.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/analysis/damping.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/adhesive_indenter.hpp>  // analysis/ has no problem for it
#include <salebra/figures/figures.hpp>
#include <salebra/io/result_file.hpp>

#include "assumption_options.hpp"
#include "damping_maps.hpp"
#include "figures/axes.hpp"
#include "io/number_table.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "results/answer_json.hpp"
#include "results/quantity_group.hpp"
#include "several_files.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct DampingArguments {
  LawOptions law;
  std::string amplitude = "finite", hold = "auto", direction = "auto", trajectory;
  MaterialOptions material;
  MotionOptions motion;
  std::vector<double> force_amplitude;
  std::optional<double> work_of_adhesion, adhesion_range;
  int steps = 2000;
  AssumptionOptions assumptions;
  MapOptions maps;
  BodyOptions body;
  std::string csv;  ///< table of several surfaces

  /// Whether the command computes the contact as a damper: with a body, or for a slow drag whose
  /// velocity is not given, since the damping constant does not depend on it.
  bool of_damper() const {
    const auto& amplitudes = motion.normal_amplitude;
    return body.given() || (motion.mode == "drag" && force_amplitude.empty() &&
                            motion.frequency.given() && !amplitudes.empty() &&
                            (motion.drag_velocity.empty() ||
                             (amplitudes.size() > 1 && motion.frequency.count() > 1)));
  }
};

std::vector<Motion> motions_of(const DampingArguments& arguments) {
  if (arguments.force_amplitude.empty()) return arguments.motion.all_motions();
  require(arguments.motion.normal_amplitude.empty(), "--force-amplitude",
          arguments.force_amplitude.front(),
          "is given together with --normal-amplitude; give one of them");
  // With a force amplitude the library does not use the normal amplitude.
  MotionOptions motion = arguments.motion;
  motion.normal_amplitude = {0};
  return motion.all_motions();
}

ContactProblem contact_of(const DampingArguments& arguments, Session& session) {
  return arguments.law.problem(arguments.material, session, arguments.assumptions.hardness,
                               arguments.direction);
}

// --trajectory: a file with one period of time, indentation and displacement.
void follow_file(const DampingArguments& arguments, Session& session) {
  require(!arguments.motion.given() && arguments.force_amplitude.empty() &&
              !arguments.of_damper() && !arguments.maps.given(),
          "--trajectory", arguments.trajectory,
          "gives the motion; leave out the options under Motion, Damper and Maps");
  const auto columns =
      read_number_table(arguments.trajectory,
                        {{"time", Dimension::time, {"t"}},
                         {"indentation", Dimension::length, {"delta", "\u03b4", "z", "normal"}},
                         {"displacement", Dimension::length, {"tangential", "x"}},
                         {"transverse", Dimension::length, {"y"}}},
                        3)
          .columns;
  PathProblem problem{.contact = arguments.law.problem_of_law(arguments.material),
                      .path = {columns[0], columns[1], columns[2]},
                      .parameters = arguments.assumptions.parameters(arguments.material)};
  if (columns.size() > 3) problem.transverse = columns[3];
  const SampledMotion& path = problem.path;
  const PathSolution answer = solve(problem, session.context());
  if (session.has_output()) {
    ResultFile file(session.output(), session.provenance(), session.write_options());
    QuantityGroup group(file.group("trajectory"));
    group.coordinate("time", path.time);
    group.dataset("indentation", path.indentation, {"time"});
    group.dataset("tangential", path.displacement, {"time"});
    group.dataset("tangential_force", answer.loss.tangential_force, {"time"});
    if (!problem.transverse.empty()) {
      const Quantity quantity = quantity_of("transverse");
      group.plain().dataset("transverse", problem.transverse, {"time"},
                            std::string(si_unit(quantity.dimension)),
                            std::string(quantity.long_name));
      group.dataset("transverse_force", answer.loss.transverse_force, {"time"});
    }
    group.dataset("dissipated", answer.loss.dissipated, {"time"});
    file.commit();
  }
  session.plot(figures::figure_of(path, answer.loss));
  AssumptionReport{.cases = {answer.assumptions},
                   .slip_followed = arguments.assumptions.friction_coefficient.has_value()}
      .answer(session, json_of(answer.loss));
}

// An adhesive indenter at rest: by the theory of JKR and, for a paraboloid with a known range of
// adhesion, by all closed forms.
void answer_adhesion(const DampingArguments& arguments, Session& session) {
  const auto body = std::get<IndenterContact>(contact_of(arguments, session));
  const IndenterProfile& profile = *body.profile;
  const double modulus = body.material.contact_modulus, work = *arguments.work_of_adhesion;
  require_positive(work, "--work-of-adhesion");
  require_that(
      !profile.has_side(), "--law",
      "has a flat face, which adheres with its whole area at any force; choose another shape");
  require(body.at.values.size() == 1, "--" + option_word(body.at.control), body.at.values.size(),
          "values given; a contact at rest takes one");
  const auto shown = [](const AdhesivePoint& point) {
    Json json = json_of(point);
    if (!std::isfinite(point.zone_radius)) json.erase("zone_radius");
    return json;
  };
  const auto state = [&](const std::function<AdhesivePoint(double)>& contact,
                         const AdhesivePoint& pull_off) {
    const AdhesivePoint point = adhesive_equilibrium(
        contact, pull_off,
        body.at.control == ControlQuantity::normal_force ? &AdhesivePoint::force
                                                         : &AdhesivePoint::indentation,
        body.at.values.front());
    Json json = shown(point);
    json["pull_off"] = shown(pull_off);
    return json;
  };
  Json answer{{"jkr", state([&](double a) { return jkr_contact(profile, modulus, work, a); },
                            jkr_pull_off(profile, modulus, work))}};
  if (arguments.adhesion_range) {
    require(arguments.law.indenter.law == "paraboloid", "--adhesion-range",
            *arguments.adhesion_range,
            "applies only to a paraboloid; leave it out with other shapes");
    const double radius = *arguments.law.indenter.radius, range = *arguments.adhesion_range;
    const MaugisDugdale model(radius, modulus, work, range);
    const double tabor = tabor_parameter(radius, modulus, work, range);
    const auto dmt = [&](double a) { return dmt_contact(radius, modulus, work, a); };
    answer["dmt"] = state(dmt, dmt(0));
    answer["maugis_dugdale"] = state([&](double a) { return model.contact(a); }, model.pull_off());
    answer["tabor"] = tabor;
    answer["suggested_model"] = name_of(suggested_model(tabor));
  }
  session.answer(answer);
}

// Answers with the state of an indenter that does not move.
void answer_at_rest(const DampingArguments& arguments, Session& session) {
  arguments.law.at.require_one("a contact at rest takes one, and damping needs a motion");
  const ContactSolution contact = solve(contact_of(arguments, session), session.context());
  session.warn(contact.warnings);
  const auto& law = static_cast<const IndenterLaw&>(*contact.law);
  const double indentation = indentation_of(law, contact.points.front());
  const Json object = json_of(state_of(law, indentation));
  write_tables(session, "damping", object, {});
  if (session.has_plot()) session.plot(figures::figure_of(law, indentation));
  session.answer(object);
}

/// The motion of a figure in words, for its caption, without the quantity that varies.
std::string setting_of(const DampingSolution& answer, std::string_view varied,
                       const AssumptionOptions& known) {
  const DampingResult& first = answer.results.front();
  constexpr double unknown = ContactParameters::unknown;
  const bool loads =
      varied == "force" || varied == "pressure" || varied == "mean_gap" || varied == "indentation";
  return figures::setting_text(figures::motion_text(answer.motions.front(), varied,
                                                    known.excursion.value_or(unknown)),
                               known.friction_coefficient.value_or(unknown),
                               loads ? unknown : first.force) +
         fmt::format("; the mean {} is held.", name_of(first.hold));
}

// Draws one period of the motion if there is a single case; draws nothing for a motion without a
// period.
void plot_case(const DampingArguments& arguments, const DampingSolution& answer,
               const AssumptionReport& assumptions, Session& session) {
  if (!session.has_plot()) return;
  require_that(arguments.force_amplitude.empty(), "--plot",
               "cannot draw a single value of --force-amplitude; give a range");
  const bool slips = arguments.assumptions.friction_coefficient.has_value();
  const DampingCycle cycle =
      cycle_of(*answer.contact.law, answer.motions.front(), answer.results.front().indentation,
               slips ? arguments.steps : 1000,
               arguments.assumptions.friction_coefficient.value_or(ContactParameters::unknown),
               session.context());
  // The loss of a surface comes from its contacts; the law of its curve draws the loop only.
  TrajectoryDamping loss = cycle.loss;
  if (answer.contact.surface) {
    loss.work_per_cycle = answer.results.front().work_per_cycle;
    loss.error = answer.results.front().error;
  }
  figures::Figure figure = figures::figure_of(cycle.path, loss);
  assumptions.state_in(figure);
  figure.caption += setting_of(answer, "", arguments.assumptions);
  session.plot(figure);
}

void lose(const DampingArguments& arguments, Session& session) {
  const std::vector<Motion> motions = motions_of(arguments);
  DampingProblem problem{.contact = {},
                         .motions = motions,
                         .force_amplitude = arguments.force_amplitude,
                         .hold = *parse_enum<Hold>(arguments.hold),
                         .amplitude = *parse_enum<Amplitude>(arguments.amplitude),
                         .parameters = arguments.assumptions.parameters(arguments.material),
                         .steps = arguments.steps};
  Varied varied = arguments.motion.varied();
  find_varied(arguments.law.at, varied);
  find_varied(problem, varied);
  const auto& [quantity, values] = varied;
  arguments.maps.check(motions, session);
  if (arguments.law.surface.given())
    require(motions.size() == 1 && arguments.force_amplitude.empty() &&
                arguments.motion.mode != "two-frequencies",
            "--surface", arguments.law.surface.file,
            "takes one motion, drag or equal-frequency; give several values of --pressure, or a "
            "--curve");
  // The loop of a drag with slip takes as many normal cycles as its excursion.
  if (session.has_plot() && values.empty() && !arguments.maps.given() && motions.size() == 1)
    require_that(!(arguments.assumptions.friction_coefficient &&
                   std::holds_alternative<Drag>(motions.front())),
                 "--plot",
                 "cannot draw the loop of a single drag with --friction-coefficient; leave the "
                 "friction out, or give several values of a quantity");
  problem.contact = contact_of(arguments, session);
  const DampingSolution answer = solve(std::move(problem), session.context());
  session.warn(answer.contact.warnings);
  session.warn(answer.warnings);
  // Several directions make several rows, all values in one direction first.
  const std::size_t directions = answer.results.size() / std::max<std::size_t>(1, values.size());
  const bool one = answer.results.size() == 1;
  if (one && !answer.periods.empty() && answer.periods.front().normal_cycles == 0)
    session.inform(
        "the two frequencies have no common period: the power is a mean over a long time");
  Json object = Json::object();
  // The direction is the first column of the rows that it distinguishes.
  if (directions > 1) object["direction"] = json_of(answer.results)["direction"];
  if (!values.empty()) {
    Json& rows = object[quantity] = Json::array();
    for (std::size_t k = 0; k < directions; ++k)
      for (const double value : values) rows.push_back(value);
  }
  object.add(answer_json(answer, answer.contact.nominal_area()));
  arguments.material.add_datum_to(object);
  // Without friction the losses without slip equal the other losses, so they are left out.
  if (!arguments.assumptions.friction_coefficient)
    for (const char* name : {"work_per_cycle_without_slip", "damping_constant_without_slip",
                             "damping_constant_without_slip_error"})
      object.erase(name);
  const bool slips = std::ranges::any_of(
      answer.results, [](const DampingResult& result) { return !std::isnan(result.slip_work); });
  const AssumptionReport assumptions{
      .cases = answer.assumptions, .list = !one, .slip_followed = slips};
  const auto lost = std::ranges::count(answer.results, false, &DampingResult::converged);
  if (lost == 0) {
    write_tables(session, "damping", object, {});
    if (!values.empty() && session.has_plot()) {
      figures::Figure figure = figures::figure_of(quantity, values, answer.results);
      assumptions.state_in(figure);
      figure.caption += setting_of(answer, quantity, arguments.assumptions);
      session.plot(figure);
    } else if (!arguments.maps.given())
      plot_case(arguments, answer, assumptions, session);
    arguments.maps.write(answer, arguments.steps, session);
  }
  assumptions.answer(session, object);
  if (lost > 0)
    throw NotConverged(fmt::format("damping: {} of {} integrals did not reach the tolerance", lost,
                                   answer.results.size()));
}

// Names and fields of the map that this solution has.
std::vector<std::pair<std::string, const Field*>> fields_of(const DamperSolution& answer) {
  std::vector<std::pair<std::string, const Field*>> fields;
  for (const auto& [name, field] :
       {std::pair{"damping_constant", &answer.map.damping_constant},
        {"damping_constant_error", &answer.damping_constant_error},
        {"slip_share", &answer.slip_share},
        {"damping_constant_without_slip", &answer.damping_constant_without_slip}})
    if (field->size() > 0) fields.emplace_back(name, field);
  return fields;
}

void write_map(const DamperSolution& answer, const std::optional<double>& falling_slope,
               const Session& session) {
  const DamperMap& map = answer.map;
  ResultFile file(session.output(), session.provenance(), session.write_options());
  QuantityGroup group(file.group("damper"));
  group.coordinate("normal_amplitude", map.normal_amplitude);
  group.coordinate("angular_frequency", map.angular_frequency);
  for (const auto& [name, field] : fields_of(answer))
    group.dataset(name, *field, "normal_amplitude", "angular_frequency");
  if (falling_slope) {
    std::vector<bool> stable;
    for (Index i = 0; i < map.damping_constant.rows(); ++i)
      for (Index j = 0; j < map.damping_constant.cols(); ++j)
        stable.push_back(map.damping_constant(i, j) >= *falling_slope);
    group.plain().flags("stable", stable, {"normal_amplitude", "angular_frequency"},
                        "steady sliding is stable");
    group.scalar("falling_slope", *falling_slope);
  }
  file.commit();
}

// The damping constants of a map: a number, a list over the one quantity that varies, or for each
// amplitude a list over the frequencies.
Json constants(const Field& map) {
  Json rows = Json::array();
  for (Index i = 0; i < map.rows(); ++i) {
    Json row = Json::array();
    for (Index j = 0; j < map.cols(); ++j) row.push_back(map(i, j));
    rows.push_back(row.size() == 1 ? row[0] : row);
  }
  return rows.size() == 1 ? rows[0] : rows;
}

// The text of a map has a row for each pair of amplitude and frequency. to_text() would print the
// list of amplitudes and the list of frequencies side by side, as if their rows belonged together.
std::string text_of(const Json& answer, const DamperSolution& found) {
  const DamperMap& map = found.map;
  Json pairs = Json::array();
  for (std::size_t i = 0; i < map.normal_amplitude.size(); ++i)
    for (std::size_t j = 0; j < map.angular_frequency.size(); ++j) {
      Json pair{{"normal_amplitude", map.normal_amplitude[i]},
                {"angular_frequency", map.angular_frequency[j]}};
      for (const auto& [name, field] : fields_of(found)) pair[name] = (*field)(Index(i), Index(j));
      pairs.push_back(pair);
    }
  std::string text = to_text(Json{{"map", pairs}});
  if (answer.contains("stabilising_amplitude"))
    text += "\n" + to_text(Json{{"angular_frequency", answer["angular_frequency"]},
                                {"stabilising_amplitude", answer["stabilising_amplitude"]}});
  return text;
}

DamperProblem damper_problem(const DampingArguments& arguments) {
  const MotionOptions& motion = arguments.motion;
  require_that(motion.mode == "drag" && arguments.force_amplitude.empty(),
               arguments.force_amplitude.empty() ? "--mode" : "--force-amplitude",
               "given, but a damper needs slow shear (--mode drag) with --normal-amplitude");
  for (const auto& [option, values] :
       {std::pair("--tangential-amplitude", &motion.tangential_amplitude),
        {"--phase", &motion.phase},
        {"--tangential-frequency", &motion.tangential_frequency}})
    require_that(values->empty(), option, "given, but --mode drag has none; leave it out");
  require(motion.drag_velocity.size() < 2, "--drag-velocity", motion.drag_velocity.size(),
          "values given; a damper takes one");
  arguments.law.at.require_one("a damper takes one");
  DamperProblem problem{.normal_amplitude = motion.normal_amplitude,
                        .angular_frequency = motion.frequency.angular(),
                        .hold = *parse_enum<Hold>(arguments.hold),
                        .amplitude = *parse_enum<Amplitude>(arguments.amplitude),
                        .falling_slope = arguments.body.falling_slope,
                        .parameters = arguments.assumptions.parameters(arguments.material)};
  if (!motion.drag_velocity.empty()) {
    require_positive(motion.drag_velocity.front(), "--drag-velocity");
    problem.drag_velocity = motion.drag_velocity.front();
  }
  require_that(arguments.body.mass || !arguments.body.spring_stiffness, "--spring-stiffness",
               "given, but there is no --mass to oscillate");
  if (arguments.body.mass)
    problem.oscillator = {*arguments.body.mass, arguments.body.spring_stiffness.value_or(0)};
  problem.max_amplitude = arguments.body.max_amplitude.value_or(
      motion.normal_amplitude.empty() ? 1e-6 : std::ranges::max(motion.normal_amplitude));
  return problem;
}

void damp(const DampingArguments& arguments, Session& session) {
  require_that(!arguments.maps.given(), "--stress-map", "and --friction-map need a single motion");
  if (!arguments.motion.frequency.given()) require_options({"--frequency"}, "a damper");
  DamperProblem problem = damper_problem(arguments);
  const std::vector<double> amplitudes = problem.normal_amplitude,
                            omega = problem.angular_frequency;
  require(!amplitudes.empty() || !session.has_output(), "--output", session.output().string(),
          "needs a map; give --normal-amplitude and --frequency");
  problem.contact = contact_of(arguments, session);
  const std::vector<DamperSolution> answers =
      solve_directions(std::move(problem), session.context());
  const DamperSolution& first = answers.front();
  session.warn(first.contact.warnings);
  for (const auto& [given, option] :
       {std::pair(session.has_output(), "--output"), {session.has_plot(), "--plot"}})
    require_that(
        !given || answers.size() == 1, option,
        "takes one direction, and the surface has a lay; give --direction across or along");
  Json object = Json::object();
  if (amplitudes.size() > 1) object["normal_amplitude"] = amplitudes;
  if (omega.size() > 1) object["angular_frequency"] = omega;
  const bool pairs = amplitudes.size() > 1 && omega.size() > 1;
  std::string text;
  AssumptionReport report{.list = amplitudes.size() > 1 || answers.size() > 1};
  std::vector<Json> objects;
  for (const DamperSolution& answer : answers) {
    session.warn(answer.warnings);
    Json& one = objects.emplace_back(Json::object());
    if (!std::isnan(answer.contact.direction())) one["direction"] = answer.contact.direction();
    for (const auto& [name, field] : fields_of(answer)) one[name] = constants(*field);
    one.add(answer_json(answer));
    arguments.material.add_datum_to(one);
    Json shown = object;
    shown.add(one);
    if (!text.empty()) text += "\n";
    if (pairs && answers.size() > 1)
      text += to_text(Json{{"direction", answer.contact.direction()}}) + "\n";
    text += pairs ? text_of(shown, answer) : to_text(shown);
    report.cases.insert(report.cases.end(), answer.assumptions.begin(), answer.assumptions.end());
    report.slip_followed = answer.slip_share.size() > 0 && !answer.slip_share.isNaN().all();
  }
  // Each value of several directions is a list, with one entry for each direction.
  if (objects.size() == 1)
    object.add(objects.front());
  else
    for (const auto& [name, value] : objects.front().items()) {
      Json& list = object[name] = Json::array();
      for (const Json& one : objects)
        list.push_back(one.contains(name) ? one[name] : Json(nullptr));
    }
  if (!amplitudes.empty() && session.has_output())
    write_map(first, arguments.body.falling_slope, session);
  if (session.has_plot()) {
    const figures::Figure figure = figures::figure_of(first, arguments.body.falling_slope, omega);
    require_that(!figure.panels.empty(), "--plot",
                 "there is only one number to draw; give a range, --mass, or --falling-slope with "
                 "several frequencies");
    session.plot(figure);
  }
  if (report.cases.empty()) return session.answer(object, text);
  report.answer(session, object, text);
}

/// The loss of each of several surfaces at the same pressures.
void lose_of_files(DampingArguments arguments, const std::vector<std::string>& files,
                   Session& session) {
  require_options_of_one(session, {{arguments.maps.given(), "--stress-map"},
                                   {!arguments.trajectory.empty(), "--trajectory"},
                                   {arguments.work_of_adhesion.has_value(), "--work-of-adhesion"},
                                   {arguments.body.given(), "--mass"}});
  const std::vector<double> pressures = arguments.law.at.pressure;
  require_that(!pressures.empty(), "--pressure",
               "not given; several surfaces are compared at the same nominal pressures");
  if (arguments.of_damper()) require_options({"--drag-velocity"}, "a table of several surfaces");
  arguments.direction = one_direction(arguments.direction);
  FileTable table{
      .columns = {{.heading = "pressure",
                   .name = "pressure",
                   .value = [&](const Json&, std::size_t load) -> Json { return pressures[load]; },
                   .dimension = Dimension::pressure,
                   .averaged = false}},
      .loads = pressures.size(),
      .csv = arguments.csv};
  add_damping_columns(table, "", [&](const Json& answer, std::size_t load) {
    return member(answer, "force", load).number() / pressures[load];
  });
  for (const auto& [heading, name] : {std::pair("K/A0", "normal_stiffness_per_area"),
                                      {"K_t/A0", "tangential_stiffness_per_area"},
                                      {"in contact", "contact_time"}})
    table.columns.push_back(column(heading, name, name));
  table.columns.push_back(column("validity", "validity", "validity", false));
  table.columns.back().unit = "text";
  answer_files(files, table, session, [&](const std::string& file) {
    arguments.law.surface.file = file;
    lose(arguments, session);
  });
}

void run(DampingArguments arguments, Session& session) {
  arguments.law.surface.names = {arguments.law.surface.file};
  if (!arguments.law.surface.file.empty()) {
    const std::vector<std::string> files =
        arguments.law.surface.several(!arguments.csv.empty(), "--surface");
    if (!files.empty()) return lose_of_files(std::move(arguments), files, session);
  }
  require_that(arguments.csv.empty(), "--csv", "needs the files of surfaces; give --surface");
  require_that(arguments.work_of_adhesion || !arguments.adhesion_range, "--adhesion-range",
               "given without --work-of-adhesion; give both");
  if (arguments.work_of_adhesion) {
    require_that(!arguments.motion.given() && arguments.force_amplitude.empty() &&
                     arguments.trajectory.empty() && !arguments.body.given() &&
                     !arguments.maps.given() && arguments.law.of_indenter(),
                 "--work-of-adhesion",
                 "applies only to an indenter at rest: in a motion with adhesion points may "
                 "separate in another order than they touched, and then the loss is not known; "
                 "leave out this option or the motion");
    return answer_adhesion(arguments, session);
  }
  if (!arguments.trajectory.empty()) return follow_file(arguments, session);
  if (arguments.of_damper()) return damp(arguments, session);
  if (!arguments.motion.given() && arguments.force_amplitude.empty() &&
      arguments.law.of_indenter() && !arguments.maps.given())
    return answer_at_rest(arguments, session);
  lose(arguments, session);
}

}  // namespace

void add_damping_command(Program& program) {
  auto arguments = std::make_shared<DampingArguments>();
  Command& command = program.add_command(
      "damping", "energy loss and damping of an oscillating contact",
      {"salebra damping --curve curve.h5 --pressure 10MPa --poisson 0.3 --normal-amplitude "
       "1:20nm:8 --drag-velocity 100nm/s --frequency 20kHz --plot damping.png",
       "salebra damping --law sphere --radius 10mm --indentation 1um --contact-modulus 1GPa "
       "--poisson 0.3 --mode equal-frequency --normal-amplitude 300nm --tangential-amplitude 200nm "
       "--phase 60deg --friction-coefficient 0.3"},
      [arguments](Session& session) { run(*arguments, session); },
      "the map, the loss or damping constant over the quantity given as a range, one period of a "
      "single motion, or the contact at rest");
  arguments->law.add_to(command);
  add_table_file(command, arguments->csv);
  arguments->motion.add_to(command, true);
  const std::string normal = "Normal motion";
  add_values(
      command, "--force-amplitude", arguments->force_amplitude, Dimension::force,
      "amplitude F_a of a force-controlled motion F + F_a cos wt, instead of --normal-amplitude")
      ->group(normal);
  add_choice<Amplitude>(command, "--amplitude", arguments->amplitude,
                        "finite normal amplitude, or the limit of a small one; default finite")
      ->group(normal);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "which mean value the oscillation keeps; default auto: the indentation, or the "
                   "force once the contact lifts off under a given load")
      ->group(normal);
  add_direction(command, arguments->direction,
                "with --surface or --curve: direction of the tangential motion")
      ->group("Tangential motion");
  const std::string path = "Measured motion, and steps";
  const std::string adhesion = "Adhesion, of an indenter at rest";
  add_quantity(command, "--work-of-adhesion", arguments->work_of_adhesion,
               Dimension::energy_per_area,
               "work of adhesion w: contact and pull-off by JKR; a force may pull")
      ->group(adhesion);
  add_quantity(command, "--adhesion-range", arguments->adhesion_range, Dimension::length,
               "range of the tension on a paraboloid: adds DMT and Maugis-Dugdale, and which of "
               "the theories applies")
      ->group(adhesion);
  command
      .add_option(
          "--trajectory", arguments->trajectory,
          "file with one period of the motion: time, indentation, x and, without slip, y (SI)")
      ->file(FileUse::input)
      ->group(path);
  add_steps(command, arguments->steps, "straight steps per cycle when slip is computed")
      ->range(8, 10000000)
      ->group(path);
  const std::string before =
      command.under("Damper under slow shear (--drag-velocity may be left out)");
  arguments->body.add_to(command, "the largest --normal-amplitude, or 1um");
  command.under(before);
  arguments->maps.add_to(command);
  arguments->assumptions.add_to(command);
  arguments->material.add_to(command);
  arguments->material.add_body_to(command, "with --surface, or a --curve of such a body");
}

}  // namespace salebra::cli
