// SPDX-License-Identifier: GPL-3.0-or-later
// Partial slip under tangential oscillations: by the law, by a surface's contacts, cell by cell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/questions/damping.hpp>
#include <utility>

#include "damping/largest_motion.hpp"
#include "part.hpp"

namespace salebra {
namespace {

void require_converged(const std::vector<JointLoss>& losses, std::string_view what) {
  if (const auto lost = std::ranges::count(losses, false, &JointLoss::converged); lost > 0)
    throw NotConverged(fmt::format("joint: {} of {} {}", lost, losses.size(), what));
}

/// Every motion once more, cell by cell, at the same indentation.
std::vector<JointLoss> simulate(const JointQuestion& question, const Surface& surface,
                                const Material& material, double indentation,
                                const Context& context) {
  const PressureLevels levels = boundary_element_pressures(surface, material.contact_modulus);
  CycleOptions options{.friction_coefficient = question.facts.friction_coefficient,
                       .steps = *question.direct_steps,
                       .max_periods = 20};
  options.on_progress = context.on_progress;
  std::vector<JointLoss> losses;
  for (const TangentialOscillation& motion : question.motions) {
    losses.push_back(simulated_joint_loss(levels, surface.grid, material, indentation,
                                          {motion, question.normal_amplitude, question.phase},
                                          options));
    if (context.stopped && context.stopped())
      throw Interrupted("joint: stopped before all motions were done");
  }
  require_converged(losses, "motions cell by cell did not converge to a steady loss");
  return losses;
}

/// What is said of a part in place of its sample.
std::string remark_on_area(double part, double sample) {
  return fmt::format(
      "forces and works are of the part, {}, and {:.6g} times those of the sample, {}",
      format_quantity(part, Dimension::length_squared), part / sample,
      format_quantity(sample, Dimension::length_squared));
}

std::vector<JointLoss> of_part(std::vector<JointLoss> losses, double ratio) {
  for (JointLoss& one : losses)
    for (const auto extensive :
         {&JointLoss::tangential_force, &JointLoss::work_per_cycle, &JointLoss::relaxation_work,
          &JointLoss::slip_work, &JointLoss::work_error, &JointLoss::secant_stiffness,
          &JointLoss::storage_stiffness, &JointLoss::loss_stiffness})
      one.*extensive *= ratio;
  return losses;
}

/// Motions of the sample that stands for a part.
std::vector<TangentialOscillation> of_sample(std::vector<TangentialOscillation> motions,
                                             double ratio) {
  for (TangentialOscillation& motion : motions)
    if (auto* force = std::get_if<TangentialForce>(&motion)) force->amplitude /= ratio;
  return motions;
}

/// By the springs of the law.
std::vector<JointLoss> losses_of_law(const JointQuestion& question, const ContactLaw& law,
                                     const Position& position, const Context& context) {
  const double friction = question.facts.friction_coefficient;
  std::vector<JointLoss> losses;
  const auto of_all = [&](ProgressReport report) {
    report.fraction = (double(losses.size()) + report.fraction) / double(question.motions.size());
    return !context.on_progress || context.on_progress(report);
  };
  for (const TangentialOscillation& motion : question.motions)
    losses.push_back(question.normal_amplitude != 0
                         ? joint_loss(law, position,
                                      {motion, question.normal_amplitude, question.phase}, friction,
                                      question.steps, of_all)
                         : joint_loss(law, position, motion, friction));
  return losses;
}

}  // namespace

JointAnswer ask(JointQuestion question, const Context& context) {
  require_that(!question.motions.empty(), "motions", "not given; give one");
  const bool oscillates = question.normal_amplitude != 0;
  Material material;
  auto* surface = std::get_if<SurfaceContact>(&question.contact);
  require(surface || !question.direct_steps, "direct_steps", question.direct_steps.value_or(0),
          "is of a surface cell by cell; give `surface`");
  const double area = question.nominal_area;
  double ratio = 1;  // of a surface, which is solved as it is
  std::string remark;
  if (!std::isnan(area)) require_positive(area, "nominal_area");
  if (surface) {
    surface->normal_amplitude = std::abs(question.normal_amplitude);
    material = surface->material;
    if (!std::isnan(area)) ratio = area / surface->surface.grid.area();
    if (ratio != 1) remark = remark_on_area(area, area / ratio);
  } else if (auto* curve = std::get_if<CurveContact>(&question.contact);
             curve && !std::isnan(area)) {
    const double sample =
        std::exchange(curve->curve, curve_of_part(curve->curve, area, curve->source)).nominal_area;
    if (sample > 0 && sample != area) remark = remark_on_area(area, sample);
  }
  JointAnswer answer{ask(std::move(question.contact), context)};
  require(answer.contact.positions.size() == 1, "normal_force",
          fmt::format("{} positions", answer.contact.positions.size()),
          "are given; a joint takes one, and several tangential forces or amplitudes");
  if (!remark.empty()) answer.remarks.push_back(remark);
  const double friction = question.facts.friction_coefficient;
  const Position of_body = answer.contact.positions.front();
  std::shared_ptr<const ContactLaw> sample;  // where the surface is not the part
  if (ratio != 1) {
    sample = std::move(answer.contact.law);
    answer.contact.law = law_of_part(sample, ratio);
    answer.contact.curve = curve_of_part(*answer.contact.curve, area, "surface");
    if (auto* force = std::get_if<AtForce>(&answer.contact.positions.front()))
      force->force *= ratio;
  }
  const Position& position = answer.contact.positions.front();
  const ContactLaw& law = *answer.contact.law;
  if (surface && !oscillates) {
    // What the part cannot bear is refused in its own forces.
    if (sample)
      for (const TangentialOscillation& motion : question.motions)
        joint_loss(law, position, motion, friction);
    answer.losses = of_part(
        surface_joint_loss(*answer.contact.surface, material, sample ? *sample : law, of_body,
                           of_sample(question.motions, ratio), friction, context.on_progress),
        ratio);
  } else {
    answer.losses = losses_of_law(question, law, position, context);
  }
  require_converged(answer.losses, "integrals did not reach the tolerance");
  if (surface && oscillates)
    answer.remarks.emplace_back(
        "the loss is that of a law through some loads: its error is not known while the normal "
        "force oscillates");
  if (const auto lost = std::ranges::count_if(
          answer.losses, [](const JointLoss& one) { return std::isnan(one.work_per_cycle); });
      lost > 0)
    answer.remarks.push_back(
        fmt::format("n/a at {} of {} motions: the error of the loss is larger than the loss, "
                    "because too few cells part where the joint slips; a finer surface helps",
                    lost, answer.losses.size()));
  const double indentation = answer.losses.front().indentation;
  answer.state = state_of(law, indentation);
  if (oscillates) {
    const DampingResult mean{
        .force = answer.state.force,
        .mean_force = mean_force_of_cycle(law, indentation, question.normal_amplitude)};
    if (const auto doubt = detail::doubt_of_held_indentation({}, {&mean, 1}))
      answer.contact.doubts.push_back(*doubt);
  }
  if (question.direct_steps) {
    question.motions = of_sample(question.motions, ratio);
    answer.simulated =
        of_part(simulate(question, *answer.contact.surface, material, indentation, context), ratio);
  }

  const JointLoss& largest =
      *std::ranges::max_element(answer.losses, {}, &JointLoss::tangential_amplitude);
  answer.largest = {question.normal_amplitude, largest.tangential_amplitude, question.phase,
                    question.angular_frequency};
  // A constant normal force is the limit of small normal amplitudes.
  EqualFrequency judged = answer.largest;
  if (!oscillates)
    judged.normal_amplitude = 1e-6 * answer.state.force / answer.state.normal_stiffness;
  answer.premises = answer.contact.premises_beside_slip(indentation, judged, question.facts);
  return answer;
}

}  // namespace salebra
