// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <vector>

/// Closed-form theories of nominally flat contact, for comparison:
///     const double area = persson_area_fraction(1e7, 1.1e11, 0.1);
/// Lengths are in m, pressures in Pa. Every function throws InvalidInput for a pressure, modulus,
/// slope or rms height that is not > 0.
namespace salebra {

/// Returns the fraction of a Gaussian surface that lies above a plane at the height mean_gap over
/// the mean plane of the surface, ½ erfc(ū/(√2 h_rms)); deformation is not considered.
double bearing_area_fraction(double mean_gap, double rms_height);

/// Returns A/A0 = √(2π) p/(E*h') of Bush et al. (1975), with the rms slope h'; valid in the limit
/// of small pressures.
double bgt_area_fraction(double pressure, double contact_modulus, double rms_slope);

/// Returns A/A0 = erf(√2 p/(E*h')) of Persson (2001), with the rms slope h'; at small pressures
/// √(8/π) p/(E*h').
double persson_area_fraction(double pressure, double contact_modulus, double rms_slope);

/// A narrow ring of the spectrum C(q) at the wave number q, rad/m; its power is ∫C d²q over the
/// ring, m².
struct RoughnessShell {
  double wavenumber = 0;
  double power = 0;
};

constexpr void describe(auto&& visit, std::type_identity<RoughnessShell>) {
  using S = RoughnessShell;
  visit(&S::wavenumber, Kept{"wavenumber", "wave number", Dimension::wavenumber});
  visit(&S::power, Kept{"power", "integral of C d^2q over the ring", Dimension::length_squared});
}

/// Divides an isotropic spectrum C(q) = density, m⁴, between the wave numbers `lowest` and
/// `highest`, rad/m, into `count` shells whose limits have equal ratios; powers come from the
/// midpoint rule in ln q.
std::vector<RoughnessShell> roughness_shells(const std::function<double(double)>& density,
                                             double lowest, double highest, int count = 1000);

/// Mean gap and stiffness by the theory of Persson (2007) in the form of Yang and Persson (2008):
///     const PerssonTheory theory(roughness_shells(density, 1e5, 1e9), 1.1e11);
///     const double gap = theory.mean_gap(1e7);
/// The elastic energy of the mode q is the fraction γ P + (1−γ) P³ of its energy in full contact,
/// where γ is energy_factor, P(q) = erf(w p/E*) is the contact area fraction if only roughness up
/// to q is seen, and w⁻² = π∫^q q³C dq. From p dū = −dU with the total energy U follows
///     ū(p) = √π ∫ q²C w ∫_p^∞ [γ + 3(1−γ)P²] exp(−(w p'/E*)²) dp'/p' dq
/// and K/A0 = −dp/dū. With r = 1/w, which is the rms slope up to q divided by √2, dq is replaced by
/// dr; the integral over r is then done in closed form for each shell, except for one numerical
/// quadrature over erf². Valid for complete and partial contact of large surfaces. At ū ≫ h_rms a
/// finite surface no longer touches, whereas p(ū) of this theory remains exponential.
class PerssonTheory {
 public:
  /// Usual energy factor γ, which may lie in (0, 1]: values of 0.4 to 0.5 agree with simulations; 1
  /// neglects the correlation of modes in contact.
  static constexpr double usual_energy_factor = 0.45;

  /// shells: any order, wave numbers > 0; shells without power are ignored.
  PerssonTheory(std::vector<RoughnessShell> shells, double contact_modulus,
                double energy_factor = usual_energy_factor);

  double mean_gap(double pressure) const;               ///< ū, m
  double stiffness_per_area(double pressure) const;     ///< K/A0 = −dp/dū, Pa/m
  double contact_area_fraction(double pressure) const;  ///< A/A0
  double pressure(double mean_gap) const;               ///< p, Pa, at a mean gap ū > 0

  /// Limit of small pressures, p = factor·E*·exp(−ū/decay_length).
  struct Asymptote {
    /// Decay length u0, m, for which K/A0 = p/u0 [Campañá et al. (2011)].
    double decay_length = 0;
    double factor = 0;  ///< dimensionless factor
  };
  Asymptote asymptote() const;

  double rms_height() const { return rms_height_; }  ///< √(Σ power) over all shells, m
  double rms_slope() const { return rms_slope_; }    ///< √(Σ q² power) over all shells

 private:
  struct Ring {
    double wavenumber, inner, outer;  ///< q and the limits of r = 1/w
  };
  std::vector<Ring> rings_;
  double contact_modulus_, energy_factor_, rms_height_ = 0, rms_slope_ = 0;
};

constexpr void describe(auto&& visit, std::type_identity<PerssonTheory::Asymptote>) {
  using S = PerssonTheory::Asymptote;
  visit(&S::decay_length, Kept{"decay_length", "u0; K/A0 = p/u0", Dimension::length});
  visit(&S::factor, Kept{"factor", "β"});
}

/// Computes a force curve at the given pressures (Pa, > 0, any order), sorted by force; K_t =
/// (G*/E*)K if G* is known.
ForceCurve persson_curve(const PerssonTheory& theory, const Material& material, double nominal_area,
                         const std::vector<double>& pressures);

}  // namespace salebra
