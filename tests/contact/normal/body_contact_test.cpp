// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <vector>

#include "ranks_in_threads.hpp"
#include "rough_surface.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

// Influence of a loaded cell on another, a sum over all wave vectors of the grid without a Fourier
// transform. A wave at a Nyquist frequency is its own mirror image.
class Influence {
 public:
  Influence(const Grid2D& grid, const Body& body) : grid_(grid) {
    normal_ = xx_ = yy_ = xy_ = Field::Zero(grid.nx, grid.ny);
    for (Index m = 0; m < grid.nx; ++m)
      for (Index n = 0; n < grid.ny; ++n) {
        const Index i = 2 * m > grid.nx ? m - grid.nx : m, j = 2 * n > grid.ny ? n - grid.ny : n;
        const double qx = 2 * pi * double(i) / grid.lx, qy = 2 * pi * double(j) / grid.ly;
        const bool mirrored = 2 * m == grid.nx || 2 * n == grid.ny;
        const Eigen::Vector4d c =
            mirrored ? ((response(body, qx, qy) + response(body, -qx, qy)) / 2).eval()
                     : response(body, qx, qy);
        for (Index a = 0; a < grid.nx; ++a)
          for (Index b = 0; b < grid.ny; ++b) {
            const double wave = std::cos(2 * pi *
                                         (double(m * a % grid.nx) / double(grid.nx) +
                                          double(n * b % grid.ny) / double(grid.ny))) /
                                static_cast<double>(grid.points());
            normal_(a, b) += c(0) * wave;
            xx_(a, b) += c(1) * wave;
            yy_(a, b) += c(2) * wave;
            xy_(a, b) += c(3) * wave;
          }
      }
  }

  Eigen::MatrixXd normal(const std::vector<Index>& cells) const { return matrix(cells, normal_); }
  Eigen::MatrixXd tangential(const std::vector<Index>& cells) const {
    const auto n = static_cast<Index>(cells.size());
    Eigen::MatrixXd all(2 * n, 2 * n);
    all << matrix(cells, xx_), matrix(cells, xy_), matrix(cells, xy_), matrix(cells, yy_);
    return all;
  }

 private:
  // Normal, and tangential xx, yy and xy.
  static Eigen::Vector4d response(const Body& body, double qx, double qy) {
    const SurfaceCompliance c = body.compliance(qx, qy);
    const double square = qx * qx + qy * qy;
    if (square == 0) return {c.normal, c.in_plane, c.in_plane, 0};
    const double length = std::sqrt(square);
    const Eigen::Vector2d along(qx / length, qy / length), across(-along.y(), along.x());
    const Eigen::Matrix2d t = c.in_plane * along * along.transpose() +
                              c.across * across * across.transpose() +
                              c.mixed * (along * across.transpose() + across * along.transpose());
    return {c.normal, t(0, 0), t(1, 1), t(0, 1)};
  }
  Eigen::MatrixXd matrix(const std::vector<Index>& cells, const Field& kernel) const {
    const auto n = static_cast<Index>(cells.size());
    Eigen::MatrixXd result(n, n);
    for (Index k = 0; k < n; ++k)
      for (Index l = 0; l < n; ++l) {
        const Index from = cells[std::size_t(k)], to = cells[std::size_t(l)];
        const Index a = std::abs(from / grid_.ny - to / grid_.ny),
                    b = from % grid_.ny - to % grid_.ny;
        const Index signed_b = from / grid_.ny < to / grid_.ny ? -b : b;
        result(k, l) = kernel(a, (signed_b + grid_.ny) % grid_.ny);
      }
    return result;
  }
  Grid2D grid_;
  Field normal_, xx_, yy_, xy_;
};

std::vector<Index> cells_of(const ContactSet& contact) {
  std::vector<Index> cells;
  for (Index k = 0; k < contact.size(); ++k)
    if (contact.data()[k]) cells.push_back(k);
  return cells;
}

struct DenseContact {
  Field pressure;
  double plane_height = 0;
};

// The contact at a mean pressure: the set of cells changes until direct solves on it leave no
// tension in it and no overlap outside it.
DenseContact dense_contact(const Surface& surface, const Eigen::MatrixXd& influence, double mean) {
  const Index points = surface.grid.points();
  const Eigen::Map<const Eigen::VectorXd> heights(surface.heights.data(), points);
  std::vector<bool> touches(std::size_t(points), true);
  for (int step = 0; step < 200; ++step) {
    std::vector<Index> cells;
    for (Index k = 0; k < points; ++k)
      if (touches[std::size_t(k)]) cells.push_back(k);
    const auto n = static_cast<Index>(cells.size());
    // Unknowns: pressures and the height λ of the plane; Gp − λ = h on the cells, Σp given.
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
    Eigen::VectorXd right(n + 1);
    const double unit = influence(0, 0);
    for (Index k = 0; k < n; ++k) {
      for (Index l = 0; l < n; ++l)
        system(k, l) = influence(cells[std::size_t(k)], cells[std::size_t(l)]) / unit;
      system(k, n) = system(n, k) = -1;
      right(k) = heights(cells[std::size_t(k)]);
    }
    right(n) = -mean * double(points) * unit;
    const Eigen::VectorXd solution = system.partialPivLu().solve(right);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(points);
    for (Index k = 0; k < n; ++k) p(cells[std::size_t(k)]) = solution(k) / unit;
    const Eigen::VectorXd gap = (influence * p - heights).array() - solution(n);
    bool changed = false;
    for (Index k = 0; k < points; ++k) {
      const bool stays = touches[std::size_t(k)] ? p(k) > 0 : gap(k) < 0;
      changed = changed || stays != touches[std::size_t(k)];
      touches[std::size_t(k)] = stays;
    }
    if (!changed) {
      DenseContact found{Field(surface.grid.nx, surface.grid.ny), solution(n)};
      std::copy_n(p.data(), points, found.pressure.data());
      return found;
    }
  }
  FAIL("the set of the dense contact does not settle");
  return {};
}

std::vector<Index> all_cells(const Grid2D& grid) {
  return cells_of(ContactSet::Constant(grid.nx, grid.ny, true));
}

// A rubber film and a stiff coating with cells of 1 µm, a graded body, zinc, sodium cut and turned
// askew, and wood on a film.
const double cell = 1e-6;
std::vector<Body> bodies() {
  const Body zinc = Body::transversely_isotropic({161e9, 61e9, 50e9, 38.3e9, 63.4e9});
  const auto sodium = AnisotropicStiffness::cubic(7.4e9, 6.2e9, 4.2e9);
  const auto wood = AnisotropicStiffness{{{{10e9, 0.5e9, 0.6e9, 0, 0, 0},
                                           {0.5e9, 0.6e9, 0.4e9, 0, 0, 0},
                                           {0.6e9, 0.4e9, 1.1e9, 0, 0, 0},
                                           {0, 0, 0, 0.04e9, 0, 0},
                                           {0, 0, 0, 0, 0.8e9, 0},
                                           {0, 0, 0, 0, 0, 0.7e9}}}}
                        .of_surface({0, 0, 1}, {3, 1, 0});
  return {Body::layered({{4 * cell, 3e9, 0.49}}),
          Body::layered({{0.5 * cell, 3e9, 0.5}, {2 * cell, 1e9, 0.4}}),
          Body::layered({{2 * cell, 600e9, 0.2}}, {70e9, 0.33}),
          Body::graded({3e9, 10 * cell, 0.5, 0.3}),
          Body::pair(Body::layered({{cell, 3e9, 0.4}}, {70e9, 0.33}), zinc),
          Body::anisotropic(sodium.of_surface({1, 1, 1}, {1, 2, -3})),
          Body::pair(Body::layered({{cell, 3e9, 0.4}}, {70e9, 0.33}), Body::anisotropic(wood))};
}

}  // namespace

TEST_CASE(
    "Contacts on layers, graded and anisotropic bodies equal direct solves with a dense matrix",
    "[body]") {
  const Grid2D grid{32, 24, 32 * cell, 24 * cell};
  const Surface surface = test::rough_surface(grid, {.rolloff = 2, .seed = 5});
  const auto which = GENERATE(0u, 1u, 2u, 3u, 4u, 5u, 6u);
  CAPTURE(which);
  const Body body = bodies()[which];
  const Influence influence(grid, body);
  const double modulus = 2 / (pi / cell * body.compliance(pi / cell).normal);
  const double mean = 0.01 * modulus;
  const DenseContact expected = dense_contact(surface, influence.normal(all_cells(grid)), mean);

  NormalContactOptions options;
  options.tolerance = 1e-14;
  options.precision = GENERATE(Precision::mixed, Precision::full);
  const NormalContactState state = press(surface, body, at_pressure(mean), options);
  REQUIRE(state.converged());
  CHECK(state.contact_area_fraction > 0.05);
  CHECK(state.contact_area_fraction < 0.8);
  // A residual of 1e-14 leaves errors of the pressure of the order of its root, 1e-7, at worst; CG
  // on a settled set does much better.
  CHECK((state.contact_pressure - expected.pressure).abs().maxCoeff() <
        1e-9 * expected.pressure.maxCoeff());
  CHECK((contact_set(state) == (expected.pressure > 0)).all());
  // The result counts from the highest point, the reference from height zero.
  CHECK(state.indentation ==
        Approx(expected.plane_height + surface.heights.maxCoeff()).epsilon(1e-9));

  const std::vector<Index> cells = cells_of(contact_set(state));
  const auto count = static_cast<Index>(cells.size());
  const double stiffness =
      influence.normal(cells).llt().solve(Eigen::VectorXd::Ones(count)).sum() * grid.cell_area();
  CHECK(normal_stiffness(state, grid, body, options) == Approx(stiffness).epsilon(1e-9));

  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(2 * count, 2);
  motions.col(0).head(count).setOnes();
  motions.col(1).tail(count).setOnes();
  const Eigen::MatrixXd forces =
      motions.transpose() * influence.tangential(cells).llt().solve(motions) * grid.cell_area();
  const StickOptions stick{.tolerance = 1e-8};
  const StickStiffness found = stick_stiffness(contact_set(state), grid, body, stick);
  REQUIRE(found.converged());
  CHECK(found.xx == Approx(forces(0, 0)).epsilon(1e-9));
  CHECK(found.yy == Approx(forces(1, 1)).epsilon(1e-9));
  CHECK(found.xy == Approx(forces(0, 1)).epsilon(1e-9).margin(1e-9 * forces(0, 0)));
  // Without traction across the motion the contact is softer, by the cross terms only.
  const StickStiffness loose =
      stick_stiffness(contact_set(state), grid, body, {.tolerance = 1e-8, .hold_lateral = false});
  CHECK(loose.xx <= found.xx * (1 + 1e-12));

  const ForceCurve curve = sweep_pressures(surface, body, {mean / 2, mean}, {.stick = true});
  REQUIRE(curve.samples.size() == 2);
  CHECK(curve.samples[1].normal_stiffness == Approx(stiffness).epsilon(1e-8));
  // The sweep solves for the tractions to 1e-3, and the stiffness is right to the square of that.
  CHECK(curve.samples[1].tangential_stiffness == Approx(forces(0, 0)).epsilon(1e-5));
  const std::vector<ForceCurve> both =
      sweep_directions(surface, body, {mean}, {0, pi / 2}, {.stick = true});
  REQUIRE(both.size() == 2);
  CHECK(both[1].samples[0].tangential_stiffness == Approx(forces(1, 1)).epsilon(1e-5));
  CHECK(std::isnan(
      sweep_pressures(surface, body, {mean}, {.stick = false}).samples[0].tangential_stiffness));
}

TEST_CASE("Homogeneous half-spaces keep their bits as bodies", "[body]") {
  const Grid2D grid{64, 64, 1e-3, 1e-3};
  const Surface surface = test::rough_surface(grid);
  const ElasticBody steel{210e9, 0.3}, brass{100e9, 0.34};
  const Body body = Body::half_space(steel, brass);
  const Material material = Material::of_bodies(steel, brass);
  const double mean = 1e-3 * material.contact_modulus;
  const NormalContactState expected = press(surface, material.contact_modulus, at_pressure(mean)),
                           found = press(surface, body, at_pressure(mean));
  CHECK((found.contact_pressure == expected.contact_pressure).all());
  CHECK(normal_stiffness(found, grid, body) ==
        normal_stiffness(expected, grid, material.contact_modulus));
  CHECK(stick_stiffness(contact_set(found), grid, body).xx ==
        stick_stiffness(contact_set(expected), grid, material).xx);
  // The transforms with the response of a layer of the same material give the same contact.
  const Body same = Body::layered({{2e-5, steel.young, steel.poisson}}, steel);
  const NormalContactState one =
      press(surface, Body::half_space(steel), at_pressure(mean), {.tolerance = 1e-13});
  const NormalContactState layered = press(surface, same, at_pressure(mean), {.tolerance = 1e-13});
  CHECK(layered.mean_gap == Approx(one.mean_gap).epsilon(1e-11));
  CHECK(layered.elastic_energy == Approx(one.elastic_energy).epsilon(1e-10));
}

TEST_CASE("A coating acts as its base where it is thin and as a half-space where it is thick",
          "[body]") {
  const Grid2D grid{64, 64, 64e-6, 64e-6};
  const Surface surface = test::rough_surface(grid);
  const ElasticBody base{70e9, 0.33}, coating{10e9, 0.4};
  const auto press_on = [&](const Body& body) {
    return press(surface, body, at_pressure(1e8), {.tolerance = 1e-13});
  };
  const auto coated = [&](double thickness) {
    return Body::layered({{thickness, coating.young, coating.poisson}}, base);
  };
  const double on_base = press_on(Body::half_space(base)).mean_gap,
               on_coating = press_on(Body::half_space(coating)).mean_gap;
  REQUIRE(on_coating < 0.9 * on_base);
  // The response of the thin coating differs by about qt times the ratio of the moduli.
  CHECK(press_on(coated(1e-12)).mean_gap == Approx(on_base).epsilon(1e-5));
  // Three periods: e^(−2·2π·3) = 4e-17.
  CHECK(press_on(coated(3 * grid.lx)).mean_gap == Approx(on_coating).epsilon(1e-11));
  const double between = press_on(coated(4e-6)).mean_gap;
  CHECK(between < on_base);
  CHECK(between > on_coating);
}

TEST_CASE("From the base, a uniform displacement adds to the motion of the mean plane", "[body]") {
  const Grid2D grid{32, 32, 32 * cell, 32 * cell};
  const Surface surface = test::rough_surface(grid, {.rolloff = 2, .seed = 3});
  const Body layer = Body::layered({{6 * cell, 3e9, 0.4}}),
             from_base = layer.measured_from(Datum::base);
  const SurfaceCompliance uniform = from_base.compliance(0);
  const NormalContactOptions options{.tolerance = 1e-13};
  const double mean = 1e8;
  const NormalContactState plane = press(surface, layer, at_pressure(mean), options),
                           base = press(surface, from_base, at_pressure(mean), options);
  CHECK(plane.datum == Datum::mean_plane);
  CHECK(base.datum == Datum::base);
  CHECK((plane.contact_pressure == base.contact_pressure).all());
  CHECK(base.indentation == Approx(plane.indentation + uniform.normal * mean).epsilon(1e-12));
  CHECK(base.mean_gap == plane.mean_gap);
  CHECK(base.elastic_energy ==
        Approx(plane.elastic_energy + uniform.normal * mean * mean * grid.area() / 2));
  // An indentation from the base is solved with the uniform response in the symbol.
  const NormalContactState again =
      press(surface, from_base, at_indentation(base.indentation), options);
  REQUIRE(again.converged());
  CHECK(again.mean_pressure == Approx(mean).epsilon(1e-9));
  CHECK(again.elastic_energy == Approx(base.elastic_energy).epsilon(1e-9));
  CHECK(press(surface, from_base, at_mean_gap(base.mean_gap), options).indentation ==
        Approx(base.indentation).epsilon(1e-9));
  // Springs in series.
  const double k_plane = normal_stiffness(plane, grid, layer, options),
               k_base = normal_stiffness(base, grid, from_base, options);
  CHECK(1 / k_base == Approx(1 / k_plane + uniform.normal / grid.area()).epsilon(1e-9));
  const StickOptions stick{.tolerance = 1e-8};
  const auto compliance_of = [&](const Body& body) {
    const StickStiffness k = stick_stiffness(contact_set(plane), grid, body, stick);
    Eigen::Matrix2d stiffness;
    stiffness << k.xx, k.xy, k.xy, k.yy;
    return Eigen::Matrix2d(stiffness.inverse());
  };
  const Eigen::Matrix2d added = compliance_of(from_base) - compliance_of(layer);
  CHECK(added(0, 0) == Approx(uniform.in_plane / grid.area()).epsilon(1e-7));
  CHECK(added(1, 1) == Approx(uniform.in_plane / grid.area()).epsilon(1e-7));
  CHECK(std::abs(added(0, 1)) < 1e-7 * added(0, 0));

  SECTION("Full contact has a finite stiffness from the base only") {
    const double full = 1e10;
    const NormalContactState all = press(surface, from_base, at_pressure(full), options);
    REQUIRE(all.contact_area_fraction == 1);
    CHECK(normal_stiffness(all, grid, from_base, options) ==
          Approx(grid.area() / uniform.normal).epsilon(1e-9));
    CHECK(stick_stiffness(contact_set(all), grid, from_base, stick).xx ==
          Approx(grid.area() / uniform.in_plane).epsilon(1e-9));
    CHECK(std::isinf(
        normal_stiffness(press(surface, layer, at_pressure(full), options), grid, layer, options)));
    CHECK_THROWS_WITH(stick_stiffness(contact_set(all), grid, layer), Catch::Contains("contact"));
    // Full contact is reached at a finite indentation.
    const NormalContactState at_all = press(surface, from_base, at_indentation(all.indentation));
    REQUIRE(at_all.converged());
    CHECK(at_all.mean_pressure == Approx(full).epsilon(1e-9));
  }
  SECTION("An incompressible layer stays at its mean plane under a uniform pressure") {
    const Body rubber = Body::layered({{6 * cell, 3e9, 0.5}}).measured_from(Datum::base);
    const NormalContactState state = press(surface, rubber, at_pressure(mean), options);
    CHECK(state.indentation ==
          press(surface, rubber.measured_from(Datum::mean_plane), at_pressure(mean), options)
              .indentation);
    CHECK_THROWS_WITH(press(surface, rubber, at_indentation(1e-3)), Catch::Contains("indentation"));
  }
  SECTION("A flat surface") {
    const Surface flat{grid, Field::Zero(grid.nx, grid.ny), true, "test"};
    const NormalContactState state = press(flat, from_base, at_pressure(mean));
    CHECK(state.indentation == Approx(uniform.normal * mean).epsilon(1e-14));
    const NormalContactState given = press(flat, from_base, at_indentation(state.indentation));
    CHECK(given.mean_pressure == Approx(mean).epsilon(1e-9));
  }
}

TEST_CASE("A sphere on a graded half-space has the pressure of Giannakopoulos and Suresh",
          "[body]") {
  const GradedHalfSpace graded{3e9, 1e-3, 0.5, 0.3};
  const double k = graded.exponent, radius = 1e-2, side = 4e-3, contact_radius = 0.06 * side;
  const double force = 4 * Body::graded_modulus(graded) * std::pow(contact_radius, 3 + k) /
                       (std::pow(graded.depth, k) * radius * (1 + k) * (1 + k) * (3 + k));
  const double peak = force * (3 + k) / (2 * pi * contact_radius * contact_radius);
  std::vector<double> errors;
  for (const Index points : {64, 128, 256}) {
    const Grid2D grid{points, points, side, side};
    const Surface sphere = test::surface_of(grid, [&](double x, double y) {
      return -(std::pow(x - side / 2, 2) + std::pow(y - side / 2, 2)) / (2 * radius);
    });
    const NormalContactState state = press(sphere, Body::graded(graded), at_force(force));
    REQUIRE(state.converged());
    errors.push_back(std::abs(state.contact_pressure.maxCoeff() / peak - 1));
  }
  CAPTURE(errors);
  // The images of the period change the peak by (a/side)^(3+k) = 5e-5.
  CHECK(errors[2] < 2e-3);
  CHECK(std::log2(errors[0] / errors[2]) / 2 > 1.0);
}

TEST_CASE("A hardness bounds the pressures on a coating", "[body]") {
  const Grid2D grid{32, 32, 32 * cell, 32 * cell};
  const Surface surface = test::rough_surface(grid, {.rolloff = 2, .seed = 3});
  const Body body = Body::layered({{2 * cell, 600e9, 0.2}}, {70e9, 0.33});
  const double hardness = 4e9;
  const NormalContactState state =
      press(surface, body, at_pressure(1e9), {.tolerance = 1e-12, .hardness = hardness});
  REQUIRE(state.converged());
  CHECK(state.contact_pressure.maxCoeff() == hardness);
  CHECK(state.mean_pressure == Approx(1e9));
  // The gap, by the dense matrix: zero on elastic cells, positive where no load is, and saturated
  // cells lie below the plane.
  const Eigen::MatrixXd influence = Influence(grid, body).normal(all_cells(grid));
  const Eigen::Map<const Eigen::VectorXd> p(state.contact_pressure.data(), grid.points());
  const Eigen::VectorXd displacement = influence * p;
  const double rms = test::rms_height(surface);
  double elastic = 0, least = 1, saturated = -1;
  for (Index i = 0; i < grid.points(); ++i) {
    const double gap = displacement(i) - surface.heights.data()[i] + surface.heights.maxCoeff() -
                       state.indentation;
    if (p(i) == hardness)
      saturated = std::max(saturated, gap);
    else if (p(i) > 0)
      elastic = std::max(elastic, std::abs(gap));
    else
      least = std::min(least, gap);
  }
  CHECK(elastic < 1e-8 * rms);
  CHECK(least > -1e-8 * rms);
  CHECK(saturated < 1e-8 * rms);
}

TEST_CASE("A contact on a layer over processes has the bits of one process", "[body]") {
  const Grid2D grid{96, 64, 96 * cell, 64 * cell};
  const Surface surface = test::rough_surface(grid, {.seed = 3});
  const Body body = Body::layered({{6 * cell, 3e9, 0.4}}).measured_from(Datum::base);
  const auto numbers_of = [&](const Surface& pressed) {
    const NormalContactState state = press(pressed, body, at_pressure(5e7));
    const StickStiffness stick =
        stick_stiffness(contact_set(state), grid, body, {}, false, {}, pressed.communicator);
    return std::vector{state.mean_gap,
                       state.indentation,
                       state.elastic_energy,
                       stick.xx,
                       stick.xy,
                       stick.yy,
                       normal_stiffness(state, grid, body),
                       double(state.iterations)};
  };
  const std::vector<double> alone = numbers_of(surface);
  testing::run_ranks(GENERATE(2, 3), [&](const Communicator& all) {
    Surface mine{grid, {}, surface.periodic, surface.origin, all};
    const RowPartition rows = mine.partition();
    mine.heights = surface.heights.middleRows(rows.begin(), rows.count());
    if (numbers_of(mine) != alone) throw Error("other bits of a number");
  });
}

TEST_CASE("What a body cannot do is refused by name", "[body]") {
  const Grid2D grid{32, 32, 32 * cell, 32 * cell};
  const Surface surface = test::rough_surface(grid, {.rolloff = 2});
  const Body layer = Body::layered({{6 * cell, 3e9, 0.4}});
  using Catch::Contains;
  CHECK_THROWS_WITH(press(surface, layer, at_pressure(1e6), {.boundary = Boundary::free}),
                    Contains("boundary") && Contains("half-spaces only"));
  const NormalContactState state = press(surface, layer, at_pressure(1e6));
  CHECK_THROWS_WITH(normal_stiffness(state, grid, layer.measured_from(Datum::base)),
                    Contains("datum"));
  CHECK_THROWS_WITH(stick_stiffness(contact_set(state), grid, layer, {.boundary = Boundary::free}),
                    Contains("boundary"));
  const Body table = Body::tabulated({.wavenumber = {1e5, 1e6, 2e6, 3e6}, .normal = {4, 3, 2, 1}});
  CHECK_THROWS_WITH(press(surface, table, at_pressure(1e-6)), Contains("wavenumber"));
  const Body normal_only =
      Body::tabulated({.wavenumber = {1e5, 1e6, 2e6, 1e7}, .normal = {4, 3, 2, 1}});
  CHECK(press(surface, normal_only, at_pressure(1e-9)).converged());
  CHECK_THROWS_WITH(stick_stiffness(contact_set(state), grid, normal_only),
                    Contains("tangential response"));
}
