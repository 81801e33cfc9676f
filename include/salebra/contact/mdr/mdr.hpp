// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/law.hpp>
#include <span>
#include <vector>

/// Method of dimensionality reduction: an axisymmetric contact as a one-dimensional elastic
/// foundation, Popov and Heß (2015).
namespace salebra {

/// A number with the estimate of its error.
struct Estimate {
  double value = 0;
  double error = 0;
};

/// Eq. (3): g(x) = |x| ∫_0^{|x|} f'(r)/√(x² − r²) dr = |x| ∫_0^{π/2} f'(|x| sin φ) dφ, by adaptive
/// quadrature in φ, where the singularity is gone. slope: f'(r), r >= 0; breaks: radii at which f'
/// is not smooth, increasing. Cost: 20 to 1000 evaluations of f'.
Estimate mdr_transform(const std::function<double(double)>& slope, double x,
                       std::span<const double> breaks = {});

/// The inverse, f(r) = (2/π) ∫_0^r g(x)/√(r² − x²) dx.
Estimate mdr_inverse(const std::function<double(double)>& image, double r,
                     std::span<const double> breaks = {});

/// Stress of a line load q(x) = q(−x) of the foundation, Eq. (17):
///     σ(r) = −(1/π) ∫_r^∞ q'(x)/√(x² − r²) dx = (1/π) [q(a)/√(a² − r²) − ∫_r^a q'(x)/√(x² − r²)
///     dx],
/// where q jumps to 0 at the edge a. q_z = E*(δ − g) gives p(r), q_x gives τ(r). 0 for r >= a.
/// slope: q'(x) for 0 < x < a, at most integrably singular at the breaks.
Estimate line_load_stress(const std::function<double(double)>& slope, double edge_value,
                          double edge, double r, std::span<const double> breaks = {});

/// An axisymmetric indenter z = f(r), f(0) = 0, and its image g(x) of Eq. (3). Immutable. Lengths
/// in m. Evaluated at x, r >= 0 up to largest_radius(); beyond: InvalidInput.
class IndenterProfile {
 public:
  virtual ~IndenterProfile() = default;
  virtual double height(double r) const = 0;          ///< f(r)
  virtual double image(double x) const = 0;           ///< g(x)
  virtual double image_slope(double x) const = 0;     ///< g'(x), the c of the paper at the edge
  virtual double image_integral(double x) const = 0;  ///< ∫_0^x g dx
  /// Radius of the flat end, g = 0 within: a contact is never smaller.
  virtual double flat_radius() const { return 0; }
  /// Where the profile ends: beyond it, f = ∞ (a punch) or is not known (a table, the equator of a
  /// sphere).
  virtual double largest_radius() const { return std::numeric_limits<double>::infinity(); }
  /// Whether the contact stops growing at largest_radius() (the side of a punch) or leaves what is
  /// known.
  virtual bool has_side() const { return false; }
  /// Radii at which f' is not smooth.
  virtual std::vector<double> breaks() const { return {}; }
  /// Contact radius a with g(a) = indentation > 0. Throws InvalidInput beyond the largest radius of
  /// a profile without a side.
  virtual double contact_radius(double indentation) const;
};

/// f = r tanθ: g = (π/2) tanθ |x|, Eqs (4), (5). angle: θ between the cone's surface and the plane,
/// 0 < θ < π/2, rad.
std::unique_ptr<IndenterProfile> cone_profile(double angle);
/// f = r²/2R: g = x²/R.
std::unique_ptr<IndenterProfile> paraboloid_profile(double radius);
/// f = B rⁿ, n > 0: g = κ_n B |x|ⁿ, κ_n = (√π n/2) Γ(n/2)/Γ((n+1)/2).
std::unique_ptr<IndenterProfile> power_profile(double coefficient, double exponent);
/// f = R − √(R² − r²), exactly: g = x artanh(x/R) (Sneddon 1965), up to the equator.
std::unique_ptr<IndenterProfile> sphere_profile(double radius);
/// Cylinder with a flat end of the given radius.
std::unique_ptr<IndenterProfile> flat_punch_profile(double radius);
/// Flat end with rounded edge: f = 0 for r < flat_radius, (r − b)²/2R beyond, R = edge_radius.
std::unique_ptr<IndenterProfile> rounded_punch_profile(double flat_radius, double edge_radius);

/// A profile measured or computed at radii r_i: f between them by a monotone cubic, its image by
/// exact quadrature of each piece.
class TabulatedProfile final : public IndenterProfile {
 public:
  /// radii: from 0, strictly increasing; heights: rising from their first value, which is taken as
  /// 0; at least seven points. Throws InvalidInput that names the row otherwise, and where the
  /// points are so few that leaving out every other one changes the image by more than 20 % in the
  /// outer three quarters.
  TabulatedProfile(std::vector<double> radii, std::vector<double> heights);
  ~TabulatedProfile() override;
  double height(double r) const override;
  double image(double x) const override;
  double image_slope(double x) const override;
  double image_integral(double x) const override;
  double flat_radius() const override;
  double largest_radius() const override;
  std::vector<double> breaks() const override;
  double contact_radius(double indentation) const override;
  /// Relative change of g(x) when every other point is left out: an upper estimate of the
  /// interpolation error.
  double image_error(double x) const;

 private:
  struct Table;
  std::unique_ptr<const Table> table_;
};

/// The contact of a profile with an elastic half-space, exact (docs/theory.md, section 6):
///     δ = g(a), F = 2E* ∫_0^a (δ − g) dx, K = 2E*a, F'' = 2E*/g'(a), K_t = (G*/E*)K.
/// The general case of what PowerLaw is for cone, paraboloid and power profiles.
class IndenterLaw final : public ContactLaw {
 public:
  /// Throws InvalidInput where G* of the material is not known.
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
