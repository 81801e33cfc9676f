// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/sliding.hpp>
#include <vector>

#include "io/plot.hpp"

namespace salebra::cli {

/// Friction and losses over the velocity, for one amplitude.
Figure sliding_figure(const std::vector<SlidingPoint>& points, double friction);
/// Mean friction and its derivative with respect to the velocity, over velocity and normal
/// amplitude.
Figure amplitude_figure(const std::vector<SlidingPoint>& points, const SlidingProblem& problem);
/// Loss with slip divided by the loss without slip, over velocity and excursion, with the borders
/// of the regimes (no slip, partial slip, lifts off, sliding). omega: angular frequency, rad/s.
Figure regime_figure(const RegimeMap& map, double omega);
/// Velocity and spring force of a slider over the time, by the full and by the averaged equation.
/// stiffness: of its spring, N/m.
Figure slider_figure(const SliderMotion& full, const SliderMotion& averaged, double stiffness);

}  // namespace salebra::cli
