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
    Quantity{"work_by_levels", energy, "energy dissipated in a cycle, from contact levels"},
    Quantity{"error_estimate", energy, "estimated error of the energy from contact levels"},
    Quantity{"predicted", energy, "energy dissipated in a cycle, Eq. (12) or (15)"},
    Quantity{"predicted_finite", energy, "energy dissipated in a cycle by K_t = (G*/E*)K"},
    Quantity{"released_energy", energy, "energy released by cells that leave the contact"},
    Quantity{"work", energy, "work of the tangential force since the start"},
    Quantity{"contact_area_min", length_squared, "least contact area of a cycle"},
    Quantity{"contact_area_max", length_squared, "greatest contact area of a cycle"},
    Quantity{"closed_form", energy, "energy dissipated in a cycle, closed form"},
    Quantity{"power", Dimension::power, "mean dissipated power"},
    Quantity{"damping_constant", damping, "damping constant P/v^2"},
    Quantity{"contact_radius", length, "contact radius"},
    Quantity{"least_contact_radius", length, "contact radius at the least indentation"},
    Quantity{"relaxation_work", energy,
             "energy dissipated in a cycle by springs that open and close"},
    Quantity{"slip_work", energy, "energy dissipated in a cycle by slip in permanent contact"},
    Quantity{"full_stick_work", energy, "energy dissipated in a cycle without slip"},
    Quantity{"small_amplitude_work", energy, "energy dissipated in a cycle, small-amplitude form"},
    Quantity{"storage_stiffness", stiffness, "mean tangential stiffness in phase with the motion"},
    Quantity{"loss_factor", dimensionless, "energy dissipated over 2 pi times energy stored"},
    Quantity{"contact_stiffness", stiffness, "tangential stiffness of what is always in contact"},
    Quantity{"natural_frequency", angular_frequency, "natural angular frequency of the oscillator"},
    Quantity{"damping_ratio", dimensionless, "damping over critical damping"},
    Quantity{"quality_factor", dimensionless, "quality factor"},
    Quantity{"decay_time", Dimension::time, "time in which the amplitude falls by e"},
    Quantity{"logarithmic_decrement", dimensionless, "logarithmic decrement"},
    Quantity{"mass", mass, "mass of the oscillator"},
    Quantity{"spring_stiffness", stiffness, "stiffness of the spring beside the contact"},
    Quantity{"falling_slope", damping, "decrease of friction with velocity"},
    Quantity{"stabilising_amplitude", length, "least normal amplitude that stabilises the slider"},
    Quantity{"friction_number", dimensionless, "M = mu E* u_z/(G* u_x)"},
    Quantity{"tangential_force", force, "tangential force"},
    Quantity{"shear", pressure, "tangential stress"},
};

}  // namespace

Quantity find_quantity(std::string_view name) {
  const auto* found = std::ranges::find(quantities, name, &Quantity::name);
  return found != quantities.end() ? *found : Quantity{name, dimensionless, name};
}

}  // namespace salebra
