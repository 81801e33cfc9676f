// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "base/convolution.hpp"
#include "base/memory.hpp"
#include "contact/half_space/half_space.hpp"
#include "contact/half_space/halo_field.hpp"
#include "contact/half_space/multilevel_kernel.hpp"
#include "contact/half_space/normal_operators.hpp"
#include "contact_residual.hpp"
#include "load_correction.hpp"
#include "tile_kernels.hpp"

namespace salebra::detail {

// Adds the seconds between its construction and destruction to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

// Minimises ½p·Gp − p·h over the pressures 0 <= p <= bound on one grid, with the normal compliance
// G and the heights h, by conjugate gradients on the free cells (0 < p < bound), preconditioned by
// InverseStencil. CG restarts only at a fresh residual, not when the set of free cells changes.
// Search directions and the displacements that they cause are Real; p and g = Gp − h are double,
// and a result is accepted only on a residual computed anew over all cells. The loop is not the one
// of tangential/conjugate_gradients.hpp, because the cost of an iteration is memory traffic: this
// loop reads and writes each tile in three fused passes.
//
// The pressure is in any unit in which G gives metres.
template <class Real>
class ActiveSetCg {
 public:
  ActiveSetCg(const Grid2D& grid, const NormalResponse& response, Boundary boundary,
              const Heights& heights, double rms_height)
      : ActiveSetCg(grid, RowPartition(grid.nx), response, boundary, heights, rms_height) {}
  // If several processes share the rows of the grid, fields and tiles are those of this process's
  // rows, and each call is collective. All decisions follow from sums that have the same bits in
  // every process, so no process waits for another in vain.
  ActiveSetCg(const Grid2D& grid, const RowPartition& rows, const NormalResponse& response,
              Boundary boundary, const Heights& heights, double rms_height);

  // p: the pressures to start from on entry, the solution on return. g: on return Gp − h, the
  // displacement by p minus the height.
  ActiveSetOutcome solve(const ScaledOperatingPoint& target, const ActiveSetLimits& limits,
                         double* p, double* g);

  // Computes the load Σq that a unit of rigid approach adds: the pressures q have the displacement
  // Gq = 1 on the cells with 0 < p < bound, and q = 0 on all other cells. `pressure`, if given,
  // receives q.
  PunchOutcome punch_load(const double* p, double bound, const PunchLimits& limits,
                          Field* pressure = nullptr);

  // Sets the cells for invert(), as the numbers ix·ny + iy in the rows of this process, in row
  // order. Returns false if the multilevel kernel cannot be used.
  bool hold(const std::vector<Index>& cells);
  // Computes the pressures q ≈ G⁻¹u on the cells of hold(), with the multilevel kernel in place of
  // the normal compliance G. CG ends when a step gains less than the fraction step_ends of the
  // total gain.
  void invert(const double* u, double step_ends, double* q, PunchOutcome& outcome);

 private:
  // The state of one call of solve().
  struct Run {
    ScaledOperatingPoint target;
    ActiveSetLimits limits;
    double* p;
    double* g;
    ActiveSetOutcome outcome = {};

    double count = 0;                                       // number of free cells
    double plane_height = 0;                                // λ
    bool has_direction = false;                             // t and w = Gt hold a direction
    double curvature = 1;                                   // <t, w>
    double threshold = 0;                                   // see worth_a_change in iterate()
    double best = std::numeric_limits<double>::infinity();  // lowest estimate of e_c
    int since_best = 0;
    std::size_t stalls = 0;
    double at_refresh = 1;  // complementarity error e_c at the last refresh
    int refreshes = 0;
    int misses = 0;  // successive refreshes on the multilevel kernel that did not halve e_c
    double estimate = 0;
    bool finished = false;

    bool load_given() const { return target.load_given(); }
    bool interrupted() const { return outcome.termination == Termination::interrupted; }
  };

  Index points() const { return rows_.count() * grid_.ny; }  // number of cells in this process
  Index tile_points() const { return static_cast<Index>(tiles_.size()) * tile_width; }
  Index first_tile(Index row) const { return row_begins_[static_cast<std::size_t>(row)]; }
  TileArrays<Real> arrays(double bound);

  // A pass over the grid: calls body(begin, end) for slabs of rows, or for blocks of rows if body
  // returns sums.
  template <class Body>
  void for_rows(const Body& body) const {
    parallel::for_slabs(rows_.count(), body, points());
  }
  template <class Sums, class Body>
  std::vector<Sums> over_rows(const Body& body) const {
    return parallel::map_blocks<Sums>(rows_, body, points());
  }

  template <class Body>
  double sum_rows(const Body& body) const {
    return parallel::sum_blocks(rows_, body, points());
  }

  // A pass over the tiles: calls body(begin, end) for slabs of the list of tiles, or for the tiles
  // of a block of rows if body returns sums.
  template <class Body>
  void for_tiles(const Body& body) const {
    parallel::for_slabs(static_cast<Index>(tiles_.size()), body, tile_points());
  }
  template <class Sums, class Body>
  std::vector<Sums> over_tiles(const Body& body) const {
    return parallel::map_blocks<Sums>(
        rows_, [&](Index begin, Index end) { return body(first_tile(begin), first_tile(end)); },
        tile_points());
  }

  // Computes the displacement Gx of a field x on the tiles, exactly or by the multilevel kernel.
  // spread(begin, end, row) writes the tiles [begin, end) of a row of x into `row`; collect(begin,
  // end, row) reads these tiles from the row of Gx and returns its sums. Returns the sums of each
  // row of this process, Sums{} for rows without tiles. On the multilevel kernel x overwrites the
  // residual, which is computed anew before it is read again.
  template <class Sums, class Spread, class Collect>
  std::vector<Sums> displace(const Spread& spread, const Collect& collect) {
    std::vector<Sums> sums(static_cast<std::size_t>(rows_.count()));
    if constexpr (std::is_same_v<Real, float>) {
      if (on_multilevel_) {
        for_rows_in_use(
            [&](Index row, Index begin, Index end) { spread(begin, end, r_.row(row)); });
        multilevel_->descend(r_);
        for_rows_in_use([&](Index row, Index begin, Index end) {
          thread_local std::vector<float> buffer;
          buffer.resize(static_cast<std::size_t>(grid_.ny));
          multilevel_->collect(tiles_.data(), begin, end, buffer.data());
          sums[static_cast<std::size_t>(row)] = collect(begin, end, buffer.data());
        });
        return sums;
      }
    }
    if (spectrum_in_pool_) {
      compliance_.keep_spectrum_in(nullptr);
      spectrum_in_pool_ = false;
    }
    compliance_.apply(
        [&](int, Index row, Real* buffer) -> const Real* {
          const Index begin = first_tile(row), end = first_tile(row + 1);
          if (begin == end) return nullptr;
          std::fill_n(buffer, grid_.ny, Real(0));
          spread(begin, end, buffer);
          return buffer;
        },
        [&](int, Index row, const Real* values) {
          const Index begin = first_tile(row), end = first_tile(row + 1);
          if (begin < end) sums[static_cast<std::size_t>(row)] = collect(begin, end, values);
        });
    return sums;
  }
  // Calls body(row, begin, end) for the rows that have tiles; [begin, end) are the tiles of the
  // row.
  template <class Body>
  void for_rows_in_use(const Body& body) const {
    parallel::for_slabs(
        rows_.count(),
        [&](Index first, Index last) {
          for (Index row = first; row < last; ++row) {
            const Index begin = first_tile(row), end = first_tile(row + 1);
            if (begin < end) body(row, begin, end);
          }
        },
        tile_points());
  }

  // While it exists, counts an application of the normal compliance, exact or multilevel, and its
  // seconds.
  class Applying {
   public:
    template <class Outcome>
    Applying(const ActiveSetCg& solver, Outcome& outcome)
        : stopwatch_(solver.on_multilevel_ ? outcome.multilevel_seconds : outcome.fft_seconds) {
      ++(solver.on_multilevel_ ? outcome.multilevel_count : outcome.fft_count);
    }

   private:
    Stopwatch stopwatch_;
  };
  // Computes the next search direction t and its displacement w = Gt; returns the scalar product
  // <t, w> and Σw over the free cells.
  CurvatureSums take_direction(double z_mean, double beta, double t_mean);

  void reset();
  void correct_load(const ScaledOperatingPoint& target, double* p) const;
  Convolution2D<double>& exact_compliance();
  Convolution2D<Real>& dense_compliance();
  ContactResidual dense_gap(Run& run, bool exact, bool whole);
  template <class Number>
  const Number* pressure_of(const Run& run, Index row, Number* buffer) const;
  void choose_tiles(Run& run, double margin);
  void list_tiles();
  double points_of_transform() const {
    return static_cast<double>(operators_->symbol().period_x * operators_->symbol().period_y);
  }
  double worthwhile_share(bool punch) const;
  void choose_operator();
  void hold_punch_set(const double* p, double bound);
  void begin_punch();
  Termination punch_rounds(const PunchLimits& limits, PunchOutcome& outcome);
  void measure_punch(PunchOutcome& outcome, Field* pressure);
  double punch_step(double& curvature, PunchOutcome& outcome);
  void renew_punch_residual();
  std::byte* pool(std::size_t bytes);
  void collect_pressure(Run& run);
  void unpack_pressure(const Run& run, double scale) const;
  void begin_set(Run& run, const std::vector<SetSums>& parts);
  void fill_halo_of_residual();
  double estimate_of(const StepSums& step, const Run& run, bool with_clipped) const;
  bool iterate(Run& run);
  // Iterates on the chosen tiles until the solve has converged or a limit ends it.
  void go_on(Run& run);
  LoadCorrection correction_over_tiles(const Run& run, double pressure) const;
  void change_set(Run& run, bool truncate, double pressure);
  void refresh(Run& run, bool last);

  Grid2D grid_;
  RowPartition rows_;
  Boundary boundary_;
  RowExchange halo_rows_;
  Heights heights_;
  double rms_height_;
  double cell_compliance_;
  std::shared_ptr<NormalOperators> operators_;
  Convolution2D<Real> compliance_;
  std::optional<Convolution2D<double>> exact_compliance_;  // made at first use
  std::array<Real, stencil_size> stencil_;
  const TileKernels<Real>& kernels_;
  std::optional<MultilevelKernel> multilevel_;  // made at first use
  bool operator_chosen_ = false;                // whether choose_operator() ran in this solve
  double multilevel_share_ = 0;                 // see MultilevelShare
  bool spectrum_in_pool_ = false;  // whether compliance_ keeps its spectrum in the pool
  // Whether iterations apply the multilevel kernel instead of an exact Fourier transform.
  bool on_multilevel_ = false;

  Index tiles_per_row_;
  std::vector<Tile> tiles_;            // row by row
  std::vector<Index> row_begins_;      // the first tile of each row, and the number of tiles
  std::vector<unsigned char> in_use_;  // (rows, tiles_per_row)
  // Minimum of g = Gp − h in each tile (rows, tiles_per_row), from the last dense_gap(); −∞ if a
  // cell of the tile carries load.
  std::vector<double> nearest_;
  std::vector<Index> indices_;  // of the cells of hold(), in packed fields
  // The fields of TileArrays. Between two refreshes p and g are up to date only on the tiles.
  HaloField<Real> r_;
  double *p_ = nullptr, *g_ = nullptr;
  Real *z_ = nullptr, *m_ = nullptr, *t_ = nullptr, *w_ = nullptr;
  std::vector<unsigned char> quiet_;
  // Memory of the tiles' arrays and, while these arrays are not needed, of the spectrum for a
  // residual over all cells.
  LargeArray<std::byte> pool_;
  std::size_t pool_size_ = 0;
};

}  // namespace salebra::detail
