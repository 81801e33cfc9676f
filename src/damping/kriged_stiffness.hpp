// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra::detail {

/// A contact that was solved, as far as the stiffness between contacts depends on it.
struct StiffnessSample {
  double indentation = 0;       // δ, m
  double force = 0;             // F, N
  double stiffness = 0;         // K of its cells, N/m
  double cells = 0, spots = 0;  // that touch
  double perimeter = 0;         // of the contact, in widths of a cell
  double together = 1;          // cells that enter at a time, of a straight part of the perimeter
  double force_correction = 0;  // its size, N: the solver's error is smaller
};

/// Over what is predicted, the variances of K by spots and by cells: the logarithm of a
/// probability, over the logarithms of both.
class VarianceScales {
 public:
  /// As predicted within a factor of e^{±1.5}.
  VarianceScales();
  /// The factors of spots (rows) and cells (columns) in the table.
  static Eigen::ArrayXd of_spots(), of_cells();

  void add(const Eigen::ArrayXXd& log_likelihood) { log_probability_ += log_likelihood; }
  Eigen::ArrayXXd probability() const;
  /// Row and column of the most probable.
  std::pair<Index, Index> best() const;

 private:
  Eigen::ArrayXXd log_probability_;
};

/// K(δ) of the surface between contacts on a grid: universal kriging (best linear unbiased
/// prediction; G. Matheron, Adv. Appl. Probab. 5 (1973) 439) from K of the contacts and their
/// differences of F, the means of K in between.
///
/// The K that is sought is a parabola of any size and a random function. With n spots of an
/// exponential law, of which each has F'' ∝ (δ − δᵢ)^{−1/2} after it touched, the relative
/// covariance of F'' is K₀(τ/2l)/(πn) (modified Bessel function, l = F/K), or −ln τ/(πn) but for
/// what the parabola takes up. Its double integral is the generalised covariance of K, F''² τ² ln
/// τ/(2πn).
///
/// The grid adds its scatter: cells enter at chance indentations, and each raises K by the same
/// step. A number N of them has the variance N as long as N is small, and no more than 2 × 0.0728
/// times the perimeter where the perimeter moves by more than a fifth of a cell, that of lattice
/// points inside a smooth curve at a random place: a random walk that is pulled back, with the
/// covariance v exp(−N/2v), v = 0.0728 × perimeter. Ridges along the grid enter row by row, and the
/// variance is greater by the number of cells that do so together.
///
/// Both variances are known as far as the contacts show them: those of one smooth spot are smaller,
/// those of cells that enter row by row larger. The likelihood of the contacts weighs both.
class KrigedStiffness {
 public:
  /// samples  from the highest indentation to the lowest, at least three
  /// places   indentations at which K is given, decreasing, with those of the samples among them
  KrigedStiffness(const std::vector<StiffnessSample>& samples, Eigen::VectorXd positions);

  /// What VarianceScales::add() takes.
  const Eigen::ArrayXXd& log_likelihood() const { return log_likelihood_; }

  double stiffness(double indentation) const;  // linear between places, as all that follows
  double force(double indentation) const;
  /// Σ weights × K(places) is K at the indentation.
  Eigen::VectorXd weights_at(double indentation) const;

  /// Mean and standard deviation of Σ weights × K(places).
  struct Estimate {
    double value, deviation;
  };
  Estimate estimate(const Eigen::VectorXd& weights, const VarianceScales& scales) const;
  /// Largest change of it where each force is off by its correction at the most.
  double solver_error(const Eigen::VectorXd& weights) const;

 private:
  /// What the samples say of K at the places, all in the units of K: F differs by the mean of K.
  struct Observations {
    Eigen::MatrixXd operators;
    Eigen::VectorXd values;
    Eigen::VectorXd entered;  // cells that touch, at the places
  };
  Observations observations_of(const std::vector<StiffnessSample>& samples) const;
  // The steps of the constructor, in their order. x: places, from −1 to 1.
  void set_covariances(const std::vector<StiffnessSample>& samples, const Eigen::VectorXd& x,
                       const Observations& observations);
  void find_contrasts(const Eigen::MatrixXd& trend);  // powers at the samples
  void find_scales();
  void predict(const StiffnessSample& middle);

  /// What an estimate is made of, in the coordinates in which both covariances are diagonal.
  struct Parts {
    Eigen::VectorXd trend;  // weights of the samples that keep the parabola
    Eigen::VectorXd by_spots, by_cells;
    double spots, cells;  // variances of the trend
  };
  Parts parts(const Eigen::VectorXd& weights) const;
  Eigen::VectorXd sample_weights(const Parts& parts, double of_spots, double of_cells) const;

  double bend_, half_;
  double best_of_spots_, best_of_cells_;
  Eigen::VectorXd positions_, stiffness_, force_, values_;
  Eigen::VectorXd corrections_;          // of the forces of the samples
  Eigen::MatrixXd trend_;                // powers at the places
  Eigen::MatrixXd fit_;                  // coefficients of the parabola from the samples
  Eigen::MatrixXd spots_;                // covariance between places
  Eigen::MatrixXd spots_to_samples_;     // … of samples and places
  Eigen::MatrixXd of_spots_, of_cells_;  // … of samples
  Eigen::MatrixXd contrasts_;       // of the samples: covariance of cells 1, of spots `ratios_`
  Eigen::VectorXd ratios_, found_;  // found_: contrasts of the values
  Eigen::ArrayXXd log_likelihood_;
};

}  // namespace salebra::detail
