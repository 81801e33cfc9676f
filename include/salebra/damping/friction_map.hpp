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
  int steps = 1000;  ///< straight steps per cycle; the error is of second order in 1/steps
  Progress on_progress = {};
};

/// How far the paper's assumption of infinite friction holds at equal frequencies: the loss with
/// friction over the loss in full stick (W(∞)) at the same u_z, u_x and phase.
struct FrictionMap {
  std::vector<double> friction_number;  ///< M = μE*u_z/(G*u_x)
  std::vector<double> phase;            ///< φ0, rad
  Field loss_ratio;                     ///< W(μ)/W(∞), (friction numbers, phases)
  Field relaxation_ratio;               ///< part of loss_ratio from springs that open and close
  Field slip_ratio;                     ///< part of loss_ratio from slip in permanent contact
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

/// Computes the loss ratios for all friction numbers M = μE*u_z/(G*u_x) and phases φ0, in parallel.
/// Phases with sin φ0 = 0 have no relaxation loss and give NaN.
///
///     FrictionMap map = friction_map(law, 1e-8, 1e-9, 1e-10, {0.3, 1, 3, 10}, {1.57});
///
/// Cost: two cycles of `steps` steps for each entry. Throws InvalidInput for friction numbers < 0,
/// amplitudes that are not > 0, and a motion that leaves the range of the law.
FrictionMap friction_map(const ContactLaw& law, double mean_indentation, double normal_amplitude,
                         double tangential_amplitude, const std::vector<double>& friction_numbers,
                         const std::vector<double>& phases, const FrictionMapOptions& options = {});

}  // namespace salebra
