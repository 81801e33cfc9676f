// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <vector>

#include "surface_response.hpp"

namespace salebra::detail {

void require_tangential(const Material& material);

std::vector<double> values_at(const Field& field, const PointList& points);

/// What the solvers with and without slip share: the kernels, kept between calls, and the way from
/// fields to vectors of points.
class TangentialWorkspace {
 public:
  /// Throws InvalidInput for a bad grid or option, or a material without tangential constants.
  TangentialWorkspace(const Grid2D& grid, const Material& material, const StickOptions& options);

  const Grid2D& grid() const { return grid_; }
  const Material& material() const { return material_; }
  const StickOptions& options() const { return options_; }
  std::size_t components() const { return options_.hold_lateral ? 2 : 1; }

  /// Needs no set-up for a set within an earlier one.
  ContactSystem& system_for(const ContactSet& contact);
  /// The cells of the window that the last set-up was for; empty where there was none.
  ContactSet prepared() const;
  std::vector<double> gather(const TangentialField& field, const PointList& points) const;
  /// The field that has these values in the cells, and 0 in all others.
  TangentialField scatter(const std::vector<double>& values, const std::vector<Index>& cells) const;
  /// Throws InvalidInput unless both components have the grid's shape.
  void require_field(const TangentialField& field, const char* name) const;
  /// Displacements in `where` under tractions on `loaded`.
  TangentialField displacement(const ContactSet& loaded, const TangentialField& traction,
                               const ContactSet& where);

 private:
  Grid2D grid_;
  Material material_;
  StickOptions options_;
  std::optional<ContactSystem> system_;
};

}  // namespace salebra::detail

namespace salebra {

struct StickSolver::Parts {
  detail::TangentialWorkspace workspace;
};

}  // namespace salebra
