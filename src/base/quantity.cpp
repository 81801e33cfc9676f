// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <salebra/base/quantity.hpp>

namespace salebra {
namespace {

using enum Dimension;
constexpr std::array quantities{
    Quantity{"size_x", length, "length of the surface along x"},
    Quantity{"size_y", length, "length of the surface along y"},
    Quantity{"x", length, "position along x"},
    Quantity{"y", length, "position along y"},
    Quantity{"heights", length, "height, a hill is positive"},
    Quantity{"mean", length, "mean height"},
    Quantity{"rms_height", length, "root mean square height"},
    Quantity{"rms_slope", dimensionless, "root mean square of the gradient"},
    Quantity{"moment0", length_squared, "spectral moment m0"},
    Quantity{"moment2", dimensionless, "spectral moment m2 of a profile"},
    Quantity{"moment4", inverse_length_squared, "spectral moment m4 of a profile"},
    Quantity{"nayak", dimensionless, "Nayak parameter m0 m4 / m2^2"},
    Quantity{"skewness", dimensionless, "skewness of heights"},
    Quantity{"kurtosis", dimensionless, "kurtosis of heights, 3 for a Gaussian"},
    Quantity{"density", inverse_length_squared, "summits per area"},
    Quantity{"radius", length, "radius of summits"},
    Quantity{"mean_radius", length, "mean radius of summits"},
    Quantity{"summit_rms", length, "standard deviation of summit heights"},
    Quantity{"mean_height", length, "mean summit height above the mean plane"},
    Quantity{"nominal_area", length_squared, "nominal area"},
    Quantity{"contact_modulus", pressure, "contact modulus E*"},
    Quantity{"tangential_modulus", pressure, "tangential modulus G*"},
    Quantity{"modulus_ratio", dimensionless, "G*/E*"},
    Quantity{"pressure", pressure, "nominal pressure"},
    Quantity{"max_pressure", pressure, "largest contact pressure"},
    Quantity{"force", force, "normal force"},
    Quantity{"contact_area_fraction", dimensionless, "contact area over nominal area"},
    Quantity{"mean_gap", length, "mean gap of the deformed surfaces"},
    Quantity{"indentation", length, "indentation"},
    Quantity{"separation", length, "distance of the smooth plane from the mean plane of summits"},
    Quantity{"elastic_energy", energy, "elastic energy"},
    Quantity{"normal_stiffness", stiffness, "normal stiffness dF/d(indentation)"},
    Quantity{"tangential_stiffness", stiffness, "tangential stiffness in full stick"},
    Quantity{"curvature", curvature, "second derivative of force by indentation"},
    Quantity{"seconds", Dimension::time, "wall time"},
    Quantity{"decay_length", length, "decay length of force with mean gap"},
    Quantity{"decay_length_low", length, "decay length, lower 95 % limit"},
    Quantity{"decay_length_high", length, "decay length, upper 95 % limit"},
    Quantity{"decay_length_over_rms_height", dimensionless, "decay length over rms height"},
    Quantity{"local_decay_length", length, "local decay length -d(mean gap)/d ln(pressure)"},
    Quantity{"reference_pressure", pressure, "fitted pressure at zero mean gap"},
    Quantity{"pressure_min", pressure, "lowest pressure of the fit"},
    Quantity{"pressure_max", pressure, "highest pressure of the fit"},
    Quantity{"normal_amplitude", length, "amplitude of the normal oscillation"},
    Quantity{"tangential_amplitude", length, "amplitude of the tangential oscillation"},
    Quantity{"phase", angle, "phase between the oscillations"},
    Quantity{"frequency", frequency, "frequency"},
    Quantity{"angular_frequency", angular_frequency, "angular frequency"},
    Quantity{"drag_velocity", velocity, "drag velocity"},
    Quantity{"work_per_cycle", energy, "energy dissipated in a cycle"},
    Quantity{"closed_form", energy, "energy dissipated in a cycle, closed form"},
    Quantity{"power", Dimension::power, "mean dissipated power"},
    Quantity{"damping_constant", damping, "damping constant P/v^2"},
    Quantity{"contact_radius", length, "contact radius"},
};

}  // namespace

Quantity find_quantity(std::string_view name) {
  const auto* found = std::ranges::find(quantities, name, &Quantity::name);
  return found != quantities.end() ? *found : Quantity{name, dimensionless, name};
}

}  // namespace salebra
