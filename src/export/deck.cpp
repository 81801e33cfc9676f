// SPDX-License-Identifier: GPL-3.0-or-later
// Decks of contact laws for other programs: which rows they contain, their units, and the sentences
// at their top.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/contact/normal/conductance.hpp>
#include <salebra/export/deck.hpp>
#include <type_traits>
#include <utility>

#include "analysis/part.hpp"
#include "damping/max_motion.hpp"
#include "fmu.hpp"
#include "formats.hpp"

namespace salebra {
namespace {

using detail::Deck;
using detail::DeckLaw;

/// Range of a law that is not a table, in multiples of the force at the operating point.
constexpr double lowest_share = 1e-3, highest_share = 10;

void set_range(DeckContact& contact) {
  const ContactLaw& law = *contact.law;
  const bool table = std::isfinite(law.highest_indentation());
  if (table) {
    contact.lowest = law.first_touch();
    contact.highest = law.highest_indentation();
  } else if (!std::isnan(contact.indentation)) {
    detail::require_possible(law, contact.indentation, 0);
    const double force = law.force(contact.indentation);
    contact.lowest = law.indentation_of(lowest_share * force);
    contact.highest = detail::possible_indentation(law, contact.indentation,
                                                   law.indentation_of(highest_share * force));
  }
}

bool complete(const ForceCurve& curve, double ForceSample::*quantity) {
  return std::ranges::all_of(curve.samples, [&](const ForceSample& sample) {
    return !sample.converged || std::isfinite(sample.*quantity);
  });
}

void set_origin(DeckContact& contact, const ForceCurve& curve) {
  const bool gap = complete(curve, &ForceSample::mean_gap);
  const bool indentation = complete(curve, &ForceSample::indentation);
  contact.clearance_from = gap ? "the mean planes of the deformed surfaces: it is their mean gap"
                               : "where the curve counts its indentation from, and is its negative";
  if (gap && indentation) {
    const auto sample = std::ranges::find(curve.samples, true, &ForceSample::converged);
    if (sample != curve.samples.end())
      contact.clearance_origin = sample->indentation + sample->mean_gap;
  }
}

/// The range of clearances that the laws of all contacts cover.
struct Range {
  double far = std::numeric_limits<double>::infinity();
  double close = -std::numeric_limits<double>::infinity();
};

double force_at(const DeckContact& contact, double clearance) {
  return contact.law->force(contact.clearance_origin - clearance);
}

std::vector<std::size_t> by_force(const std::vector<DeckContact>& contacts, double clearance) {
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return force_at(contacts[i], clearance); });
  return order;
}

/// The same problem for the part: with the curves and laws of its area instead of those of the
/// sample.
DeckProblem of_part(DeckProblem problem) {
  const double area = problem.nominal_area;
  if (std::isnan(area)) return problem;
  require_positive(area, "nominal_area");
  for (DeckContact& contact : problem.contacts) {
    const double sample = std::exchange(contact.nominal_area, area);
    if (std::isnan(sample) || sample == area) continue;
    contact.law = law_of_part(std::move(contact.law), area / sample);
    contact.sample_area = sample;
  }
  return problem;
}

Range common_range(const DeckProblem& problem) {
  Range range;
  for (const DeckContact& contact : problem.contacts) {
    double lowest = contact.lowest, highest = contact.highest;
    require_that(
        !std::isnan(lowest), "indentation",
        "not given, but a law without a table is sampled at forces around the force there");
    if (problem.pressure_window) {
      const double area = contact.nominal_area;
      lowest = contact.law->indentation_of(problem.pressure_window->first * area);
      highest = contact.law->indentation_of(problem.pressure_window->second * area);
      const double rest = std::isnan(contact.indentation) ? lowest : contact.indentation;
      const double most = detail::possible_indentation(*contact.law, rest, highest);
      require(
          !(highest > most), "pressure_window", problem.pressure_window->second,
          fmt::format("Pa cannot be reached by this contact; its largest pressure is {}",
                      format_quantity(contact.law->force(most) / area, Dimension::pressure, 3)));
    }
    range.far = std::min(range.far, contact.clearance_origin - lowest);
    range.close = std::max(range.close, contact.clearance_origin - highest);
  }
  require(range.close < range.far, "pressure_window", problem.contacts.size(),
          "surfaces have no common clearances; widen the window");
  return range;
}

/// The greatest convex table that nowhere exceeds `pressure`: rows above the line between their
/// neighbours move onto this line. Throws InvalidInput if the pressure does not increase from row
/// to row, or if a row moves by more than 1 %. what: name of the table in messages.
std::vector<double> convex(const std::vector<double>& pressure, const std::string& what) {
  constexpr double most = 0.01;
  std::vector<std::size_t> hull;
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    require(
        i == 0 || pressure[i] > pressure[i - 1], "curve", what,
        "has a pressure that does not grow as the clearance shrinks; remove or smooth the sample");
    while (hull.size() > 1) {
      const std::size_t b = hull.back(), a = hull[hull.size() - 2];
      if ((pressure[b] - pressure[a]) / double(b - a) <=
          (pressure[i] - pressure[b]) / double(i - b))
        break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  std::vector<double> result = pressure;
  for (std::size_t k = 1; k < hull.size(); ++k) {
    const std::size_t a = hull[k - 1], b = hull[k];
    for (std::size_t i = a + 1; i < b; ++i) {
      result[i] = std::lerp(pressure[a], pressure[b], double(i - a) / double(b - a));
      require(result[i] > (1 - most) * pressure[i], "curve", what,
              fmt::format("is not convex: a pressure lies {:.2g} % above the line between its "
                          "neighbours; remove or smooth the sample, or choose a `pressure_window`",
                          100 * (pressure[i] / result[i] - 1)));
    }
  }
  return result;
}

/// The mean of the laws of some contacts at the clearances of a deck, per nominal area. which:
/// indices of the contacts.
DeckLaw law_of_contacts(const DeckProblem& problem, const std::vector<double>& clearance,
                        const std::vector<std::size_t>& which) {
  DeckLaw law;
  const double share = 1 / double(which.size());
  bool tangential = true;
  for (const std::size_t i : which)
    tangential = tangential && problem.contacts[i].knows_tangential_stiffness;
  law.pressure.assign(clearance.size(), 0);
  law.normal_stiffness = law.pressure;
  if (tangential) law.tangential_stiffness = law.pressure;
  for (std::size_t row = 0; row < clearance.size(); ++row)
    for (const std::size_t i : which) {
      const DeckContact& contact = problem.contacts[i];
      const double weight = share / contact.nominal_area;
      // Because of rounding, the ends of the range may lie outside the range of the contact, and a
      // row at first touch may have a force.
      const bool at_lowest = clearance[row] >= contact.clearance_origin - contact.lowest;
      const double indentation = at_lowest ? contact.lowest
                                           : std::clamp(contact.clearance_origin - clearance[row],
                                                        contact.lowest, contact.highest);
      law.pressure[row] += weight * contact.law->force(indentation);
      law.normal_stiffness[row] += weight * contact.law->normal_stiffness(indentation);
      if (tangential)
        law.tangential_stiffness[row] += weight * contact.law->tangential_stiffness(indentation);
    }
  if (!problem.conductivity.empty())
    for (const double stiffness : law.normal_stiffness)
      law.conductance.push_back(
          conductances(stiffness, problem.contact_modulus,
                       {.conductivity = problem.conductivity, .resistivity = {}})
              .thermal_conductance);
  if (!std::isnan(problem.friction_coefficient)) {
    double slope = 0, normal_slope = 0, pressure = 0;
    for (const std::size_t i : which) {
      const DeckContact& contact = problem.contacts[i];
      const double weight = share / contact.nominal_area;
      slope += weight * contact.law->tangential_stiffness(contact.indentation);
      normal_slope += weight * contact.law->normal_stiffness(contact.indentation);
      pressure += weight * contact.law->force(contact.indentation);
    }
    law.stick_slope = slope;
    law.normal_slope = normal_slope;
    law.elastic_slip = problem.friction_coefficient * pressure / slope;
  }
  return law;
}

/// Largest error of straight lines between the rows of the mean law, over the pressure. Below the
/// lowest load of curves, where the pressure falls to 0, it is over the pressure at this load.
double interpolation_error(const DeckProblem& problem, const Deck& deck) {
  const DeckLaw& mean = deck.laws.front();
  std::vector<double> middle;
  for (std::size_t i = 1; i < deck.clearance.size(); ++i)
    middle.push_back((deck.clearance[i - 1] + deck.clearance[i]) / 2);
  std::vector<std::size_t> all(problem.contacts.size());
  std::iota(all.begin(), all.end(), 0);
  const DeckLaw between = law_of_contacts(problem, middle, all);
  double least = 0;
  for (const DeckContact& contact : problem.contacts)
    if (const double first = contact.law->lowest_indentation(); std::isfinite(first))
      least += contact.law->force(first) / contact.nominal_area / double(all.size());
  double worst = 0;
  for (std::size_t i = 0; i < middle.size(); ++i) {
    const double line = (mean.pressure[i] + mean.pressure[i + 1]) / 2, law = between.pressure[i];
    worst = std::max(worst, std::abs(line - law) / std::max(law, least));
  }
  return worst;
}

/// The cases of a deck with their contacts: the mean of all, and for several contacts also the
/// contacts at the 2.5 % and 97.5 % quantiles of the force at this clearance.
std::vector<std::pair<DeckCase, std::vector<std::size_t>>> cases_of(const DeckProblem& problem,
                                                                    double clearance) {
  const std::vector<std::size_t> order = by_force(problem.contacts, clearance);
  std::vector<std::pair<DeckCase, std::vector<std::size_t>>> cases{{DeckCase::mean, order}};
  if (order.size() > 1) {
    const auto rank = std::size_t(0.025 * double(order.size()));
    cases.push_back({DeckCase::low, {order[rank]}});
    cases.push_back({DeckCase::high, {order[order.size() - 1 - rank]}});
  }
  return cases;
}

std::string what_of(DeckCase which, const std::vector<std::size_t>& surfaces, std::size_t all) {
  if (all == 1) return "one surface or law";
  if (which == DeckCase::mean) return fmt::format("mean of {} surfaces at each clearance", all);
  const auto rank = std::size_t(0.025 * double(all)) + 1;
  return fmt::format("surface {} of {}, number {} from the {} force", surfaces.front() + 1, all,
                     rank, which == DeckCase::low ? "lowest" : "highest");
}

/// Throws InvalidInput if the deck would have no content, or none of what was asked for.
void check_conduction(const DeckProblem& problem, const detail::DeckWriter& writer) {
  const bool asked = !problem.conductivity.empty();
  require_that(
      !asked || writer.takes_conductance, "conductivity",
      fmt::format("given, but {} has no conductance in salebra's decks", name_of(problem.format)));
  if (asked) {
    require_that(!std::isnan(problem.contact_modulus), "contact_modulus",
                 "not given, but the conductance needs it");
    Conduction{.conductivity = problem.conductivity, .resistivity = {}}.validate();
    require_positive(problem.contact_modulus, "contact_modulus");
  }
  require_that(problem.format != DeckFormat::elmer || asked, "conductivity",
               "not given, but a deck for Elmer contains only the conductance");
  require_that(
      problem.format != DeckFormat::moose || asked || !std::isnan(problem.friction_coefficient),
      "friction_coefficient",
      "not given, and no conductivity either, but a deck for MOOSE contains one of them");
}

void check(const DeckProblem& problem, const detail::DeckWriter& writer) {
  const detail::DeckContent content = writer.content;
  check_conduction(problem, writer);
  const bool table = content == detail::DeckContent::table;
  const bool springs = content == detail::DeckContent::springs;
  require(!problem.contacts.empty(), "contacts", 0, "given; give at least one");
  require(problem.rows >= 4 && problem.rows <= 100000, "rows", problem.rows,
          "must be from 4 to 100000");
  require(problem.sliders >= 2 && problem.sliders <= 100000, "sliders", problem.sliders,
          "must be from 2 to 100000");
  require(problem.min_force > 0 && problem.min_force < 1, "min_force", problem.min_force,
          "must be > 0 and < 1; it is a fraction of the force at which the whole contact slips");
  if (problem.pressure_window)
    require(problem.pressure_window->first > 0 &&
                problem.pressure_window->second > problem.pressure_window->first,
            "pressure_window", problem.pressure_window->first, "must be > 0 and rise");
  const bool friction = !std::isnan(problem.friction_coefficient);
  if (friction) require_positive(problem.friction_coefficient, "friction_coefficient");
  require_that(content != detail::DeckContent::sliders || friction, "friction_coefficient",
               "not given, but sliders need it");
  for (const DeckContact& contact : problem.contacts) {
    const double area = contact.nominal_area;
    if (table || problem.pressure_window || (springs && problem.contacts.size() > 1))
      require_that(area > 0 && std::isfinite(area), "nominal_area",
                   "not given, but a pressure needs the nominal area");
    if (!friction && !springs) continue;
    require_that(
        contact.knows_tangential_stiffness, "tangential_stiffness",
        "is not known, but friction needs it; give `poisson` or `tangential_modulus`, or a "
        "curve with stick solves");
    if (springs) continue;
    require_that(!std::isnan(contact.indentation), "indentation",
                 "not given, but the tangential stiffness depends on it; give it or another load");
  }
}

/// Converts all numbers of the deck from SI to its unit system.
void convert(Deck& deck) {
  const UnitSystem& units = deck.problem.units;
  const auto scale = [&](auto& values, Dimension dimension) {
    const double factor = 1 / units.in_si(dimension);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(values)>, double>)
      values *= factor;
    else
      for (double& value : values) value *= factor;
  };
  scale(deck.clearance, Dimension::length);
  for (DeckLaw& law : deck.laws) {
    scale(law.pressure, Dimension::pressure);
    scale(law.normal_stiffness, Dimension::stiffness_per_area);
    scale(law.tangential_stiffness, Dimension::stiffness_per_area);
    scale(law.stick_slope, Dimension::stiffness_per_area);
    scale(law.normal_slope, Dimension::stiffness_per_area);
    scale(law.conductance, Dimension::thermal_conductance);
    scale(law.elastic_slip, Dimension::length);
  }
  for (detail::Slider& slider : deck.sliders) {
    scale(slider.stiffness, Dimension::stiffness);
    scale(slider.slider_force, Dimension::force);
  }
  scale(deck.start, Dimension::length);
  scale(deck.exponential_pressure, Dimension::pressure);
  scale(deck.exponential_length, Dimension::length);
}

std::vector<std::string> opening(const DeckProblem& problem) {
  const UnitSystem& units = problem.units;
  std::vector<std::string> lines{
      fmt::format("Contact law by salebra {}{}", version(),
                  problem.provenance.revision.empty()
                      ? ""
                      : " (revision " + problem.provenance.revision + ")"),
      "License of this file: MIT-0, https://opensource.org/license/mit-0",
      fmt::format("Units: {}. The unit of force is {:g} N, of pressure {:g} Pa.", units.text(),
                  units.in_si(Dimension::force), units.in_si(Dimension::pressure))};
  if (!problem.source.empty()) lines.push_back("Source: " + problem.source);
  if (!problem.provenance.command_line.empty())
    lines.push_back("Made by: " + problem.provenance.command_line);
  lines.emplace_back(
      "Assumptions: quasi-static, nested contact sets, the same law on loading and unloading; no "
      "adhesion, no wear.");
  if (!problem.comment.empty()) lines.push_back(problem.comment);
  const DeckContact& first = problem.contacts.front();
  const double square = 1 / (units.in_si(Dimension::length) * units.in_si(Dimension::length));
  if (!std::isnan(first.sample_area))
    lines.push_back(
        fmt::format("Nominal area of the part: {:.10g}. The law was computed on a sample of "
                    "{:.10g}; forces and stiffnesses are those of the sample times {:.10g}.",
                    first.nominal_area * square, first.sample_area * square,
                    first.nominal_area / first.sample_area));
  else if (!std::isnan(first.nominal_area))
    lines.push_back(fmt::format("Nominal area: {:.10g}.", first.nominal_area * square));
  return lines;
}

void add_table(Deck& deck, int max_rows, DeckSolution& answer) {
  const DeckProblem& problem = deck.problem;
  const Range range = common_range(problem);
  const int rows = std::min(problem.rows, max_rows);
  for (int i = 0; i < rows; ++i)
    deck.clearance.push_back(std::lerp(range.far, range.close, double(i) / (rows - 1)));
  const double middle = (range.far + range.close) / 2;
  for (const auto& [which, surfaces] : cases_of(problem, middle)) {
    DeckLaw law = law_of_contacts(problem, deck.clearance, surfaces);
    law.name = name_of(which);
    law.what = what_of(which, surfaces, problem.contacts.size());
    law.pressure = convex(law.pressure, law.what);
    deck.laws.push_back(std::move(law));
  }
  answer.interpolation_error = interpolation_error(problem, deck);
  const DeckContact& first = problem.contacts.front();
  if (problem.contacts.size() == 1 && !std::isnan(first.decay_length)) {
    deck.exponential_length = first.decay_length;
    deck.exponential_pressure = force_at(first, 0) / first.nominal_area;
  }
  const double metre = 1 / problem.units.in_si(Dimension::length),
               pascal = 1 / problem.units.in_si(Dimension::pressure);
  deck.header.push_back(fmt::format("Clearance: counted from {}.", first.clearance_from));
  deck.header.push_back(fmt::format(
      "Window: clearance {:.6g} to {:.6g}, mean pressure {:.6g} to {:.6g}; straight lines between "
      "the {} rows are off by {:.2g} % at most{}.",
      range.far * metre, range.close * metre, deck.laws.front().pressure.front() * pascal,
      deck.laws.front().pressure.back() * pascal, rows, 100 * answer.interpolation_error,
      deck.laws.front().pressure.front() > 0
          ? ""
          : ", of the pressure at the lowest load of the curve where the pressure is smaller"));
  if (problem.contacts.size() > 1)
    deck.header.push_back(
        fmt::format("Low and high are whole surfaces, ranked by their force at clearance {:.6g}.",
                    middle * metre));
  if (deck.has_friction())
    deck.header.push_back(fmt::format(
        "Friction: coefficient {:.6g}; tangential stiffness at the mean pressure {:.6g}.",
        problem.friction_coefficient,
        deck.laws.front().elastic_slip * deck.laws.front().stick_slope /
            problem.friction_coefficient * pascal));
  if (deck.has_conductance())
    deck.header.push_back(
        fmt::format("Conductance: thermal, of the solid contact per nominal area, for "
                    "conductivities {:g} W/(m K) "
                    "and the contact modulus {:.6g}. Unit: {:g} W/(m^2 K).",
                    fmt::join(problem.conductivity, ", "), problem.contact_modulus * pascal,
                    problem.units.in_si(Dimension::thermal_conductance)));
}

/// Indices of the contacts of the requested case, and a text that says which contacts these are.
std::pair<std::vector<std::size_t>, std::string> case_of(const DeckProblem& problem) {
  if (problem.contacts.size() == 1) return {{0}, what_of(problem.of, {0}, 1)};
  const Range range = common_range(problem);
  for (const auto& [which, surfaces] : cases_of(problem, (range.far + range.close) / 2))
    if (which == problem.of) return {surfaces, what_of(which, surfaces, problem.contacts.size())};
  return {};
}

void add_sliders(Deck& deck, DeckSolution& answer) {
  const DeckProblem& problem = deck.problem;
  const auto [which, what] = case_of(problem);
  std::vector<DeckContact> contacts;
  for (const std::size_t i : which) contacts.push_back(problem.contacts[i]);
  detail::SliderSet set = detail::jenkins_sliders(contacts, problem.friction_coefficient,
                                                  problem.sliders, problem.min_force);
  answer.tangential_stiffness = set.stiffness;
  answer.slip_force = set.force;
  answer.loss_error = set.loss_error;
  double force = 0;
  for (const DeckContact& contact : contacts)
    force += contact.law->force(contact.indentation) / double(contacts.size());
  const double newton = 1 / problem.units.in_si(Dimension::force),
               stiffness = 1 / problem.units.in_si(Dimension::stiffness);
  deck.header.push_back(fmt::format(
      "Contact: {}, at the normal force {:.10g} with the coefficient of friction {:.6g}.", what,
      force * newton, problem.friction_coefficient));
  deck.header.push_back(fmt::format(
      "Sliders in parallel: each a spring in series with a slider. Together: stiffness {:.10g}, "
      "force {:.10g}.",
      set.stiffness * stiffness, set.force * newton));
  deck.header.push_back(
      fmt::format("The loss of a cycle is off by up to {1:.3g} % from {0:g} of the total force "
                  "on. Beyond {2:.4g} of it one slider holds all that sticks.",
                  problem.min_force, 100 * set.loss_error, set.resolved));
  deck.sliders = std::move(set.sliders);
}

/// The law of a case. A single contact has its own law. For several it is a table of their mean
/// force and stiffnesses at each clearance.
std::shared_ptr<const ContactLaw> law_of_case(const DeckProblem& problem, const Range& range,
                                              const std::vector<std::size_t>& which) {
  const DeckContact& first = problem.contacts[which.front()];
  if (which.size() == 1) return first.law;
  std::vector<double> clearance;
  for (int i = 0; i < problem.rows; ++i)
    clearance.push_back(std::lerp(range.far, range.close, double(i) / (problem.rows - 1)));
  const DeckLaw mean = law_of_contacts(problem, clearance, which);
  const double area = first.nominal_area;
  ForceCurve curve{.model = "mean", .nominal_area = area, .samples = {}};
  for (std::size_t i = 0; i < clearance.size(); ++i)
    curve.samples.push_back({.indentation = first.clearance_origin - clearance[i],
                             .force = area * mean.pressure[i],
                             .normal_stiffness = area * mean.normal_stiffness[i],
                             .tangential_stiffness = area * mean.tangential_stiffness[i]});
  return std::make_shared<TabulatedLaw>(curve, first.law->modulus_ratio());
}

void add_springs(Deck& deck) {
  const DeckProblem& problem = deck.problem;
  const Range range = common_range(problem);
  const auto [which, what] = case_of(problem);
  const DeckContact& first = problem.contacts[which.front()];
  const std::shared_ptr<const ContactLaw> law = law_of_case(problem, range, which);
  // Because of rounding, the ends of the range may lie outside the table.
  const double lowest = std::max(first.clearance_origin - range.far, law->lowest_indentation());
  double highest = std::min(first.clearance_origin - range.close, law->highest_indentation());
  // Springs follow motions that lift off, under which the force of an exponential law rises to
  // √(2π u_z/l) times its mean: 100 times at 1600 decay lengths.
  if (!std::isfinite(law->highest_indentation()) && !problem.pressure_window &&
      !std::isnan(first.indentation))
    highest = std::max(highest, detail::possible_indentation(
                                    *law, first.indentation,
                                    law->indentation_of(100 * law->force(first.indentation))));
  const bool friction = !std::isnan(problem.friction_coefficient);
  deck.springs = std::make_shared<const LawSprings>(
      *law, lowest, highest,
      LawSpringsOptions{.friction_coefficient = friction ? problem.friction_coefficient
                                                         : std::numeric_limits<double>::infinity(),
                        .springs = problem.sliders});
  deck.start = std::isnan(first.indentation) ? (lowest + highest) / 2 : first.indentation;
  const double metre = 1 / problem.units.in_si(Dimension::length),
               newton = 1 / problem.units.in_si(Dimension::force);
  deck.header.push_back(
      fmt::format("Contact: {}. Indentation: {:.6g} minus the clearance, which is counted from {}.",
                  what, first.clearance_origin * metre, first.clearance_from));
  deck.header.push_back(fmt::format(
      "Window: indentation {:.6g} to {:.6g}, force {:.6g} to {:.6g}; below it springs are coarser, "
      "above it the force follows its tangent.",
      lowest * metre, highest * metre, law->force(lowest) * newton, law->force(highest) * newton));
}

}  // namespace

DeckContact deck_contact(std::shared_ptr<const ContactLaw> law, std::optional<double> indentation) {
  DeckContact contact;
  contact.clearance_from = "where the law counts its indentation from, and is its negative";
  if (const auto* exponential = dynamic_cast<const ExponentialLaw*>(law.get())) {
    contact.decay_length = exponential->decay_length();
    if (!indentation) indentation = 0;
  }
  contact.law = std::move(law);
  if (indentation) contact.indentation = *indentation;
  set_range(contact);
  return contact;
}

DeckContact deck_contact(ContactProblem problem, const Context& context) {
  bool knows_tangential_stiffness = true;
  double decay_length = DeckContact::unknown;
  std::string clearance_from = "first touch, and is the negative of the indentation";
  if (auto* curve = std::get_if<CurveContact>(&problem)) {
    // If each sample has K_t, the ratio G*/E* is not used and may be any number.
    knows_tangential_stiffness = complete(curve->curve, &ForceSample::tangential_stiffness) ||
                                 !std::isnan(curve->modulus_ratio);
    if (std::isnan(curve->modulus_ratio)) curve->modulus_ratio = 1;
  } else if (const auto* law = std::get_if<ExponentialContact>(&problem)) {
    decay_length = law->decay_length;
    clearance_from = "where the normal force is that of the position";
  }
  ContactSolution answer = solve(std::move(problem), context);
  require(answer.points.size() < 2, "contacts",
          fmt::format("{} operating points", answer.points.size()), "given; a deck takes one");
  std::optional<double> indentation;
  if (!answer.points.empty()) indentation = indentation_of(*answer.law, answer.points.front());
  DeckContact contact = deck_contact(std::move(answer.law), indentation);
  contact.knows_tangential_stiffness = knows_tangential_stiffness;
  contact.decay_length = decay_length;
  contact.clearance_from = clearance_from;
  if (answer.curve) set_origin(contact, *answer.curve);
  if (answer.nominal_area() > 0) contact.nominal_area = answer.nominal_area();
  return contact;
}

DeckSolution solve(const DeckProblem& asked) {
  const DeckProblem problem = of_part(asked);
  const detail::DeckWriter& writer = detail::writer_of(problem.format);
  check(problem, writer);
  DeckSolution answer;
  answer.surfaces = int(problem.contacts.size());
  Deck deck{.problem = problem, .header = opening(problem)};
  switch (writer.content) {
    case detail::DeckContent::table:
      add_table(deck, writer.max_rows, answer);
      break;
    case detail::DeckContent::sliders:
      add_sliders(deck, answer);
      break;
    case detail::DeckContent::springs:
      add_springs(deck);
      break;
  }
  convert(deck);
  if (problem.format == DeckFormat::fmu) {
    deck.library = detail::fmu_library(deck);
    if (!deck.library.empty()) answer.platform = detail::platform();
  }
  answer.text = writer.write(deck);
  return answer;
}

}  // namespace salebra
