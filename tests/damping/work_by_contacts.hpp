// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/oscillation.hpp>
#include <vector>

namespace salebra {

/// W of a slow tangential motion without surface_damping(): of the mean K between `intervals` + 1
/// contacts by their forces, and of K of the last. stick: with K_t/((G*/E*)K) of stick solves at
/// both ends and in the middle, else K_t = (G*/E*)K.
inline double work_by_contacts(const Surface& surface, const Material& material, double pressure,
                               const Drag& motion, int intervals, bool stick) {
  constexpr double pi = std::numbers::pi;
  NormalContactOptions options;
  options.tolerance = 1e-9;
  NormalContactState state =
      press(surface, material.contact_modulus, {.pressure = pressure}, options);
  const double center = state.indentation;
  Field start = state.contact_pressure;
  options.initial_pressure = &start;
  std::vector<double> force, place;
  std::array<double, 3> ratio{1, 1, 1};
  double last = 0;
  for (int k = 0; k <= intervals; ++k) {
    place.push_back(center + motion.normal_amplitude * std::cos(pi * k / intervals));
    force.push_back(0);
    last = 0;
    if (!(place.back() > 0)) continue;
    state = press(surface, material.contact_modulus, {.indentation = place.back()}, options);
    start = state.contact_pressure;
    force.back() = state.force;
    if (stick ? k % (intervals / 2) != 0 : k != intervals) continue;
    last = normal_stiffness(state, surface.grid, material.contact_modulus, options);
    if (stick)
      ratio[static_cast<std::size_t>(2 * k / intervals)] =
          stick_stiffness(contact_set(state), surface.grid, material, {.tolerance = 1e-4}, true)
              .xx /
          (material.modulus_ratio() * last);
  }
  const auto ratio_at = [&](double x) {
    return ratio[1] + x * (ratio[0] - ratio[2]) / 2 +
           x * x * ((ratio[0] + ratio[2]) / 2 - ratio[1]);
  };
  double sum = 0;
  for (std::size_t k = 0; k + 1 < force.size(); ++k) {
    const double from = pi * double(k) / intervals, to = pi * double(k + 1) / intervals;
    const double mean = (force[k] - force[k + 1]) / (place[k] - place[k + 1]);
    sum += (to * to - from * from) / 2 *
           (mean * ratio_at((std::cos(from) + std::cos(to)) / 2) - last * ratio[2]);
  }
  const double way = motion.drag_velocity / motion.angular_frequency;
  return 4 * way * way * material.modulus_ratio() * sum;
}

}  // namespace salebra
