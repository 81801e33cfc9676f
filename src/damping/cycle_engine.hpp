// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/cycle_state.hpp>

namespace salebra::detail {

/// What a cycle records of a body after each step.
struct CycleReading {
  ContactSet contact;
  double tangential_force = 0;  ///< along the motion, N
  double normal_force = 0;      ///< N
  /// ∫F_x dx, J. This work, the next two and the loss count from a fixed time of any choice.
  double work = 0;
  double normal_work = 0;  ///< ∫F dδ, J, from that fixed time
  double gap_work = 0;     ///< part of normal_work from gaps that close and open in a step, J
  /// Energy lost by springs that separated, J; used if `loss` is not set.
  double released = 0;
  const Field* loss = nullptr;  ///< energy lost in each cell, J; set if the contact may slip
  Index slipping = 0;           ///< number of cells at their friction limit
  double tangential_stiffness = std::numeric_limits<double>::quiet_NaN();  ///< N/m
  long iterations = 0;
  long fft_count = 0;
};

/// A body in contact that a cycle drives. There is one class for each kind of simulation: stuck,
/// with friction, and with coupling. The constructor brings the body to the start of the
/// trajectory, or to the state from which the cycle resumes.
class CycleBody {
 public:
  virtual ~CycleBody() = default;
  virtual void start_period() {}
  /// Moves the body to the indentation and the displacement of a step. `from` is its tangential
  /// position before the step, m. Returns its position after the step, m.
  virtual double advance(int step, double from) = 0;
  virtual CycleReading reading() const = 0;
  virtual double stored_energy() const = 0;     ///< J
  virtual Termination termination() const = 0;  ///< of all solves so far
  virtual decltype(CycleState::body) state() const = 0;
};

/// The minimum and maximum of a trajectory over the steps of a period.
struct TrajectoryRange {
  double indentation_min = std::numeric_limits<double>::infinity();
  double indentation_max = -indentation_min;
  double tangential_min = indentation_min;
  double tangential_max = -indentation_min;
  double sweep() const { return indentation_max - indentation_min; }
  double tangential() const { return tangential_max - tangential_min; }
};

/// Checks the options and returns the range of the trajectory. Throws InvalidInput for bad options
/// or a trajectory with an empty function.
TrajectoryRange checked_range(const Trajectory& trajectory, const CycleOptions& options);

/// The state from which this kind of body resumes, or nullptr if the cycle starts anew. Throws
/// InvalidInput if the state does not match the kind of body, the grid or the options.
template <class State>
const State* resumed(const CycleOptions& options, const Grid2D& grid);

/// Simulates periods until two in a row have the same loss, or a single period if `first_is_steady`
/// says that the first one already repeats.
CycleResult run_cycle(CycleBody& body, const Grid2D& grid, const Trajectory& trajectory,
                      const CycleOptions& options, bool first_is_steady = false);

}  // namespace salebra::detail
