// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/half_space/material.hpp>

#include "base/convolution.hpp"

namespace salebra {

/// Integrals over a rectangle dx × dy centred at the origin, seen from a field point (x, y). (ξ, η)
/// is the vector from a point of the rectangle to (x, y), and r its length.
struct CellIntegrals {
  /// ∬ 1/r, m: Love (1929), for the normal displacement under uniform pressure.
  double inverse_distance = 0;
  double xx = 0;  ///< ∬ ξ²/r³, m: xx, yy and xy are Cerruti's, for uniform shear
  double yy = 0;  ///< ∬ η²/r³, m
  double xy = 0;  ///< ∬ ξη/r³, m
};
/// The antiderivatives of 1/r, ξ²/r³, η²/r³ and ξη/r³, taken at the four corners, are ξ
/// asinh(η/|ξ|) + η asinh(ξ/|η|), the second of these terms, the first of these terms, and −r.
/// Beyond a distance of 32 cells, where the corners cancel each other, Gauss quadrature is used
/// instead. Relative error below 1e-12 for squares at any distance.
CellIntegrals cell_integrals(double x, double y, double dx, double dy);

/// Shape of a convolution of fields on this grid: the grid if periodic, padded with zeros if free.
template <class Real>
typename Convolution2D<Real>::Shape shape_of(const Grid2D& grid, Boundary boundary) {
  if (boundary == Boundary::periodic) return {grid.nx, grid.ny, grid.nx, grid.ny};
  return {grid.nx, grid.ny, fast_transform_size(2 * grid.nx - 1),
          fast_transform_size(2 * grid.ny - 1)};
}

/// Normal displacement u of a half-space under a field of pressure p, the convolution u = Gp:
///     periodic  û(q) = 2 p̂(q)/(E*|q|) for the Fourier modes of wave vector q, û(0) = 0
///     free      u = (1/πE*) ∬ p/r with the distance r, p uniform over each cell, zero-padded
/// contact_modulus  E* > 0, Pa
/// communicator     processes that share the rows of the fields
template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, double contact_modulus, Boundary boundary,
                                      const Communicator& communicator = {});

/// Tangential displacement (u_x, u_y) under shear tractions (τ_x, τ_y), with Cerruti's constants c1
/// and c2 of the material:
///     periodic  û_x = (2π/q) [(c1 + c2 − c2 q_x²/q²) τ̂_x − (c2 q_x q_y/q²) τ̂_y], mean zero,
///               for the Fourier modes of wave vector (q_x, q_y) of length q
///     free      u_x = ∬ [(c1/r + c2 ξ²/r³) τ_x + (c2 ξη/r³) τ_y], zero-padded,
///               with the vector (ξ, η) of length r from the traction to the displacement
/// For u_y exchange x and y. Throws InvalidInput if the Cerruti constants of the material are
/// unknown.
template <class Real>
Convolution2D<Real> tangential_compliance(const Grid2D& grid, const Material& material,
                                          Boundary boundary, const Communicator& communicator = {});

/// As above for any body on a periodic surface, with its responses along (C_l) and across (C_a) the
/// wave vector:
///     û_x = [C_a + (C_l − C_a) q_x²/q²] τ̂_x + (C_l − C_a) (q_x q_y/q²) τ̂_y,  û(0) = C_l(0) τ̂(0)
template <class Real>
Convolution2D<Real> tangential_compliance(const Grid2D& grid, const Body& body,
                                          const Communicator& communicator = {});

/// Displacement of a cell under a unit pressure on this cell alone, m/Pa. It gives the order of
/// magnitude of displacements and is not exact for the periodic kernel.
double cell_compliance(const Grid2D& grid, double contact_modulus);

/// Approximate inverse of normal_compliance() that needs no Fourier transform: the symbol |q|/2 of
/// the inverse (for E* = 1), truncated to the 7 × 7 cells around each point. As a preconditioner on
/// a contact set it leaves CG one forward and one backward transform per iteration and saves about
/// 60 % of the iterations.
class InverseStencil {
 public:
  static constexpr int radius = 3;
  static constexpr int width = 2 * radius + 1;

  /// Stencil of the half-space; depends only on dx and dy. The weights are symmetric, and their Fourier
  /// transform is positive.
  explicit InverseStencil(const Grid2D& grid);
  /// Stencil of another symbol of the inverse, a function of the wave vector that is even in q_x and
  /// in q_y; at q = 0 the symbol is 0.
  InverseStencil(const Grid2D& grid, const std::function<double(double qx, double qy)>& symbol);
  /// Weight of the neighbour (i, j), −radius <= i, j <= radius, 1/m.
  double weight(int i, int j) const { return weights_[index(i, j)]; }
  /// Weights of all (i, j), row by row.
  const double* weights() const { return weights_.data(); }
  /// z = M S r, where S is the stencil and M selects the cells with mask > 0: z is zero elsewhere.
  /// All fields hold the rows of this process; neighbours wrap around if periodic. Collective.
  void apply(const RowPartition& rows, const Field& mask, const Field& r, Boundary boundary,
             Field& z) const;

 private:
  /// inverse: the symbol, even in x and y, at the wave vector (x, y)·2π/(number of samples).
  void set_weights(const Grid2D& grid, const std::function<double(double x, double y)>& inverse);
  static std::size_t index(int i, int j) {
    return static_cast<std::size_t>((i + radius) * width + j + radius);
  }
  std::array<double, width * width> weights_;
};

}  // namespace salebra
