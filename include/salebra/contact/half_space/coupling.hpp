// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/contact_set.hpp>
#include <salebra/contact/half_space/material.hpp>

namespace salebra {

/// (1 − 2ν_1)/(4πG_1) − (1 − 2ν_2)/(4πG_2) = β/(πE*), 1/Pa: how the normal and the tangential
/// direction of two bodies are coupled. β, Dundurs' second constant, changes its sign with the
/// order of the bodies; 0 for equal bodies and for incompressible ones.
/// Throws InvalidInput as Material::of_bodies does.
double coupling_constant(const ElasticBody& first, const ElasticBody& second = {});
/// The constant of a material whose first body has all the compliance, (c1 − c2)/2 with Cerruti's
/// constants: exact for one elastic body against a rigid one, otherwise the largest that two bodies
/// with these constants can have. Throws InvalidInput where the material does not know them.
double coupling_constant(const Material& material);
/// β = πE* · coupling constant, −0.5 … 0.5.
double dundurs_constant(double contact_modulus, double coupling);

/// What the normal and the tangential directions of two half-spaces have to do with each other:
///     u_z(x) = (β/πE*) ∬ τ(ξ)·(x − ξ)/r²,   u_t(x) = −(β/πE*) ∬ p(ξ) (x − ξ)/r²,   r = |x − ξ|;
///     û_z = −(2iβ/E*q²) q·τ̂,   û_t = (2iβ/E*q²) q p̂,   mean zero      (periodic)
/// [Johnson (1985), Eqs (3.18), (3.75), for β/πE* = Σ ±(1 − 2ν_i)/(4πG_i)]. u_z counts into the
/// first body, on which p and τ act: a pressure draws the surface towards itself, and a surface
/// that is drawn sideways sinks in front of the load. Reciprocity: ∫p u_z[τ] = ∫τ·u_t[p]. β = 0.286
/// for ν = 0.3 against a rigid body. Free: uniform over each cell, zero-padded. One object may be
/// used by one thread at a time.
class NormalTangentialCoupling {
 public:
  /// coupling: β/(πE*), 1/Pa, finite. Throws InvalidInput for a bad grid or constant.
  NormalTangentialCoupling(const Grid2D& grid, double coupling, Boundary boundary);
  NormalTangentialCoupling(NormalTangentialCoupling&&) noexcept;
  NormalTangentialCoupling& operator=(NormalTangentialCoupling&&) noexcept;
  ~NormalTangentialCoupling();

  /// u_z (nx, ny), m, of tractions. Cost: two real transforms forward and two backward.
  Field normal_displacement(const TangentialField& traction);
  /// u_t, m, of pressures. Cost: the same, with rows of zeros left out.
  TangentialField tangential_displacement(const Field& pressure);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// ∬ ξ/r² over a rectangle dx × dy centred at the origin, seen from (x, y), ξ = x minus its points;
/// m. The same along y by exchange. From the primitive ½ η ln r² + ξ atan(η/ξ) at the four corners.
double cell_gradient_integral(double x, double y, double dx, double dy);

}  // namespace salebra
