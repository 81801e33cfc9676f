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

/// Calls body(i) for all i < count, in parallel if the number of operations makes it worthwhile.
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

/// Scalar product Σ a_i b_i, with the same bits for every thread count.
double dot(const std::vector<double>& a, const std::vector<double>& b);

/// Cells of a set in row order, for the rows of this process, with the indices of each cell in the
/// fields of the grid, in the window, and in the preconditioner's field with a halo.
struct PointList {
  std::vector<Index> cell;        ///< ix·ny + iy in the fields
  std::vector<Index> windowed;    ///< ix·ny + iy in the window
  std::vector<Index> with_halo;   ///< index in StencilPreconditioner's field
  std::vector<Index> row_begins;  ///< first point of each row of the window; last: number of points
  Index size() const { return static_cast<Index>(cell.size()); }
};

/// Tractions and displacements of a response: shear along one axis only, where the other traction
/// is zero and the other displacement is not computed, or both tangential components.
enum class Traction { along_x, along_y, tangential };

/// Displacements of the surface of a half-space under tractions on cells of a window: the whole
/// grid if periodic, any rectangle if free. Each component of a vector of points is contiguous in
/// memory. With several processes, each has the points of its rows of the window, and calls are
/// collective.
class SurfaceResponse {
 public:
  SurfaceResponse(const Grid2D& grid, const Material& material, Boundary boundary,
                  Traction traction, const CellWindow& window, const RowPartition& rows);

  /// Any body under a periodic surface, in double precision only.
  SurfaceResponse(const Grid2D& grid, const Body& body, Traction traction,
                  const RowPartition& rows);

  int components() const { return traction_ == Traction::tangential ? 2 : 1; }
  /// Computes the displacements (components × read.size()) under the tractions (components ×
  /// loaded.size()).
  void apply(const PointList& loaded, const double* tractions, const PointList& read,
             double* displacements);
  /// apply() in single precision, in half the time, with an error of loose_error times the largest
  /// displacement: for search directions and small changes, not for whole residuals. The
  /// single-precision kernel is made at the first call.
  static constexpr double loose_error = 1e-6;
  void apply_loosely(const PointList& points, const double* tractions, double* displacements);
  int fft_count() const { return fft_count_; }

 private:
  /// Factors of the scaled units: `in` multiplies tractions before a convolution, `out`
  /// displacements after it.
  struct Units {
    double in = 1, out = 1;
  };
  template <class Real>
  void through(Convolution2D<Real>& compliance, const Units& units, const PointList& loaded,
               const double* tractions, const PointList& read, double* displacements);

  CellWindow window_;
  Traction traction_;
  Convolution2D<double> compliance_;
  double single_unit_ = 1;                             // m/Pa
  std::function<Convolution2D<float>()> make_single_;  // empty: there is none
  std::optional<Convolution2D<float>> single_;
  int fft_count_ = 0;
};

/// Approximate inverse of each component of a response: InverseStencil, applied only to the points
/// of a contact set, so that cells out of contact cost nothing.
class StencilPreconditioner {
 public:
  StencilPreconditioner(const InverseStencil& stencil, Boundary boundary, const CellWindow& window,
                        const RowPartition& rows);

  Index framed_index(Index ix, Index iy) const {
    return (ix - window_.x0) * field_.stride() + iy - window_.y0;
  }
  double diagonal() const { return stencil_.weight(0, 0); }  ///< 1/m, for E* = 1
  /// Sets the points to which apply() applies the inverse from now on.
  void hold(const PointList& points);
  /// Applies the inverse to one component of a vector on the points of hold().
  void apply(const double* in, double* out);

 private:
  CellWindow window_;
  Boundary boundary_;
  InverseStencil stencil_;
  std::vector<Index> held_;  // indices at which field_ may be nonzero
  HaloField<double> field_;
  RowExchange halo_rows_;
};

/// A response with the tangential compliance K, its preconditioner and its window: finds the
/// tractions τ with K τ = u for displacements u on a contact set.
class ContactSystem {
 public:
  ContactSystem(const Grid2D& grid, const Material& material, Boundary boundary, Traction traction,
                const CellWindow& window)
      : ContactSystem(grid, material, boundary, traction, window, RowPartition(window.nx)) {}
  ContactSystem(const Grid2D& grid, const Material& material, Boundary boundary, Traction traction,
                const CellWindow& window, const RowPartition& rows);

  /// Any body under a periodic surface, preconditioned by the stencil of its tangential response.
  ContactSystem(const Grid2D& grid, const Body& body, Traction traction, const RowPartition& rows);

  const CellWindow& window() const { return window_; }
  const RowPartition& rows() const { return rows_; }
  SurfaceResponse& response() { return response_; }
  StencilPreconditioner& preconditioner() { return preconditioner_; }
  /// cells: a set of the whole grid or, if the window is the whole grid, of this process's rows.
  PointList points(const ContactSet& cells) const;
  /// Scalar product Σ a_i b_i over `components` components of the points of all processes, with the
  /// same bits for every number of threads and processes.
  double dot(const PointList& points, const double* a, const double* b, int components) const;

  /// Conjugate gradients on K τ = u for the displacements u, from the guess in `tractions`; stops
  /// at rms(u − Kτ) < tolerance, in m. SetInverse preconditions each component: at wave number q
  /// Cerruti's response has the eigenvalues Σ(1−ν_i)/(G_i q) and Σ1/(G_i q), summed over the two
  /// bodies i with shear modulus G_i, so the condition number is their ratio, 1/(1 − ν) for equal
  /// bodies, increased by the error of SetInverse. Without a multilevel kernel, the stencil
  /// preconditions. On return the residual is in m, and `misfit` (components × points) holds u −
  /// Kτ.
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
  bool multilevel_ = true;  // whether the multilevel kernel may precondition
  SurfaceResponse response_;
  StencilPreconditioner preconditioner_;
  std::optional<SetInverse> inverse_;  // made by solve(); contacts with slip do not use it
};

}  // namespace salebra::detail
