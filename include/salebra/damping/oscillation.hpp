// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>

namespace salebra {

/// Case (a): z = u_z cos ωt, x = u_x cos(ωt + φ0).
struct EqualFrequency {
  double normal_amplitude = 0;      ///< u_z >= 0, m
  double tangential_amplitude = 0;  ///< u_x, m
  double phase = 0;                 ///< φ0, rad
  /// ω > 0, rad/s, or 0 where it is not known: the work per cycle does not depend on it, only power and damping constant do.
  double angular_frequency = 0;
};

/// Case (b): z = u_z cos ωt while the body is drawn tangentially at constant velocity.
struct Drag {
  double normal_amplitude = 0;   ///< u_z >= 0, m
  double drag_velocity = 0;      ///< v, m/s
  double angular_frequency = 0;  ///< ω > 0, rad/s
};

using Oscillation = std::variant<EqualFrequency, Drag>;

/// What stays fixed over a cycle while u_z is finite: the mean indentation, or the mean force (a dead weight).
enum class Hold { indentation, force };

}  // namespace salebra
