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

/// periodic: the cell repeats for ever, and the mean of every displacement over it is zero (the far
/// field is the reference). free: one loaded patch on an infinite half-space, displacement zero far
/// away.
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

/// What a contact knows of its two bodies.
///     1/E* = Σ (1−ν_i²)/E_i        Eq. (1)        1/G* = Σ (2−ν_i)/(4 G_i)        Eq. (2)
struct Material {
  double contact_modulus = 0;     ///< E*, Pa
  double tangential_modulus = 0;  ///< G*, Pa; NaN where only E* was given
  /// Cerruti's constants, which give the tangential displacement of a shear traction
  /// (docs/theory.md, section 5), 1/Pa.
  double cerruti_isotropic = 0;  ///< Σ (1−ν_i)/(2π G_i)
  double cerruti_directed = 0;   ///< Σ ν_i/(2π G_i)

  /// G*/E*. Throws InvalidInput naming tangential_modulus where G* is not known: there is no
  /// default.
  double modulus_ratio() const;

  /// Throws InvalidInput unless young > 0 and −1 < poisson <= 0.5 of each body, at least one of
  /// them not rigid.
  static Material of_bodies(const ElasticBody& first, const ElasticBody& second = {});
  /// One elastic body with E* = E/(1−ν²) against a rigid one: G* = 2E*(1−ν)/(2−ν).
  static Material of_contact_modulus(double contact_modulus, double poisson);
  /// E* and G* as given. The Cerruti constants are those of one elastic body with that G*/E*, hence
  /// a ratio outside [2/3, 4/3] (ν from 0.5 to −1) leaves them NaN.
  static Material of_moduli(double contact_modulus, double tangential_modulus);
  /// Normal contact only: G* and the Cerruti constants are NaN, modulus_ratio() throws.
  static Material of_contact_modulus(double contact_modulus);
};

constexpr void describe(auto&& visit, std::type_identity<Material>) {
  visit(&Material::contact_modulus,
        Quantity{"contact_modulus", Dimension::pressure, "contact modulus E*"});
  visit(&Material::tangential_modulus,
        Quantity{"tangential_modulus", Dimension::pressure, "tangential modulus G*"});
  visit(&Material::cerruti_isotropic, Kept{"cerruti_isotropic", "sum of (1 - nu)/(2 pi G), 1/Pa"});
  visit(&Material::cerruti_directed, Kept{"cerruti_directed", "sum of nu/(2 pi G), 1/Pa"});
  visit(&Material::modulus_ratio, Quantity{"modulus_ratio", Dimension::dimensionless, "G*/E*"});
}

/// A nominal pressure above a tenth of E*, where strains of the whole surface are no longer small:
/// as a rule a unit was forgotten. In words for a warning.
std::optional<std::string> doubt_of_pressure(double nominal_pressure, double contact_modulus);

}  // namespace salebra
