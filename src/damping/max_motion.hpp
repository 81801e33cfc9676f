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

/// Largest force of an exponential law divided by its force without oscillation. The law describes
/// a rough surface with the rms slope h' from the first cells in contact, at a pressure of about
/// 10⁻⁴ E*h', to full contact, at about E*h'.
constexpr double max_force_ratio = 1e4;

/// The largest normal amplitude, m, that an exponential law with this decay length allows while the
/// mean indentation is held.
double possible_amplitude(double decay_length);
/// The largest normal amplitude, m, that any law allows about the indentation `rest` while the mean
/// indentation is held; infinity if the law sets no limit.
double possible_amplitude(const ContactLaw& law, double rest);

/// Throws InvalidInput, and names the largest possible amplitude, if an oscillation about a contact
/// that rests at the indentation `rest` reaches pressures that no elastic contact has: for an
/// indenter a mean pressure above E*, for an exponential law a force above max_force_ratio times
/// the force at `rest`. A table cannot reach them, since its range ends earlier.
/// middle_at   returns the mean indentation for an amplitude
/// hold        what the user holds; an exponential law has no limit if the mean force is held.
///             Empty: the user cannot choose, and the message does not propose to hold the force
void require_possible(const ContactLaw& law, double rest, double amplitude,
                      const std::function<double(double)>& middle_at,
                      std::optional<Hold> hold = {});

/// The same check for a mean indentation that need not be the indentation at rest, because the mean
/// force may be held. An exponential law is then assumed to rest at 0, the origin of its
/// indentation, or higher. A power law has no limit, because it has no modulus with which to
/// compare its pressure.
void require_possible(const ContactLaw& law, double mean_indentation, double amplitude);

/// The highest indentation, up to `asked`, to which require_possible() lets a contact that rests at
/// `rest` be pressed.
double possible_indentation(const ContactLaw& law, double rest, double asked);

/// Returns a warning if the mean indentation is held and the mean force of a result exceeds twice
/// the force without oscillation; a preloaded machine would hold the force. The warning describes
/// the result with the largest ratio. Reads only `hold`, `force` and `mean_force` of the results.
std::optional<std::string> warning_of_held_indentation(std::span<const DampingResult> results);

/// As relaxation_damping(), but for a mean indentation that is not the indentation at rest, because
/// the mean force is held or the amplitude is searched.
DampingResult damping_about(const ContactLaw& law, double mean_indentation, const Motion& motion,
                            double tolerance);

/// The fastest motion u_z ω sin θ of the indentation while the bodies touch, divided by ω, m: the
/// speed at which the friction limits fall, in units of μ/g. It is u_z unless the contact lasts less
/// than half a period.
double fastest_opening(const ContactLaw& law, double mean_indentation, double normal_amplitude);

/// As steady_sliding(), but for a mean indentation that is not the indentation at rest.
std::vector<SteadySliding> steady_sliding_about(const ContactLaw& law, double mean_indentation,
                                                const NormalOscillation& normal,
                                                std::span<const double> velocities,
                                                double friction_coefficient);

}  // namespace salebra::detail
