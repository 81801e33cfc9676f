// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/grid.hpp>
#include <salebra/damping/oscillation.hpp>
#include <vector>

// The loss of a cycle as a linear functional of K_t over the phase θ, with δ(θ) = δ0 + u_z cosθ
// (docs/theory.md, section 7), for (a) a tangential oscillation of amplitude u_x and phase φ0 at
// the normal frequency and (b) a slow drag with the velocity v:
//     (a) W = 2u_x² sin²φ0 ∫_0^π K_t sin2θ dθ        (b) W = 4(v/ω)² ∫_0^π θ [K_t − K_t(π)] dθ
namespace salebra::detail {

struct Node {
  double theta, weight;
};

// Nodes and weights of the Gauss–Legendre rule on the phases [0, π].
std::vector<Node> gauss_nodes(int count);

// Loss W from K_t at the nodes. stiffness: K_t by index of the node; least: K_t at θ = π.
double loss(const Oscillation& motion, const std::vector<Node>& nodes,
            const std::function<double(std::size_t)>& stiffness, double least);

// Loss W of a smooth function K_t(θ), exact to round-off.
double loss_of(const Oscillation& motion, const std::function<double(double)>& stiffness);

// Derivative of the Chebyshev polynomial T_l at c = cosθ with respect to c: l sin(lθ)/sinθ, or its
// limit ±l² at θ = 0 and π.
double chebyshev_slope(Index l, double theta);

double normal_amplitude(const Oscillation& motion);

}  // namespace salebra::detail
