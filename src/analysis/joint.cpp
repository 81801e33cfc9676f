// SPDX-License-Identifier: GPL-3.0-or-later
// Partial slip of joints under tangential oscillations, by three methods: with the contact law,
// with contacts of a surface, and by simulation cell by cell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/analysis/damping.hpp>
#include <salebra/base/error.hpp>
#include <salebra/surface/lay.hpp>
#include <utility>

#include "damping/max_motion.hpp"
#include "part.hpp"

namespace salebra {
namespace {

void require_converged(const std::vector<JointLoss>& losses, std::string_view what) {
  if (const auto lost = std::ranges::count(losses, false, &JointLoss::converged); lost > 0)
    throw NotConverged(fmt::format("joint: {} of {} {}", lost, losses.size(), what));
}

/// Simulates every motion again cell by cell, at the same indentation.
std::vector<JointLoss> simulate(const JointProblem& problem, const Surface& surface,
                                const Body& body, double indentation, const Context& context) {
  const PressureFields pressures = boundary_element_pressures(surface, body);
  CycleOptions options{.friction_coefficient = problem.parameters.friction_coefficient,
                       .steps = *problem.direct_steps,
                       .max_periods = 20};
  options.on_progress = context.on_progress;
  std::vector<JointLoss> losses;
  for (const TangentialOscillation& motion : problem.motions) {
    losses.push_back(simulated_joint_loss(pressures, surface.grid, body, indentation,
                                          {motion, problem.normal_amplitude, problem.phase},
                                          options));
    if (context.stopped && context.stopped())
      throw Interrupted("joint: stopped before all motions were done");
  }
  require_converged(losses, "simulations cell by cell did not converge to a steady loss");
  return losses;
}

/// A warning that forces and losses are those of the part, which is larger or smaller than its
/// sample.
std::string warning_of_area(double part, double sample) {
  return fmt::format(
      "forces and works are those of the part, {}; they are {:.6g} times those of the sample, {}",
      format_quantity(part, Dimension::length_squared), part / sample,
      format_quantity(sample, Dimension::length_squared));
}

std::vector<JointLoss> of_part(std::vector<JointLoss> losses, double ratio) {
  for (JointLoss& one : losses)
    for (const auto extensive :
         {&JointLoss::tangential_force, &JointLoss::work_per_cycle, &JointLoss::relaxation_work,
          &JointLoss::slip_work, &JointLoss::work_error, &JointLoss::secant_stiffness,
          &JointLoss::storage_stiffness, &JointLoss::loss_stiffness, &JointLoss::mean_force,
          &JointLoss::max_force})
      one.*extensive *= ratio;
  return losses;
}

/// The motions of the sample that correspond to those of the part: force amplitudes are divided by
/// `ratio`, the area of the part over that of the sample.
std::vector<TangentialOscillation> of_sample(std::vector<TangentialOscillation> motions,
                                             double ratio) {
  for (TangentialOscillation& motion : motions)
    if (auto* force = std::get_if<TangentialForce>(&motion)) force->amplitude /= ratio;
  return motions;
}

/// Losses of all motions, computed from the springs of the contact law.
std::vector<JointLoss> losses_of_law(const JointProblem& problem, const ContactLaw& law,
                                     const OperatingPoint& point, const Context& context) {
  const double friction = problem.parameters.friction_coefficient;
  std::vector<JointLoss> losses;
  const auto of_all = [&](ProgressReport report) {
    report.fraction = (double(losses.size()) + report.fraction) / double(problem.motions.size());
    return !context.on_progress || context.on_progress(report);
  };
  for (const TangentialOscillation& motion : problem.motions)
    losses.push_back(problem.normal_amplitude != 0 ? joint_loss(law, point,
                                                                {motion, problem.normal_amplitude,
                                                                 problem.phase, problem.hold},
                                                                friction, problem.steps, of_all)
                                                   : joint_loss(law, point, motion, friction));
  return losses;
}

}  // namespace

JointSolution solve(JointProblem problem, const Context& context) {
  require_that(!problem.motions.empty(), "motions", "not given; give one");
  const bool oscillates = problem.normal_amplitude != 0;
  std::optional<Body> body;
  auto* surface = std::get_if<SurfaceContact>(&problem.contact);
  require(surface || !problem.direct_steps, "direct_steps", problem.direct_steps.value_or(0),
          "simulates a surface cell by cell; give `surface`");
  const double area = problem.nominal_area;
  double ratio = 1;  // area of the part divided by that of the surface
  std::string warning;
  if (!std::isnan(area)) require_positive(area, "nominal_area");
  if (surface) {
    surface->normal_amplitude = std::abs(problem.normal_amplitude);
    surface->hold = problem.hold;
    body = surface->body;
    if (!std::isnan(area)) ratio = area / surface->surface.grid.area();
    if (ratio != 1) warning = warning_of_area(area, area / ratio);
  } else if (auto* curve = std::get_if<CurveContact>(&problem.contact);
             curve && !std::isnan(area)) {
    const double sample =
        std::exchange(curve->curve, curve_of_part(curve->curve, area, curve->source)).nominal_area;
    if (sample > 0 && sample != area) warning = warning_of_area(area, sample);
  }
  JointSolution solution{solve(std::move(problem.contact), context)};
  require(solution.contact.points.size() == 1, "normal_force",
          fmt::format("{} operating points", solution.contact.points.size()),
          "given; a joint takes one, with several tangential forces or amplitudes");
  if (!warning.empty()) solution.warnings.push_back(warning);
  const double friction = problem.parameters.friction_coefficient;
  const double direction =
      std::isnan(solution.contact.direction()) ? 0 : solution.contact.direction();
  require(direction == 0 || !problem.direct_steps, "direction", direction_in_words(direction),
          "given, but the simulation cell by cell is of motion along x; leave one of them out");
  const OperatingPoint of_body = solution.contact.points.front();
  // Law of the surface; empty if the surface itself is the part.
  std::shared_ptr<const ContactLaw> sample;
  if (ratio != 1) {
    sample = std::move(solution.contact.law);
    solution.contact.law = law_of_part(sample, ratio);
    solution.contact.curve = curve_of_part(*solution.contact.curve, area, "surface");
    OperatingPoint& point = solution.contact.points.front();
    if (point.load_given()) point.value *= ratio;
  }
  const OperatingPoint& point = solution.contact.points.front();
  const ContactLaw& law = *solution.contact.law;
  if (surface && !oscillates) {
    // Checks the motions on the part, so that the message about a force that is too large states
    // forces of the part and not of the sample.
    if (sample)
      for (const TangentialOscillation& motion : problem.motions)
        joint_loss(law, point, motion, friction);
    solution.losses =
        of_part(surface_joint_loss(*solution.contact.surface, *body, sample ? *sample : law,
                                   of_body, of_sample(problem.motions, ratio), friction,
                                   context.on_progress, direction),
                ratio);
  } else {
    solution.losses = losses_of_law(problem, law, point, context);
  }
  require_converged(solution.losses, "integrals did not reach the tolerance");
  if (surface && oscillates) {
    // The error by the distances between the loads is known, that by the cells is not.
    for (JointLoss& loss : solution.losses) loss.work_error = JointLoss::unknown;
    solution.warnings.emplace_back(
        "the loss is computed on a law through some loads; its error is not known, because the "
        "normal force oscillates");
  }
  if (const auto lost = std::ranges::count_if(
          solution.losses, [](const JointLoss& one) { return std::isnan(one.work_per_cycle); });
      lost > 0)
    solution.warnings.push_back(
        fmt::format("n/a at {} of {} motions: the error of the loss is larger than the loss, "
                    "because too few cells separate where the joint slips; use a finer surface",
                    lost, solution.losses.size()));
  const double indentation = solution.losses.front().indentation;
  solution.state = state_of(law, indentation);
  if (oscillates) {
    const JointLoss& any = solution.losses.front();
    DampingResult mean;
    mean.hold = any.hold;
    mean.force = solution.state.force;
    mean.mean_force = any.mean_force;
    if (const auto held = detail::warning_of_held_indentation({&mean, 1}))
      solution.contact.warnings.push_back(*held);
  }
  if (problem.direct_steps) {
    problem.motions = of_sample(problem.motions, ratio);
    solution.simulated =
        of_part(simulate(problem, *solution.contact.surface, *body, indentation, context), ratio);
  }
  if (problem.angular_frequency > 0)
    for (std::vector<JointLoss>* losses : {&solution.losses, &solution.simulated})
      for (JointLoss& one : *losses) one.set_damping_constant(problem.angular_frequency);
  if (const auto sliding = std::ranges::count(solution.losses, Regime::sliding, &JointLoss::regime);
      sliding > 0)
    solution.warnings.push_back(fmt::format(
        "the contact slides at {} of {} motions{}: its loss is that of Coulomb friction, not of a "
        "damper",
        sliding, solution.losses.size(), oscillates ? "" : ", with T above 0.95 μF"));

  const JointLoss& largest =
      *std::ranges::max_element(solution.losses, {}, &JointLoss::tangential_amplitude);
  solution.largest = {problem.normal_amplitude, largest.tangential_amplitude, problem.phase,
                      problem.angular_frequency};
  // With a constant normal force the assumptions are those of a very small normal amplitude.
  EqualFrequency judged = solution.largest;
  if (!oscillates)
    judged.normal_amplitude = 1e-6 * solution.state.force / solution.state.normal_stiffness;
  solution.assumptions =
      solution.contact.assumptions_beside_slip(indentation, judged, problem.parameters);
  // Each motion has a regime of its own.
  solution.assumptions.regime = Regime::unknown;
  return solution;
}

}  // namespace salebra
