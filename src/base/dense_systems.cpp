// SPDX-License-Identifier: GPL-3.0-or-later
// Small dense systems by Eigen's decompositions, of dense_systems.hpp.
#include "dense_systems.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace salebra::detail {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

template <int N>
Eigen::Vector<double, N> shortest_solution(const Eigen::Matrix<double, N, N>& a,
                                           const Eigen::Vector<double, N>& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

template Eigen::Vector2d shortest_solution(const Eigen::Matrix2d&, const Eigen::Vector2d&);
template Eigen::Vector3d shortest_solution(const Eigen::Matrix3d&, const Eigen::Vector3d&);
template Eigen::Vector<double, 6> shortest_solution(const Eigen::Matrix<double, 6, 6>&,
                                                    const Eigen::Vector<double, 6>&);

Eigen::Vector2d positive_solution(const Eigen::Matrix2d& a, const Eigen::Vector2d& b) {
  return a.ldlt().solve(b);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
}
Modes symmetric_modes(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a) { return a.inverse(); }
Eigen::Matrix2d inverse(const Eigen::Matrix2d& a) { return a.inverse(); }

}  // namespace salebra::detail
