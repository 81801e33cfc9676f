// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/adaptive_quadrature.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/cycle.hpp>
#include <string>
#include <vector>

/// The cycle of a contact computed in three dimensions by several methods: interval quadrature,
/// time steps without slip, time steps with finite friction, and time steps with coupling of
/// pressure and traction.
namespace salebra {

/// A surface with its boundary condition and, for a shape given by a formula, a default indentation
/// and normal amplitude, m.
struct OscillatingBody {
  Surface surface;
  Boundary boundary = Boundary::free;
  double indentation = 0, normal_amplitude = 0;  ///< m; 0 for a surface from a file
};

/// Names of the shapes that oscillating_shape() makes; the four shapes of Fig. 3 of the paper come
/// first.
const std::vector<std::string>& oscillating_shapes();
/// Makes the shape with a given name. Its axis lies off the grid points, and at the deepest
/// indentation of the default motion the contact spans at most a third of the grid. Throws
/// InvalidInput for an unknown name.
OscillatingBody oscillating_shape(const std::string& shape, const Grid2D& grid);

/// One contact, with its material, motion and mean indentation.
struct OscillationCase {
  OscillatingBody body;
  Body material = Material{};  ///< a Material, or any Body under a periodic surface
  Oscillation motion;
  double indentation = 0;                          ///< mean indentation, m
  std::optional<FirstLoading> first_loading = {};  ///< empty without plastic first loading
};

/// Returns the indentation of a body at an operating point, m. Throws NotConverged.
double mean_indentation(const OscillatingBody& body, const Body& material,
                        const OperatingPoint& point);
/// Returns the mean indentation of an oscillation about an operating point, m: that at rest, or that
/// at which the mean force of the cycle is the force at rest (hold_of()). The latter comes from a law
/// through contacts from 1 % of this force to the largest force of the cycle.
/// throws  InvalidInput for a cycle beyond full contact; NotConverged, Interrupted
double mean_indentation(const OscillatingBody& body, const Body& material,
                        const OperatingPoint& point, const Oscillation& motion, Hold hold,
                        const Progress& on_progress = {});

/// Loads the contact plastically to `point`, with pressures limited to the hardness, Pa. If the
/// surface yields, `contact` then has the residual surface, at the same load.
/// throws  NotConverged, Interrupted, and InvalidInput wherever load_first() does
void load_plastically(OscillationCase& contact, const OperatingPoint& point, double hardness,
                      const Progress& on_progress);

/// The methods by which a cycle is computed, and the options of each method.
struct OscillationRoutes {
  IntervalQuadratureOptions intervals;
  CycleOptions cycle;
  bool frictional = false;  ///< true: also computes the cycle with friction, as in `cycle`
  bool coupled = false;     ///< true: also with coupling, as in `cycle`; needs frictional
  /// Target relative error of the interval quadrature, which determines the number of intervals
  /// and, if `shape` is given, the number of cells. Empty: intervals and grid are those given.
  std::optional<double> relative_error;
  std::string shape;        ///< shape to be refined with relative_error; empty: the grid is given
  Index max_points = 1024;  ///< limit for the finest grid
};

/// Results for one cycle by each method.
struct OscillationOutcome {
  OscillationCase run;  ///< the case on the chosen grid
  IntervalQuadratureResult intervals;
  std::optional<AdaptiveQuadratureResult> choice;
  std::optional<CycleResult> cycle;  ///< cycle without slip
  std::optional<CycleResult> frictional, coupled;
  double friction_coefficient = 0;  ///< μ of frictional and coupled; infinite: no slip
  double dundurs = 0;               ///< β of the coupled cycle

  /// Whether a cycle with finite friction was simulated, so that the loss of the motion as described
  /// is that of `frictional`.
  bool slips() const;
  double work_per_cycle() const;
  /// Error of work_per_cycle(), J: the error due to the time steps or, without time steps, that of
  /// the interval quadrature; plus the error due to the cell size if the cells were refined.
  double error_estimate() const;
  /// Names of the parts of error_estimate(): "steps" or "intervals", and "cells".
  std::vector<std::string> error_contains() const;
  /// Elastic energy ½K u², J, with the largest tangential stiffness in the cycle and u = u_x or
  /// v/ω. It shows whether a loss is close to 0.
  double elastic_energy() const;
  double uncertain_loss() const;  ///< loss that the solvers' tolerance can produce, J
  /// Returns work_per_cycle() divided by a reference loss, J; empty if the reference is not larger
  /// than its own error.
  std::optional<double> over(double reference) const;
  /// Whether F'' at the mean indentation is below 0 by more than noise. The curvature of the
  /// interpolated force is then wrong, so that Eqs (12) and (15) do not apply.
  bool bends_down() const;
  bool converged() const;
  bool interrupted() const;  ///< whether a cycle was interrupted
  /// Whether the losses by interval quadrature and by time steps agree within their errors.
  bool routes_agree() const;
  /// Relative difference between work_per_cycle and dissipated of one of the simulated cycles; NaN
  /// if its loss is no larger than uncertain_loss().
  double balance(const CycleResult& cycle) const;
};

/// Computes the interval quadrature alone. Throws Interrupted.
///
///     OscillationOutcome outcome = oscillation_by_intervals(contact, {});
OscillationOutcome oscillation_by_intervals(OscillationCase run, const OscillationRoutes& routes);

/// Function that runs the simulation `simulate` of a cycle and may record it, as
/// CycleRecorder::run() does.
using CycleRunner = std::function<CycleResult(
    const CycleOptions&, const std::function<CycleResult(const CycleOptions&)>& simulate)>;

/// Adds the cycles computed in time steps to `outcome`: without slip, with friction, and with
/// coupling, as far as requested. Each cycle starts from first contact. If a cycle is interrupted,
/// it is incomplete, and later cycles are left out.
void simulate_cycles(OscillationOutcome& outcome, const OscillationRoutes& routes,
                     const CycleRunner& run);

/// Returns the loss computed in time steps or, without time steps, by interval quadrature, and its
/// ratio to the paper's equations.
OscillationLoss loss_of(const OscillationOutcome& outcome);
/// Returns the loss by Eq. (16) (for a Drag) or by Eq. (12) with F'' = F/l² (for an
/// EqualFrequency), and the loss of the exponential law at the given amplitude.
ExponentialLoss exponential_loss(const OscillationOutcome& outcome, double decay_length);
/// Returns the effect of friction on the loss of a cycle.
SlipEffect slip_effect(const OscillationOutcome& outcome);
/// Returns the effect of the coupling of normal and tangential displacements on the loss of a
/// cycle.
CouplingEffect coupling_effect(const OscillationOutcome& outcome);
/// Checks the assumptions with the forces of the interval quadrature and, if there is one, the
/// coupled cycle. If fewer than four contacts of the interval quadrature touch, only the contact
/// parameters are used.
Assumptions assumptions_of(const OscillationOutcome& outcome, ContactParameters parameters);

}  // namespace salebra
