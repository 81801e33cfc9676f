// SPDX-License-Identifier: GPL-3.0-or-later
// Normal contact of a surface at a given pressure, mean gap, indentation or force, from the
// coarsest grid to the finest.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <vector>

#include "base/memory.hpp"
#include "base/stage_time.hpp"
#include "contact_memory.hpp"
#include "nested_contact.hpp"

namespace salebra {
namespace {

using detail::ActiveSetCg;
using detail::ActiveSetLimits;
using detail::ActiveSetOutcome;
using detail::Heights;
using detail::MultigridLevel;
using detail::ScaledOperatingPoint;

// Tolerance of solves on coarse grids, which only give a start: solving them more accurately gains
// nothing.
constexpr double coarse_tolerance = 1e-3;
// Fraction of a full Jacobi step, (gap)/(cell compliance), that corrects the pressure interpolated
// from the coarser grid.
constexpr double prediction = 0.6;
// Cells whose initial pressure is the hardness, up to rounding to float, start as saturated:
// finding out that they are costs more iterations than the start saves.
constexpr double full_from = 1 - double(std::numeric_limits<float>::epsilon());

// Quantities of the heights that the operating point needs, counted downwards from the highest
// point.
struct Depths {
  double highest = 0;  // height of the highest point, where the plane first touches
  double mean = 0;     // mean of highest − h: the mean gap at first touch
  double rms = 0;      // h_rms

  explicit Depths(const Surface& surface) {
    const double points = static_cast<double>(surface.grid.points());
    double origin = surface.communicator.is_root() ? surface.heights(0, 0) : 0;
    surface.communicator.broadcast(&origin, sizeof origin);
    // Heights count from one of them, so that a large mean does not cost precision.
    Sums total;
    total.highest = origin;
    for (const Sums& part : sums(surface, origin)) {
      total.highest = std::max(total.highest, part.highest);
      total.first += part.first;
    }
    highest = total.highest;
    const double mean_height = origin + total.first / points;
    mean = (highest - origin) - total.first / points;
    double square = 0, first = 0;
    for (const Sums& part : sums(surface, mean_height)) {
      square += part.second;
      first += part.first;
    }
    const double mean_square = square / points;
    require(mean_square < 1e200, "rms height", std::sqrt(mean_square),
            "must be below 1e100 m; check the unit of the heights");
    rms = std::sqrt(std::max(0.0, mean_square - first / points * (first / points)));
  }

 private:
  struct Sums {
    double highest = 0, first = 0, second = 0;  // maximum of h, Σ(h − origin), Σ(h − origin)²
  };
  static std::vector<Sums> sums(const Surface& surface, double origin) {
    const Field& heights = surface.heights;
    return parallel::map_blocks<Sums>(
        surface.partition(),
        [&](Index begin, Index end) {
          // Several partial sums: in a single sum, each addition waits for the one before.
          constexpr Index lanes = 8;
          const double* h = heights.data() + begin * heights.cols();
          const Index count = (end - begin) * heights.cols();
          std::array<double, lanes> top, first{}, second{};
          top.fill(h[0]);
          const auto add = [&](std::size_t lane, double height) {
            const double deviation = height - origin;
            top[lane] = height > top[lane] ? height : top[lane];
            first[lane] += deviation;
            second[lane] += deviation * deviation;
          };
          Index k = 0;
          for (; k + lanes <= count; k += lanes)
            for (Index lane = 0; lane < lanes; ++lane)
              add(static_cast<std::size_t>(lane), h[k + lane]);
          for (; k < count; ++k) add(0, h[k]);
          Sums result{top[0], 0, 0};
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            result.highest = std::max(result.highest, top[lane]);
            result.first += first[lane];
            result.second += second[lane];
          }
          return result;
        },
        heights.size());
  }
};

void check_here(const Surface& surface, double contact_modulus,
                const NormalContactOptions& options) {
  surface.require_complete_rows("a contact calculation");
  require_positive(contact_modulus, "contact_modulus");
  require(options.tolerance >= 1e-14 && options.tolerance <= 1e-1, "tolerance", options.tolerance,
          "must lie in 1e-14 … 1e-1");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "must be >= 1");
  require(options.hardness > 0, "hardness", options.hardness, "must be > 0");
  require(options.checkpoint_every >= 0, "checkpoint_every", options.checkpoint_every,
          "must be >= 0, s");
  if (const Field* start = options.initial_pressure)
    require(start->rows() == surface.heights.rows() && start->cols() == surface.grid.ny &&
                (*start >= 0 && *start <= std::numeric_limits<double>::max()).all(),
            "initial_pressure", start->size(),
            "cells must fill the grid with finite pressures >= 0");
}

void check(const Surface& surface, double contact_modulus, const NormalContactOptions& options) {
  collectively(surface.communicator, [&] { check_here(surface, contact_modulus, options); });
  require_memory(surface.grid, detail::contact_memory(surface, options), "a contact",
                 surface.communicator);
}

// The problem in scaled units. Heights stay in metres; the unit of pressure is E*/(cell size),
// which makes the displacement Gp by a pressure p of the order of p in any system of units.
struct Scaled {
  Grid2D grid;                      // in cell sizes
  double contact_modulus;           // Pa; of a body: detail::reference_modulus()
  double pressure_unit;             // Pa
  detail::NormalResponse response;  // in scaled units
  explicit Scaled(const Grid2D& physical, double modulus, const detail::NormalResponse& body = 1)
      : contact_modulus(modulus), response(body) {
    const double cell = std::sqrt(physical.cell_area());
    grid = {physical.nx, physical.ny, physical.lx / cell, physical.ly / cell};
    pressure_unit = contact_modulus / cell;
  }
};

struct Solution {
  Field pressure, gap;  // displacement − height, not relative to the plane
  ActiveSetOutcome outcome;
};

// Mean depth of the heights below zero, the highest point of the finest grid. It is the mean gap at
// first touch, unless the coarse grid lacks the highest point.
double mean_depth_of(const MultigridLevel& level) {
  const double sum = parallel::sum_blocks(
      level.rows,
      [&](Index begin, Index end) {
        double part = 0;
        for (Index k = begin * level.grid.ny; k < end * level.grid.ny; ++k)
          part -= level.heights[k];
        return part;
      },
      level.rows.count() * level.grid.ny);
  return sum / static_cast<double>(level.grid.points());
}

// Solves a contact on the coarsest grid and on each finer one in turn.
class NestedSolve {
 public:
  struct Problem {
    const Scaled& scaled;
    const RowPartition& rows;
    const Heights& heights;
    double rms_height, mean_depth;
    const ScaledOperatingPoint& target;
    const NormalContactOptions& options;
  };

  explicit NestedSolve(const Problem& problem)
      : problem_(problem),
        levels_(detail::multigrid_levels(
            problem.scaled.grid, problem.rows, problem.heights, problem.options.boundary,
            problem.options.initial_pressure ? 1 : std::numeric_limits<int>::max())) {}

  template <class Real>
  Solution run() {
    const auto& [scaled, rows, heights, rms_height, mean_depth, target, options] = problem_;
    for (std::size_t k = levels_.size(); k-- > 0;) {
      const MultigridLevel& level = levels_[k];
      solution_.pressure = start(k);
      solution_.gap = uninitialised_field(level.rows.count(), level.grid.ny);
      const ActiveSetLimits limits = limits_of(k);
      // The coarser grids are no longer needed; they take 2.7 bytes per cell of the finest grid.
      levels_.erase(levels_.begin() + static_cast<std::ptrdiff_t>(k) + 1, levels_.end());
      ActiveSetCg<Real> solver(level.grid, level.rows, scaled.response, options.boundary,
                               level.heights, rms_height);
      ScaledOperatingPoint target_here = target;
      // A coarse grid has another mean height than the finest one. With the same plane height its
      // contact may be beyond full contact, where no pressure is a solution and CG diverges; a
      // coarse grid is therefore solved for the same mean gap instead.
      if (k > 0 && !target.load_given() && options.boundary == Boundary::periodic)
        target_here.value += mean_depth_of(level) - mean_depth;
      solution_.outcome =
          solver.solve(target_here, limits, solution_.pressure.data(), solution_.gap.data());
      if (solution_.outcome.termination == Termination::interrupted && k > 0) {
        show_nothing();
        break;
      }
    }
    return std::move(solution_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Returns a new field, because the pressure of the coarser grid is still being read.
  Field start(std::size_t k) const {
    const auto& options = problem_.options;
    const auto& target = problem_.target;
    const MultigridLevel& level = levels_[k];
    if (options.initial_pressure) {
      Field pressure = *options.initial_pressure / problem_.scaled.pressure_unit;
      pressure = (pressure < full_from * target.bound).select(pressure, target.bound);
      return pressure;
    }
    if (k + 1 == levels_.size())
      return Field::Constant(level.rows.count(), level.grid.ny,
                             target.load_given() ? target.value : 0.0);
    Field pressure = uninitialised_field(level.rows.count(), level.grid.ny);
    const double step = prediction / detail::cell_compliance(level.grid, problem_.scaled.response);
    detail::prolong(
        {levels_[k + 1], solution_.pressure, solution_.gap, solution_.outcome.plane_height}, level,
        options.boundary, step, pressure.data());
    return pressure;
  }

  ActiveSetLimits limits_of(std::size_t k) {
    const auto& options = problem_.options;
    ActiveSetLimits limits{
        k == 0 ? options.tolerance : std::max(coarse_tolerance, options.tolerance),
        options.max_iterations, k == 0};
    if (k + 1 < levels_.size()) limits.expected_plane_height = solution_.outcome.plane_height;
    if (options.on_progress)
      limits.keep_going = [&options, k](int iteration, double residual) {
        const double decades = std::log10(std::clamp(residual, options.tolerance, 1.0));
        const double share = k == 0 ? decades / std::log10(options.tolerance) : 0.0;
        return options.on_progress(
            {"contact", std::isfinite(share) ? share : 0.0, iteration, residual});
      };
    if (options.on_checkpoint && k == 0) {
      limits.checkpoint_due = [this, &options] {
        const std::chrono::duration<double> elapsed = Clock::now() - last_checkpoint_;
        return !problem_.rows.communicator().is_root() ||
               elapsed.count() >= options.checkpoint_every;
      };
      limits.take_checkpoint = [this, &options] {
        solution_.pressure *= problem_.scaled.pressure_unit;
        options.on_checkpoint(solution_.pressure);
        last_checkpoint_ = Clock::now();
      };
    }
    return limits;
  }

  // Makes a state without contact, for a solve that is interrupted before the finest grid.
  void show_nothing() {
    const Index nx = problem_.rows.count(), ny = problem_.scaled.grid.ny;
    solution_.pressure = Field::Zero(nx, ny);
    solution_.gap =
        Field::NullaryExpr(nx, ny, [&](Index i, Index j) { return -problem_.heights[i * ny + j]; });
    solution_.outcome.plane_height = 0;
  }

  const Problem problem_;
  std::vector<MultigridLevel> levels_;
  Solution solution_;
  Clock::time_point last_checkpoint_ = Clock::now();
};

NormalContactState state_of(Solution&& solution, const ScaledOperatingPoint& target,
                            const Scaled& scaled, const Surface& surface,
                            const Heights& below_summit, double hardness) {
  NormalContactState state;
  const ActiveSetOutcome& outcome = solution.outcome;
  const Field& heights = surface.heights;
  struct Sums {
    double pressure = 0, contact = 0, work = 0, gap = 0;
  };
  Sums total;
  for (const Sums& part : parallel::map_blocks<Sums>(
           surface.partition(),
           [&](Index begin, Index end) {
             Sums sums;
             for (Index k = begin * heights.cols(); k < end * heights.cols(); ++k) {
               double &gap = solution.gap.data()[k], &pressure = solution.pressure.data()[k];
               sums.pressure += pressure;
               sums.contact += pressure > 0 ? 1 : 0;
               sums.work += pressure * (gap + below_summit[k]);
               // A saturated cell sinks in: its depth below the plane is plastic flow, not a gap.
               const bool flows = pressure >= target.bound;
               gap = flows ? 0 : gap - outcome.plane_height;
               pressure = flows ? hardness : pressure * scaled.pressure_unit;
               sums.gap += gap;
             }
             return sums;
           },
           heights.size())) {
    total.pressure += part.pressure;
    total.contact += part.contact;
    total.work += part.work;
    total.gap += part.gap;
  }
  const double points = static_cast<double>(surface.grid.points());
  state.communicator = surface.communicator;
  state.contact_pressure = std::move(solution.pressure);
  state.gap = std::move(solution.gap);
  state.mean_pressure = total.pressure / points * scaled.pressure_unit;
  state.force = state.mean_pressure * surface.grid.area();
  state.mean_gap = total.gap / points;
  state.indentation = outcome.plane_height;
  state.contact_area_fraction = total.contact / points;
  state.elastic_energy = 0.5 * total.work * scaled.pressure_unit * surface.grid.cell_area();
  state.residual = outcome.residual;
  state.iterations = outcome.iterations;
  state.fft_count = outcome.fft_count;
  state.multilevel_count = outcome.multilevel_count;
  // Detects results that are not finite: such numbers pass every comparison of the solver.
  const bool finite = std::isfinite(state.force) && std::isfinite(state.mean_gap) &&
                      std::isfinite(state.elastic_energy);
  if (!finite) state.residual = std::numeric_limits<double>::infinity();
  state.termination = finite || outcome.termination == Termination::interrupted
                          ? outcome.termination
                          : Termination::out_of_range;
  return state;
}

// A flat surface touches everywhere under any pressure.
NormalContactState full_contact_of_plane(const Surface& surface, double nominal_pressure) {
  NormalContactState state;
  state.contact_pressure =
      Field::Constant(surface.heights.rows(), surface.grid.ny, nominal_pressure);
  state.gap = Field::Zero(surface.heights.rows(), surface.grid.ny);
  state.communicator = surface.communicator;
  state.mean_pressure = nominal_pressure;
  state.force = nominal_pressure * surface.grid.area();
  state.contact_area_fraction = 1;
  state.termination = Termination::converged;
  return state;
}

// Solves a contact. Heights count from the highest point, so the height of the plane is the
// indentation.
NormalContactState contact_of(const Surface& surface, const Scaled& scaled, const Depths& depths,
                              const OperatingPoint& point, const NormalContactOptions& options) {
  const ScaledOperatingPoint scaled_point{
      point.control, point.load_given() ? point.value / scaled.pressure_unit : point.value,
      options.hardness / scaled.pressure_unit};
  const Heights heights{surface.heights.data(), depths.highest};
  // A flat punch has no rms height as a length to compare gaps with; its problem is linear, and the
  // displacement serves as this length.
  const double displacement =
      point.load_given() ? point.value / scaled.contact_modulus * std::sqrt(surface.grid.area())
                         : point.value;
  const double length = depths.rms > 0 ? depths.rms : displacement;
  const RowPartition rows = surface.partition();
  const auto solve = [&]<class Real>(Real) {  // levels are freed at return
    return NestedSolve({scaled, rows, heights, length, depths.mean, scaled_point, options})
        .run<Real>();
  };
  auto solution = options.precision == Precision::mixed ? solve(0.0f) : solve(0.0);
  return state_of(std::move(solution), scaled_point, scaled, surface, heights, options.hardness);
}

/// Checks a prescribed load and returns its nominal pressure.
double checked_pressure(const OperatingPoint& point, double area, double contact_modulus,
                        double hardness) {
  const bool by_force = point.control == ControlQuantity::normal_force;
  const char* name = by_force ? "force" : "pressure";
  require_positive(point.value, name);
  const double pressure = by_force ? point.value / area : point.value;
  require(pressure <= 1e12 * contact_modulus, name, point.value,
          fmt::format("must not exceed 1e12 times the contact modulus, {} Pa; check the units",
                      contact_modulus));
  require(
      pressure < hardness, "hardness", format_quantity(hardness, Dimension::pressure),
      fmt::format(
          "must exceed the nominal pressure, {}, because no contact carries more than its hardness",
          format_quantity(pressure, Dimension::pressure)));
  return pressure;
}

/// Checks a prescribed mean gap or indentation and returns the indentation from the mean plane.
/// limited: whether a periodic surface is in full contact at an indentation of `highest`.
double checked_indentation(const OperatingPoint& point, double highest, bool limited) {
  if (point.control == ControlQuantity::mean_gap) {
    require(point.value < highest, "mean_gap", point.value,
            fmt::format("must be below {} m, where the highest point first touches", highest));
    // The mean displacement of a periodic surface is zero, so the approach and the mean gap add up
    // to the mean gap at first touch.
    return highest - point.value;
  }
  require(
      !limited || point.value < highest, "indentation", point.value,
      fmt::format("must be below {} m, at which a periodic surface is in full contact", highest));
  return point.value;
}

}  // namespace

ContactSet contact_set(const NormalContactState& state) { return state.contact_pressure > 0; }

namespace {

// Presses after all checks but those of the operating point. limited: as for checked_indentation().
NormalContactState press_checked(const Surface& surface, const Scaled& scaled,
                                 const OperatingPoint& point, const NormalContactOptions& options,
                                 bool limited) {
  if (point.load_given()) {
    const double nominal =
        checked_pressure(point, surface.grid.area(), scaled.contact_modulus, options.hardness);
    const Depths depths(surface);
    if (!(depths.rms > 0) && options.boundary == Boundary::periodic)
      return full_contact_of_plane(surface, nominal);
    return contact_of(surface, scaled, depths, at_pressure(nominal), options);
  }
  if (point.control == ControlQuantity::mean_gap) {
    require(options.boundary == Boundary::periodic, "boundary", "free",
            "has no mean gap; give a force or an indentation");
    require(std::isinf(options.hardness), "hardness", options.hardness,
            "makes the mean gap depend on the plastic deformation too; give a pressure or an "
            "indentation");
  }
  require_positive(point.value, name_of(point.control));
  const Depths depths(surface);
  return contact_of(surface, scaled, depths,
                    at_indentation(checked_indentation(point, depths.mean, limited)), options);
}

}  // namespace

NormalContactState press(const Surface& surface, double contact_modulus,
                         const OperatingPoint& point, const NormalContactOptions& options) {
  const detail::StageTime time(detail::Stage::contacts);
  check(surface, contact_modulus, options);
  return press_checked(surface, Scaled(surface.grid, contact_modulus), point, options,
                       options.boundary == Boundary::periodic);
}

NormalContactState press(const Surface& surface, const Body& body, const OperatingPoint& point,
                         const NormalContactOptions& options) {
  if (const auto& half_space = body.half_space_material())
    return press(surface, half_space->contact_modulus, point, options);
  detail::require_pressable(body, surface.grid, options.boundary);
  const detail::StageTime time(detail::Stage::contacts);
  // Only a prescribed indentation needs the uniform displacement during the solve. Otherwise it is
  // added to the result, so that both data have the same pressures.
  const bool by_indentation = point.control == ControlQuantity::indentation;
  const double uniform = body.compliance(0).normal;
  const detail::NormalResponse response(body, surface.grid, by_indentation);
  check(surface, response.modulus, options);
  NormalContactState state = press_checked(
      surface, Scaled(surface.grid, response.modulus, response), point, options, !(uniform > 0));
  state.datum = body.datum();
  if (!by_indentation) {
    state.indentation += uniform * state.mean_pressure;
    state.elastic_energy += uniform / 2 * state.mean_pressure * state.force;
  }
  return state;
}

}  // namespace salebra
