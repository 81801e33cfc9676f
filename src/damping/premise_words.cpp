// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the premises of a damping constant, and what is broken or doubtful in words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/damping/premises.hpp>

namespace salebra {
namespace {

/// "at 1 MPa to 5 MPa, 20 MPa", one for each run of pressures.
std::string runs_of(const std::vector<bool>& chosen, std::span<const double> pressures) {
  const auto at = [&](std::size_t k) { return format_quantity(pressures[k], Dimension::pressure); };
  std::string text;
  for (std::size_t first = 0; first < pressures.size(); ++first) {
    if (!chosen[first]) continue;
    std::size_t last = first;
    while (last + 1 < pressures.size() && chosen[last + 1]) ++last;
    text += (text.empty() ? "at " : ", ") + at(first) + (last > first ? " to " + at(last) : "");
    first = last;
  }
  return text;
}

double first_limit(const Premise& premise) {
  return std::isnan(premise.onset) ? premise.limit_5_percent : premise.onset;
}

/// "M = 0.054 (5 % of the loss at 9.4)", of the case that is worst.
std::string one_objection(const PremiseName& name, std::span<const Premises> cases,
                          std::span<const double> pressures, Verdict verdict) {
  std::vector<bool> objected;
  const Premise* worst = nullptr;
  for (const Premises& premises : cases) {
    const Premise& premise = premises.*name.premise;
    objected.push_back(premise.verdict == verdict);
    if (!objected.back()) continue;
    const auto beyond = [](const Premise& p) {
      return std::abs(std::log(p.value / first_limit(p)));
    };
    if (worst == nullptr || beyond(premise) > beyond(*worst)) worst = &premise;
  }
  if (worst == nullptr) return "";
  const auto quantity = [&](double value) {
    return format_quantity(value, name.value_dimension, 3);
  };
  std::string text;
  if (worst->limit_20_percent == 0)
    text = fmt::format("{}, at this velocity on any {}", name.meaning, name.value);
  else
    text = fmt::format("{}, {} {} ({} at {})", name.meaning, name.value, quantity(worst->value),
                       std::isnan(worst->onset) ? "5 % of the loss" : "flow begins",
                       quantity(first_limit(*worst)));
  const auto count = std::ranges::count(objected, true);
  if (cases.size() == 1) return text;
  if (pressures.empty()) return text + fmt::format(" in {} of {}", count, cases.size());
  return text + (std::size_t(count) == cases.size() ? " at all pressures"
                                                    : " " + runs_of(objected, pressures));
}

/// The option or key that gives a fact.
std::string given_as(const std::string& fact) {
  // A law given by its formula has neither size nor pressure.
  if (fact == "loaded_size" || fact == "largest_pressure") return "curve";
  return fact == "angular_frequency" ? "frequency" : fact;
}

std::string objections_of(std::span<const Premises> cases, std::span<const double> pressures,
                          Verdict verdict, const char* heading) {
  std::string text;
  for (const PremiseName& name : premise_names())
    if (const std::string one = one_objection(name, cases, pressures, verdict); !one.empty())
      text += (text.empty() ? heading : "; ") + one;
  return text.empty() ? "" : text + "\n";
}

}  // namespace

std::span<const PremiseName> premise_names() {
  static const auto names = [] {
    std::vector<PremiseName> all;
    describe(
        [&]<class Line>(auto member, const Line& line) {
          if constexpr (std::is_same_v<Line, PremiseWords>) all.push_back({line, member});
        },
        std::type_identity<Premises>{});
    return all;
  }();
  return names;
}

std::string objections(std::span<const Premises> cases, std::span<const double> pressures) {
  return objections_of(cases, pressures, Verdict::broken, "Premises broken: ") +
         objections_of(cases, pressures, Verdict::doubtful, "Premises doubtful: ");
}

std::string open_points(std::span<const Premises> cases) {
  std::string open, largest;
  for (const PremiseName& name : premise_names()) {
    const auto unknown = std::ranges::find(
        cases, Verdict::unknown, [&](const Premises& p) { return (p.*name.premise).verdict; });
    if (unknown == cases.end()) continue;
    const std::string needs = given_as(((*unknown).*name.premise).needs);
    open += fmt::format("{}{}{}", open.empty() ? "Premises not judged: " : ", ", name.meaning,
                        needs.empty() ? "" : fmt::format(" (`{}`)", needs));
  }
  const auto judged =
      std::ranges::find_if(cases, [](const Premises& p) { return !p.largest.empty(); });
  for (std::size_t i = 0; judged != cases.end() && i < judged->largest.size(); ++i) {
    double velocity = HUGE_VAL, amplitude = HUGE_VAL;
    for (const Premises& p : cases) {
      if (p.largest.empty()) continue;
      velocity = std::fmin(velocity, p.largest[i].drag_velocity);
      amplitude = std::fmin(amplitude, p.largest[i].tangential_amplitude);
    }
    const bool drag = std::isfinite(velocity);
    if (!drag && !std::isfinite(amplitude)) continue;
    // The limit of case (b) is that of the opening levels alone.
    if (largest.empty())
      largest = fmt::format("Slip{} changes the loss by less than 5 % up to ",
                            drag ? " where the contact opens and closes" : "");
    else
      largest += ", ";
    largest += fmt::format("{} with friction {:g}",
                           drag ? format_quantity(velocity, Dimension::velocity, 3)
                                : format_quantity(amplitude, Dimension::length, 3),
                           judged->largest[i].friction_coefficient);
  }
  return (open.empty() ? "" : open + "\n") + (largest.empty() ? "" : largest + "\n");
}

}  // namespace salebra
