// SPDX-License-Identifier: GPL-3.0-or-later
// 16_implicit_block — shakes a block on a rough contact and on springs to the ground in three
// directions. The implicit integrator rejects steps, so the contact element returns forces and
// their derivatives for a trial step without taking it.
// Sample runs:  16_implicit_block        16_implicit_block 1e-3
#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/contact_element.hpp>

using namespace salebra;
using Eigen::Matrix3d;
using Eigen::Vector3d;

int main(int argc, char** argv) try {
  const double tolerance = argc > 1 ? std::atof(argv[1]) : 1e-2;  // per step, over the decay length

  // 1. The law becomes a stack of springs once, for all contacts that share it.
  const double load = 10, decay_length = 100e-9, mass = 1, spring = 1e7;  // N, m, kg, N/m
  const ExponentialLaw law(load, decay_length,
                           Material::of_contact_modulus(115e9, 0.3).modulus_ratio());
  const auto table = std::make_shared<const LawSprings>(
      law, -50e-9, 50e-9, LawSpringsOptions{.friction_coefficient = 0.3});
  ContactElement contact(table);
  contact.start(0, 0, 0);

  // 2. The equation of motion is m a + f(q) + springs = load(t) with q = (indentation, x, y).
  const auto outside = [&](double time, const Vector3d& q) {
    const double angle = 2e4 * time;
    return Vector3d(load + 4 * std::sin(3 * angle), 2.5 * std::sin(angle) - spring * q[1],
                    2.5 * std::cos(angle) - spring * q[2]);
  };
  const Matrix3d springs = Vector3d(0, spring, spring).asDiagonal();
  const auto inside = [](const ElementForces& forces) {
    return Vector3d(forces.normal_force, forces.tangential_force[0], forces.tangential_force[1]);
  };

  // 3. In the trapezoidal rule, Newton's method finds the end of a step before the step is taken.
  Vector3d q = Vector3d::Zero(), v = Vector3d::Zero();
  Vector3d a = (outside(0, q) - inside(contact.forces(0, 0, 0))) / mass;
  double time = 0, step = 1e-4;
  int taken = 0, rejected = 0, iterations = 0;
  while (time < 5e-3) {
    const double now = std::min(step, 5e-3 - time);
    const Vector3d predicted = q + now * v + now * now / 2 * a;
    Vector3d end = predicted, acceleration;
    bool converged = false;
    for (int iteration = 0; iteration < 12 && !converged; ++iteration, ++iterations) {
      const ElementForces forces = contact.forces(end[0], end[1], end[2]);
      acceleration = (end - q - now * v) * 4 / (now * now) - a;
      const Vector3d residual = mass * acceleration + inside(forces) - outside(time + now, end);
      Matrix3d stiffness = springs + mass * 4 / (now * now) * Matrix3d::Identity();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) stiffness(i, j) += forces.stiffness[i][j];
      const Vector3d change = stiffness.partialPivLu().solve(residual);
      end -= change;
      converged = change.norm() < 1e-10 * decay_length;
    }
    // If a step does not converge, or ends far from the prediction, try a shorter one: the contact
    // has not moved.
    const double error = (end - predicted).norm() / decay_length;
    if (!converged || error > tolerance) {
      step = now / 2, ++rejected;
      continue;
    }
    contact.move_to(end[0], end[1], end[2]);
    acceleration = (end - q - now * v) * 4 / (now * now) - a;
    v += now / 2 * (a + acceleration);
    q = end, a = acceleration, time += now, ++taken;
    if (error < tolerance / 8) step = now * 1.5;
  }

  // 4. Because of the normal vibration the block slips and settles on its springs.
  std::printf("%d steps taken, %d rejected, %.1f iterations a step\n", taken, rejected,
              double(iterations) / (taken + rejected));
  std::printf("after 5 ms at x = %.2f nm, y = %.2f nm, indentation %.2f nm\n", 1e9 * q[1],
              1e9 * q[2], 1e9 * q[0]);
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
