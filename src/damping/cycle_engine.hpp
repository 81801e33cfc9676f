// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/cycle_state.hpp>

namespace salebra::detail {

/// What a body shows between two moves.
struct CycleReading {
  ContactSet contact;
  double tangential_force = 0;  ///< along the motion, N
  double normal_force = 0;      ///< N
  double work = 0;              ///< ∫F_x dx, J; this and the next three since any fixed time
  double normal_work = 0;       ///< ∫F dδ, J
  double gap_work = 0;          ///< J
  double released = 0;          ///< J; used where there is no `loss`
  const Field* loss = nullptr;  ///< J in each cell; where the contact may slip
  Index slipping = 0;           ///< cells at their limit
  double tangential_stiffness = std::numeric_limits<double>::quiet_NaN();  ///< N/m
  long iterations = 0;
  long fft_count = 0;
};

/// A body in contact that a cycle drives: what differs between the three simulations. Its
/// constructor brings it to the start of the trajectory, or to the state to resume from.
class CycleBody {
 public:
  virtual ~CycleBody() = default;
  virtual void start_period() {}
  /// Goes to the indentation and the place of a step, from the tangential position `from`; returns
  /// the position reached, m.
  virtual double advance(int step, double from) = 0;
  virtual CycleReading reading() const = 0;
  virtual double stored_energy() const = 0;     ///< J
  virtual Termination termination() const = 0;  ///< of all solves so far
  virtual decltype(CycleState::body) state() const = 0;
};

/// The ranges of a trajectory at its steps.
struct TrajectoryRange {
  double indentation_min = std::numeric_limits<double>::infinity();
  double indentation_max = -indentation_min;
  double tangential_min = indentation_min;
  double tangential_max = -indentation_min;
  double sweep() const { return indentation_max - indentation_min; }
  double tangential() const { return tangential_max - tangential_min; }
};

/// Throws InvalidInput for bad options or a trajectory without functions.
TrajectoryRange checked_range(const Trajectory& trajectory, const CycleOptions& options);

/// The state to resume from, of that kind of body; nullptr where the cycle starts. Throws
/// InvalidInput where the state does not suit the grid and the options.
template <class State>
const State* resumed(const CycleOptions& options, const Grid2D& grid);

/// Periods until one loses what the last one lost, or one in all where the first is known to be
/// steady.
CycleResult run_cycle(CycleBody& body, const Grid2D& grid, const Trajectory& trajectory,
                      const CycleOptions& options, bool first_is_steady = false);

}  // namespace salebra::detail
