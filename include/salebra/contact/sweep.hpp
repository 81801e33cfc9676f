// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <salebra/base/communicator.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <vector>

namespace salebra {

/// What is computed at each load, and how many loads at once.
struct SweepOptions {
  /// on_progress is told of finished loads, with stage "sweep"; when it returns false, the loads
  /// finished by then are returned.
  NormalContactOptions contact = {};
  bool stiffness =
      true;  ///< K by a punch solve on each contact set, and K_t = (G*/E*)K where G* is known
  /// Solves for K_t along x by a stick solve on each contact set instead of (G*/E*)K; needs
  /// stiffness, and the bodies or Poisson's ratio.
  bool stick = false;
  /// Loads solved at the same time, each with 50 to 60 bytes a cell of its own and on one thread
  /// while there are others that wait; 1 gives all threads to one load after the other; 0: as many
  /// as there are threads.
  int concurrent_loads = 0;
  /// Groups of processes, each of which holds the surface, spread over the group (`ranks` of the
  /// surface is groups->own()). Each group solves some of the loads, one after the other; all
  /// processes get all samples. Default: one group.
  std::optional<Groups> groups = {};
  /// Called with the place in `pressures` and the state of each load that converged, as soon as it
  /// is there: from several threads at once where loads are concurrent.
  std::function<void(std::size_t, const NormalContactState&)> on_state = {};
};

/// What a curve holds of one contact, with the stiffnesses that the options ask for; the concurrent
/// loads, groups and calls among them are not used. Collective where the surface is spread.
ForceSample force_sample(const NormalContactState& state, const Surface& surface,
                         const Material& material, const SweepOptions& options);

/// Force–gap curve of a surface by boundary elements, one independent solve for each pressure, in
/// parallel over loads: a solve that starts from its own coarse grids is not slower than one that
/// starts from the neighbouring load. A surface may be spread over several processes: the call is
/// then collective, and solves one load after the other. Samples do not depend on the number of
/// processes and groups, but for K and K_t of isolated surfaces: alone, these are solved on the
/// cells that the contact spans. pressures: > 0, Pa, increasing. Samples that did not converge are
/// kept and marked. With a hardness this is the curve of first loading; that of unloading is the
/// elastic sweep of after_first_loading() (contact/normal/first_loading.hpp).
/// throws InvalidInput before any work
ForceCurve sweep_pressures(const Surface& surface, const Material& material,
                           const std::vector<double>& pressures, const SweepOptions& options = {});

}  // namespace salebra
