// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/contact/mdr/viscoelastic.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <span>
#include <vector>

/// Rough contact of a linearly viscoelastic body, which relaxes by one Prony series at constant
/// Poisson's ratio: a press along a path, and the steady state of an oscillation without slip.
///
/// The Body gives the relaxed response C, and of the series only the ratios g_k = G_k/G∞ are used,
/// so that C p = u + Σ g_k y_k with y_k' = u' − y_k/τ_k for pressures and for tractions. The series
/// holds for the whole body: a coating and a base that relax differently have no such form. While
/// the displacement u is straight within a step Δt, the pressures at the end of the step are those
/// of one elastic contact of the heights
///     α h + Σ g_k (d_k y_k − γ_k u),  d_k = exp(−Δt/τ_k),  γ_k = (1 − d_k)τ_k/Δt,
///     α = 1 + Σ g_k γ_k,
/// with u and y_k at the beginning of the step.
namespace salebra {

/// The contact at one time of a path.
struct ViscoelasticPoint {
  double time = 0;         ///< s, as given
  double pressure = 0;     ///< nominal pressure, Pa
  double force = 0;        ///< F, N
  double indentation = 0;  ///< δ from first touch of the undeformed body, m
  /// Changes since half as many steps, Pa and m; NaN for the quantity that is prescribed.
  double pressure_error = std::numeric_limits<double>::quiet_NaN();
  double indentation_error = std::numeric_limits<double>::quiet_NaN();
  double mean_gap = 0;               ///< m
  double contact_area_fraction = 0;  ///< cells with p > 0 over all cells
};

constexpr void describe(auto&& visit, std::type_identity<ViscoelasticPoint>) {
  using S = ViscoelasticPoint;
  using enum Dimension;
  visit(&S::time, quantity::time);
  visit(&S::pressure, Quantity{"pressure", Dimension::pressure, "nominal pressure"});
  visit(&S::force, quantity::force);
  visit(&S::indentation, quantity::indentation);
  visit(&S::pressure_error,
        Quantity{"pressure_error", Dimension::pressure, "error of the pressure by the time steps"});
  visit(&S::indentation_error,
        Quantity{"indentation_error", length, "error of the indentation by the time steps"});
  visit(&S::mean_gap, Quantity{"mean_gap", length, "mean gap of the deformed surfaces"});
  visit(&S::contact_area_fraction,
        Quantity{"contact_area_fraction", dimensionless, "contact area over nominal area"});
}

/// A contact along a path in time.
struct ViscoelasticPath {
  std::vector<ViscoelasticPoint> points;  ///< one for each time
  Field contact_pressure;                 ///< p of each cell at the last time, Pa
  Field gap;                              ///< at the last time, m
  bool converged = false;                 ///< false: do not use the numbers
};

constexpr void describe(auto&& visit, std::type_identity<ViscoelasticPath>) {
  using S = ViscoelasticPath;
  visit(&S::points, Table{"points", "over the time"});
  visit(&S::contact_pressure,
        Kept{"contact_pressure", "contact pressure of each cell at the last time",
             Dimension::pressure});
  visit(&S::gap, Kept{"gap", "gap of each cell at the last time", Dimension::length});
  visit(&S::converged, Kept{"converged", "false: do not use the numbers"});
}

struct ViscoelasticPathOptions {
  int steps = 16;  ///< straight steps between neighbouring times, even, >= 2
  NormalContactOptions contact = {};
  Progress on_progress = {};
};

/// Presses a surface on an undisturbed body along a path of a control quantity, for example creep
/// under a constant pressure:
///     const Body rubber = Body::half_space({3e6, 0.5});  // the relaxed constants
///     const ViscoelasticPath creep =
///         viscoelastic_path(surface, rubber, {1, {{3, 0.02}}}, std::vector{0.0, 0.01, 0.1},
///                           {ControlQuantity::pressure, {1e5}});
/// The value at the first time is reached at once, with the unrelaxed response; between the times
/// the value is straight. A load of 0 lifts the surface off; an indentation <= 0 holds it above the
/// undeformed body.
/// body        relaxed response; any body under a periodic surface, a half-space also under a free
///             one
/// relaxation  Prony series; only G_k/G∞ and τ_k are used
/// time        s, increasing, at least one value; displacements are straight within the steps
///             between the times, and errors are of second order in the steps. `steps` and steps/2
///             are both computed; the change is the error, three times that of a second-order rule
/// path        pressure >= 0, force >= 0 or indentation at each time, or one value > 0 that is held
/// throws      InvalidInput for arguments that violate these conditions or those of press(), for a
///             finite hardness and for a mean gap; Interrupted if on_progress says stop
/// cost        3/2 · steps · times contacts
ViscoelasticPath viscoelastic_path(const Surface& surface, const Body& body,
                                   const PronySeries& relaxation, std::span<const double> time,
                                   const OperatingPoints& path,
                                   const ViscoelasticPathOptions& options = {});

struct ViscoelasticCycleOptions {
  int steps = 64;  ///< straight steps per cycle, even, >= 16
  /// Largest distance of the displacements from their periodic state, over the larger of the
  /// amplitudes of the motion (the normal one for normal displacements). 1e-10 to 1e-1.
  double tolerance = 1e-4;
  int max_cycles = 200;         ///< limit for each direction, >= 2
  Hold hold = Hold::automatic;  ///< the mean value that the oscillation keeps
  NormalContactOptions contact = {};
  StickOptions stick = {.tolerance = 1e-8};
  Progress on_progress = {};
};

/// The contact at one time of a steady cycle.
struct ViscoelasticSample {
  double time = 0;              ///< from the minimum of the indentation, s
  double indentation = 0;       ///< δ, m
  double tangential = 0;        ///< x, m
  double normal_force = 0;      ///< F, N
  double tangential_force = 0;  ///< F_x, N, from x = 0 without force in cells in permanent contact
  double contact_area = 0;      ///< m²
};

constexpr void describe(auto&& visit, std::type_identity<ViscoelasticSample>) {
  using S = ViscoelasticSample;
  using enum Dimension;
  visit(&S::time, quantity::time);
  visit(&S::indentation, quantity::indentation);
  visit(&S::tangential, Quantity{"tangential", length, "tangential displacement"});
  visit(&S::normal_force, Quantity{"normal_force", force, "normal force"});
  visit(&S::tangential_force, quantity::tangential_force);
  visit(&S::contact_area, Quantity{"contact_area", length_squared, "contact area"});
}

/// Loss of a rough contact on a viscoelastic body over a cycle of its steady state.
struct ViscoelasticCycle {
  double angular_frequency = 0;     ///< ω, rad/s
  double work_per_cycle = 0;        ///< normal_work + tangential_work, J
  double work_per_cycle_error = 0;  ///< step_error plus |dissipated − work_per_cycle|, J
  double normal_work = 0;           ///< ∮F dδ, J
  double tangential_work = 0;       ///< ∮F_x dx minus the growth of the stored energy, J
  /// Part of tangential_work: elastic energy that cells release at once when they leave, with the
  /// unrelaxed response, J. Some of the energy that they keep is lost while the free surface
  /// recovers, so that this is no split into material and relaxation damping.
  double jump_work = 0;
  /// The loss computed independently, J: dissipation of the branches, plus jump_work, plus the work
  /// of tractions inside the steps in cells that recover freely.
  double dissipated = 0;
  double step_error = 0;  ///< change of the loss since half as many steps, J
  double power = 0;       ///< work_per_cycle over the period, W
  /// Mean power of tangential_work over ⟨ẋ²⟩, N s/m; NaN without tangential motion.
  double damping_constant = std::numeric_limits<double>::quiet_NaN();
  /// Amplitude of F in phase with the indentation over the amplitude of the indentation, N/m, and
  /// normal_work/(πu_z²); NaN without normal motion.
  double normal_storage_stiffness = std::numeric_limits<double>::quiet_NaN();
  double normal_loss_stiffness = std::numeric_limits<double>::quiet_NaN();
  /// The same for F_x and x; NaN without tangential motion or for a Drag.
  double tangential_storage_stiffness = std::numeric_limits<double>::quiet_NaN();
  double tangential_loss_stiffness = std::numeric_limits<double>::quiet_NaN();
  double mean_indentation = 0;              ///< mean of δ over the cycle, m
  double mean_force = 0;                    ///< mean of F over the cycle, N
  double contact_area_min = 0;              ///< smallest of the cycle, m²
  double contact_area_max = 0;              ///< largest of the cycle, m²
  std::vector<ViscoelasticSample> samples;  ///< at the steps, with both ends of the cycle
  int cycles = 0;                           ///< cycles computed, in both directions
  /// Largest estimated distance from the periodic state, as ViscoelasticCycleOptions::tolerance.
  double residual = 0;
  /// Worst outcome of all solves and of the search of the periodic state; unless it is `converged`,
  /// the numbers are NaN.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
  /// Makes NaN what does not exceed its error: all numbers of the loss, or only those of
  /// tangential_work alone (damping constant and tangential loss stiffness). Without a steady state,
  /// only the frequency, cycles and residual are left.
  void drop_uncertain();
};

constexpr void describe(auto&& visit, std::type_identity<ViscoelasticCycle>) {
  using enum Dimension;
  using S = ViscoelasticCycle;
  visit(&S::angular_frequency, quantity::angular_frequency);
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::work_per_cycle_error, quantity::work_per_cycle_error);
  visit(&S::normal_work, Quantity{"normal_work", energy, "work of the normal force in a cycle"});
  visit(&S::tangential_work, Quantity{"tangential_work", energy,
                                      "energy dissipated in a cycle by the tangential motion"});
  visit(&S::jump_work, Quantity{"jump_work", energy,
                                "energy that cells release at once when they leave the contact"});
  visit(&S::dissipated,
        Quantity{"dissipated", energy, "energy dissipated in a cycle, as a sum over the branches"});
  visit(&S::step_error,
        Quantity{"step_error", energy, "change of the loss since half as many steps"});
  visit(&S::power, quantity::power);
  visit(&S::damping_constant, quantity::damping_constant);
  visit(&S::normal_storage_stiffness, Quantity{"normal_storage_stiffness", stiffness,
                                               "normal force in phase over the amplitude"});
  visit(&S::normal_loss_stiffness, Quantity{"normal_loss_stiffness", stiffness,
                                            "normal force out of phase over the amplitude"});
  visit(&S::tangential_storage_stiffness, Quantity{"tangential_storage_stiffness", stiffness,
                                                   "tangential force in phase over the amplitude"});
  visit(&S::tangential_loss_stiffness,
        Quantity{"tangential_loss_stiffness", stiffness,
                 "tangential force out of phase over the amplitude"});
  visit(&S::mean_indentation,
        Quantity{"mean_indentation", length, "mean indentation over the cycle"});
  visit(&S::mean_force, quantity::mean_force);
  visit(&S::contact_area_min,
        Quantity{"contact_area_min", length_squared, "minimum contact area of a cycle"});
  visit(&S::contact_area_max,
        Quantity{"contact_area_max", length_squared, "maximum contact area of a cycle"});
  visit(&S::samples, Table{"samples", "over the cycle"});
  visit(&S::cycles, Quantity{"cycles", dimensionless, "cycles computed"});
  visit(&S::residual,
        Quantity{"residual", dimensionless, "distance from the periodic state, relative"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Quantity{"converged", dimensionless, "whether every solve converged"});
}

/// Computes the steady state of a rough contact on a viscoelastic body that oscillates without
/// slip, with tangential motion along x:
///     const Body rubber = Body::half_space({3e6, 0.5});  // the relaxed constants
///     const EqualFrequency motion{1e-6, 1e-7, std::numbers::pi / 2, 2 * std::numbers::pi * 50};
///     const ViscoelasticCycle cycle =
///         viscoelastic_cycle(surface, rubber, {1, {{3, 0.02}}}, motion, at_pressure(1e5));
/// Each step of the indentation is one elastic contact. The tangential displacements move from one
/// mid-step to the next with the contact set between them: cells that leave drop their traction at
/// once, with the unrelaxed response; cells in contact move with the body; cells that enter keep
/// the displacement that they have. Anderson's extrapolation of cycles finds the periodic state of
/// displacements and branches, and of the mean indentation if the mean force is held. The elastic
/// loss theorem does not hold here, because contact sets depend on the past.
/// The error of the steps is of second order while cells enter at a smooth rate; `steps` and
/// steps/2 are both computed, and step_error is the change, three times the error of a second-order
/// rule. It does not include the error due to the cell size. A loss that does not exceed its error is
/// NaN (drop_uncertain()).
/// surface, body, relaxation  as for viscoelastic_path(); the tangential response must be known if
///         the motion has a tangential part
/// motion  ω > 0 must be given. A Drag must be slow against all relaxation times
/// point   about which the contact oscillates: the state of the relaxed body at rest
/// throws  InvalidInput for arguments that violate these conditions or those of press() and
///         StickSolver, and for an oscillation that reaches full contact from a mean plane;
///         Interrupted if on_progress says stop
/// cost    3/2 · steps · cycles (typically 5 to 30) contacts, and up to twice as many stick solves
/// memory  25(1 + terms) floats per cell
ViscoelasticCycle viscoelastic_cycle(const Surface& surface, const Body& body,
                                     const PronySeries& relaxation, const Oscillation& motion,
                                     const OperatingPoint& point,
                                     const ViscoelasticCycleOptions& options = {});

/// The same motion at several frequencies, each > 0, rad/s. The search of each periodic state
/// starts from that of the frequency before, so that neighbours should follow each other. A
/// frequency without a steady state has no numbers, and `termination` says why; the others have
/// theirs:
///     const auto sweep =
///         viscoelastic_sweep(surface, rubber, series, motion, point, std::vector{10.0, 100.0});
std::vector<ViscoelasticCycle> viscoelastic_sweep(const Surface& surface, const Body& body,
                                                  const PronySeries& relaxation,
                                                  const Oscillation& motion,
                                                  const OperatingPoint& point,
                                                  std::span<const double> angular_frequencies,
                                                  const ViscoelasticCycleOptions& options = {});

}  // namespace salebra
