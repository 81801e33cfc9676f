// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <vector>

using namespace salebra;

namespace {

// x = qt from thin to thick, twenty values.
std::vector<double> twenty_depths() {
  std::vector<double> depths;
  for (int k = 0; k < 20; ++k) depths.push_back(1e-3 * std::pow(20000.0, k / 19.0));
  return depths;
}

void check_equal(const SurfaceCompliance& found, const SurfaceCompliance& expected,
                 double tolerance) {
  CHECK(found.normal == Approx(expected.normal).epsilon(tolerance));
  CHECK(found.in_plane == Approx(expected.in_plane).epsilon(tolerance));
  CHECK(found.across == Approx(expected.across).epsilon(tolerance));
  // The coupling changes sign, so it is compared with the size of the whole response.
  CHECK(std::abs(found.coupling - expected.coupling) <= tolerance * expected.in_plane);
}

// Moduli of a body at a depth: those of a transversely isotropic material, where c13 = λ is infinite
// for an incompressible one. The pressure λ(W' − qU) is therefore an unknown of its own.
struct Moduli {
  double c11_less_c13, c33_less_c13, c44, c66, inverse_c13;
};
Moduli isotropic(double young, double poisson) {
  const double shear = young / (2 * (1 + poisson));
  return {2 * shear, 2 * shear, shear, shear, (1 - 2 * poisson) / (2 * poisson * shear)};
}

// A column of finite elements: waves along the surface, polynomials of degree 8 over the depth, zero
// displacement at the bottom. The compliance is an energy, whose error is the square of that of the
// displacement. The matrix elements of exp(iqx) loads are real for u_x = iU, u_z = W.
class Column {
 public:
  Column(std::vector<double> nodes, std::function<Moduli(double depth)> moduli)
      : nodes_(std::move(nodes)), moduli_(std::move(moduli)) {}

  SurfaceCompliance compliance(double q) const {
    const int elements = static_cast<int>(nodes_.size()) - 1;
    const int points = elements * degree + 1;
    const int pressures = elements * degree;
    // Order of the unknowns: U and W at the points, then the pressures; V is a problem of its own.
    Eigen::MatrixXd plane = Eigen::MatrixXd::Zero(2 * points + pressures, 2 * points + pressures);
    Eigen::MatrixXd antiplane = Eigen::MatrixXd::Zero(points, points);
    for (int e = 0; e < elements; ++e) {
      const double from = nodes_[static_cast<std::size_t>(e)];
      const double h = nodes_[static_cast<std::size_t>(e) + 1] - from;
      for (const auto& [s, weight] : gauss()) {
        const Moduli m = moduli_(from + h * (s + 1) / 2);
        const double w = weight * h / 2;
        for (int i = 0; i <= degree; ++i) {
          const int ui = 2 * (e * degree + i), wi = ui + 1;
          const double ni = value(i, s), di = slope(i, s) * 2 / h;
          for (int j = 0; j <= degree; ++j) {
            const int uj = 2 * (e * degree + j), wj = uj + 1;
            const double nj = value(j, s), dj = slope(j, s) * 2 / h;
            plane(ui, uj) += w * (m.c11_less_c13 * q * q * ni * nj + m.c44 * di * dj);
            plane(wi, wj) += w * (m.c33_less_c13 * di * dj + m.c44 * q * q * ni * nj);
            plane(ui, wj) += w * m.c44 * q * di * nj;
            plane(wi, uj) += w * m.c44 * q * ni * dj;
            antiplane(ui / 2, uj / 2) += w * (m.c44 * di * dj + m.c66 * q * q * ni * nj);
          }
          for (int k = 0; k < degree; ++k) {
            const int p = 2 * points + e * degree + k;
            const double legendre = std::legendre(static_cast<unsigned>(k), s);
            for (const auto& [row, strain] : {std::pair(wi, di), {ui, -q * ni}}) {
              plane(row, p) += w * strain * legendre;
              plane(p, row) += w * strain * legendre;
            }
          }
        }
        for (int k = 0; k < degree; ++k)
          for (int l = 0; l < degree; ++l)
            plane(2 * points + e * degree + k, 2 * points + e * degree + l) -=
                w * m.inverse_c13 * std::legendre(static_cast<unsigned>(k), s) *
                std::legendre(static_cast<unsigned>(l), s);
      }
    }
    for (const int held : {2 * points - 2, 2 * points - 1}) {
      plane.row(held).setZero();
      plane.col(held).setZero();
      plane(held, held) = 1;
    }
    antiplane.row(points - 1).setZero();
    antiplane.col(points - 1).setZero();
    antiplane(points - 1, points - 1) = 1;
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(plane.rows(), 2);
    loads(0, 0) = loads(1, 1) = 1;
    const Eigen::MatrixXd moved = plane.partialPivLu().solve(loads);
    const Eigen::VectorXd load = Eigen::VectorXd::Unit(points, 0);
    return {moved(1, 1), moved(0, 0), antiplane.partialPivLu().solve(load)(0), moved(1, 0)};
  }

 private:
  static constexpr int degree = 8;
  static double node(int i) { return -std::cos(std::numbers::pi * i / degree); }
  static double value(int i, double s) {
    double product = 1;
    for (int k = 0; k <= degree; ++k)
      if (k != i) product *= (s - node(k)) / (node(i) - node(k));
    return product;
  }
  static double slope(int i, double s) {
    double sum = 0;
    for (int l = 0; l <= degree; ++l) {
      if (l == i) continue;
      double product = 1 / (node(i) - node(l));
      for (int k = 0; k <= degree; ++k)
        if (k != i && k != l) product *= (s - node(k)) / (node(i) - node(k));
      sum += product;
    }
    return sum;
  }
  // Gauss points and weights for twelve points, by Newton's method.
  static std::vector<std::pair<double, double>> gauss() {
    constexpr unsigned n = 12;
    std::vector<std::pair<double, double>> rule;
    for (unsigned k = 0; k < n; ++k) {
      double s = std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)), derivative = 1;
      for (int step = 0; step < 6; ++step) {
        derivative = n * (s * std::legendre(n, s) - std::legendre(n - 1, s)) / (s * s - 1);
        s -= std::legendre(n, s) / derivative;
      }
      rule.emplace_back(s, 2 / ((1 - s * s) * derivative * derivative));
    }
    return rule;
  }

  std::vector<double> nodes_;
  std::function<Moduli(double)> moduli_;
};

// Nodes of elements that end at the given interfaces and are at most `longest` long, down to the
// depth `bottom`.
std::vector<double> nodes_to(double bottom, double longest, std::vector<double> interfaces) {
  interfaces.push_back(bottom);
  std::vector<double> nodes = {0};
  for (const double end : interfaces) {
    const double from = nodes.back();
    const int parts = static_cast<int>(std::ceil((end - from) / longest));
    for (int k = 1; k <= parts; ++k) nodes.push_back(from + (end - from) * k / parts);
  }
  return nodes;
}

}  // namespace

TEST_CASE("A layer on a rigid base has the response of Bentall and Johnson", "[body]") {
  const double young = 3e6, thickness = 5e-6;
  const double poisson = GENERATE(-0.3, 0.0, 0.25, 0.4999, 0.5);
  const long double shear = young / (2 * (1 + poisson)), nu = poisson, k = 3 - 4 * nu;
  const Body layer = Body::layered({{thickness, young, poisson}});
  for (const double x : twenty_depths()) {
    const double q = x / thickness;
    // In long double: at x = 0.001 and ν = ½ these formulas lose six digits.
    const long double s = std::sinh(2.0L * x), c = std::cosh(2.0L * x), y = 2.0L * x;
    const long double bracket = k * c + y * y / 2 + 5 - 12 * nu + 8 * nu * nu;
    const long double unit = 1 / (shear * q);
    check_equal(layer.compliance(q),
                {double((1 - nu) * unit * (k * s - y) / bracket),
                 double((1 - nu) * unit * (k * s + y) / bracket), double(unit * std::tanh(y / 2)),
                 double(unit / 2 * ((1 - 2 * nu) * k * (c - 1) - y * y / 2) / bracket)},
                1e-12);
  }
}

TEST_CASE("A layer on a half-space has the response of O'Sullivan and King", "[body]") {
  const double thickness = 2e-6, upper_poisson = GENERATE(0.2, 0.5);
  const double ratio = GENERATE(1e-3, 0.3, 5.0, 1e3);  // of the shear moduli
  const ElasticBody base{70e9, 0.33};
  const double shear = ratio * base.shear();
  const Body body =
      Body::layered({{thickness, 2 * shear * (1 + upper_poisson), upper_poisson}}, base);
  const long double nu = upper_poisson, g = ratio;
  const long double lambda = 1 - 4 * (1 - nu) / (1 + g * (3 - 4 * 0.33L));
  const long double k = (g - 1) / (g + 3 - 4 * nu), r = (g - 1) / (g + 1);
  for (const double x : twenty_depths()) {
    const double q = x / thickness;
    const long double e = std::exp(-2.0L * x), unit = 1 / (static_cast<long double>(shear) * q);
    const auto along = [&](int sign) {
      return double((1 - nu) * unit * (1 + sign * 4 * k * x * e - lambda * k * e * e) /
                    (1 - (lambda + k + 4 * k * x * x) * e + lambda * k * e * e));
    };
    const SurfaceCompliance found = body.compliance(q);
    CHECK(found.normal == Approx(along(1)).epsilon(1e-12));
    CHECK(found.in_plane == Approx(along(-1)).epsilon(1e-12));
    CHECK(found.across == Approx(double(unit * (1 + r * e) / (1 - r * e))).epsilon(1e-12));
  }
}

TEST_CASE("Layers tend to a half-space where they are thin, thick or of its material", "[body]") {
  const ElasticBody base{70e9, 0.33}, coating{210e9, 0.28};
  const double q = 1e6;
  const SurfaceCompliance of_base = Body::half_space(base).compliance(q),
                          of_coating = Body::half_space(coating).compliance(q);
  // The response of a thin layer differs by a term of order x = 1e-9.
  check_equal(Body::layered({{1e-15, coating.young, coating.poisson}}, base).compliance(q), of_base,
              1e-8);
  for (const double thickness : {24e-6, 26e-6, 1.0})
    check_equal(Body::layered({{thickness, coating.young, coating.poisson}}, base).compliance(q),
                of_coating, 1e-12);
  const std::vector<ElasticLayer> same(4, {0.7e-6, base.young, base.poisson});
  check_equal(Body::layered(same, base).compliance(q), of_base, 1e-13);
  // One layer in three parts.
  check_equal(
      Body::layered({{0.2e-6, 3e9, 0.4}, {0.5e-6, 3e9, 0.4}, {0.3e-6, 3e9, 0.4}}).compliance(q),
      Body::layered({{1e-6, 3e9, 0.4}}).compliance(q), 1e-13);
}

TEST_CASE("Responses agree with a column of finite elements", "[body]") {
  const double q = 1;
  SECTION("two layers on a half-space, the upper one nearly incompressible or incompressible") {
    const double poisson = GENERATE(0.49, 0.5);
    const double upper = GENERATE(0.02, 0.3, 2.0);
    const Column column(nodes_to(40, 3, {upper, upper + 0.5}), [=](double z) {
      return z < upper         ? isotropic(1, poisson)
             : z < upper + 0.5 ? isotropic(40, 0.2)
                               : isotropic(7, 0.3);
    });
    // Elements of 3/q with degree 8: the displacement is right to 1e-5, its square to 1e-9.
    check_equal(Body::layered({{upper, 1, poisson}, {0.5, 40, 0.2}}, {7, 0.3}).compliance(q),
                column.compliance(q), 1e-8);
  }
  SECTION("a stack on a rigid base") {
    const double scale = GENERATE(0.01, 1.0, 5.0);
    const Column column(nodes_to(2 * scale, 1, {scale}), [=](double z) {
      return z < scale ? isotropic(1, 0.5) : isotropic(0.1, 0.45);
    });
    check_equal(Body::layered({{scale, 1, 0.5}, {scale, 0.1, 0.45}}).compliance(q),
                column.compliance(q), 1e-8);
  }
  SECTION("transversely isotropic: zinc and a composite") {
    const TransverseStiffness c = GENERATE(TransverseStiffness{16.1, 6.1, 5.0, 3.83, 6.34},
                                           TransverseStiffness{1.2, 9.0, 0.5, 0.4, 0.35});
    const Column column(nodes_to(120, 3, {}), [=](double) {
      return Moduli{c.c11 - c.c13, c.c33 - c.c13, c.c44, c.c66, 1 / c.c13};
    });
    check_equal(Body::transversely_isotropic(c).compliance(q), column.compliance(q), 1e-8);
  }
  SECTION("graded") {
    const GradedHalfSpace body =
        GENERATE(GradedHalfSpace{3, 2, 0.5, 0.3}, GradedHalfSpace{3, 2, 0.25, 0.5},
                 GradedHalfSpace{3, 2, 0.4, 0.1});
    std::vector<double> nodes = {0};
    // The displacement is smooth in ln z. The first element changes it by a small part of z^(1−k),
    // 1e-6, and the inverse of this is about the condition number of the matrix.
    for (double z = std::pow(1e-6, 1 / (1 - body.exponent)); z < 2; z *= 4) nodes.push_back(z);
    for (double z = std::max(3.0, nodes.back() + 1); z < 40; z += 2) nodes.push_back(z);
    const Column column(nodes, [=](double z) {
      return isotropic(body.modulus * std::pow(z / body.depth, body.exponent), body.poisson);
    });
    const SurfaceCompliance found = Body::graded(body).compliance(q),
                            expected = column.compliance(q);
    CHECK(found.normal == Approx(expected.normal).epsilon(1e-6));
    CHECK(found.in_plane == Approx(expected.in_plane).epsilon(1e-6));
    CHECK(found.across == Approx(expected.across).epsilon(1e-6));
    CHECK(std::isnan(found.coupling));
  }
}

TEST_CASE("A layer measured from its rigid base has a finite response to a uniform load",
          "[body]") {
  const double thickness = 1e-3, young = 5e6, poisson = 0.4;
  const Body layer =
      Body::layered({{thickness, young, poisson}, {2 * thickness, 2 * young, poisson}});
  CHECK(layer.datum() == Datum::mean_plane);
  CHECK(layer.compliance(0).normal == 0);
  const Body from_base = layer.measured_from(Datum::base);
  const double shear = young / (2 * (1 + poisson));
  const SurfaceCompliance uniform = from_base.compliance(0);
  // Uniaxial strain and simple shear of two layers, of which the lower is twice as thick and stiff.
  CHECK(uniform.normal == Approx(2 * thickness * (1 - 2 * poisson) / (2 * shear * (1 - poisson))));
  CHECK(uniform.in_plane == Approx(2 * thickness / shear));
  // The limit of long waves; the next term is of order x² = 1e-8.
  const SurfaceCompliance long_wave = layer.compliance(1e-4 / thickness);
  CHECK(long_wave.normal == Approx(uniform.normal).epsilon(1e-6));
  CHECK(long_wave.in_plane == Approx(uniform.in_plane).epsilon(1e-6));
  CHECK(long_wave.across == Approx(uniform.across).epsilon(1e-6));
  CHECK(from_base.compliance(1e3).normal == layer.compliance(1e3).normal);
  CHECK(from_base.measured_from(Datum::mean_plane).compliance(0).normal == 0);
}

TEST_CASE("Bodies have the isotropic half-space as a limit, and two of them add", "[body]") {
  const double young = 210e9, poisson = 0.3, q = 3e5;
  const ElasticBody steel{young, poisson}, rubber{1e7, 0.45};
  const Body half_space = Body::half_space(steel);
  const SurfaceCompliance expected = half_space.compliance(q);
  CHECK(expected.normal ==
        Approx(2 / (Material::of_bodies(steel).contact_modulus * q)).epsilon(1e-15));
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), shear = steel.shear();
  check_equal(Body::transversely_isotropic({lame + 2 * shear, lame + 2 * shear, lame, shear, shear})
                  .compliance(q),
              expected, 1e-14);
  const SurfaceCompliance graded = Body::graded({young, 1e-6, 0, poisson}).compliance(q);
  CHECK(graded.normal == Approx(expected.normal).epsilon(1e-14));
  CHECK(graded.in_plane == Approx(expected.in_plane).epsilon(1e-14));
  CHECK(graded.across == Approx(expected.across).epsilon(1e-14));
  check_equal(Body::pair(half_space, Body::half_space(rubber)).compliance(q),
              Body::half_space(steel, rubber).compliance(q), 1e-14);
  CHECK(Body::half_space(steel, rubber).half_space_material()->contact_modulus ==
        Material::of_bodies(steel, rubber).contact_modulus);
  CHECK_FALSE(Body::layered({{1e-6, 1e9, 0.3}}).half_space_material());
}

TEST_CASE("A table of a response reproduces powers, and layers to the fourth power of its spacing",
          "[body]") {
  const Body layer = Body::layered({{1e-6, 1e9, 0.3}}, {200e9, 0.3});
  const auto table_of = [&](int points) {
    ComplianceTable table;
    for (int k = 0; k < points; ++k) {
      const double q = 1e4 * std::pow(1e4, k / (points - 1.0));
      const SurfaceCompliance c = layer.compliance(q);
      table.wavenumber.push_back(q);
      table.normal.push_back(c.normal);
      table.in_plane.push_back(c.in_plane);
      table.across.push_back(c.across);
    }
    return table;
  };
  const auto error_of = [&](int points) {
    const Body table = Body::tabulated(table_of(points));
    double error = 0;
    for (double q = 1.001e4; q < 1e8; q *= 1.013)
      error =
          std::max(error, std::abs(table.compliance(q).normal / layer.compliance(q).normal - 1));
    return error;
  };
  CHECK(error_of(801) < 1e-6);
  CHECK(std::log2(error_of(401) / error_of(801)) > 3);
  ComplianceTable power{.wavenumber = {1, 2, 5, 10}, .normal = {}};
  for (const double q : power.wavenumber) power.normal.push_back(3 * std::pow(q, -0.7));
  const Body normal_only = Body::tabulated(power);
  CHECK(normal_only.compliance(3).normal == Approx(3 * std::pow(3, -0.7)).epsilon(1e-14));
  CHECK_FALSE(normal_only.has_tangential_response());
  CHECK_THROWS_WITH(normal_only.compliance(11),
                    Catch::Contains("wavenumber") && Catch::Contains("beyond the table"));
}

TEST_CASE("Bad constants of a body are refused by name", "[body]") {
  using Catch::Contains;
  CHECK_THROWS_WITH(Body::layered({}), Contains("layers"));
  CHECK_THROWS_WITH(Body::layered({{0, 1e9, 0.3}}), Contains("thickness"));
  CHECK_THROWS_WITH(Body::layered({{1e-6, INFINITY, 0.3}}), Contains("young"));
  CHECK_THROWS_WITH(Body::layered({{1e-6, 1e9, 0.6}}), Contains("poisson"));
  CHECK_THROWS_WITH(Body::layered({{1e-6, 1e9, 0.3}}, {1e9, -1}), Contains("poisson"));
  CHECK_THROWS_WITH(Body::graded({1e9, 1e-6, 1, 0.3}), Contains("exponent"));
  CHECK_THROWS_WITH(Body::graded({1e9, 1e-6, -0.1, 0.3}), Contains("exponent"));
  CHECK_THROWS_WITH(Body::transversely_isotropic({10, 10, 9, 3, 3}), Contains("c13"));
  CHECK_THROWS_WITH(Body::transversely_isotropic({10, 10, 3, 3, 11}), Contains("c66"));
  CHECK_THROWS_WITH(Body::tabulated({.wavenumber = {1, 2, 2, 3}, .normal = {1, 1, 1, 1}}),
                    Contains("wavenumber"));
  CHECK_THROWS_WITH(Body::tabulated({.wavenumber = {1, 2, 3, 4}, .normal = {1, 1, 1}}),
                    Contains("normal"));
  const Body half_space = Body::half_space({1e9, 0.3});
  CHECK_THROWS_WITH(half_space.measured_from(Datum::base), Contains("datum"));
  const Body layer = Body::layered({{1e-6, 1e9, 0.3}});
  CHECK_THROWS_WITH(Body::pair(layer.measured_from(Datum::base), layer), Contains("datum"));
  CHECK_THROWS_WITH(Body::pair(half_space, layer).measured_from(Datum::base), Contains("datum"));
}
