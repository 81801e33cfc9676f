// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/half_space/body.hpp>

#include "half_space.hpp"

namespace salebra::detail {

// What a solve presses, in the units of the solve: a half-space with a contact modulus, or any body.
// In a solve, lengths along the surface are in units of `cell` and pressures in units of
// modulus/cell; displacements keep their unit.
struct NormalResponse {
  double contact_modulus = 1;     // of a half-space
  std::optional<Body> body = {};  // none: the half-space
  double cell = 1, modulus = 1;   // m and Pa
  bool uniform = false;           // whether a uniform load displaces as the body's datum has it

  NormalResponse(double contact_modulus_of_half_space)
      : contact_modulus(contact_modulus_of_half_space) {}
  // The response of a body on a grid, in units of its cells and of reference_modulus().
  NormalResponse(const Body& pressed, const Grid2D& physical, bool with_uniform);

  // The compliance of the body at a wave vector in the units of the solve.
  double compliance(double qx, double qy) const {
    return qx != 0 || qy != 0 || uniform
               ? body->compliance(qx / cell, qy / cell).normal * modulus / cell
               : 0;
  }
  bool operator==(const NormalResponse& other) const;
};

// Throws InvalidInput unless the body can be pressed on the grid: periodic, and known at all wave
// numbers of the grid.
void require_pressable(const Body& body, const Grid2D& grid, Boundary boundary);

// Contact modulus E* = 2/(qC) of the half-space that responds as the body does to the waves of two
// cells: a scale, which makes numbers of a solve of the order of 1.
double reference_modulus(const Body& body, const Grid2D& grid);

// As salebra::cell_compliance(), for any response.
double cell_compliance(const Grid2D& grid, const NormalResponse& response);

// Stencils of the inverse responses of a body: normal, for contact_modulus = 1, and tangential,
// Pa/m, where one scalar stands for the responses along and across the wave.
InverseStencil inverse_stencil(const Grid2D& grid, const NormalResponse& response);
InverseStencil tangential_inverse_stencil(const Grid2D& grid, const Body& body);

// The Fourier transform of the kernel of normal_compliance() and its period, which is the grid or,
// for a free contact, the grid padded with empty cells. For a free contact the symbol takes longer
// to compute than a convolution with it, so one convolution in float and one in double share it.
struct NormalSymbol {
  Index period_x = 0, period_y = 0;
  // The symbol at frequency (i, j). For a free contact it covers only the columns that a
  // convolution of this process's rows needs.
  Convolution2D<double>::Symbol value;
  // Computes any columns of a free contact's symbol, collectively. Returns a field
  // (indices.count(), period_x/2 + 1), whose row for each index of this process is the column
  // column_at(index) of the symbol. Empty for a periodic contact, whose `value` covers all columns.
  std::function<Field(const RowPartition& indices,
                      const std::function<Index(Index index)>& column_at)>
      columns;
  Parity parity = Parity::even;  // of the kernel
};
NormalSymbol normal_symbol(const Grid2D& grid, const NormalResponse& response, Boundary boundary,
                           const RowPartition& rows);

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, const NormalSymbol& symbol,
                                      const RowPartition& rows);

}  // namespace salebra::detail
