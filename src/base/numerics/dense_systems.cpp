// SPDX-License-Identifier: GPL-3.0-or-later
// Pseudo-inverses and eigenvalues of small dense matrices, by GSL.
#include "dense_systems.hpp"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>

#include <limits>
#include <memory>
#include <new>

#include "base/quiet_gsl.hpp"

namespace salebra::detail {
namespace {

// Row-major matrices, the layout of GSL's matrices.
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

gsl_matrix_view view(RowMajor& a) {
  return gsl_matrix_view_array(a.data(), static_cast<std::size_t>(a.rows()),
                               static_cast<std::size_t>(a.cols()));
}
gsl_vector_view view(Eigen::VectorXd& a) {
  return gsl_vector_view_array(a.data(), static_cast<std::size_t>(a.size()));
}

}  // namespace

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
  // With numbers that are not finite, the Jacobi rotations would not converge.
  if (!a.allFinite())
    return Eigen::MatrixXd::Constant(a.cols(), a.rows(), std::numeric_limits<double>::quiet_NaN());
  if (a.rows() < a.cols()) return pseudo_inverse(a.transpose()).transpose();
  // One-sided Jacobi rotations keep the digits of small singular values.
  RowMajor u = a, v(a.cols(), a.cols());
  Eigen::VectorXd values(a.cols());
  gsl_matrix_view u_view = view(u), v_view = view(v);
  gsl_vector_view value_view = view(values);
  gsl_linalg_SV_decomp_jacobi(&u_view.matrix, &v_view.matrix, &value_view.vector);
  // Singular values below this are 0 but for round-off.
  const double least = std::numeric_limits<double>::epsilon() * static_cast<double>(a.rows()) *
                       (values.size() > 0 ? values.maxCoeff() : 0);
  const Eigen::VectorXd inverse =
      values.unaryExpr([&](double value) { return value > least ? 1 / value : 0.0; });
  return v * inverse.asDiagonal() * u.transpose();
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return pseudo_inverse(a) * b;
}

Modes symmetric_modes(const Eigen::MatrixXd& a) {
  quiet_gsl();
  RowMajor copy = a, vectors(a.rows(), a.cols());
  Modes modes{Eigen::VectorXd(a.rows()), {}};
  const std::unique_ptr<gsl_eigen_symmv_workspace, decltype(&gsl_eigen_symmv_free)> workspace(
      gsl_eigen_symmv_alloc(static_cast<std::size_t>(a.rows())), &gsl_eigen_symmv_free);
  if (!workspace) throw std::bad_alloc();
  gsl_matrix_view copy_view = view(copy), vector_view = view(vectors);
  gsl_vector_view value_view = view(modes.values);
  gsl_eigen_symmv(&copy_view.matrix, &value_view.vector, &vector_view.matrix, workspace.get());
  gsl_eigen_symmv_sort(&value_view.vector, &vector_view.matrix, GSL_EIGEN_SORT_VAL_ASC);
  modes.vectors = vectors;
  return modes;
}

}  // namespace salebra::detail
