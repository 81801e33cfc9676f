// SPDX-License-Identifier: GPL-3.0-or-later
// Residual surface after a first loading with a limit of the pressure, the hardness.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <utility>

#include "base/memory.hpp"
#include "contact/half_space/half_space.hpp"

namespace salebra {
namespace {

/// Lowers each cell that yielded by its plastic depth, and returns the yielded area, the mean and
/// the maximum plastic depth.
FirstLoading sink_in(Field& heights, const Field& displacement, const NormalContactState& state,
                     double bound) {
  const double highest = heights.maxCoeff();
  struct Sums {
    double cells = 0, depth = 0, deepest = 0;
  };
  Sums total;
  for (const Sums& part : parallel::map_blocks<Sums>(
           heights.rows(),
           [&](Index begin, Index end) {
             Sums sums;
             for (Index k = begin * heights.cols(); k < end * heights.cols(); ++k) {
               if (state.contact_pressure.data()[k] < bound) continue;
               double& height = heights.data()[k];
               // A saturated cell may lie above the contact plane by the tolerance of the solver.
               const double depth =
                   std::max(0.0, height - highest + state.indentation - displacement.data()[k]);
               height -= depth;
               sums.cells += 1;
               sums.depth += depth;
               sums.deepest = std::max(sums.deepest, depth);
             }
             return sums;
           },
           heights.size())) {
    total.cells += part.cells;
    total.depth += part.depth;
    total.deepest = std::max(total.deepest, part.deepest);
  }
  const auto cells = static_cast<double>(heights.size());
  return {.pressure = state.mean_pressure,
          .yielded_area_fraction = total.cells / cells,
          .mean_plastic_depth = total.depth / cells,
          .max_plastic_depth = total.deepest};
}

// The largest load of the oscillation may exceed that of the first loading by at most this
// fraction.
constexpr double load_tolerance = 1e-3;
constexpr int max_loadings = 20;

/// Returns the contact of the residual surface at the highest load of an oscillation about the
/// nominal pressure, without further plastic flow; nothing if this contact is full. loaded: the
/// contact that left the residual surface; unchanged: whether this is the contact at the nominal
/// pressure and no cell yielded.
std::optional<NormalContactState> at_top(const Surface& surface, double contact_modulus,
                                         double nominal_pressure, double normal_amplitude,
                                         const NormalContactState& loaded, bool unchanged,
                                         NormalContactOptions options) {
  options.hardness = std::numeric_limits<double>::infinity();
  double mean = loaded.indentation;
  if (!unchanged) {
    options.initial_pressure = &loaded.contact_pressure;
    const NormalContactState unloaded =
        press(surface, contact_modulus, at_pressure(nominal_pressure), options);
    if (!unloaded.converged()) return unloaded;
    mean = unloaded.indentation;
    options.initial_pressure = nullptr;
  }
  const double top = mean + normal_amplitude;
  if (options.boundary == Boundary::periodic &&
      top >= (surface.heights.maxCoeff() - surface.heights).mean())
    return {};
  return press(surface, contact_modulus, at_indentation(top), options);
}

}  // namespace

namespace {

// The pressures `traction` displace the body elastically; where the pressure reaches the bound, the
// rest of the depth is plastic.
ResidualSurface residual_of(Surface surface, double contact_modulus,
                            const NormalContactState& state, const Field& traction, double bound,
                            Boundary boundary) {
  surface.require_whole("a residual surface");
  require(state.contact_pressure.rows() == surface.grid.nx &&
              state.contact_pressure.cols() == surface.grid.ny,
          "pressure", state.contact_pressure.size(), "points do not fill the grid");
  ResidualSurface residual{
      .surface = std::move(surface), .first_loading = {}, .termination = state.termination};
  if (!state.converged()) return residual;
  if ((state.contact_pressure < bound).all()) {
    residual.first_loading = {.pressure = state.mean_pressure,
                              .yielded_area_fraction = 0,
                              .mean_plastic_depth = 0,
                              .max_plastic_depth = 0};
    return residual;
  }
  const Grid2D& grid = residual.surface.grid;
  require_memory(grid, 3 * sizeof(double) * static_cast<double>(grid.points()),
                 "a residual surface");
  Field displacement(grid.nx, grid.ny);
  normal_compliance<double>(grid, contact_modulus, boundary)
      .apply(traction.data(), displacement.data());
  residual.first_loading = sink_in(residual.surface.heights, displacement, state, bound);
  return residual;
}

}  // namespace

ResidualSurface residual_surface(Surface surface, double contact_modulus,
                                 const NormalContactState& state,
                                 const NormalContactOptions& options) {
  return residual_of(std::move(surface), contact_modulus, state, state.contact_pressure,
                     options.hardness, options.boundary);
}

ResidualSurface residual_surface(Surface surface, double contact_modulus,
                                 const AdhesiveContactState& state, const Adhesion& adhesion,
                                 const NormalContactOptions& options) {
  return residual_of(std::move(surface), contact_modulus, state,
                     state.contact_pressure - state.tension,
                     adhesion.pressure_bound(options.hardness), options.boundary);
}

ResidualSurface after_first_loading(Surface surface, double contact_modulus,
                                    double nominal_pressure, const NormalContactOptions& options,
                                    double normal_amplitude) {
  surface.require_whole("a residual surface");
  require(normal_amplitude >= 0 && normal_amplitude < std::numeric_limits<double>::infinity(),
          "normal_amplitude", normal_amplitude, "must be finite and >= 0");
  NormalContactState state =
      press(surface, contact_modulus, at_pressure(nominal_pressure), options);
  if (normal_amplitude == 0)
    return residual_surface(std::move(surface), contact_modulus, state, options);
  ResidualSurface residual = residual_surface(surface, contact_modulus, state, options);
  for (int loading = 1; residual.converged(); ++loading) {
    const std::optional<NormalContactState> top =
        at_top(residual.surface, contact_modulus, nominal_pressure, normal_amplitude, state,
               loading == 1 && !residual.first_loading.yielded(), options);
    if (!top) return residual;
    residual.termination = top->converged() && loading >= max_loadings
                               ? Termination::iteration_limit
                               : top->termination;
    if (!residual.converged()) return residual;
    const double load = top->mean_pressure;
    if (!residual.first_loading.yielded() && (top->contact_pressure < options.hardness).all()) {
      residual.first_loading.pressure = load;
      return residual;
    }
    if (load <= (1 + load_tolerance) * residual.first_loading.pressure) return residual;
    require(load < options.hardness, "hardness",
            format_quantity(options.hardness, Dimension::pressure),
            fmt::format("must exceed the largest mean pressure of the oscillation, {}; reduce the "
                        "load or the normal amplitude",
                        format_quantity(load, Dimension::pressure)));
    NormalContactOptions further = options;
    further.initial_pressure = &top->contact_pressure;
    state = press(surface, contact_modulus, at_pressure(load), further);
    residual = residual_surface(surface, contact_modulus, state, options);
  }
  return residual;
}

}  // namespace salebra
