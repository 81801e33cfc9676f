// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/contact/law/force_curve.hpp>
#include <vector>

namespace salebra {

/// Force–indentation law of a contact: all that the damping problem needs to know of it
/// (docs/theory.md, section 7). Indentation δ grows with approach. A law is immutable and may be
/// shared between threads. Units: m, N, N/m, N/m². Evaluation outside [lowest_indentation,
/// highest_indentation] throws InvalidInput that names the range; below first touch, laws that
/// define it return 0.
class ContactLaw {
 public:
  /// modulus_ratio: G*/E* > 0, which turns K into K_t.
  explicit ContactLaw(double modulus_ratio);
  virtual ~ContactLaw() = default;

  virtual double force(double indentation) const = 0;             ///< F(δ)
  virtual double normal_stiffness(double indentation) const = 0;  ///< K = F'
  virtual double force_curvature(double indentation) const = 0;   ///< K' = F''
  /// K_t(δ); (G*/E*)K unless the law was given a K_t of its own.
  virtual double tangential_stiffness(double indentation) const;
  virtual double tangential_curvature(double indentation) const;  ///< K_t'(δ)
  /// K_t/K at δ: G*/E* unless the law was given a K_t of its own. A level that touches at ζ slips
  /// where it is stretched by μK/K_t (δ − ζ): with this ratio a contact that slides as a whole
  /// carries μF.
  virtual double stiffness_ratio(double indentation) const;
  virtual double lowest_indentation() const;   ///< −∞ unless the law is a table
  virtual double highest_indentation() const;  ///< +∞ unless the law is a table
  /// Inverse of force(): δ with F(δ) = force > 0. Throws InvalidInput where the law does not reach
  /// that force.
  virtual double indentation_of(double force) const = 0;

  /// Indentations at which F, K, K_t or one of their first derivatives jumps, increasing, as far as
  /// the law knows them: quadratures over δ converge fast between them.
  virtual std::vector<double> break_points() const;

  double modulus_ratio() const { return modulus_ratio_; }

 private:
  double modulus_ratio_;
};

/// F = B δⁿ for δ > 0, 0 below: cone n = 2, paraboloid n = 3/2, profile r^m n = 1 + 1/m.
class PowerLaw final : public ContactLaw {
 public:
  PowerLaw(double coefficient, double exponent, double modulus_ratio);
  double force(double indentation) const override;
  double normal_stiffness(double indentation) const override;
  double force_curvature(double indentation) const override;
  double indentation_of(double force) const override;
  std::vector<double> break_points() const override;  ///< first touch
  double coefficient() const { return coefficient_; }
  double exponent() const { return exponent_; }

 private:
  double coefficient_, exponent_;
};

/// F = F0 exp(δ/l), δ counted from where F = F0: the law of nominally flat rough surfaces, F ∝
/// exp(−ū/l).
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

/// A curve, computed or read from a file. ln F against δ is interpolated by one monotone cubic,
/// whose slopes at the nodes are K/F where every sample has K and four-point differences otherwise;
/// K = F' and K' = F'' are its exact derivatives, of order 4, 3 and 2 in the spacing of the samples
/// (K' jumps at the samples). K_t: where every sample has one, ln K_t is interpolated likewise and
/// modulus_ratio is not used; otherwise (G*/E*)K. δ is the samples' indentation, or −ū where any of
/// them lacks it: the laws differ by a shift of δ only. Samples that did not converge or have F = 0
/// are left out. Throws InvalidInput for fewer than four usable samples or F not growing with δ.
class TabulatedLaw final : public ContactLaw {
 public:
  TabulatedLaw(const ForceCurve& curve, double modulus_ratio);
  ~TabulatedLaw() override;
  double force(double indentation) const override;
  double normal_stiffness(double indentation) const override;
  double force_curvature(double indentation) const override;
  double tangential_stiffness(double indentation) const override;
  double tangential_curvature(double indentation) const override;
  /// Beyond the table's ends that of the end.
  double stiffness_ratio(double indentation) const override;
  double lowest_indentation() const override;
  double highest_indentation() const override;
  double indentation_of(double force) const override;
  std::vector<double> break_points() const override;  ///< the samples

 private:
  struct Splines;
  std::unique_ptr<const Splines> splines_;
};

}  // namespace salebra
