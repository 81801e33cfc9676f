// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the premises of a damping constant, and what is broken or doubtful in words.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <salebra/damping/premises.hpp>

namespace salebra {
namespace {

/// "M = 0.054 (5 % of the loss at 9.4)", of the case that is worst.
std::string one_objection(const PremiseName& name, std::span<const Premises> cases,
                          Verdict verdict) {
  std::size_t count = 0;
  const Premise* worst = nullptr;
  for (const Premises& premises : cases) {
    const Premise& premise = premises.*name.premise;
    if (premise.verdict != verdict) continue;
    ++count;
    const auto beyond = [](const Premise& p) {
      return std::abs(std::log(p.value / p.limit_5_percent));
    };
    if (worst == nullptr || beyond(premise) > beyond(*worst)) worst = &premise;
  }
  if (worst == nullptr) return "";
  const auto quantity = [&](double value) { return format_quantity(value, name.dimension, 3); };
  std::string text;
  if (worst->limit_20_percent == 0)
    text = fmt::format("{}, at this velocity on any {}", name.words, name.value);
  else
    text = fmt::format("{}, {} {} (5 % of the loss at {})", name.words, name.value,
                       quantity(worst->value), quantity(worst->limit_5_percent));
  if (cases.size() > 1) text += fmt::format(" in {} of {}", count, cases.size());
  return text;
}

std::string objections_of(std::span<const Premises> cases, Verdict verdict, const char* heading) {
  std::string text;
  for (const PremiseName& name : premise_names())
    if (const std::string one = one_objection(name, cases, verdict); !one.empty())
      text += (text.empty() ? heading : "; ") + one;
  return text.empty() ? "" : text + "\n";
}

}  // namespace

std::span<const PremiseName> premise_names() {
  static constexpr std::array names{
      PremiseName{"slip_of_opening_levels", &Premises::slip_of_opening_levels,
                  "slip where the contact opens and closes", "M =", Dimension::dimensionless},
      PremiseName{"slip_of_closed_levels", &Premises::slip_of_closed_levels,
                  "slip where it stays closed", "excursion", Dimension::length},
      PremiseName{"slow_motion", &Premises::slow_motion, "slow tangential motion",
                  "X/w =", Dimension::dimensionless},
      PremiseName{"amplitude", &Premises::amplitude, "small amplitude of Eqs (12), (15) and (16)",
                  "u_z =", Dimension::length},
      PremiseName{"plasticity", &Premises::plasticity, "plasticity", "pressure over hardness",
                  Dimension::dimensionless},
      PremiseName{"inertia", &Premises::inertia, "inertia", "ωa/c_s =", Dimension::dimensionless},
      PremiseName{"coupling", &Premises::coupling, "coupling", "share of the loss",
                  Dimension::dimensionless},
  };

  return names;
}

std::string objections(std::span<const Premises> cases) {
  return objections_of(cases, Verdict::broken, "Premises broken: ") +
         objections_of(cases, Verdict::doubtful, "Premises doubtful: ");
}

}  // namespace salebra
