// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <vector>

/// Conductance of a contact from its normal stiffness K = dF/dδ. The pressure under a unit approach
/// of a contact set and the current density through it are solutions of one problem of potential
/// theory, hence it holds for every set of contact spots, without a sum over spots [Barber (2003)].
/// K of normal_stiffness() or of a force curve is all that is needed; K per nominal area gives a
/// conductance per nominal area. An infinite K, of full contact, conducts without resistance.
/// Throws InvalidInput for K < 0, E* <= 0, negative numbers of a body, or two bodies without any
/// resistance.
namespace salebra {

/// C = 2K/[E*(ρ_1 + ρ_2)], S; S/m² of K per area. Resistivities ρ, Ω m; 0: a perfect conductor.
/// normal_stiffness   N/m
/// contact_modulus    E*, Pa
double electrical_conductance(double normal_stiffness, double contact_modulus, double resistivity_1,
                              double resistivity_2);

/// 2K/[E*(1/κ_1 + 1/κ_2)], W/K; W/(m² K) of K per area. Conductivities κ, W/(m K); infinite: a
/// perfect conductor. Solid spots alone: neither radiation nor what fills the gap.
double thermal_conductance(double normal_stiffness, double contact_modulus, double conductivity_1,
                           double conductivity_2);

/// How the bodies conduct. Of each list: two numbers are the two bodies, one number is both of
/// them, none is not asked about.
struct Conduction {
  std::vector<double> conductivity = {};  ///< κ, W/(m K)
  std::vector<double> resistivity = {};   ///< ρ, Ω m

  bool given() const { return !conductivity.empty() || !resistivity.empty(); }
  /// Throws InvalidInput naming a list of more than two numbers, or as the functions above.
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

/// Per nominal area; NaN where it was not asked about.
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

/// Those that were asked about, of K per area, Pa/m.
Conductances conductances(double normal_stiffness_per_area, double contact_modulus,
                          const Conduction& conduction);

}  // namespace salebra
