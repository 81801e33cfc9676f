// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

namespace salebra {

/// Stresses under an axisymmetric indenter in full stick, in the first cycle from the smallest
/// indentation, where tangential stress is zero; this cycle is already steady: δ = δ0 + u_z cosθ,
/// θ = ωt from −π to π (Fig. 4 of the paper).
class OscillatingStress {
 public:
  /// Throws InvalidInput where the motion is invalid or leaves the profile.
  OscillatingStress(const IndenterLaw& law, double mean_indentation, const Oscillation& motion);

  double contact_radius(double angle) const;      ///< a(θ), m; 0 while the contact is open
  double min_contact_radius() const;              ///< m
  double displacement(double angle) const;        ///< x(θ) − x(−π), m
  double tangential_force(double angle) const;    ///< F_x = 2∫_0^a q_x dx, N
  double pressure(double angle, double r) const;  ///< p(r), Pa
  /// τ(r) by Eq. (17) from q_x = G*(x − x0), Pa; 0 for r >= a.
  /// While δ falls it has a square-root singularity at the edge: τ →
  /// (G*/π)(x(θ) − x(−θ))/√(a² − r²), x(θ) − x(−θ) = −2u_x sinθ sinφ0. At the smallest contact
  /// radius, once passed, it has a logarithmic one with a coefficient constant in time:
  /// (G*x'(−π)/2π)√(2/(R u_z)) ln[1/(a_min − r)] for a paraboloid, x' = dx/dθ.
  double shear(double angle, double r) const;

 private:
  double indentation(double angle) const;
  double position(double angle) const;  // x(θ), whatever its origin
  double speed(double angle) const;     // dx/dθ
  // |θ| at which the spring at image radius x touches and separates.
  double touch_angle(double radius) const;

  const IndenterLaw& law_;
  Oscillation motion_;
  double mean_indentation_, amplitude_, tangential_modulus_;
  double open_angle_;  // where the contact opens; π where it does not
};

/// Stresses on a grid of phases and radii.
struct StressMap {
  std::vector<double> angle;             ///< θ, rad
  std::vector<double> radial_position;   ///< r, m
  std::vector<double> contact_radius;    ///< a of each phase, m
  std::vector<double> tangential_force;  ///< F_x of each phase, N
  Field shear;                           ///< τ (phases, radii), Pa
  Field contact_pressure;                ///< p (phases, radii), Pa
};

constexpr void describe(auto&& visit, std::type_identity<StressMap>) {
  using enum Dimension;
  using S = StressMap;
  visit(&S::angle, Quantity{"angle", Dimension::angle, "phase of the normal motion, 0 at its top"});
  visit(&S::radial_position, Quantity{"radial_position", length, "distance from the axis"});
  visit(&S::contact_radius, Quantity{"contact_radius", length, "contact radius"});
  visit(&S::tangential_force, quantity::tangential_force);
  visit(&S::shear, Quantity{"shear", pressure, "tangential stress, Eq. (17)"});
  visit(&S::contact_pressure, Quantity{"contact_pressure", pressure, "contact pressure"});
}

/// Computes the map of Fig. 4, in parallel over phases.
///
///     StressMap map = stress_map(law, 1e-8, EqualFrequency{1e-9, 1e-10, std::numbers::pi / 2});
///
/// phases  gives phases + 1 angles from −π to π, both ends included
/// radii   number of cells from 0 to 1.05 times the largest contact radius; stresses are at their
///         middles
/// throws  Interrupted where on_progress says stop
StressMap stress_map(const IndenterLaw& law, double mean_indentation, const Oscillation& motion,
                     int phases = 128, int radii = 256, const Progress& on_progress = {});

}  // namespace salebra
