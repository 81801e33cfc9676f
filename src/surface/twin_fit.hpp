// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "surface/twin_model.hpp"

namespace salebra::twin_detail {

struct TwinFit {
  Eigen::VectorXd parameters;
  double cost = 0;  ///< −ln of the posterior density, ½|F|²
};

/// Least squares from a start by Gauss and Newton with Levenberg's damping; parameters in `fixed`
/// keep their values, those of the law their bounds.
TwinFit minimised(const TwinModel& model, Eigen::VectorXd start,
                  const std::vector<Index>& fixed = {});

/// The best of several starts of a self-affine law under a wide tolerance, then under that of the law with the zone of
/// the cut-off apart, which it leaves set.
TwinFit fitted(TwinModel& model);

/// fitted() from a start that is near.
TwinFit refitted(TwinModel& model, const Eigen::VectorXd& start);

/// Least cost with one parameter held at several values.
struct TwinProfile {
  std::vector<double> values;  ///< of the parameter
  std::vector<TwinFit> fits;

  /// The value at which the cost first is `drop` above the least on the way from the end that is
  /// allowed, the last, to the first; none where it never is.
  std::optional<double> limit(double least, double drop) const;
};

/// From a start for the last value to the first one.
TwinProfile profiled(const TwinModel& model, Index parameter, std::vector<double> values,
                     const Eigen::VectorXd& start);

/// Inverse of FᵀF's curvature at a fit, in the parameters that are not at a bound; widths beyond
/// those of weak priors are cut.
Eigen::MatrixXd laplace_covariance(const TwinModel& model, const Eigen::VectorXd& parameters,
                                   const std::vector<Index>& fixed = {});

/// Draws of the posterior, one each column, by an ensemble of walkers that starts in the columns of
/// `start`.
/// Half of the moves stretch towards a walker of the other half (Goodman and Weare (2010)); half
/// are drawn from a Student t distribution with the mean and covariance of the other half.
Eigen::MatrixXd sampled_posterior(const TwinModel& model, const Eigen::MatrixXd& start, Index draws,
                                  std::uint64_t seed);

}  // namespace salebra::twin_detail
