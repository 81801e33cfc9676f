// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/punch.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/tangential/stick.hpp>

using namespace salebra;

namespace {

using std::numbers::pi;

// Cells whose centres lie in an ellipse about a point (0.31, 0.17) of a cell off the middle of the
// grid; with its centre on the grid the error of the area would jump with n.
ContactSet ellipse(const Grid2D& grid, double semi_axis_x, double semi_axis_y) {
  ContactSet contact(grid.nx, grid.ny);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double x = (static_cast<double>(ix) - 0.31) * grid.dx() - grid.lx / 2;
      const double y = (static_cast<double>(iy) - 0.17) * grid.dy() - grid.ly / 2;
      contact(ix, iy) = std::pow(x / semi_axis_x, 2) + std::pow(y / semi_axis_y, 2) < 1;
    }
  return contact;
}

// An irregular set of several pieces with holes.
ContactSet islands(const Grid2D& grid) {
  ContactSet contact(grid.nx, grid.ny);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double x = 2 * pi * static_cast<double>(ix) / static_cast<double>(grid.nx);
      const double y = 2 * pi * static_cast<double>(iy) / static_cast<double>(grid.ny);
      contact(ix, iy) = std::sin(x + 0.3) * std::cos(2 * y) + 0.7 * std::sin(3 * x - y) +
                            0.5 * std::cos(5 * x + 4 * y) >
                        0.6;
    }
  return contact;
}

// Mindlin (1949): the tractions of a stuck ellipse are F_x/(2πab√(1 − x²/a² − y²/b²)). In Fourier
// space their displacement is u_x = (F_x/8π) ∫_0^{2π} [Σ1/G − Σ(ν/G) cos²φ]/√(a²cos²φ + b²sin²φ)
// dφ, here by complete elliptic integrals. a is the semi-axis along the motion.
double ellipse_stiffness(double a, double b, double inverse_shear, double poisson_over_shear) {
  if (a == b) return 8 * a / (2 * inverse_shear - poisson_over_shear);
  const double longer = std::max(a, b), shorter = std::min(a, b);
  const double m = 1 - std::pow(shorter / longer, 2);
  const double first = std::comp_ellint_1(std::sqrt(m)), second = std::comp_ellint_2(std::sqrt(m));
  const double total = 4 * first / longer;
  const double directed = 4 / (m * longer) * (a > b ? second - (1 - m) * first : first - second);
  return 8 * pi / (inverse_shear * total - poisson_over_shear * directed);
}

constexpr double contact_modulus = 2e9;

// Σ1/G and Σν/G of one elastic body.
double inverse_shear(double poisson) { return 2 / (contact_modulus * (1 - poisson)); }
double poisson_over_shear(double poisson) { return poisson * inverse_shear(poisson); }

StickOptions free_boundary(double tolerance = 1e-6) {
  return {.tolerance = tolerance, .boundary = Boundary::free};
}

}  // namespace

TEST_CASE("A stuck circular contact has K_t = 2G*a at any Poisson's ratio", "[stick]") {
  const double poisson = GENERATE(0.0, 0.3, 0.5), radius = 0.3e-3;
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const auto error = [&](Index n) {
    const Grid2D grid{n, n, 1e-3, 1e-3};
    const StickStiffness k =
        stick_stiffness(ellipse(grid, radius, radius), grid, material, free_boundary());
    REQUIRE(k.converged());
    CHECK(k.yy == Approx(k.xx).epsilon(2e-3));  // the outline of the cells is not a circle
    CHECK(std::abs(k.xy) < 1e-3 * k.xx);
    return std::abs((k.xx + k.yy) / 2 / (2 * material.tangential_modulus * radius) - 1);
  };
  // The edge is resolved to a cell: first order. Two doublings are used, since the area of the
  // cells scatters around that of the circle.
  const double coarse = error(32), fine = error(128);
  CHECK(fine < 4e-3);
  CHECK(std::log2(coarse / fine) / 2 == Approx(1.0).margin(0.3));
}

TEST_CASE("Elliptic contacts follow Mindlin's elliptic integrals", "[stick]") {
  const double poisson = GENERATE(0.3, 0.5);
  const auto [a, b] = GENERATE(table<double, double>({{0.4e-3, 0.2e-3}, {0.1e-3, 0.4e-3}}));
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const Grid2D grid{96, 96, 1e-3, 1e-3};
  const ContactSet contact = ellipse(grid, a, b);
  const StickStiffness k = stick_stiffness(contact, grid, material, free_boundary());
  const PunchStiffness punch =
      punch_stiffness(contact, grid, contact_modulus, {.boundary = Boundary::free});
  REQUIRE(k.converged());
  REQUIRE(punch.converged());
  const double g1 = inverse_shear(poisson), g2 = poisson_over_shear(poisson);
  const double exact_x = ellipse_stiffness(a, b, g1, g2), exact_y = ellipse_stiffness(b, a, g1, g2);
  const double exact_normal = ellipse_stiffness(a, b, 2 / contact_modulus, 0);
  CHECK(k.xx == Approx(exact_x).epsilon(0.01));
  CHECK(k.yy == Approx(exact_y).epsilon(0.01));
  // The ratio to the punch does not depend on the resolution of the edge.
  CHECK(k.xx / punch.normal_stiffness == Approx(exact_x / exact_normal).epsilon(1e-3));
  CHECK(k.yy / punch.normal_stiffness == Approx(exact_y / exact_normal).epsilon(1e-3));
}

TEST_CASE("At zero Poisson's ratio K_t = (G*/E*)K for every contact set", "[stick]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Grid2D grid{45, 28, 2e-3, 1e-3};  // odd, not square, cells not square
  const Material material = Material::of_contact_modulus(contact_modulus, 0.0);
  const StickOptions options{.tolerance = 1e-8, .boundary = boundary};
  const ContactSet contact = islands(grid);
  const StickStiffness k = stick_stiffness(contact, grid, material, options);
  const PunchStiffness punch = punch_stiffness(
      contact, grid, contact_modulus, {.tolerance = options.tolerance, .boundary = boundary});
  REQUIRE(k.converged());
  REQUIRE(punch.converged());
  CHECK(k.xx == Approx(material.modulus_ratio() * punch.normal_stiffness).epsilon(1e-11));
  CHECK(k.yy == Approx(k.xx).epsilon(1e-11));
  CHECK(std::abs(k.xy) < 1e-11 * k.xx);
}

TEST_CASE("Strips show the limits of the anisotropy, (1 - nu/2)/(1 - nu) and 1 - nu/2", "[stick]") {
  // On strips along y every mode has q along x, so the ratios hold for the discrete problem too.
  const double poisson = GENERATE(0.3, 0.5, -0.4);
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const Grid2D grid{60, 16, 1e-3, 0.3e-3};
  ContactSet contact = ContactSet::Constant(grid.nx, grid.ny, false);
  contact.middleRows(5, 9) = true;
  contact.middleRows(31, 4) = true;
  const StickOptions options{.tolerance = 1e-8};
  const StickStiffness k = stick_stiffness(contact, grid, material, options);
  const double scaled =
      material.modulus_ratio() *
      punch_stiffness(contact, grid, contact_modulus, {.tolerance = 1e-8}).normal_stiffness;
  CHECK(k.xx / scaled == Approx((1 - poisson / 2) / (1 - poisson)).epsilon(1e-10));
  CHECK(k.yy / scaled == Approx(1 - poisson / 2).epsilon(1e-10));
}

TEST_CASE("Exchanging x and y exchanges the stiffnesses", "[stick]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Grid2D grid{40, 27, 1.3e-3, 1e-3}, turned{27, 40, 1e-3, 1.3e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.4);
  const StickOptions options{.tolerance = 1e-8, .boundary = boundary};
  const ContactSet contact = islands(grid);
  const StickStiffness k = stick_stiffness(contact, grid, material, options);
  const StickStiffness t =
      stick_stiffness(ContactSet(contact.transpose()), turned, material, options);
  CHECK(t.xx == Approx(k.yy).epsilon(1e-11));
  CHECK(t.yy == Approx(k.xx).epsilon(1e-11));
  CHECK(t.xy == Approx(k.xy).epsilon(1e-9));
  CHECK(std::abs(k.xy) > 1e-4 * k.xx);  // otherwise the last line would show nothing
  // The stiffness in any direction is positive, and freeing the lateral displacement can only make
  // the contact softer.
  StickOptions lateral_free = options;
  lateral_free.hold_lateral = false;
  const StickStiffness soft = stick_stiffness(contact, grid, material, lateral_free);
  CHECK(soft.xx < k.xx);
  CHECK(soft.xx > 0.9 * k.xx);
  CHECK(soft.yy < k.yy);
  CHECK(stick_stiffness(contact, grid, material, options, true).xx == k.xx);
}

TEST_CASE("A periodic cell stiffens an isolated contact by a compliance that falls like 1/L",
          "[stick]") {
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const double cell = 1e-5;
  const auto difference = [&](Index n) {
    const Grid2D grid{n, n, cell * static_cast<double>(n), cell * static_cast<double>(n)};
    const ContactSet contact = ellipse(grid, 8 * cell, 5 * cell);
    const double free = stick_stiffness(contact, grid, material, free_boundary(1e-9)).xx;
    const double periodic = stick_stiffness(contact, grid, material, {.tolerance = 1e-9}).xx;
    return 1 / free - 1 / periodic;
  };
  // The next order is (a/L)³ against a/L, below one per cent at L = 8a. The kernels also differ
  // within a cell, equally for both.
  const double first = difference(64), second = difference(128), third = difference(256);
  CHECK((first - second) / (second - third) == Approx(2.0).epsilon(0.02));
}

TEST_CASE("Periodic displacements of one wave are Cerruti's in Fourier space", "[stick]") {
  const Material material = Material::of_bodies({3e9, 0.45}, {7e9, 0.1});
  const Grid2D grid{18, 15, 1e-3, 2e-3};
  const double qx = 2 * pi * 2 / grid.lx, qy = -2 * pi * 3 / grid.ly, q = std::hypot(qx, qy);
  Field wave(grid.nx, grid.ny);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy)
      wave(ix, iy) = std::cos(qx * static_cast<double>(ix) * grid.dx() +
                              qy * static_cast<double>(iy) * grid.dy() + 0.4);
  const ContactSet everywhere = ContactSet::Constant(grid.nx, grid.ny, true);
  StickSolver solver(grid, material);
  const double tx = 2e6, ty = -5e6;
  const TangentialField u = solver.displacement(everywhere, {tx * wave, ty * wave}, everywhere);
  double ux = 0, uy = 0;
  for (const ElasticBody& body : {ElasticBody{3e9, 0.45}, ElasticBody{7e9, 0.1}}) {
    const double along = (qx * tx + qy * ty) / (q * q);
    ux += (tx - body.poisson * qx * along) / (body.shear() * q);
    uy += (ty - body.poisson * qy * along) / (body.shear() * q);
  }
  CHECK((u.x - ux * wave).abs().maxCoeff() < 1e-13 * std::abs(ux));
  CHECK((u.y - uy * wave).abs().maxCoeff() < 1e-13 * std::abs(uy));
}

TEST_CASE("Free displacements are the integral of Cerruti's point solution", "[stick]") {
  const Material material = Material::of_bodies({3e9, 0.45}, {7e9, 0.1});
  const Grid2D grid{9, 7, 1.1e-3, 1.6e-3};
  ContactSet loaded = ContactSet::Constant(grid.nx, grid.ny, false);
  TangentialField traction{Field::Zero(grid.nx, grid.ny), Field::Zero(grid.nx, grid.ny)};
  loaded(1, 4) = true;
  traction.x(1, 4) = 2e6;
  traction.y(1, 4) = -5e6;
  const ContactSet everywhere = ContactSet::Constant(grid.nx, grid.ny, true);
  StickSolver solver(grid, material, free_boundary());
  const TangentialField u = solver.displacement(loaded, traction, everywhere);
  for (const auto& [ix, iy] : {std::pair<Index, Index>{3, 1}, {0, 6}, {8, 5}, {1, 0}}) {
    double ux = 0, uy = 0;
    // Midpoint rule on 40² parts of the loaded cell; its error at a distance of two cells is below
    // 1e-5.
    constexpr int parts = 40;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts; ++j) {
        const double x = (static_cast<double>(ix - 1) + (i + 0.5) / parts - 0.5) * grid.dx();
        const double y = (static_cast<double>(iy - 4) + (j + 0.5) / parts - 0.5) * grid.dy();
        const double r = std::hypot(x, y);
        const double c1 = material.cerruti_isotropic, c2 = material.cerruti_directed;
        ux += (c1 / r + c2 * x * x / (r * r * r)) * 2e6 - c2 * x * y / (r * r * r) * 5e6;
        uy += -(c1 / r + c2 * y * y / (r * r * r)) * 5e6 + c2 * x * y / (r * r * r) * 2e6;
      }
    const double area = grid.cell_area() / (parts * parts);
    CHECK(u.x(ix, iy) == Approx(ux * area).epsilon(1e-4));
    CHECK(u.y(ix, iy) == Approx(uy * area).epsilon(1e-4));
  }
}

TEST_CASE("The solved tractions give the displacements asked for and vanish off the contact",
          "[stick]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Grid2D grid{32, 40, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const ContactSet contact = islands(grid);
  TangentialField wanted{Field::Random(grid.nx, grid.ny) * 1e-9, Field::Zero(grid.nx, grid.ny)};
  wanted.y = 2e-9 - wanted.x;
  StickSolver solver(grid, material, {.tolerance = 1e-9, .boundary = boundary});
  TangentialField traction;
  const StickReport report = solver.solve(contact, wanted, 1e-9, traction);
  REQUIRE(report.converged());
  CHECK((!contact).select(traction.x.abs() + traction.y.abs(), 0).maxCoeff() == 0);
  const TangentialField u = solver.displacement(contact, traction, contact);
  const double misfit =
      contact.select((u.x - wanted.x).square() + (u.y - wanted.y).square(), 0).sum();
  const double rms = std::sqrt(misfit / static_cast<double>(contact.count()));
  CHECK(rms < 1.01e-18);
  // The solver reports this misfit over the scale, up to the round-off of its recursion.
  CHECK(report.residual == Approx(rms / 1e-9).epsilon(0.01));
  // A solve that starts from the solution has nothing to do.
  CHECK(solver.solve(contact, wanted, 1e-9, traction).iterations == 0);
}

TEST_CASE("A stick solve that stops early says so, and bad input is named", "[stick]") {
  const Grid2D grid{32, 32, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const ContactSet contact = islands(grid);
  CHECK(stick_stiffness(contact, grid, material, {.max_iterations = 2}).termination ==
        Termination::iteration_limit);
  const auto stop = [](const ProgressReport& report) { return report.step < 3; };
  CHECK(stick_stiffness(contact, grid, material, {.on_progress = stop}).termination ==
        Termination::interrupted);
  CHECK_THROWS_WITH(stick_stiffness(contact, grid, material, {.tolerance = 0}),
                    Catch::StartsWith("tolerance: 0"));
  CHECK_THROWS_WITH(stick_stiffness(contact, {31, 32, 1e-3, 1e-3}, material),
                    Catch::StartsWith("contact:"));
  CHECK_THROWS_WITH(stick_stiffness(contact, grid, Material::of_contact_modulus(1e9)),
                    Catch::StartsWith("material:"));
  CHECK_THROWS_WITH(stick_stiffness(ContactSet::Constant(32, 32, true), grid, material),
                    Catch::Contains("full contact"));
  const ContactSet none = ContactSet::Constant(32, 32, false);
  CHECK(stick_stiffness(none, grid, material, free_boundary()).xx == 0);
}

TEST_CASE("A sweep takes K_t from stick solves on its contact sets", "[stick]") {
  const Grid2D grid{32, 32, 1e-3, 1e-3};
  Surface surface{grid, Field(grid.nx, grid.ny), true, "waves"};
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy)
      surface.heights(ix, iy) = 1e-6 * std::cos(2 * pi * static_cast<double>(ix) / 32) +
                                0.3e-6 * std::cos(2 * pi * static_cast<double>(iy) / 16);
  const Material material = Material::of_contact_modulus(contact_modulus, 0.4);
  const std::vector<double> pressures{1e5, 1e6};
  SweepOptions options;
  const ForceCurve plain = sweep_pressures(surface, material, pressures, options);
  options.stick = true;
  const ForceCurve stuck = sweep_pressures(surface, material, pressures, options);
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    const NormalContactState state = press(surface, contact_modulus, at_pressure(pressures[k]));
    const StickStiffness direct = stick_stiffness(contact_set(state), grid, material);
    // A sweep ends its stick solves early: K_t is a maximum, and its error is the square of that of
    // the tractions, 1e-3, or at worst ten times that.
    CHECK(stuck.samples[k].tangential_stiffness == Approx(direct.xx).epsilon(1e-5));
    CHECK(stuck.samples[k].normal_stiffness == plain.samples[k].normal_stiffness);
    // Ridges along y are stiffer across than a round contact.
    CHECK(stuck.samples[k].tangential_stiffness > 1.02 * plain.samples[k].tangential_stiffness);
  }
}

TEST_CASE(
    "The steps of a stick solve do not grow with the grid where it is on the multilevel kernel",
    "[stick]") {
  // With the exact inverse of the normal response the condition number is 1/(1 − ν) = 1.43, each
  // step gains a factor of 11, and 1e-6 takes six. The inverse has an error of a tenth in the norm
  // of G, which costs up to half as many more. The stencil takes 13 at 128², which has no
  // multilevel kernel, and more on larger grids.
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  for (const Index n : {256, 512, 1024}) {
    const Grid2D grid{n, n, 1e-3, 1e-3};
    const StickStiffness k =
        stick_stiffness(islands(grid), grid, material, {}, /*along_x_only=*/true);
    INFO(n << " points a side");
    CHECK(k.multilevel_count > 0);
    CHECK(k.iterations <= 9);
  }
}

TEST_CASE("A stiffness is converged where both of its solves are", "[stick]") {
  // A row of cells may take one step more in one direction than in the other. With one step less
  // than the slower solve needs, the faster one still converges, which must not hide that the
  // slower one, here the first, has not.
  const Grid2D grid{64, 64, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const ContactSet lying = ellipse(grid, 4.5e-4, 1.5e-5), standing = lying.transpose();
  int compared = 0;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    StickOptions options = free_boundary(tolerance);
    options.hold_lateral = false;
    const auto iterations = [&](const ContactSet& contact) {
      return stick_stiffness(contact, grid, material, options, /*along_x_only=*/true).iterations;
    };
    const int along = iterations(lying), across = iterations(standing);
    if (along == across) continue;
    ++compared;
    options.max_iterations = std::max(along, across) - 1;
    const ContactSet& slow_first = along > across ? lying : standing;
    CHECK_FALSE(stick_stiffness(slow_first, grid, material, options).converged());
  }
  CHECK(compared > 0);
}
