// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/contact/mdr/mdr.hpp>

/// Adhesive contacts of axisymmetric indenters in closed form:
///     const AdhesivePoint off = jkr_pull_off(*paraboloid_profile(1e-3), 1e9, 0.05);
/// Forces and indentations are positive in compression, lengths in m. Each function throws
/// InvalidInput for numbers that are not > 0.
namespace salebra {

/// One equilibrium of an adhesive indenter.
struct AdhesivePoint {
  double contact_radius = 0;  ///< a, m
  double force = 0;           ///< N
  double indentation = 0;     ///< m
  double zone_radius = 0;     ///< outer radius of the adhesive zone, c >= a, m
};

constexpr void describe(auto&& visit, std::type_identity<AdhesivePoint>) {
  using S = AdhesivePoint;
  visit(&S::force, Quantity{"force", Dimension::force, "normal force"});
  visit(&S::indentation, Quantity{"indentation", Dimension::length, "indentation"});
  visit(&S::contact_radius, Quantity{"contact_radius", Dimension::length, "contact radius"});
  visit(&S::zone_radius, Quantity{"zone_radius", Dimension::length, "radius where adhesion ends"});
}

/// Computes a JKR state (adhesion of zero range) with the contact radius a for any profile with the
/// image g(x), Eq. (3) in mdr.hpp [Popov and Heß (2015)]:
///     δ = g(a) − √(2πwa/E*),   F = 2E* [aδ − ∫_0^a g dx].
/// For a paraboloid, F = 4E*a³/(3R) − √(8πwE*a³) [Johnson et al. (1971)]. work: w, J/m².
AdhesivePoint jkr_contact(const IndenterProfile& profile, double contact_modulus, double work,
                          double contact_radius);
/// Computes the JKR state of minimum force, where a pulled indenter separates. Its contact radius a
/// satisfies a g'(a) = (3/2)√(2πwa/E*) with the image g of the profile. For a paraboloid F =
/// −(3/2)πwR. Throws NotConverged if no contact radius within the profile satisfies this condition.
AdhesivePoint jkr_pull_off(const IndenterProfile& profile, double contact_modulus, double work);

/// Computes a DMT state, with adhesion outside a contact that it does not deform: F = 4E*a³/(3R) −
/// 2πwR, δ = a²/R [Derjaguin et al. (1975)]. The pull-off is at a = 0.
AdhesivePoint dmt_contact(double radius, double contact_modulus, double work,
                          double contact_radius);

/// Adhesive paraboloid of radius R with a constant tension w/ρ where the gap is below the range ρ;
/// w is the work of adhesion [Maugis (1992)]. a is the contact radius, c the outer radius of the
/// adhesive zone. With K = 4E*/3, λ = 2 (w/ρ) (R/(πwK²))^(1/3), A = a/(πwR²/K)^(1/3), m = c/a and s
/// = √(m² − 1):
///     1 = (λA²/2)[s + (m² − 2) arcsec m] + (4λ²A/3)[s arcsec m − m + 1],
///     F = πwR (A³ − λA²[s + m² arcsec m]),   δ = (π²w²R/K²)^(1/3) (A² − (4/3)λAs).
class MaugisDugdale {
 public:
  MaugisDugdale(double radius, double contact_modulus, double work, double range);
  /// Computes the state with the contact radius a >= 0; a = 0 means adhesion without contact. Cost:
  /// about twenty evaluations.
  AdhesivePoint contact(double contact_radius) const;
  /// Computes the state of minimum force, by golden section over a.
  AdhesivePoint pull_off() const;
  double transition_parameter() const { return lambda_; }  ///< λ = 1.16 times Tabor's parameter

 private:
  double radius_, work_, lambda_;
  double length_, depth_;  // of A and of δ
};

/// Finds the equilibrium with a given force or indentation, `quantity`, on the branch that starts
/// at the pull-off and along which force and indentation grow. contact: returns the state for a
/// contact radius, m. Throws InvalidInput for a value below that of the pull-off, and passes on
/// what contact throws.
AdhesivePoint adhesive_equilibrium(const std::function<AdhesivePoint(double)>& contact,
                                   const AdhesivePoint& pull_off, double AdhesivePoint::*quantity,
                                   double value);

/// Returns Tabor's parameter μ = (R w²/(E*² ρ³))^(1/3) [Tabor (1977)], where the range ρ takes the
/// place of the equilibrium distance.
double tabor_parameter(double radius, double contact_modulus, double work, double range);

enum class AdhesionModel { dmt, maugis_dugdale, jkr };

template <>
struct EnumNames<AdhesionModel> {
  static constexpr auto values = std::to_array<std::pair<AdhesionModel, std::string_view>>(
      {{AdhesionModel::dmt, "dmt"},
       {AdhesionModel::maugis_dugdale, "maugis_dugdale"},
       {AdhesionModel::jkr, "jkr"}});
};

/// Returns the adhesion model for a Tabor parameter: DMT below 0.1, JKR above 5, and Maugis–Dugdale
/// in between, after the map of Johnson and Greenwood (1997).
AdhesionModel suggested_model(double tabor_parameter);

}  // namespace salebra
