// SPDX-License-Identifier: GPL-3.0-or-later
// Contact modulus E* and tangential modulus G* of two elastic bodies.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/half_space/material.hpp>

#include "base/special_values.hpp"
#include "poisson.hpp"

namespace salebra {
namespace {

using detail::unknown;

}  // namespace

double Material::modulus_ratio() const {
  if (!(tangential_modulus > 0))
    throw InvalidInput("tangential_modulus",
                       "not given, but tangential stiffness and damping need it; give Poisson's "
                       "ratio or the tangential modulus");
  return tangential_modulus / contact_modulus;
}

Material Material::of_bodies(const ElasticBody& first, const ElasticBody& second) {
  double normal_compliance = 0, tangential_compliance = 0;
  Material material;
  for (const ElasticBody& body : {first, second}) {
    require(body.young > 0, "young", body.young, "must be > 0 (infinity: rigid)");
    detail::require_poisson(body.poisson);
    normal_compliance += (1 - body.poisson * body.poisson) / body.young;
    tangential_compliance += (2 - body.poisson) / (4 * body.shear());
    material.cerruti_isotropic += (1 - body.poisson) / (2 * std::numbers::pi * body.shear());
    material.cerruti_directed += body.poisson / (2 * std::numbers::pi * body.shear());
  }
  require(normal_compliance > 0, "young", first.young, "must be finite for at least one body");
  material.contact_modulus = 1 / normal_compliance;
  material.tangential_modulus = 1 / tangential_compliance;
  return material;
}

Material Material::of_contact_modulus(double contact_modulus, double poisson) {
  require_positive(contact_modulus, "contact_modulus");
  detail::require_poisson(poisson);
  return of_bodies({.young = contact_modulus * (1 - poisson * poisson), .poisson = poisson});
}

Material Material::of_moduli(double contact_modulus, double tangential_modulus) {
  require_positive(contact_modulus, "contact_modulus");
  require_positive(tangential_modulus, "tangential_modulus");
  // Poisson's ratio ν from G*/E* = 2(1−ν)/(2−ν), for two bodies with equal ν.
  const double ratio = tangential_modulus / contact_modulus;
  const double poisson = 2 * (1 - ratio) / (2 - ratio);
  Material material;
  if (ratio < 2 && poisson > -1 && poisson <= 0.5)
    material = of_contact_modulus(contact_modulus, poisson);
  else
    material.cerruti_isotropic = material.cerruti_directed = unknown;
  material.contact_modulus = contact_modulus;
  material.tangential_modulus = tangential_modulus;
  return material;
}

Material Material::of_contact_modulus(double contact_modulus) {
  require_positive(contact_modulus, "contact_modulus");
  return {.contact_modulus = contact_modulus,
          .tangential_modulus = unknown,
          .cerruti_isotropic = unknown,
          .cerruti_directed = unknown};
}

std::optional<std::string> warning_of_pressure(double nominal_pressure, double contact_modulus) {
  constexpr double max_strain = 0.1;
  const double ratio = nominal_pressure / contact_modulus;
  if (!(ratio > max_strain)) return {};
  return fmt::format(
      "a nominal pressure of {} is {} times E* = {}, but linear elasticity holds only far below "
      "E*; check the units: a bare number is in Pa",
      format_quantity(nominal_pressure, Dimension::pressure),
      ratio < 100 ? fmt::format("{:.2g}", ratio) : fmt::format("{:.0f}", ratio),
      format_quantity(contact_modulus, Dimension::pressure));
}

}  // namespace salebra
