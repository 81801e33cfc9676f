// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/enum_names.hpp>
#include <vector>

namespace salebra {

/// The quantity that is held while a contact is pressed.
enum class ControlQuantity { normal_force, indentation, pressure, mean_gap };

template <>
struct EnumNames<ControlQuantity> {
  static constexpr auto values = std::to_array<std::pair<ControlQuantity, std::string_view>>(
      {{ControlQuantity::normal_force, "normal_force"},
       {ControlQuantity::indentation, "indentation"},
       {ControlQuantity::pressure, "pressure"},
       {ControlQuantity::mean_gap, "mean_gap"}});
};

/// The state in which a contact is held: a control quantity and its value.
///     const OperatingPoint point = at_pressure(2e6);
/// A contact law knows forces and indentations only. A surface accepts all four control quantities,
/// with two exceptions: a free contact has no mean gap, and with a hardness the mean gap cannot be
/// prescribed.
struct OperatingPoint {
  ControlQuantity control = ControlQuantity::normal_force;
  double value = 0;

  /// True for a force or a pressure.
  bool load_given() const {
    return control == ControlQuantity::normal_force || control == ControlQuantity::pressure;
  }
  bool operator==(const OperatingPoint&) const = default;
};

/// Normal force, N.
constexpr OperatingPoint at_force(double force) { return {ControlQuantity::normal_force, force}; }
/// Rigid approach from first touch, m, or for a contact law its own indentation δ. For a periodic
/// contact it must be below max h − mean h with the heights h.
constexpr OperatingPoint at_indentation(double indentation) {
  return {ControlQuantity::indentation, indentation};
}
/// Nominal pressure, Pa.
constexpr OperatingPoint at_pressure(double pressure) {
  return {ControlQuantity::pressure, pressure};
}
/// Mean gap ū of the deformed surfaces of a periodic contact, m; it must be below max h − mean h
/// with the heights h.
constexpr OperatingPoint at_mean_gap(double mean_gap) {
  return {ControlQuantity::mean_gap, mean_gap};
}

/// Several values of one control quantity.
struct OperatingPoints {
  ControlQuantity control = ControlQuantity::normal_force;
  std::vector<double> values = {};  ///< N, m or Pa, depending on control
};

}  // namespace salebra
