// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/adaptive_quadrature.hpp>
#include <salebra/damping/premises.hpp>
#include <salebra/io/plot.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/quantity_group.hpp>
#include <string>
#include <vector>

#include "session.hpp"

/// What `oscillate` and `figure3` share: the paper's bodies, a run by both routes, and how its
/// result is told.
namespace salebra::cli {

/// A surface with its boundary, and the indentation and sweep of a shape that the command line
/// leaves open.
struct Body {
  Surface surface;
  Boundary boundary = Boundary::free;
  double indentation = 0, normal_amplitude = 0;  ///< 0 for a surface from a file
};

/// The four of Fig. 3 first.
const std::vector<std::string>& shape_names();
/// A shape by its name, off the grid, with a contact that fills a third of it or less at the end of
/// the sweep.
Body shape_body(const std::string& shape, const Grid2D& grid);

/// One contact and its motion.
struct OscillationCase {
  Body body;
  Material material;
  Oscillation motion;
  double indentation = 0;                          ///< mean
  std::optional<FirstLoading> first_loading = {};  ///< of which the body is the residual surface
};

struct OscillationRoutes {
  LevelQuadratureOptions levels;
  CycleOptions cycle;
  bool simulate = true;
  /// Levels, and cells where the shape is known, are chosen for this error of the level quadrature.
  std::optional<double> relative_error;
  std::string shape;         ///< to be refined with relative_error; empty: the grid is given
  Index most_points = 1024;  ///< of its finest grid
};

struct OscillationOutcome {
  OscillationCase run;  ///< on the grid that was chosen
  LevelQuadratureResult levels;
  std::optional<AdaptiveQuadratureResult> choice;
  std::optional<CycleResult> cycle;  ///< nothing slips
  std::optional<CycleResult> frictional, coupled;

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
};

/// Levels first, then the steps. Throws Interrupted where the levels were; a stopped cycle comes
/// back as it is.
OscillationOutcome run_routes(OscillationCase run, const OscillationRoutes& routes);

/// The steps alone.
CycleResult simulate(const OscillationCase& run, const CycleOptions& options);

/// The numbers of a cycle; no balance where it loses no more than what the solvers leave.
Json cycle_json(const OscillationOutcome& outcome, const CycleResult& cycle);
/// Axes, columns over time, where the contact is and where energy is lost.
void write_cycle(QuantityGroup& group, const CycleResult& cycle, const Grid2D& grid);

Json to_json(const OscillationOutcome& outcome);
/// Judges by the force at the contact levels; by the facts alone where fewer than four of them
/// touch.
Premises premises_of(const OscillationOutcome& outcome, ContactFacts facts);
/// Groups PREFIXcycle and PREFIXlevels.
void write_outcome(ResultFile& file, const std::string& prefix, const OscillationOutcome& outcome);

/// Fig. 3b: black always in contact, grey during a part of the cycle.
PlotPanel contact_panel(const OscillationOutcome& outcome, const std::string& title);
/// Fig. 3c: W(t) over Eq. (12) for equal frequencies; the energy released so far over Eq. (15) for
/// drag. Over ½Ku² where nothing is lost.
PlotPanel work_panel(const OscillationOutcome& outcome, const std::string& title);

}  // namespace salebra::cli
