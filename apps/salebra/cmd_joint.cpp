// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra joint`: partial slip under a tangential oscillation.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/analysis/damping.hpp>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>
#include <set>

#include "assumption_options.hpp"
#include "damping/joint_loop.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "study/estimate.hpp"

namespace salebra::cli {
namespace {

struct JointArguments {
  LawOptions law;
  MaterialOptions material;
  std::vector<double> tangential_forces, tangential_amplitudes;
  std::optional<double> normal_amplitude, phase, frequency, angular_frequency;
  std::string hold, direction = "auto";
  int steps = 2000;
  std::optional<int> direct_steps;
  AssumptionOptions assumptions;
};

double half_range_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return (high - low) / 2;
}

// The loop of displacement and force of the largest motion, computed from the springs of the
// contact law. The loss of a surface is computed without the law, so the loop is scaled to the
// force and displacement that were found for the surface.
detail::JointLoop loop_of(const JointArguments& arguments, const JointSolution& found,
                          Session& session) {
  const JointLoss& largest =
      *std::ranges::max_element(found.losses, {}, &JointLoss::tangential_amplitude);
  JointMotion motion{.tangential = TangentialAmplitude{largest.tangential_amplitude},
                     .normal_amplitude = found.largest.normal_amplitude,
                     .phase = found.largest.phase};
  if (!arguments.tangential_forces.empty() && motion.normal_amplitude > 0)
    motion.tangential = TangentialForce{largest.tangential_force};
  // An even number of steps contains the maximum and the minimum of a harmonic motion.
  detail::JointLoop loop =
      detail::joint_loop(*found.contact.law, found.state.indentation, motion,
                         *arguments.assumptions.friction_coefficient,
                         arguments.steps + arguments.steps % 2, session.context().on_progress);
  const double along = largest.tangential_amplitude / half_range_of(loop.displacement);
  const double up = largest.tangential_force / half_range_of(loop.tangential_force);
  for (double& x : loop.displacement) x *= along;
  for (double& force : loop.tangential_force) force *= up;
  return loop;
}

void check(const JointArguments& arguments) {
  std::vector<std::string> missing;
  if (!arguments.assumptions.friction_coefficient) missing.emplace_back("--friction-coefficient");
  if (arguments.tangential_forces.empty() && arguments.tangential_amplitudes.empty())
    missing.emplace_back("--tangential-forces or --tangential-amplitudes");
  require_options(missing, "a joint");
  require_that(arguments.tangential_forces.empty() || arguments.tangential_amplitudes.empty(),
               "--tangential-amplitudes",
               "given together with --tangential-forces; give one of them");
  require(!arguments.phase || arguments.normal_amplitude, "--phase", arguments.phase.value_or(0),
          "needs a normal oscillation; give --normal-amplitude");
  arguments.law.at.require_one("a joint takes one, with several tangential forces or amplitudes");
  require_that(arguments.hold.empty() || arguments.normal_amplitude, "--hold",
               "needs a normal oscillation; give --normal-amplitude");
  if (arguments.frequency) require_positive(*arguments.frequency, "--frequency");
  if (arguments.angular_frequency)
    require_positive(*arguments.angular_frequency, "--angular-frequency");
  require_that(!arguments.frequency || !arguments.angular_frequency, "--angular-frequency",
               "given together with --frequency; give one of them");
  if (arguments.law.nominal_area) require_positive(*arguments.law.nominal_area, "--nominal-area");
}

/// The contacts whose joints are solved: one, that of each surface of a study, or for a part of known
/// roughness five: with the decay length, with its limits, and between them. The softest has K_t/K
/// of a lay along the motion, the stiffest that of a lay across it, each for an endless stretch: with
/// ν from ρ = 2(1 − ν)/(2 − ν), K_t/K of strips is 1 − ν = ρ/(2 − ρ) along and 1 across.
std::vector<ContactProblem> contacts_of(const JointArguments& arguments, Session& session) {
  std::vector<ContactProblem> contacts = arguments.law.problems(
      arguments.material, session, arguments.assumptions.hardness, arguments.direction);
  if (arguments.law.of_roughness()) {
    const RoughnessLaw law = arguments.law.law_of_sides(arguments.material);
    const auto middle = std::get<ExponentialContact>(contacts.front());
    const double ratio = middle.modulus_ratio, along = ratio / (2 - ratio);
    // Between two bodies with Poisson's ratios of −1 … ½, G*/E* is from 2/3 to 4/3.
    constexpr double rounding = 1e-9;
    require(ratio > 2.0 / 3 - rounding && ratio < 4.0 / 3 + rounding, "--tangential-modulus", ratio,
            "of E* is outside 2/3 to 4/3, so that the effect of a lay is not known; give --law "
            "exponential");
    for (const auto& [length, lay] : {std::pair{law.decay_length_low, std::max(along, 1.0)},
                                      {law.decay_length_high, std::min(along, 1.0)}}) {
      contacts.emplace_back(ExponentialContact{length, lay, middle.normal_force});
      contacts.emplace_back(ExponentialContact{std::sqrt(length * middle.decay_length),
                                               std::sqrt(lay * ratio), middle.normal_force});
    }
  }
  return contacts;
}

std::vector<JointSolution> solve_all(const JointArguments& arguments, Session& session) {
  std::vector<JointSolution> solutions;
  for (ContactProblem& contact : contacts_of(arguments, session)) {
    JointProblem problem{
        .contact = std::move(contact),
        .normal_amplitude = arguments.normal_amplitude.value_or(0),
        .phase = arguments.phase.value_or(0),
        .hold = arguments.hold.empty() ? Hold::automatic : *parse_enum<Hold>(arguments.hold),
        .angular_frequency = arguments.angular_frequency.value_or(2 * std::numbers::pi *
                                                                  arguments.frequency.value_or(0)),
        .parameters = arguments.assumptions.parameters(arguments.material),
        .steps = arguments.steps,
        .direct_steps = arguments.direct_steps};
    if (arguments.law.nominal_area) problem.nominal_area = *arguments.law.nominal_area;
    for (const double force : arguments.tangential_forces)
      problem.motions.emplace_back(TangentialForce{force});
    for (const double amplitude : arguments.tangential_amplitudes)
      problem.motions.emplace_back(TangentialAmplitude{amplitude});
    solutions.push_back(solve(std::move(problem), session.context()));
  }
  return solutions;
}

/// The numbers of several joints with their limits, NAME_low and NAME_high. The joints are either
/// those of the surfaces of a study, with the mean and the 95 % prediction interval of one more
/// surface, or that of a part of known roughness, followed by its extremes.
class Limits {
 public:
  Limits(const std::vector<JointSolution>& solutions, bool extremes)
      : solutions_(solutions), extremes_(extremes) {}

  std::string meaning() const {
    if (extremes_)
      return "limits: 95 % of pairs of surfaces with this roughness, moved along or across a lay; "
             "a map of the surfaces gives narrower ones";
    return fmt::format(
        "means over {} surfaces; limits: 95 % prediction interval of one more surface",
        solutions_.size());
  }

  /// Adds the limits of the contact at rest.
  Json state() const {
    std::vector<Json> all;
    for (const JointSolution& one : solutions_) all.push_back(json_of(one.state));
    Json answer = Json::object();
    for (const auto& [name, value] : all.front().items()) {
      std::vector<double> values;
      for (const Json& one : all) values.push_back(one[name].number());
      std::vector<double> ratios;
      for (const double one : values) ratios.push_back(one / values.front());
      add(name, {limits_of(values)}, ratios,
          [&](const std::string& key, const auto& numbers) { answer[key] = numbers.front(); });
    }
    return answer;
  }

  ResultTable motions(double area) const {
    const bool several = solutions_.size() > 1;
    std::vector<ResultTable> all;
    for (const JointSolution& one : solutions_)
      all.push_back(table_of("motions", one.losses, several ? 0 : area));
    ResultTable table{.name = "motions", .columns = {}};
    for (const ResultColumn& column : all.front().columns) {
      // With its limits a number takes three columns: those that follow from the others are left out.
      constexpr std::array derived{"relaxation_work", "slip_work", "secant_stiffness", "exponent",
                                   "loss_stiffness",  "knee",      "mean_force",       "max_force",
                                   "contact_time",    "work_error"};
      if (several && std::ranges::find(derived, column.name) != derived.end()) continue;
      std::vector<EnsembleMean> limits;
      std::vector<double> every;
      for (std::size_t row = 0; row < column.values.size(); ++row) {
        std::vector<double> values;
        for (const ResultTable& one : all) {
          const auto same = std::ranges::find(one.columns, column.name, &ResultColumn::name);
          values.push_back(same == one.columns.end() ? JointLoss::unknown : same->values[row]);
        }
        limits.push_back(limits_of(values));
        if (extremes_ && column.name == "storage_stiffness" && slips(limits.size() - 1)) {
          // Where the contact begins to slide, k' depends on the form of the law: other laws with
          // the same decay length have up to a tenth more than the exponential one.
          constexpr double form = 1.15;
          limits.back().low /= form;
          limits.back().high *= form;
        }
        for (const double value : values) every.push_back(value / values.front());
      }
      add(column.name, limits, every, [&](const std::string& name, const auto& numbers) {
        table.columns.push_back({name, numbers});
      });
    }
    return table;
  }

  /// Says which regimes the joints have, if they differ in a motion; otherwise empty.
  std::string regimes() const {
    std::string text;
    for (std::size_t k = 0; k < solutions_.front().losses.size(); ++k) {
      std::vector<std::string_view> found;
      for (const JointSolution& one : solutions_)
        if (const auto name = name_of(one.losses[k].regime);
            std::ranges::find(found, name) == found.end())
          found.push_back(name);
      if (found.size() > 1)
        text += fmt::format("{}motion {}: {}", text.empty() ? "" : "; ", k + 1,
                            fmt::join(found, " or "));
    }
    return text.empty() ? "" : "within the limits the regime differs: " + text;
  }

 private:
  /// Whether slip takes more than a twentieth of the stiffness of the first joint in a motion; if it
  /// does not, k' is K_t.
  bool slips(std::size_t motion) const {
    const JointSolution& first = solutions_.front();
    return first.losses[motion].storage_stiffness < 0.95 * first.state.tangential_stiffness;
  }

  EnsembleMean limits_of(const std::vector<double>& values) const {
    if (!extremes_) return prediction(values);
    const auto [low, high] = std::ranges::minmax(values);
    return {values.front(), low, high};
  }
  /// Passes the values to `put` and, unless all joints have the same, their limits. ratios: values of
  /// the joints over that of the first.
  template <class Put>
  static void add(const std::string& name, const std::vector<EnsembleMean>& limits,
                  const std::vector<double>& ratios, const Put& put) {
    const bool same =
        std::ranges::none_of(ratios, [](double ratio) { return std::abs(ratio - 1) > 1e-9; });
    for (const auto& [end, member] : {std::pair{"", &EnsembleMean::mean},
                                      {"_low", &EnsembleMean::low},
                                      {"_high", &EnsembleMean::high}}) {
      std::vector<double> numbers;
      for (const EnsembleMean& one : limits) numbers.push_back(one.*member);
      put(name + end, numbers);
      if (same) break;
    }
  }

  const std::vector<JointSolution>& solutions_;
  bool extremes_;
};

/// A column of a table; empty if the table does not have it.
std::vector<double> values_of(const ResultTable& table, std::string_view name) {
  const auto column = std::ranges::find(table.columns, name, &ResultColumn::name);
  return column == table.columns.end() ? std::vector<double>() : column->values;
}

/// The losses as the table has them, of which pictures are made.
void take_numbers(std::vector<JointLoss>& losses, const ResultTable& table) {
  for (const auto& [name, member] : {std::pair{"tangential_force", &JointLoss::tangential_force},
                                     {"tangential_amplitude", &JointLoss::tangential_amplitude},
                                     {"work_per_cycle", &JointLoss::work_per_cycle}})
    if (const std::vector<double> values = values_of(table, name); !values.empty())
      for (std::size_t row = 0; row < losses.size(); ++row) losses[row].*member = values[row];
}

void run(const JointArguments& arguments, Session& session) {
  const bool direct = arguments.direct_steps.has_value();
  require_tables(session, direct ? std::vector<std::string>{"motions", "direct"}
                                 : std::vector<std::string>{"motions"});
  check(arguments);
  std::vector<JointSolution> solutions = solve_all(arguments, session);
  JointSolution& found = solutions.front();
  std::set<std::string> said;
  for (const JointSolution& one : solutions)
    for (const std::string& warning : one.contact.warnings)
      if (said.insert(warning).second) session.warn(warning);
  for (const std::string& warning : found.warnings) session.inform(warning);

  const double area = arguments.law.nominal_area.value_or(found.contact.nominal_area());
  const Limits limits(solutions, arguments.law.of_roughness());
  Json answer = Json::object();
  if (arguments.law.of_roughness())
    answer = json_of(arguments.law.law_of_sides(arguments.material));
  if (const double direction = found.contact.direction(); !std::isnan(direction))
    answer["direction"] = direction;
  answer.add(limits.state());
  arguments.material.add_datum_to(answer);
  std::vector<ResultTable> tables{limits.motions(area)};
  if (solutions.size() > 1) {
    session.inform(limits.meaning());
    if (const std::string differing = limits.regimes(); !differing.empty()) session.warn(differing);
  }
  if (direct) tables.push_back(table_of("direct", found.simulated, area));
  write_tables(session, "joint", answer, tables);
  for (const ResultColumn& column : tables.front().columns) answer[column.name] = column.values;
  Json& regimes = answer["regime"] = Json::array();
  for (const JointLoss& one : found.losses) regimes.push_back(name_of(one.regime));
  if (direct)
    for (const ResultColumn& column : tables.back().columns)
      answer["direct"][column.name] = column.values;
  take_numbers(found.losses, tables.front());
  const AssumptionReport assumptions{{found.assumptions}};
  if (session.has_plot()) {
    const detail::JointLoop loop = loop_of(arguments, found, session);
    figures::Figure figure =
        figures::figure_of(found.losses, loop.displacement, loop.tangential_force,
                           found.state.force, *arguments.assumptions.friction_coefficient,
                           {values_of(tables.front(), "work_per_cycle_low"),
                            values_of(tables.front(), "work_per_cycle_high")});
    assumptions.state_in(figure);
    session.plot(figure);
  }
  add_first_loading(answer, found.contact.first_loading);
  assumptions.answer(session, answer);
}

}  // namespace

void add_joint_command(Program& program) {
  auto arguments = std::make_shared<JointArguments>();
  Command& command = program.add_command(
      "joint", "partial slip under a tangential oscillation",
      {"salebra joint --law paraboloid --radius 10mm --normal-force 10 --contact-modulus 115GPa "
       "--poisson 0.3 --friction-coefficient 0.3 --tangential-forces 0.1:2.9N:12 --plot joint.png",
       "salebra joint --rms-height 0.8um,0.8um --pressure 30MPa --nominal-area 400mm2 --poisson "
       "0.3 "
       "--friction-coefficient 0.2 --tangential-amplitudes 0.1um,1um,5um --frequency 100Hz"},
      [arguments](Session& session) { run(*arguments, session); },
      "loss over force, loop and backbone", OutputCheck::any_name);
  arguments->law.add_to(command);
  arguments->law.add_roughness_to(command);
  arguments->material.add_to(command);
  arguments->material.add_body_to(command, "with --surface, or a --curve of such a body");
  add_quantity(command, "--nominal-area", arguments->law.nominal_area, Dimension::length_squared,
               "nominal area of the part: forces of --curve or --surface are scaled to it; with "
               "--law, for results per area");
  command.under("Motion");
  add_values(command, "--tangential-forces", arguments->tangential_forces, Dimension::force,
             "amplitudes T of a force between -T and T: one, a list or a range");
  add_values(command, "--tangential-amplitudes", arguments->tangential_amplitudes,
             Dimension::length,
             "amplitudes x of a displacement between -x and x, instead of --tangential-forces");
  add_direction(command, arguments->direction,
                "with --surface or --curve: direction of the tangential motion");
  add_quantity(command, "--normal-amplitude", arguments->normal_amplitude, Dimension::length,
               "amplitude u_z of the normal motion; without it the normal force is constant");
  add_quantity(command, "--phase", arguments->phase, Dimension::angle,
               "phase of the tangential motion against the normal one; default 0");
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "which mean value the normal oscillation keeps; default auto: the force if it "
                   "is given and the contact lifts off, otherwise the indentation");
  add_steps(command, arguments->steps, "steps per cycle with a normal oscillation; default 2000")
      ->range(16, 10000000);
  command
      .add_option(
          "--direct-steps", arguments->direct_steps,
          "with --surface: also simulate each motion cell by cell, with this many steps per cycle")
      ->range(16, 100000);
  add_quantity(command, "--frequency", arguments->frequency, Dimension::frequency,
               "frequency in Hz, for the damping constant and to check for inertia");
  add_quantity(command, "--angular-frequency", arguments->angular_frequency,
               Dimension::angular_frequency, "angular frequency in rad/s, instead of --frequency");
  arguments->assumptions.add_to(command, false);
}

}  // namespace salebra::cli
