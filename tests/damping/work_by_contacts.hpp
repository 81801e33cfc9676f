// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/oscillation.hpp>
#include <utility>
#include <vector>

namespace salebra {

/// W of a slow tangential motion without surface_damping(), from the mean K between `intervals` + 1
/// contacts, by their forces, and from K of the last. stick: uses K_t/((G*/E*)K) of stick solves at
/// both ends and in the middle, otherwise K_t = (G*/E*)K.
inline double work_by_contacts(const Surface& surface, const Material& material, double pressure,
                               const Drag& motion, int intervals, bool stick) {
  constexpr double pi = std::numbers::pi;
  NormalContactOptions options;
  options.tolerance = 1e-9;
  NormalContactState state =
      press(surface, material.contact_modulus, at_pressure(pressure), options);
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
    state = press(surface, material.contact_modulus, at_indentation(place.back()), options);
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

/// W of a joint from contacts between the forces F and F − T/μ, the range of the springs that slip,
/// with K_t = K: 4μ² ∫_0^c (c − 2t) K(δ − t) dt.
inline double joint_work_by_contacts(const Surface& surface, const Material& stuck, double pressure,
                                     double tangential_force, double friction_coefficient) {
  constexpr int intervals = 16;
  NormalContactOptions options;
  options.tolerance = 1e-10;
  const NormalContactState high =
      press(surface, stuck.contact_modulus, at_pressure(pressure), options);
  const double least = high.force - tangential_force / friction_coefficient;
  const double depth = high.indentation - press(surface, stuck.contact_modulus,
                                                at_pressure(least / surface.grid.area()), options)
                                              .indentation;
  Field start = high.contact_pressure;
  options.initial_pressure = &start;
  double sum = 0, above = high.force, from = 0;
  for (int k = 1; k <= intervals; ++k) {
    const double to = depth * std::pow(std::sin(std::numbers::pi * k / (2 * intervals)), 2);
    const NormalContactState state =
        press(surface, stuck.contact_modulus, at_indentation(high.indentation - to), options);
    start = state.contact_pressure;
    sum += (above - state.force) * (depth - from - to);
    above = state.force;
    from = to;
  }
  return 4 * friction_coefficient * friction_coefficient * sum;
}

/// The law of a surface from contacts inside an oscillation about the indentation under a pressure,
/// and that indentation; K_t = (G*/E*)K.
inline std::pair<std::unique_ptr<const ContactLaw>, double> law_by_contacts(
    const Surface& surface, const Material& material, double pressure, double normal_amplitude,
    int intervals) {
  NormalContactOptions options;
  options.tolerance = 1e-10;
  NormalContactState state =
      press(surface, material.contact_modulus, at_pressure(pressure), options);
  const double center = state.indentation;
  Field start = state.contact_pressure;
  options.initial_pressure = &start;
  ForceCurve curve{.model = "bem", .nominal_area = surface.grid.area(), .samples = {}};
  for (int k = 0; k <= intervals; ++k) {
    // If the law ended exactly at the oscillation, round-off would lead out of it.
    const double place =
        center - 1.001 * normal_amplitude * std::cos(std::numbers::pi * k / intervals);
    state = press(surface, material.contact_modulus, at_indentation(place), options);
    start = state.contact_pressure;
    ForceSample& sample = curve.samples.emplace_back();
    sample.indentation = place;
    sample.force = state.force;
    sample.normal_stiffness =
        normal_stiffness(state, surface.grid, material.contact_modulus, options);
  }
  return {std::make_unique<TabulatedLaw>(curve, material.modulus_ratio()), center};
}

}  // namespace salebra
