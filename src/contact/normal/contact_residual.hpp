// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/progress.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/operating_point.hpp>

namespace salebra::detail {

// Heights, counted from a reference height near them, so that a large mean does not cost digits of
// the gap.
struct Heights {
  const double* values = nullptr;
  double zero = 0;
  double operator[](Index k) const { return values[k] - zero; }
};

// The prescribed quantity: the mean pressure, or the height λ of the contact plane, where the gap
// is Gp − h − λ with the displacement Gp by the pressures and the heights h.
struct ScaledOperatingPoint : OperatingPoint {
  ScaledOperatingPoint(ControlQuantity held, double at,
                       double largest = std::numeric_limits<double>::infinity())
      : OperatingPoint{held, at}, bound(largest) {}
  double bound;
};

// The multilevel kernel replaces Fourier transforms if the tiles in use cover at most this fraction
// of the transform's points; 0: never. The work of the multilevel kernel grows with the number of
// tiles, that of a transform does not. No value: the faster one, as measured
// (active_set_tiles.cpp).
using MultilevelShare = std::optional<double>;

struct PunchLimits {
  // Stop when the relative growth of the load was below this value in two successive iterations.
  // The load is a maximum over the pressures q of the punch, so its error is the square of the
  // error of q.
  double relative_gain = 1e-11;
  int max_iterations = 1000;
  std::function<bool(int iteration)> keep_going = {};
  MultilevelShare multilevel_share = {};
  // On the multilevel kernel, CG works in rounds: a round ends, and the residual is computed anew,
  // when a step gains less than this fraction of the gain of the round.
  double round_ends = 1e-4;
};

struct PunchOutcome {
  double load = 0;
  double residual = 0;  // rms over the punch of 1 − displacement
  int iterations = 0;
  int fft_count = 0;
  int multilevel_count = 0;
  double fft_seconds = 0, multilevel_seconds = 0;  // reported for performance measurements
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

struct ActiveSetLimits {
  double tolerance = 1e-10;  // upper bound of the complementarity error e_c
  int max_iterations = 1000;
  // true: accept a result only with a residual in double precision. false: the result only starts a
  // finer grid, and few computations of the residual suffice.
  bool exact = true;
  std::function<bool(int iteration, double residual)> keep_going = {};
  // If the root process answers checkpoint_due() with true after an iteration, take_checkpoint()
  // runs. During this call p holds the current pressures within their bounds, and take_checkpoint()
  // may change them.
  std::function<bool()> checkpoint_due = {};
  std::function<void()> take_checkpoint = {};
  // If the complementarity error e_c does not halve within this many iterations, CG restarts with
  // another threshold, and finally gradient_projection() takes over.
  int patience = 40;
  MultilevelShare multilevel_share = {};
  // Estimate of the height of the contact plane if this height is not prescribed. It saves work and
  // changes no result.
  std::optional<double> expected_plane_height = {};
};

struct ActiveSetOutcome {
  double residual = std::numeric_limits<double>::infinity();  // e_c over all cells
  double plane_height = 0;
  int iterations = 0;
  int fft_count = 0;
  int exact_fft_count = 0;   // transforms in double precision, if the inner loop is in single
  int multilevel_count = 0;  // applications of the multilevel kernel in place of a transform
  // For performance measurements: seconds in all transforms, in those in double precision, and on
  // the multilevel kernel, and the number of cells in tiles, summed over the iterations.
  double fft_seconds = 0, exact_fft_seconds = 0, multilevel_seconds = 0;
  double active_cells = 0, resting_cells = 0;
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

// Height of the contact plane and complementarity error of the pressures p and the gap g, over all
// cells.
struct ContactResidual {
  double plane_height = 0;  // mean g of the cells with 0 < p < bound, or the prescribed height
  double residual = 0;      // complementarity error e_c
};

// Complementarity error e_c = Σp|g − plane|/(Σp·h_rms), where g is the displacement by the
// pressures p minus the height. The plane lies at the minimum of g if the load is given, otherwise
// at the given height; then a cell below the plane adds its depth to e_c. Saturated cells may lie
// below the plane, so they count only if they lie above it. p and g hold the rows of this process;
// the result is that of all processes. Collective.
ContactResidual contact_residual(const Grid2D& grid, const RowPartition& rows,
                                 const ScaledOperatingPoint& target, double rms_height,
                                 const double* p, const double* g);

}  // namespace salebra::detail
