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
/// adhesion. Each potential is a concave function of g with the range ρ:
///     exponential     −w exp(−g/ρ)
///     maugis          −w (1 − g/ρ) for g < ρ, 0 for g >= ρ: the constant tension of Maugis (1992)
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
  double max_tension() const;        ///< φ'(0), Pa: w/ρ; 2w/ρ for van_der_waals
  /// Upper bound H + φ'(0) of the contact pressure p in a first loading with the hardness H, Pa.
  /// (Touching cells carry p minus the tension t, and this difference is limited to H.)
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
/// side of a cell); infinite for w = 0. If the zone is narrower than 1.4 cells, the grid determines
/// where contacts begin and end, not the surfaces.
double cells_in_process_zone(const Adhesion& adhesion, const Grid2D& grid, double contact_modulus);
/// The same for any body, with E* = 2/(qC_n(q)) at waves of two cells.
double cells_in_process_zone(const Adhesion& adhesion, const Grid2D& grid, const Body& body);

/// Returns the text of a warning if the process zone has fewer than 3.3 cells.
std::optional<std::string> warning_of_process_zone(const Adhesion& adhesion, const Grid2D& grid,
                                                   double contact_modulus);
std::optional<std::string> warning_of_process_zone(const Adhesion& adhesion, const Grid2D& grid,
                                                   const Body& body);

struct AdhesiveContactOptions {
  /// The solver stops when the tension t satisfies |φ'(g) − t| < tolerance · max(E*·rms slope,
  /// φ'(0)) in every cell with a gap g; 1e-10 to 1e-1.
  double tolerance = 1e-5;
  int max_outer_iterations = 500;  ///< maximum number of non-adhesive contact solves, >= 1
  /// Options of the non-adhesive contacts that the solver uses; it sets their tolerance, start and
  /// checkpoints itself. With a hardness, the result is the state of a plastic first loading.
  NormalContactOptions contact = {};
  /// Tension of a neighbouring state of the same surface, Pa, from which to start so that the
  /// solution stays on its branch of loading or unloading. nullptr: starts from the contact without
  /// adhesion, or from first touch. The field must outlive the call.
  const Field* start_tension = nullptr;
  bool force_coarse = false;  ///< true: accepts a process zone of less than 1.4 cells
};

/// Results that adhesion adds to the state of a contact.
struct AdhesionOfState {
  Field tension;               ///< t, in the shape of contact_pressure, Pa, >= 0
  double tension_force = 0;    ///< ∫t dA, N
  double adhesive_energy = 0;  ///< ∫φ(g) dA, J
  /// Sum of the elastic energy, the adhesive energy, the energy of the load (P ū A with the nominal
  /// area A if periodic, −F·indentation if free) and the plastic work of a first loading, J.
  double total_energy = 0;
  /// Error of the tension that was reached, defined as AdhesiveContactOptions::tolerance.
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

/// Result of an adhesive contact. The contact pressure p acts in touching cells, the tension t in
/// all cells; mean_pressure and force are those of p − t. residual is that of the last non-adhesive
/// contact; iterations and transform counts are totals. Unless the result converged, its numbers
/// must not be used.
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
/// where h are the heights and ⟨ ⟩ is the mean over the surface. At a given mean gap it minimises
/// the first two terms. Because φ is concave, its tangent lies above φ. With t = φ'(g_n) at the
/// current gap g_n, the non-adhesive contact of the heights h + G(t − ⟨t⟩) under the pressure P +
/// ⟨t⟩ minimises a function that lies above E and touches it at g_n. E therefore falls with each
/// contact, from any start [difference-of-convex programming, Le Thi and Pham Dinh (2018)].
/// The extrapolation of t by Anderson (1965) is used whenever E falls with it. Solutions are local
/// minima and depend on the start; with start_tension the first steps are not extrapolated, so that
/// they lead to the minimum nearest to that state.
/// hardness   contact.hardness = H, for a plastic first loading: p − t is limited to H. Where p − t
///            = H, the surface sinks in by a depth d >= 0, which adds H⟨d⟩ and −P⟨d⟩ to E; p is
///            bounded by H + φ'(0) in the non-adhesive contacts. The gap is measured to the
///            residual heights h − d, which residual_surface() returns; the state is also the
///            adhesive contact of these heights without a hardness
/// point      as in press(), but negative values are allowed: a pressure or force may pull, an
///            indentation may be < 0 (before first touch). A pull that no contact can hold gives a
///            state with `detached` set. At a given mean gap, and for a free contact at a given
///            indentation, states beyond the pull-off force can be reached
/// throws     InvalidInput, before any computation, wherever press() does; for fewer than 1.4 cells
///            in the process zone, unless force_coarse is set; with a hardness, unless the point is
///            a pressure or force > 0 with a mean pressure below the hardness; and for a free
///            boundary if the tension at the edge of the undeformed surface exceeds 1e-2 of the
///            largest tension. Non-convergence is returned, not thrown
/// cost       10 to 40 non-adhesive contacts, each started from the previous one and taking a few
///            transform pairs; 130 bytes per cell in addition to press(). Collective if the surface
///            is distributed, with the same bits for any number of processes and threads
AdhesiveContactState press_adhesive(const Surface& surface, double contact_modulus,
                                    const OperatingPoint& point, const Adhesion& adhesion,
                                    const AdhesiveContactOptions& options = {});
/// On any body under a periodic surface, whose displacements are measured from the mean plane, and
/// without a hardness. Throws InvalidInput for another datum and wherever press() does.
AdhesiveContactState press_adhesive(const Surface& surface, const Body& body,
                                    const OperatingPoint& point, const Adhesion& adhesion,
                                    const AdhesiveContactOptions& options = {});

}  // namespace salebra
