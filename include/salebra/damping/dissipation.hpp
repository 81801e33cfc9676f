// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/progress.hpp>
#include <salebra/base/words.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/loss.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <span>
#include <variant>
#include <vector>

namespace salebra {

/// Where a contact stands before or while it oscillates: at an indentation δ on the law's own
/// scale, m …
struct AtIndentation {
  double indentation = 0;
};
/// … or at a force, N, > 0.
struct AtForce {
  double force = 0;
};
using Position = std::variant<AtIndentation, AtForce>;

/// δ of a position, m.
double indentation_of(const ContactLaw& law, const Position& position);

enum class Amplitude {
  small,  ///< Eq. (12) or (15) with F'' of the law: the limit u_z → 0
  finite  ///< the theorem of docs/theory.md, section 7, exact at every amplitude
};

template <>
struct Words<Amplitude> {
  static constexpr auto values = std::to_array<std::pair<Amplitude, std::string_view>>(
      {{Amplitude::small, "small"}, {Amplitude::finite, "finite"}});
};

struct DampingOptions {
  /// Hold::indentation: the position is that of mean indentation. Hold::force: the cycle mean of F
  /// equals the force of the position (its F(δ) where an indentation was given); at
  /// Amplitude::small the two coincide.
  Hold hold = Hold::indentation;
  Amplitude amplitude = Amplitude::finite;
  double tolerance = 1e-10;   ///< relative, of the quadrature of W; 1e-13 … 1e-2
  Progress on_progress = {};  ///< of the form that takes many cases; a stop throws Interrupted
};

constexpr void describe(auto&& visit, std::type_identity<DampingOptions>) {
  keep(visit, &DampingOptions::hold, &DampingOptions::amplitude, &DampingOptions::tolerance,
       &DampingOptions::on_progress);
}

/// The loss of one contact under one motion, and the state about which it oscillates.
struct DampingResult : Loss {
  double power = unknown;  ///< P = Wω/2π, W; NaN where the motion has no ω
  double normal_stiffness = unknown;      ///< K at the mean indentation, N/m
  double tangential_stiffness = unknown;  ///< K_t there: with γ the contact as a spring and damper
  double force_curvature = unknown;       ///< F'' at the mean indentation, N/m²
  double force = unknown;                 ///< F at the mean indentation, N
  double mean_force = unknown;   ///< mean of F over the cycle, N; that of a finite amplitude always
  double indentation = unknown;  ///< mean indentation of the cycle, m
  /// Eq. (12) or (15) with (G*/E*)F'' at the *given* position, J. What Hold::force does to the mean
  /// indentation is not in it.
  double small_amplitude_work = unknown;
  double tangential_curvature =
      unknown;  ///< K_t' at the mean indentation, N/m²; (G*/E*)F'' unless the law has a K_t of its
                ///< own
  /// Of a loop with friction that is followed step by step, N/m; NaN otherwise.
  double storage_stiffness = unknown, loss_factor = unknown;
  double error_estimate =
      unknown;  ///< of work_per_cycle, J: quadrature and round-off, not the law's own error
  bool converged =
      false;  ///< whether the quadratures reached the tolerance; false: do not use work_per_cycle
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
}

/// Work lost per cycle by
///     W = ½∮ s² dK_t,  s = x_out − x_in of each indentation level, in the by-parts forms that need K_t alone:
///     (a) W = 2u_x² sin²φ0 ∫_0^π K_t(δ(θ)) sin2θ dθ
///     (b) W = 4(v/ω)² ∫_0^π θ [K_t(δ(θ)) − K_t(δ0 − u_z)] dθ,
/// δ(θ) = δ0 + u_z cosθ, adaptively, with first touch as a break point: the contact may open during
/// the cycle. No slip, contact sets that grow with δ, quasi-static.
/// throws  InvalidInput for u_z < 0, an ω that is not > 0 in Drag or < 0 in EqualFrequency, values
///         that are not finite, a force <= 0,
///         and a motion that leaves the range of a tabulated law
/// cost    about 100 to 1000 evaluations of the law; 50 times that with Hold::force
DampingResult relaxation_damping(const ContactLaw& law, const Position& position,
                                 const Oscillation& motion, const DampingOptions& options = {});

/// Two frequencies, W over their common period of p normal cycles,
///     W = 2u_x² S r ∫_0^π sin(2rθ) [K_t(δ(θ)) − K_t(δ0 − u_z)] dθ,
/// r = ω_x/ω_z and S as closed_form::frequency_ratio_phase_sum. Without a common period
/// work_per_cycle is NaN and power is the mean power, with S/p = 1/2; small_amplitude_work and
/// error_estimate are then means per normal cycle.
DampingResult relaxation_damping(const ContactLaw& law, const Position& position,
                                 const TwoFrequencies& motion, const DampingOptions& options = {});

/// One case of a damping curve: over force, amplitude, frequency, velocity or phase.
struct DampingCase {
  Position position;
  Oscillation motion;
};

/// relaxation_damping() of each case, in parallel, in the order of the cases.
std::vector<DampingResult> relaxation_damping(const ContactLaw& law,
                                              std::span<const DampingCase> cases,
                                              const DampingOptions& options = {});

/// Normal motion by force, F = F0 + F_a cosωt with 0 <= F_a <= F0; a table must cover the whole
/// range of F. motion.normal_amplitude is not used; indentation is that of F0, mean_force is F0,
/// small_amplitude_work is Eq. (12) or (15) with u_z = F_a/K.
DampingResult relaxation_damping_force_controlled(const ContactLaw& law, double mean_force,
                                                  double force_amplitude, const Oscillation& motion,
                                                  const DampingOptions& options = {});
DampingResult relaxation_damping_force_controlled(const ContactLaw& law, double mean_force,
                                                  double force_amplitude,
                                                  const TwoFrequencies& motion,
                                                  const DampingOptions& options = {});

/// Mean of F over a cycle δ0 + u_z cosθ, N. Throws InvalidInput where the law does not cover the
/// cycle.
double mean_force_of_cycle(const ContactLaw& law, double mean_indentation, double normal_amplitude);

/// The mean indentation δ0 at which the cycle mean of F is mean_force: where a dead weight settles
/// under the oscillation. Throws InvalidInput where the law's range does not hold such a cycle.
double indentation_at_mean_force(const ContactLaw& law, double mean_force, double normal_amplitude);

}  // namespace salebra
