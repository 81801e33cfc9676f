// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/contact_set.hpp>
#include <salebra/contact/half_space/material.hpp>

namespace salebra {

/// Returns the constant of normal–tangential coupling of two bodies with Poisson's ratios ν_1, ν_2
/// and shear moduli G_1, G_2,
///     (1 − 2ν_1)/(4πG_1) − (1 − 2ν_2)/(4πG_2) = β/(πE*), 1/Pa.
/// Dundurs' second constant β changes sign with the order of the bodies; it is 0 for equal bodies
/// and for incompressible bodies. Throws InvalidInput wherever Material::of_bodies does.
double coupling_constant(const ElasticBody& first, const ElasticBody& second = {});
/// Returns the coupling constant β/(πE*) of a material, 1/Pa, assuming that the first body has all
/// the compliance: (cerruti_isotropic − cerruti_directed)/2. It is exact for one elastic body
/// against a rigid one, otherwise the largest value for any two bodies with these Cerruti
/// constants. Throws InvalidInput if the Cerruti constants are unknown.
double coupling_constant(const Material& material);
/// Returns Dundurs' β = πE* · coupling constant, between −0.5 and 0.5.
double dundurs_constant(double contact_modulus, double coupling);

/// Normal–tangential coupling of two half-spaces:
///     NormalTangentialCoupling coupling(grid, coupling_constant(material), Boundary::periodic);
///     const Field u_z = coupling.normal_displacement(traction);
/// For tractions τ and pressures p, with r = |x − ξ|, it computes the normal displacement u_z and
/// the tangential displacement u_t,
///     u_z(x) = (β/πE*) ∬ τ(ξ)·(x − ξ)/r²,   u_t(x) = −(β/πE*) ∬ p(ξ) (x − ξ)/r²   (free)
///     û_z = −(2iβ/E*q²) q·τ̂,   û_t = (2iβ/E*q²) q p̂,   mean zero                   (periodic)
/// [Johnson (1985), Eqs (3.18), (3.75), for β/πE* = Σ ±(1 − 2ν_i)/(4πG_i)]. u_z is positive into
/// the first body, on which p and τ act: a pressure pulls the surface towards itself, and a sheared
/// surface sinks in front of the load. Work is reciprocal: ∫p u_z[τ] = ∫τ·u_t[p]. Example: β =
/// 0.286 for ν = 0.3 against a rigid body. For Boundary::free, loads are uniform in each cell and
/// the convolution is zero-padded. Only one thread may use an object at a time.
class NormalTangentialCoupling {
 public:
  /// coupling: β/(πE*), 1/Pa, finite. Throws InvalidInput for a bad grid or constant.
  NormalTangentialCoupling(const Grid2D& grid, double coupling, Boundary boundary);
  NormalTangentialCoupling(NormalTangentialCoupling&&) noexcept;
  NormalTangentialCoupling& operator=(NormalTangentialCoupling&&) noexcept;
  ~NormalTangentialCoupling();

  /// Returns u_z (nx, ny), m, for tractions. Cost: two real FFTs forward and two backward.
  Field normal_displacement(const TangentialField& traction);
  /// Returns u_t, m, for pressures. Cost: that of normal_displacement(), but rows of zeros are
  /// skipped.
  TangentialField tangential_displacement(const Field& pressure);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Returns ∬ ξ/r² dξ dη over a rectangle dx × dy centred at the origin, m, where (ξ, η) is the
/// vector from a point of the rectangle to (x, y) and r its length. For ∬ η/r², exchange the two
/// axes. It uses the primitive ½ η ln r² + ξ atan(η/ξ) at the four corners.
double cell_gradient_integral(double x, double y, double dx, double dy);

}  // namespace salebra
