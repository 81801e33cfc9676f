// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/results/describe.hpp>

namespace salebra {

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<Material>) {
  visit(&Material::contact_modulus,
        Quantity{"contact_modulus", Dimension::pressure, "contact modulus E*"});
  visit(&Material::tangential_modulus,
        Quantity{"tangential_modulus", Dimension::pressure, "tangential modulus G*"});
  visit(&Material::cerruti_isotropic, Kept{"cerruti_isotropic", "sum of (1 - nu)/(2 pi G), 1/Pa"});
  visit(&Material::cerruti_directed, Kept{"cerruti_directed", "sum of nu/(2 pi G), 1/Pa"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<HeightDensityPoint>) {
  visit(&HeightDensityPoint::height, Kept{"height", "height, m"});
  visit(&HeightDensityPoint::density, Kept{"density", "summits per height, 1/m"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<SummitEnsemble>) {
  using enum Dimension;
  using S = SummitEnsemble;
  visit(&S::density, Quantity{"summit_density", inverse_length_squared, "summits per area"});
  visit(&S::radius, Quantity{"radius", length, "radius of summits"});
  visit(&S::summit_rms, Quantity{"summit_rms", length, "standard deviation of summit heights"});
  visit(&S::mean_height,
        Quantity{"mean_height", length, "mean summit height above the mean plane"});
  visit(&S::distribution, Kept{"distribution", "of the summit heights"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::table, Kept{"table", "density of the heights, where it is tabulated"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<ForceSample>) {
  using enum Dimension;
  using S = ForceSample;
  visit(&S::indentation, Quantity{"indentation", length, "indentation"});
  visit(&S::mean_gap, Quantity{"mean_gap", length, "mean gap of the deformed surfaces"});
  visit(&S::separation, Quantity{"separation", length,
                                 "distance of the smooth plane from the mean plane of summits"});
  visit(&S::force, Quantity{"force", Dimension::force, "normal force"});
  visit(&S::pressure, Quantity{"pressure", Dimension::pressure, "nominal pressure"});
  visit(&S::contact_area_fraction,
        Quantity{"contact_area_fraction", dimensionless, "contact area over nominal area"});
  visit(&S::normal_stiffness,
        Quantity{"normal_stiffness", stiffness, "normal stiffness dF/d(indentation)"});
  visit(&S::tangential_stiffness,
        Quantity{"tangential_stiffness", stiffness, "tangential stiffness in full stick"});
  visit(&S::converged, Quantity{"converged", dimensionless, "whether the contact converged"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<ForceCurve>) {
  using enum Dimension;
  visit(&ForceCurve::model, Kept{"model", "contact model"});
  visit(&ForceCurve::nominal_area, Quantity{"nominal_area", length_squared, "nominal area"});
  visit(&ForceCurve::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&ForceCurve::samples, Kept{"samples", "from the lowest force to the highest"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<FirstLoading>) {
  using enum Dimension;
  using S = FirstLoading;
  visit(&S::pressure, Quantity{"first_loading_pressure", Dimension::pressure,
                               "largest nominal pressure of the plastic first loading"});
  visit(&S::yielded_area_fraction,
        Quantity{"yielded_area_fraction", dimensionless,
                 "area that carried the hardness in the first loading over nominal area"});
  visit(&S::mean_plastic_depth,
        Quantity{"mean_plastic_depth", length,
                 "depth that the first loading left, mean over the nominal area"});
  visit(&S::max_plastic_depth,
        Quantity{"max_plastic_depth", length, "largest depth that the first loading left"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<PressureWindow>) {
  using enum Dimension;
  using S = PressureWindow;
  visit(&S::pressure_min, Quantity{"pressure_min", pressure, "lowest pressure of the fit"});
  visit(&S::pressure_max, Quantity{"pressure_max", pressure, "highest pressure of the fit"});
  visit(&S::points, Kept{"points", "samples in the window"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<ExponentialFit>) {
  using enum Dimension;
  using S = ExponentialFit;
  visit(&S::decay_length, Quantity{"decay_length", length, "decay length of force with mean gap"});
  visit(&S::decay_length_low,
        Quantity{"decay_length_low", length, "decay length, lower 95 % limit"});
  visit(&S::decay_length_high,
        Quantity{"decay_length_high", length, "decay length, upper 95 % limit"});
  visit(&S::reference_pressure,
        Quantity{"reference_pressure", pressure, "fitted pressure at zero mean gap"});
  visit(&S::r_squared,
        Quantity{"r_squared", dimensionless, "coefficient of determination of the fit"});
  visit(&S::window, Part{"window", "pressures of the fit"});
  visit(&S::decay_length_over_rms_height,
        Quantity{"decay_length_over_rms_height", dimensionless, "decay length over rms height"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<ExponentialTest>) {
  using enum Dimension;
  using S = ExponentialTest;
  visit(&S::quadratic, Quantity{"quadratic", inverse_length_squared,
                                "coefficient of the squared mean gap in ln p"});
  visit(&S::standard_error, Quantity{"standard_error", inverse_length_squared,
                                     "standard error of the quadratic coefficient"});
  visit(&S::significance,
        Quantity{"significance", dimensionless, "probability of so large a bend if the law held"});
  visit(&S::decay_length_closest, Quantity{"decay_length_closest", length,
                                           "local decay length at the close end of the window"});
  visit(&S::decay_length_farthest, Quantity{"decay_length_farthest", length,
                                            "local decay length at the far end of the window"});
  visit(&S::window, Kept{"window", "pressures of the fit"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<WindowSensitivity>) {
  using enum Dimension;
  using S = WindowSensitivity;
  visit(&S::decay_length_min,
        Quantity{"decay_length_min", length, "minimum decay length over parts of the window"});
  visit(&S::decay_length_max,
        Quantity{"decay_length_max", length, "maximum decay length over parts of the window"});
  visit(&S::windows, Kept{"windows", "parts of the window that were fitted"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<LocalDecayLength>) {
  using enum Dimension;
  using S = LocalDecayLength;
  visit(&S::mean_gap, Quantity{"mean_gap", length, "mean gap of the deformed surfaces"});
  visit(&S::decay_length,
        Quantity{"local_decay_length", length, "local decay length -d(mean gap)/d ln(pressure)"});
}

}  // namespace salebra
