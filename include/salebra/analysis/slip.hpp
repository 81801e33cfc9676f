// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/contact.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <string>

/// Adds slip to a loss that was computed without slip. The program, studies and Python call this
/// function; reports show the results of studies.
namespace salebra {

/// Returns a sentence on why the loss of a motion with a known coefficient of friction is unknown
/// and which input is missing; empty if the loss is known, or friction is infinite. force_given:
/// true if the motion is given by an amplitude of the normal force.
std::string why_loss_unknown(const Motion& motion, const ContactParameters& parameters,
                             bool force_given = false);

/// Replaces the loss without slip in `result` by the loss of the motion as described: with slip if
/// the coefficient of friction is known, NaN if why_loss_unknown() gives a reason. For a Drag it
/// uses loss_with_slip(), which includes the turning points; any other motion is followed along
/// `steps` straight steps of its period.
///
///     DampingResult result = relaxation_damping(law, at_force(1), motion);
///     add_slip(result, law, motion, {.friction_coefficient = 0.3, .excursion = 1e-5});
///
/// Throws InvalidInput wherever loss_with_slip() and trajectory_damping() do, and Interrupted.
/// Cost: some milliseconds, or `steps` steps of a TangentialContact.
void add_slip(DampingResult& result, const ContactLaw& law, const Motion& motion,
              const ContactParameters& parameters, int steps = 2000, const Context& context = {});

/// Removes a loss that came from a curve and is no larger than its error, and returns a sentence
/// that says so; empty if the loss stays.
std::string drop_uncertain(DampingResult& result);

/// One period of a motion about a mean indentation, and the loss along it: the data of a plot.
struct DampingCycle {
  SampledMotion path;
  TrajectoryDamping loss;
};
/// Computes one period of a motion about a mean indentation, m, with `steps` straight steps.
/// friction_coefficient NaN: no slip.
DampingCycle cycle_of(const ContactLaw& law, const Motion& motion, double indentation, int steps,
                      double friction_coefficient, const Context& context = {});

}  // namespace salebra
