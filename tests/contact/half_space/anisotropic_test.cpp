// SPDX-License-Identifier: GPL-3.0-or-later
// The surface response of anisotropic half-spaces against closed forms and two other methods.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/body.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

AnisotropicStiffness stiffness_of(const Matrix6& matrix) {
  AnisotropicStiffness stiffness;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) stiffness.c[std::size_t(i)][std::size_t(j)] = matrix(i, j);
  return stiffness;
}

// A triclinic material: no direction of its surface is like another.
AnisotropicStiffness triclinic() {
  Matrix6 root;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) root(i, j) = std::sin(1 + 3 * i + 7 * j + i * j) + (i == j ? 2 : 0);
  return stiffness_of(5e9 * root * root.transpose());
}

// The element c_ijkl from the definition of Voigt's indices.
double element(const AnisotropicStiffness& stiffness, int i, int j, int k, int l) {
  constexpr std::size_t index[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  return stiffness.c[index[i][j]][index[k][l]];
}

using Matrix3 = Eigen::Matrix3d;
Matrix3 product(const AnisotropicStiffness& stiffness, const Eigen::Vector3d& a,
                const Eigen::Vector3d& b) {
  Matrix3 sum = Matrix3::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) sum(i, k) += a(j) * element(stiffness, i, j, k, l) * b(l);
  return sum;
}

// Normal, in plane, across, mixed: the elements of a compliance in the axes of the surface.
std::array<double, 4> elements(const Matrix3& c, double direction) {
  const Eigen::Vector3d along(std::cos(direction), std::sin(direction), 0),
      across(-std::sin(direction), std::cos(direction), 0);
  return {c(2, 2), along.dot(c * along), across.dot(c * across), along.dot(c * across)};
}

// One element of the depth, of the functions e^(−z/2) L_k(z) of Laguerre over the infinite depth, for
// q = 1: minimum of the energy, so that the compliance has the square of the error.
Matrix3 column(const AnisotropicStiffness& stiffness, double direction) {
  constexpr int functions = 60;
  const Eigen::Vector3d along(std::cos(direction), std::sin(direction), 0), normal(0, 0, 1);
  const Matrix3 q = product(stiffness, along, along), r = product(stiffness, along, normal),
                t = product(stiffness, normal, normal);
  // Row k: the derivative of function k, as a sum of functions.
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(functions, functions);
  for (int k = 0; k < functions; ++k) {
    derivative(k, k) = -0.5;
    derivative.row(k).head(k).setConstant(-1);
  }
  const Eigen::MatrixXd squares = derivative * derivative.transpose();
  const std::complex<double> i(0, 1);
  Eigen::MatrixXcd energy(3 * functions, 3 * functions), load(3 * functions, 3);
  for (int a = 0; a < functions; ++a) {
    load.middleRows(3 * a, 3).setIdentity();
    for (int b = 0; b < functions; ++b) {
      const double one = a == b;
      energy.block(3 * a, 3 * b, 3, 3) =
          (one * q + squares(a, b) * t).cast<std::complex<double>>() +
          i * (derivative(a, b) * r.transpose() - derivative(b, a) * r)
                  .cast<std::complex<double>>();
    }
  }
  return (load.transpose() * energy.partialPivLu().solve(load)).real();
}

// Re(iAB⁻¹) from the eigenvectors of Stroh's matrix, for a material without double eigenvalues.
Matrix3 stroh(const AnisotropicStiffness& stiffness, double direction) {
  const Eigen::Vector3d along(std::cos(direction), std::sin(direction), 0), normal(0, 0, 1);
  const Matrix3 q = product(stiffness, along, along), r = product(stiffness, along, normal),
                t = product(stiffness, normal, normal);
  const double scale = t.norm();
  Matrix6 matrix;
  const Matrix3 inverse = t.inverse();
  matrix << -inverse * r.transpose(), inverse * scale, (r * inverse * r.transpose() - q) / scale,
      -r * inverse;
  const Eigen::EigenSolver<Matrix6> solver(matrix);
  Eigen::Matrix3cd a, b;
  int found = 0;
  for (int k = 0; k < 6; ++k)
    if (solver.eigenvalues()(k).imag() > 0) {
      a.col(found) = solver.eigenvectors().col(k).head(3);
      b.col(found++) = solver.eigenvectors().col(k).tail(3) * scale;
    }
  REQUIRE(found == 3);
  return (std::complex<double>(0, 1) * a * b.inverse()).real();
}

void check_elements(const SurfaceCompliance& found, const std::array<double, 4>& expected,
                    double tolerance) {
  CHECK(found.normal == Approx(expected[0]).epsilon(tolerance));
  CHECK(found.in_plane == Approx(expected[1]).epsilon(tolerance));
  CHECK(found.across == Approx(expected[2]).epsilon(tolerance));
  CHECK(std::abs(found.mixed - expected[3]) <= tolerance * expected[0]);
  CHECK(std::isnan(found.coupling));
}

}  // namespace

TEST_CASE("An anisotropic half-space has the response of Stroh's eigenvectors and of a column",
          "[body]") {
  const auto silicon = AnisotropicStiffness::cubic(166e9, 64e9, 80e9);
  const auto which = GENERATE(0, 1, 2);
  const AnisotropicStiffness stiffness =
      which == 0
          ? triclinic()
          : silicon.of_surface(which == 1 ? std::array{1., 1., 0.} : std::array{1., 2., 3.},
                               which == 1 ? std::array{1., -1., 2.} : std::array{3., 0., -1.});
  const Body body = Body::anisotropic(stiffness);
  for (int k = 0; k < 20; ++k) {
    const double direction = 0.1 + pi * k / 20;
    CAPTURE(which, direction);
    const SurfaceCompliance found = body.compliance(std::cos(direction), std::sin(direction));
    // Eigenvectors lose a few digits; the functions of Laguerre converge slowly for steep waves.
    check_elements(found, elements(stroh(stiffness, direction), direction), 1e-11);
    check_elements(found, elements(column(stiffness, direction), direction), 1e-8);
    CHECK(found.normal > 0);
    // Opposite waves respond alike, and short ones stiffly.
    const SurfaceCompliance opposite =
        body.compliance(-2 * std::cos(direction), -2 * std::sin(direction));
    CHECK(opposite.normal == Approx(found.normal / 2).epsilon(1e-14));
    CHECK(opposite.mixed == Approx(found.mixed / 2).epsilon(1e-12).margin(1e-14 * found.normal));
  }
}

TEST_CASE("Materials with planes of symmetry have their closed forms", "[body]") {
  SECTION("isotropic: double eigenvalues") {
    const double poisson = GENERATE(-0.5, 0.0, 0.3, 0.4999), young = 210e9;
    const double shear = young / (2 * (1 + poisson)),
                 lame = 2 * shear * poisson / (1 - 2 * poisson);
    const Body body = Body::anisotropic(AnisotropicStiffness::cubic(lame + 2 * shear, lame, shear)
                                            .of_surface({1, 2, 3}, {2, -1, 0}));
    const Body expected = Body::half_space({young, poisson});
    // Near incompressibility the stiffnesses themselves carry an error of 1e-16·λ/µ.
    const double tolerance = poisson > 0.49 ? 1e-10 : 1e-13;
    for (const double direction : {0.0, 0.7, 2.0}) {
      const SurfaceCompliance half = expected.compliance(3e5);
      check_elements(body.compliance(3e5 * std::cos(direction), 3e5 * std::sin(direction)),
                     {half.normal, half.in_plane, half.across, 0}, tolerance);
    }
    CHECK(body.compliance(3e5).normal ==
          Approx(expected.compliance(3e5).normal).epsilon(tolerance));
  }
  SECTION("transversely isotropic about the normal") {
    const TransverseStiffness c = GENERATE(TransverseStiffness{16.1, 6.1, 5.0, 3.83, 6.34},
                                           TransverseStiffness{1.2, 9.0, 0.5, 0.4, 0.35});
    const double c12 = c.c11 - 2 * c.c66;
    Matrix6 matrix = Matrix6::Zero();
    matrix.topLeftCorner(3, 3) << c.c11, c12, c.c13, c12, c.c11, c.c13, c.c13, c.c13, c.c33;
    matrix.diagonal().tail(3) << c.c44, c.c44, c.c66;
    const SurfaceCompliance expected = Body::transversely_isotropic(c).compliance(2);
    const SurfaceCompliance found =
        Body::anisotropic(stiffness_of(matrix)).compliance(2 * std::cos(1), 2 * std::sin(1));
    check_elements(found, {expected.normal, expected.in_plane, expected.across, 0}, 1e-12);
  }
  SECTION("orthotropic, waves along its axes") {
    Matrix6 wood = Matrix6::Zero();
    wood.topLeftCorner(3, 3) << 10, 0.5, 0.6, 0.5, 0.6, 0.4, 0.6, 0.4, 1.1;
    wood.diagonal().tail(3) << 0.04, 0.8, 0.7;
    const Body body = Body::anisotropic(stiffness_of(wood));
    for (const int axis : {0, 1}) {
      const double c11 = wood(axis, axis), c33 = wood(2, 2), c13 = wood(axis, 2),
                   c55 = wood(4 - axis, 4 - axis), c44 = wood(3 + axis, 3 + axis), c66 = wood(5, 5);
      const double root = std::sqrt(c11 * c33);
      const double normal =
          1 / ((c13 + root) * std::sqrt(c55 * (root - c13) / (c11 * (c13 + 2 * c55 + root))));
      check_elements(body.compliance(1 - axis, axis),
                     {normal, normal * std::sqrt(c33 / c11), 1 / std::sqrt(c44 * c66), 0}, 1e-12);
    }
  }
}

TEST_CASE("A turned surface has a turned response, and the mean of its directions", "[body]") {
  const AnisotropicStiffness stiffness = triclinic();
  const Body body = Body::anisotropic(stiffness);
  const double turn = 0.4;
  const Body turned =
      Body::anisotropic(stiffness.of_surface({0, 0, 2}, {std::cos(turn), std::sin(turn), 0}));
  double sum = 0;
  constexpr int directions = 200;
  for (int k = 0; k < directions; ++k) {
    const double direction = pi * k / directions;
    const SurfaceCompliance here =
        body.compliance(std::cos(direction + turn), std::sin(direction + turn));
    check_elements(turned.compliance(std::cos(direction), std::sin(direction)),
                   {here.normal, here.in_plane, here.across, here.mixed}, 1e-12);
    sum += here.normal / directions;
  }
  CHECK(body.compliance(1).normal == Approx(sum).epsilon(1e-12));
  CHECK(body.is_directional());
  CHECK(Body::pair(Body::layered({{1, 1e9, 0.3}}, {1e9, 0.3}), body).is_directional());
  CHECK_FALSE(Body::half_space({1e9, 0.3}).is_directional());
  CHECK(body.fingerprint() != turned.fingerprint());
  CHECK(body.fingerprint() == Body::anisotropic(stiffness).fingerprint());
}

TEST_CASE("Stiffnesses that no material has are refused", "[body]") {
  using Catch::Contains;
  AnisotropicStiffness skew = AnisotropicStiffness::cubic(166e9, 64e9, 80e9);
  skew.c[0][4] = 1e9;
  CHECK_THROWS_WITH(Body::anisotropic(skew), Contains("stiffness") && Contains("symmetric"));
  CHECK_THROWS_WITH(Body::anisotropic(AnisotropicStiffness::cubic(60e9, 64e9, 80e9)),
                    Contains("stiffness") && Contains("positive definite"));
  CHECK_THROWS_WITH(Body::anisotropic(AnisotropicStiffness::cubic(166e9, NAN, 80e9)),
                    Contains("finite"));
  const auto silicon = AnisotropicStiffness::cubic(166e9, 64e9, 80e9);
  CHECK_THROWS_WITH(silicon.of_surface({0, 0, 1}, {1, 0, 1}),
                    Contains("x") && Contains("perpendicular"));
  CHECK_THROWS_WITH(silicon.of_surface({0, 0, 0}, {1, 0, 0}), Contains("normal"));
}
