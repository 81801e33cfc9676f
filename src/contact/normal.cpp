// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal.hpp>

#include "nested_contact.hpp"

namespace salebra {
namespace {

using detail::ActiveSetCg;
using detail::ActiveSetLimits;
using detail::ActiveSetOutcome;
using detail::ContactLevel;
using detail::ContactTarget;

// Coarse levels only give a start: solving them further gains nothing.
constexpr double coarse_tolerance = 1e-3;
// Part of a full Jacobi step that the prolongation takes.
constexpr double prediction = 0.6;

double mean_of(const Field& field) {
  return parallel::sum_slabs(
             field.rows(),
             [&](Index begin, Index end) { return field.middleRows(begin, end - begin).sum(); }) /
         static_cast<double>(field.size());
}

double greatest_of(const Field& field) {
  return -parallel::min_slabs(
      field.rows(),
      [&](Index begin, Index end) { return -field.middleRows(begin, end - begin).maxCoeff(); },
      field.size());
}

double rms_about(const Field& field, double mean) {
  return std::sqrt(parallel::sum_slabs(
                       field.rows(),
                       [&](Index begin, Index end) {
                         return (field.middleRows(begin, end - begin) - mean).square().sum();
                       },
                       field.size()) /
                   static_cast<double>(field.size()));
}

void check(const Surface& surface, double contact_modulus, const NormalContactOptions& options) {
  surface.require_complete("a contact calculation");
  require_positive(contact_modulus, "contact_modulus");
  require(options.tolerance >= 1e-14 && options.tolerance <= 1e-1, "tolerance", options.tolerance,
          "must lie in 1e-14 … 1e-1");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "must be >= 1");
  require(options.hardness > 0, "hardness", options.hardness, "must be > 0");
  if (const Field* start = options.initial_pressure)
    require(start->rows() == surface.grid.nx && start->cols() == surface.grid.ny &&
                start->isFinite().all() && start->minCoeff() >= 0,
            "initial_pressure", start->size(),
            "cells must fill the grid with finite pressures >= 0");
}

// Heights stay in metres; pressures are counted in E*/(cell size), which makes Gp a number of order p whatever the units.
struct Scaled {
  Grid2D grid;           // in cell sizes
  double pressure_unit;  // Pa
  explicit Scaled(const Grid2D& physical, double contact_modulus) {
    const double cell = std::sqrt(physical.cell_area());
    grid = {physical.nx, physical.ny, physical.lx / cell, physical.ly / cell};
    pressure_unit = contact_modulus / cell;
  }
};

struct Solution {
  Field pressure, gap;  // gap = Gp − h, not yet counted from the level
  ActiveSetOutcome outcome;
};

// From the coarsest level to the finest.
template <class Real>
Solution solve_nested(const Scaled& scaled, const Field& heights, double rms_height,
                      const ContactTarget& target, const NormalContactOptions& options) {
  auto levels =
      detail::contact_levels(scaled.grid, heights, options.boundary,
                             options.initial_pressure ? 1 : std::numeric_limits<int>::max());
  Solution solution;
  for (std::size_t k = levels.size(); k-- > 0;) {
    const ContactLevel& level = levels[k];
    const Index nx = level.grid.nx, ny = level.grid.ny;
    Field pressure;
    if (options.initial_pressure) {
      pressure = (*options.initial_pressure / scaled.pressure_unit).min(target.bound);
    } else if (k + 1 == levels.size()) {
      pressure = Field::Constant(
          nx, ny, target.kind == ContactTarget::Kind::mean_pressure ? target.value : 0.0);
    } else {
      pressure.resize(nx, ny);
      const double step = prediction / cell_compliance(level.grid, 1);
      detail::prolong(levels[k + 1], solution.pressure, solution.gap, solution.outcome.level, level,
                      options.boundary, step, pressure.data());
    }
    solution.pressure = std::move(pressure);
    solution.gap = Field(nx, ny);
    ActiveSetLimits limits{
        k == 0 ? options.tolerance : std::max(coarse_tolerance, options.tolerance),
        options.max_iterations, k == 0};
    if (options.on_progress)
      limits.keep_going = [&](int iteration, double residual) {
        const double decades = std::log10(std::clamp(residual, options.tolerance, 1.0));
        const double share = k == 0 ? decades / std::log10(options.tolerance) : 0.0;
        return options.on_progress(
            {"contact", std::isfinite(share) ? share : 0.0, iteration, residual});
      };
    ActiveSetCg<Real> solver(level.grid, 1, options.boundary, level.heights, rms_height);
    solution.outcome = solver.solve(target, limits, solution.pressure.data(), solution.gap.data());
    if (solution.outcome.interrupted && k > 0) {
      // Nothing on the finest grid to show: an empty contact that says so.
      solution.pressure = Field::Zero(heights.rows(), heights.cols());
      solution.gap = -heights;
      solution.outcome.level = -greatest_of(heights);
      solution.outcome.converged = false;
      break;
    }
  }
  return solution;
}

NormalContactState state_of(Solution&& solution, const ContactTarget& target, const Scaled& scaled,
                            const Surface& surface, double hardness) {
  NormalContactState state;
  const ActiveSetOutcome& outcome = solution.outcome;
  const Field& heights = surface.heights;
  const auto slabs = [&](auto body) {
    return parallel::sum_slabs(
        heights.rows(),
        [&](Index begin, Index end) {
          const Index rows = end - begin;
          return body(solution.pressure.middleRows(begin, rows),
                      solution.gap.middleRows(begin, rows), heights.middleRows(begin, rows));
        },
        heights.size());
  };
  const double pressure_sum = slabs([](auto p, auto, auto) { return p.sum(); });
  const double contact =
      slabs([](auto p, auto, auto) { return static_cast<double>((p > 0).count()); });
  const double work = slabs([](auto p, auto g, auto h) { return (p * (g + h)).sum(); });
  const double points = static_cast<double>(heights.size());
  // A saturated cell sinks in: what is below the plane there is plastic flow, not a gap.
  const double gap_sum = parallel::sum_slabs(
      heights.rows(),
      [&](Index begin, Index end) {
        double sum = 0;
        for (Index k = begin * heights.cols(); k < end * heights.cols(); ++k) {
          double &gap = solution.gap.data()[k], &pressure = solution.pressure.data()[k];
          const bool flows = pressure >= target.bound;
          gap = flows ? 0 : gap - outcome.level;
          pressure = flows ? hardness : pressure * scaled.pressure_unit;
          sum += gap;
        }
        return sum;
      },
      heights.size());
  state.pressure = std::move(solution.pressure);
  state.gap = std::move(solution.gap);
  state.mean_pressure = pressure_sum / points * scaled.pressure_unit;
  state.force = state.mean_pressure * surface.grid.area();
  state.mean_gap = gap_sum / points;
  state.indentation = greatest_of(heights) + outcome.level;
  state.contact_area_fraction = contact / points;
  state.elastic_energy = 0.5 * work * scaled.pressure_unit * surface.grid.cell_area();
  state.residual = outcome.residual;
  state.iterations = outcome.iterations;
  state.fft_count = outcome.fft_count;
  state.converged = outcome.converged;
  state.interrupted = outcome.interrupted;
  return state;
}

// A plane touches everywhere under any pressure.
NormalContactState full_contact_of_plane(const Surface& surface, double nominal_pressure) {
  NormalContactState state;
  state.pressure = Field::Constant(surface.grid.nx, surface.grid.ny, nominal_pressure);
  state.gap = Field::Zero(surface.grid.nx, surface.grid.ny);
  state.mean_pressure = nominal_pressure;
  state.force = nominal_pressure * surface.grid.area();
  state.contact_area_fraction = 1;
  state.converged = true;
  return state;
}

NormalContactState press(const Surface& surface, const Scaled& scaled, double rms_height,
                         const ContactTarget& target, const NormalContactOptions& options) {
  auto solution = options.precision == Precision::mixed
                      ? solve_nested<float>(scaled, surface.heights, rms_height, target, options)
                      : solve_nested<double>(scaled, surface.heights, rms_height, target, options);
  return state_of(std::move(solution), target, scaled, surface, options.hardness);
}

// Contact with the plane at a height of `level` below the zero of −heights, where the gap Gp − h counts from.
NormalContactState press_to_level(const Surface& surface, double contact_modulus, double mean,
                                  double level, const NormalContactOptions& options) {
  const Scaled scaled(surface.grid, contact_modulus);
  const ContactTarget target{ContactTarget::Kind::level, level,
                             options.hardness / scaled.pressure_unit};
  return press(surface, scaled, rms_about(surface.heights, mean), target, options);
}

}  // namespace

NormalContactState press_to_pressure(const Surface& surface, double contact_modulus,
                                     double nominal_pressure, const NormalContactOptions& options) {
  check(surface, contact_modulus, options);
  require_positive(nominal_pressure, "nominal_pressure");
  require(nominal_pressure < options.hardness, "hardness", options.hardness,
          "must exceed the nominal pressure: no contact carries more than its hardness");
  const double rms_height = rms_about(surface.heights, mean_of(surface.heights));
  if (!(rms_height > 0) && options.boundary == Boundary::periodic)
    return full_contact_of_plane(surface, nominal_pressure);
  const Scaled scaled(surface.grid, contact_modulus);
  const ContactTarget target{ContactTarget::Kind::mean_pressure,
                             nominal_pressure / scaled.pressure_unit,
                             options.hardness / scaled.pressure_unit};
  // A flat punch has no roughness to compare a gap with: its cells are the only length there is.
  return press(surface, scaled, rms_height > 0 ? rms_height : std::sqrt(surface.grid.cell_area()),
               target, options);
}

NormalContactState press_to_mean_gap(const Surface& surface, double contact_modulus,
                                     double mean_gap, const NormalContactOptions& options) {
  check(surface, contact_modulus, options);
  require(options.boundary == Boundary::periodic, "boundary", "free",
          "has no mean gap; give a force or an indentation");
  require(std::isinf(options.hardness), "hardness", options.hardness,
          "makes the mean gap depend on more than the approach; give a pressure or an indentation");
  require_positive(mean_gap, "mean_gap");
  const double mean = mean_of(surface.heights);
  const double first_touch = greatest_of(surface.heights) - mean;
  require(mean_gap < first_touch, "mean_gap", mean_gap,
          fmt::format("must be below {} m, where the highest point first touches", first_touch));
  // The mean of Gp is zero, so the mean of the gap Gp − h − level is −mean − level.
  return press_to_level(surface, contact_modulus, mean, -mean - mean_gap, options);
}

NormalContactState press_to_indentation(const Surface& surface, double contact_modulus,
                                        double indentation, const NormalContactOptions& options) {
  check(surface, contact_modulus, options);
  require_positive(indentation, "indentation");
  const double mean = mean_of(surface.heights), highest = greatest_of(surface.heights);
  require(options.boundary == Boundary::free || indentation < highest - mean, "indentation",
          indentation,
          fmt::format("must be below {} m, where a periodic contact is full", highest - mean));
  return press_to_level(surface, contact_modulus, mean, indentation - highest, options);
}

}  // namespace salebra
