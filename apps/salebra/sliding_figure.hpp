// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/sliding.hpp>
#include <vector>

#include "io/plot.hpp"

namespace salebra::cli {

/// Friction and losses over the velocity, of one amplitude.
Figure sliding_figure(const std::vector<SlidingPoint>& points, double friction);
/// Friction and its growth over velocity and amplitude.
Figure amplitude_figure(const std::vector<SlidingPoint>& points, const SlidingProblem& problem);
/// Loss ratio over velocity and excursion, with the borders of the regimes.
Figure regime_figure(const RegimeMap& map, double omega);
/// Velocity and spring force over time. stiffness: of the spring.
Figure slider_figure(const SliderMotion& full, const SliderMotion& averaged, double stiffness);

}  // namespace salebra::cli
