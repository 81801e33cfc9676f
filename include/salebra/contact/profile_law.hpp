// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law.hpp>
#include <salebra/contact/material.hpp>

namespace salebra {

/// Force law of the axisymmetric profile f(r) = B rⁿ on an elastic half-space, exact (Galin, Sneddon; PHYSICS section 6):
///     δ = κ_n B aⁿ, F = 2E* n/(n+1) δ a,  κ_n = (√π n/2) Γ(n/2)/Γ((n+1)/2),
/// hence F ∝ δ^{1+1/n}. Cone: B = tanθ, n = 1. Paraboloid: B = 1/(2R), n = 2.
/// coefficient > 0, m^{1−n}; exponent > 0; material with G*. Throws InvalidInput otherwise.
PowerLaw profile_law(double coefficient, double exponent, const Material& material);

}  // namespace salebra
