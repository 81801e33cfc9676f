// SPDX-License-Identifier: GPL-3.0-or-later
// The largest normal oscillation that the law of a contact can describe.
#include "largest_motion.hpp"

#include <fmt/format.h>

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

// F/K of a law that is exponential from a place on, F F'' = K²; NaN of another one. A law may be
// wrapped, hence its numbers are asked and not its type.
double decay_length_of(const ContactLaw& law, double place) {
  if (std::isfinite(law.lowest_indentation())) return unknown;
  const auto is_exponential = [&](double at) {
    const double stiffness = law.normal_stiffness(at);
    return std::abs(law.force(at) * law.force_curvature(at) / (stiffness * stiffness) - 1) < 1e-12;
  };
  const double length = law.force(place) / law.normal_stiffness(place);
  return is_exponential(place) && is_exponential(place + length) ? length : unknown;
}

double mean_pressure(const IndenterLaw& law, double indentation) {
  const double radius = law.contact_radius(indentation);
  return law.force(indentation) / (std::numbers::pi * radius * radius);
}

void require_possible(const IndenterLaw& law, double rest, double amplitude,
                      const std::function<double(double)>& middle_at) {
  const auto pressure_under = [&](double one) { return mean_pressure(law, middle_at(one) + one); };
  const double limit = law.contact_modulus(), most = pressure_under(amplitude);
  if (!(most > limit)) return;
  const double at_rest = rest > 0 ? mean_pressure(law, rest) : 0;
  // A cone has this pressure at every load.
  if (!(most > 1.001 * at_rest)) return;
  const std::string beyond = fmt::format(
      "m presses the contact to a mean of {}, above the contact modulus of {}, which "
      "no elastic contact reaches; ",
      in_words(most, Dimension::pressure), in_words(limit, Dimension::pressure));
  require(at_rest < limit, "indentation", rest, beyond + "reduce the load");
  double possible = 0, above = amplitude;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (possible + above);
    (pressure_under(middle) > limit ? above : possible) = middle;
  }
  require(false, "normal_amplitude", amplitude,
          beyond + fmt::format("at most {} here", in_words(possible, Dimension::length)));
}

}  // namespace

double possible_amplitude(double decay_length) { return decay_length * std::log(most_force_ratio); }

double possible_amplitude(const ContactLaw& law, double rest) {
  const double length = decay_length_of(law, rest);
  return std::isnan(length) ? infinity : possible_amplitude(length);
}

void require_possible(const ContactLaw& law, double rest, double amplitude,
                      const std::function<double(double)>& middle_at, std::optional<Hold> hold) {
  if (const auto* indenter = dynamic_cast<const IndenterLaw*>(&law))
    return require_possible(*indenter, rest, amplitude, middle_at);
  const double most = hold == Hold::force ? infinity : possible_amplitude(law, rest);
  require(amplitude <= most, "normal_amplitude", amplitude,
          fmt::format("m takes the force to {:.2g} times that at rest, and an exponential law "
                      "holds up to {:g} times; at most {} here; {}give a `curve` that "
                      "covers the motion",
                      std::exp(amplitude / most * std::log(most_force_ratio)), most_force_ratio,
                      in_words(most, Dimension::length), hold ? "hold the mean force, or " : ""));
}

}  // namespace salebra::detail
