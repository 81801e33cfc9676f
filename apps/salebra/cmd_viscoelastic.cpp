// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra viscoelastic`: losses of material and of relaxation damping on a viscoelastic body.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>  // analysis/ has no problem for it
#include <salebra/figures/figures.hpp>

#include "damping/phase_quadrature.hpp"
#include "figures/axes.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "several_files.hpp"
#include "viscoelastic_command.hpp"

namespace salebra::cli {
namespace {

/// Reads terms written as "G1:tau1,G2:tau2", modulus and relaxation time.
std::vector<PronyTerm> parse_terms(const std::string& text) {
  std::vector<PronyTerm> terms;
  std::string moduli, times;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string term = text.substr(begin, end - begin);
    const std::size_t colon = term.find(':');
    require(colon != term.npos, "--prony", '\'' + term + '\'',
            "is not of the form MODULUS:TIME; write for example 10MPa:1ms,2MPa:0.1s");
    terms.push_back({parse_quantity(term.substr(0, colon), Dimension::pressure, "--prony"),
                     parse_quantity(term.substr(colon + 1), Dimension::time, "--prony")});
    moduli += (begin > 0 ? "," : "") + term.substr(0, colon);
    times += (begin > 0 ? "," : "") + term.substr(colon + 1);
    begin = end + 1;
  }
  // Refuses a list in which only some of the moduli, or only some of the times, have units.
  parse_values(moduli, Dimension::pressure, "--prony");
  parse_values(times, Dimension::time, "--prony");
  return terms;
}

// Computes the loss of each motion.
std::vector<ViscoelasticLoss> losses_of(const ViscoelasticArguments& arguments,
                                        const IndenterLaw& law, const PronySeries& prony,
                                        double indentation, Session& session) {
  std::vector<ViscoelasticLoss> losses;
  const std::vector<Oscillation> motions = arguments.motion.motions();
  const Progress progress = session.progress();
  for (const Oscillation& motion : motions)
    losses.push_back(viscoelastic_loss(
        law, prony, motion, indentation,
        {.steps = arguments.steps.value_or(512),
         .springs = arguments.springs.value_or(200),
         .on_progress = [&](auto report) {
           report.fraction = (double(losses.size()) + report.fraction) / double(motions.size());
           return progress(report);
         }}));
  if (const auto lost = std::ranges::count_if(
          losses, [](const ViscoelasticLoss& one) { return !one.damping.converged; });
      lost > 0)
    throw NotConverged(
        fmt::format("viscoelastic: {} of {} steady states were not found; add relaxation times "
                    "beyond 1e9 periods to the relaxed modulus or leave them out",
                    lost, losses.size()));
  return losses;
}

void run(ViscoelasticArguments arguments, Session& session) {
  const std::vector<std::string> files = arguments.surface.several(!arguments.csv.empty());
  if (!files.empty()) return lose_of_files(std::move(arguments), files, session);
  require_that(arguments.csv.empty(), "--csv", "needs the files of surfaces; give SURFACE");
  if (arguments.surface.given()) return run_on_surface(arguments, session);
  require_tables(session, {"motions"});
  for (const auto& [given, option] : {std::pair(!arguments.body_file.empty(), "--body"),
                                      {arguments.point.pressure.has_value(), "--pressure"},
                                      {arguments.point.mean_gap.has_value(), "--mean-gap"},
                                      {arguments.tolerance.has_value(), "--tolerance"},
                                      {arguments.hold != "auto", "--hold"},
                                      {!arguments.creep.empty(), "--creep"}})
    require(!given, option, "", "applies to a rough surface; give SURFACE too");
  std::vector<std::string> missing = arguments.motion.missing();
  if (arguments.prony.empty()) missing.insert(missing.begin(), "--prony");
  if (arguments.indenter.law.empty()) missing.insert(missing.begin(), "--law (or SURFACE)");
  if (arguments.motion.mode != "drag" && !arguments.motion.frequency.given())
    missing.emplace_back("--frequency (or --angular-frequency)");
  require_options(missing, "the loss on a viscoelastic body");
  require(
      arguments.material.young.size() <= 1, "--young", arguments.material.young.size(),
      "values given; the indenter is rigid, so give only the relaxed modulus of the other body");
  const Material material = arguments.material.material_with_tangential_modulus();
  const PronySeries prony = PronySeries::of_body(material, parse_terms(arguments.prony));
  prony.validate();
  const auto profile = arguments.indenter.indenter();
  const auto any_law = law_of(IndenterContact{profile, material, {}}, session.context());
  const auto& law = static_cast<const IndenterLaw&>(*any_law);
  require_one(arguments.point.indentation.has_value(), "--indentation",
              arguments.point.force.has_value(), "--normal-force");
  if (arguments.point.indentation) require_positive(*arguments.point.indentation, "--indentation");
  const double indentation = arguments.point.indentation
                                 ? *arguments.point.indentation
                                 : law.indentation_of(*arguments.point.force);
  session.warn(warnings_of_profile(*profile, law.contact_radius(indentation)));
  const ContactParameters known = arguments.assumptions.parameters(arguments.material);
  const std::vector<ViscoelasticLoss> losses =
      losses_of(arguments, law, prony, indentation, session);
  AssumptionReport assumptions{.list = true, .body = "relaxed elastic body"};
  for (const Oscillation& motion : arguments.motion.motions())
    assumptions.cases.push_back(
        assumptions_of(law, indentation, motion,
                       at_state(known, law, nullptr, indentation,
                                indentation + detail::normal_amplitude(motion))));

  Json answer = json_of(state_of(*any_law, indentation));
  answer.add(json_of(prony));
  ResultTable table = table_of("motions", losses);
  const auto [quantity, values] = arguments.motion.varied();
  if (!values.empty() && quantity != "angular_frequency")
    table.columns.insert(table.columns.begin(), {quantity, values});
  write_tables(session, "viscoelastic", answer, {table});
  for (const ResultColumn& column : table.columns) answer[column.name] = column.values;
  if (session.has_plot()) {
    figures::Figure figure =
        figures::figure_of(table.columns.front().name, table.columns.front().values, losses);
    figure.caption +=
        fmt::format(" Indenter: {}, δ = {}; shear modulus {} (relaxed) to {}.",
                    arguments.indenter.in_words(),
                    format_quantity(indentation, Dimension::length, 4),
                    format_quantity(prony.relaxed_modulus, Dimension::pressure, 4),
                    format_quantity(prony.unrelaxed_modulus(), Dimension::pressure, 4)) +
        motion_of_caption(arguments);
    assumptions.state_in(figure);
    session.plot(figure);
  }
  assumptions.answer(session, answer);
}

}  // namespace

std::string motion_of_caption(const ViscoelasticArguments& arguments) {
  const std::string varied = arguments.motion.varied().first;
  const auto text = [&](const auto& motion) {
    return figures::motion_text(motion, varied == "frequency" ? "angular_frequency" : varied);
  };
  const std::optional<double>& pressure = arguments.point.pressure;
  return " Motion: " + std::visit(text, arguments.motion.motions().front()) +
         (pressure ? ", p = " + format_quantity(*pressure, Dimension::pressure, 4) : "") + ".";
}

void add_viscoelastic_command(Program& program) {
  auto arguments = std::make_shared<ViscoelasticArguments>();
  Command& command = program.add_command(
      "viscoelastic", "losses of an indenter or a surface on rubber",
      {"salebra viscoelastic --law sphere --radius 5mm --indentation 20um --contact-modulus "
       "4MPa --poisson 0.5 --prony 3MPa:20ms --mode equal-frequency --normal-amplitude 2um "
       "--tangential-amplitude 1um --phase 90deg --frequency 0.1Hz:1kHz:25 --plot losses.png",
       "salebra viscoelastic rough.h5 --body rubber.toml --pressure 50kPa --mode equal-frequency "
       "--normal-amplitude 100nm --tangential-amplitude 50nm --phase 90deg --frequency 1Hz:1kHz:7"},
      [arguments](Session& session) { run(*arguments, session); },
      "losses and complex modulus over the quantity that varies, or the contact over the time",
      OutputCheck::any_name);
  arguments->surface.add_several_to(command);
  add_table_file(command, arguments->csv);
  arguments->indenter.add_to(command);
  arguments->point.add_to(command);
  arguments->material.add_to(command);
  command.under("Material");
  command
      .add_option("--prony", arguments->prony,
                  "terms G1:T1,G2:T2,... of the shear relaxation modulus, such as 3MPa:20ms, added "
                  "to the relaxed modulus of the other options")
      ->type_name("LIST");
  command
      .add_option("--body", arguments->body_file,
                  "file of the body under SURFACE, with [[relaxation]] tables of its weights "
                  "G_i/G_inf and times")
      ->file(FileUse::input);
  command.under("Options");
  add_values(command, "--creep", arguments->creep, Dimension::time,
             "times at which a load or indentation, applied to one SURFACE at time 0 and held, is "
             "answered in place of a motion, such as 1ms:10s:9; without --csv");
  arguments->motion.add_to(command);
  add_steps(command, arguments->steps,
            "straight steps per cycle; default 512, with SURFACE 64, even; between the times of "
            "--creep 16, even")
      ->range(2, 1000000);
  command
      .add_option("--springs", arguments->springs,
                  "number of springs in the ring that opens and closes; default 200")
      ->range(8, 1000000);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "mean value that the oscillation of SURFACE keeps; auto: the mean force if a "
                   "force is given and the contact would lift off, else the indentation");
  add_quantity(command, "--tolerance", arguments->tolerance, Dimension::dimensionless,
               "largest distance from the periodic state with SURFACE, over the amplitude; default "
               "1e-4");
  arguments->assumptions.add_to(command);
}

}  // namespace salebra::cli
