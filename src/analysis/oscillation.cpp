// SPDX-License-Identifier: GPL-3.0-or-later
// One oscillating contact, computed by the theorem W = ½∮s² dK_t (s: stretch of a spring where it
// separates) and by direct simulation: bodies, methods and results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/analysis/contact.hpp>
#include <salebra/analysis/oscillation.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/coupling.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/shapes.hpp>
#include <salebra/surface/moments.hpp>

#include "damping/judge.hpp"
#include "damping/surface_law.hpp"

namespace salebra {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// Largest |a − b| of a quantity over a cycle, divided by the largest |b|.
double change(const CycleResult& a, const CycleResult& b, double CycleSample::*quantity) {
  std::vector<double> values = column(a, quantity);
  const std::vector<double> reference = column(b, quantity);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= reference[i];
  const double scale = greatest(reference);
  return scale > 0 ? greatest(values) / scale : unknown;
}

double tangential_scale(const Oscillation& motion) {
  if (const auto* drag = std::get_if<Drag>(&motion))
    return drag->drag_velocity / drag->angular_frequency;
  return std::get<EqualFrequency>(motion).tangential_amplitude;
}

ContactSets intervals_of(const OscillatingBody& body, const Body& material) {
  return boundary_element_contact_sets(body.surface, material, {.boundary = body.boundary});
}

/// Returns the constants of the half-spaces. Throws InvalidInput for another body; field: what needs
/// them.
const Material& constants_of(const Body& material, const std::string& field) {
  require_that(material.half_space_material().has_value(), field,
               "needs homogeneous half-spaces; leave it out, or give their elastic constants");
  return *material.half_space_material();
}

NormalContactState contact_at(const OperatingPoint& position, const OscillatingBody& body,
                              const Body& material, const NormalContactOptions& options) {
  NormalContactState state = press(body.surface, material, position, options);
  if (!state.converged())
    throw NotConverged("oscillate: the contact at the mean indentation did not converge");
  return state;
}

/// value/reference; NaN if |reference| is not larger than the numerical error of a loss.
double ratio(const OscillationOutcome& outcome, double value, double reference) {
  return std::abs(reference) > outcome.uncertain_loss() ? value / reference : unknown;
}

}  // namespace

const std::vector<std::string>& oscillating_shapes() {
  static const std::vector<std::string> names{"cylinder",  "paraboloid", "pyramids",
                                              "sinusoids", "cone",       "elliptic-paraboloid"};
  return names;
}

OscillatingBody oscillating_shape(const std::string& shape, const Grid2D& grid) {
  const double size = grid.lx;
  const PlanePoint center = off_grid_center(grid);
  const PlanePoint shift{0.31 * grid.dx(), 0.17 * grid.dy()};
  // The last two numbers of each body are its indentation δ0 and its normal amplitude u_z = 0.3 δ0.
  if (shape == "cylinder")
    return {flat_punch_surface(grid, 0.3 * size, size, center), Boundary::free, 0.02 * size,
            0.006 * size};
  if (shape == "paraboloid")
    return {paraboloid_surface(grid, 4 * size, center), Boundary::free, 0.02 * size, 0.006 * size};
  if (shape == "cone")
    return {cone_surface(grid, 0.05, center), Boundary::free, 0.02 * size, 0.006 * size};
  if (shape == "elliptic-paraboloid")
    return {elliptic_paraboloid_surface(grid, 6 * size, 2 * size, center), Boundary::free,
            0.02 * size, 0.006 * size};
  if (shape == "pyramids")
    return {pyramids_surface(grid, 4, 4, 0.1, shift), Boundary::free, 0.006 * size, 0.0018 * size};
  require(shape == "sinusoids", "shape", shape,
          fmt::format("is not one of {}", fmt::join(oscillating_shapes(), ", ")));
  return {sinusoid_surface(grid, 0.01 * size, 1, 4, shift), Boundary::periodic, 0.0045 * size,
          0.00135 * size};
}

double OscillationOutcome::work_per_cycle() const {
  return cycle ? cycle->work_per_cycle : intervals.work_per_cycle;
}

double OscillationOutcome::error_estimate() const {
  if (!cycle) return intervals.error_estimate;
  return cycle->step_error + (choice ? choice->cell_error : 0);
}

std::vector<std::string> OscillationOutcome::error_contains() const {
  std::vector<std::string> parts{cycle ? "steps" : "intervals"};
  if (choice && choice->cell_error > 0) parts.emplace_back("cells");
  return parts;
}

double OscillationOutcome::elastic_energy() const {
  double stiffness = 0;
  for (const ForceSample& sample : intervals.curve.samples)
    if (std::isfinite(sample.tangential_stiffness))
      stiffness = std::max(stiffness, sample.tangential_stiffness);
  const double scale = tangential_scale(run.motion);
  return stiffness * scale * scale / 2;
}

double OscillationOutcome::uncertain_loss() const { return 1e-7 * elastic_energy(); }

std::optional<double> OscillationOutcome::over(double reference) const {
  // If the contact set does not change during the cycle, the loss of the quadrature is only the
  // error of its solvers.
  if (std::abs(reference) <= std::max(intervals.error_estimate, uncertain_loss())) return {};
  return work_per_cycle() / reference;
}

bool OscillationOutcome::bends_down() const {
  // The small-amplitude loss is proportional to F''. It is 0 for a flat punch except for the noise
  // of the force, so only a clearly negative value counts.
  return intervals.small_amplitude_work < -1e-3 * elastic_energy();
}

bool OscillationOutcome::converged() const {
  const auto done = [](const std::optional<CycleResult>& one) { return !one || one->converged(); };
  return intervals.converged() && done(cycle) && done(frictional) && done(coupled);
}

bool OscillationOutcome::slips() const { return frictional && std::isfinite(friction_coefficient); }

bool OscillationOutcome::interrupted() const {
  const auto stopped = [](const std::optional<CycleResult>& one) {
    return one && one->termination == Termination::interrupted;
  };
  return stopped(cycle) || stopped(frictional) || stopped(coupled);
}

bool OscillationOutcome::routes_agree() const {
  return std::abs(intervals.work_per_cycle - cycle->work_per_cycle) <=
         intervals.error_estimate + cycle->step_error + uncertain_loss();
}

double OscillationOutcome::balance(const CycleResult& one) const {
  return std::abs(one.work_per_cycle) > uncertain_loss() ? one.balance() : unknown;
}

double mean_indentation(const OscillatingBody& body, const Body& material,
                        const OperatingPoint& point) {
  if (point.control == ControlQuantity::indentation) return point.value;
  return contact_at(point, body, material, {.boundary = body.boundary}).indentation;
}

double mean_indentation(const OscillatingBody& body, const Body& material,
                        const OperatingPoint& point, const Oscillation& motion, Hold hold,
                        const Progress& on_progress) {
  const double amplitude = std::visit([](const auto& m) { return m.normal_amplitude; }, motion);
  const NormalContactOptions options{.boundary = body.boundary, .on_progress = on_progress};
  const auto at = [&](const OperatingPoint& one) {
    return contact_at(one, body, material, options);
  };
  if (hold != Hold::force && point.control == ControlQuantity::indentation) return point.value;
  const NormalContactState rest = at(point);
  if (hold == Hold::automatic)
    hold = point.load_given() && amplitude > rest.indentation ? Hold::force : Hold::indentation;
  if (hold == Hold::indentation || !(rest.force > 0)) return rest.indentation;
  // Neighbouring contacts differ by this factor of the force.
  constexpr double factor = 1.35, lowest = 0.01;
  ForceCurve curve;
  curve.nominal_area = body.surface.grid.area();
  const auto add = [&](const NormalContactState& state) {
    curve.samples.push_back({.indentation = state.indentation, .force = state.force});
  };
  for (double share = lowest; share < 1; share *= factor) add(at(at_force(share * rest.force)));
  add(rest);
  const bool closes = body.boundary == Boundary::periodic && material.stops_at_full_contact();
  const double full =
      closes ? detail::full_contact(body.surface) : std::numeric_limits<double>::infinity();
  for (;;) {
    const TabulatedLaw law(curve, 1);
    const double middle = detail::mean_indentation(law, rest.force, amplitude, hold);
    const double top = law.highest_indentation();
    if (middle + amplitude <= top) return middle;
    const auto next = detail::further_indentation(law, middle + amplitude, full, hold);
    if (!next)
      detail::refuse_full_contact(
          amplitude, rest.mean_pressure,
          detail::possible_amplitude(law, rest.force, amplitude, hold, top));
    const double length = law.force(top) / law.normal_stiffness(top);
    add(at(at_indentation(std::min(*next, top + std::log(factor) * length))));
  }
}

void load_plastically(OscillationCase& contact, const OperatingPoint& point, double hardness,
                      const Progress& on_progress) {
  const double modulus = constants_of(contact.material, "hardness").contact_modulus;
  const NormalContactOptions elastic{.boundary = contact.body.boundary, .on_progress = on_progress};
  NormalContactOptions plastic = elastic;
  plastic.hardness = hardness;
  const double pressure =
      point.control == ControlQuantity::pressure
          ? point.value
          : contact_at(point, contact.body, contact.material, plastic).mean_pressure;
  OscillatingBody residual = contact.body;
  contact.first_loading = load_first(
      residual.surface, hardness, modulus, pressure, elastic,
      std::visit([](const auto& motion) { return motion.normal_amplitude; }, contact.motion));
  if (!contact.first_loading->yielded()) return;
  contact.body = std::move(residual);
  contact.indentation =
      contact_at(at_pressure(pressure), contact.body, contact.material, elastic).indentation;
}

OscillationOutcome oscillation_by_intervals(OscillationCase run, const OscillationRoutes& routes) {
  OscillationOutcome outcome;
  outcome.run = std::move(run);
  OscillationCase& contact = outcome.run;
  const Grid2D& grid = contact.body.surface.grid;
  if (routes.relative_error) {
    AdaptiveQuadratureOptions options;
    options.relative_error = *routes.relative_error;
    options.max_points = routes.max_points;
    options.quadrature = routes.intervals;
    const auto choose = [&](const auto& intervals) {
      return adaptive_interval_quadrature(intervals, grid, contact.material, contact.motion,
                                          contact.indentation, options);
    };
    if (routes.shape.empty()) {
      outcome.choice = choose(intervals_of(contact.body, contact.material));
    } else {
      const auto shape_on = [&, boundary = contact.body.boundary](const Grid2D& finer) {
        OscillatingBody body = oscillating_shape(routes.shape, finer);
        body.boundary = boundary;
        return body;
      };
      outcome.choice = choose(ContactSetsOnGrid(
          [&](const Grid2D& finer) { return intervals_of(shape_on(finer), contact.material); }));
      contact.body = shape_on(outcome.choice->grid);
    }
    outcome.intervals = outcome.choice->quadrature;
  } else {
    outcome.intervals =
        interval_quadrature(intervals_of(contact.body, contact.material), grid, contact.material,
                            contact.motion, contact.indentation, routes.intervals);
  }
  if (outcome.intervals.termination == Termination::interrupted)
    throw Interrupted("interrupted; nothing was written");
  const double amplitude =
      std::visit([](const auto& m) { return m.normal_amplitude; }, contact.motion);
  const bool from_file = contact.body.indentation == 0;
  if (from_file && contact.indentation < amplitude) {
    // The polynomial through the forces of a cycle that lifts off does not describe a rough surface
    // at its mean indentation.
    outcome.intervals.force =
        contact.indentation > 0 ? contact_at(at_indentation(contact.indentation), contact.body,
                                             contact.material, {.boundary = contact.body.boundary})
                                      .force
                                : 0;
    outcome.intervals.force_curvature = outcome.intervals.small_amplitude_work = unknown;
  }
  return outcome;
}

void simulate_cycles(OscillationOutcome& outcome, const OscillationRoutes& routes,
                     const CycleRunner& run) {
  const OscillationCase& contact = outcome.run;
  const Surface& surface = contact.body.surface;
  const Body& material = contact.material;
  const NormalContactOptions normal{.boundary = contact.body.boundary};
  outcome.friction_coefficient = routes.cycle.friction_coefficient;
  if (routes.coupled)
    outcome.dundurs = dundurs_constant(constants_of(material, "coupled").contact_modulus,
                                       *routes.cycle.coupling_constant);
  const Trajectory trajectory = trajectory_of(contact.motion, contact.indentation);
  outcome.cycle = run(routes.cycle, [&](const CycleOptions& options) {
    return simulate_cycle(intervals_of(contact.body, material), surface.grid, material, trajectory,
                          options);
  });
  if (!routes.frictional || outcome.interrupted()) return;
  const PressureFields intervals = boundary_element_pressures(surface, material, normal);
  outcome.frictional = run(routes.cycle, [&](const CycleOptions& options) {
    return simulate_frictional_cycle(intervals, surface.grid, material, trajectory, options);
  });
  if (!routes.coupled || outcome.interrupted()) return;
  outcome.coupled = run(routes.cycle, [&](const CycleOptions& options) {
    return simulate_coupled_cycle(surface, constants_of(material, "coupled"), trajectory, options,
                                  normal);
  });
}

OscillationLoss loss_of(const OscillationOutcome& outcome) {
  const IntervalQuadratureResult& intervals = outcome.intervals;
  OscillationLoss loss{
      .work_per_cycle = outcome.work_per_cycle(),
      .error_estimate = outcome.error_estimate(),
      .work_by_intervals = intervals.work_per_cycle,
      .work_by_intervals_error = intervals.error_estimate,
      .work_by_whole_cells = intervals.work_by_intervals,
      .work_by_force = intervals.work_by_force,
      .ratio_finite = outcome.over(intervals.work_by_force),
      .work_over_elastic_energy = outcome.work_per_cycle() / outcome.elastic_energy(),
      .indentation = outcome.run.indentation,
      .force = intervals.force,
      // The contacts at the largest and the smallest indentation do not count as nodes; they have
      // no tangential solve, except that at the smallest indentation under a drag.
      .intervals = intervals.curve.samples.size() - 2,
      .direction = intervals.direction};
  if (!outcome.bends_down()) {
    loss.small_amplitude_work = intervals.small_amplitude_work;
    loss.ratio = outcome.over(intervals.small_amplitude_work);
    loss.force_curvature = intervals.force_curvature;
  }
  return loss;
}

ExponentialLoss exponential_loss(const OscillationOutcome& outcome, double decay_length) {
  require_positive(decay_length, "decay_length");
  const double modulus_ratio = constants_of(outcome.run.material, "decay_length").modulus_ratio(),
               force = outcome.intervals.force;
  const double small = std::visit(
      [&](const auto& motion) {
        return closed_form::work_per_cycle(modulus_ratio, force / (decay_length * decay_length),
                                           motion);
      },
      outcome.run.motion);
  const ExponentialLaw law(force, decay_length, modulus_ratio);
  const double finite = relaxation_damping(law, at_force(force), outcome.run.motion).work_per_cycle;
  return {.decay_length = decay_length,
          .predicted_exponential = small,
          .ratio_exponential = outcome.over(small),
          .predicted_exponential_finite = finite,
          .ratio_exponential_finite = outcome.over(finite)};
}

SlipEffect slip_effect(const OscillationOutcome& outcome) {
  const CycleResult& frictional = *outcome.frictional;
  SlipEffect effect{
      .over_stick = ratio(outcome, frictional.work_per_cycle, outcome.work_per_cycle()),
      .mean_tangential_force = unknown,
      .mean_force = mean_over_period(frictional, &CycleSample::normal_force)};
  if (std::holds_alternative<Drag>(outcome.run.motion))
    effect.mean_tangential_force =
        frictional.work_per_cycle / std::abs(frictional.samples.back().tangential);
  return effect;
}

CouplingEffect coupling_effect(const OscillationOutcome& outcome) {
  const CycleResult &coupled = *outcome.coupled, &frictional = *outcome.frictional;
  return {.work_change = ratio(outcome, coupled.work_per_cycle - frictional.work_per_cycle,
                               frictional.work_per_cycle),
          .force_change = change(coupled, frictional, &CycleSample::normal_force),
          .tangential_force_change = change(coupled, frictional, &CycleSample::tangential_force)};
}

Assumptions assumptions_of(const OscillationOutcome& outcome, ContactParameters parameters) {
  const OscillationCase& run = outcome.run;
  ForceCurve curve = outcome.intervals.curve;
  const Grid2D& grid = run.body.surface.grid;
  const double contact = curve.samples.back().contact_area_fraction * grid.area();
  const bool spot = run.body.boundary == Boundary::free;
  if (const auto& material = run.material.half_space_material())
    parameters.contact_modulus = material->contact_modulus;
  parameters.mean_contact_pressure = curve.samples.back().force / contact;
  parameters.loaded_size = spot ? std::sqrt(contact / std::numbers::pi) : grid.lx;
  parameters.nominal_pressure = outcome.intervals.force / (spot ? contact : grid.area());
  if (run.first_loading && run.first_loading->yielded())
    parameters.first_load = run.first_loading->pressure * grid.area();
  // The outermost contacts have no tangential solve, and no modulus gives K_t of another body.
  if (!run.material.half_space_material())
    std::erase_if(curve.samples,
                  [](const ForceSample& one) { return std::isnan(one.tangential_stiffness); });
  const auto touching = std::ranges::count_if(curve.samples, [](const ForceSample& sample) {
    return sample.converged && sample.force > 0;
  });
  Assumptions assumptions;
  if (touching >= 4)
    assumptions = assumptions_of(TabulatedLaw(curve, run.material.modulus_ratio()), run.indentation,
                                 run.motion, parameters);
  // Judges coupling by the change of the loss that was simulated here, instead of by the largest
  // change in simulations of other contacts.
  if (outcome.coupled && !std::holds_alternative<Drag>(run.motion)) {
    Assumption& coupling = assumptions.coupling;
    coupling.value =
        std::abs(outcome.coupled->work_per_cycle / outcome.frictional->work_per_cycle - 1);
    coupling.verdict = Verdict::unknown;
    detail::judge(coupling);
  }
  return assumptions;
}

}  // namespace salebra
