// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <span>
#include <string>
#include <vector>

namespace salebra::detail {

/// An exponential law is one of a rough surface between some first cells in contact, at about
/// 10⁻⁴ E*h', and full contact, at about E*h'. No force can be more times that at rest.
constexpr double max_force_ratio = 1e4;

/// The largest amplitude of an exponential law with this decay length, the mean indentation held.
double possible_amplitude(double decay_length);
/// The same of any law about a contact at rest; infinity: the law itself names none.
double possible_amplitude(const ContactLaw& law, double rest);

/// Throws InvalidInput, with the amplitude that is possible, where an oscillation takes a contact
/// that rests at `rest` to pressures that no elastic contact has: an indenter to a mean pressure
/// above E*, an exponential law to max_force_ratio times its force. A table has an end of its own.
/// middle_at   mean indentation under an amplitude
/// hold        what stays under an amplitude: under a held force an exponential law has no limit;
///             without a value the caller has no choice
void require_possible(const ContactLaw& law, double rest, double amplitude,
                      const std::function<double(double)>& middle_at,
                      std::optional<Hold> hold = {});

/// The same of a mean indentation at which the contact need not rest, because a mean force may be
/// held there. An exponential law then rests at 0, where it counts its indentation from, or higher.
/// A power law has no modulus, and with it no scale of its pressure: it has no limit.
void require_possible(const ContactLaw& law, double mean_indentation, double amplitude);

/// The highest indentation up to `asked` to which a contact that rests at `rest` can be pressed.
double possible_indentation(const ContactLaw& law, double rest, double asked);

/// A sentence for the worst of these oscillations, if what was held is the mean indentation and the
/// mean force then is more than twice that at rest: a machine that is preloaded holds the force.
/// Only `force` and `mean_force` are looked at. hold: as above.
std::optional<std::string> warning_of_held_indentation(std::optional<Hold> hold,
                                                     std::span<const DampingResult> results);

/// As relaxation_damping(), of a mean indentation at which the contact does not rest: one that
/// holds its mean force, or is searched over amplitudes.
DampingResult damping_about(const ContactLaw& law, double mean_indentation, const Motion& motion,
                            double tolerance);

/// As steady_sliding(), of such a mean indentation.
std::vector<SteadySliding> steady_sliding_about(const ContactLaw& law, double mean_indentation,
                                                const NormalOscillation& normal,
                                                std::span<const double> velocities,
                                                double friction_coefficient);

}  // namespace salebra::detail
