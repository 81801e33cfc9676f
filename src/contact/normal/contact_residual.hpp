// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/progress.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/operating_point.hpp>

namespace salebra::detail {

// Heights counted from a zero near them, so that a large mean costs no digits of the gap.
struct Heights {
  const double* values = nullptr;
  double zero = 0;
  double operator[](Index k) const { return values[k] - zero; }
};

// The operating point in the units of the solver: a mean pressure, or as indentation the height λ of
// the contact plane (gap = g − λ with g = Gp − h). No cell carries more than the bound.
struct ScaledOperatingPoint : OperatingPoint {
  ScaledOperatingPoint(ControlQuantity held, double at,
                       double largest = std::numeric_limits<double>::infinity())
      : OperatingPoint{held, at}, bound(largest) {}
  double bound;
};

// Part of the transform's points that may be in tiles in use where the multilevel kernel takes the
// place of transforms; 0: it never does. Its work goes with the tiles, that of a transform does
// not. No value: what is faster, as measured (active_set_tiles.cpp).
using MultilevelShare = std::optional<double>;

struct PunchLimits {
  // Stop when the load grew by less than this part of itself in two iterations running. The load is
  // a maximum over q: its error is the square of the error of q.
  double relative_gain = 1e-11;
  int max_iterations = 1000;
  std::function<bool(int iteration)> keep_going = {};
  MultilevelShare multilevel_share = {};
  // On the multilevel kernel a round of CG ends, and the residual is computed afresh, when a step gains less
  // than this part of what the round gained.
  double round_ends = 1e-4;
};

struct PunchOutcome {
  double load = 0;
  double residual = 0;  // rms of 1 − Gq over the punch
  int iterations = 0;
  int fft_count = 0;
  int multilevel_count = 0;
  double fft_seconds = 0, multilevel_seconds = 0;  // for profiles
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

struct ActiveSetLimits {
  double tolerance = 1e-10;  // of e_c
  int max_iterations = 1000;
  bool exact =
      // accept on a residual in double precision; false: a start for a finer level, a few refreshes
      // will do
      true;
  std::function<bool(int iteration, double residual)> keep_going = {};
  // After an iteration where the root says that one is due, p holds the present pressure within its
  // bounds while take_checkpoint() runs, which may change it.
  std::function<bool()> checkpoint_due = {};
  std::function<void()> take_checkpoint = {};
  // When e_c has not halved in this many iterations, CG restarts with another threshold, and at
  // last gives way to gradient_projection().
  int patience = 40;
  MultilevelShare multilevel_share = {};
  // About where the contact plane will be, where it is not prescribed; it saves work and changes no
  // result.
  std::optional<double> expected_plane_height = {};
};

struct ActiveSetOutcome {
  double residual = std::numeric_limits<double>::infinity();  // e_c, over all cells
  double plane_height = 0;
  int iterations = 0;
  int fft_count = 0;
  int exact_fft_count = 0;   // of them in double precision, where the inner loop is not
  int multilevel_count = 0;  // applications of the multilevel kernel in place of a transform
  // Profiles read these: seconds in transforms, of them in exact ones, on the multilevel kernel, and the cells
  // of the tiles summed over the iterations.
  double fft_seconds = 0, exact_fft_seconds = 0, multilevel_seconds = 0;
  double active_cells = 0, resting_cells = 0;
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

// Measures over all cells where the contact plane is, and how far p and g are from complementary.
struct ContactResidual {
  double plane_height = 0;     // mean g of the cells with 0 < p < bound, or the level prescribed
  double residual = 0;  // e_c
};

// e_c = Σp|g − plane|/(Σp·h_rms), with the plane at the least g (load given) or at the level given;
// a gap below the latter adds its depth. Saturated cells may lie below the plane, so they count
// only where they stand above it. p and g are those of the rows of this process, the result that of
// all. Collective.
ContactResidual contact_residual(const Grid2D& grid, const RowPartition& rows,
                                 const ScaledOperatingPoint& target, double rms_height,
                                 const double* p, const double* g);

}  // namespace salebra::detail
