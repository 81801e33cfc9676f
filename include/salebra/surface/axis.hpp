// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/enum_names.hpp>

namespace salebra {

/// The direction of the profiles of a surface, as in `profile_psd(surface, Axis::x)`.
enum class Axis { x, y };

template <>
struct EnumNames<Axis> {
  static constexpr auto values =
      std::to_array<std::pair<Axis, std::string_view>>({{Axis::x, "x"}, {Axis::y, "y"}});
};

}  // namespace salebra
