// SPDX-License-Identifier: GPL-3.0-or-later
// Largest normal oscillation that a contact law can describe.
#include "max_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/mdr/mdr.hpp>

#include "base/special_values.hpp"

namespace salebra::detail {
namespace {

std::string in_words(double value, Dimension dimension) {
  return format_quantity(value, dimension, 3);
}

// Decay length F/K of a law that is exponential for all indentations above `position`, where F F''
// = K²; NaN for other laws. It tests numbers and not the class, because a law may be wrapped in
// another.
double decay_length_of(const ContactLaw& law, double position) {
  if (std::isfinite(law.lowest_indentation())) return unknown;
  const auto is_exponential = [&](double at) {
    const double stiffness = law.normal_stiffness(at);
    return std::abs(law.force(at) * law.force_curvature(at) / (stiffness * stiffness) - 1) < 1e-12;
  };
  const double length = law.force(position) / law.normal_stiffness(position);
  return is_exponential(position) && is_exponential(position + length) ? length : unknown;
}

double mean_pressure(const IndenterLaw& law, double indentation) {
  const double radius = law.contact_radius(indentation);
  return law.force(indentation) / (std::numbers::pi * radius * radius);
}

// Returns whether the mean pressure at the indentation exceeds E*. The mean pressure of a cone is
// the same at every load, so a cone always returns false.
bool is_above_modulus(const IndenterLaw& law, double indentation) {
  if (!(indentation > 0)) return false;
  const double pressure = mean_pressure(law, indentation);
  return pressure > law.contact_modulus() &&
         pressure > 1.001 * mean_pressure(law, 0.5 * indentation);
}

// Largest number between `possible` and `asked` for which is_beyond() is false, by bisection.
// is_beyond(possible) must be false and is_beyond(asked) true.
double max_possible(double possible, double asked, const std::function<bool(double)>& is_beyond) {
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (possible + asked);
    (is_beyond(middle) ? asked : possible) = middle;
  }
  return possible;
}

void require_possible(const IndenterLaw& law, double rest, double amplitude,
                      const std::function<double(double)>& middle_at) {
  const auto is_beyond = [&](double one) { return is_above_modulus(law, middle_at(one) + one); };
  if (!is_beyond(amplitude)) return;
  const std::string beyond = fmt::format(
      "m raises the mean contact pressure to {}, above the contact modulus of {}, which no elastic "
      "contact reaches; ",
      in_words(mean_pressure(law, middle_at(amplitude) + amplitude), Dimension::pressure),
      in_words(law.contact_modulus(), Dimension::pressure));
  require(!is_above_modulus(law, rest), "indentation", rest, beyond + "reduce the load");
  const double possible = max_possible(0, amplitude, is_beyond);
  require(
      false, "normal_amplitude", amplitude,
      beyond + fmt::format("at most {} is possible here", in_words(possible, Dimension::length)));
}

// Throws if the exponential law with the decay length `length` exceeds max_force_ratio times its
// force at the indentation `rest`. remedy: text that the error message
// inserts between its proposals.
void require_possible_exponential(double length, double rest, double mean, double amplitude,
                                  const char* remedy) {
  const double most = possible_amplitude(length) + (rest - mean);
  require(amplitude <= most, "normal_amplitude", amplitude,
          fmt::format(
              "m raises the force to {:.2g} times the force at rest, but an exponential law holds "
              "up to {:g} times; use at most {},{} or give a `curve` that covers the motion",
              std::exp((mean + amplitude - rest) / length), max_force_ratio,
              in_words(most, Dimension::length), remedy));
}

}  // namespace

double possible_amplitude(double decay_length) { return decay_length * std::log(max_force_ratio); }

double possible_amplitude(const ContactLaw& law, double rest) {
  const double length = decay_length_of(law, rest);
  return std::isnan(length) ? infinity : possible_amplitude(length);
}

void require_possible(const ContactLaw& law, double rest, double amplitude,
                      const std::function<double(double)>& middle_at, std::optional<Hold> hold) {
  if (const auto* indenter = dynamic_cast<const IndenterLaw*>(&law))
    return require_possible(*indenter, rest, amplitude, middle_at);
  if (hold == Hold::force) return;
  if (const double length = decay_length_of(law, rest); std::isfinite(length))
    require_possible_exponential(length, rest, rest, amplitude,
                                 hold ? " hold the mean force," : "");
}

void require_possible(const ContactLaw& law, double mean_indentation, double amplitude) {
  if (const auto* indenter = dynamic_cast<const IndenterLaw*>(&law))
    return require_possible(*indenter, mean_indentation, amplitude,
                            [&](double) { return mean_indentation; });
  const double rest = std::max(mean_indentation, 0.0);
  double length = decay_length_of(law, rest);
  // The test at indentation 0 avoids a force that overflows at a much higher indentation.
  if (std::isnan(length)) length = decay_length_of(law, 0);
  if (std::isfinite(length))
    require_possible_exponential(length, rest, mean_indentation, amplitude, "");
}

std::optional<std::string> warning_of_held_indentation(std::span<const DampingResult> results) {
  constexpr double max_ratio = 2;
  double worst = max_ratio;
  std::optional<std::string> warning;
  for (const DampingResult& one : results) {
    if (one.hold == Hold::force) continue;
    // mean_force/force is infinite if the contact is open without oscillation, and NaN if it never
    // touches.
    const double ratio = one.mean_force / one.force;
    if (!(ratio > worst)) continue;
    worst = ratio;
    warning = fmt::format(
        "holding the mean indentation raises the mean force to {} from {}{}; a preloaded machine "
        "holds the mean force (`hold` force)",
        in_words(one.mean_force, Dimension::force), in_words(one.force, Dimension::force),
        std::isfinite(ratio) ? fmt::format(", {:.3g} times as much", ratio) : "");
  }
  return warning;
}

double possible_indentation(const ContactLaw& law, double rest, double asked) {
  if (const auto* indenter = dynamic_cast<const IndenterLaw*>(&law)) {
    const auto is_beyond = [&](double one) { return is_above_modulus(*indenter, one); };
    return is_beyond(asked) ? max_possible(0, asked, is_beyond) : asked;
  }
  const double length = decay_length_of(law, rest);
  return std::isfinite(length) ? std::min(asked, rest + possible_amplitude(length)) : asked;
}

}  // namespace salebra::detail
