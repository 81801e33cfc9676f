// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

}  // namespace salebra
