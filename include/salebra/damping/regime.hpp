// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/enum_names.hpp>

namespace salebra {

/// Extent of slip in a contact, and whether it lifts off.
enum class Regime {
  no_slip,       ///< both assumptions of no slip hold: slip changes the loss by at most 5 %
  partial_slip,  ///< some springs slip, others that carry part of the force stick
  /// All springs slip except the deepest ones: a contact as small as these carries less than 5 % of
  /// the mean normal force. At a constant normal force F_x then exceeds 0.95 μF. If the
  /// contact opens in each cycle, sliding means that no spring ever sticks; in case (b) this
  /// happens at velocities v >= v_c = (μ/g) u_z ω with g = K_t/K. For v < v_c, case (b) counts as
  /// sliding only if the slip of closed springs loses more energy than the relaxation of springs
  /// that open; otherwise the tangential force grows with velocity, as for a damper.
  sliding,
  /// A parameter is missing; or the excursion of case (b) is shorter than the distance travelled
  /// per normal cycle, so that the motion is not slow.
  unknown,
  /// The contact lifts off in every cycle, and does not slide as a whole while it touches.
  lifts_off
};
template <>
struct EnumNames<Regime> {
  static constexpr auto values =
      std::to_array<std::pair<Regime, std::string_view>>({{Regime::no_slip, "no slip"},
                                                          {Regime::partial_slip, "partial slip"},
                                                          {Regime::sliding, "sliding"},
                                                          {Regime::unknown, "unknown"},
                                                          {Regime::lifts_off, "lifts off"}});
};

}  // namespace salebra
