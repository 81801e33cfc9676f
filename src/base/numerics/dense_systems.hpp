// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace salebra::detail {

/// Moore–Penrose inverse of a matrix of any shape and rank; NaN if a is not finite.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

/// Least-squares solution x of ax = b: the shortest x that minimises |ax − b|. a may have any shape
/// and rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Eigenvalues in increasing order and eigenvectors of a finite symmetric matrix,
/// a = V diag(values) Vᵀ.
struct Modes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // V
};
Modes symmetric_modes(const Eigen::MatrixXd& a);

}  // namespace salebra::detail
