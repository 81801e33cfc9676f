// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/slider.hpp>
#include <salebra/results/words.hpp>

/// The words of a slider's enumerations, apart from the others, which nearly every source includes.
namespace salebra {

template <>
struct Words<SliderStart> {
  static constexpr auto values = std::to_array<std::pair<SliderStart, std::string_view>>(
      {{SliderStart::rest, "rest"}, {SliderStart::sliding, "sliding"}});
};
template <>
struct Words<SliderState> {
  static constexpr auto values = std::to_array<std::pair<SliderState, std::string_view>>(
      {{SliderState::steady, "steady"},
       {SliderState::pulsating, "pulsating"},
       {SliderState::stick_slip, "stick_slip"}});
};

}  // namespace salebra
