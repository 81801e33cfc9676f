// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <salebra/base/fft.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/material.hpp>
#include <salebra/contact/stick.hpp>
#include <vector>

namespace salebra::detail {

/// A rectangle of cells of a grid.
struct CellWindow {
  Index x0 = 0, y0 = 0, nx = 0, ny = 0;

  bool contains(const CellWindow& other) const;
};

/// The smallest window that holds every cell of the set; empty for an empty set.
CellWindow bounding_window(const ContactSet& cells);

/// Cells of a set in row order, as positions in the padded fields and in the preconditioner's field.
struct PointList {
  std::vector<Index> cell;    ///< ix·ny + iy in the grid
  std::vector<Index> padded;  ///< in SurfaceResponse's fields
  std::vector<Index> haloed;  ///< in StencilPreconditioner's field
  Index size() const { return static_cast<Index>(cell.size()); }
};

enum class Traction { normal, along_x, along_y, tangential };

/// Displacements of the surface of a half-space under tractions in cells, by FFT convolution on a window: the whole grid where
/// periodic, any rectangle, zero-padded to twice its size, where free. A component of a vector of points is contiguous.
class SurfaceResponse {
 public:
  SurfaceResponse(const Grid2D& grid, const Material& material, Boundary boundary, Traction traction,
                  const CellWindow& window);

  int components() const { return components_; }
  Index padded_index(Index ix, Index iy) const {
    return (ix - window_.x0) * fft_.ny() + iy - window_.y0;
  }
  /// displacements (components × read.size()) of tractions (components × loaded.size()).
  void apply(const PointList& loaded, const double* tractions, const PointList& read,
             double* displacements);
  int fft_count() const { return fft_count_; }

 private:
  void make_periodic(const Grid2D& grid, const Material& material, Traction traction);
  void make_free(const Grid2D& grid, const Material& material, Traction traction);
  void transform_kernel(const std::vector<double>& kernel, std::vector<double>& symbol);

  CellWindow window_;
  RealFft2D<double> fft_;
  int components_;
  int fft_count_ = 0;
  std::vector<double> symbol_xx_, symbol_yy_, symbol_xy_;  ///< with 1/(nx ny); one component: xx only
  std::vector<double> loads_, values_;
  std::vector<std::complex<double>> modes_x_, modes_y_;
};

/// Approximate inverse of every component of a response: |q|, cut to 7 × 7 cells of real space and to the contact set.
class StencilPreconditioner {
 public:
  StencilPreconditioner(const Grid2D& grid, Boundary boundary, const CellWindow& window);

  Index haloed_index(Index ix, Index iy) const {
    return (ix - window_.x0 + reach) * row_length() + iy - window_.y0 + reach;
  }
  /// One component; out may not be in.
  void apply(const PointList& points, const double* in, double* out);

 private:
  static constexpr Index reach = 3;
  static constexpr Index width = 2 * reach + 1;
  Index row_length() const { return window_.ny + 2 * reach; }
  void fill_ghosts();

  CellWindow window_;
  bool periodic_;
  double weights_[width * width];
  std::vector<double> field_;
};

/// A response with its preconditioner and the points of a contact set: solves K τ = u on the set.
class ContactSystem {
 public:
  ContactSystem(const Grid2D& grid, const Material& material, Boundary boundary, Traction traction,
                const CellWindow& window);

  const CellWindow& window() const { return window_; }
  SurfaceResponse& response() { return response_; }
  PointList points(const ContactSet& cells) const;

  /// Preconditioned conjugate gradients from the guess in `tractions`; stops at rms(u − Kτ) < tolerance, in m.
  /// On return residual is in m, and `misfit` (components × points) holds u − Kτ.
  StickReport solve(const PointList& points, const std::vector<double>& displacements,
                    double tolerance, int max_iterations, const Progress& progress,
                    std::vector<double>& tractions, std::vector<double>& misfit);

 private:
  CellWindow window_;
  SurfaceResponse response_;
  StencilPreconditioner preconditioner_;
};

}  // namespace salebra::detail
