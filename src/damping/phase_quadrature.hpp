// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/grid.hpp>
#include <salebra/damping/oscillation.hpp>
#include <vector>

// The loss of a cycle as a linear functional of K_t over the phase θ, δ(θ) = δ0 + u_z cosθ
// (docs/theory.md, section 7):
//     (a) W = 2u_x² sin²φ0 ∫_0^π K_t sin2θ dθ        (b) W = 4(v/ω)² ∫_0^π θ [K_t − K_t(π)] dθ
namespace salebra::detail {

struct Node {
  double theta, weight;
};

// Gauss–Legendre nodes on [0, π].
std::vector<Node> gauss_nodes(int count);

// W from K_t at the nodes. least: K_t at θ = π.
double loss(const Oscillation& motion, const std::vector<Node>& nodes,
            const std::function<double(std::size_t)>& stiffness, double least);

// W of a smooth K_t(θ), to round-off.
double loss_of(const Oscillation& motion, const std::function<double(double)>& stiffness);

// T_l'(c) at c = cosθ: l sin(lθ)/sinθ, and its limits l², ∓l² at the ends.
double chebyshev_slope(Index l, double theta);

double normal_amplitude(const Oscillation& motion);

}  // namespace salebra::detail
