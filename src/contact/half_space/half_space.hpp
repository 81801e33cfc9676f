// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/material.hpp>

#include "base/convolution.hpp"

namespace salebra {

/// Integrals over a rectangle dx × dy centred at the origin, seen from (x, y); ξ, η, r run from its
/// points to (x, y).
struct CellIntegrals {
  double inverse_distance =
      0;          ///< ∬ 1/r, m: Love (1929), the normal displacement under uniform pressure
  double xx = 0;  ///< ∬ ξ²/r³, m: with yy and xy Cerruti's, for uniform shear
  double yy = 0;  ///< ∬ η²/r³, m
  double xy = 0;  ///< ∬ ξη/r³, m
};
/// Computed from the primitives ξ asinh(η/|ξ|) + η asinh(ξ/|η|), its second term, its first term,
/// and −r at the four corners; beyond 32 cells, where those cancel each other, by Gauss's
/// quadrature. Relative error below 1e-12 for squares at any distance.
CellIntegrals cell_integrals(double x, double y, double dx, double dy);

/// What a convolution of fields on this grid needs: as it is, or padded with zeros.
template <class Real>
typename Convolution2D<Real>::Shape shape_of(const Grid2D& grid, Boundary boundary) {
  if (boundary == Boundary::periodic) return {grid.nx, grid.ny, grid.nx, grid.ny};
  return {grid.nx, grid.ny, fast_transform_size(2 * grid.nx - 1),
          fast_transform_size(2 * grid.ny - 1)};
}

/// Normal displacement of a pressure field, u = Gp:
///     periodic  û(q) = 2 p̂(q)/(E*|q|), û(0) = 0;      free  u = (1/πE*) ∬ p/r, uniform over each cell, zero-padded.
/// contact_modulus   E* > 0, Pa
/// ranks             processes that share the rows of the fields
template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, double contact_modulus, Boundary boundary,
                                      const Communicator& communicator = {});

/// Tangential displacement (u_x, u_y) of shear tractions (τ_x, τ_y), with Cerruti's constants c1,
/// c2 of the material:
///     periodic  û_x = (2π/q) [(c1 + c2 − c2 q_x²/q²) τ̂_x − (c2 q_x q_y/q²) τ̂_y], mean zero; u_y
///               by exchange
///     free      u_x = ∬ [(c1/r + c2 ξ²/r³) τ_x + (c2 ξη/r³) τ_y], zero-padded
/// throws InvalidInput where the material does not know its Cerruti constants
template <class Real>
Convolution2D<Real> tangential_compliance(const Grid2D& grid, const Material& material,
                                          Boundary boundary, const Communicator& communicator = {});

/// Displacement of a cell under a unit pressure on itself alone, m/Pa: a scale, not exact for the
/// periodic kernel.
double cell_compliance(const Grid2D& grid, double contact_modulus);

/// Approximate inverse of normal_compliance that needs no transform: |q|/2 (E* = 1) cut to the 7 ×
/// 7 cells around each point. Masked to a contact set it keeps CG at one transform pair an
/// iteration and saves about 60 % of the iterations.
class InverseStencil {
 public:
  static constexpr int radius = 3;
  static constexpr int width = 2 * radius + 1;

  /// Depends on dx and dy alone. The weights are symmetric and their transform is positive.
  explicit InverseStencil(const Grid2D& grid);
  /// Weight of the neighbour (i, j), −radius <= i, j <= radius; 1/m.
  double weight(int i, int j) const { return weights_[index(i, j)]; }
  /// All of them (i, j), row by row.
  const double* weights() const { return weights_.data(); }
  /// z = M S M r with M the cells where mask > 0: z is zero elsewhere. All fields hold the rows of
  /// this process; neighbours wrap where periodic. Collective.
  void apply(const RowPartition& rows, const Field& mask, const Field& r, Boundary boundary,
             Field& z) const;

 private:
  static std::size_t index(int i, int j) {
    return static_cast<std::size_t>((i + radius) * width + j + radius);
  }
  std::array<double, width * width> weights_;
};

}  // namespace salebra
