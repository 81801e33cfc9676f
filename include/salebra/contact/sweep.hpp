// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <salebra/base/communicator.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <vector>

namespace salebra {

/// Options of a load sweep: what to compute at each load, and how many loads to solve at once.
struct SweepOptions {
  /// on_progress reports finished loads, with stage "sweep"; if it returns false, the loads
  /// finished by then are returned.
  NormalContactOptions contact = {};
  /// Computes K by a punch solve on each contact set, and K_t = (G*/E*)K if G* is known.
  bool stiffness = true;
  /// Computes K_t by a stick solve on each contact set instead of (G*/E*)K; this needs `stiffness`,
  /// and a material with known Cerruti constants (made from the bodies or from Poisson's ratio).
  bool stick = false;
  /// Direction of this K_t, from the x axis, rad. A direction other than x costs two stick solves.
  double direction = 0;
  /// Number of loads solved at the same time. Each load solved at the same time needs 50 to 60
  /// bytes per cell and uses one thread; 1: the loads are solved one after the other, each with all
  /// threads; 0: as many at once as there are threads.
  int concurrent_loads = 0;
  /// Groups of processes. Each group has the surface distributed over its processes (the
  /// communicator of the surface is groups->own()) and solves its part of the loads; all processes
  /// get all samples. Default: one group.
  std::optional<Groups> groups = {};
  /// Called with the index in `pressures` and the state of each load as soon as it has converged,
  /// from several threads at once if loads are concurrent.
  std::function<void(std::size_t, const NormalContactState&)> on_state = {};
  /// Called after on_state with the same arguments, K in N/m, and dp/dδ of each cell in Pa/m, for
  /// loads whose K was computed.
  std::function<void(std::size_t, const NormalContactState&, double, const Field&)> on_stiffness =
      {};
};

/// Converts one contact to a sample of a curve, with the stiffnesses that `options` requests; its
/// concurrent_loads, groups and callbacks are not used. Collective if the surface is distributed.
ForceSample force_sample(const NormalContactState& state, const Surface& surface,
                         const Material& material, const SweepOptions& options);
/// The same with K_t in each of several directions, rad, which replace options.direction: one
/// sample for each, for the cost of two stick solves in all.
std::vector<ForceSample> force_samples(const NormalContactState& state, const Surface& surface,
                                       const Material& material, const SweepOptions& options,
                                       const std::vector<double>& directions);

/// As above for any body. K and K_t are measured from the body's datum. Except for half-spaces, K_t
/// needs options.stick, since no ratio of moduli gives it, and is NaN otherwise.
ForceSample force_sample(const NormalContactState& state, const Surface& surface, const Body& body,
                         const SweepOptions& options);
std::vector<ForceSample> force_samples(const NormalContactState& state, const Surface& surface,
                                       const Body& body, const SweepOptions& options,
                                       const std::vector<double>& directions);

/// Computes the force–gap curve of a surface by boundary elements:
///     const ForceCurve curve = sweep_pressures(surface, material, {1e6, 2e6, 5e6, 1e7});
/// Each pressure is solved independently of the others, in parallel over loads; starting from
/// coarser grids is not slower than starting from the solution of a neighbouring load. If the
/// surface is distributed over processes, the call is collective and solves one load after the
/// other. Samples do not depend on the number of processes and groups, except for K and K_t of
/// isolated surfaces (Boundary::free), because a single process solves these on the part of the
/// grid that the contact spans. pressures: > 0, Pa, increasing. Samples that did not converge are
/// kept and marked. With a hardness this is the curve of first loading; the unloading curve is the
/// elastic sweep of after_first_loading() (contact/normal/first_loading.hpp). Throws InvalidInput,
/// before any computation, for invalid arguments.
ForceCurve sweep_pressures(const Surface& surface, const Material& material,
                           const std::vector<double>& pressures, const SweepOptions& options = {});
/// The same contacts with K_t in each of several directions, rad, which replace options.direction:
/// one curve for each direction.
///     const std::vector<ForceCurve> curves =
///         sweep_directions(surface, material, {1e6, 2e6}, {0, std::numbers::pi / 2}, {.stick = true});
/// Each contact is solved once, with two stick solves.
std::vector<ForceCurve> sweep_directions(const Surface& surface, const Material& material,
                                         const std::vector<double>& pressures,
                                         const std::vector<double>& directions,
                                         const SweepOptions& options = {});

/// As above for any body, with the samples of force_sample() for that body:
///     const ForceCurve curve = sweep_pressures(surface, coated, {1e6, 2e6, 5e6}, {.stick = true});
ForceCurve sweep_pressures(const Surface& surface, const Body& body,
                           const std::vector<double>& pressures, const SweepOptions& options = {});
std::vector<ForceCurve> sweep_directions(const Surface& surface, const Body& body,
                                         const std::vector<double>& pressures,
                                         const std::vector<double>& directions,
                                         const SweepOptions& options = {});

}  // namespace salebra
