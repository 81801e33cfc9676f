// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/contact/law/law.hpp>
#include <vector>

namespace salebra_test {

/// An independent sum over the springs of a law under an oscillation, followed in time. A spring
/// stands for a range of depths: its stiffnesses are the gains of K and K_t over this range, and its
/// depth is the mean depth of the range, weighted by K'. Coulomb's law limits the force of each
/// spring by its own normal force. The loss is ∮T dx, not a sum of losses of springs.
class JointSprings {
 public:
  struct Loop {
    double work = 0, force = 0;                        ///< J, half the range of T in N
    double storage_stiffness = 0, loss_stiffness = 0;  ///< first harmonic of T over that of x, N/m
    double mean_force = 0, max_friction = 0;           ///< cycle mean of F, N; largest |T|/F
  };

  /// Springs between the depths `low` and `high`; F(low) must be 0 or negligible.
  JointSprings(const salebra::ContactLaw& law, double low, double high, double friction, int count)
      : friction_(friction) {
    for (int i = 0; i < count; ++i) {
      // Narrow ranges near first touch, where K' of a sphere is infinite, and at the top, where slip
      // begins.
      const auto edge = [&](int k) {
        return low + (high - low) * std::pow(std::sin(0.5 * std::numbers::pi * k / count), 2);
      };
      const double a = edge(i), b = edge(i + 1);
      const double normal = law.normal_stiffness(b) - law.normal_stiffness(a);
      if (!(normal > 0)) continue;
      const double moment =
          b * law.normal_stiffness(b) - a * law.normal_stiffness(a) - (law.force(b) - law.force(a));
      springs_.push_back(
          {moment / normal, normal, law.tangential_stiffness(b) - law.tangential_stiffness(a)});
    }
  }

  /// The second period of δ = mean + u_z cos θ, x = amplitude · cos(θ + phase), which is steady.
  Loop cycle(double mean, double normal_amplitude, double amplitude, double phase, int steps) {
    double indentation = 0, x = 0, tangential = 0;
    Loop loop;
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i <= 2 * steps; ++i) {
      const double angle = 2 * std::numbers::pi * i / steps + std::numbers::pi;
      const double next = mean + normal_amplitude * std::cos(angle);
      const double next_x = amplitude * std::cos(angle + phase);
      double force = 0, normal_force = 0;
      for (Spring& spring : springs_) {
        const double pressed = next - spring.depth;
        if (!(pressed > 0)) continue;
        if (i == 0)
          spring.anchor = next_x;
        else if (!(indentation > spring.depth))  // it touches during the step
          spring.anchor = x + (next_x - x) * (spring.depth - indentation) / (next - indentation);
        const double normal = spring.normal * pressed;
        const double limit = friction_ * normal / spring.tangential;
        spring.anchor = std::clamp(spring.anchor, next_x - limit, next_x + limit);
        force += spring.tangential * (next_x - spring.anchor);
        normal_force += normal;
      }
      if (i > steps) {
        loop.work += 0.5 * (force + tangential) * (next_x - x);
        loop.storage_stiffness += 2 * force * std::cos(angle + phase) / steps / amplitude;
        loop.loss_stiffness -= 2 * force * std::sin(angle + phase) / steps / amplitude;
        loop.mean_force += normal_force / steps;
        low = std::min(low, force), high = std::max(high, force);
        if (normal_force > 0)
          loop.max_friction = std::max(loop.max_friction, std::abs(force) / normal_force);
      }
      indentation = next, x = next_x, tangential = force;
    }
    loop.force = 0.5 * (high - low);
    return loop;
  }

 private:
  struct Spring {
    double depth, normal, tangential, anchor = 0;
  };
  std::vector<Spring> springs_;
  double friction_;
};

}  // namespace salebra_test
