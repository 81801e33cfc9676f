// SPDX-License-Identifier: GPL-3.0-or-later
// The verdicts on the assumptions of a damping constant as text, and the overall validity.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <salebra/results/assumption_verdicts.hpp>

namespace salebra {
namespace {

/// Lists the chosen pressures, neighbouring ones as a range: "at 1 MPa to 5 MPa, 20 MPa".
std::string runs_of(const std::vector<bool>& chosen, std::span<const double> pressures) {
  const auto at = [&](std::size_t k) {
    return format_quantity(pressures[k], Dimension::pressure, 3);
  };
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

/// Says in which cases something applies: "at all loads", "in 2 of 5" (without pressures), "at 1
/// MPa to 5 MPa"; empty if there is only one case. chosen: whether it applies, for each case.
std::string which_of(const std::vector<bool>& chosen, std::span<const double> pressures) {
  const auto count = std::size_t(std::ranges::count(chosen, true));
  return chosen.size() == 1       ? ""
         : count == chosen.size() ? "at all loads"
         : pressures.empty()      ? fmt::format("in {} of {}", count, chosen.size())
                                  : runs_of(chosen, pressures);
}

/// Order of severity: 0 for the worst verdict. Unknown lies between doubtful and holds.
int rank_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::broken:
      return 0;
    case Verdict::doubtful:
      return 1;
    case Verdict::unknown:
      return 2;
    case Verdict::holds:
      return 3;
  }
  return 3;
}

double first_limit(const Assumption& assumption) {
  return std::isnan(assumption.onset) ? assumption.limit_5_percent : assumption.onset;
}

/// Ratio of the value of the assumption to its first limit, as |ln(value/limit)|.
double distance(const Assumption& assumption) {
  return std::abs(std::log(assumption.value / first_limit(assumption)));
}

/// The case whose assumption decides the verdict on all cases: that with the worst verdict. Among
/// equal verdicts it is the case farthest beyond the limit or, if the assumption holds, the one
/// closest to it.
const Assumption& worst_of(const AssumptionName& name, std::span<const Assumptions> cases) {
  const auto worse = [&](const Assumptions& one, const Assumptions& other) {
    const Assumption &a = one.*name.assumption, &b = other.*name.assumption;
    if (rank_of(a.verdict) != rank_of(b.verdict)) return rank_of(a.verdict) < rank_of(b.verdict);
    if (std::isnan(distance(a)) || std::isnan(distance(b))) return std::isnan(distance(b));
    return a.verdict == Verdict::holds ? distance(a) < distance(b) : distance(a) > distance(b);
  };
  return (*std::ranges::min_element(cases, worse)).*name.assumption;
}

std::string assumption_text(const AssumptionName& name, const Assumption& assumption) {
  // For plasticity after a first loading the value is the load divided by the first load, and
  // yielding begins at 1.
  if (assumption.onset == 1) return "elastic again: loads below the largest of the first loading";
  // At this velocity no motion satisfies the assumption, so there is no limit to name.
  if (assumption.limit_20_percent == 0) return std::string(name.meaning) + " at any motion";
  // Without a known limit the text ends with the meaning of the value.
  if (!std::isfinite(first_limit(assumption)) ||
      (assumption.verdict == Verdict::unknown && assumption.needs.empty()))
    return std::string(name.statement.substr(0, name.statement.find(": ")));
  return fmt::format(fmt::runtime(name.statement),
                     format_quantity(first_limit(assumption), name.value_dimension, 3));
}

AssumptionVerdict verdict_of(const AssumptionName& name, std::span<const Assumptions> cases,
                             std::span<const double> pressures) {
  const Assumption& worst = worst_of(name, cases);
  AssumptionVerdict one{.name = std::string(name.name),
                        .verdict = worst.verdict,
                        .assumption = assumption_text(name, worst)};
  if (worst.verdict == Verdict::unknown) {
    one.here = worst.needs.empty() ? "not known for this motion"
                                   : fmt::format("`{}` not given", given_as(worst.needs));
    return one;
  }
  if (!std::isnan(worst.value))
    one.here =
        fmt::format(fmt::runtime(name.here), format_quantity(worst.value, name.value_dimension, 3));
  if (worst.verdict == Verdict::holds) return one;
  one.remedy = name.remedy;
  std::vector<bool> objected;
  for (const Assumptions& assumptions : cases)
    objected.push_back((assumptions.*name.assumption).verdict == worst.verdict);
  if (const std::string which = which_of(objected, pressures); !which.empty())
    one.here += ", " + which;
  return one;
}

/// Only under a slow drag is the number of normal cycles per excursion known.
bool is_slow_motion(const Assumptions& assumptions) {
  return !std::isnan(assumptions.slow_motion.value);
}

/// The verdict on the regime of a contact in gross sliding: its loss is right, but the damping
/// constant γ depends on the velocity.
AssumptionVerdict no_damper(std::span<const Assumptions> cases, std::span<const double> pressures) {
  AssumptionVerdict one{.name = "regime",
                        .verdict = Verdict::broken,
                        .assumption = "a damper: the contact does not slide as a whole"};
  std::vector<bool> sliding;
  for (const Assumptions& assumptions : cases)
    sliding.push_back(assumptions.regime == Regime::sliding);
  const Assumptions& first = *std::ranges::find(cases, Regime::sliding, &Assumptions::regime);
  one.here = is_slow_motion(first) ? "γ = µF/v: Coulomb friction, not a damper"
                                   : "γ = 4µF/(πωu_x): Coulomb friction, not a damper";
  one.remedy =
      is_slow_motion(first) ? "use `salebra sliding`" : "use the energy dissipated in a cycle";
  if (const std::string which = which_of(sliding, pressures); !which.empty())
    one.here += "; " + which;
  return one;
}

}  // namespace

std::span<const AssumptionName> assumption_names() {
  static constexpr AssumptionName names[] = {
      {&Assumptions::slip_of_opening_springs, "slip_of_opening_springs",
       "slip where the contact opens and closes", "no slip where it opens and closes: M above {}",
       "M = {}", "use the loss with slip, which `friction_coefficient` gives"},
      {&Assumptions::slip_of_closed_springs, "slip_of_closed_springs", "slip where it stays closed",
       "no slip where it stays closed: excursion below {}", "{}",
       "use the loss with slip, which `friction_coefficient` gives", Dimension::length},
      {&Assumptions::slow_motion, "slow_motion", "slow tangential motion",
       "slow: at least {} normal cycles in an excursion", "{}",
       "a longer `excursion`, or the motion with its two frequencies"},
      {&Assumptions::amplitude, "amplitude", "small amplitude of Eqs (12), (15) and (16)",
       "Eqs (12), (15) and (16): amplitude below {}", "{}",
       "the damping constant itself has no such limit", Dimension::length},
      {&Assumptions::plasticity, "plasticity", "plasticity",
       "elastic: pressure on spots below {} of the hardness", "{} at peak",
       "reduce the load; a surface with `hardness` is first loaded plastically"},
      {&Assumptions::inertia, "inertia", "inertia", "quasi-static: ωa/c_s below {}", "{} at peak",
       "a lower `frequency`, or a smaller part of the contact"},
      {&Assumptions::coupling, "coupling", "coupling",
       "pressure and traction uncoupled: {} of the loss", "{}",
       "the coupled cycle in three dimensions computes it"},
  };
  return names;
}

std::string given_as(const std::string& parameter) {
  // A law given by its formula has neither a loaded size nor a maximum pressure; the user gives
  // both by a curve.
  if (parameter == "loaded_size" || parameter == "max_pressure") return "curve";
  return parameter == "angular_frequency" ? "frequency" : parameter;
}

std::vector<AssumptionVerdict> verdicts_of(std::span<const Assumptions> cases, bool slip_followed,
                                           std::span<const double> pressures) {
  std::vector<AssumptionVerdict> verdicts;
  for (const AssumptionName& name : assumption_names()) {
    const bool slip = name.assumption == &Assumptions::slip_of_opening_springs ||
                      name.assumption == &Assumptions::slip_of_closed_springs;
    if ((slip && slip_followed) || name.assumption == &Assumptions::amplitude) continue;
    // An assumption without a value does not apply to the motion, and is left out.
    AssumptionVerdict one = verdict_of(name, cases, pressures);
    if (one.verdict == Verdict::holds && one.here.empty()) continue;
    verdicts.push_back(std::move(one));
  }
  if (slip_followed && std::ranges::count(cases, Regime::sliding, &Assumptions::regime) > 0)
    verdicts.push_back(no_damper(cases, pressures));
  sort_worst_first(verdicts);
  return verdicts;
}

void sort_worst_first(std::vector<AssumptionVerdict>& verdicts) {
  std::ranges::stable_sort(verdicts, {},
                           [](const AssumptionVerdict& one) { return rank_of(one.verdict); });
}

AssumptionVerdict closed_form_verdict(std::span<const Assumptions> cases,
                                      std::span<const double> pressures) {
  const auto name = std::ranges::find_if(assumption_names(), [](const AssumptionName& one) {
    return one.assumption == &Assumptions::amplitude;
  });
  return verdict_of(*name, cases, pressures);
}

Validity validity_of(std::span<const AssumptionVerdict> verdicts) {
  int worst = rank_of(Verdict::holds);
  for (const AssumptionVerdict& one : verdicts) {
    // No parameter of the user can settle an unknown verdict on coupling, since coupling of a slow
    // drag is not modelled (docs/limits.md). It therefore does not count.
    if (one.name == "coupling" && one.verdict == Verdict::unknown) continue;
    worst = std::min(worst, rank_of(one.verdict));
  }
  return worst == rank_of(Verdict::broken)     ? Validity::not_valid
         : worst == rank_of(Verdict::doubtful) ? Validity::valid_with_care
         : worst == rank_of(Verdict::unknown)  ? Validity::not_checked
                                               : Validity::valid;
}

std::string in_words(std::span<const AssumptionVerdict> verdicts) {
  constexpr std::size_t width = 78, margin = 6;
  std::string text;
  for (const AssumptionVerdict& one : verdicts) {
    const char* mark = one.verdict == Verdict::broken     ? "no"
                       : one.verdict == Verdict::doubtful ? "!"
                       : one.verdict == Verdict::unknown  ? "?"
                                                          : "ok";
    const std::string here =
        one.verdict == Verdict::unknown || one.here.empty() ? one.here : "here " + one.here;
    const std::string line = fmt::format("  {:<2}  {}", mark, one.assumption);
    // Widths are counted in bytes. "µ" and "ω" have two bytes, so lines with them break one column
    // early.
    if (here.empty())
      text += line + "\n";
    else if (line.size() + 2 + here.size() <= width)
      text += fmt::format("{:<{}}  {}\n", line, std::min<std::size_t>(50, width - 2 - here.size()),
                          here);
    else
      text += fmt::format("{}\n{:{}}{}\n", line, "", margin, here);
    if (!one.remedy.empty()) text += fmt::format("{:{}}-> {}\n", "", margin, one.remedy);
  }
  return text;
}

std::string regimes_in_words(std::span<const Assumptions> cases,
                             std::span<const double> pressures) {
  std::string text;
  for (const Regime regime : {Regime::sliding, Regime::lifts_off, Regime::partial_slip,
                              Regime::no_slip, Regime::unknown}) {
    std::vector<bool> here;
    for (const Assumptions& assumptions : cases) here.push_back(assumptions.regime == regime);
    const auto count = std::ranges::count(here, true);
    if (count == 0 || (regime == Regime::unknown && text.empty())) continue;
    const std::string which = which_of(here, pressures);
    text += (text.empty() ? "" : ", ") + std::string(name_of(regime)) +
            (which.empty() ? "" : " " + which);
  }
  return text;
}

std::string motion_without_slip(std::span<const Assumptions> cases) {
  const auto judged =
      std::ranges::find_if(cases, [](const Assumptions& p) { return !p.largest.empty(); });
  if (judged == cases.end()) return "";
  const auto quantity = [](double value, Dimension dimension) {
    return format_quantity(value, dimension, 3);
  };
  std::string none, text;
  for (std::size_t i = 0; i < judged->largest.size(); ++i) {
    double velocity = HUGE_VAL, amplitude = HUGE_VAL, excursion = HUGE_VAL;
    for (const Assumptions& p : cases) {
      if (p.largest.empty()) continue;
      velocity = std::fmin(velocity, p.largest[i].drag_velocity);
      amplitude = std::fmin(amplitude, p.largest[i].tangential_amplitude);
      excursion = std::fmin(excursion, p.largest[i].excursion);
    }
    const double friction = judged->largest[i].friction_coefficient;
    std::string motion;
    if (excursion == 0) {
      // With this coefficient of friction even the shortest excursion slips. With smaller ones it
      // slips too, so the text names the largest such coefficient.
      none = fmt::format("no excursion (µ up to {:g})", friction);
      continue;
    }
    if (std::isfinite(velocity))
      motion = (std::isfinite(excursion) ? quantity(excursion, Dimension::length) + " at " : "") +
               quantity(velocity, Dimension::velocity);
    else if (std::isfinite(amplitude))
      motion = quantity(amplitude, Dimension::length);
    else
      continue;
    text += fmt::format(", {} (µ = {:g})", motion, friction);
  }
  return none.empty() && !text.empty() ? text.substr(2) : none + text;
}

}  // namespace salebra
