// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra::detail {

/// A solved contact, with the quantities that the prediction of the stiffness between contacts
/// uses.
struct StiffnessSample {
  double indentation = 0;       // δ, m
  double force = 0;             // F, N
  double stiffness = 0;         // K of the cells in contact, N/m
  double cells = 0, spots = 0;  // numbers of cells and of contact patches in contact
  double perimeter = 0;         // of the contact, in cell widths
  double together = 1;          // cells that enter at a time along a straight part of the perimeter
  // Absolute correction of the force, N, an upper bound of the solver's error.
  double force_correction = 0;
};

/// Factors by which the actual variances of K exceed the predicted ones: one factor for the
/// variance by contact patches and one for that by cells. Holds a table of the log probabilities of
/// both factors on a logarithmic grid.
class VarianceScales {
 public:
  /// Prior distribution: the logarithm of each factor is normal, with mean 0 and deviation 1.5.
  VarianceScales();
  /// Values of the factor for patches (rows of the table) and for cells (columns).
  static Eigen::ArrayXd of_spots(), of_cells();

  void add(const Eigen::ArrayXXd& log_likelihood) { log_probability_ += log_likelihood; }
  Eigen::ArrayXXd probability() const;
  /// Row and column of the table at which the probability is largest.
  std::pair<Index, Index> best() const;

 private:
  Eigen::ArrayXXd log_probability_;
};

/// Predicts K(δ) of the surface between contacts solved on a grid by universal kriging (best linear
/// unbiased prediction; G. Matheron, Adv. Appl. Probab. 5 (1973) 439). The data are K of the
/// contacts and the differences of F between contacts, each of which is the mean of K over an
/// interval.
///
/// K is modelled as a parabola with free coefficients plus a random function with two independent
/// parts, by contact patches and by cells. Patches: for n contact patches of an exponential law,
/// each with F'' ∝ (δ − δᵢ)^{−1/2} after its first touch at δᵢ, the relative covariance of F'' at
/// two indentations a distance τ apart is K₀(τ/2l)/(πn) (modified Bessel function K₀, l = F/K),
/// which is −ln τ/(πn) except for terms that the parabola absorbs. Its double integral is the
/// generalised covariance of K, F''² τ² ln τ/(2πn).
///
/// Cells: the grid adds scatter, because cells enter at random indentations, and each raises K by
/// the same step. The variance of the number N of entered cells is N for small N. It never exceeds
/// 2 × 0.0728 times the perimeter, where 0.0728 × perimeter is the variance of the number of
/// lattice points inside a smooth curve at a random position; this limit holds once the perimeter
/// has moved by more than a fifth of a cell. N is therefore modelled as a random walk with a
/// restoring force, with the covariance v exp(−|ΔN|/2v), v = 0.0728 × perimeter. Ridges along the
/// grid enter row by row, which multiplies the variance by the number of cells that enter together.
///
/// The factors of both variances (VarianceScales) follow from the likelihood of the data: patches
/// that all have one smooth shape have a smaller variance than predicted, cells that enter row by
/// row a larger one.
class KrigedStiffness {
 public:
  /// samples    solved contacts from the highest indentation to the lowest, at least three
  /// positions  decreasing indentations at which K is predicted; they include those of the samples
  KrigedStiffness(const std::vector<StiffnessSample>& samples, Eigen::VectorXd positions);

  /// Log likelihood of the samples for each pair of factors, as VarianceScales::add() takes it.
  const Eigen::ArrayXXd& log_likelihood() const { return log_likelihood_; }

  // K, N/m; linear between the positions, as are the functions below.
  double stiffness(double indentation) const;
  double force(double indentation) const;
  /// Returns the weights for which Σ weights × K(positions) is K at the indentation.
  Eigen::VectorXd weights_at(double indentation) const;

  /// Mean and standard deviation of a weighted sum Σ weights × K(positions), for example of W.
  struct Estimate {
    double value, deviation;
  };
  Estimate estimate(const Eigen::VectorXd& weights, const VarianceScales& scales) const;
  /// Largest change of the weighted sum if each sample's force is wrong by at most its correction.
  double solver_error(const Eigen::VectorXd& weights) const;

 private:
  /// What the samples say about K at the positions, in units of K: values ≈ operators ×
  /// K(positions). A difference of two forces, divided by their distance, is a mean of K.
  struct Observations {
    Eigen::MatrixXd operators;
    Eigen::VectorXd values;
    Eigen::VectorXd entered;  // cells in contact, at the positions
  };
  Observations observations_of(const std::vector<StiffnessSample>& samples) const;
  // The following functions are the steps of the constructor, in order. x: positions, scaled to the
  // range from −1 to 1.
  void set_covariances(const std::vector<StiffnessSample>& samples, const Eigen::VectorXd& x,
                       const Observations& observations);
  void find_contrasts(const Eigen::MatrixXd& trend);  // trend: powers of x, as the samples see them
  void find_scales();
  void predict(const StiffnessSample& middle);

  /// The terms of an estimate. by_spots and by_cells are in coordinates in which both covariances,
  /// by patches and by cells, are diagonal.
  struct Parts {
    Eigen::VectorXd trend;  // weights of the samples that are exact for every parabola
    Eigen::VectorXd by_spots, by_cells;
    double spots, cells;  // variances of the part of the estimate that the parabola gives
  };
  Parts parts(const Eigen::VectorXd& weights) const;
  Eigen::VectorXd sample_weights(const Parts& parts, double of_spots, double of_cells) const;

  double bend_, half_;
  double best_of_spots_, best_of_cells_;
  Eigen::VectorXd positions_, stiffness_, force_, values_;
  Eigen::VectorXd corrections_;  // corrections of the sample forces
  Eigen::MatrixXd trend_;        // powers of x at the positions
  // Maps the data of the samples to the coefficients of the parabola.
  Eigen::MatrixXd fit_;
  Eigen::MatrixXd spots_;                // covariance by patches between positions
  Eigen::MatrixXd spots_to_samples_;     // covariance by patches between samples and positions
  Eigen::MatrixXd of_spots_, of_cells_;  // covariances between samples, by patches and by cells
  // Combinations of samples with the variances 1 by cells and ratios_ by patches.
  Eigen::MatrixXd contrasts_;
  Eigen::VectorXd ratios_, found_;  // found_: contrasts_ applied to the data of the samples
  Eigen::ArrayXXd log_likelihood_;
};

}  // namespace salebra::detail
