// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Parses and formats quantities such as "10 µm", "20kHz", "1e-7":
///     const double width = parse_quantity("10 µm", Dimension::length, "width");
/// Internally salebra uses SI units only.
namespace salebra {

/// Dimension of a quantity.
enum class Dimension {
  dimensionless,
  length,                  ///< m
  length_squared,          ///< m²
  length_cubed,            ///< m³; spectral density of a profile
  length_to_the_fourth,    ///< m⁴; spectral density of a surface
  inverse_length,          ///< 1/m; curvature of a surface
  inverse_length_squared,  ///< 1/m²; spectral moment m4, number per area
  pressure,                ///< Pa
  inverse_pressure,        ///< 1/Pa
  force,                   ///< N
  stiffness,               ///< N/m
  stiffness_per_area,      ///< Pa/m; printed in GPa/µm
  force_curvature,         ///< N/m², F''
  damping,                 ///< N s/m
  mass,                    ///< kg
  mass_density,            ///< kg/m³
  angle,                   ///< rad
  wavenumber,              ///< rad/m
  frequency,               ///< Hz
  angular_frequency,       ///< rad/s
  velocity,                ///< m/s
  time,                    ///< s
  energy,                  ///< J
  energy_per_area,         ///< J/m²
  power,                   ///< W
  resistivity,             ///< Ω m
  thermal_conductivity,    ///< W/(m K)
  conductance_per_area,    ///< S/m²
  thermal_conductance,     ///< W/(m² K), per area
};

/// Returns the SI unit as written in files, for example "m", "rad/s" or "1/m^2"; "1" for
/// dimensionless numbers.
std::string_view si_unit(Dimension dimension);

/// Converts "<number>[ ]<unit>", such as "10um", "115 GPa", "90deg", "0.1", to SI units. A number
/// without a unit is in SI units. Units may have the prefixes f p n u µ m c k M G T; lengths also
/// "Å", angles "deg" and "°", pressures "bar" and "N/mm^2", pure numbers "%". Powers are written
/// mm2, mm^2 or mm².
/// field   name of the option or key in errors
/// throws  InvalidInput for anything except one number with a unit of the dimension, and wherever
///         require_squarable does
double parse_quantity(std::string_view text, Dimension dimension, std::string_view field);

/// Throws InvalidInput unless the number is 0 or its magnitude is from 1e-150 to 1e150, so that a
/// double can represent its square. text: the number as the user wrote it, for the message.
void require_squarable(double value, std::string_view text, std::string_view field);

/// Parses one value, a list "a,b,c", or a range "from:to:count" of count >= 2 values in geometric
/// progression, which includes the values from and to exactly (from, to > 0, not equal). A unit
/// after `to` also applies to a `from` without one: "1:100MPa:5".
std::vector<double> parse_values(std::string_view text, Dimension dimension,
                                 std::string_view field);

/// Formats a number with `digits` significant digits and an SI prefix if its unit may have one,
/// e.g. "1.234 µm" or "115 GPa"; "n/a" for NaN.
std::string format_quantity(double value, Dimension dimension, int digits = 4);

}  // namespace salebra
