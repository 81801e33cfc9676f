// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/contact.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <string>

/// Adds slip to a loss. The program, studies and Python call this; the report shows what a study found.
namespace salebra {

/// Returns a sentence on why the loss of a motion with a known coefficient of friction is unknown
/// and which input is missing; empty if it is known, or friction is infinite. force_given: the normal
/// force oscillates by a given amplitude.
std::string why_loss_unknown(const Motion& motion, const ContactParameters& parameters,
                             bool force_given = false);

/// Turns the loss of a law without slip into that of the motion as described: with slip where the
/// coefficient of friction is known, NaN where why_loss_unknown() gives a reason. A slow motion
/// uses loss_with_slip(), with its turning points; other motions are followed along `steps`
/// straight steps of their period.
///
///     DampingResult result = relaxation_damping(law, at_force(1), motion);
///     add_slip(result, law, motion, {.friction_coefficient = 0.3, .excursion = 1e-5});
///
/// Throws InvalidInput as loss_with_slip() and trajectory_damping(), and Interrupted.
/// Cost: some milliseconds; one step of the law for each of `steps`.
void add_slip(DampingResult& result, const ContactLaw& law, const Motion& motion,
              const ContactParameters& parameters, int steps = 2000, const Context& context = {});

/// One period of a motion about a mean indentation, and the loss along it: the data of a plot.
struct DampingCycle {
  SampledMotion path;
  TrajectoryDamping loss;
};
/// Computes that period. friction_coefficient NaN: no slip.
DampingCycle cycle_of(const ContactLaw& law, const Motion& motion, double indentation, int steps,
                      double friction_coefficient, const Context& context = {});

}  // namespace salebra
