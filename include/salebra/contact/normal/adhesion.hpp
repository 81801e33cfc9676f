// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <string>

namespace salebra {

/// Interaction energy per area φ(g) of two surfaces at a gap g >= 0, with φ(0) = −w, w the work of
/// adhesion. Each potential is concave:
///     exponential     −w exp(−g/ρ)
///     maugis          −w (1 − g/ρ) below ρ, 0 beyond: the constant tension of Maugis (1992)
///     van_der_waals   −w/(1 + g/ρ)², with a hard wall
enum class AdhesionPotential { exponential, maugis, van_der_waals };

template <>
struct EnumNames<AdhesionPotential> {
  static constexpr auto values = std::to_array<std::pair<AdhesionPotential, std::string_view>>(
      {{AdhesionPotential::exponential, "exponential"},
       {AdhesionPotential::maugis, "maugis"},
       {AdhesionPotential::van_der_waals, "van_der_waals"}});
};

struct Adhesion {
  AdhesionPotential potential = AdhesionPotential::exponential;
  double work = 0;   ///< w >= 0, J/m²
  double range = 0;  ///< ρ > 0, m

  double energy(double gap) const;   ///< φ(g), J/m²
  double tension(double gap) const;  ///< φ'(g), Pa
  double max_tension() const;    ///< φ'(0), Pa: w/ρ; 2w/ρ for van_der_waals
  /// Upper bound H + φ'(0) of the contact pressure p in a first loading, Pa: touching bodies carry
  /// p − t.
  double pressure_bound(double hardness) const { return hardness + max_tension(); }
  bool operator==(const Adhesion&) const = default;
};

constexpr void describe(auto&& visit, std::type_identity<Adhesion>) {
  using S = Adhesion;
  visit(&S::potential, Kept{"potential", "'exponential', 'maugis' or 'van_der_waals'"});
  visit(&S::work, Kept{"work", "work of adhesion w", Dimension::energy_per_area});
  visit(&S::range, Kept{"range", "range of the potential", Dimension::length});
}

/// Returns the width of the adhesive process zone at a contact edge in cells, E*w/(φ'(0)² · longer
/// side of a cell); infinite for w = 0. Below 1.4 cells the grid, not the surfaces, determines
/// where contacts begin and end.
double cells_in_process_zone(const Adhesion& adhesion, const Grid2D& grid, double contact_modulus);

/// Returns the text of a warning if the process zone has fewer than 3.3 cells.
std::optional<std::string> warning_of_process_zone(const Adhesion& adhesion, const Grid2D& grid,
                                                 double contact_modulus);

struct AdhesiveContactOptions {
  /// The solver stops when max |φ'(g) − t| over the cells with a gap, t being the acting tension,
  /// is below this fraction of max(E*·rms slope, φ'(0)); 1e-10 … 1e-1.
  double tolerance = 1e-5;
  int max_outer_iterations = 500;  ///< maximum number of non-adhesive contact solves, >= 1
  /// Options of the non-adhesive contacts; the solver sets their tolerance, start and checkpoints.
  /// With a hardness the state is that of a first loading.
  NormalContactOptions contact = {};
  /// Tension of another state of the same surface, Pa, whose branch to follow: the previous state
  /// when loading or unloading. nullptr starts from the contact without adhesion, or from first
  /// touch. It must outlive the call.
  const Field* start_tension = nullptr;
  bool force_coarse = false;  ///< also solves with less than 1.4 cells in the process zone
};

/// Results that adhesion adds to the state of a contact.
struct AdhesionOfState {
  Field tension;               ///< t, as contact_pressure, Pa, >= 0
  double tension_force = 0;    ///< ∫t dA, N
  double adhesive_energy = 0;  ///< ∫φ(g) dA, J
  /// Elastic and adhesive energy, energy of the load, P ū A (periodic) or −F·indentation (free),
  /// and the plastic work of a first loading, J.
  double total_energy = 0;
  double adhesion_residual = std::numeric_limits<double>::infinity();
  double cells_in_process_zone = 0;
  int outer_iterations = 0;  ///< number of non-adhesive contacts solved
  /// True if the surfaces separate under this load: there is no equilibrium, and the gaps are
  /// infinite.
  bool detached = false;
};

constexpr void describe(auto&& visit, std::type_identity<AdhesionOfState>) {
  using enum Dimension;
  using S = AdhesionOfState;
  visit(&S::tension, Quantity{"tension", pressure, "adhesive tension"});
  visit(&S::tension_force,
        Quantity{"tension_force", Dimension::force, "force by which adhesion pulls"});
  visit(&S::adhesive_energy, Quantity{"adhesive_energy", energy, "energy of adhesion"});
  visit(&S::total_energy,
        Quantity{"total_energy", energy,
                 "elastic and adhesive energy, that of the load, and plastic work"});
  visit(&S::adhesion_residual,
        Quantity{"adhesion_residual", dimensionless, "residual of the adhesive tension"});
  visit(&S::cells_in_process_zone,
        Quantity{"cells_in_process_zone", dimensionless, "cells in the process zone of adhesion"});
  visit(&S::outer_iterations,
        Quantity{"outer_iterations", dimensionless, "contacts solved for an adhesive one"});
  visit(&S::detached, Quantity{"detached", dimensionless, "whether the load parts the surfaces"});
}

/// Result of an adhesive contact. The contact pressure p acts on the touching cells, the tension t
/// between all cells; mean pressure and force are those of p − t. `residual` belongs to the last
/// non-adhesive contact; counts are totals. Unless it converged, the numbers must not be used.
struct AdhesiveContactState : NormalContactState, AdhesionOfState {};

constexpr void describe(auto&& visit, std::type_identity<AdhesiveContactState>) {
  describe(visit, std::type_identity<NormalContactState>{});
  describe(visit, std::type_identity<AdhesionOfState>{});
}

/// Solves the adhesive contact of a rigid rough surface with an elastic half-space:
///     const Adhesion adhesion{AdhesionPotential::exponential, 0.05, 1e-9};
///     const auto state = press_adhesive(surface, 1e9, at_pressure(1e6), adhesion);
/// At a pressure P it finds a minimum of
///     E(g) = ½⟨(g + h) k (g + h)⟩ + ⟨φ(g)⟩ + P⟨g⟩,   g >= 0,   k = G⁻¹ of press(),
/// at a mean gap that of the first two terms. The tangent of a concave φ lies above φ. With t =
/// φ'(g_n), the non-adhesive contact of the heights h + G(t − ⟨t⟩) under the pressure P + ⟨t⟩
/// minimises a function that lies above E and touches it at g_n; so E falls with each contact, from
/// any start [difference-of-convex programming, Le Thi and Pham Dinh (2018)]. The extrapolation of
/// Anderson (1965) of t is used if E falls with it. Solutions are local minima and depend on the
/// start; with start_tension the first steps are not extrapolated and so descend the valley of that
/// state.
/// hardness   H, for a first loading: p − t is limited to H. Where it equals H, the surface sinks
///            in by w >= 0, which adds H⟨w⟩ and −P⟨w⟩ to E; the contacts have the bound H + φ'(0).
///            The gap is measured to the heights h − w, for which the state is an adhesive contact
///            without a hardness; residual_surface() returns them
/// target     as in press(), with other signs allowed: a pressure or force may pull, an indentation
///            may be < 0 (before first touch). A pull that no contact can hold gives a detached
///            state. At a given mean gap, and for a free contact at an indentation, states beyond
///            the minimum of the force can be reached
/// throws     InvalidInput before any work as press(); for less than 1.4 cells in the process zone,
///            unless forced; with a hardness for anything but a load > 0 below it; for a free
///            boundary at which the undeformed gap has more than 1e-2 of the largest tension.
///            Non-convergence is returned, not thrown
/// cost       10 to 40 contacts that start from each other, of some pairs each; 130 bytes per cell
///            in addition to press(). Collective if the surface is distributed, with the same bits
///            for any number of processes and threads
AdhesiveContactState press_adhesive(const Surface& surface, double contact_modulus,
                                    const OperatingPoint& point, const Adhesion& adhesion,
                                    const AdhesiveContactOptions& options = {});

}  // namespace salebra
