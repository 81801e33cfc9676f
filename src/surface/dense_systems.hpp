// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace salebra::detail {

/// Moore and Penrose's inverse of a of any shape and rank: the inverse where there is one, NaN
/// where a is not finite.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

/// The shortest x of least |ax − b|, a of any shape and rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// a = V diag(values) Vᵀ of a finite symmetric a, values increasing.
struct Modes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // V
};
Modes symmetric_modes(const Eigen::MatrixXd& a);

}  // namespace salebra::detail
