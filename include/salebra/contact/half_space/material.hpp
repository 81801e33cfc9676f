// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace salebra {

/// Boundary conditions. periodic: the surface repeats in x and y, and displacements have zero mean
/// over one period (they are measured from the far field). free: one loaded patch on an infinite
/// half-space, with zero displacement far away.
enum class Boundary { periodic, free };

template <>
struct EnumNames<Boundary> {
  static constexpr auto values = std::to_array<std::pair<Boundary, std::string_view>>(
      {{Boundary::periodic, "periodic"}, {Boundary::free, "free"}});
};

/// One elastic half-space; a rigid body has an infinite modulus.
struct ElasticBody {
  double young = std::numeric_limits<double>::infinity();  ///< Young's modulus E > 0, Pa
  double poisson = 0;                                      ///< ν, −1 < ν <= 0.5

  double shear() const { return young / (2 * (1 + poisson)); }  ///< G, Pa
};

constexpr void describe(auto&& visit, std::type_identity<ElasticBody>) {
  using S = ElasticBody;
  visit(&S::young, Kept{"young", "Young's modulus E", Dimension::pressure});
  visit(&S::poisson, Kept{"poisson", "Poisson's ratio"});
  visit(&S::shear, Kept{"shear", "shear modulus G = E/(2(1+ν))", Dimension::pressure});
}

/// Elastic constants of a contact of two bodies:
///     1/E* = Σ (1−ν_i²)/E_i        Eq. (1)        1/G* = Σ (2−ν_i)/(4 G_i)        Eq. (2)
/// Steel against a rigid body, for example:
///     const Material steel = Material::of_bodies({.young = 210e9, .poisson = 0.3});
struct Material {
  double contact_modulus = 0;     ///< E*, Pa
  double tangential_modulus = 0;  ///< G*, Pa; NaN if only E* was given
  /// Cerruti's constants for the tangential displacement under a shear traction (docs/theory.md,
  /// section 5), 1/Pa.
  double cerruti_isotropic = 0;  ///< Σ (1−ν_i)/(2π G_i)
  double cerruti_directed = 0;   ///< Σ ν_i/(2π G_i)

  /// Returns G*/E*. If G* is unknown, throws InvalidInput, whose message names tangential_modulus;
  /// there is no default.
  double modulus_ratio() const;

  /// Computes the constants of two bodies; the default second body is rigid. Throws InvalidInput
  /// unless young > 0 and −1 < poisson <= 0.5 for each body, and at least one is not rigid.
  static Material of_bodies(const ElasticBody& first, const ElasticBody& second = {});
  /// Describes one elastic body with E* = E/(1−ν²) against a rigid one: G* = 2E*(1−ν)/(2−ν).
  static Material of_contact_modulus(double contact_modulus, double poisson);
  /// Takes E* and G* as given. The Cerruti constants are those of one elastic body with this G*/E*;
  /// a ratio outside [2/3, 4/3] (ν from 0.5 to −1) makes them NaN.
  static Material of_moduli(double contact_modulus, double tangential_modulus);
  /// Makes a material with E* only, which suffices for normal contact: G* and the Cerruti constants
  /// are NaN, and modulus_ratio() throws.
  static Material of_contact_modulus(double contact_modulus);
};

constexpr void describe(auto&& visit, std::type_identity<Material>) {
  visit(&Material::contact_modulus,
        Quantity{"contact_modulus", Dimension::pressure, "contact modulus E*"});
  visit(&Material::tangential_modulus,
        Quantity{"tangential_modulus", Dimension::pressure, "tangential modulus G*"});
  visit(&Material::cerruti_isotropic,
        Kept{"cerruti_isotropic", "sum of (1 - nu)/(2 pi G)", Dimension::inverse_pressure});
  visit(&Material::cerruti_directed,
        Kept{"cerruti_directed", "sum of nu/(2 pi G)", Dimension::inverse_pressure});
  visit(&Material::modulus_ratio, Quantity{"modulus_ratio", Dimension::dimensionless, "G*/E*"});
}

/// Returns the text of a warning if the nominal pressure exceeds E*/10: strains of the whole
/// surface are then no longer small, and usually a pressure or modulus was given in the wrong unit.
std::optional<std::string> warning_of_pressure(double nominal_pressure, double contact_modulus);

}  // namespace salebra
