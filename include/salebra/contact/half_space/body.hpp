// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <salebra/base/enum_names.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace salebra {

/// What displacements of a periodic contact are measured from.
/// mean_plane: the mean plane of the deformed surface, as for a half-space. A uniform load then
/// displaces nothing. base: the rigid base of a layer. A uniform load then compresses and shears
/// the whole layer, and the stiffness between contact and base is finite even in full contact.
/// Under a given load both give the same pressures; indentation, energy and stiffness differ.
enum class Datum { mean_plane, base };

template <>
struct EnumNames<Datum> {
  static constexpr auto values = std::to_array<std::pair<Datum, std::string_view>>(
      {{Datum::mean_plane, "mean_plane"}, {Datum::base, "base"}});
};

/// Response of a surface to loads that vary as a wave exp(iq·x) with the wave number q, m/Pa:
///     û_z = C_n p̂ − i c q·τ̂/q,   û_t = i c q p̂/q + C_l (q·τ̂) q/q² + C_a [τ̂ − (q·τ̂) q/q²]
///           + C_m [(q·τ̂) e_a + (e_a·τ̂) q]/q,   e_a = (−q_y, q_x)/q
/// u_z is positive into the body, on which the pressure p and the traction τ act; the signs of the
/// coupling are those of NormalTangentialCoupling.
struct SurfaceCompliance {
  double normal = 0;    ///< C_n
  double in_plane = 0;  ///< C_l, traction and displacement along q; NaN: unknown
  double across = 0;    ///< C_a, traction and displacement perpendicular to q; NaN: unknown
  double coupling = 0;  ///< c, normal to in plane; NaN: unknown
  double mixed = 0;     ///< C_m, in plane by a traction across and the reverse; not 0: anisotropic
};

/// One layer, bonded to what lies below it.
struct ElasticLayer {
  double thickness = 0;  ///< > 0, m
  double young = 0;      ///< E > 0, finite, Pa
  double poisson = 0;    ///< ν, −1 < ν <= 0.5
};

/// A half-space whose Young's modulus grows with the depth z as E = modulus·(z/depth)^exponent, with
/// constant Poisson's ratio.
struct GradedHalfSpace {
  double modulus = 0;   ///< E at `depth`, > 0, Pa
  double depth = 0;     ///< > 0, m
  double exponent = 0;  ///< k, 0 <= k < 1
  double poisson = 0;   ///< ν, −1 < ν <= 0.5
};

/// Stiffnesses of a transversely isotropic half-space whose axis is the normal z of the surface, Pa.
/// They must be positive definite: c44, c66 > 0, c11 > c66 and c33(c11 − c66) > c13².
struct TransverseStiffness {
  double c11 = 0, c33 = 0, c13 = 0, c44 = 0, c66 = 0;
};

/// Stiffnesses c_IJ of an anisotropic material, Pa: σ_I = Σ_J c_IJ ε_J with I = xx, yy, zz, yz, xz, xy
/// (Voigt) and shear strains γ = 2ε. They must be symmetric and positive definite.
struct AnisotropicStiffness {
  std::array<std::array<double, 6>, 6> c = {};

  /// A cubic crystal in the axes of its cube.
  static AnisotropicStiffness cubic(double c11, double c12, double c44);
  /// The stiffnesses in the axes of a surface with the outward normal z and the direction x, both
  /// given in the axes of these stiffnesses, of any length > 0: y = z × x. A silicon wafer, for
  /// example, with x along the flat of a (001) wafer:
  ///     AnisotropicStiffness::cubic(166e9, 64e9, 80e9).of_surface({0, 0, 1}, {1, 1, 0});
  /// Throws InvalidInput unless the directions are perpendicular.
  AnisotropicStiffness of_surface(const std::array<double, 3>& normal,
                                  const std::array<double, 3>& x) const;
};

/// A response that the user gives at wave numbers q.
struct ComplianceTable {
  std::vector<double> wavenumber = {};  ///< q > 0, increasing, at least 4, 1/m
  std::vector<double> normal = {};      ///< C_n > 0 at each q, m/Pa
  /// C_l and C_a > 0 at each q, m/Pa; both empty: unknown, which suffices for normal contact.
  std::vector<double> in_plane = {}, across = {};
  /// Displacement from the base per uniform pressure or traction, >= 0, m/Pa; infinite: no base.
  double uniform_normal = std::numeric_limits<double>::infinity();
  double uniform_tangential = std::numeric_limits<double>::infinity();
};

/// A linear elastic body, known by the response of its surface to waves of load. A rubber film of 5
/// µm on steel, for example:
///     const Body coated = Body::layered({{5e-6, 3e6, 0.49}}, {.young = 210e9, .poisson = 0.3});
///     const NormalContactState state = press(surface, coated, at_pressure(1e5));
/// All bodies but anisotropic() respond alike in all directions of the surface. Copies share their
/// data. Waves longer than the period of a surface do not exist: a layer much thicker than the
/// period responds like a half-space.
class Body {
 public:
  /// Homogeneous isotropic half-spaces: C_n = 2/(E*q), C_l = Σ(1−ν_i)/(G_i q), C_a = Σ1/(G_i q),
  /// c = (1−2ν_1)/(2G_1q) − (1−2ν_2)/(2G_2q). Throws InvalidInput wherever Material::of_bodies
  /// does.
  static Body half_space(const ElasticBody& first, const ElasticBody& second = {});
  /// The same from the constants of both bodies together, so that what takes a Body takes a Material
  /// too: C_n = 2/(E*q), C_l = 2πΣ(1−ν_i)/(2πG_i)/q, C_a = 2πΣ1/(2πG_i)/q; the coupling is not known
  /// (NaN), nor are C_l and C_a of a material with E* alone.
  Body(const Material& material);  // NOLINT(google-explicit-constructor): a material is a body

  /// Bonded layers, from the surface down, on a half-space or, by default, on a rigid base.
  /// A layer of thickness t and shear modulus µ maps the compliance M (in 1/(µq)) at its lower face
  /// to that at its upper face, with the blocks of T = exp(−Ax), x = qt, of the equations of plane
  /// strain:
  ///     (T_uu M − T_uf)(T_ff − T_fu M)⁻¹  for the pair (C_l, C_n),
  ///     (M + tanh x)/(1 + M tanh x)       for C_a.
  /// All terms are multiplied by e^−x, so they do not overflow, and the differences that cancel for
  /// thin or incompressible layers are series. One layer gives the closed forms of Bentall and
  /// Johnson (1968) on a rigid base and of O'Sullivan and King (1988) on a half-space. Relative
  /// error about 1e-13 for moduli within a factor of 1e6. Uniform loads: Σt(1−2ν)/(2µ(1−ν)) and
  /// Σt/µ on a rigid base, infinite on a half-space. Cost: about 0.1 µs per layer and wave number.
  /// Throws InvalidInput for an empty list or bad constants.
  static Body layered(const std::vector<ElasticLayer>& layers, const ElasticBody& base = {});

  /// C_n = cos(kπ/2) 2^(1−k) Γ((1−k)/2)/Γ((1+k)/2) d^k q^(k−1)/c_N, C_l = C_n (1+k)/(1−kν/(1−ν)),
  /// C_a = 2^−k Γ((1−k)/2)/Γ((1+k)/2) d^k q^(k−1)/µ_0 for the modulus E_0 and shear modulus µ_0 at
  /// the depth d [Booker et al. (1985), Giannakopoulos and Suresh (1997)]. k = 0 is a
  /// homogeneous half-space. The coupling is not known (NaN). Near the surface the body is soft
  /// without limit, so that the cells should be well below d. Throws InvalidInput for bad constants.
  static Body graded(const GradedHalfSpace& half_space);
  /// The constant c_N of graded(), Pa,
  ///     c_N = E_0/(1−ν²) · 2(1+k) cos(kπ/2) Γ(1+k/2)/[√π C β sin(βπ/2) Γ((1+k)/2)],
  ///     β² = (1+k)(1 − kν/(1−ν)),  C = 2^(1+k) Γ((3+k+β)/2) Γ((3+k−β)/2)/(π Γ(2+k)).
  /// A sphere of radius R, pressed in over the contact radius a, needs the force
  /// F = 4c_N a^(3+k)/(d^k R(1+k)²(3+k)) at the indentation a²/((1+k)R).
  static double graded_modulus(const GradedHalfSpace& half_space);

  /// C_n = 2/(Mq), C_l = C_n √(c33/c11), C_a = 1/(q√(c44c66)), c = 1/(q(c13 + √(c11c33))) with
  /// M = 2√{(c11c33 − c13²)/c11 / [1/c44 + 2/(√(c11c33) + c13)]} [Delafargue and Ulm (2004)]. Throws
  /// InvalidInput unless the stiffnesses are positive definite.
  static Body transversely_isotropic(const TransverseStiffness& stiffness);

  /// A half-space of any anisotropic material, whose stiffnesses are in the axes x, y of the surface
  /// and z normal to it. Waves along m, with the normal n, have the compliance L⁻¹/q,
  ///     L = (1/π)∫₀^π [Q − R T⁻¹ Rᵀ] dθ,  Q = (mm), R = (mn), T = (nn),  (ab)_ik = a_j c_ijkl b_l,
  /// where m and n turn by θ in their plane [Barnett and Lothe (1973)]: C_n, C_l, C_a and
  /// C_m are its elements along n, m and n × m. The coupling of normal and tangential directions is
  /// not known (NaN). L⁻¹ is a Fourier series of the direction, relative error about 1e-13; cost about
  /// 1 ms for the series and 0.1 µs for each wave vector. Throws InvalidInput unless the stiffnesses
  /// are symmetric and positive definite.
  static Body anisotropic(const AnisotropicStiffness& stiffness);

  /// A response given at wave numbers. Between them, ln C is a cubic of ln q (slopes of
  /// detail::MonotoneHermite), so that powers of q are exact. The coupling is not known (NaN).
  /// Wave numbers beyond the table are refused when they are asked for. Throws InvalidInput for a
  /// bad table.
  static Body tabulated(const ComplianceTable& table);

  /// Two bodies in contact: compliances add, couplings subtract. Both must have the same datum.
  static Body pair(const Body& first, const Body& second);

  /// The same body with another datum. Throws InvalidInput for Datum::base if the body has no rigid
  /// base, so that a uniform load displaces it without limit.
  Body measured_from(Datum datum) const;
  Datum datum() const;  ///< mean_plane unless measured_from() changed it

  /// Response at the wave number q >= 0, 1/m, as the mean over all directions of the wave vector. At
  /// q = 0: zero from the mean plane, the uniform response from the base. Throws InvalidInput for a
  /// wave number beyond a table.
  SurfaceCompliance compliance(double wavenumber) const;
  /// Response at the wave vector (q_x, q_y), 1/m.
  SurfaceCompliance compliance(double qx, double qy) const;
  bool is_directional() const;           ///< whether the response depends on the wave's direction
  bool has_tangential_response() const;  ///< false if C_l and C_a are unknown
  /// The constants of homogeneous isotropic half-spaces; none for other bodies.
  const std::optional<Material>& half_space_material() const;
  /// G*/E* of half_space_material(); NaN for other bodies, of which no constant gives K_t/K. Throws
  /// InvalidInput for half-spaces with E* alone.
  double modulus_ratio() const;
  /// Whether a contact in which all cells touch can be indented no further: true unless displacements
  /// are measured from the base of a compressible layer.
  bool stops_at_full_contact() const { return !(compliance(0).normal > 0); }
  /// Checksum of the datum and of the responses to waves from 1 nm to 10 m in eight directions (as far
  /// as they are known), to nine digits, by which curves, checkpoints and parts of studies recognise their body;
  /// empty for homogeneous half-spaces, whose constants they keep.
  std::string fingerprint() const;
  /// True if the copies share their data, and thus all responses are equal.
  bool same_as(const Body& other) const { return parts_ == other.parts_; }

 private:
  struct Parts;
  explicit Body(Parts parts);
  std::shared_ptr<const Parts> parts_;
};

}  // namespace salebra
