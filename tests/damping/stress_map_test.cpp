// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/tangential_contact.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

const Material material = Material::of_moduli(1e9, 8e8);
constexpr double tangential_modulus = 8e8, radius = 1e-2, indentation = 1e-6, amplitude = 3e-7,
                 stroke = 2e-7;
const EqualFrequency quarter{.normal_amplitude = amplitude,
                             .tangential_amplitude = stroke,
                             .phase = pi / 2,
                             .angular_frequency = 1};

// Gauss–Legendre rule with six points on panels that halve towards both ends, for logarithms and
// roots there.
double graded(const std::function<double(double)>& f, double low, double high) {
  const double node[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  const double weight[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  auto panel = [&](double from, double to) {
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    double sum = 0;
    for (int j = 0; j < 3; ++j)
      sum += weight[j] * (f(middle - half * node[j]) + f(middle + half * node[j]));
    return sum * half;
  };
  const double half = 0.5 * (high - low);
  double sum = 0;
  for (int i = 0; i < 40; ++i) {
    const double outer = half * std::exp2(-i), inner = half * std::exp2(-i - 1);
    sum += panel(low + inner, low + outer) + panel(high - outer, high - inner);
  }
  return sum;
}

}  // namespace

TEST_CASE("Eq (17): shear stress carries the tangential force", "[stress]") {
  const IndenterLaw law(paraboloid_profile(radius), material);
  const double mean = GENERATE(1e-6, 1e-7);
  const Oscillation motion =
      GENERATE(Oscillation(quarter), Oscillation(EqualFrequency{amplitude, stroke, 0.5, 1}),
               Oscillation(Drag{amplitude, 1e-4, 500}));
  const OscillatingStress stress(law, mean, motion);
  for (const double angle : {-2.0, -0.5, 0.0, 0.6, 1.5, 3.0}) {
    CAPTURE(mean, motion.index(), angle);
    const double a = stress.contact_radius(angle), least = stress.min_contact_radius();
    if (a == 0) {
      CHECK(stress.tangential_force(angle) == 0);
      continue;
    }
    // r = a sin ψ removes the root at the edge; the logarithm is at the smallest contact radius.
    auto ring = [&](double psi) {
      const double r = a * std::sin(psi);
      return 2 * pi * r * stress.shear(angle, r) * a * std::cos(psi);
    };
    const double middle = std::asin(std::min(1.0, least / a));
    const double force = graded(ring, 0, middle) + graded(ring, middle, pi / 2);
    const double scale = law.tangential_stiffness(mean + amplitude) * stroke;
    CHECK(force == Approx(stress.tangential_force(angle)).margin(1e-6 * scale));
  }
}

TEST_CASE("The force under the stresses is that of the turning-point stack", "[stress]") {
  const IndenterLaw law(paraboloid_profile(radius), material);
  const double mean = GENERATE(1e-6, 1e-7);
  const OscillatingStress stress(law, mean, quarter);
  TangentialContact contact(law, mean - amplitude, mean + amplitude);
  contact.start(mean - amplitude, stress.displacement(-pi));
  const int steps = 2000;
  for (int i = 1; i <= steps; ++i) {
    const double angle = -pi + 2 * pi * i / steps;
    contact.move_to(mean + amplitude * std::cos(angle), stress.displacement(angle));
    if (i % 250 == 0)
      // Second order in the step: (2π/2000)² of K_t u_x.
      CHECK(contact.tangential_force() ==
            Approx(stress.tangential_force(angle))
                .margin(1e-5 * law.tangential_stiffness(mean) * stroke));
  }
}

TEST_CASE("Fig. 4: the logarithm at the least contact radius keeps its coefficient", "[stress]") {
  const IndenterLaw law(paraboloid_profile(radius), material);
  const OscillatingStress stress(law, indentation, quarter);
  const double least = stress.min_contact_radius();
  const double expected =
      tangential_modulus * stroke / (2 * pi) * std::sqrt(2 / (radius * amplitude));
  for (const double angle : {-2.0, -0.5, 0.8, 2.0}) {
    CAPTURE(angle);
    const double near = 1e-9 * least, far = 4e-9 * least;
    const double slope =
        (stress.shear(angle, least - near) - stress.shear(angle, least - far)) / std::log(4.0);
    CHECK(slope == Approx(expected).epsilon(1e-3));
  }
}

TEST_CASE("Fig. 4: the retreating edge carries a square root of −2u_x sinθ", "[stress]") {
  const IndenterLaw law(paraboloid_profile(radius), material);
  const OscillatingStress stress(law, indentation, quarter);
  for (const double angle : {0.3, 1.2, 2.5}) {
    const double a = stress.contact_radius(angle), r = a * (1 - 1e-10);
    const double root = std::sqrt((a - r) * (a + r));
    CHECK(stress.shear(angle, r) * root * pi / tangential_modulus ==
          Approx(-2 * stroke * std::sin(angle)).epsilon(2e-4));
    // There is no singularity while the contact grows.
    CHECK(std::abs(stress.shear(-angle, r) * root * pi / tangential_modulus) < 2e-4 * stroke);
  }
}

TEST_CASE("Without intermittent levels the shear is that of a stuck punch", "[stress]") {
  const double end = 1e-3;
  const IndenterLaw punch(flat_punch_profile(end), material);
  const OscillatingStress stress(punch, indentation, Drag{amplitude, 1e-4, 500});
  const double angle = 1.0, r = 6e-4;
  CHECK(stress.shear(angle, r) ==
        Approx(tangential_modulus * stress.displacement(angle) / (pi * 8e-4)).epsilon(1e-9));
}

TEST_CASE("A stress map holds the stresses of its phases and radii", "[stress]") {
  const IndenterLaw law(paraboloid_profile(radius), material);
  const StressMap map = stress_map(law, indentation, quarter, 8, 12);
  const OscillatingStress stress(law, indentation, quarter);
  REQUIRE(map.shear.rows() == 9);
  REQUIRE(map.shear.cols() == 12);
  CHECK(map.shear(5, 3) == stress.shear(map.angle[5], map.radial_position[3]));
  CHECK(map.contact_pressure(2, 4) == stress.pressure(map.angle[2], map.radial_position[4]));
  CHECK(map.shear.isFinite().all());
  CHECK(map.contact_radius[4] == law.contact_radius(indentation + amplitude));
  CHECK_THROWS_AS(stress_map(law, -1e-6, quarter), InvalidInput);
  CHECK_THROWS_AS(stress_map(law, indentation, quarter, 0), InvalidInput);
  auto stop = [](const ProgressReport&) { return false; };
  CHECK_THROWS_AS(stress_map(law, indentation, quarter, 8, 12, stop), Interrupted);
}
