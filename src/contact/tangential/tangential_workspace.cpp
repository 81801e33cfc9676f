// SPDX-License-Identifier: GPL-3.0-or-later
// State shared by the tangential solvers with and without slip: kernels kept between calls, and
// conversions between fields and vectors of points.
#include "tangential_workspace.hpp"

#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>

#include "contact/half_space/normal_symbol.hpp"

namespace salebra::detail {

void require_tangential(const Material& material) {
  require(
      std::isfinite(material.cerruti_isotropic) && std::isfinite(material.cerruti_directed) &&
          material.cerruti_isotropic > 0,
      "material", material.cerruti_isotropic,
      "as Cerruti's constant cannot be used for a stick solve; give Young's moduli and Poisson's "
      "ratios, or a contact modulus with Poisson's ratio");
}

void require_tangential(const Body& body, const Grid2D& grid, Boundary boundary) {
  if (const auto& material = body.half_space_material()) return require_tangential(*material);
  require_pressable(body, grid, boundary);
  require_that(body.has_tangential_response(), "body",
               "has no tangential response; give in_plane and across in its table");
}

std::vector<double> values_at(const Field& field, const PointList& points) {
  std::vector<double> values;
  values.reserve(points.cell.size() * 2);  // space for the other component
  for (const Index cell : points.cell) values.push_back(field.data()[cell]);
  return values;
}

TangentialWorkspace::TangentialWorkspace(const Grid2D& grid, const Body& body,
                                         const StickOptions& options)
    : grid_(grid), body_(body), options_(options) {
  grid.validate();
  require_limits(options.tolerance, options.max_iterations);
  require_tangential(body, grid, options.boundary);
}

double TangentialWorkspace::stiffness_scale() const {
  // On half-spaces the compliance is (2π/q)(c1 + c2 …) with Cerruti's constants c1 and c2.
  if (const auto& material = body_.half_space_material())
    return 1 / (std::numbers::pi * (material->cerruti_isotropic + material->cerruti_directed / 2));
  return 1;
}

ContactSystem& TangentialWorkspace::system_for(const ContactSet& contact) {
  const CellWindow window = loading_window(contact, grid_, options_.boundary);
  if (system_ && system_->window().contains(window)) return *system_;
  const Traction traction = options_.hold_lateral ? Traction::tangential : Traction::along_x;
  if (const auto& material = body_.half_space_material())
    system_.emplace(grid_, *material, options_.boundary, traction, window);
  else
    system_.emplace(grid_, body_, traction, RowPartition(grid_.nx));
  return *system_;
}

ContactSet TangentialWorkspace::prepared() const {
  if (!system_) return {};
  ContactSet cells = ContactSet::Constant(grid_.nx, grid_.ny, false);
  const CellWindow& window = system_->window();
  cells.block(window.x0, window.y0, window.nx, window.ny) = true;
  return cells;
}

std::vector<double> TangentialWorkspace::gather(const TangentialField& field,
                                                const PointList& points) const {
  std::vector<double> values = values_at(field.x, points);
  if (options_.hold_lateral)
    for (const Index cell : points.cell) values.push_back(field.y.data()[cell]);
  return values;
}

TangentialField TangentialWorkspace::scatter(const std::vector<double>& values,
                                             const std::vector<Index>& cells) const {
  TangentialField field{Field::Zero(grid_.nx, grid_.ny), Field::Zero(grid_.nx, grid_.ny)};
  const std::size_t count = cells.size();
  for (std::size_t k = 0; k < count; ++k) field.x.data()[cells[k]] = values[k];
  if (options_.hold_lateral)
    for (std::size_t k = 0; k < count; ++k) field.y.data()[cells[k]] = values[count + k];
  return field;
}

void TangentialWorkspace::require_field(const TangentialField& field, const char* name) const {
  for (const Field* component : {&field.x, &field.y})
    require(component->rows() == grid_.nx && component->cols() == grid_.ny, name, component->size(),
            "values do not match the grid; give both components with nx × ny values");
}

TangentialField TangentialWorkspace::displacement(const ContactSet& loaded,
                                                  const TangentialField& traction,
                                                  const ContactSet& where) {
  require_contact(loaded, grid_, Boundary::free);
  require_contact(where, grid_, Boundary::free);
  require_field(traction, "traction");
  ContactSystem& system = system_for(loaded || where);
  const PointList sources = system.points(loaded), readings = system.points(where);
  const std::vector<double> tractions = gather(traction, sources);
  std::vector<double> values(readings.cell.size() * components());
  system.response().apply(sources, tractions.data(), readings, values.data());
  return scatter(values, readings.cell);
}

}  // namespace salebra::detail
