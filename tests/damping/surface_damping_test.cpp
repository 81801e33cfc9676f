// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/generators/shapes.hpp>
#include <salebra/surface/moments.hpp>

#include "damping/surface_contacts.hpp"
#include "separate_contacts.hpp"
#include "slip_by_contacts.hpp"
#include "surface/refine.hpp"
#include "work_by_contacts.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

const Material material = Material::of_contact_modulus(1e9, 0.3);
constexpr double angular_frequency = 2 * pi * 20e3;

ForceCurve curve_of(const Surface& surface, const std::vector<double>& pressures,
                    Boundary boundary = Boundary::periodic, bool stick = true) {
  SweepOptions sweep;
  sweep.contact.tolerance = 1e-9;
  sweep.contact.boundary = boundary;
  sweep.stick = stick;
  return sweep_pressures(surface, material, pressures, sweep);
}

Surface rough(Index points, std::uint64_t seed, double cells_in_wave = 6) {
  const Grid2D grid{points, points, 1e-6, 1e-6};
  const SelfAffineSpectrum spectrum({.hurst = 0.5,
                                     .rolloff = 0.4e-6,
                                     .short_cutoff = cells_in_wave * grid.dx(),
                                     .rms_slope = 0.1});
  return filtered_noise(grid, spectrum, seed);
}

// Loads over E*h' from light to a fifth of the area.
std::vector<double> loads(int count) {
  std::vector<double> pressures;
  for (int k = 0; k < count; ++k)
    pressures.push_back(4e-3 * std::pow(25, double(k) / (count - 1)) * 0.1 *
                        material.contact_modulus);
  return pressures;
}

Drag drag(const Surface& surface, double amplitude_over_rms) {
  return {amplitude_over_rms * height_statistics(surface).rms_height, 1e-3, angular_frequency};
}

SurfaceDampingOptions converged_options() {
  SurfaceDampingOptions options;
  options.intervals = 16;
  options.refinements = 0;
  return options;
}

// Sums of waves whose numbers, directions and phases are fractional parts of multiples of
// irrational numbers. The generator makes no such surfaces. Rms height 1.
Field waves(Index points, int seed, double highest, double direction, double spread) {
  const auto fraction = [](double value) { return value - std::floor(value); };
  Field sum = Field::Zero(points, points);
  for (int i = 41 * seed + 1; i <= 41 * seed + 40; ++i) {
    const double number = 2 * std::pow(highest / 2, fraction(std::numbers::sqrt2 * i));
    const double angle = direction + spread * (fraction(std::numbers::sqrt3 * i) - 0.5);
    const double along_x = std::round(number * std::cos(angle)),
                 along_y = std::round(number * std::sin(angle));
    const double phase = fraction(std::numbers::phi * i);
    sum += Field::NullaryExpr(points, points, [&](Index x, Index y) {
      return std::pow(number, -1.5) *
             std::cos(2 * pi *
                      ((along_x * double(x) + along_y * double(y)) / double(points) + phase));
    });
  }
  return (sum - sum.mean()) / std::sqrt((sum - sum.mean()).square().mean());
}

// Turned ridges, peaks and pits of a lognormal surface, plateaux and smooth hills, all with an rms
// slope of 0.1.
Surface other_surface(int seed) {
  constexpr Index points = 64;
  const auto isotropic = [&](double cells, int other = 0) {
    return waves(points, seed + other, double(points) / cells, 0, 2 * pi);
  };
  Surface surface{Grid2D{points, points, 1e-6, 1e-6}, {}, true};
  switch (seed % 5) {
    case 0:
      surface.heights = waves(points, seed, double(points) / 6, 0.5, 0.5);
      break;
    case 1:
      surface.heights = (0.8 * isotropic(8)).exp();
      break;
    case 2:
      surface.heights = -(0.8 * isotropic(8)).exp();
      break;
    case 3:
      surface.heights = isotropic(6).min(0.5) + 0.1 * isotropic(6, 7);
      break;
    default:
      surface.heights = isotropic(20);
  }
  const auto square_of_steps = [&](const Field& steps) {
    return (steps / surface.grid.dx()).square().mean();
  };
  const Field& h = surface.heights;
  const double slope = std::sqrt(square_of_steps(h.bottomRows(points - 1) - h.topRows(points - 1)) +
                                 square_of_steps(h.rightCols(points - 1) - h.leftCols(points - 1)));
  surface.heights *= 0.1 / slope;
  return surface;
}

struct Count {
  int cases = 0, held = 0;
  std::vector<double> over_actual;

  void add(const std::vector<SurfaceDamping>& stated,
           const std::vector<SurfaceDamping>& converged) {
    for (std::size_t k = 0; k < stated.size(); ++k) {
      if (!stated[k].converged || !converged[k].converged) continue;
      const double actual = std::abs(stated[k].work_per_cycle - converged[k].work_per_cycle);
      ++cases;
      held += actual <= stated[k].work_per_cycle_error();
      over_actual.push_back(stated[k].work_per_cycle_error() / actual);
    }
  }
  double median() {
    std::ranges::sort(over_actual);
    return over_actual[over_actual.size() / 2];
  }
};

}  // namespace

TEST_CASE(
    "The loss of a paraboloid is Hertz', within the error stated, in both motions and for both "
    "things held") {
  // F = (4/3)E*√R δ^{3/2}; K_t = (G*/E*)K for a round contact.
  constexpr double radius = 4e-3, size = 1e-3, mean_indentation = 20e-6;
  const double coefficient = 4.0 / 3 * material.contact_modulus * std::sqrt(radius);
  const PowerLaw law(coefficient, 1.5, material.modulus_ratio());
  const Grid2D grid{64, 64, size, size};
  const Surface surface = paraboloid_surface(grid, radius, off_grid_center(grid));
  const double force = coefficient * std::pow(mean_indentation, 1.5);
  const ForceCurve curve = curve_of(surface, {force / grid.area()}, Boundary::free);
  const std::vector<Oscillation> motions{EqualFrequency{6e-6, 1e-6, pi / 4, angular_frequency},
                                         Drag{6e-6, 1e-3, angular_frequency}};
  for (const Oscillation& motion : motions)
    for (const Hold hold : {Hold::indentation, Hold::force}) {
      SurfaceDampingOptions options;
      options.boundary = Boundary::free;
      options.hold = hold;
      const SurfaceDamping result = surface_damping(surface, material, motion, curve, options)[0];
      const DampingResult exact = relaxation_damping(law, at_force(force), motion, {.hold = hold});
      INFO(motion.index() << ' ' << int(hold) << ' ' << result.work_per_cycle / exact.work_per_cycle
                          << ' ' << result.work_per_cycle_error() / exact.work_per_cycle);
      REQUIRE(result.converged);
      CHECK(std::abs(result.work_per_cycle - exact.work_per_cycle) < result.work_per_cycle_error());
      // About 700 cells enter on the finer grid: two standard deviations are 8 %, which the weights
      // of the quadrature and K_t may double.
      CHECK(result.work_per_cycle_error() < 0.16 * exact.work_per_cycle);
      CHECK(result.damping_constant / exact.damping_constant ==
            Approx(result.work_per_cycle / exact.work_per_cycle));
    }
}

TEST_CASE("A surface that slides as a whole loses μF on its way, whatever its K_t is") {
  // An elongated contact has K_t above (G*/E*)K along its length, and below it across.
  constexpr double size = 1e-3, friction = 0.3;
  const Grid2D grid{64, 64, size, size};
  Surface surface{grid, Field(64, 64), false};
  const Drag motion{2e-8, 1e-5, 1e5};
  SurfaceDampingOptions options;
  options.boundary = Boundary::free;
  options.friction_coefficient = friction;
  options.excursion = 1e-2;
  for (const bool along : {true, false}) {
    for (Index ix = 0; ix < 64; ++ix)
      for (Index iy = 0; iy < 64; ++iy) {
        const double x = size * (double(ix) - 31.3) / 64, y = size * (double(iy) - 31.8) / 64;
        surface.heights(ix, iy) =
            -(along ? x * x / 16e-3 + y * y / 1e-3 : x * x / 1e-3 + y * y / 16e-3);
      }
    const ForceCurve curve = sweep_pressures(
        surface, material, {20e6}, {.contact = {.boundary = Boundary::free}, .stick = true});
    const SurfaceDamping result = surface_damping(surface, material, motion, curve, options)[0];
    INFO(result.stiffness_ratio);
    CHECK(std::abs(result.stiffness_ratio - 1) > 0.03);
    // Turning points take 4μδ/g of the excursion, less than 0.5 %; the amplitude is 1e-3 of δ.
    const double way = 2 * pi * motion.drag_velocity / motion.angular_frequency;
    CHECK(result.work_per_cycle == Approx(friction * curve.samples[0].force * way).epsilon(0.01));
  }
}

TEST_CASE("The loss of a paraboloid with slip is that of Hertz' law, from no slip to sliding") {
  constexpr double radius = 4e-3, size = 1e-3, mean_indentation = 20e-6, amplitude = 2e-6;
  const double coefficient = 4.0 / 3 * material.contact_modulus * std::sqrt(radius);
  const PowerLaw law(coefficient, 1.5, material.modulus_ratio());
  const Grid2D grid{64, 64, size, size};
  const Surface surface = paraboloid_surface(grid, radius, off_grid_center(grid));
  const double force = coefficient * std::pow(mean_indentation, 1.5);
  const ForceCurve curve = curve_of(surface, {force / grid.area()}, Boundary::free);
  SurfaceDampingOptions options;
  options.boundary = Boundary::free;
  options.friction_coefficient = 0.3;
  const auto compare = [&](const Oscillation& motion, double excursion) {
    options.excursion = excursion;
    const SurfaceDamping result = surface_damping(surface, material, motion, curve, options)[0];
    const Loss exact =
        loss_with_slip(law, mean_indentation, motion, options.friction_coefficient, excursion);
    const double found = result.work_per_cycle;
    INFO(motion.index() << ' ' << excursion << ' ' << found / exact.work_per_cycle << ' '
                        << result.work_per_cycle_error() / exact.work_per_cycle << ' '
                        << result.slip_work / found << ' ' << exact.slip_share());
    REQUIRE(result.converged);
    CHECK(std::abs(found - exact.work_per_cycle) < result.work_per_cycle_error());
    // Some 200 cells enter within the oscillation on the finer grid: two standard deviations are
    // 14 %. If slip dominates W, it is an integral of forces, which hardly depend on the cells.
    CHECK(result.work_per_cycle_error() < 0.2 * exact.work_per_cycle);
    if (exact.slip_share() > 0.5)
      CHECK(result.work_per_cycle_error() < 0.05 * exact.work_per_cycle);
    CHECK(std::abs(result.slip_work / found - exact.slip_share()) <
          result.work_per_cycle_error() / found);
  };
  // The contact slides as a whole from x = (μ/g)δ on, 7 µm.
  for (const double excursion : {0.1e-6, 1e-6, 100e-6})
    compare(Drag{amplitude, excursion / 20 * angular_frequency / (2 * pi), angular_frequency},
            excursion);
  for (const double displacement : {1e-6, 10e-6})
    compare(EqualFrequency{amplitude, displacement, pi / 3, angular_frequency},
            SurfaceDamping::unknown);
}

TEST_CASE("What holds a mean force shifts the mean indentation of a paraboloid as the law says") {
  // With u_z as large as the indentation, the two losses differ by far more than the error.
  constexpr double radius = 4e-3, size = 1e-3;
  const double coefficient = 4.0 / 3 * material.contact_modulus * std::sqrt(radius);
  const PowerLaw law(coefficient, 1.5, material.modulus_ratio());
  const double force = coefficient * std::pow(20e-6, 1.5);
  const Drag motion{16e-6, 1e-3, angular_frequency};
  const Grid2D grid{64, 64, size, size};
  const Surface surface = paraboloid_surface(grid, radius, off_grid_center(grid));
  const ForceCurve curve = curve_of(surface, {force / grid.area()}, Boundary::free);
  double works[2], exact[2];
  for (const Hold hold : {Hold::indentation, Hold::force}) {
    SurfaceDampingOptions options;
    options.boundary = Boundary::free;
    options.hold = hold;
    works[int(hold)] = surface_damping(surface, material, motion, curve, options)[0].work_per_cycle;
    exact[int(hold)] =
        relaxation_damping(law, at_force(force), motion, {.hold = hold}).work_per_cycle;
  }
  const double found = works[1] / works[0] - 1, expected = exact[1] / exact[0] - 1;
  REQUIRE(std::abs(expected) > 0.01);
  // The same cells carry both, so their scatter cancels, except for the cells that enter at the
  // ends of the two ranges.
  CHECK(found == Approx(expected).margin(0.5 * std::abs(expected)));
}

TEST_CASE("Stated errors of the damping of rough surfaces hold what it converges to") {
  // Eighteen losses at three amplitudes. At least nine in ten errors hold; by chance 12 of 18 or
  // fewer would occur one time in 500.
  Count count;
  for (const std::uint64_t seed : {11, 12, 13}) {
    const Surface surface = rough(48, seed), fine = refined(surface, 4);
    const Drag motion = drag(surface, seed == 11 ? 0.01 : seed == 12 ? 0.05 : 0.2);
    const auto pressures = loads(6);
    count.add(
        surface_damping(surface, material, motion, curve_of(surface, pressures)),
        surface_damping(fine, material, motion,
                        curve_of(fine, pressures, Boundary::periodic, false), converged_options()));
  }
  CHECK(count.cases >= 16);
  CHECK(count.held >= count.cases * 2 / 3);
  // An error that always holds because it is huge is useless. The errors are about 4 times the
  // actual deviations; a median of eighteen varies by a half.
  CHECK(count.median() < 8);
}

TEST_CASE("Surfaces unlike the generator's have errors that hold, and none is missed by far") {
  // With the seeds 0 to 119, 99 % hold, and the largest ratio is 1.03. On the first six, forces
  // alone, without the stiffnesses of the contacts, were off by up to 1.6 errors.
  int held = 0;
  double largest = 0;
  std::vector<double> stated;
  for (const int seed : {27, 35, 85, 100, 103, 113, 0, 1}) {
    const Surface surface = other_surface(seed);
    const double pressure =
        std::array{0.004, 0.02, 0.08}[std::size_t(seed % 3)] * 0.1 * material.contact_modulus;
    const Drag motion = drag(surface, std::array{0.01, 0.03, 0.1, 0.2}[std::size_t(seed % 4)]);
    SurfaceDampingOptions options;
    options.hold = Hold::indentation;
    const SurfaceDamping result =
        surface_damping(surface, material, motion,
                        curve_of(surface, {pressure}, Boundary::periodic, false), options)[0];
    // 33 contacts instead of 17 change it by 0.3 %.
    const double converged =
        work_by_contacts(refined(surface, 4), material, pressure, motion, 16, false);
    const double ratio =
        std::abs(result.work_per_cycle - converged) / result.work_per_cycle_error();
    INFO(seed << ' ' << result.work_per_cycle_error() / result.work_per_cycle << ' '
              << converged / result.work_per_cycle - 1);
    REQUIRE(result.converged);
    CHECK(ratio < 1.6);
    held += ratio <= 1;
    stated.push_back(result.work_per_cycle_error() / result.work_per_cycle);
  }
  CHECK(held >= 7);
  // The median is 12 % for all 120 seeds.
  std::ranges::sort(stated);
  CHECK(stated[stated.size() / 2] < 0.2);
}

TEST_CASE("Errors of the loss with slip hold, over three decades of the excursion") {
  // With 80 losses of the seeds 0 to 19, 92 % hold, and the largest ratio is 2.0. Cells of half the
  // size serve as the surface, cells of twice the size give the error.
  int held = 0, cases = 0;
  std::vector<double> stated;
  for (const int seed : {0, 1, 2, 3, 4, 5}) {
    const Surface surface = other_surface(seed);
    const double pressure =
        std::array{0.004, 0.02, 0.08}[std::size_t(seed % 3)] * 0.1 * material.contact_modulus;
    const double amplitude = std::array{0.01, 0.03, 0.1, 0.2}[std::size_t(seed % 4)] *
                             height_statistics(surface).rms_height;
    const ForceCurve curve = curve_of(surface, {pressure}, Boundary::periodic, false);
    const DenseForces dense = dense_forces(refined(surface, 2), material, pressure, amplitude, 24);
    for (const auto& [friction, steps] :
         {std::pair{0.1, 0.1}, {0.5, 1.}, {0.1, 10.}, {0.5, 100.}}) {
      SurfaceDampingOptions options;
      options.coarsen = true;
      options.friction_coefficient = friction;
      options.excursion = steps * friction * amplitude;
      const Drag motion{amplitude, options.excursion / 20 * angular_frequency / (2 * pi),
                        angular_frequency};
      const SurfaceDamping result = surface_damping(surface, material, motion, curve, options)[0];
      const double found = result.work_per_cycle;
      const double converged =
          work_with_slip_by_contacts(dense, material, motion, friction, options.excursion);
      const double ratio = std::abs(found - converged) /
                           std::hypot(result.work_per_cycle_error(), 0.005 * converged);
      INFO(seed << ' ' << friction << ' ' << steps << ": " << found / converged << ' '
                << result.work_per_cycle_error() / converged << ' ' << result.slip_work / found);
      REQUIRE(result.converged);
      CHECK(ratio < 2.5);
      held += ratio <= 1;
      ++cases;
      stated.push_back(result.work_per_cycle_error() / found);
    }
  }
  // 92 % of 24 hold; fewer than 19 occur by chance one time in 100.
  CHECK(held >= 19);
  // The median is 8 % for the 80.
  std::ranges::sort(stated);
  CHECK(stated[stated.size() / 2] < 0.25);
}

TEST_CASE("A loss whose error is not smaller is no number, and neither are its parts") {
  Loss loss;
  loss.work_per_cycle = 1;
  loss.relaxation_work = 0.4;
  loss.slip_work = 0.6;
  loss.work_per_cycle_without_slip = 2;
  loss.set_damping_constants(Drag{1e-9, 1e-3, 1e5});
  loss.error = {.cells = 0.3, .noise = 0.4, .intervals = 0, .stiffness_ratio = 0, .solver = 0};
  loss.error_without_slip = loss.error;
  Loss kept = loss;
  kept.drop_uncertain();
  CHECK(kept.work_per_cycle == 1);
  CHECK(kept.damping_constant_error() == Approx(0.5 * loss.damping_constant).epsilon(1e-12));
  loss.error.noise = 1;
  loss.error_without_slip.noise = 3;
  loss.drop_uncertain();
  for (const double number :
       {loss.work_per_cycle, loss.damping_constant, loss.relaxation_work, loss.slip_work,
        loss.work_per_cycle_without_slip, loss.damping_constant_without_slip})
    CHECK(std::isnan(number));
  // The error stays known, to explain why the loss is unknown.
  CHECK(loss.work_per_cycle_error() == Approx(std::sqrt(0.09 + 1)));
}

TEST_CASE("Friction leaves the loss without slip as it is, to the bit") {
  const Surface surface = rough(32, 7);
  const Drag motion = drag(surface, 0.05);
  const ForceCurve curve = curve_of(surface, loads(3), Boundary::periodic, false);
  SurfaceDampingOptions options;
  const std::vector<SurfaceDamping> without =
      surface_damping(surface, material, motion, curve, options);
  options.friction_coefficient = 0.3;
  options.excursion = 20 * motion.normal_amplitude;
  const std::vector<SurfaceDamping> with =
      surface_damping(surface, material, motion, curve, options);
  for (std::size_t k = 0; k < with.size(); ++k) {
    CHECK(with[k].work_per_cycle_without_slip == without[k].work_per_cycle);
    CHECK(with[k].error_without_slip.total() == without[k].work_per_cycle_error());
    CHECK(without[k].work_per_cycle_without_slip == without[k].work_per_cycle);
    CHECK(without[k].damping_constant_without_slip == without[k].damping_constant);
    CHECK(std::isnan(without[k].slip_work));
    CHECK(with[k].slip_work > 0);
    CHECK(with[k].work_per_cycle ==
          Approx(with[k].relaxation_work + with[k].slip_work).epsilon(1e-12));
  }
}

TEST_CASE("The loss of a joint of a surface has an error that holds, at small forces too") {
  // On 48 surfaces of twelve kinds 98 % hold; the law through 13 forces alone is off by up to 150 %
  // at 0.25 μF. With ν = 0, K_t is K.
  const Material stuck = Material::of_contact_modulus(1e9, 0);
  constexpr double friction = 0.3;
  int held = 0;
  double max_of_law = 0;
  std::vector<double> stated;
  for (const int seed : {0, 1, 2, 3, 4, 27}) {
    const Surface surface = other_surface(seed);
    const double pressure = std::array{0.004, 0.02, 0.08}[std::size_t(seed % 3)] * 0.1 * 1e9;
    const double force =
        std::array{0.09, 0.3}[std::size_t(seed % 2)] * friction * pressure * surface.grid.area();
    std::vector<double> pressures;
    for (int k = -7; k <= 5; ++k) pressures.push_back(pressure * std::pow(1.6, k));
    const ForceCurve curve = sweep_pressures(surface, stuck, pressures);
    const TabulatedLaw law(curve, stuck.modulus_ratio());
    const OperatingPoint position = at_force(pressure * surface.grid.area());
    const TangentialOscillation motion = TangentialForce{force};
    const JointLoss result =
        surface_joint_loss(surface, stuck, law, position, {motion}, friction)[0];
    const double converged =
        joint_work_by_contacts(refined(surface, 4), stuck, pressure, force, friction);
    INFO(seed << ' ' << result.work_per_cycle / converged << ' ' << result.work_error / converged);
    const double ratio = std::abs(result.work_per_cycle - converged) / result.work_error;
    CHECK(ratio < 1.6);
    held += ratio <= 1;
    stated.push_back(result.work_error / result.work_per_cycle);
    const double by_law = joint_loss(law, position, motion, friction).work_per_cycle;
    max_of_law = std::max(max_of_law, std::abs(by_law / converged - 1));
  }
  CHECK(held >= 5);
  CHECK(max_of_law > 0.2);
  // The median of 48 is 20 %.
  std::ranges::sort(stated);
  CHECK(stated[3] < 0.4);
}

TEST_CASE("A joint of a surface that slides as a whole loses 4μF(x − 2μ'U/F), within its error") {
  // U = ∫F dδ by Simpson's rule over solved contacts on cells of a quarter of the size. With ν = 0,
  // K_t is K.
  const Material stuck = Material::of_contact_modulus(1e9, 0);
  constexpr double friction = 0.3;
  for (const int seed : {0, 1, 2}) {
    const Surface surface = other_surface(seed), fine = refined(surface, 4);
    const double pressure = std::array{0.004, 0.02, 0.08}[std::size_t(seed % 3)] * 0.1 * 1e9;
    std::vector<double> pressures;
    for (int k = -7; k <= 5; ++k) pressures.push_back(pressure * std::pow(1.6, k));
    const TabulatedLaw law(sweep_pressures(surface, stuck, pressures), stuck.modulus_ratio());
    const NormalContactState high = press(fine, stuck.contact_modulus, at_pressure(pressure));
    constexpr int steps = 12;
    double energy = 0;
    for (int k = 1; k <= steps; ++k) {
      const double weight = k == steps ? 1 : k % 2 == 1 ? 4 : 2;
      energy +=
          weight / 3 * high.indentation / steps *
          press(fine, stuck.contact_modulus, at_indentation(high.indentation * k / steps)).force;
    }
    // Three times the knee, where the elastic part is about a tenth.
    const double x = 3 * friction * high.indentation;
    const double exact = 4 * friction * (high.force * x - 2 * friction * energy);
    const JointLoss loss =
        surface_joint_loss(surface, stuck, law, at_force(pressure * surface.grid.area()),
                           {TangentialAmplitude{x}}, friction)[0];
    INFO(seed << ' ' << loss.work_per_cycle / exact - 1 << ' ' << loss.work_error / exact);
    CHECK(loss.regime == Regime::sliding);
    CHECK(loss.tangential_force == Approx(friction * high.force).epsilon(1e-9));
    CHECK(std::abs(loss.work_per_cycle - exact) < loss.work_error);
    CHECK(loss.work_error < 0.02 * exact);
  }
}

TEST_CASE("Steady sliding of a surface has errors that hold, and so do its dampings") {
  // With ν = 0, K_t is K. Each of two velocities has ten numbers.
  const Material stuck = Material::of_contact_modulus(1e9, 0);
  constexpr double friction = 0.3;
  int held = 0, all = 0;
  double farthest = 0;
  for (const int seed : {0, 1, 2, 3, 4}) {
    const Surface surface = other_surface(seed);
    const double pressure = std::array{0.004, 0.02, 0.08}[std::size_t(seed % 3)] * 0.1 * 1e9;
    const double amplitude = (seed % 2 == 0 ? 0.02 : 0.1) * height_statistics(surface).rms_height;
    SweepOptions sweep;
    sweep.stick = true;
    const ForceCurve curve = sweep_pressures(surface, stuck, {pressure}, sweep);
    const double critical = friction * amplitude * angular_frequency;
    const std::vector<double> velocities{0.03 * critical, 0.3 * critical};
    const auto found =
        surface_sliding(surface, stuck, curve, 0,
                        {{amplitude, angular_frequency}, velocities, friction, Hold::indentation});
    REQUIRE(found.size() == 2);
    const auto [law, center] = law_by_contacts(refined(surface, 4), stuck, pressure, amplitude, 32);
    const std::vector<SteadySliding> converged = steady_sliding(
        *law, at_indentation(center), {amplitude, angular_frequency}, velocities, friction);
    for (std::size_t i = 0; i < 2; ++i)
      for (const auto& [number, error] : sliding_errors) {
        if (std::isnan(found[i].first.*number)) continue;
        const double off = std::abs(found[i].first.*number - converged[i].*number);
        const double ratio = off / (found[i].second.*error + 1e-6 * std::abs(converged[i].*number));
        INFO(seed << ' ' << i << ' ' << found[i].first.*number << " +- " << found[i].second.*error
                  << " against " << converged[i].*number);
        CHECK(ratio < 2);
        farthest = std::max(farthest, ratio);
        ++all;
        held += ratio <= 1;
      }
  }
  INFO(held << " of " << all << ", farthest " << farthest);
  CHECK(all >= 80);
  CHECK(held >= 0.9 * all);
}

TEST_CASE("Ridges along the grid, whose cells touch row by row, have errors that hold too") {
  Count count;
  for (const std::uint64_t seed : {3, 4, 5}) {
    Surface ridges = rough(48, seed);
    for (Index i = 0; i < ridges.grid.nx; ++i)
      ridges.heights.row(i).setConstant(ridges.heights(i, 7));
    const Surface fine = refined(ridges, 4);
    const Drag motion = drag(ridges, 0.05);
    const auto pressures = loads(5);
    count.add(
        surface_damping(ridges, material, motion,
                        curve_of(ridges, pressures, Boundary::periodic, false)),
        surface_damping(fine, material, motion,
                        curve_of(fine, pressures, Boundary::periodic, false), converged_options()));
  }
  CHECK(count.cases >= 13);
  CHECK(count.held >= count.cases * 2 / 3);
}

TEST_CASE("Doubling the number of loads moves no stated interval by more than its error") {
  const Surface surface = rough(48, 21);
  const Drag motion = drag(surface, 0.05);
  const auto few = loads(5), many = loads(9);
  const auto by_few = surface_damping(surface, material, motion, curve_of(surface, few));
  const auto by_many = surface_damping(surface, material, motion, curve_of(surface, many));
  for (std::size_t k = 0; k < few.size(); ++k) {
    const SurfaceDamping &a = by_few[k], &b = by_many[2 * k];
    REQUIRE(many[2 * k] == Approx(few[k]));
    const double error = std::min(a.work_per_cycle_error(), b.work_per_cycle_error());
    CHECK(std::abs(a.work_per_cycle - b.work_per_cycle) < error);
    CHECK(std::abs(a.work_per_cycle_error() - b.work_per_cycle_error()) < error);
  }
}

TEST_CASE(
    "An amplitude within which no cell enters has the loss of the limit of small amplitudes, with "
    "an error") {
  const Surface surface = rough(48, 31);
  const auto pressures = loads(4);
  const ForceCurve curve = curve_of(surface, pressures, Boundary::periodic, false);
  const Drag motion = drag(surface, 1e-5);
  SurfaceDampingOptions small;
  small.amplitude = Amplitude::small;
  const auto finite = surface_damping(surface, material, motion, curve);
  const auto limit = surface_damping(surface, material, motion, curve, small);
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    REQUIRE(finite[k].converged);
    CHECK(finite[k].window > 100 * motion.normal_amplitude);
    // The differences are of first order in u_z/l, 1e-5 over about 0.4, and come also from the
    // difference quotient of the limit.
    CHECK(finite[k].work_per_cycle == Approx(limit[k].work_per_cycle).epsilon(1e-3));
    CHECK(finite[k].work_per_cycle_error() > 0);
  }
}

TEST_CASE("A relative error halves the cells of the loads that need it") {
  const Surface surface = rough(32, 41, 8);
  const Drag motion = drag(surface, 0.2);
  const ForceCurve curve = curve_of(surface, loads(4), Boundary::periodic, false);
  SurfaceDampingOptions options;
  const auto once = surface_damping(surface, material, motion, curve, options);
  options.relative_error = 0.08;
  const auto refined_on = surface_damping(surface, material, motion, curve, options);
  int finer = 0;
  for (std::size_t k = 0; k < once.size(); ++k) {
    const bool met = once[k].work_per_cycle_error() <= 0.08 * std::abs(once[k].work_per_cycle);
    CHECK((refined_on[k].points == 64) == met);
    if (!met)
      CHECK((refined_on[k].work_per_cycle_error() <= 0.08 * refined_on[k].work_per_cycle ||
             refined_on[k].points == 256));
    finer += refined_on[k].points > 64;
  }
  CHECK(finer > 0);
}

TEST_CASE(
    "Damping of a surface has the same bits for every number of threads, and keeps the cells where "
    "told") {
  const Surface surface = rough(32, 51);
  const Drag motion = drag(surface, 0.1);
  const ForceCurve curve = curve_of(surface, loads(4), Boundary::periodic, false);
  SurfaceDampingOptions options;
  options.keep_cells = true;
  const auto kept = surface_damping(surface, material, motion, curve, options);
  options.keep_cells = false;
  options.refinements = 0;
  parallel::set_threads(1);
  const auto alone = surface_damping(surface, material, motion, curve, options);
  parallel::set_threads(0);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    CHECK(kept[k].points == 32);
    CHECK(std::isfinite(kept[k].work_per_cycle_error()));
    CHECK(std::isnan(alone[k].work_per_cycle_error()));
    CHECK(alone[k].points == 32);
  }
  const auto together = surface_damping(surface, material, motion, curve, options);
  for (std::size_t k = 0; k < alone.size(); ++k)
    CHECK(alone[k].work_per_cycle == together[k].work_per_cycle);
}

TEST_CASE("Cells of twice the size give an error too, and their value is that of the cells") {
  const Index points = GENERATE(48, 49);
  const Surface surface = rough(points, 61, 8);
  const Drag motion = drag(surface, 0.1);
  const ForceCurve curve = curve_of(surface, loads(4), Boundary::periodic, false);
  SurfaceDampingOptions options;
  options.refinements = 0;
  options.coarsen = true;
  const auto coarsened = surface_damping(surface, material, motion, curve, options);
  const auto halved = surface_damping(surface, material, motion, curve);
  for (std::size_t k = 0; k < halved.size(); ++k) {
    CHECK(coarsened[k].points == points);
    CHECK(coarsened[k].error.cells > 0);
    // Both errors include the same true value, each in 90 % of cases.
    CHECK(std::abs(coarsened[k].work_per_cycle - halved[k].work_per_cycle) <
          coarsened[k].work_per_cycle_error() + halved[k].work_per_cycle_error());
  }
}

TEST_CASE("A step at the seam has its error, which a surface without a step has not") {
  Surface periodic = rough(64, 71);
  periodic.periodic = false;
  Surface tilted = periodic;
  const double rms = height_statistics(periodic).rms_height;
  for (Index i = 0; i < 64; ++i) tilted.heights.row(i) += 4 * rms * (double(i) / 63 - 0.5);
  SurfaceDampingOptions options;
  options.refinements = 0;
  options.coarsen = true;
  options.seam = SeamCheck::window;
  const auto pressures = loads(4);
  const Drag motion = drag(periodic, 0.1);
  const auto smooth =
      surface_damping(periodic, material, motion,
                      curve_of(periodic, pressures, Boundary::periodic, false), options);
  const auto stepped = surface_damping(
      tilted, material, motion, curve_of(tilted, pressures, Boundary::periodic, false), options);
  double of_smooth = 0, of_stepped = 0;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    REQUIRE(smooth[k].converged);
    CHECK(smooth[k].work_per_cycle_error() >= smooth[k].error.seam);
    of_smooth += smooth[k].error.seam / smooth[k].work_per_cycle;
    of_stepped += stepped[k].error.seam / stepped[k].work_per_cycle;
  }
  // On the tilted surface only the step carries the light loads; the window takes a quarter of the
  // area from both surfaces.
  CHECK(of_stepped > 1.5 * of_smooth);
}

TEST_CASE("The error of a seam is the change of the loss beyond the scatter of both solves") {
  const Surface surface = rough(32, 71);
  SurfaceDampingOptions options;
  options.refinements = 0;
  const auto curve = curve_of(surface, loads(6), Boundary::periodic, false);
  const Drag motion = drag(surface, 0.3);
  options.seam = SeamCheck::free;
  const auto seamed = surface_damping(surface, material, motion, curve, options);
  options.seam = {};
  options.boundary = Boundary::free;
  const auto free = surface_damping(surface, material, motion, curve, options);
  int told_apart = 0;
  for (std::size_t k = 0; k < seamed.size(); ++k) {
    // A wider window adds the random entry of contact patches to the scatter.
    if (!seamed[k].converged || !free[k].converged || seamed[k].window != motion.normal_amplitude)
      continue;
    const double change = free[k].work_per_cycle - seamed[k].work_per_cycle;
    const double deviation = seamed[k].error.noise / 1.8;  // standard deviations that it states
    const double beyond = change * change - 2 * deviation * deviation;
    // Both are the same numbers in another order. A scatter of a thousandth of the change changes
    // the result by 1e-6.
    CHECK(seamed[k].error.seam == Approx(std::sqrt(std::max(0.0, beyond))).epsilon(1e-9));
    if (beyond > 0 && deviation > 1e-3 * std::abs(change)) ++told_apart;
  }
  CHECK(told_apart > 0);
}

TEST_CASE("Damping of a surface refuses what it cannot use") {
  const Surface surface = rough(16, 1, 4);
  const Drag motion = drag(surface, 0.1);
  const ForceCurve curve = curve_of(surface, loads(4), Boundary::periodic, false);
  for (const double relative_error : {-0.1, 1.0, 2.0, std::nan("")}) {
    SurfaceDampingOptions options;
    options.relative_error = relative_error;
    CHECK_THROWS_WITH(surface_damping(surface, material, motion, curve, options),
                      Catch::StartsWith("relative_error: "));
  }
  SurfaceDampingOptions options;
  options.intervals = 7;
  CHECK_THROWS_WITH(surface_damping(surface, material, motion, curve, options),
                    "intervals: 7 must be 4, 8, 16 or 32");
  options.intervals = 8;
  options.on_progress = [](const ProgressReport&) { return false; };
  CHECK_THROWS_AS(surface_damping(surface, material, motion, curve, options), Interrupted);
  ForceCurve nothing = curve;
  nothing.samples.clear();
  CHECK_THROWS_AS(surface_damping(surface, material, motion, nothing), InvalidInput);
  // A load whose contact did not converge has no number.
  ForceCurve failed = curve;
  failed.samples[1].converged = false;
  const auto results = surface_damping(surface, material, motion, failed);
  CHECK_FALSE(results[1].converged);
  CHECK(std::isnan(results[1].work_per_cycle));
  CHECK(results[2].converged);
}

TEST_CASE("The loss of small amplitudes is that of contacts that know nothing of each other") {
  // Contacts less than a thousandth of h_rms apart are so close that the start already meets the
  // tolerance.
  const Grid2D grid{128, 128, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 0.25e-3, .short_cutoff = 64e-6, .rms_height = 1e-6});
  for (const std::uint64_t seed : {1, 2}) {
    const Surface surface = random_phase(grid, spectrum, seed);
    const ForceCurve curve = curve_of(surface, {6e6, 18e6}, Boundary::periodic, false);
    for (const double relative : {3e-4, 1e-3}) {
      const Drag motion = drag(surface, relative);
      SurfaceDampingOptions options;
      options.keep_cells = true;
      const auto found = surface_damping(surface, material, motion, curve, options);
      for (std::size_t k = 0; k < found.size(); ++k) {
        CAPTURE(seed, k, relative);
        REQUIRE(found[k].converged);
        const WorkOfParabola truth = work_of_parabola(
            separate_stiffnesses(surface, material.contact_modulus, curve.samples[k].indentation,
                                 found[k].window, 24),
            found[k].window, material.modulus_ratio(), motion);
        // 1.6 stated errors are 2.9 standard deviations: one number in 270 is further off.
        CHECK(std::abs(found[k].work_per_cycle - truth.work) <
              1.6 * std::hypot(found[k].work_per_cycle_error(), 1.8 * truth.error));
        // Starts that are never iterated give errors of 5 to 15 times W.
        CHECK(found[k].work_per_cycle_error() < 1.5 * truth.work);
        CHECK(found[k].error.solver < 1e-2 * found[k].work_per_cycle_error());
      }
    }
  }
}

TEST_CASE("Forces of contacts that start from each other know nothing of the tolerance") {
  const Surface surface = rough(128, 5);
  NormalContactOptions options;
  options.tolerance = 1e-6;
  detail::SurfaceContacts contacts_at(surface, material, options);
  const double center = contacts_at.indentation_at(2e6);
  options.tolerance = 1e-13;
  for (const double share : {1.0, 1.001, 0.999, 1.002, 1.01}) {
    const detail::StiffnessSample sample = contacts_at.at(share * center);
    const NormalContactState separate =
        press(surface, material.contact_modulus, at_indentation(share * center), options);
    CAPTURE(share, sample.force_correction / separate.force);
    // If the contact sets are the same, the difference is round-off; otherwise cells that carry
    // almost nothing are missing.
    CHECK(std::abs(sample.force / separate.force - 1) < 1e-9);
  }
}

TEST_CASE("Contacts of a sweep give the losses that the same contacts solved anew give") {
  const Surface surface = rough(64, 5);
  const double slip = GENERATE(std::numeric_limits<double>::quiet_NaN(), 0.3);
  SweepOptions sweep;
  sweep.contact.tolerance = 1e-9;
  const std::vector<double> pressures = loads(4);
  detail::KeptContacts kept(pressures.size());
  sweep.on_stiffness = [&](std::size_t k, const NormalContactState& state, double stiffness,
                           const Field& growth) {
    kept[k].emplace(state, stiffness, growth, surface);
  };
  const std::vector<ForceCurve> curves{sweep_pressures(surface, material, pressures, sweep)};
  SurfaceDampingOptions options = converged_options();
  options.friction_coefficient = slip;
  options.excursion = 1e-8;
  const Oscillation motion = drag(surface, 0.02);
  const auto anew = surface_damping(surface, material, motion, curves, options)[0];
  const auto begun =
      detail::surface_damping(surface, material, motion, curves, options, kept, 1e-9)[0];
  // Other starts give other last digits: without the kept contacts all bits would be the same.
  CHECK(!std::ranges::equal(begun, anew, {}, &SurfaceDamping::indentation,
                            &SurfaceDamping::indentation));
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    CAPTURE(k);
    REQUIRE(anew[k].converged);
    CHECK(begun[k].work_per_cycle_without_slip ==
          Approx(anew[k].work_per_cycle_without_slip).epsilon(1e-4));
    CHECK(begun[k].work_per_cycle == Approx(anew[k].work_per_cycle).epsilon(1e-4));
    CHECK(begun[k].indentation == Approx(anew[k].indentation).epsilon(1e-6));
  }
}

TEST_CASE("A loss below zero is no result") {
  // If K_t/K falls more steeply than on any surface, K_t falls with the indentation.
  const Surface surface = rough(64, 3);
  ForceCurve curve = curve_of(surface, {1.8e6, 2e6, 2.2e6}, Boundary::periodic, false);
  for (std::size_t k = 0; k < 3; ++k)
    curve.samples[k].tangential_stiffness *= std::array{5.0, 1.0, 0.2}[k];
  SurfaceDampingOptions options;
  options.refinements = 0;
  const SurfaceDamping damping =
      surface_damping(surface, material, drag(surface, 0.01), curve, options)[1];
  CHECK(!damping.converged);
  for (const double number : {damping.work_per_cycle, damping.damping_constant,
                              damping.work_per_cycle_error(), damping.damping_constant_error()})
    CHECK(std::isnan(number));
}
