// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/words.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <string>

namespace salebra {

/// Energy per area φ(g) of two surfaces at a gap g >= 0; φ(0) = −w with the work of adhesion w, and
/// each is concave:
///     exponential     −w exp(−g/ρ)
///     maugis          −w (1 − g/ρ) below ρ, 0 beyond: the constant tension of Maugis (1992)
///     van_der_waals   −w/(1 + g/ρ)², of a hard wall
enum class AdhesionPotential { exponential, maugis, van_der_waals };

template <>
struct Words<AdhesionPotential> {
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
  double largest_tension() const;    ///< φ'(0), Pa: w/ρ, or 2w/ρ of van_der_waals
  /// Of the contact pressure p in a first loading, H + φ'(0), Pa: bodies that touch carry p − t.
  double pressure_bound(double hardness) const { return hardness + largest_tension(); }
  bool operator==(const Adhesion&) const = default;
};

constexpr void describe(auto&& visit, std::type_identity<Adhesion>) {
  using S = Adhesion;
  visit(&S::potential, Kept{"potential", "'exponential', 'maugis' or 'van_der_waals'"});
  visit(&S::work, Kept{"work", "work of adhesion w", Dimension::energy_per_area});
  visit(&S::range, Kept{"range", "range of the potential", Dimension::length});
}

/// Cells in the zone beside a contact in which surfaces that part are held, E*w/(φ'(0)² · the
/// longer side of a cell); infinite for w = 0. Below 1.4 of them the cells, not the surfaces, decide
/// where contacts begin and end.
double cells_in_process_zone(const Adhesion& adhesion, const Grid2D& grid, double contact_modulus);

/// Fewer than 3.3 cells in the process zone, in words for a warning.
std::optional<std::string> doubt_of_process_zone(const Adhesion& adhesion, const Grid2D& grid,
                                                 double contact_modulus);

struct AdhesiveContactOptions {
  /// Stop where max |φ'(g) − t| over the cells with a gap, t being the tension that acts, is below
  /// this part of max(E*·rms slope, φ'(0)); 1e-10 … 1e-1.
  double tolerance = 1e-5;
  int max_outer_iterations = 500;  ///< ordinary contacts, >= 1
  /// Of the contacts; their tolerance, start and checkpoints are the solver's own. With a hardness
  /// the state is that of a first loading.
  NormalContactOptions contact = {};
  /// Tension of another state of the same surface, Pa, from which to follow its branch: that of the
  /// state before, for loading and for unloading. nullptr: from the contact without adhesion, or from
  /// first touch. It must outlive the call.
  const Field* start_tension = nullptr;
  bool force_coarse = false;  ///< solves with less than 1.4 cells in the process zone as well
};

/// What adhesion adds to the state of a contact.
struct AdhesionOfState {
  Field tension;               ///< t, as contact_pressure, Pa, >= 0
  double tension_force = 0;    ///< ∫t dA, N
  double adhesive_energy = 0;  ///< ∫φ(g) dA, J
  /// Elastic and adhesive energy, that of the load, P ū A (periodic) or −F·indentation (free), and
  /// the plastic work of a first loading, J.
  double total_energy = 0;
  double adhesion_residual = std::numeric_limits<double>::infinity();
  double cells_in_process_zone = 0;
  int outer_iterations = 0;  ///< ordinary contacts solved
  /// Under this load the surfaces part, and there is no equilibrium: gap and mean gap are infinite.
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

/// An adhesive contact. The contact pressure p is that of the cells that touch; between all cells
/// acts the tension t, and mean pressure and force are those of p − t. `residual` is that of the
/// last ordinary contact, counts are of all of them. Unless converged, the numbers must not be used
/// as the answer.
struct AdhesiveContactState : NormalContactState, AdhesionOfState {};

constexpr void describe(auto&& visit, std::type_identity<AdhesiveContactState>) {
  describe(visit, std::type_identity<NormalContactState>{});
  describe(visit, std::type_identity<AdhesionOfState>{});
}

/// Adhesive contact of a rigid rough surface with an elastic half-space: a minimum of
///     E(g) = ½⟨(g + h) k (g + h)⟩ + ⟨φ(g)⟩ + P⟨g⟩,   g >= 0,   k = G⁻¹ of press(),
/// at a pressure P, or of its first two terms at a mean gap. The tangent of a concave φ lies above
/// it. With t = φ'(g_n) the contact without adhesion of the heights h + G(t − ⟨t⟩) under the pressure
/// P + ⟨t⟩ is the minimum of what lies above E and touches it at g_n: E falls with each contact,
/// from any start [difference-of-convex programming, Le Thi and Pham Dinh (2018)]. Anderson's
/// extrapolation [Anderson (1965)] of t is taken where E fell. Solutions are local minima and depend
/// on the start; with start_tension the first steps are plain ones, down the valley of that state.
/// hardness   H, of a first loading: p − t rises to H and no further. Where it is H, the surface
///            sinks in by w >= 0, and E has H⟨w⟩ and −P⟨w⟩ more. The contacts have the bound
///            H + φ'(0). The gap is that over the heights h − w, of which the state is an adhesive
///            contact without a hardness: residual_surface() returns them
/// target     as of press(), but for signs: a pressure or force may pull, an indentation may be < 0
///            (out of first touch). Under a pull that nothing holds the state is detached. At a
///            given mean gap, and of a free contact at an indentation, the force passes its minimum
/// throws     InvalidInput before any work as press(); for less than 1.4 cells in the process zone,
///            unless forced; with a hardness for anything but a load > 0 below it; for a free
///            boundary at which the undeformed gap has more than 1e-2 of the largest tension.
///            Non-convergence is returned, not thrown
/// cost       10 to 40 contacts that start from each other, of some pairs each; 130 bytes a cell
///            in addition to those of press(). Collective where the surface is spread, with the same
///            bits for every number of processes and threads
AdhesiveContactState press_adhesive(const Surface& surface, double contact_modulus,
                                    const Target& target, const Adhesion& adhesion,
                                    const AdhesiveContactOptions& options = {});

}  // namespace salebra
