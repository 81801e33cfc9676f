// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/contact/mdr/mdr.hpp>

/// Adhesive contacts of axisymmetric indenters in closed form. Forces and indentations are positive
/// in compression, lengths in m. Each throws InvalidInput for numbers that are not > 0.
namespace salebra {

/// One equilibrium of an adhesive indenter.
struct AdhesivePoint {
  double contact_radius = 0;  ///< a, m
  double force = 0;           ///< N
  double indentation = 0;     ///< m
  double zone_radius = 0;     ///< where adhesion ends, c >= a, m
};

constexpr void describe(auto&& visit, std::type_identity<AdhesivePoint>) {
  using S = AdhesivePoint;
  visit(&S::force, Quantity{"force", Dimension::force, "normal force"});
  visit(&S::indentation, Quantity{"indentation", Dimension::length, "indentation"});
  visit(&S::contact_radius, Quantity{"contact_radius", Dimension::length, "contact radius"});
  visit(&S::zone_radius, Quantity{"zone_radius", Dimension::length, "radius where adhesion ends"});
}

/// JKR, adhesion of no range, of any profile, by its image g(x) [Popov and Heß (2015)]:
///     δ = g(a) − √(2πwa/E*),   F = 2E* [aδ − ∫_0^a g dx];
/// of a paraboloid, F = 4E*a³/(3R) − √(8πwE*a³) [Johnson et al. (1971)].
/// work   w, J/m²
AdhesivePoint jkr_contact(const IndenterProfile& profile, double contact_modulus, double work,
                          double contact_radius);
/// The state of the least force, where a pulled indenter comes off: a g'(a) = (3/2)√(2πwa/E*).
/// F = −(3/2)πwR of a paraboloid. Throws NotConverged where no contact radius within the profile has
/// it.
AdhesivePoint jkr_pull_off(const IndenterProfile& profile, double contact_modulus, double work);

/// DMT, adhesion outside a contact that it does not deform: F = 4E*a³/(3R) − 2πwR, δ = a²/R
/// [Derjaguin et al. (1975)]. The pull-off is that of a = 0.
AdhesivePoint dmt_contact(double radius, double contact_modulus, double work,
                          double contact_radius);

/// A paraboloid under a tension w/ρ as far as the gap is below ρ [Maugis (1992)]. With K = 4E*/3,
/// λ = 2 (w/ρ) (R/(πwK²))^(1/3), A = a/(πwR²/K)^(1/3), m = c/a and s = √(m² − 1):
///     1 = (λA²/2)[s + (m² − 2) arcsec m] + (4λ²A/3)[s arcsec m − m + 1],
///     F = πwR (A³ − λA²[s + m² arcsec m]),   δ = (π²w²R/K²)^(1/3) (A² − (4/3)λAs).
class MaugisDugdale {
 public:
  MaugisDugdale(double radius, double contact_modulus, double work, double range);
  /// a >= 0; 0: adhesion alone. Cost: some twenty evaluations.
  AdhesivePoint contact(double contact_radius) const;
  /// The state of the least force, by golden section over a.
  AdhesivePoint pull_off() const;
  double transition_parameter() const { return lambda_; }  ///< λ, 1.16 times Tabor's parameter

 private:
  double radius_, work_, lambda_;
  double length_, depth_;  // of A and of δ
};

/// The equilibrium at which force or indentation, `quantity`, has a value, on the branch from the
/// pull-off on along which both grow. contact: the state of a contact radius, m. Throws InvalidInput
/// for less than the pull-off has; as contact does.
AdhesivePoint adhesive_equilibrium(const std::function<AdhesivePoint(double)>& contact,
                                   const AdhesivePoint& pull_off, double AdhesivePoint::*quantity,
                                   double value);

/// μ = (R w²/(E*² ρ³))^(1/3) of Tabor (1977), with the range ρ for the distance of equilibrium.
double tabor_parameter(double radius, double contact_modulus, double work, double range);

enum class AdhesionModel { dmt, maugis_dugdale, jkr };

template <>
struct EnumNames<AdhesionModel> {
  static constexpr auto values = std::to_array<std::pair<AdhesionModel, std::string_view>>(
      {{AdhesionModel::dmt, "dmt"},
       {AdhesionModel::maugis_dugdale, "maugis_dugdale"},
       {AdhesionModel::jkr, "jkr"}});
};

/// DMT below μ = 0.1, JKR above 5, Maugis and Dugdale's between, as Johnson and Greenwood (1997)
/// draw the map.
AdhesionModel suggested_model(double tabor_parameter);

}  // namespace salebra
