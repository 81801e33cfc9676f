// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/contact.hpp>
#include <salebra/analysis/damping.hpp>
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

/// The axis of a quantity that has this name in JSON and files.
PlotAxis axis_of(std::string_view quantity, bool logarithmic = false);
/// Whether positive values span more than 1.5 decades.
bool spans_decades(const std::vector<double>& values);

/// An indenter at rest (Fig. 1 of the paper): its profile and the deformed surface, the
/// one-dimensional image on its springs, the pressure, and force F(δ) with contact radius a(δ).
Figure contact_figure(const IndenterLaw& law, double indentation);

/// One period of a motion (Fig. 2 of the paper): the path of a point of the body with the spring
/// that it carries and releases, the loop F_x(x), and the cumulative loss W(t).
Figure cycle_figure(const SampledMotion& path, const TrajectoryDamping& loss);

/// The loss W and its small-amplitude formula, their ratio and, if known, the damping constant γ,
/// over the quantity of which `values` has several values.
Figure damping_figure(const std::string& quantity, const std::vector<double>& values,
                      const std::vector<DampingResult>& results);

/// Fig. 4 of the paper: shear stress τ and pressure p over radius and phase, and τ(r) at two
/// phases, one while the indenter is pressed in and one while it is pulled out.
Figure stress_figure(const IndenterLaw& law, double indentation, const Oscillation& motion,
                     const StressMap& map);

/// The loss with friction divided by the loss without slip, W(μ)/W(∞), over the friction number M =
/// μu_zK/(u_xK_t) and the phase φ0, with lines at which it deviates from 1 by 1, 5 and 10 %.
/// Further panels: this deviation over M; the parts of slip and relaxation.
Figure friction_figure(const FrictionMap& map);

/// Damping constant γ over u_z and ω, with the limit of stable sliding if a falling slope of
/// friction is given; a line if only one of u_z and ω varies. Further panels: free decay of the
/// oscillator; the smallest stabilising amplitude over the frequency. A result that is a single
/// number has no panel.
Figure damper_figure(const DamperSolution& answer, std::optional<double> falling_slope,
                     const std::vector<double>& angular_frequency);

}  // namespace salebra::cli
