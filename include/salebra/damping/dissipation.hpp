// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/operating_point.hpp>
#include <salebra/damping/loss.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <span>
#include <vector>

namespace salebra {

/// Returns the indentation δ at an operating point, m, measured as the law measures it. Throws
/// InvalidInput for a pressure or a mean gap, because a law has no area and no gap, and for a force
/// outside the samples of a table.
double indentation_of(const ContactLaw& law, const OperatingPoint& point);

enum class Amplitude {
  small,  ///< Eq. (12) or (15) with F'' of the law: the limit u_z → 0
  finite  ///< exact at every amplitude (docs/theory.md, section 7)
};

template <>
struct EnumNames<Amplitude> {
  static constexpr auto values = std::to_array<std::pair<Amplitude, std::string_view>>(
      {{Amplitude::small, "small"}, {Amplitude::finite, "finite"}});
};

struct DampingOptions {
  /// Hold::indentation: the operating point gives the mean indentation of the cycle. Hold::force:
  /// the cycle mean of F equals the force at the operating point (F(δ) if the point is given by an
  /// indentation δ). At Amplitude::small both choices give the same loss.
  Hold hold = Hold::automatic;
  Amplitude amplitude = Amplitude::finite;
  double tolerance = 1e-10;   ///< relative error of the quadrature of W; 1e-13 to 1e-2
  Progress on_progress = {};  ///< used if several cases are computed; a stop throws Interrupted
};

constexpr void describe(auto&& visit, std::type_identity<DampingOptions>) {
  keep(visit, &DampingOptions::hold, &DampingOptions::amplitude, &DampingOptions::tolerance,
       &DampingOptions::on_progress);
}

/// The loss of one contact under one motion, and the state about which the contact oscillates.
struct DampingResult : Loss {
  double power = unknown;             ///< mean power P = Wω/2π, W; NaN if ω is unknown
  double normal_stiffness = unknown;  ///< K at the mean indentation, N/m
  /// K_t at the mean indentation, N/m. K_t and the damper γ act in parallel.
  double tangential_stiffness = unknown;
  double force_curvature = unknown;  ///< F'' at the mean indentation, N/m²
  double force = unknown;            ///< F at the mean indentation, N
  double mean_force = unknown;       ///< cycle mean of F at finite amplitude, N
  double max_force = unknown;        ///< F at the largest indentation of the cycle, N
  /// Share of the period in which the bodies touch; 1 unless the contact lifts off.
  double contact_time = unknown;
  double indentation = unknown;  ///< mean indentation of the cycle, m
  /// Loss by Eq. (12) or (15) of the paper with (G*/E*)F'' at the *given* operating point, J. It
  /// does not include the shift of the mean indentation that Hold::force causes.
  double small_amplitude_work = unknown;
  /// K_t' at the mean indentation, N/m²; (G*/E*)F'' unless the law has its own K_t.
  double tangential_curvature = unknown;
  /// Stiffness in phase with the motion, N/m, and loss factor. Known only if the friction loop was
  /// computed step by step; NaN otherwise.
  double storage_stiffness = unknown, loss_factor = unknown;
  /// Error of the quadrature of work_per_cycle and of round-off, J. For a table, `error` has the
  /// errors by the distances between its samples and by its part below them, and 0 for other causes.
  double error_estimate = unknown;
  /// Whether the quadratures reached the tolerance; if false, work_per_cycle must not be used.
  bool converged = false;
  Hold hold = Hold::indentation;  ///< the mean value that the oscillation keeps
  /// Direction of the tangential motion, from the x axis, rad; NaN if K_t has no direction, as for
  /// an indenter.
  double direction = unknown;

  /// Sets the loss and the numbers computed from it (such as power and damping constant) to NaN;
  /// the numbers without slip stay.
  void forget();
};

constexpr void describe(auto&& visit, std::type_identity<DampingResult>) {
  using enum Dimension;
  using S = DampingResult;
  describe(visit, std::type_identity<Loss>{});
  visit(&S::power, quantity::power);
  visit(&S::normal_stiffness, Extensive{quantity::normal_stiffness});
  visit(&S::tangential_stiffness, Extensive{quantity::tangential_stiffness});
  visit(&S::force_curvature, quantity::force_curvature);
  visit(&S::force, quantity::force);
  visit(&S::mean_force, quantity::mean_force);
  visit(&S::max_force, quantity::max_force);
  visit(&S::contact_time, quantity::contact_time);
  visit(&S::indentation, quantity::indentation);
  visit(&S::small_amplitude_work, quantity::small_amplitude_work);
  visit(&S::tangential_curvature,
        Kept{"tangential_curvature", "derivative of the tangential stiffness by indentation",
             force_curvature});
  visit(&S::storage_stiffness, WhereKnown{quantity::storage_stiffness});
  visit(&S::loss_factor, WhereKnown{quantity::loss_factor});
  visit(&S::error_estimate,
        Kept{"error_estimate",
             "estimated error of the energy dissipated in a cycle, of quadrature and round-off",
             energy});
  visit(&S::converged, Kept{"converged", "false: do not use work_per_cycle"});
  visit(&S::hold, Kept{"hold", "mean value that the oscillation keeps: indentation or force"});
  visit(&S::direction, WhereKnown{quantity::direction});
}

/// Computes the energy lost per cycle, and γ, from the contact law alone:
///     W = ½∮ s² dK_t,
/// where s is the displacement of the body between the moments at which the spring at a given depth
/// touches and separates. Integration by parts leaves K_t alone:
///     EqualFrequency (a): W = 2u_x² sin²φ0 ∫_0^π K_t(δ(θ)) sin2θ dθ
///     Drag (b):           W = 4(v/ω)² ∫_0^π θ [K_t(δ(θ)) − K_t(δ0 − u_z)] dθ
/// with δ(θ) = δ0 + u_z cosθ. The quadrature is adaptive and treats first touch as a break point,
/// so the contact may open during the cycle. The formula assumes no slip, contact sets that grow
/// with δ, and quasi-static motion.
///
///     DampingResult result = relaxation_damping(law, at_force(1), Drag{1e-9, 1e-6, 1e5});
///
/// throws  InvalidInput for u_z < 0, an ω that is not > 0 in Drag or < 0 in EqualFrequency, values
///         that are not finite, a force <= 0, a motion above the range of a tabulated law (the
///         message names the load that it needs), and a motion below it if this part decides on
///         the loss
/// cost    about 100 to 1000 evaluations of the law; 50 times that with Hold::force
DampingResult relaxation_damping(const ContactLaw& law, const OperatingPoint& point,
                                 const Oscillation& motion, const DampingOptions& options = {});

/// Computes the loss of a motion with two frequencies. W over their common period of p normal
/// cycles is
///     W = 2u_x² S r ∫_0^π sin(2rθ) [K_t(δ(θ)) − K_t(δ0 − u_z)] dθ,
/// with r = ω_x/ω_z, δ(θ) = δ0 + u_z cosθ and S = closed_form::frequency_ratio_phase_sum(). If the
/// frequencies have no common period, work_per_cycle is NaN and power is the mean power over
/// infinitely many cycles, computed with S/p = 1/2; small_amplitude_work and error_estimate are
/// then means per normal cycle.
DampingResult relaxation_damping(const ContactLaw& law, const OperatingPoint& point,
                                 const TwoFrequencies& motion, const DampingOptions& options = {});

/// One case of a parameter study, for example one point of a damping curve over force, amplitude,
/// frequency, velocity or phase.
struct DampingCase {
  OperatingPoint point;
  Oscillation motion;
};

/// Computes relaxation_damping() of all cases in parallel and returns the results in their order.
std::vector<DampingResult> relaxation_damping(const ContactLaw& law,
                                              std::span<const DampingCase> cases,
                                              const DampingOptions& options = {});

/// Computes the loss of a force-controlled normal motion, F = F0 + F_a cosωt with F0 = mean_force,
/// F_a = force_amplitude and 0 <= F_a <= F0. A tabulated law must cover the whole range of F.
/// motion.normal_amplitude is not used. In the result, indentation is that at F0, mean_force is F0,
/// and small_amplitude_work is Eq. (12) or (15) with u_z = F_a/K.
DampingResult relaxation_damping_force_controlled(const ContactLaw& law, double mean_force,
                                                  double force_amplitude, const Oscillation& motion,
                                                  const DampingOptions& options = {});
DampingResult relaxation_damping_force_controlled(const ContactLaw& law, double mean_force,
                                                  double force_amplitude,
                                                  const TwoFrequencies& motion,
                                                  const DampingOptions& options = {});

/// Returns what an oscillation about an operating point keeps: `wanted` unless it is automatic. Then
/// it is the mean force if a force is given and the contact would lift off from the indentation at
/// rest, since a preloaded machine holds the force; in all other cases the mean indentation.
Hold hold_of(const ContactLaw& law, const OperatingPoint& point, double normal_amplitude,
             Hold wanted = Hold::automatic);

/// Returns the share θ_t/π of the period in which the bodies touch, with cos θ_t = (δ_t − δ0)/u_z
/// and the first touch δ_t of the law; 0 <= share <= 1.
double contact_time(const ContactLaw& law, double mean_indentation, double normal_amplitude);

/// Returns the mean of F over a cycle of the indentation, δ0 + u_z cosθ, N, with δ0 =
/// mean_indentation and u_z = normal_amplitude. Throws InvalidInput where the law does not cover
/// the cycle.
double mean_force_of_cycle(const ContactLaw& law, double mean_indentation, double normal_amplitude);

/// Returns the mean indentation δ0 at which the cycle mean of F is mean_force: a dead weight
/// settles there under the oscillation. Throws InvalidInput if no cycle with this mean force fits
/// into the range of the law.
double indentation_at_mean_force(const ContactLaw& law, double mean_force, double normal_amplitude);

}  // namespace salebra
