// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <salebra/base/convolution.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/half_space.hpp>
#include <vector>

#include "contact_residual.hpp"
#include "load_correction.hpp"
#include "tile_kernels.hpp"

namespace salebra::detail {

// Minimises ½p·Gp − p·h over 0 <= p <= bound on one grid: conjugate gradients on the free cells, preconditioned by
// InverseStencil, that are not restarted when the set of free cells changes. Search directions and their images are Real;
// p and g are double, and a result is accepted on a residual computed afresh over all cells.
//
// The pressure is in any unit that makes `compliance` give metres.
template <class Real>
class ActiveSetCg {
 public:
  ActiveSetCg(const Grid2D& grid, double contact_modulus, Boundary boundary, const Heights& heights,
              double rms_height);

  // p: the start on entry, the solution on return; g = Gp − h on return.
  ActiveSetOutcome solve(const ContactTarget& target, const ActiveSetLimits& limits, double* p,
                         double* g);

  // Σq with Gq = 1 on the cells where 0 < p < bound and q = 0 elsewhere: the load that a unit of rigid approach adds.
  // `pressure`, where given, receives q.
  PunchOutcome punch_load(const double* p, double bound, const PunchLimits& limits,
                          Field* pressure = nullptr);

 private:
  // The state of one call of solve().
  struct Run {
    ContactTarget target;
    ActiveSetLimits limits;
    double* p;
    double* g;
    ActiveSetOutcome outcome = {};

    double count = 0;                                       // free cells
    double level = 0;                                       // λ
    bool has_direction = false;                             // t, w hold a direction and its image
    double curvature = 1;                                   // <t, w>
    double threshold = 0;                                   // see worth_a_change in iterate()
    double best = std::numeric_limits<double>::infinity();  // estimate of e_c, for patience
    int since_best = 0;
    std::size_t stalls = 0;
    double at_refresh = 1;  // e_c at the last refresh
    int refreshes = 0;
    double estimate = 0;
    bool finished = false;

    bool load_given() const { return target.load_given(); }
  };

  Index points() const { return grid_.points(); }
  Index tile_points() const { return static_cast<Index>(tiles_.size()) * tile_width; }
  TileArrays<Real> arrays(double bound);

  // Dense passes: body(begin, end) over the slabs of rows.
  template <class Body>
  void for_rows(const Body& body) const {
    parallel::for_slabs(grid_.nx, body, points());
  }
  template <class Sums, class Body>
  std::vector<Sums> over_rows(const Body& body) const {
    return parallel::map_slabs<Sums>(grid_.nx, body, points());
  }

  template <class Body>
  double sum_rows(const Body& body) const {
    return parallel::sum_slabs(grid_.nx, body, points());
  }

  // Passes over the tiles in fixed slabs of their list.
  template <class Body>
  void for_tiles(const Body& body) const {
    parallel::for_slabs(static_cast<Index>(tiles_.size()), body, tile_points());
  }
  template <class Sums, class Body>
  std::vector<Sums> over_tiles(const Body& body) const {
    return parallel::map_slabs<Sums>(static_cast<Index>(tiles_.size()), body, tile_points());
  }

  void reset();
  void correct_load(const ContactTarget& target, double* p) const;
  Convolution2D<double>& exact_compliance();
  void transform(Run& run, const Real* field, Real* result);
  void exact_transform(Run& run);
  ContactResidual dense_gap(Run& run, bool exact);
  void choose_tiles(Run& run, double margin);
  void list_tiles();
  std::byte* pool(std::size_t bytes);
  void collect_pressure(Run& run);
  void begin_set(Run& run, const std::vector<SetSums>& parts);
  void frame_residual();
  bool iterate(Run& run);
  LoadCorrection correction_over_tiles(const Run& run, double pressure) const;
  void change_set(Run& run, bool truncate, double pressure);
  void refresh(Run& run);

  Grid2D grid_;
  Boundary boundary_;
  Heights heights_;
  double rms_height_;
  double cell_compliance_;
  double contact_modulus_;
  Convolution2D<Real> compliance_;
  std::optional<Convolution2D<double>> exact_compliance_;  // made when it is first needed
  std::array<Real, stencil_size> stencil_;
  const TileKernels<Real>& kernels_;

  Index tiles_per_row_, framed_stride_;
  std::vector<Tile> tiles_;
  std::vector<unsigned char> in_use_;  // (nx, tiles_per_row)
  // Not initialised before reset(), which lets the thread that will use a page touch it first.
  LargeArray<Real> t_, w_;  // dense
  LargeArray<Real> r_;      // framed
  // Tile after tile, with zeros where a row ends within a tile. Between two refreshes p and g are up to date only here.
  double *p_ = nullptr, *g_ = nullptr;
  Real *z_ = nullptr, *m_ = nullptr;
  std::vector<unsigned char> quiet_;
  // Holds the tiles' arrays and, while they are not needed, the spectrum of the exact check.
  LargeArray<std::byte> pool_;
  std::size_t pool_size_ = 0;
};

}  // namespace salebra::detail
