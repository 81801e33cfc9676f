// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <vector>

#include "base/convolution.hpp"
#include "contact/half_space/cell_window.hpp"
#include "contact/half_space/half_space.hpp"
#include "contact/half_space/halo_field.hpp"
#include "contact/normal/set_inverse.hpp"

namespace salebra::detail {

/// body(i) for all i < count, in parallel where there are so many operations that it pays.
template <class Body>
void for_each(std::size_t count, std::size_t operations, const Body& body) {
  parallel::for_slabs(
      static_cast<Index>(count),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) body(static_cast<std::size_t>(i));
      },
      static_cast<Index>(operations));
}

double max_of(const double* values, Index count);

/// Σ a_i b_i, with the same bits for every thread count.
double dot(const std::vector<double>& a, const std::vector<double>& b);

/// Cells of a set in row order, as positions in the window and in that of the preconditioner, which
/// has a halo: of the rows of this process.
struct PointList {
  std::vector<Index> cell;        ///< ix·ny + iy in the fields
  std::vector<Index> windowed;    ///< ix·ny + iy in the window
  std::vector<Index> with_halo;   ///< in StencilPreconditioner's field
  std::vector<Index> row_begins;  ///< the first point of each row of the window, and their number
  Index size() const { return static_cast<Index>(cell.size()); }
};

/// Which displacements of which tractions: shear along one axis with the other component of
/// traction absent and the other component of displacement not asked for, or both components.
enum class Traction { along_x, along_y, tangential };

/// Displacements of the surface of a half-space under tractions in cells, on a window: the whole
/// grid where periodic, any rectangle where free. A component of a vector of points is contiguous.
/// Over the processes of a share of the window's rows each has the points of its rows, and calls
/// are collective.
class SurfaceResponse {
 public:
  SurfaceResponse(const Grid2D& grid, const Material& material, Boundary boundary,
                  Traction traction, const CellWindow& window, const RowPartition& rows);

  int components() const { return traction_ == Traction::tangential ? 2 : 1; }
  /// displacements (components × read.size()) of tractions (components × loaded.size()).
  void apply(const PointList& loaded, const double* tractions, const PointList& read,
             double* displacements);
  /// The same in single precision, in half the time, with an error of loose_error of the largest
  /// displacement: for directions of a search and for small changes, not for whole residuals. Made
  /// at the first call.
  static constexpr double loose_error = 1e-6;
  void apply_loosely(const PointList& points, const double* tractions, double* displacements);
  int fft_count() const { return fft_count_; }

 private:
  /// Factors of tractions before a convolution, and of displacements after it.
  struct Units {
    double in = 1, out = 1;
  };
  template <class Real>
  void through(Convolution2D<Real>& compliance, const Units& units, const PointList& loaded,
               const double* tractions, const PointList& read, double* displacements);

  CellWindow window_;
  Traction traction_;
  Convolution2D<double> compliance_;
  double single_unit_;  // m/Pa
  std::function<Convolution2D<float>()> make_single_;
  std::optional<Convolution2D<float>> single_;
  int fft_count_ = 0;
};

/// Approximate inverse of each component of a response: InverseStencil on the points of a contact
/// set alone, which costs nothing where there is no contact.
class StencilPreconditioner {
 public:
  StencilPreconditioner(const Grid2D& grid, Boundary boundary, const CellWindow& window,
                        const RowPartition& rows);

  Index framed_index(Index ix, Index iy) const {
    return (ix - window_.x0) * field_.stride() + iy - window_.y0;
  }
  double diagonal() const { return stencil_.weight(0, 0); }  ///< 1/m, of E* = 1
  /// Takes the points on which it is applied from now on.
  void hold(const PointList& points);
  /// One component.
  void apply(const double* in, double* out);

 private:
  CellWindow window_;
  Boundary boundary_;
  InverseStencil stencil_;
  std::vector<Index> held_;  // where field_ may differ from zero
  HaloField<double> field_;
  RowExchange halo_rows_;
};

/// A response with its preconditioner and the points of a contact set: solves K τ = u on the set.
class ContactSystem {
 public:
  ContactSystem(const Grid2D& grid, const Material& material, Boundary boundary, Traction traction,
                const CellWindow& window)
      : ContactSystem(grid, material, boundary, traction, window, RowPartition(window.nx)) {}
  ContactSystem(const Grid2D& grid, const Material& material, Boundary boundary, Traction traction,
                const CellWindow& window, const RowPartition& rows);

  const CellWindow& window() const { return window_; }
  const RowPartition& rows() const { return rows_; }
  SurfaceResponse& response() { return response_; }
  StencilPreconditioner& preconditioner() { return preconditioner_; }
  /// cells: the whole grid, or of a window that is the whole grid the rows of this process.
  PointList points(const ContactSet& cells) const;
  /// Σ a_i b_i of so many components over the points of all processes, with the same bits for every
  /// number of threads and processes.
  double dot(const PointList& points, const double* a, const double* b, int components) const;

  /// Conjugate gradients from the guess in `tractions`; stops at rms(u − Kτ) < tolerance, in m.
  /// Preconditioned by SetInverse for each component: Cerruti's response has Σ(1−ν_i)/(G_i q) and
  /// Σ1/(G_i q) as eigenvalues, so that the condition number is their ratio, 1/(1 − ν), but for
  /// what the error of SetInverse adds. Where there is no multilevel kernel, by the stencil. On return
  /// residual is in m, and `misfit` (components × points) holds u − Kτ.
  struct Limits {
    double tolerance;
    int max_iterations;
    const Progress& progress;
  };
  StickReport solve(const PointList& points, const std::vector<double>& displacements,
                    const Limits& limits, std::vector<double>& tractions,
                    std::vector<double>& misfit);

 private:
  void subtract_response(const PointList& points, const std::vector<double>& tractions,
                         std::vector<double>& displacements);

  CellWindow window_;
  RowPartition rows_;
  Grid2D window_grid_;
  Boundary boundary_;
  SurfaceResponse response_;
  StencilPreconditioner preconditioner_;
  std::optional<SetInverse> inverse_;  // made by solve(), which contacts with slip do not call
};

}  // namespace salebra::detail
