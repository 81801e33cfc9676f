// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/force_curve.hpp>
#include <salebra/contact/material.hpp>
#include <salebra/contact/normal.hpp>
#include <vector>

namespace salebra {

struct SweepOptions {
  NormalContactOptions contact = {};
  bool stiffness = true;  ///< K by a punch solve on each contact set, and K_t = (G*/E*)K where G* is known
};

/// Force–gap curve of a surface by boundary elements, one independent solve for each pressure, in parallel over loads.
/// pressures: > 0, Pa, increasing. Samples that did not converge are kept and marked.
ForceCurve sweep_pressures(const Surface& surface, const Material& material,
                           const std::vector<double>& pressures, const SweepOptions& options = {});

}  // namespace salebra
