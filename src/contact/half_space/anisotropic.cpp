// SPDX-License-Identifier: GPL-3.0-or-later
// Surface response of anisotropic half-spaces by the integral of Barnett and Lothe.
#include "anisotropic.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>

#include "base/numerics/dense_systems.hpp"
#include "base/special_values.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

// Voigt's index of the pair (i, j).
std::size_t voigt(int i, int j) { return static_cast<std::size_t>(i == j ? i : 6 - i - j); }

// The matrix (ab)_ik = Σ_jl a_j c_ijkl b_l.
Matrix contraction(const AnisotropicStiffness& stiffness, const Vector& a, const Vector& b) {
  Matrix sum = Matrix::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l)
          sum(i, k) += a(j) * stiffness.c[voigt(i, j)][voigt(k, l)] * b(l);
  return sum;
}

void validate(const AnisotropicStiffness& stiffness) {
  Eigen::MatrixXd matrix(6, 6);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double value = stiffness.c[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      require(std::isfinite(value), "stiffness", value, "must be finite");
      matrix(i, j) = value;
    }
  // The sides may differ by the rounding of a rotation.
  const double largest = matrix.cwiseAbs().maxCoeff(),
               difference = (matrix - matrix.transpose()).cwiseAbs().maxCoeff();
  require(difference <= 1e-9 * largest, "stiffness", difference,
          "Pa between two sides of the diagonal; it must be symmetric");
  const double least = detail::symmetric_modes(matrix).values(0);
  require(least > 1e-9 * largest, "stiffness", least,
          "Pa is its least eigenvalue; it must be positive definite");
}

// q times the response to waves along (cos φ, sin φ): the inverse of
//     L = (1/π)∫₀^π [Q − R T⁻¹ Rᵀ] dθ,  Q = (mm), R = (mn), T = (nn),
// where m and n turn by θ in the plane of the wave vector and the normal. The integrand has the
// period π and is smooth, so that the trapezoidal rule converges exponentially.
Matrix compliance_along(const AnisotropicStiffness& stiffness, double direction) {
  const Vector along(std::cos(direction), std::sin(direction), 0), normal(0, 0, 1);
  const Matrix q0 = contraction(stiffness, along, along),
               r0 = contraction(stiffness, along, normal),
               t0 = contraction(stiffness, normal, normal), both = r0 + r0.transpose();
  const auto integrand = [&](double angle) -> Matrix {
    const double c = std::cos(angle), s = std::sin(angle);
    const Matrix q = q0 * (c * c) + both * (s * c) + t0 * (s * s),
                 r = (t0 - q0) * (s * c) + r0 * (c * c) - r0.transpose() * (s * s),
                 t = q0 * (s * s) - both * (s * c) + t0 * (c * c);
    // By factors, R T⁻¹ Rᵀ is right to rounding times c/µ in a nearly incompressible material, where
    // it cancels with Q; an explicit inverse loses the square of that.
    const Matrix factor = t.llt().matrixL().solve(r.transpose());
    return q - factor.transpose() * factor;
  };
  constexpr int most = 1 << 14;
  int points = 8;
  Matrix sum = Matrix::Zero();
  for (int k = 0; k < points; ++k) sum += integrand(pi * k / points);
  for (; points < most; points *= 2) {
    Matrix between = Matrix::Zero();
    for (int k = 0; k < points; ++k) between += integrand(pi * (k + 0.5) / points);
    // The error falls to its square from one rule to the next.
    const bool converged = (between - sum).norm() < 1e-9 * sum.norm();
    sum += between;
    if (converged) return (sum / (2 * points)).llt().solve(Matrix::Identity());
  }
  throw InvalidInput("stiffness",
                     "is of a material so close to instability that its response was not found");
}

}  // namespace

AnisotropicStiffness AnisotropicStiffness::cubic(double c11, double c12, double c44) {
  AnisotropicStiffness stiffness;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) stiffness.c[i][j] = i == j ? c11 : c12;
    stiffness.c[i + 3][i + 3] = c44;
  }
  return stiffness;
}

AnisotropicStiffness AnisotropicStiffness::of_surface(const std::array<double, 3>& normal,
                                                      const std::array<double, 3>& x) const {
  const auto direction = [](const std::array<double, 3>& given, const char* name) {
    const Vector vector(given[0], given[1], given[2]);
    require(vector.norm() > 0 && vector.allFinite(), name, vector.norm(),
            "is its length, which must be > 0 and finite");
    return Vector(vector.normalized());
  };
  const Vector z = direction(normal, "normal"), along = direction(x, "x");
  require(std::abs(along.dot(z)) < 1e-6, "x", along.dot(z),
          "is the cosine of its angle to the normal, to which it must be perpendicular");
  const Vector across(z(1) * along(2) - z(2) * along(1), z(2) * along(0) - z(0) * along(2),
                      z(0) * along(1) - z(1) * along(0));
  const std::array<Vector, 3> axes{along, across.normalized(), z};
  AnisotropicStiffness turned;
  // The blocks of the tensor between pairs of new axes, turned to the new axes themselves.
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l) {
      const Matrix block =
          contraction(*this, axes[static_cast<std::size_t>(j)], axes[static_cast<std::size_t>(l)]);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          turned.c[voigt(i, j)][voigt(k, l)] =
              axes[static_cast<std::size_t>(i)].dot(block * axes[static_cast<std::size_t>(k)]);
    }
  return turned;
}

namespace detail {

AngularResponse::AngularResponse(const AnisotropicStiffness& stiffness) {
  validate(stiffness);
  constexpr std::size_t most = 2048;
  for (std::size_t directions = 16; directions <= most; directions *= 2) {
    terms_.assign(directions / 2, Term{});
    for (std::size_t at = 0; at < directions; ++at) {
      const double angle = pi * static_cast<double>(at) / static_cast<double>(directions);
      const Matrix c = compliance_along(stiffness, angle);
      const Vector along(std::cos(angle), std::sin(angle), 0),
          across(-std::sin(angle), std::cos(angle), 0);
      const std::array<double, 4> values{c(2, 2), along.dot(c * along), across.dot(c * across),
                                         along.dot(c * across)};
      for (std::size_t k = 0; k < terms_.size(); ++k)
        for (std::size_t part = 0; part < values.size(); ++part)
          terms_[k][part] += (k == 0 ? 1.0 : 2.0) / static_cast<double>(directions) * values[part] *
                             std::polar(1.0, -2 * angle * static_cast<double>(k));
    }
    const auto size = [](const Term& term) {
      return std::abs(*std::ranges::max_element(
          term, {}, [](const std::complex<double>& part) { return std::abs(part); }));
    };
    // Coefficients beyond the last one, which the sum folds back, are smaller still.
    const double rounding = 1e-14 * size(terms_.front());
    if (size(terms_.back()) + size(*(terms_.end() - 2)) > rounding) continue;
    while (terms_.size() > 1 && size(terms_.back()) <= rounding) terms_.pop_back();
    return;
  }
  throw InvalidInput("stiffness",
                     "is of a material so anisotropic that its response was not found");
}

SurfaceCompliance AngularResponse::mean() const {
  const Term& term = terms_.front();
  return {term[0].real(), term[1].real(), term[2].real(), unknown, term[3].real()};
}

SurfaceCompliance AngularResponse::along(double cosine, double sine) const {
  const std::complex<double> wave(cosine * cosine - sine * sine, 2 * sine * cosine);
  Term sum = terms_.back();
  for (auto term = terms_.rbegin() + 1; term != terms_.rend(); ++term)
    for (std::size_t part = 0; part < sum.size(); ++part)
      sum[part] = sum[part] * wave + (*term)[part];
  return {sum[0].real(), sum[1].real(), sum[2].real(), unknown, sum[3].real()};
}

}  // namespace detail
}  // namespace salebra
