// SPDX-License-Identifier: GPL-3.0-or-later
// Percolation of the fluid through a gap, and its pressure flow factors.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <vector>

#include "base/memory.hpp"
#include "flow_multigrid.hpp"

namespace salebra {
namespace {

using detail::FaceConductances;
using detail::FlowMultigrid;

// Cells with a gap below this, in units of the mean gap, count as closed: contact solvers do not
// resolve such gaps, and the cubes of such gaps leave the range of single precision.
constexpr double min_open = 1e-9;

// CG tracks the dissipation of the flow by subtracting the gain of each iteration. When it has
// fallen to this fraction of its last computed value, the difference has lost too many digits.
constexpr double worth_a_refresh = 0.05;

struct Directions {
  bool x = false, y = false;
  bool any() const { return x || y; }
};

/// Connected parts of the open cells, and the axes along which each part spans the period. A part
/// spans the period if it meets its own periodic image, shifted by that period.
class OpenParts {
 public:
  explicit OpenParts(const Field& opening)
      : columns_(opening.cols()), part_of_(static_cast<std::size_t>(opening.size()), none) {
    for (Index row = 0; row < opening.rows(); ++row)
      for (Index column = 0; column < columns_; ++column) {
        if (!(opening(row, column) > 0)) continue;
        const std::int32_t left = column > 0 ? at(row, column - 1) : none;
        const std::int32_t above = row > 0 ? at(row - 1, column) : none;
        if (left != none && above != none) join(left, above, {});
        at(row, column) = left != none ? left : above != none ? above : new_part();
      }
    const auto meet = [&](std::int32_t last, std::int32_t first, const Shift& shift) {
      if (last != none && first != none) join(last, first, shift);
    };
    for (Index column = 0; column < columns_; ++column)
      meet(at(opening.rows() - 1, column), at(0, column), {1, 0});
    for (Index row = 0; row < opening.rows(); ++row)
      meet(at(row, columns_ - 1), at(row, 0), {0, 1});
    for (std::int32_t part = 0; part < static_cast<std::int32_t>(parts_.size()); ++part)
      parts_[index(part)].leads_round = parts_[index(root_of(part).part)].leads_round;
  }

  Directions leads_round(Index cell) const {
    const std::int32_t part = part_of_[static_cast<std::size_t>(cell)];
    return part == none ? Directions{} : parts_[index(part)].leads_round;
  }

 private:
  static constexpr std::int32_t none = -1;
  struct Shift {
    std::int32_t x = 0, y = 0;  // shift in numbers of periods
  };
  struct Part {
    std::int32_t parent = 0;
    Shift shift;  // from this part's copy of the parent
    Directions leads_round;
  };
  struct Root {
    std::int32_t part = 0;
    Shift shift;
  };

  static std::size_t index(std::int32_t part) { return static_cast<std::size_t>(part); }
  std::int32_t& at(Index row, Index column) {
    return part_of_[static_cast<std::size_t>(row * columns_ + column)];
  }
  std::int32_t new_part() {
    parts_.push_back({static_cast<std::int32_t>(parts_.size()), {}, {}});
    return parts_.back().parent;
  }
  Root root_of(std::int32_t part) {
    Root root{part, {}};
    for (;;) {
      Part& here = parts_[index(root.part)];
      if (here.parent == root.part) return root;
      const Part& above = parts_[index(here.parent)];
      // Pointing to the parent of the parent halves the path to the root. A root has no shift.
      here.shift = {here.shift.x + above.shift.x, here.shift.y + above.shift.y};
      here.parent = above.parent;
      root = {here.parent, {root.shift.x + here.shift.x, root.shift.y + here.shift.y}};
    }
  }
  // Joins the part `first` to the periodic image of `second` that it touches, which is shifted by
  // `shift` periods.
  void join(std::int32_t first, std::int32_t second, const Shift& shift) {
    const Root a = root_of(first), b = root_of(second);
    const Shift between{a.shift.x - b.shift.x - shift.x, a.shift.y - b.shift.y - shift.y};
    const std::int32_t root = std::min(a.part, b.part), child = std::max(a.part, b.part);
    if (root == child) {
      Directions& round = parts_[index(root)].leads_round;
      round = {round.x || between.x != 0, round.y || between.y != 0};
      return;
    }
    const std::int32_t sign = child == b.part ? 1 : -1;
    parts_[index(child)].parent = root;
    parts_[index(child)].shift = {sign * between.x, sign * between.y};
    const Directions of_child = parts_[index(child)].leads_round;
    Directions& round = parts_[index(root)].leads_round;
    round = {round.x || of_child.x, round.y || of_child.y};
  }

  Index columns_;
  std::vector<std::int32_t> part_of_;  // part of each cell; none: closed
  std::vector<Part> parts_;
};

template <class Body>
double sum_cells(const Field& field, const Body& body) {
  return parallel::sum_blocks(
      field.rows(),
      [&](Index begin, Index end) {
        double sum = 0;
        for (Index k = begin * field.cols(); k < end * field.cols(); ++k)
          sum += body(field.data()[k]);
        return sum;
      },
      field.size());
}

/// Solves ⟨(s − b)/(s + b)⟩ = 0 for the effective conductance b, where ⟨⟩ is the mean over the
/// cells and s >= 0 the conductance of a cell. The mean is 1 − 2⟨b/(s + b)⟩ and falls with b;
/// Newton's method in ln b is safeguarded by bisection.
double effective_medium(const Field& conductance, double mean) {
  const double cells = static_cast<double>(conductance.size());
  const double closed = sum_cells(conductance, [](double s) { return s > 0 ? 0.0 : 1.0; });
  if (2 * closed >= cells) return FlowFactors::unknown;
  double low = -800, high = std::log(mean), point = high;
  for (int step = 0; step < 200 && high - low > 1e-14; ++step) {
    const double b = std::exp(point);
    // ⟨b/(s + b)⟩ and its derivative with respect to ln b, with the mean ⟨⟩ over the cells.
    const double part = sum_cells(conductance, [&](double s) { return b / (s + b); }) / cells;
    const double slope =
        sum_cells(conductance, [&](double s) { return b * s / ((s + b) * (s + b)); }) / cells;
    (part > 0.5 ? high : low) = point;
    const double next = point - (part - 0.5) / slope;
    if (std::abs(next - point) < 1e-13) break;
    point = next > low && next < high ? next : 0.5 * (low + high);
  }
  return std::exp(point);
}

/// Flow under a pressure gradient of one per cell.
struct Flow {
  Field pressure = {};
  double factor = 0, residual = 0;
  int iterations = 0;
  Termination termination = Termination::iteration_limit;
};

/// Reynolds' equation of the flow on a grid of face conductances, and its solver.
class Reynolds {
 public:
  Reynolds(const FaceConductances& faces, FlowMultigrid& multigrid)
      : faces_(faces), multigrid_(multigrid) {}

  /// Computes the flow under a pressure gradient of one per cell along x or y. The flow is the
  /// minimum over the pressures p of the mean of T(1 + δp)² over the cells, where T is the
  /// conductance of a face and δp the pressure difference across it. It is found by conjugate
  /// gradients, and its error is the square of the error of p.
  Flow flow(bool along_x, const FlowOptions& options, int iterations_before) {
    const double cells = static_cast<double>(faces_.x.size());
    const auto like = [&] { return uninitialised_field(faces_.x.rows(), faces_.x.cols()); };
    Field p = Field::Zero(faces_.x.rows(), faces_.x.cols()), r = like(), z = like();
    Field t = Field::Zero(p.rows(), p.cols()), image = t;
    net_inflow(p, along_x, r);
    double computed = dissipation(p, along_x), left = computed, last_product = 1, last_step = 0;
    Flow result;
    for (;; ++result.iterations) {
      multigrid_.apply(r, z);
      const auto [product, overlap] = products(z, r, image);
      result.residual = std::max(0.0, product) / left;
      if (!(std::isfinite(product) && left > 0)) {
        result.termination = Termination::out_of_range;
        break;
      }
      if (result.residual <= options.tolerance) {
        result.termination = Termination::converged;
        break;
      }
      if (result.iterations >= options.max_iterations) break;
      if (options.on_progress &&
          !options.on_progress(
              {"flow", 0, iterations_before + result.iterations, result.residual})) {
        result.termination = Termination::interrupted;
        break;
      }
      // Flexible CG, because the preconditioner changes from call to call.
      const double beta = result.iterations > 0 ? -last_step * overlap / last_product : 0;
      const double curvature = take_direction(beta, z, t, image);
      if (!(curvature > 0)) {
        result.termination = Termination::stalled;
        break;
      }
      const double descent = products(t, r, image)[0];
      last_step = descent / curvature;
      last_product = product;
      advance(last_step, t, image, p, r);
      left -= last_step * descent;
      // A dissipation that is a small difference of much larger numbers is computed anew.
      if (left < worth_a_refresh * computed) {
        left = computed = dissipation(p, along_x);
        net_inflow(p, along_x, r);
      }
    }
    result.factor = dissipation(p, along_x) / cells;
    result.pressure = std::move(p);
    return result;
  }

  /// Flow along x under a gradient of one per cell along y, from the pressures of both gradients. As
  /// a product of both, its error is the product of their errors.
  double mixed(const Field& of_x, const Field& of_y) const {
    return parallel::sum_blocks(
               of_x.rows(),
               [&](Index begin, Index end) {
                 double sum = 0;
                 const double *u = of_x.data(), *v = of_y.data();
                 for_cells(begin, end, [&](Index k, Index, Index below, Index, Index right) {
                   sum += faces_.x.data()[k] * (1 + u[below] - u[k]) * (v[below] - v[k]) +
                          faces_.y.data()[k] * (u[right] - u[k]) * (1 + v[right] - v[k]);
                 });
                 return sum;
               },
               of_x.size()) /
           static_cast<double>(of_x.size());
  }

 private:
  // Calls body(k, cell above, cell below, cell to the left, cell to the right) for each cell k.
  template <class Body>
  void for_cells(Index first_row, Index last_row, const Body& body) const {
    const Index rows = faces_.x.rows(), columns = faces_.x.cols();
    for (Index row = first_row; row < last_row; ++row) {
      const Index here = row * columns, above = (row == 0 ? rows - 1 : row - 1) * columns;
      const Index below = (row == rows - 1 ? 0 : row + 1) * columns;
      const auto cell = [&](Index column, Index left, Index right) {
        body(here + column, above + column, below + column, here + left, here + right);
      };
      cell(0, columns - 1, columns > 1 ? 1 : 0);
      for (Index column = 1; column < columns - 1; ++column) cell(column, column - 1, column + 1);
      if (columns > 1) cell(columns - 1, columns - 2, 0);
    }
  }

  // r = inflow minus outflow of each cell under the pressures p and the mean gradient.
  void net_inflow(const Field& p, bool along_x, Field& r) const {
    const double gradient_x = along_x ? 1 : 0, gradient_y = along_x ? 0 : 1;
    parallel::for_slabs(
        p.rows(),
        [&](Index begin, Index end) {
          const double *u = p.data(), *x = faces_.x.data(), *y = faces_.y.data();
          for_cells(begin, end, [&](Index k, Index above, Index below, Index left, Index right) {
            r.data()[k] =
                x[k] * (gradient_x + u[below] - u[k]) - x[above] * (gradient_x + u[k] - u[above]) +
                y[k] * (gradient_y + u[right] - u[k]) - y[left] * (gradient_y + u[k] - u[left]);
          });
        },
        p.size());
  }

  double dissipation(const Field& p, bool along_x) const {
    const double gradient_x = along_x ? 1 : 0, gradient_y = along_x ? 0 : 1;
    return parallel::sum_blocks(
        p.rows(),
        [&](Index begin, Index end) {
          double sum = 0;
          for_cells(begin, end, [&](Index k, Index, Index below, Index, Index right) {
            const double x = gradient_x + p.data()[below] - p.data()[k];
            const double y = gradient_y + p.data()[right] - p.data()[k];
            sum += faces_.x.data()[k] * x * x + faces_.y.data()[k] * y * y;
          });
          return sum;
        },
        p.size());
  }

  static std::array<double, 2> products(const Field& z, const Field& r, const Field& image) {
    std::array<double, 2> total{};
    for (const auto& part : parallel::map_blocks<std::array<double, 2>>(
             z.rows(),
             [&](Index begin, Index end) {
               std::array<double, 2> sums{};
               for (Index k = begin * z.cols(); k < end * z.cols(); ++k) {
                 sums[0] += z.data()[k] * r.data()[k];
                 sums[1] += z.data()[k] * image.data()[k];
               }
               return sums;
             },
             z.size())) {
      total[0] += part[0];
      total[1] += part[1];
    }
    return total;
  }

  // Computes the search direction t = z + β t and its image At, where A is the operator of
  // Reynolds' equation; returns the scalar product <t, At>.
  double take_direction(double beta, const Field& z, Field& t, Field& image) const {
    parallel::for_slabs(
        t.rows(),
        [&](Index begin, Index end) {
          for (Index k = begin * t.cols(); k < end * t.cols(); ++k)
            t.data()[k] = z.data()[k] + beta * t.data()[k];
        },
        t.size());
    return parallel::sum_blocks(
        t.rows(),
        [&](Index begin, Index end) {
          double sum = 0;
          const double *u = t.data(), *x = faces_.x.data(), *y = faces_.y.data();
          for_cells(begin, end, [&](Index k, Index above, Index below, Index left, Index right) {
            const double here = u[k];
            const double value = x[k] * (here - u[below]) + x[above] * (here - u[above]) +
                                 y[k] * (here - u[right]) + y[left] * (here - u[left]);
            image.data()[k] = value;
            sum += here * value;
          });
          return sum;
        },
        t.size());
  }

  static void advance(double step, const Field& t, const Field& image, Field& p, Field& r) {
    parallel::for_slabs(
        p.rows(),
        [&](Index begin, Index end) {
          for (Index k = begin * p.cols(); k < end * p.cols(); ++k) {
            p.data()[k] += step * t.data()[k];
            r.data()[k] -= step * image.data()[k];
          }
        },
        p.size());
  }

  const FaceConductances& faces_;
  FlowMultigrid& multigrid_;
};

/// Conductances of the faces of those parts of the fluid that span a period; nothing flows through
/// other parts.
FaceConductances faces_of(const Field& conductance, const OpenParts& parts, const Grid2D& grid) {
  FaceConductances faces{uninitialised_field(grid.nx, grid.ny),
                         uninitialised_field(grid.nx, grid.ny)};
  const double aspect = grid.dy() / grid.dx();
  const auto between = [&](Index a, Index b) {
    const double first = conductance.data()[a], second = conductance.data()[b];
    return first > 0 && second > 0 ? 2 * first * second / (first + second) : 0.0;
  };
  parallel::for_slabs(
      grid.nx,
      [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row)
          for (Index column = 0; column < grid.ny; ++column) {
            const Index k = row * grid.ny + column;
            const bool used = parts.leads_round(k).any();
            const Index below = (row + 1 == grid.nx ? 0 : row + 1) * grid.ny + column;
            const Index right = row * grid.ny + (column + 1 == grid.ny ? 0 : column + 1);
            // A cell that is its own neighbour (one cell per period) exchanges nothing with itself
            // but conducts across the period.
            faces.x.data()[k] = used ? between(k, below) * aspect : 0;
            faces.y.data()[k] = used ? between(k, right) / aspect : 0;
          }
      },
      grid.points());
  return faces;
}

/// The flow factors of a gap on its cells, without their errors. Cells with a gap of 0 are closed.
FlowFactors flow_of(const Field& gap, const Grid2D& grid, const FlowOptions& options,
                    bool with_bruggeman) {
  FlowFactors result;
  result.mean_gap = sum_cells(gap, [](double g) { return g; }) / static_cast<double>(gap.size());
  if (!(result.mean_gap > 0)) return result;
  Field conductance = uninitialised_field(grid.nx, grid.ny);
  for (Index k = 0; k < grid.points(); ++k) {
    const double relative = gap.data()[k] / result.mean_gap;
    conductance.data()[k] = relative > min_open ? relative * relative * relative : 0;
  }
  if (with_bruggeman) {
    const double mean_cube =
        sum_cells(conductance, [](double s) { return s; }) / static_cast<double>(grid.points());
    result.bruggeman_flow_factor = effective_medium(conductance, mean_cube);
  }
  const OpenParts parts(conductance);
  for (Index k = 0; k < grid.points(); ++k) {
    const Directions round = parts.leads_round(k);
    result.percolates_x |= round.x;
    result.percolates_y |= round.y;
  }
  if (!result.percolates_x && !result.percolates_y) return result;

  const FaceConductances faces = faces_of(conductance, parts, grid);
  FlowMultigrid multigrid(faces);
  Reynolds reynolds(faces, multigrid);
  const double aspect = grid.dx() / grid.dy();
  const auto solve = [&](bool along_x) {
    Flow flow = reynolds.flow(along_x, options, result.iterations);
    result.residual = std::max(result.residual, flow.residual);
    result.iterations += flow.iterations;
    result.termination = std::max(result.termination, flow.termination);
    return flow;
  };
  Flow along_x, along_y;
  if (result.percolates_x) {
    along_x = solve(true);
    result.pressure_flow_factor_x = along_x.factor * aspect;
  }
  if (result.percolates_y && result.termination != Termination::interrupted) {
    along_y = solve(false);
    result.pressure_flow_factor_y = along_y.factor * (1 / aspect);
  }
  if (result.termination == Termination::interrupted) return result;
  result.pressure_flow_factor_xy = result.percolates_x && result.percolates_y
                                       ? reynolds.mixed(along_x.pressure, along_y.pressure)
                                       : 0;
  return result;
}

/// The flow through every second cell along both axes; empty if too few cells are left.
std::optional<FlowFactors> on_coarse_cells(const Field& gap, const Grid2D& grid,
                                           const FlowOptions& options) {
  if (grid.nx < 8 || grid.ny < 8) return {};
  const Grid2D coarse{(grid.nx + 1) / 2, (grid.ny + 1) / 2, grid.lx, grid.ly};
  const Field gaps = gap(Eigen::seqN(0, coarse.nx, 2), Eigen::seqN(0, coarse.ny, 2));
  return flow_of(gaps, coarse, options, false);
}

/// Error of a flow factor by its cells, from that on cells of twice the size. Flow factors converge
/// at second order, so that a third of the change remains; with the few cells that constrictions
/// have, it is up to two thirds.
double cell_error(double factor, const std::optional<FlowFactors>& coarse, double angle) {
  if (!coarse || std::isnan(factor)) return FlowFactors::unknown;
  if (!coarse->converged()) return FlowFactors::unknown;
  const double other = coarse->flow_factor(angle);
  return 0.75 * std::abs(factor - (std::isnan(other) ? 0 : other));
}
template <class OpenCell>
FlowFactors flow_through(const Field& gap, const Grid2D& grid, const FlowOptions& options,
                         const OpenCell& open) {
  require(options.tolerance >= 1e-14 && options.tolerance <= 1e-1, "tolerance", options.tolerance,
          "must lie in 1e-14 … 1e-1");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "must be >= 1");
  require(!std::isinf(options.lay_angle), "lay_angle", options.lay_angle, "must be finite");
  require_memory(grid, 166 * static_cast<double>(grid.points()), "the flow through a gap");
  Field opening = uninitialised_field(grid.nx, grid.ny);
  for (Index k = 0; k < grid.points(); ++k)
    opening.data()[k] = open(k) ? std::max(0.0, gap.data()[k]) : 0.0;
  FlowFactors result = flow_of(opening, grid, options, true);
  if (!result.percolates_x && !result.percolates_y) return result;
  double both = 0;
  if (result.percolates_x) both += result.pressure_flow_factor_x;
  if (result.percolates_y && !std::isnan(result.pressure_flow_factor_y))
    both += result.pressure_flow_factor_y;
  result.effective_gap = result.mean_gap * std::cbrt(0.5 * both);
  if (!result.converged()) return result;
  const std::optional<FlowFactors> coarse = on_coarse_cells(opening, grid, options);
  if (coarse && coarse->termination == Termination::interrupted) {
    result.termination = coarse->termination;
    return result;
  }
  const auto add = [&](double angle, double& factor, double& error) {
    factor = result.flow_factor(angle);
    error = cell_error(factor, coarse, angle);
  };
  double unused;
  add(0, unused, result.pressure_flow_factor_x_error);
  add(std::numbers::pi / 2, unused, result.pressure_flow_factor_y_error);
  if (std::isnan(options.lay_angle)) return result;
  add(options.lay_angle + std::numbers::pi / 2, result.pressure_flow_factor_across,
      result.pressure_flow_factor_across_error);
  add(options.lay_angle, result.pressure_flow_factor_along,
      result.pressure_flow_factor_along_error);
  return result;
}

void require_gap(const Field& gap, const Grid2D& grid) {
  grid.validate();
  require(gap.rows() == grid.nx && gap.cols() == grid.ny, "gap", gap.size(),
          "cells must fill the grid");
  require(grid.points() < std::numeric_limits<std::int32_t>::max(), "grid", grid.points(),
          "cells are too many for a flow, which takes at most 2147483646");
  require(gap.isFinite().all(), "gap", gap.sum(), "must be finite in every cell");
}

}  // namespace

double FlowFactors::flow_factor(double angle) const {
  // Along an axis, the factor keeps its bits.
  const double c = std::cos(angle), s = std::sin(angle);
  if (std::abs(s) < 1e-12) return pressure_flow_factor_x;
  if (std::abs(c) < 1e-12) return pressure_flow_factor_y;
  if (!percolates_x && !percolates_y) return unknown;
  const double x = percolates_x ? pressure_flow_factor_x : 0,
               y = percolates_y ? pressure_flow_factor_y : 0;
  const double factor = c * c * x + 2 * c * s * pressure_flow_factor_xy + s * s * y;
  // Channels that all run at right angles to the direction let nothing pass along it.
  return factor <= 1e-9 * (x + y) ? unknown : factor;
}

FlowFactors flow_factors(const Field& gap, const Grid2D& grid, const FlowOptions& options) {
  require_gap(gap, grid);
  return flow_through(gap, grid, options, [](Index) { return true; });
}

FlowFactors flow_factors(const NormalContactState& state, const Grid2D& grid,
                         const FlowOptions& options) {
  require_that(state.communicator.alone(), "state",
               "is spread over several processes, but a flow needs the whole grid");
  require_gap(state.gap, grid);
  const double* pressure = state.contact_pressure.data();
  return flow_through(state.gap, grid, options, [&](Index k) { return !(pressure[k] > 0); });
}

}  // namespace salebra
