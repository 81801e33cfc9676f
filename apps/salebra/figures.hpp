// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/contact.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/plot.hpp"

namespace salebra {
struct DamperSolution;
struct FrictionMap;
struct StressMap;
struct TrajectoryDamping;
}  // namespace salebra

/// The pictures of the commands about damping.
namespace salebra::cli {

/// The axis of a quantity by its name in JSON and files.
PlotAxis axis_of(std::string_view quantity, bool logarithmic = false);
/// Whether positive values span more than a decade and a half.
bool spans_decades(const std::vector<double>& values);

/// An indenter at rest, Fig. 1: profile and deformed surface, the one-dimensional image on its
/// springs, pressure, F(δ) with a(δ).
Figure contact_figure(const IndenterLaw& law, double indentation);

/// One period, Fig. 2: the path of a point of the body with the spring that it takes along and lets
/// go, the loop F_x(x), W(t).
Figure cycle_figure(const SampledMotion& path, const TrajectoryDamping& loss);

/// W and its small-amplitude form, their ratio, γ where it is known, over the quantity that varies.
Figure damping_figure(const std::string& quantity, const std::vector<double>& values,
                      const std::vector<DampingResult>& results);

/// Fig. 4: τ and p over radius and phase, and τ(r) at two phases: while pressing in, and while
/// pulling out.
Figure stress_figure(const IndenterLaw& law, double indentation, const Oscillation& motion,
                     const StressMap& map);

/// W(μ)/W(∞) over M and φ0 with the lines of 1, 5 and 10 % off; what is missing to 1 over M; slip
/// and relaxation apart.
Figure friction_figure(const FrictionMap& map);

/// γ over u_z and ω, with the border of stability where a falling slope is given, or a line where
/// only one of them varies; free decay of the oscillator; the least amplitude that stabilises over
/// the frequencies. No panel where there is but one number.
Figure damper_figure(const DamperSolution& answer, std::optional<double> falling_slope,
                     const std::vector<double>& angular_frequency);

}  // namespace salebra::cli
