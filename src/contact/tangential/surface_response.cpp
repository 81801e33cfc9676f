// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements of the points of a contact set under their tractions, and the CG solve on the set.
#include "surface_response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/memory.hpp"
#include "conjugate_gradients.hpp"
#include "contact/half_space/multilevel_passes.hpp"
#include "contact/half_space/normal_symbol.hpp"
#include "contact/normal/contact_memory.hpp"

namespace salebra::detail {
namespace {

std::size_t size_of(Index count) { return static_cast<std::size_t>(count); }

Grid2D grid_of(const CellWindow& window, const Grid2D& grid) {
  return {window.nx, window.ny, static_cast<double>(window.nx) * grid.dx(),
          static_cast<double>(window.ny) * grid.dy()};
}

/// Returns the window after checking that memory for each process's rows of the window is
/// available.
CellWindow affordable(const CellWindow& window, const Grid2D& grid, const RowPartition& rows) {
  const Grid2D part = grid_of(window, grid);
  const double of_all = static_cast<double>(rows.count()) / static_cast<double>(rows.rows());
  require_memory(part, stick_memory(part) * of_all, "a stick solve", rows.communicator());
  return window;
}

}  // namespace

double max_of(const double* values, Index count) {
  double largest = 0;
  for (const double part : parallel::map_blocks<double>(
           count,
           [values](Index begin, Index end) {
             return Eigen::Map<const Eigen::ArrayXd>(values + begin, end - begin).abs().maxCoeff();
           },
           count))
    largest = std::max(largest, part);
  return largest;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  const Index count = static_cast<Index>(a.size());
  return parallel::sum_blocks(
      count,
      [&](Index begin, Index end) {
        const auto part = [=](const std::vector<double>& vector) {
          return Eigen::Map<const Eigen::VectorXd>(vector.data() + begin, end - begin);
        };
        return part(a).dot(part(b));
      },
      count);
}

SurfaceResponse::SurfaceResponse(const Grid2D& grid, const Material& material, Boundary boundary,
                                 Traction traction, const CellWindow& window,
                                 const RowPartition& rows)
    : window_(affordable(window, grid, rows)),
      traction_(traction),
      compliance_(tangential_compliance<double>(grid_of(window, grid), material, boundary,
                                                rows.communicator())),
      // A traction of 1 in scaled units displaces by about 1 cell in any system of units.
      single_unit_(std::sqrt(grid.cell_area()) * material.cerruti_isotropic) {
  Material scaled = material;
  scaled.cerruti_isotropic /= single_unit_;
  scaled.cerruti_directed /= single_unit_;
  make_single_ = [part = grid_of(window, grid), scaled, boundary,
                  communicator = rows.communicator()] {
    return tangential_compliance<float>(part, scaled, boundary, communicator);
  };
}

SurfaceResponse::SurfaceResponse(const Grid2D& grid, const Body& body, Traction traction,
                                 const RowPartition& rows)
    : window_(affordable({0, 0, grid.nx, grid.ny}, grid, rows)),
      traction_(traction),
      compliance_(tangential_compliance<double>(grid, body, rows.communicator())) {}

void SurfaceResponse::apply(const PointList& loaded, const double* tractions, const PointList& read,
                            double* displacements) {
  through(compliance_, {}, loaded, tractions, read, displacements);
}

void SurfaceResponse::apply_loosely(const PointList& points, const double* tractions,
                                    double* displacements) {
  if (!make_single_) return apply(points, tractions, points, displacements);
  if (!single_) single_ = make_single_();
  double largest = max_of(tractions, components() * points.size());
  if (!(largest > 0)) largest = 1;
  through(*single_, {1 / largest, largest * single_unit_}, points, tractions, points,
          displacements);
}

template <class Real>
void SurfaceResponse::through(Convolution2D<Real>& compliance, const Units& units,
                              const PointList& loaded, const double* tractions,
                              const PointList& read, double* displacements) {
  const int first = traction_ == Traction::along_y ? 1 : 0;
  // Returns the points of a row of the window; none if the component has no values.
  const auto points_of = [&](const PointList& points, int component, Index row) {
    const bool any = component >= first && component < first + components();
    return any ? std::pair(points.row_begins[size_of(row)], points.row_begins[size_of(row + 1)])
               : std::pair<Index, Index>(0, 0);
  };
  const auto column_of = [&](const PointList& points, Index row, Index k) {
    return points.windowed[size_of(k)] - row * window_.ny;
  };
  const auto offset = [&](const PointList& points, int component) {
    return (component - first) * points.size();
  };
  compliance.apply(
      [&](int component, Index row, Real* buffer) -> const Real* {
        const auto [begin, end] = points_of(loaded, component, row);
        if (begin == end) return nullptr;
        std::fill_n(buffer, window_.ny, Real(0));
        for (Index k = begin; k < end; ++k)
          buffer[column_of(loaded, row, k)] =
              static_cast<Real>(units.in * tractions[offset(loaded, component) + k]);
        return buffer;
      },
      [&](int component, Index row, const Real* values) {
        const auto [begin, end] = points_of(read, component, row);
        for (Index k = begin; k < end; ++k)
          displacements[offset(read, component) + k] =
              units.out * static_cast<double>(values[column_of(read, row, k)]);
      });
  fft_count_ += 2;
}

StencilPreconditioner::StencilPreconditioner(const InverseStencil& stencil, Boundary boundary,
                                             const CellWindow& window, const RowPartition& rows)
    : window_(window),
      boundary_(boundary),
      stencil_(stencil),
      field_(rows.count(), window.ny),
      halo_rows_(halo_rows(rows, boundary)) {
  static_assert(halo == InverseStencil::radius);
}

void StencilPreconditioner::hold(const PointList& points) {
  for (const Index cell : held_) field_.row(0)[cell] = 0;
  held_ = points.with_halo;
}

void StencilPreconditioner::apply(const double* in, double* out) {
  double* field = field_.row(0);
  for_each(held_.size(), 4 * held_.size(), [&](std::size_t k) { field[held_[k]] = in[k]; });
  field_.fill_halo(boundary_, halo_rows_);
  const Index count = static_cast<Index>(held_.size());
  parallel::for_slabs(
      count,
      [&](Index begin, Index end) {
        multilevel_passes().at_cells(field, field_.stride(), stencil_.weights(), held_.data(),
                                     begin, end, out);
      },
      InverseStencil::width * InverseStencil::width * count);
}

ContactSystem::ContactSystem(const Grid2D& grid, const Material& material, Boundary boundary,
                             Traction traction, const CellWindow& window, const RowPartition& rows)
    : window_(window),
      rows_(rows),
      window_grid_(grid_of(window, grid)),
      boundary_(boundary),
      response_(grid, material, boundary, traction, window, rows),
      preconditioner_(InverseStencil(grid), boundary, window, rows) {}

ContactSystem::ContactSystem(const Grid2D& grid, const Body& body, Traction traction,
                             const RowPartition& rows)
    : window_{0, 0, grid.nx, grid.ny},
      rows_(rows),
      window_grid_(grid),
      boundary_(Boundary::periodic),
      multilevel_(false),
      response_(grid, body, traction, rows),
      preconditioner_(tangential_inverse_stencil(grid, body), boundary_, window_, rows) {}

PointList ContactSystem::points(const ContactSet& cells) const {
  PointList list;
  for (Index ix = window_.x0; ix < window_.x0 + rows_.count(); ++ix) {
    list.row_begins.push_back(list.size());
    for (Index iy = window_.y0; iy < window_.y0 + window_.ny; ++iy)
      if (cells(ix, iy)) {
        list.cell.push_back(ix * cells.cols() + iy);
        list.windowed.push_back((ix - window_.x0) * window_.ny + iy - window_.y0);
        list.with_halo.push_back(preconditioner_.framed_index(ix, iy));
      }
  }
  list.row_begins.push_back(list.size());
  return list;
}

double ContactSystem::dot(const PointList& points, const double* a, const double* b,
                          int components) const {
  return parallel::sum_blocks(
      rows_,
      [&](Index begin, Index end) {
        const Index first = points.row_begins[size_of(begin)],
                    last = points.row_begins[size_of(end)];
        double sum = 0;
        for (int c = 0; c < components; ++c)
          for (Index k = c * points.size() + first; k < c * points.size() + last; ++k)
            sum += a[k] * b[k];
        return sum;
      },
      points.size());
}

void ContactSystem::subtract_response(const PointList& points, const std::vector<double>& tractions,
                                      std::vector<double>& displacements) {
  const bool none = std::ranges::all_of(tractions, [](double t) { return t == 0; });
  if (rows_.communicator().all_agree(none)) return;
  std::vector<double> response(tractions.size());
  response_.apply(points, tractions.data(), points, response.data());
  for (std::size_t i = 0; i < response.size(); ++i) displacements[i] -= response[i];
}

StickReport ContactSystem::solve(const PointList& points, const std::vector<double>& displacements,
                                 const Limits& limits, std::vector<double>& tractions,
                                 std::vector<double>& misfit) {
  StickReport report;
  const int first_fft = response_.fft_count();
  const Communicator& communicator = rows_.communicator();
  const std::size_t unknowns = displacements.size();
  misfit = displacements;
  if (communicator.all_agree(unknowns == 0)) {
    report.termination = Termination::converged;
    return report;
  }
  subtract_response(points, tractions, misfit);
  const int components = response_.components();
  const double unknowns_of_all = parallel::sum_blocks(rows_, [&](Index begin, Index end) {
    return static_cast<double>(
        components * (points.row_begins[size_of(end)] - points.row_begins[size_of(begin)]));
  });
  const double root = std::sqrt(unknowns_of_all);
  const auto stop = [&](double square, int iterations) {
    report.residual = std::sqrt(square) / root;
    // An iteration that ended before it met the tolerance or the limit was stopped by round-off.
    report.termination = report.residual < limits.tolerance    ? Termination::converged
                         : iterations == limits.max_iterations ? Termination::iteration_limit
                                                               : Termination::stalled;
    if (report.termination != Termination::stalled) return true;
    if (limits.progress && !communicator.all_agree(limits.progress(
                               {"stick", iterations / static_cast<double>(limits.max_iterations),
                                iterations, report.residual})))
      report.termination = Termination::interrupted;
    return report.termination == Termination::interrupted;
  };
  if (multilevel_ && !inverse_) inverse_.emplace(window_grid_, rows_, boundary_);
  const bool on_multilevel = inverse_ && inverse_->hold(points.windowed);
  if (!on_multilevel) preconditioner_.hold(points);
  const int first_multilevel = inverse_ ? inverse_->multilevel_count() : 0;
  const CgOutcome outcome = conjugate_gradients(
      [&](const std::vector<double>& in, std::vector<double>& out) {
        response_.apply(points, in.data(), points, out.data());
      },
      [&](const std::vector<double>& in, std::vector<double>& out) {
        for (int c = 0; c < components; ++c) {
          const std::size_t offset = size_of(c * points.size());
          if (on_multilevel)
            inverse_->apply(in.data() + offset, out.data() + offset);
          else
            preconditioner_.apply(in.data() + offset, out.data() + offset);
        }
      },
      stop,
      [&](const std::vector<double>& a, const std::vector<double>& b) {
        return dot(points, a.data(), b.data(), components);
      },
      tractions, misfit);
  report.iterations = outcome.iterations;
  report.fft_count = response_.fft_count() - first_fft;
  report.multilevel_count = inverse_ ? inverse_->multilevel_count() - first_multilevel : 0;
  return report;
}

}  // namespace salebra::detail
