// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/adaptive_quadrature.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/premises.hpp>
#include <string>
#include <vector>

/// A contact that is moved through its cycle in three dimensions: by contact levels, by time steps,
/// with finite friction, and with coupling of pressure and traction.
namespace salebra {

/// A surface with its boundary, and the indentation and sweep of a shape that a question leaves
/// open.
struct OscillatingBody {
  Surface surface;
  Boundary boundary = Boundary::free;
  double indentation = 0, normal_amplitude = 0;  ///< 0 for a surface from a file
};

/// The four of Fig. 3 first.
const std::vector<std::string>& oscillating_shapes();
/// A shape by its name, off the grid, with a contact that fills a third of it or less at the end of
/// the sweep. Throws InvalidInput for another name.
OscillatingBody oscillating_shape(const std::string& shape, const Grid2D& grid);

/// One contact and its motion.
struct OscillationCase {
  OscillatingBody body;
  Material material;
  Oscillation motion;
  double indentation = 0;                          ///< mean
  std::optional<FirstLoading> first_loading = {};  ///< of which the body is the residual surface
};

/// The indentation of a contact, m: of a target of which nothing is given the body's own. Throws
/// NotConverged.
double mean_indentation(const OscillatingBody& body, double contact_modulus,
                        const Target& position);

/// First loading to the mean position, with pressures up to the hardness, Pa. Where something
/// flows, the contact stands on the residual surface, at the same load.
/// throws  NotConverged, Interrupted, and as load_first()
void load_plastically(OscillationCase& contact, const Target& position, double hardness,
                      const Progress& on_progress);

/// By which routes a cycle is simulated, and how finely.
struct OscillationRoutes {
  LevelQuadratureOptions levels;
  CycleOptions cycle;
  bool frictional = false;  ///< the steps once more, with the cycle's friction and max_periods
  bool coupled = false;     ///< and once more with its coupling_constant; with frictional
  /// Levels, and cells where the shape is known, are chosen for this error of the level quadrature.
  std::optional<double> relative_error;
  std::string shape;         ///< to be refined with relative_error; empty: the grid is given
  Index most_points = 1024;  ///< of its finest grid
};

/// One simulated cycle by each of the routes.
struct OscillationOutcome {
  OscillationCase run;  ///< on the grid that was chosen
  LevelQuadratureResult levels;
  std::optional<AdaptiveQuadratureResult> choice;
  std::optional<CycleResult> cycle;  ///< nothing slips
  std::optional<CycleResult> frictional, coupled;
  double friction_coefficient = 0;  ///< of both; infinite: nothing slips
  double dundurs = 0;               ///< β of the coupled one

  double work_per_cycle() const;
  /// Error of work_per_cycle(), J: that of the steps, or of the levels where there are none; with
  /// that of the cells where those were refined.
  double error_estimate() const;
  /// What is in it: "steps" or "levels", and "cells".
  std::vector<std::string> error_contains() const;
  /// ½K u² with the greatest stiffness of the sweep and u = u_x or v/ω: what a loss has to be
  /// compared with where there is none.
  double elastic_energy() const;
  double uncertain_loss() const;  ///< what the solvers leave of a loss, J
  /// The loss over a reference; empty where the reference is not larger than its own uncertainty.
  std::optional<double> over(double reference) const;
  /// Whether F'' is below 0 by more than noise: the interpolated force bends the wrong way there,
  /// and neither it nor Eqs (12) and (15) mean anything.
  bool bends_down() const;
  bool converged() const;
  bool interrupted() const;  ///< one of its cycles
  /// Whether levels and steps agree within what they state.
  bool routes_agree() const;
  /// The relative difference of work and dissipation of one of its cycles; NaN where it loses no
  /// more than what the solvers leave.
  double balance(const CycleResult& cycle) const;
};

/// The levels alone. Throws Interrupted.
OscillationOutcome oscillation_by_levels(OscillationCase run, const OscillationRoutes& routes);

/// Stands between a cycle and its simulation, to record it: CycleRecorder::run().
using CycleRunner = std::function<CycleResult(
    const CycleOptions&, const std::function<CycleResult(const CycleOptions&)>& simulate)>;

/// Adds the cycles by steps, each from first contact: without slip, with friction, coupled. An
/// interrupted one is the last, and as it is.
void simulate_cycles(OscillationOutcome& outcome, const OscillationRoutes& routes,
                     const CycleRunner& run);

/// Loss of the steps, or of the levels where there are none, beside what the equations say of it.
OscillationLoss loss_of(const OscillationOutcome& outcome);
/// Eq. (16), or Eq. (12) with F'' = F/l², and the exponential law at this amplitude.
ExponentialLoss exponential_loss(const OscillationOutcome& outcome, double decay_length);
/// What friction changes in the loss of a cycle.
SlipEffect slip_effect(const OscillationOutcome& outcome);
/// What the coupling of normal and tangential displacements changes in it.
CouplingEffect coupling_effect(const OscillationOutcome& outcome);
/// Judges by the force at the contact levels, and by the coupled cycle where there is one; by the
/// facts alone where fewer than four levels touch.
Premises premises_of(const OscillationOutcome& outcome, ContactFacts facts);

}  // namespace salebra
