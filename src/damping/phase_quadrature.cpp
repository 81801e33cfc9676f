// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature of the loss over the phase of a cycle.
#include "phase_quadrature.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "base/stop_check.hpp"

namespace salebra::detail {
namespace {

using std::numbers::pi;

// With this many nodes the loss of a smooth function is exact to round-off.
constexpr int fine_nodes = 96;

}  // namespace

std::vector<Node> gauss_nodes(int count) {
  std::vector<Node> nodes;
  for (int k = count; k >= 1; --k) {
    stop_if_asked();
    double x = std::cos(pi * (k - 0.25) / (count + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double previous = 1, value = x;  // Legendre polynomials P_0(x), P_1(x)
      for (int l = 2; l <= count; ++l) {
        const double next = ((2 * l - 1) * x * value - (l - 1) * previous) / l;
        previous = value;
        value = next;
      }
      slope = count * (x * value - previous) / (x * x - 1);
      x -= value / slope;
    }
    nodes.push_back({pi / 2 * (1 + x), pi / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

double loss(const Oscillation& motion, const std::vector<Node>& nodes,
            const std::function<double(std::size_t)>& stiffness, double least) {
  double sum = 0;
  if (const auto* equal = std::get_if<EqualFrequency>(&motion)) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      sum += nodes[k].weight * stiffness(k) * std::sin(2 * nodes[k].theta);
    return 2 * std::pow(equal->tangential_amplitude * std::sin(equal->phase), 2) * sum;
  }
  const auto& drag = std::get<Drag>(motion);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    sum += nodes[k].weight * nodes[k].theta * (stiffness(k) - least);
  return 4 * std::pow(drag.drag_velocity / drag.angular_frequency, 2) * sum;
}

double normal_amplitude(const Oscillation& motion) {
  return std::visit([](const auto& m) { return m.normal_amplitude; }, motion);
}

double loss_of(const Oscillation& motion, const std::function<double(double)>& stiffness) {
  static const std::vector<Node> nodes = gauss_nodes(fine_nodes);
  return loss(
      motion, nodes, [&](std::size_t k) { return stiffness(nodes[k].theta); }, stiffness(pi));
}

double chebyshev_slope(Index l, double theta) {
  const double order = static_cast<double>(l), sine = std::sin(theta);
  if (sine > 1e-7) return order * std::sin(order * theta) / sine;
  return std::cos(theta) > 0 || l % 2 == 1 ? order * order : -order * order;
}

}  // namespace salebra::detail
