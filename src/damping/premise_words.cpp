// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the premises of a damping constant, and what is broken or doubtful in words.
#include <fmt/format.h>

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
  const auto quantity = [&](double value) {
    return format_quantity(value, name.value_dimension, 3);
  };
  std::string text;
  if (worst->limit_20_percent == 0)
    text = fmt::format("{}, at this velocity on any {}", name.meaning, name.value);
  else
    text = fmt::format("{}, {} {} (5 % of the loss at {})", name.meaning, name.value,
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

std::string objections(std::span<const Premises> cases) {
  return objections_of(cases, Verdict::broken, "Premises broken: ") +
         objections_of(cases, Verdict::doubtful, "Premises doubtful: ");
}

}  // namespace salebra
