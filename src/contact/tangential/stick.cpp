// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential stiffness of a stuck contact set, and its tractions for given displacements.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/contact/tangential/stick.hpp>

#include "base/special_values.hpp"
#include "base/stage_time.hpp"
#include "contact/half_space/normal_symbol.hpp"
#include "surface_response.hpp"
#include "tangential_workspace.hpp"

namespace salebra {
namespace {

using detail::unknown;

struct UnitMotion {
  std::vector<double> tractions, misfit;
  StickReport report;
};

// Tangential stiffness K_ij, divided by the cell area, of the contact set: the force in direction i
// for a unit displacement in direction j. e_i is 1 on component i of the points (`moved`) and τ_i
// are the tractions of the unit displacement; with the compliance C it is e_i·τ_j + τ_i·(e_j −
// Cτ_j). The second term makes the error of unfinished iterates quadratic.
double stiffness_of(detail::ContactSystem& system, const detail::PointList& points, int moved,
                    const UnitMotion& i, const UnitMotion& j) {
  const std::vector<double> ones(points.cell.size(), 1.0);
  return system.dot(points, ones.data(), j.tractions.data() + moved * points.size(), 1) +
         system.dot(points, i.tractions.data(), j.misfit.data(), system.response().components());
}

// Finds the tractions for which component `moving` of the displacement is 1 on the contact set and
// the other component is 0. guess: tractions of component `moving` on the grid to start from;
// empty: none.
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
  // The residual is an rms over all components, the tolerance refers to an rms over the points.
  motion.report = system.solve(
      points, displacements,
      {options.tolerance / std::sqrt(components), options.max_iterations, options.on_progress},
      motion.tractions, motion.misfit);
  motion.report.residual *= std::sqrt(components);
  return motion;
}

}  // namespace

StickSolver::StickSolver(const Grid2D& grid, const Body& body, const StickOptions& options)
    : parts_(std::make_unique<Parts>(Parts{detail::TangentialWorkspace(grid, body, options)})) {}
StickSolver::StickSolver(StickSolver&&) noexcept = default;
StickSolver& StickSolver::operator=(StickSolver&&) noexcept = default;
StickSolver::~StickSolver() = default;

StickReport StickSolver::solve(const ContactSet& contact, const TangentialField& displacement,
                               double scale, TangentialField& traction) {
  detail::TangentialWorkspace& workspace = parts_->workspace;
  const StickOptions& options = workspace.options();
  detail::require_contact(contact, workspace.grid(), options.boundary);
  workspace.require_field(displacement, "displacement");
  require_positive(scale, "scale");
  detail::ContactSystem& system = workspace.system_for(contact);
  const detail::PointList points = system.points(contact);
  const std::vector<double> displacements = workspace.gather(displacement, points);
  std::vector<double> tractions(displacements.size(), 0.0), misfit;
  if (traction.x.size() > 0) {
    workspace.require_field(traction, "traction");
    tractions = workspace.gather(traction, points);
  }
  const double per_point = std::sqrt(static_cast<double>(system.response().components()));
  StickReport report = system.solve(
      points, displacements,
      {options.tolerance * scale / per_point, options.max_iterations, options.on_progress},
      tractions, misfit);
  report.residual *= per_point / scale;
  traction = workspace.scatter(tractions, points.cell);
  return report;
}

TangentialField StickSolver::displacement(const ContactSet& loaded, const TangentialField& traction,
                                          const ContactSet& where) {
  return parts_->workspace.displacement(loaded, traction, where);
}

void StickSolver::reserve(const ContactSet& largest) {
  detail::require_contact(largest, parts_->workspace.grid(), Boundary::free);
  parts_->workspace.system_for(largest);
}

double StickStiffness::along(double angle) const {
  if (angle == 0) return xx;
  const double c = std::cos(angle), s = std::sin(angle);
  return c * c * xx + 2 * c * s * xy + s * s * yy;
}

namespace {

void check(const Grid2D& grid, const StickOptions& options, const Field& guess,
           const RowPartition& rows) {
  detail::require_limits(options.tolerance, options.max_iterations);
  collectively(rows.communicator(), [&] {
    require(guess.size() == 0 || (guess.rows() == rows.count() && guess.cols() == grid.ny), "guess",
            guess.size(), "values do not match the grid; give one value for each cell");
  });
}

// system_of(traction) makes the system of the contact's cells for tractions along one or both axes.
template <class SystemOf>
StickStiffness stiffness_of(const ContactSet& contact, const Grid2D& grid,
                            const SystemOf& system_of, const StickOptions& options,
                            bool along_x_only, const Field& guess) {
  const detail::StageTime time(detail::Stage::stick);
  detail::ContactSystem system =
      system_of(options.hold_lateral ? detail::Traction::tangential : detail::Traction::along_x);
  const detail::PointList points = system.points(contact);
  const UnitMotion along_x = move_by_one(system, points, 0, options, guess);
  StickStiffness stiffness;
  const auto add = [&](const StickReport& report) {
    stiffness.iterations += report.iterations;
    stiffness.fft_count += report.fft_count;
    stiffness.multilevel_count += report.multilevel_count;
    stiffness.residual = std::max(stiffness.residual, report.residual);
    stiffness.termination = std::max(stiffness.termination, report.termination);
  };
  stiffness.termination = Termination::converged;
  add(along_x.report);
  stiffness.xx = stiffness_of(system, points, 0, along_x, along_x) * grid.cell_area();
  if (along_x_only) {
    stiffness.yy = stiffness.xy = unknown;
    return stiffness;
  }
  if (!options.hold_lateral) {
    detail::ContactSystem across = system_of(detail::Traction::along_y);
    const UnitMotion along_y = move_by_one(across, points, 0, options, guess);
    add(along_y.report);
    stiffness.yy = stiffness_of(across, points, 0, along_y, along_y) * grid.cell_area();
    return stiffness;
  }
  const UnitMotion along_y = move_by_one(system, points, 1, options, guess);
  add(along_y.report);
  stiffness.yy = stiffness_of(system, points, 1, along_y, along_y) * grid.cell_area();
  stiffness.xy = stiffness_of(system, points, 1, along_y, along_x) * grid.cell_area();
  return stiffness;
}

}  // namespace

StickStiffness stick_stiffness(const ContactSet& contact, const Grid2D& grid,
                               const Material& material, const StickOptions& options,
                               bool along_x_only, const Field& guess,
                               const Communicator& communicator) {
  grid.validate();
  const RowPartition rows(communicator, grid.nx);
  check(grid, options, guess, rows);
  detail::require_tangential(material);
  detail::require_spread_contact(contact, grid, rows, options.boundary);
  const detail::CellWindow window = communicator.alone()
                                        ? detail::loading_window(contact, grid, options.boundary)
                                        : detail::CellWindow{0, 0, grid.nx, grid.ny};
  return stiffness_of(
      contact, grid,
      [&](detail::Traction traction) {
        return detail::ContactSystem(grid, material, options.boundary, traction, window,
                                     communicator.alone() ? RowPartition(window.nx) : rows);
      },
      options, along_x_only, guess);
}

StickStiffness stick_stiffness(const ContactSet& contact, const Grid2D& grid, const Body& body,
                               const StickOptions& options, bool along_x_only, const Field& guess,
                               const Communicator& communicator) {
  if (const auto& material = body.half_space_material())
    return stick_stiffness(contact, grid, *material, options, along_x_only, guess, communicator);
  detail::require_tangential(body, grid, options.boundary);
  const RowPartition rows(communicator, grid.nx);
  check(grid, options, guess, rows);
  // From a base, the stiffness is finite even if every cell is in contact.
  detail::require_spread_contact(
      contact, grid, rows, body.compliance(0).in_plane > 0 ? Boundary::free : Boundary::periodic);
  return stiffness_of(
      contact, grid,
      [&](detail::Traction traction) { return detail::ContactSystem(grid, body, traction, rows); },
      options, along_x_only, guess);
}

}  // namespace salebra
