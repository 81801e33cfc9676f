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

/// Computes Eq. (3), g(x) = |x| ∫_0^{|x|} f'(r)/√(x² − r²) dr = |x| ∫_0^{π/2} f'(|x| sin φ) dφ, by
/// adaptive quadrature in φ, which removes the singularity. slope: f'(r), r >= 0; breaks: radii at
/// which f' is not smooth, increasing. Cost: 20 to 1000 evaluations of f'.
Estimate mdr_transform(const std::function<double(double)>& slope, double x,
                       std::span<const double> breaks = {});

/// Computes the inverse, f(r) = (2/π) ∫_0^r g(x)/√(r² − x²) dx.
Estimate mdr_inverse(const std::function<double(double)>& image, double r,
                     std::span<const double> breaks = {});

/// Computes the stress of a line load q(x) = q(−x) of the foundation, Eq. (17):
///     σ(r) = −(1/π) ∫_r^∞ q'(x)/√(x² − r²) dx
///          = (1/π) [q(a)/√(a² − r²) − ∫_r^a q'(x)/√(x² − r²) dx],
/// where q jumps to 0 at the edge a. q_z = E*(δ − g) gives p(r), q_x gives τ(r). 0 for r >= a.
/// slope: q'(x) for 0 < x < a, at most integrably singular at the breaks.
Estimate line_load_stress(const std::function<double(double)>& slope, double edge_value,
                          double edge, double r, std::span<const double> breaks = {});

/// An axisymmetric indenter z = f(r), f(0) = 0, and its image g(x) of Eq. (3). Immutable. Lengths
/// in m. Evaluated at x, r >= 0 up to max_radius(); beyond: InvalidInput.
class IndenterProfile {
 public:
  virtual ~IndenterProfile() = default;
  virtual double height(double r) const = 0;          ///< f(r)
  virtual double image(double x) const = 0;           ///< g(x)
  virtual double image_slope(double x) const = 0;     ///< g'(x), the c of the paper at the edge
  virtual double image_integral(double x) const = 0;  ///< ∫_0^x g dx
  /// Radius of the flat end, inside which g = 0: the minimum contact radius.
  virtual double flat_radius() const { return 0; }
  /// Radius at which the profile ends: beyond it f = ∞ (a punch) or is unknown (a table, the
  /// equator of a sphere).
  virtual double max_radius() const { return std::numeric_limits<double>::infinity(); }
  /// True if the contact stops growing at max_radius() (the side of a punch), false if it then
  /// leaves the known profile.
  virtual bool has_side() const { return false; }
  /// Radii at which f' is not smooth.
  virtual std::vector<double> breaks() const { return {}; }
  /// Contact radius a with g(a) = indentation > 0. Throws InvalidInput beyond the largest radius of
  /// a profile without a side.
  virtual double contact_radius(double indentation) const;
};

/// f = r tanθ: g = (π/2) tanθ |x|, Eqs (4), (5). angle: θ between the surface of the cone and the
/// plane, 0 < θ < π/2, rad.
std::unique_ptr<IndenterProfile> cone_profile(double angle);
/// f = r²/2R: g = x²/R.
std::unique_ptr<IndenterProfile> paraboloid_profile(double radius);
/// f = B rⁿ, n > 0: g = κ_n B |x|ⁿ, κ_n = (√π n/2) Γ(n/2)/Γ((n+1)/2).
std::unique_ptr<IndenterProfile> power_profile(double coefficient, double exponent);
/// f = R − √(R² − r²), exactly: g = x artanh(x/R) (Sneddon 1965), up to the equator.
std::unique_ptr<IndenterProfile> sphere_profile(double radius);
/// A cylinder with a flat end of the given radius.
std::unique_ptr<IndenterProfile> flat_punch_profile(double radius);
/// A flat end with rounded edge: f = 0 for r < b, (r − b)²/2R beyond, b = flat_radius, R =
/// edge_radius.
std::unique_ptr<IndenterProfile> rounded_punch_profile(double flat_radius, double edge_radius);

/// A profile measured or computed at radii r_i: a monotone cubic interpolates f, and exact
/// quadrature of each piece gives its image.
class TabulatedProfile final : public IndenterProfile {
 public:
  /// radii: from 0, strictly increasing; heights: increasing from their first value, which becomes
  /// 0; at least seven points. Otherwise throws InvalidInput that names the row, and also if the
  /// points are so few that omitting every other one changes the image by more than 20 % in the
  /// outer three quarters.
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

/// Exact law of the contact of a profile with an elastic half-space (docs/theory.md, section 6):
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
  double highest_indentation() const override;
  std::vector<double> break_points() const override;
  double contact_radius(double indentation) const;
  /// p(r) under the indenter, Pa; infinite at the edge of a flat end.
  double pressure(double indentation, double r) const;
  /// Normal displacement of the half-space's surface, m: δ − f(r) in contact,
  /// (2/π) ∫_0^a (δ − g(x))/√(r² − x²) dx outside it.
  double surface_displacement(double indentation, double r) const;
  const IndenterProfile& profile() const { return *profile_; }
  double contact_modulus() const { return contact_modulus_; }

 private:
  std::shared_ptr<const IndenterProfile> profile_;
  double contact_modulus_;
};

}  // namespace salebra
