// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/contact/stick.hpp>

#include "surface_response.hpp"

namespace salebra {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

void validate(const StickOptions& options) {
  require(options.tolerance >= 1e-14 && options.tolerance <= 0.1, "tolerance", options.tolerance,
          "must lie in 1e-14 … 0.1");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "must be >= 1");
}

void require_tangential(const Material& material) {
  require(
      std::isfinite(material.cerruti_isotropic) && std::isfinite(material.cerruti_directed) &&
          material.cerruti_isotropic > 0,
      "material", material.cerruti_isotropic,
      "as Cerruti's constant cannot be used for a stick solve; give Young's moduli and Poisson's "
      "ratios, or a contact modulus with Poisson's ratio");
}

void require_shape(const ContactSet& contact, const Grid2D& grid, Boundary boundary) {
  require(contact.rows() == grid.nx && contact.cols() == grid.ny, "contact", contact.size(),
          "cells do not match the grid; give one value for each of nx × ny cells");
  require(boundary == Boundary::free || !contact.all(), "contact", contact.size(),
          "cells are all in contact; a periodic surface in full contact has no finite stiffness");
}

detail::CellWindow window_for(const ContactSet& contact, const Grid2D& grid, Boundary boundary) {
  if (boundary == Boundary::periodic) return {0, 0, grid.nx, grid.ny};
  const detail::CellWindow window = detail::bounding_window(contact);
  return window.nx > 0 ? window : detail::CellWindow{0, 0, 1, 1};
}

struct UnitMotion {
  std::vector<double> tractions, misfit;
  StickReport report;
};

double sum_of(const std::vector<double>& values, Index first, Index count) {
  double sum = 0;
  for (Index k = first; k < first + count; ++k) sum += values[static_cast<std::size_t>(k)];
  return sum;
}

// K_ij = e_i·τ_j at the solution τ_j; adding τ_i·(e_j − Kτ_j) makes the error of unfinished iterates quadratic.
double correction(const UnitMotion& i, const UnitMotion& j) {
  return std::inner_product(i.tractions.begin(), i.tractions.end(), j.misfit.begin(), 0.0);
}

// Component `moving` of the displacement is 1 on the contact set, the other 0.
// guess: tractions of that component on the grid to start from; empty: none.
UnitMotion move_by_one(detail::ContactSystem& system, const detail::PointList& points, int moving,
                       const StickOptions& options, const Field& guess = {}) {
  const int components = system.response().components();
  const std::size_t count = points.cell.size();
  std::vector<double> displacements(count * static_cast<std::size_t>(components), 0.0);
  std::fill_n(displacements.begin() + static_cast<std::ptrdiff_t>(count) * moving, count, 1.0);
  UnitMotion motion;
  motion.tractions.assign(displacements.size(), 0.0);
  if (guess.size() > 0)
    for (std::size_t k = 0; k < count; ++k)
      motion.tractions[count * static_cast<std::size_t>(moving) + k] = guess.data()[points.cell[k]];
  // The residual is a mean over the components; the tolerance is one over the contact set.
  motion.report =
      system.solve(points, displacements, options.tolerance / std::sqrt(components),
                   options.max_iterations, options.on_progress, motion.tractions, motion.misfit);
  motion.report.residual *= std::sqrt(components);
  return motion;
}

}  // namespace

ContactSet contact_set(const NormalContactState& state) { return state.pressure > 0; }

struct StickSolver::Parts {
  Grid2D grid;
  Material material;
  StickOptions options;
  std::optional<detail::ContactSystem> system;

  detail::ContactSystem& system_for(const ContactSet& contact) {
    const detail::CellWindow window = window_for(contact, grid, options.boundary);
    if (!system || !system->window().contains(window))
      system.emplace(
          grid, material, options.boundary,
          options.hold_lateral ? detail::Traction::tangential : detail::Traction::along_x, window);
    return *system;
  }
  std::vector<double> gather(const TangentialField& field, const detail::PointList& points) const {
    std::vector<double> values;
    values.reserve(points.cell.size() * 2);
    for (const Index cell : points.cell) values.push_back(field.x.data()[cell]);
    if (options.hold_lateral)
      for (const Index cell : points.cell) values.push_back(field.y.data()[cell]);
    return values;
  }
  void scatter(const std::vector<double>& values, const detail::PointList& points,
               TangentialField& field) const {
    field.x = Field::Zero(grid.nx, grid.ny);
    field.y = Field::Zero(grid.nx, grid.ny);
    const std::size_t count = points.cell.size();
    for (std::size_t k = 0; k < count; ++k) field.x.data()[points.cell[k]] = values[k];
    if (options.hold_lateral)
      for (std::size_t k = 0; k < count; ++k) field.y.data()[points.cell[k]] = values[count + k];
  }
  void require_field(const TangentialField& field, const char* name) const {
    for (const Field* component : {&field.x, &field.y})
      require(component->rows() == grid.nx && component->cols() == grid.ny, name, component->size(),
              "values do not match the grid; give both components with nx × ny values");
  }
};

StickSolver::StickSolver(const Grid2D& grid, const Material& material, const StickOptions& options)
    : parts_(std::make_unique<Parts>(Parts{grid, material, options, {}})) {
  grid.validate();
  validate(options);
  require_tangential(material);
}
StickSolver::StickSolver(StickSolver&&) noexcept = default;
StickSolver& StickSolver::operator=(StickSolver&&) noexcept = default;
StickSolver::~StickSolver() = default;

StickReport StickSolver::solve(const ContactSet& contact, const TangentialField& displacement,
                               double scale, TangentialField& traction) {
  require_shape(contact, parts_->grid, parts_->options.boundary);
  parts_->require_field(displacement, "displacement");
  require_positive(scale, "scale");
  detail::ContactSystem& system = parts_->system_for(contact);
  const detail::PointList points = system.points(contact);
  const std::vector<double> displacements = parts_->gather(displacement, points);
  std::vector<double> tractions(displacements.size(), 0.0), misfit;
  if (traction.x.size() > 0) {
    parts_->require_field(traction, "traction");
    tractions = parts_->gather(traction, points);
  }
  const StickOptions& options = parts_->options;
  const double per_point = std::sqrt(static_cast<double>(system.response().components()));
  StickReport report = system.solve(points, displacements, options.tolerance * scale / per_point,
                                    options.max_iterations, options.on_progress, tractions, misfit);
  report.residual *= per_point / scale;
  parts_->scatter(tractions, points, traction);
  return report;
}

TangentialField StickSolver::displacement(const ContactSet& loaded, const TangentialField& traction,
                                          const ContactSet& where) {
  require_shape(loaded, parts_->grid, Boundary::free);
  require_shape(where, parts_->grid, Boundary::free);
  parts_->require_field(traction, "traction");
  detail::ContactSystem& system = parts_->system_for(loaded || where);
  const detail::PointList sources = system.points(loaded), readings = system.points(where);
  const std::vector<double> tractions = parts_->gather(traction, sources);
  std::vector<double> values(readings.cell.size() * (parts_->options.hold_lateral ? 2 : 1));
  system.response().apply(sources, tractions.data(), readings, values.data());
  TangentialField result;
  parts_->scatter(values, readings, result);
  return result;
}

void StickSolver::reserve(const ContactSet& largest) {
  require_shape(largest, parts_->grid, Boundary::free);
  parts_->system_for(largest);
}

StickStiffness stick_stiffness(const ContactSet& contact, const Grid2D& grid,
                               const Material& material, const StickOptions& options,
                               bool along_x_only, const Field& guess_x) {
  grid.validate();
  validate(options);
  require_tangential(material);
  require_shape(contact, grid, options.boundary);
  const detail::CellWindow window = window_for(contact, grid, options.boundary);
  const auto system_of = [&](detail::Traction traction) {
    return detail::ContactSystem(grid, material, options.boundary, traction, window);
  };
  detail::ContactSystem system =
      system_of(options.hold_lateral ? detail::Traction::tangential : detail::Traction::along_x);
  const detail::PointList points = system.points(contact);
  const Index count = points.size();
  require(guess_x.size() == 0 || (guess_x.rows() == grid.nx && guess_x.cols() == grid.ny),
          "guess_x", guess_x.size(), "values do not match the grid; give nx × ny values");
  const UnitMotion along_x = move_by_one(system, points, 0, options, guess_x);
  StickStiffness stiffness;
  const auto add = [&](const StickReport& report) {
    stiffness.iterations += report.iterations;
    stiffness.fft_count += report.fft_count;
    stiffness.residual = std::max(stiffness.residual, report.residual);
    stiffness.converged = stiffness.converged && report.converged;
  };
  stiffness.converged = true;
  add(along_x.report);
  stiffness.xx =
      (sum_of(along_x.tractions, 0, count) + correction(along_x, along_x)) * grid.cell_area();
  if (along_x_only) {
    stiffness.yy = stiffness.xy = unknown;
    return stiffness;
  }
  if (!options.hold_lateral) {
    detail::ContactSystem across = system_of(detail::Traction::along_y);
    const UnitMotion along_y = move_by_one(across, across.points(contact), 0, options);
    add(along_y.report);
    stiffness.yy =
        (sum_of(along_y.tractions, 0, count) + correction(along_y, along_y)) * grid.cell_area();
    return stiffness;
  }
  const UnitMotion along_y = move_by_one(system, points, 1, options);
  add(along_y.report);
  stiffness.yy =
      (sum_of(along_y.tractions, count, count) + correction(along_y, along_y)) * grid.cell_area();
  stiffness.xy =
      (sum_of(along_x.tractions, count, count) + correction(along_y, along_x)) * grid.cell_area();
  return stiffness;
}

PunchStiffness punch_stiffness(const ContactSet& contact, const Grid2D& grid,
                               double contact_modulus, const StickOptions& options) {
  grid.validate();
  validate(options);
  require_shape(contact, grid, options.boundary);
  detail::ContactSystem system(grid, Material::of_contact_modulus(contact_modulus),
                               options.boundary, detail::Traction::normal,
                               window_for(contact, grid, options.boundary));
  const detail::PointList points = system.points(contact);
  const UnitMotion press = move_by_one(system, points, 0, options);
  return {
      .normal_stiffness =
          (sum_of(press.tractions, 0, points.size()) + correction(press, press)) * grid.cell_area(),
      .iterations = press.report.iterations,
      .fft_count = press.report.fft_count,
      .residual = press.report.residual,
      .converged = press.report.converged};
}

}  // namespace salebra
