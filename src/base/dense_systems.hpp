// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

/// Small dense systems, solved by Eigen's decompositions. Those take seconds to compile, hence one source has them all.
namespace salebra::detail {

/// x of least |Ax − b|, A of full rank, by QR with pivots.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The shortest x of least |Ax − b|, A of any rank. N is 2, 3 or 6.
template <int N>
Eigen::Vector<double, N> shortest_solution(const Eigen::Matrix<double, N, N>& a,
                                           const Eigen::Vector<double, N>& b);

/// x of Ax = b, A symmetric and positive, by LDLᵀ.
Eigen::Vector2d positive_solution(const Eigen::Matrix2d& a, const Eigen::Vector2d& b);

/// Moore and Penrose's, of any shape and rank.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

/// A = V diag(values) Vᵀ of a symmetric A.
struct Modes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // V
};
Modes symmetric_modes(const Eigen::MatrixXd& a);

Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
Eigen::Matrix2d inverse(const Eigen::Matrix2d& a);

}  // namespace salebra::detail
