// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/oscillation.hpp>
#include <salebra/results/describe.hpp>

namespace salebra {

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<EqualFrequency>) {
  using enum Dimension;
  using S = EqualFrequency;
  visit(&S::normal_amplitude,
        Quantity{"normal_amplitude", length, "amplitude of the normal oscillation"});
  visit(&S::tangential_amplitude,
        Quantity{"tangential_amplitude", length, "amplitude of the tangential oscillation"});
  visit(&S::phase, Quantity{"phase", angle, "phase between the oscillations"});
  visit(&S::angular_frequency,
        Quantity{"angular_frequency", Dimension::angular_frequency, "angular frequency"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<Drag>) {
  using enum Dimension;
  visit(&Drag::normal_amplitude,
        Quantity{"normal_amplitude", length, "amplitude of the normal oscillation"});
  visit(&Drag::drag_velocity, Quantity{"drag_velocity", velocity, "drag velocity"});
  visit(&Drag::angular_frequency,
        Quantity{"angular_frequency", Dimension::angular_frequency, "angular frequency"});
}

}  // namespace salebra
