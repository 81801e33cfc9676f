// SPDX-License-Identifier: GPL-3.0-or-later
// Options and answers for the assumptions of a damping constant.
#include "assumption_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>

#include "option_words.hpp"
#include "results/answer_json.hpp"
#include "terminal.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

/// The option that sets a contact parameter, as JSON text; the parameter is named as in the
/// library.
Json option_of(const std::string& parameter) {
  std::string option = "--" + given_as(parameter);
  std::ranges::replace(option, '_', '-');
  return option;
}

/// The largest motions without slip, of the first case for which they are known.
const std::vector<MaxMotion>& any_max(const std::vector<Assumptions>& cases) {
  const auto judged =
      std::ranges::find_if(cases, [](const Assumptions& p) { return !p.largest.empty(); });
  return judged == cases.end() ? cases.front().largest : judged->largest;
}

}  // namespace

void AssumptionOptions::add_to(Command& command, bool excursion_judged) {
  const std::string group = "Assumptions";
  add_quantity(command, "--friction-coefficient", friction_coefficient, Dimension::dimensionless,
               "Coulomb coefficient of friction, used to compute slip or to check for it")
      ->group(group);
  add_quantity(command, "--hardness", hardness, Dimension::pressure,
               "hardness of the softer body. A surface is first loaded to its largest pressure, "
               "with local pressures up to the hardness, and the results are those of the "
               "unloading curve; with a law it only serves to check for yielding")
      ->group(group);
  add_quantity(command, "--density", density, Dimension::mass_density,
               "mass density of the elastic body, to check for inertia")
      ->group(group);
  if (!excursion_judged) return;
  add_quantity(command, "--excursion", excursion, Dimension::length,
               "distance of the slow motion from one turning point to the other, to compute slip "
               "or to check for it")
      ->group(group);
}

ContactParameters AssumptionOptions::parameters(const MaterialOptions& material,
                                                const std::optional<double>& followed) const {
  ContactParameters parameters;
  for (const auto& [option, value, parameter] :
       {std::tuple{"--friction-coefficient", &friction_coefficient,
                   &parameters.friction_coefficient},
        std::tuple{"--hardness", &hardness, &parameters.hardness},
        std::tuple{"--density", &density, &parameters.density},
        std::tuple{"--excursion", &excursion, &parameters.excursion}}) {
    if (!*value) continue;
    require_positive(**value, option);
    *parameter = **value;
  }
  if (followed && std::isfinite(*followed) && *followed > 0) {
    require(!friction_coefficient || *friction_coefficient == *followed, "--friction-coefficient",
            parameters.friction_coefficient, "differs from --friction; give one of them");
    parameters.friction_coefficient = *followed;
  }
  if (material.contact_modulus || !material.young.empty())
    parameters.contact_modulus = material.material().contact_modulus;
  if (material.young.size() == 2 && material.poisson.size() == 2)
    parameters.dundurs =
        std::numbers::pi * parameters.contact_modulus * material.coupling_constant();
  return parameters;
}

std::vector<AssumptionVerdict> AssumptionReport::all_verdicts() const {
  std::vector<AssumptionVerdict> all = verdicts_of(cases, slip_followed, pressures);
  // If the assumptions were checked for another body than that of the answer, the loss is only
  // known without slip, and the advice must not name slip.
  if (!body.empty())
    for (AssumptionVerdict& one : all)
      if (!one.remedy.empty() && one.name.starts_with("slip_of"))
        one.remedy = "reduce the motion; slip is not computed here";
  all.insert(all.begin(), others.begin(), others.end());
  sort_worst_first(all);
  return all;
}

void AssumptionReport::state_in(figures::Figure& figure) const {
  figures::state_validity(figure, all_verdicts());
}

void AssumptionReport::add_to(Json& answer) const {
  const std::vector<AssumptionVerdict> judged = all_verdicts();
  answer["validity"] = std::string(name_of(validity_of(judged)));
  Json& verdicts = answer["verdicts"] = Json::array();
  for (AssumptionVerdict one : judged) {
    one.here = in_options(one.here);
    one.remedy = in_options(one.remedy);
    verdicts.push_back(to_json(one));
  }
  const auto column = [&](const auto& value_of) -> Json {
    if (!list) return value_of(cases.front());
    Json all = Json::array();
    for (const Assumptions& assumptions : cases) all.push_back(value_of(assumptions));
    return all;
  };
  const auto of_cases = [&](const auto& all) { return list ? json_of(all) : json_of(all.front()); };
  Json& object = answer["assumptions"] = Json::object();
  for (const AssumptionName& name : assumption_names()) {
    std::vector<Assumption> assumptions;
    for (const Assumptions& one : cases) assumptions.push_back(one.*name.assumption);
    Json& one = object[name.name] = of_cases(assumptions);
    const auto lacking = std::ranges::find_if(
        assumptions, [](const Assumption& assumption) { return !assumption.needs.empty(); });
    one["needs"] = lacking == assumptions.end() ? Json() : option_of(lacking->needs);
  }
  if (!body.empty()) answer["assumptions_of"] = body;
  const std::vector<MaxMotion>& largest = any_max(cases);
  const bool known =
      std::ranges::any_of(cases, [](const Assumptions& p) { return p.regime != Regime::unknown; });
  if (known || !largest.empty())
    answer["regime"] = column([](const Assumptions& p) -> Json {
      return p.regime == Regime::unknown ? Json(nullptr) : Json(name_of(p.regime));
    });
  Json& described = answer["max_motion"] = Json::array();
  for (std::size_t i = 0; i < largest.size(); ++i) {
    std::vector<MaxMotion> motions;
    for (const Assumptions& p : cases)
      motions.push_back(p.largest.empty() ? MaxMotion{} : p.largest[i]);
    Json one = of_cases(motions);
    one["friction_coefficient"] = largest[i].friction_coefficient;
    described.push_back(std::move(one));
  }
}

std::string AssumptionReport::text() const {
  const std::vector<AssumptionVerdict> verdicts = all_verdicts();
  std::string text;
  const std::string largest = motion_without_slip(cases);
  const bool judged = std::ranges::any_of(verdicts, [](const AssumptionVerdict& one) {
    return one.name == "slip_of_opening_springs" && one.verdict != Verdict::unknown;
  });
  if (!slip_followed && !judged && !largest.empty())
    text = wrapped("Without slip up to " + largest + "\n", text_width());
  text += fmt::format("Validity: {}\n{}", name_of(validity_of(verdicts)),
                      in_options(in_words(verdicts)));
  if (const std::string regimes = regimes_in_words(cases, pressures);
      !regimes.empty() && warning().empty())
    text += wrapped("Regime: " + regimes + "\n", text_width());
  if (!body.empty()) text += "The assumptions were checked for the " + body + "\n";
  return text;
}

std::string AssumptionReport::warning() const {
  for (const AssumptionVerdict& one : all_verdicts())
    if (one.name == "regime")
      return wrapped(
          in_options(fmt::format("Regime: {}. {}; {}\n", regimes_in_words(cases, pressures),
                                 one.here.substr(0, one.here.find(';')), one.remedy)),
          text_width());
  return "";
}

void AssumptionReport::answer(Session& session, Json object, const std::string& text) const {
  add_to(object);
  session.answer(object, warning() + text + "\n" + this->text());
}

void AssumptionReport::answer(Session& session, Json object) const {
  const std::string text = to_text(object);
  answer(session, std::move(object), text);
}

}  // namespace salebra::cli
