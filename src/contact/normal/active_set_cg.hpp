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

// Adds the seconds until its end.
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

// Minimises ½p·Gp − p·h over 0 <= p <= bound on one grid: conjugate gradients on the free cells,
// preconditioned by InverseStencil, that are restarted by a fresh residual only, not when the set
// of free cells changes. Search directions and their images are Real; p and g are double, and a
// result is accepted on a residual computed afresh over all cells. The iteration is a separate
// loop, not tangential/conjugate_gradients.hpp: an iteration reads and writes each tile in three
// fused passes, and its cost is memory traffic.
//
// The pressure is in any unit that makes `compliance` give metres.
template <class Real>
class ActiveSetCg {
 public:
  ActiveSetCg(const Grid2D& grid, double contact_modulus, Boundary boundary, const Heights& heights,
              double rms_height)
      : ActiveSetCg(grid, RowPartition(grid.nx), contact_modulus, boundary, heights, rms_height) {}
  // Works over the processes of a share of the rows: fields, and tiles, are those of the rows of
  // this process, and each call is collective. All decisions follow from sums that have the same
  // bits everywhere, so that no process leaves the others waiting.
  ActiveSetCg(const Grid2D& grid, const RowPartition& rows, double contact_modulus, Boundary boundary,
              const Heights& heights, double rms_height);

  // p: the start on entry, the solution on return; g = Gp − h on return.
  ActiveSetOutcome solve(const ScaledOperatingPoint& target, const ActiveSetLimits& limits,
                         double* p, double* g);

  // Σq with Gq = 1 on the cells where 0 < p < bound and q = 0 elsewhere: the load that a unit of
  // rigid approach adds. `pressure`, where given, receives q.
  PunchOutcome punch_load(const double* p, double bound, const PunchLimits& limits,
                          Field* pressure = nullptr);

  // Makes a set of cells ready for invert(): ix·ny + iy of the rows of this process, in row order.
  // False where the multilevel kernel cannot be used.
  bool hold(const std::vector<Index>& cells);
  // q ≈ G⁻¹u on the cells of hold(), with G~ in place of G: CG until a step gains less than this
  // part of all that was gained.
  void invert(const double* u, double step_ends, double* q, PunchOutcome& outcome);

 private:
  // The state of one call of solve().
  struct Run {
    ScaledOperatingPoint target;
    ActiveSetLimits limits;
    double* p;
    double* g;
    ActiveSetOutcome outcome = {};

    double count = 0;                                       // free cells
    double plane_height = 0;                                       // λ
    bool has_direction = false;                             // t, w hold a direction and its image
    double curvature = 1;                                   // <t, w>
    double threshold = 0;                                   // see worth_a_change in iterate()
    double best = std::numeric_limits<double>::infinity();  // estimate of e_c, for patience
    int since_best = 0;
    std::size_t stalls = 0;
    double at_refresh = 1;  // e_c at the last refresh
    int refreshes = 0;
    int misses = 0;  // refreshes on the multilevel kernel that did not find e_c much smaller
    double estimate = 0;
    bool finished = false;

    bool load_given() const { return target.load_given(); }
    bool interrupted() const { return outcome.termination == Termination::interrupted; }
  };

  Index points() const { return rows_.count() * grid_.ny; }  // of this process
  Index tile_points() const { return static_cast<Index>(tiles_.size()) * tile_width; }
  Index first_tile(Index row) const { return row_begins_[static_cast<std::size_t>(row)]; }
  TileArrays<Real> arrays(double bound);

  // Dense passes: body(begin, end) over slabs of rows, or over blocks where it has a sum.
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

  // Passes over the tiles: over slabs of their list, or over those of a block of rows where there
  // is a sum.
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

  // Gx, or G~x on the multilevel kernel, of a field x that lives on the tiles: spread(begin, end, row) writes
  // the tiles [begin, end) of a row into it, collect(begin, end, row) takes them from the row of Gx
  // and returns its sums. Row by row of this process, those of rows without tiles being Sums{}. On
  // the multilevel kernel x is spread over the residual, which is made anew before it is read again.
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
  // body(row, begin, end) for the rows that have tiles.
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

  // Counts an application of G or G~, and the seconds until its end.
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
  // w = Gt for the next direction t, with <t, w> and Σw over the free cells.
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
  // Iterates from tiles that are chosen until the solution, or what ends it before.
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
  std::optional<Convolution2D<double>> exact_compliance_;  // made when it is first needed
  std::array<Real, stencil_size> stencil_;
  const TileKernels<Real>& kernels_;
  std::optional<MultilevelKernel> multilevel_;  // made when it is first needed
  bool operator_chosen_ = false;                // of this solve
  MultilevelShare multilevel_share_;            // of the limits
  bool spectrum_in_pool_ = false;               // that of compliance_
  bool on_multilevel_ =
      false;  // the iterations apply the multilevel kernel in place of a transform

  Index tiles_per_row_;
  std::vector<Tile> tiles_;            // row by row
  std::vector<Index> row_begins_;      // the first tile of each row, and the number of tiles
  std::vector<unsigned char> in_use_;  // (rows, tiles_per_row)
  std::vector<double> nearest_;  // the same, of the last dense_gap(): least g, −∞ under load
  std::vector<Index> indices_;    // of the cells of hold(), in packed fields
  // See TileArrays. Between two refreshes p and g are up to date only on the tiles.
  HaloField<Real> r_;
  double *p_ = nullptr, *g_ = nullptr;
  Real *z_ = nullptr, *m_ = nullptr, *t_ = nullptr, *w_ = nullptr;
  std::vector<unsigned char> quiet_;
  // Holds the tiles' arrays and, while they are not needed, the spectrum of a dense residual.
  LargeArray<std::byte> pool_;
  std::size_t pool_size_ = 0;
};

}  // namespace salebra::detail
