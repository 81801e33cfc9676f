// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <vector>

#include "surface_response.hpp"

namespace salebra::detail {

void require_tangential(const Material& material);
/// The same for any body; others than half-spaces must be periodic.
void require_tangential(const Body& body, const Grid2D& grid, Boundary boundary);

std::vector<double> values_at(const Field& field, const PointList& points);

/// State shared by the tangential solvers with and without slip: the kernels, kept between calls,
/// and the conversion between fields and vectors of points.
class TangentialWorkspace {
 public:
  /// Throws InvalidInput for a bad grid or option, or a body without tangential response.
  TangentialWorkspace(const Grid2D& grid, const Body& body, const StickOptions& options);

  const Grid2D& grid() const { return grid_; }
  const StickOptions& options() const { return options_; }
  /// Factor that makes the preconditioner's stencil the inverse of the compliance: of half-spaces,
  /// whose stencil is for E = 1 Pa, the modulus E whose 2/(Eq) is the mean of the compliances along
  /// and across a wave; 1 for other bodies, whose stencil is their own.
  double stiffness_scale() const;
  std::size_t components() const { return options_.hold_lateral ? 2 : 1; }

  /// Returns the system for a contact set; a set within the window of an earlier set needs no
  /// set-up.
  ContactSystem& system_for(const ContactSet& contact);
  /// The cells of the window of the last system_for(); empty if there was none.
  ContactSet prepared() const;
  std::vector<double> gather(const TangentialField& field, const PointList& points) const;
  /// Returns a field with the values (components × cells) in the given cells and 0 in all others.
  TangentialField scatter(const std::vector<double>& values, const std::vector<Index>& cells) const;
  /// Throws InvalidInput unless both components have the grid's shape.
  void require_field(const TangentialField& field, const char* name) const;
  /// Returns the displacements of the cells in `where` under tractions on the cells in `loaded`.
  TangentialField displacement(const ContactSet& loaded, const TangentialField& traction,
                               const ContactSet& where);

 private:
  Grid2D grid_;
  Body body_;
  StickOptions options_;
  std::optional<ContactSystem> system_;
};

}  // namespace salebra::detail

namespace salebra {

struct StickSolver::Parts {
  detail::TangentialWorkspace workspace;
};

}  // namespace salebra
