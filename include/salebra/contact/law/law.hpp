// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/contact/law/force_curve.hpp>
#include <vector>

namespace salebra {

/// Force–indentation law of a contact, the only input that the damping problem needs from it
/// (docs/theory.md, section 7):
///     const TabulatedLaw law(curve, material.modulus_ratio());
///     const double stiffness = law.normal_stiffness(law.indentation_of(10.0));
/// Indentation δ grows with approach. A law is immutable and may be shared between threads. Units:
/// m, N, N/m, N/m². Below first_touch() the bodies are apart: F, K, K_t and their derivatives are 0.
/// Evaluation above highest_indentation() throws InvalidInput that names the range.
class ContactLaw {
 public:
  /// modulus_ratio: G*/E* > 0, the ratio of K_t to K; NaN if the body has no such constant, for a
  /// law whose K_t comes from elsewhere.
  explicit ContactLaw(double modulus_ratio);
  virtual ~ContactLaw() = default;

  virtual double force(double indentation) const = 0;             ///< F(δ)
  virtual double normal_stiffness(double indentation) const = 0;  ///< K = F'
  virtual double force_curvature(double indentation) const = 0;   ///< K' = F''
  /// K_t(δ); (G*/E*)K unless the law has its own K_t.
  virtual double tangential_stiffness(double indentation) const;
  virtual double tangential_curvature(double indentation) const;  ///< K_t'(δ)
  /// K_t/K at δ: G*/E* unless the law has its own K_t. With the coefficient of friction μ, a spring
  /// that touches at the depth ζ slips at the stretch (μK/K_t)(δ − ζ); a contact that slides as a
  /// whole then carries μF.
  virtual double stiffness_ratio(double indentation) const;
  /// Indentation δ_t at which the bodies touch first, m; −∞ for a law with a force at every δ.
  virtual double first_touch() const;
  /// Lowest indentation of the data that the law comes from, m; −∞ unless the law is a table, which
  /// is continued from there down to first touch.
  virtual double lowest_indentation() const;
  virtual double highest_indentation() const;  ///< m; +∞ unless the law is a table
  /// Inverse of force(): δ with F(δ) = force > 0. Throws InvalidInput if the law does not reach the
  /// force.
  virtual double indentation_of(double force) const = 0;

  /// Indentations, increasing, at which F, K, K_t or the first derivative of one of them is known
  /// to jump. Quadratures over δ converge fast between these points.
  virtual std::vector<double> break_points() const;

  /// The same law through every other sample of its table, the first and the last included: what it
  /// changes shows the error by the distances between the samples. odd: which half of the others
  /// remains. Null for a law that is not a table and for a table of fewer than seven samples.
  virtual std::unique_ptr<const ContactLaw> coarser(bool odd) const;

  double modulus_ratio() const { return modulus_ratio_; }

 private:
  double modulus_ratio_;
};

/// Power law F = B δⁿ for δ > 0, and F = 0 for δ <= 0: n = 2 for a cone, n = 3/2 for a paraboloid,
/// n = 1 + 1/m for a profile r^m.
class PowerLaw final : public ContactLaw {
 public:
  PowerLaw(double coefficient, double exponent, double modulus_ratio);
  double force(double indentation) const override;
  double normal_stiffness(double indentation) const override;
  double force_curvature(double indentation) const override;
  double first_touch() const override { return 0; }
  double indentation_of(double force) const override;
  std::vector<double> break_points() const override;  ///< first touch
  double coefficient() const { return coefficient_; }
  double exponent() const { return exponent_; }

 private:
  double coefficient_, exponent_;
};

/// Exponential law F = F0 exp(δ/l) of nominally flat rough surfaces (F ∝ exp(−ū/l)), with the
/// reference force F0 at δ = 0 and the decay length l, m.
class ExponentialLaw final : public ContactLaw {
 public:
  ExponentialLaw(double reference_force, double decay_length, double modulus_ratio);
  double force(double indentation) const override;
  double normal_stiffness(double indentation) const override;
  double force_curvature(double indentation) const override;
  double indentation_of(double force) const override;
  double decay_length() const { return decay_length_; }

 private:
  double reference_force_, decay_length_;
};

/// Law that interpolates a force curve, computed or read from a file. A monotone cubic interpolates
/// ln F over δ; its slopes at the samples are K/F if every sample has K, otherwise four-point
/// differences. K and F'' are the exact derivatives of the interpolant. The errors of F, K and F''
/// are of order 4, 3 and 2 in the spacing of the samples (F'' jumps at the samples). If every
/// sample has K_t, ln K_t is interpolated in the same way and modulus_ratio, which may be NaN, is
/// not used; otherwise K_t = (G*/E*)K. The curve of a body that is no half-space takes only NaN. δ
/// is the indentation of the samples, or −ū if a sample has no indentation; this only shifts δ.
/// Samples that did not converge or have F = 0 are ignored.
///
/// Below the first sample (δ1, F1, K1, K_t1) the law is that of summits that separate one after the
/// other, until the last of them opens like a sphere at δ_t:
///     F = F1 s^(3/2),  K = K1 s^(1/2),  K_t = K_t1 s^(1/2),
///     s = (δ − δ_t)/(δ1 − δ_t),  δ_t = δ1 − 1.5 F1/K1.
/// Whether this continuation matters is judged by whoever integrates over it (error_estimate of
/// DampingResult).
/// Throws InvalidInput for fewer than four usable samples or F not growing with δ.
class TabulatedLaw final : public ContactLaw {
 public:
  TabulatedLaw(const ForceCurve& curve, double modulus_ratio);
  ~TabulatedLaw() override;
  double force(double indentation) const override;
  double normal_stiffness(double indentation) const override;
  double force_curvature(double indentation) const override;
  double tangential_stiffness(double indentation) const override;
  double tangential_curvature(double indentation) const override;
  /// K_t/K; beyond the first or last sample, its value at that sample.
  double stiffness_ratio(double indentation) const override;
  double first_touch() const override;
  double lowest_indentation() const override;
  double highest_indentation() const override;
  double indentation_of(double force) const override;
  /// First touch and the indentations of the samples.
  std::vector<double> break_points() const override;
  std::unique_ptr<const ContactLaw> coarser(bool odd) const override;

 private:
  struct Splines;
  std::unique_ptr<const Splines> splines_;
};

}  // namespace salebra
