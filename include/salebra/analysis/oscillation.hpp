// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/adaptive_quadrature.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/assumptions.hpp>
#include <string>
#include <vector>

/// A contact simulated through its cycle in three dimensions: by level quadrature, by time steps,
/// with finite friction, and with coupling of pressure and traction.
namespace salebra {

/// A surface with its boundary, and the default indentation and amplitude of a shape.
struct OscillatingBody {
  Surface surface;
  Boundary boundary = Boundary::free;
  double indentation = 0, normal_amplitude = 0;  ///< 0 for a surface from a file
};

/// Names of the shapes; the four of Fig. 3 come first.
const std::vector<std::string>& oscillating_shapes();
/// Makes a shape by its name, shifted off the grid, with a contact that covers at most a third at
/// the end of the sweep. Throws InvalidInput for another name.
OscillatingBody oscillating_shape(const std::string& shape, const Grid2D& grid);

/// One contact and its motion.
struct OscillationCase {
  OscillatingBody body;
  Material material;
  Oscillation motion;
  double indentation = 0;                          ///< mean indentation, m
  std::optional<FirstLoading> first_loading = {};  ///< empty unless the body is residual
};

/// Returns the indentation at an operating point, m. Throws NotConverged.
double mean_indentation(const OscillatingBody& body, double contact_modulus,
                        const OperatingPoint& point);

/// Loads the contact to the mean operating point with pressures up to the hardness, Pa. After
/// plastic deformation the contact has the residual surface, at the same load.
/// throws  NotConverged, Interrupted, and as load_first()
void load_plastically(OscillationCase& contact, const OperatingPoint& point, double hardness,
                      const Progress& on_progress);

/// The methods by which a cycle is simulated, and their resolution.
struct OscillationRoutes {
  IntervalQuadratureOptions intervals;
  CycleOptions cycle;
  bool frictional = false;  ///< steps again, with the cycle's friction and max_periods
  bool coupled = false;     ///< steps again, with its coupling_constant; needs frictional
  /// Target error of the level quadrature; it determines the number of levels, and of cells where
  /// the shape is known.
  std::optional<double> relative_error;
  std::string shape;         ///< shape to be refined with relative_error; empty: the grid is given
  Index max_points = 1024;  ///< limit for the finest grid
};

/// One simulated cycle by each method.
struct OscillationOutcome {
  OscillationCase run;  ///< the case on the chosen grid
  IntervalQuadratureResult intervals;
  std::optional<AdaptiveQuadratureResult> choice;
  std::optional<CycleResult> cycle;  ///< cycle without slip
  std::optional<CycleResult> frictional, coupled;
  double friction_coefficient = 0;  ///< for both; infinite: no slip
  double dundurs = 0;               ///< β of the coupled cycle

  double work_per_cycle() const;
  /// Error of work_per_cycle(), J: that of the steps, or of the level quadrature where there are no
  /// steps; plus that of the cells where they were refined.
  double error_estimate() const;
  /// Names of the parts of this error: "steps" or "intervals", and "cells".
  std::vector<std::string> error_contains() const;
  /// ½K u² with the largest stiffness of the sweep and u = u_x or v/ω: the reference for a loss
  /// close to 0.
  double elastic_energy() const;
  double uncertain_loss() const;  ///< loss that the solvers' tolerance can produce, J
  /// Returns the loss over a reference; empty where the reference is not larger than its own
  /// uncertainty.
  std::optional<double> over(double reference) const;
  /// Whether F'' is below 0 by more than noise: the interpolated force has the wrong curvature
  /// there, and neither it nor Eqs (12) and (15) apply.
  bool bends_down() const;
  bool converged() const;
  bool interrupted() const;  ///< whether a cycle was interrupted
  /// Whether level quadrature and steps agree within their stated errors.
  bool routes_agree() const;
  /// Relative difference of work and dissipation of one of the cycles; NaN where its loss is no
  /// larger than uncertain_loss().
  double balance(const CycleResult& cycle) const;
};

/// Computes the level quadrature alone. Throws Interrupted.
///
///     OscillationOutcome outcome = oscillation_by_intervals(contact, {});
OscillationOutcome oscillation_by_intervals(OscillationCase run, const OscillationRoutes& routes);

/// Wraps the simulation of a cycle to record it: CycleRecorder::run().
using CycleRunner = std::function<CycleResult(
    const CycleOptions&, const std::function<CycleResult(const CycleOptions&)>& simulate)>;

/// Adds the cycles by steps, each from first contact: without slip, with friction, coupled. If one
/// is interrupted, it is the last one and incomplete.
void simulate_cycles(OscillationOutcome& outcome, const OscillationRoutes& routes,
                     const CycleRunner& run);

/// Returns the loss of the steps, or of the level quadrature where there are no steps, with the
/// paper's equations for it.
OscillationLoss loss_of(const OscillationOutcome& outcome);
/// Returns Eq. (16), or Eq. (12) with F'' = F/l², and the exponential law at this amplitude.
ExponentialLoss exponential_loss(const OscillationOutcome& outcome, double decay_length);
/// Returns the effect of friction on the loss of a cycle.
SlipEffect slip_effect(const OscillationOutcome& outcome);
/// Returns the effect of the coupling of normal and tangential displacements on it.
CouplingEffect coupling_effect(const OscillationOutcome& outcome);
/// Checks the assumptions by the forces of the level quadrature and by the coupled cycle where
/// there is one; only by the contact parameters where fewer than four of its contacts touch.
Assumptions assumptions_of(const OscillationOutcome& outcome, ContactParameters parameters);

}  // namespace salebra
