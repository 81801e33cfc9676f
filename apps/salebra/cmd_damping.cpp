// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/damping/dissipation.hpp>

#include "answer_file.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct DampingArguments {
  LawOptions law;
  std::string amplitude = "finite", hold = "indentation";
  MaterialOptions material;
  MotionOptions motion;
};

void run(const DampingArguments& arguments, Session& session) {
  const std::vector<Oscillation> motions = arguments.motion.motions();
  const LawOptions::Contact contact = arguments.law.contact(arguments.material);
  const auto& positions = contact.positions;
  require(positions.size() == 1 || motions.size() == 1, "--force-newton",
          fmt::format("{} values", positions.size()),
          "are a second range; only one quantity may be a range");

  DampingOptions options;
  options.hold = arguments.hold == "force" ? Hold::force : Hold::indentation;
  options.amplitude = arguments.amplitude == "small" ? Amplitude::small : Amplitude::finite;
  options.on_progress = session.progress();
  std::vector<DampingCase> cases;
  for (std::size_t i = 0; i < std::max(positions.size(), motions.size()); ++i) {
    cases.push_back(
        {positions[positions.size() == 1 ? 0 : i], motions[motions.size() == 1 ? 0 : i]});
  }
  const auto results = relaxation_damping(*contact.law, cases, options);
  const auto lost = std::ranges::count(results, false, &DampingResult::converged);

  const auto column = [&](double DampingResult::*quantity) -> Json {
    if (cases.size() == 1) return results.front().*quantity;
    Json values = Json::array();
    for (const DampingResult& result : results) values.push_back(result.*quantity);
    return values;
  };
  Json object;
  if (const auto& [name, values] = arguments.motion.varied(); !values.empty())
    object[name] = values;
  object["work_per_cycle"] = column(&DampingResult::work_per_cycle);
  object["power"] = column(&DampingResult::power);
  object["damping_constant"] = column(&DampingResult::damping_constant);
  object["curvature"] = column(&DampingResult::curvature);
  object["force"] = column(&DampingResult::force);
  if (lost == 0) write_answer(session, "damping", object);
  if (cases.size() == 1 && options.amplitude == Amplitude::finite) {
    const DampingResult& result = results.front();
    session.note(fmt::format("the small-amplitude form, {}, gives {:+.2g} % here",
                             arguments.motion.mode == "drag" ? "Eq. (15)" : "Eq. (12)",
                             100 * (result.small_amplitude_work / result.work_per_cycle - 1)));
  }
  session.answer(object);
  if (lost > 0) {
    throw NotConverged(fmt::format("damping: {} of {} integrals did not reach the tolerance", lost,
                                   results.size()));
  }
}

}  // namespace

void add_damping_command(Program& program) {
  auto arguments = std::make_shared<DampingArguments>();
  CLI::App& command = program.add_command(
      "damping", "relaxation damping of a contact under an oscillation",
      {"salebra damping --law exponential --force-newton 1 --decay-length 100nm --poisson 0.3 "
       "--normal-amplitude 5nm --drag-velocity 1mm/s --frequency 20kHz --amplitude small",
       "salebra damping --curve curve.h5 --pressure 10MPa --poisson 0.3 --normal-amplitude "
       "1:20nm:8 --drag-velocity 1mm/s --frequency 20kHz"},
      [arguments](Session& session) { run(*arguments, session); });
  arguments->law.add_to(command);
  arguments->motion.add_to(command);
  add_choice(command, "--amplitude", arguments->amplitude, {"small", "finite"},
             "of the normal oscillation; default finite");
  add_choice(command, "--hold", arguments->hold, {"indentation", "force"},
             "what stays in the mean; default indentation");
  arguments->material.add_to(command);
}

}  // namespace salebra::cli
