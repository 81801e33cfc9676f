// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <vector>

/// Conductance of a contact from its normal stiffness K = dF/dδ, as returned by normal_stiffness()
/// or in a force curve:
///     const double siemens = electrical_conductance(stiffness, 1.1e11, 1.7e-8, 1.7e-8);
/// The pressure of a contact set under a unit approach and the current density through the set
/// solve the same problem of potential theory, so conductance is proportional to K for every set of
/// contact spots, without a sum over spots [Barber (2003)]. K per nominal area gives a conductance
/// per nominal area. An infinite K (full contact) conducts without resistance. The functions throw
/// InvalidInput for K < 0, E* <= 0, a negative resistivity or conductivity, or two bodies that are
/// both perfect conductors.
namespace salebra {

/// Returns the electrical conductance 2K/[E*(ρ_1 + ρ_2)] in S, or in S/m² if K is given per area.
/// ρ_1 and ρ_2 are the resistivities of the two bodies, Ω m; 0 is a perfect conductor.
/// normal_stiffness   N/m
/// contact_modulus    E*, Pa
double electrical_conductance(double normal_stiffness, double contact_modulus, double resistivity_1,
                              double resistivity_2);

/// Returns the thermal conductance 2K/[E*(1/κ_1 + 1/κ_2)] in W/K, or in W/(m² K) if K is given per
/// area. κ_1 and κ_2 are the conductivities of the two bodies, W/(m K); infinity is a perfect
/// conductor. Only solid contact spots conduct: radiation and the medium in the gap are neglected.
double thermal_conductance(double normal_stiffness, double contact_modulus, double conductivity_1,
                           double conductivity_2);

/// Conduction of the bodies. Each list has two numbers for the two bodies, or one number that holds
/// for both bodies, or is empty if the corresponding conductance is not wanted.
struct Conduction {
  std::vector<double> conductivity = {};  ///< κ, W/(m K)
  std::vector<double> resistivity = {};   ///< ρ, Ω m

  bool given() const { return !conductivity.empty() || !resistivity.empty(); }
  /// Throws InvalidInput for a list of more than two numbers (the message names the list), and
  /// wherever electrical_conductance() and thermal_conductance() do.
  void validate() const;
};

constexpr void describe(auto&& visit, std::type_identity<Conduction>) {
  using enum Dimension;
  using S = Conduction;
  visit(&S::conductivity,
        Quantity{"conductivity", thermal_conductivity, "thermal conductivity of the bodies"});
  visit(&S::resistivity,
        Quantity{"resistivity", Dimension::resistivity, "electrical resistivity of the bodies"});
}

/// Conductances per nominal area; NaN if not requested.
struct Conductances {
  double thermal_conductance = std::numeric_limits<double>::quiet_NaN();     ///< W/(m² K)
  double electrical_conductance = std::numeric_limits<double>::quiet_NaN();  ///< S/m²
};

constexpr void describe(auto&& visit, std::type_identity<Conductances>) {
  using S = Conductances;
  visit(&S::thermal_conductance, Quantity{"thermal_conductance", Dimension::thermal_conductance,
                                          "thermal conductance over nominal area"});
  visit(&S::electrical_conductance,
        Quantity{"electrical_conductance", Dimension::conductance_per_area,
                 "electrical conductance over nominal area"});
}

/// Returns the requested conductances for a K per area, Pa/m.
Conductances conductances(double normal_stiffness_per_area, double contact_modulus,
                          const Conduction& conduction);

}  // namespace salebra
