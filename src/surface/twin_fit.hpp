// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "surface/twin_model.hpp"

namespace salebra::twin_detail {

struct TwinFit {
  Eigen::VectorXd parameters;
  double cost = 0;  ///< −ln of the posterior density: half the sum of squared residuals
};

/// Minimises the cost from a start by Gauss and Newton's method with Levenberg's damping.
/// Parameters in `fixed` keep their values, and parameters of the law stay within their bounds.
TwinFit minimised(const TwinModel& model, Eigen::VectorXd start,
                  const std::vector<Index>& fixed = {});

/// The best fit from several starts, first with a wide tolerance for the deviation of the data from
/// the law, then with the final tolerance, which is wider near the cut-off. The model keeps the
/// final tolerance.
TwinFit fitted(TwinModel& model);

/// Like fitted(), from a single start near the minimum of the cost.
TwinFit refitted(TwinModel& model, const Eigen::VectorXd& start);

/// Minimum cost of a fit with one parameter held, for each of several values of this parameter.
struct TwinProfile {
  std::vector<double> values;  ///< of the held parameter
  std::vector<TwinFit> fits;

  /// Going from the value with the lowest cost towards the first value, returns the value at which
  /// the cost first exceeds `least` by `drop`; empty if it never does.
  std::optional<double> limit(double least, double drop) const;
};

/// Fits with the parameter held at each of the values, from the last to the first; each fit starts
/// from the result of the one before.
TwinProfile profiled(const TwinModel& model, Index parameter, std::vector<double> values,
                     const Eigen::VectorXd& start);

/// Covariance of the parameters at a fit: inverse of the curvature FᵀF, with the derivatives F of
/// the residuals. Weak priors limit the widths of parameters that the data do not determine;
/// parameters in `fixed` have no width.
Eigen::MatrixXd laplace_covariance(const TwinModel& model, const Eigen::VectorXd& parameters,
                                   const std::vector<Index>& fixed = {});

/// Draws from the posterior, one draw in each column, by an ensemble of walkers that starts in the
/// columns of `start`. The ensemble has two halves. Half of the moves of a walker stretch its
/// distance to a walker of the other half (Goodman and Weare (2010)); the other moves are drawn
/// from a Student t distribution with the mean and covariance of the other half.
Eigen::MatrixXd sampled_posterior(const TwinModel& model, const Eigen::MatrixXd& start, Index draws,
                                  std::uint64_t seed);

}  // namespace salebra::twin_detail
