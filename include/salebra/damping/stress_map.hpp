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

/// Stresses under an axisymmetric indenter in full stick during a cycle δ = δ0 + u_z cosθ, θ = ωt
/// from −π to π (Fig. 4 of the paper). The cycle starts at the smallest indentation without
/// tangential stress; this first cycle is already steady. Arguments `angle` are θ in rad, r is the
/// distance from the axis in m.
class OscillatingStress {
 public:
  /// Throws InvalidInput where the motion is invalid or leaves the profile.
  OscillatingStress(const IndenterLaw& law, double mean_indentation, const Oscillation& motion);

  double contact_radius(double angle) const;      ///< a(θ), m; 0 while the contact is open
  double min_contact_radius() const;              ///< m
  double displacement(double angle) const;        ///< x(θ) − x(−π), m
  double tangential_force(double angle) const;    ///< F_x = 2∫_0^a q_x dx, N; q_x as in shear()
  double pressure(double angle, double r) const;  ///< p(r), Pa
  /// Shear stress τ(r), Pa, by Eq. (17) of the paper from the line load q_x = G*(x − x0), with the
  /// displacement x of the body and its value x0 when the spring touched; 0 for r >= a. While δ
  /// falls, τ has a square-root singularity at the contact edge r = a: τ → (G*/π)(x(θ) −
  /// x(−θ))/√(a² − r²), x(θ) − x(−θ) = −2u_x sinθ sinφ0. At the smallest contact radius a_min of
  /// the cycle, τ has a logarithmic singularity with a coefficient that is constant in time:
  /// (G*x'(−π)/2π)√(2/(R u_z)) ln[1/(a_min − r)] for a paraboloid of radius R, x' = dx/dθ.
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
  std::vector<double> contact_radius;    ///< contact radius a at each θ, m
  std::vector<double> tangential_force;  ///< F_x at each θ, N
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
/// phases  number of steps in θ: the map has phases + 1 angles from −π to π, both included
/// radii   number of equal intervals of r from 0 to 1.05 times the largest contact radius; stresses
///         are given at the middle of each interval
/// throws  Interrupted where on_progress says stop
StressMap stress_map(const IndenterLaw& law, double mean_indentation, const Oscillation& motion,
                     int phases = 128, int radii = 256, const Progress& on_progress = {});

}  // namespace salebra
