// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/law.hpp>
#include <span>
#include <vector>

/// Method of dimensionality reduction [Popov and Heß (2015)]: an axisymmetric contact as a
/// one-dimensional elastic foundation.
///     const IndenterLaw law(sphere_profile(1e-3), Material::of_contact_modulus(1e11, 0.3));
///     const double stiffness = law.normal_stiffness(law.indentation_of(1.0));
namespace salebra {

/// A number with an estimate of its error.
struct Estimate {
  double value = 0;
  double error = 0;
};

/// Computes the one-dimensional image g of an axisymmetric profile f(r), Eq. (3) of the paper, g(x)
/// = |x| ∫_0^{|x|} f'(r)/√(x² − r²) dr = |x| ∫_0^{π/2} f'(|x| sin φ) dφ, by adaptive quadrature in
/// φ, which removes the singularity at r = |x|. slope: f'(r), r >= 0; breaks: radii at which f' is
/// not smooth, increasing. Cost: 20 to 1000 evaluations of f'.
Estimate mdr_transform(const std::function<double(double)>& slope, double x,
                       std::span<const double> breaks = {});

/// Computes the profile from its image, f(r) = (2/π) ∫_0^r g(x)/√(r² − x²) dx. breaks: values of x
/// at which g is not smooth, increasing.
Estimate mdr_inverse(const std::function<double(double)>& image, double r,
                     std::span<const double> breaks = {});

/// Computes the stress of a line load q(x) = q(−x) of the foundation, Eq. (17):
///     σ(r) = −(1/π) ∫_r^∞ q'(x)/√(x² − r²) dx
///          = (1/π) [q(a)/√(a² − r²) − ∫_r^a q'(x)/√(x² − r²) dx],
/// where q jumps to 0 at the edge a. The normal line load q_z = E*(δ − g) gives the pressure p(r),
/// the tangential line load q_x gives the shear stress τ(r). The result is 0 for r >= a. slope:
/// q'(x) for 0 < x < a, whose singularities at `breaks` must be integrable; edge_value: q(a); edge:
/// a.
Estimate line_load_stress(const std::function<double(double)>& slope, double edge_value,
                          double edge, double r, std::span<const double> breaks = {});

/// An axisymmetric indenter z = f(r), f(0) = 0, and its one-dimensional image g(x), Eq. (3) of the
/// paper. Immutable. Lengths in m. Arguments x and r must lie between 0 and max_radius(); otherwise
/// functions throw InvalidInput.
class IndenterProfile {
 public:
  virtual ~IndenterProfile() = default;
  virtual double height(double r) const = 0;  ///< f(r)
  virtual double image(double x) const = 0;   ///< g(x)
  /// g'(x); at the contact edge it is c of the paper.
  virtual double image_slope(double x) const = 0;
  virtual double image_integral(double x) const = 0;  ///< ∫_0^x g dx
  /// Radius of the flat end, inside which g = 0: the minimum contact radius.
  virtual double flat_radius() const { return 0; }
  /// Radius at which the profile ends: beyond it f = ∞ (a punch) or is unknown (a table, the
  /// equator of a sphere).
  virtual double max_radius() const { return std::numeric_limits<double>::infinity(); }
  /// True if the contact cannot grow beyond max_radius() (the side of a punch); false if a larger
  /// contact would leave the known profile.
  virtual bool has_side() const { return false; }
  /// Radii at which the slope f' of the profile is not smooth.
  virtual std::vector<double> breaks() const { return {}; }
  /// Contact radius a with g(a) = indentation > 0. Throws InvalidInput if the contact radius would
  /// exceed max_radius() of a profile without a side.
  virtual double contact_radius(double indentation) const;
};

/// Cone f = r tanθ, g = (π/2) tanθ |x|, Eqs (4), (5) of the paper. angle: θ between the surface of
/// the cone and the plane, 0 < θ < π/2, rad.
std::unique_ptr<IndenterProfile> cone_profile(double angle);
/// Paraboloid f = r²/2R, g = x²/R.
std::unique_ptr<IndenterProfile> paraboloid_profile(double radius);
/// Power profile f = B rⁿ, n > 0, g = κ_n B |x|ⁿ, κ_n = (√π n/2) Γ(n/2)/Γ((n+1)/2).
std::unique_ptr<IndenterProfile> power_profile(double coefficient, double exponent);
/// Sphere f = R − √(R² − r²), g = x artanh(x/R) (Sneddon 1965), up to the equator r = R.
std::unique_ptr<IndenterProfile> sphere_profile(double radius);
/// A cylinder with a flat end of the given radius.
std::unique_ptr<IndenterProfile> flat_punch_profile(double radius);
/// A flat punch with a rounded edge: f = 0 for r < b, f = (r − b)²/2R for r >= b, with b =
/// flat_radius and R = edge_radius.
std::unique_ptr<IndenterProfile> rounded_punch_profile(double flat_radius, double edge_radius);

/// A profile measured or computed at radii r_i: a monotone cubic interpolates the profile f, and
/// exact quadrature of each cubic piece gives the image g.
class TabulatedProfile final : public IndenterProfile {
 public:
  /// radii: from 0, strictly increasing, m; heights: increasing, m (the first height is subtracted
  /// from all); at least seven points. Otherwise throws InvalidInput, whose message names the row.
  /// It also throws if the points are so few that omitting every other point changes the image g by
  /// more than 20 % somewhere in the outer three quarters of the radius.
  TabulatedProfile(std::vector<double> radii, std::vector<double> heights);
  ~TabulatedProfile() override;
  double height(double r) const override;
  double image(double x) const override;
  double image_slope(double x) const override;
  double image_integral(double x) const override;
  double flat_radius() const override;
  double max_radius() const override;
  std::vector<double> breaks() const override;
  double contact_radius(double indentation) const override;
  /// Returns the relative change of g(x) when every other point is omitted: an upper estimate of
  /// the interpolation error.
  double image_error(double x) const;

 private:
  struct Table;
  std::unique_ptr<const Table> table_;
};

/// Exact law of the contact of a rigid axisymmetric profile, with image g and contact radius a,
/// with an elastic half-space (docs/theory.md, section 6):
///     δ = g(a), F = 2E* ∫_0^a (δ − g) dx, K = 2E*a, F'' = 2E*/g'(a), K_t = (G*/E*)K.
/// It generalises PowerLaw, which covers cone, paraboloid and power profiles.
class IndenterLaw final : public ContactLaw {
 public:
  /// Throws InvalidInput if G* of the material is unknown.
  IndenterLaw(std::shared_ptr<const IndenterProfile> profile, const Material& material);
  double force(double indentation) const override;
  double normal_stiffness(double indentation) const override;
  double force_curvature(double indentation) const override;
  double indentation_of(double force) const override;
  double first_touch() const override { return 0; }
  double highest_indentation() const override;
  std::vector<double> break_points() const override;
  double contact_radius(double indentation) const;
  /// Pressure p(r) under the indenter, Pa; infinite at the edge of a flat punch.
  double pressure(double indentation, double r) const;
  /// Normal displacement of the surface of the half-space, m: δ − f(r) inside the contact, (2/π)
  /// ∫_0^a (δ − g(x))/√(r² − x²) dx outside the contact.
  double surface_displacement(double indentation, double r) const;
  const IndenterProfile& profile() const { return *profile_; }
  double contact_modulus() const { return contact_modulus_; }

 private:
  std::shared_ptr<const IndenterProfile> profile_;
  double contact_modulus_;
};

}  // namespace salebra
