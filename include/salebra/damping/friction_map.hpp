// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/oscillation.hpp>
#include <vector>

namespace salebra {

struct FrictionMapOptions {
  int steps = 1000;  ///< straight steps per cycle; W(μ)/W(∞) converges at second order in them
  Progress on_progress = {};
};

/// Validity of the paper's "infinite" friction at equal frequencies: losses over the full-stick
/// loss at the same u_z, u_x and phase.
struct FrictionMap {
  std::vector<double> friction_number;  ///< M = μE*u_z/(G*u_x)
  std::vector<double> phase;            ///< φ0, rad
  Field loss_ratio;                     ///< W(μ)/W(∞), (friction numbers, phases)
  Field relaxation_ratio;               ///< part of it from springs that open and close
  Field slip_ratio;                     ///< part of it from slip in permanent contact
};

constexpr void describe(auto&& visit, std::type_identity<FrictionMap>) {
  using enum Dimension;
  using S = FrictionMap;
  visit(&S::friction_number, Quantity{"friction_number", dimensionless, "M = mu E* u_z/(G* u_x)"});
  visit(&S::phase, Kept{"phase", "phases between the oscillations", angle});
  visit(&S::loss_ratio, Quantity{"loss_ratio", dimensionless, "W(mu)/W(infinity)"});
  visit(&S::relaxation_ratio,
        Quantity{"relaxation_ratio", dimensionless, "part of it from springs that open and close"});
  visit(&S::slip_ratio,
        Quantity{"slip_ratio", dimensionless, "part of it from slip in permanent contact"});
}

/// Computes the losses for all friction numbers and phases, in parallel. Phases with sin φ0 = 0
/// have no relaxation loss and give NaN.
///
///     FrictionMap map = friction_map(law, 1e-8, 1e-9, 1e-10, {0.3, 1, 3, 10}, {1.57});
///
/// Cost: steps × 2 for each entry.
/// Throws InvalidInput for friction numbers < 0, amplitudes that are not > 0, and motion outside
/// the law.
FrictionMap friction_map(const ContactLaw& law, double mean_indentation, double normal_amplitude,
                         double tangential_amplitude, const std::vector<double>& friction_numbers,
                         const std::vector<double>& phases, const FrictionMapOptions& options = {});

}  // namespace salebra
