// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/contact_element.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <vector>

using namespace salebra;
using std::numbers::pi;

namespace {

constexpr double ratio = 0.8;

std::shared_ptr<const LawSprings> intervals_of(const ContactLaw& law, double lowest, double highest,
                                               double friction, int springs) {
  return std::make_shared<const LawSprings>(
      law, lowest, highest,
      LawSpringsOptions{.friction_coefficient = friction, .springs = springs});
}

double size_of(const ElementForces& forces) {
  return std::hypot(forces.tangential_force[0], forces.tangential_force[1]);
}

// A random walk of turning points in δ, x, y.
std::vector<std::array<double, 3>> walk(double low, double high, double reach, int count) {
  std::mt19937_64 bits(11);
  const auto uniform = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  std::vector<std::array<double, 3>> path;
  for (int i = 0; i < count; ++i)
    path.push_back(
        {low + (high - low) * uniform(), reach * (2 * uniform() - 1), reach * (2 * uniform() - 1)});
  return path;
}

// Largest difference of the force along x from that of a contact without levels, relative to μF,
// over a path of turning points that both follow in small steps.
double error_of_intervals(const ContactLaw& law, double low, double high, double friction,
                          int springs) {
  const double reach = 0.6 * (high - low);
  TangentialContact exact(law, low, high,
                          {.friction_coefficient = friction, .tangential_range = 2 * reach});
  ContactElement element(intervals_of(law, low, high, friction, springs));
  const auto path = walk(low, high, reach, 30);
  exact.start(path[0][0], 0), element.start(path[0][0], 0, 0);
  double worst = 0;
  std::array<double, 2> from{path[0][0], 0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    constexpr int steps = 400;
    for (int step = 1; step <= steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      const double indentation = std::lerp(from[0], path[i][0], part);
      const double x = std::lerp(from[1], path[i][1], part);
      exact.move_to(indentation, x);
      const ElementForces forces = element.move_to(indentation, x, 0);
      worst = std::max(worst, std::abs(forces.tangential_force[0] - exact.tangential_force()) /
                                  (friction * law.force(high)));
    }
    from = {path[i][0], path[i][1]};
  }
  return worst;
}

// A curve of loads spread evenly in ln F, for a body whose K_t/K falls from 0.95 to 0.8 with load,
// with a given scatter of both stiffnesses.
enum class Body { exponential, sphere, summits };
struct MeasuredCurve {
  Body body;
  int loads;
  double scatter;
  bool with_normal_stiffness = true;
};

ForceCurve curve_of(const MeasuredCurve& table) {
  std::mt19937_64 bits(7);
  const auto noise = [&] {
    return 1 + table.scatter * (2 * (static_cast<double>(bits() >> 11) * 0x1p-53) - 1);
  };
  ForceCurve curve{.model = "measured", .nominal_area = 1e-6, .samples = {}};
  for (int i = 0; i < table.loads; ++i) {
    const double part = i / (table.loads - 1.0), force = 10 * std::pow(1e-4, 1 - part);
    double indentation = 0, stiffness = 0;
    if (table.body == Body::exponential) {
      indentation = 1e-7 * std::log(force), stiffness = force / 1e-7;
    } else if (table.body == Body::sphere) {
      indentation = 1e-6 * std::pow(force / 10, 2.0 / 3), stiffness = 1.5 * force / indentation;
    } else {  // a Gaussian height distribution: ln F falls faster than linearly with the separation
      const double separation = std::sqrt(2.25 - 2 * std::log(force / 10)) - 1.5;
      indentation = -3e-7 * separation, stiffness = force * (separation + 1.5) / 3e-7;
    }
    curve.samples.push_back({.indentation = indentation,
                             .force = force,
                             .normal_stiffness = table.with_normal_stiffness ? stiffness * noise()
                                                                             : ForceSample::unknown,
                             .tangential_stiffness = stiffness * (0.95 - 0.15 * part) * noise()});
  }
  return curve;
}

// Twenty curves: three bodies, few and many loads as in practice, and scatter of K and K_t.
std::vector<MeasuredCurve> measured_curves() {
  std::vector<MeasuredCurve> all;
  for (const Body body : {Body::exponential, Body::sphere, Body::summits}) {
    for (const int loads : {8, 12, 24, 60, 240}) all.push_back({body, loads, 0.02});
    all.push_back({body, 60, 0});
  }
  all.push_back({Body::exponential, 30, 0.1});
  all.push_back({Body::summits, 240, 0.05, false});
  return all;
}

}  // namespace

TEST_CASE("No path takes the tangential force of a tabulated law beyond μF") {
  const double friction = 0.3;
  double worst = 0, sliding = 0;
  for (const MeasuredCurve& table : measured_curves()) {
    CAPTURE(int(table.body), table.loads, table.scatter);
    const TabulatedLaw law(curve_of(table), ratio);
    const double middle = law.indentation_of(0.5), highest = law.highest_indentation();
    const double low = law.indentation_of(0.05), reach = 0.5 * (highest - middle);
    ContactElement element(intervals_of(law, low, highest, friction, 64));
    element.start(middle, 0, 0);
    // The lowest tangent ends where the contact separates, and part of the path lies below. Every
    // other motion is a short one along x, and most of these slip only a little.
    int number = 0;
    for (auto [indentation, x, y] : walk(2 * low - middle, highest, reach, 5000)) {
      if (++number % 2 == 0) x = element.state()[1] + 0.02 * x, y = element.state()[2];
      const ElementForces forces = element.move_to(indentation, x, y);
      REQUIRE(forces.normal_force >= 0);
      // The allowance is the round-off of sums of 64 levels.
      worst = std::max(worst, size_of(forces) - friction * forces.normal_force * (1 + 1e-12));
      REQUIRE(worst <= 0);
    }
    const ElementForces here = element.move_to(middle, 0, 0);
    CHECK(here.normal_force == Approx(law.force(middle)).epsilon(1e-3));
    const ElementForces slid = element.move_to(middle, 1e-4, 0);
    sliding = size_of(slid) / (friction * slid.normal_force);
    // Earlier stretches of 1e-7 m turn the springs by 1e-3 relative to the distance of 1e-4 m.
    CHECK(sliding == Approx(1).epsilon(1e-6));
    CHECK(element.move_to(law.lowest_indentation() - 1e-5, 0, 0).normal_force == 0);
    CHECK(size_of(element.move_to(law.lowest_indentation() - 1e-5, 1e-8, 0)) == 0);
  }
}

TEST_CASE("A loop of an element over a tabulated law loses what a joint and a damper of it lose") {
  const double friction = 0.3;
  for (const MeasuredCurve& table : measured_curves()) {
    CAPTURE(int(table.body), table.loads, table.scatter);
    const TabulatedLaw law(curve_of(table), ratio);
    const double middle = law.indentation_of(1);
    const auto loop = [&](const EqualFrequency& motion, double coefficient, double& peak) {
      ContactElement element(intervals_of(law, middle - motion.normal_amplitude,
                                          middle + motion.normal_amplitude, coefficient, 512));
      const auto at = [&](double phase) {
        return std::array{middle + motion.normal_amplitude * std::cos(phase),
                          motion.tangential_amplitude * std::cos(phase + motion.phase)};
      };
      element.start(at(0)[0], 0, 0);
      double work = 0, x = 0, force = 0;
      constexpr int steps = 4000;
      for (int i = 0; i <= 2 * steps; ++i) {
        const auto [indentation, next] = at(2 * pi * i / steps);
        const double now = element.move_to(indentation, next, 0).tangential_force[0];
        if (i > steps) work += 0.5 * (force + now) * (next - x), peak = std::max(peak, now);
        x = next, force = now;
      }
      return work;
    };
    // Both have the K_t of the law, and the friction limit of the K_t/K of the whole contact. They
    // differ by the width of the springs of the element.
    constexpr double ratios = 0.01;
    const double decay = law.force(middle) / law.normal_stiffness(middle);
    for (const double part : {0.3, 0.8}) {
      const double x = part * friction / law.stiffness_ratio(middle) * decay;
      const JointLoss joint =
          joint_loss(law, at_indentation(middle), TangentialAmplitude{x}, friction);
      double peak = 0;
      const double work = loop({.tangential_amplitude = x}, friction, peak);
      CHECK(peak == Approx(joint.tangential_force).epsilon(ratios));
      // A loss that the distances between the loads leave open is not known.
      if (!std::isnan(joint.work_per_cycle))
        CHECK(work == Approx(joint.work_per_cycle).epsilon(ratios));
    }
    // In full stick only the law matters, and K_t falls only by scatter.
    const EqualFrequency motion{
        .normal_amplitude = 0.5 * decay, .tangential_amplitude = 0.01 * decay, .phase = pi / 2};
    const DampingResult damping = relaxation_damping(law, at_indentation(middle), motion);
    double peak = 0;
    CHECK(loop(motion, INFINITY, peak) ==
          Approx(damping.work_per_cycle).epsilon(0.005 + table.scatter));
  }
}

TEST_CASE("On noisy curves of a sphere an element and a joint differ by less than the noise does") {
  // Loads from 1 mN to 10 N, with a standard deviation of 1 % in F and in K_t.
  const double friction = 0.3, coefficient = 4e9 / 3 * std::sqrt(1e-3), middle_force = 1;
  const double middle = std::pow(middle_force / coefficient, 2.0 / 3);
  const double stiffness = ratio * 1.5 * middle_force / middle;
  const double part = 0.2, x = part * friction / ratio * middle;
  // Mindlin and Deresiewicz (1953): the loss of a sphere under T = t μF.
  const double t = 1 - std::pow(1 - part, 1.5), rest = std::pow(1 - t, 2.0 / 3);
  const double exact = 36.0 / 5 * std::pow(friction * middle_force, 2) / stiffness *
                       (1 - (1 - t) * rest - 5 * t / 6 * (1 + rest));
  double element_square = 0, joint_square = 0, difference_square = 0, largest = 0;
  std::mt19937_64 bits(11);
  const auto noise = [&] {
    return 1 + 0.01 * std::sqrt(3) * (2 * (static_cast<double>(bits() >> 11) * 0x1p-53) - 1);
  };
  constexpr int curves = 40, loads = 60;
  for (int number = 0; number < curves; ++number) {
    CAPTURE(number);
    ForceCurve curve{.model = "measured", .nominal_area = 1e-6, .samples = {}};
    for (int i = 0; i < loads; ++i) {
      const double force = 10 * std::pow(1e-4, 1 - i / (loads - 1.0));
      const double indentation = std::pow(force / coefficient, 2.0 / 3);
      curve.samples.push_back(
          {.indentation = indentation,
           .force = force * noise(),
           .tangential_stiffness = ratio * 1.5 * force / indentation * noise()});
    }
    const TabulatedLaw law(curve, ratio);
    ContactElement element(intervals_of(law, middle, middle, friction, 256));
    element.start(middle, 0, 0);
    double work = 0, before = 0, force = 0;
    constexpr int steps = 1000;
    for (int i = 1; i <= 2 * steps; ++i) {
      const double next = x * std::sin(2 * pi * i / steps);
      const double now = element.move_to(middle, next, 0).tangential_force[0];
      if (i > steps) work += 0.5 * (force + now) * (next - before);
      before = next, force = now;
    }
    const double joint =
        joint_loss(law, at_indentation(middle), TangentialAmplitude{x}, friction).work_per_cycle;
    element_square += std::pow(work / exact - 1, 2) / curves;
    joint_square += std::pow(joint / exact - 1, 2) / curves;
    difference_square += std::pow((work - joint) / exact, 2) / curves;
    largest = std::max(largest, std::abs(work / joint - 1));
  }
  // The loss depends on K_t', which turns a noise of 1 % into 15 to 20 %. The element and the joint
  // have the same noise, and both take K_t/K of the whole contact. They differ by the width of the
  // springs of the element, and where K_t falls.
  CAPTURE(std::sqrt(element_square), std::sqrt(joint_square), std::sqrt(difference_square),
          largest);
  CHECK(largest < 5e-3);
  CHECK(std::min(element_square, joint_square) > 0.1 * 0.1);
  CHECK(std::max(element_square, joint_square) < 0.2 * 0.2);
}

TEST_CASE("The force of an element tends to that of a contact without levels") {
  // Levels of the width h leave an error of h in the end of slip and in the history of a level. The
  // order is therefore at least one: between 32 and 256 levels the error falls by 8 or more.
  const ExponentialLaw exponential(10, 1e-7, ratio);
  const double coarse = error_of_intervals(exponential, -5e-8, 5e-8, 0.3, 32);
  const double fine = error_of_intervals(exponential, -5e-8, 5e-8, 0.3, 256);
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.02);
  CHECK(fine < coarse / 8);
  const PowerLaw sphere(1e9, 1.5, ratio);
  CHECK(error_of_intervals(sphere, 1e-8, 6e-8, 0.3, 256) < 2e-3);
}

TEST_CASE("The normal force of an element is that of the law to fourth order of its nodes") {
  const ExponentialLaw law(10, 1e-7, ratio);
  const auto error = [&](int springs) {
    const LawSprings of(law, -2e-7, 2e-7, {.springs = springs});
    double worst = 0;
    for (double at = -2e-7; at < 2e-7; at += 1.7e-9)
      worst = std::max(worst, std::abs(of.normal(at).force / law.force(at) - 1));
    return worst;
  };
  // A cubic of the width h has the error h⁴F''''/384; h = 4 l/16.
  CHECK(error(32) < 1.1 * std::pow(0.25, 4) / 384);
  CHECK(error(32) / error(64) == Approx(16).epsilon(0.1));
}

TEST_CASE("An element in full stick loses what the levels that it lets go held") {
  // δ = w cos, x = X cos with the phase π/2 between them: γ of the exponential law has a closed
  // form. Here the path is two laps of a rectangle in (δ, x). The law itself loses K_t(high) −
  // K_t(low) times X²/2 each time the body rises at 0 and falls at X.
  const ExponentialLaw law(10, 1e-7, ratio);
  const double low = -3e-8, high = 4e-8, travel = 5e-9;
  ContactElement element(intervals_of(law, low, high, INFINITY, 64));
  element.start(low, 0, 0);
  double work = 0;
  const auto go = [&](double indentation, double x) {
    const double before = element.state()[1],
                 force = element.forces(indentation, before, 0).tangential_force[0];
    const ElementForces end = element.move_to(indentation, x, 0);
    work += 0.5 * (force + end.tangential_force[0]) * (x - before);
  };
  for (int lap = 0; lap < 2; ++lap) {
    go(high, 0), go(high, travel), go(low, travel), go(low, 0);
  }
  const double held = law.tangential_stiffness(high) - law.tangential_stiffness(low);
  // Straight sides are followed exactly, up to the round-off of sums.
  CHECK(work == Approx(2 * 0.5 * held * travel * travel).epsilon(1e-12));
}

TEST_CASE("An element under a constant load loses what Mindlin's bodies lose in partial slip") {
  // W = 8μ²(E*/G*)lF[−(1 − q/2)ln(1 − q) − q], q = T/(μF): two half cycles between ±T.
  const double load = 10, decay = 1e-7, friction = 0.3;
  const ExponentialLaw law(load, decay, ratio);
  const auto error = [&](double q, int springs) {
    ContactElement element(intervals_of(law, 0, 0, friction, springs));
    element.start(0, 0, 0);
    // Loading: T = μF(1 − exp(−x/x_c)), x_c = μ(E*/G*)l.
    const double amplitude = -friction / ratio * decay * std::log1p(-q);
    double work = 0, force = 0, x = 0;
    const auto go = [&](double to) {
      for (int step = 1, steps = 2000; step <= steps; ++step) {
        const double next = x + (to - x) / (steps - step + 1);
        const double now = element.move_to(0, next, 0).tangential_force[0];
        work += 0.5 * (force + now) * (next - x);
        x = next, force = now;
      }
    };
    go(amplitude), go(-amplitude);
    work = 0;
    go(amplitude), go(-amplitude);
    const double exact =
        8 * friction * friction / ratio * decay * load * (-(1 - q / 2) * std::log1p(-q) - q);
    return std::abs(work / exact - 1);
  };
  // The depth of slip is known to one level, which is thin where slip begins: second order.
  for (const double q : {0.1, 0.5, 0.9}) {
    CAPTURE(q);
    CHECK(error(q, 64) < 0.015);
    CHECK(error(q, 256) < 0.0015);
  }
}

TEST_CASE("Sliding in any direction takes μF, against the motion") {
  const PowerLaw law(1e9, 1.5, ratio);
  ContactElement element(intervals_of(law, 0, 5e-8, 0.2, 32));
  element.start(3e-8, 0, 0);
  for (const double angle : {0.3, 2.0, 4.5}) {
    const std::vector<double> from = element.state();
    const ElementForces forces =
        element.move_to(4e-8, from[1] + 1e-5 * std::cos(angle), from[2] + 1e-5 * std::sin(angle));
    // Earlier stretches of up to 1e-8 m turn the springs by 1e-3 relative to the distance of 1e-5 m
    // and to each other; their sum is shorter by half of the square.
    CHECK(size_of(forces) == Approx(0.2 * forces.normal_force).epsilon(1e-6));
    CHECK(std::atan2(forces.tangential_force[1], forces.tangential_force[0]) ==
          Approx(angle > pi ? angle - 2 * pi : angle).margin(3e-3));
  }
}

TEST_CASE("An element knows no direction") {
  const ExponentialLaw law(10, 1e-7, ratio);
  const auto springs = intervals_of(law, -5e-8, 5e-8, 0.3, 32);
  ContactElement straight(springs), turned(springs);
  straight.start(0, 0, 0), turned.start(0, 0, 0);
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const auto& [indentation, x, y] : walk(-5e-8, 5e-8, 3e-8, 200)) {
    const ElementForces a = straight.move_to(indentation, x, y);
    const ElementForces b = turned.move_to(indentation, c * x - s * y, s * x + c * y);
    REQUIRE(b.normal_force == a.normal_force);
    CHECK(b.tangential_force[0] ==
          Approx(c * a.tangential_force[0] - s * a.tangential_force[1]).margin(1e-12 * 3));
    CHECK(b.tangential_force[1] ==
          Approx(s * a.tangential_force[0] + c * a.tangential_force[1]).margin(1e-12 * 3));
  }
}

TEST_CASE("The stiffness of an element is the derivative of its forces") {
  const ExponentialLaw exponential(10, 1e-7, ratio);
  const PowerLaw sphere(1e9, 1.5, ratio);
  for (const double friction : {0.3, double(INFINITY)})
    for (const ContactLaw* law :
         {static_cast<const ContactLaw*>(&exponential), static_cast<const ContactLaw*>(&sphere)}) {
      ContactElement element(intervals_of(*law, 1e-8, 9e-8, friction, 24));
      element.start(2e-8, 0, 0);
      int compared = 0;
      for (const auto& end : walk(-1e-8, 9e-8, 4e-8, 300)) {
        const ElementForces here = element.forces(end[0], end[1], end[2]);
        for (std::size_t along = 0; along < 3; ++along) {
          // Forces have a kink where a level begins to slip; elsewhere both one-sided differences
          // agree.
          constexpr double step = 1e-14;
          std::array<double, 3> before = end, after = end;
          before[along] -= step, after[along] += step;
          const ElementForces left = element.forces(before[0], before[1], before[2]);
          const ElementForces right = element.forces(after[0], after[1], after[2]);
          for (std::size_t of = 0; of < 3; ++of) {
            const auto part = [&](const ElementForces& forces) {
              return of == 0 ? forces.normal_force : forces.tangential_force[of - 1];
            };
            const double backward = (part(here) - part(left)) / step;
            const double forward = (part(right) - part(here)) / step;
            // Round-off of forces of some N over the step, in N/m.
            const double noise = 20 * 2.2e-16 * (std::abs(part(here)) + 1) / step;
            if (std::abs(backward - forward) > 1e-3 * std::abs(forward) + noise) continue;
            CHECK(here.stiffness[of][along] ==
                  Approx(0.5 * (backward + forward)).epsilon(1e-3).margin(noise));
            ++compared;
          }
        }
        element.move_to(end[0], end[1], end[2]);
      }
      CHECK(compared > 2500);
    }
}

TEST_CASE("A copy of an element and its numbers are states to come back to") {
  const ExponentialLaw law(10, 1e-7, ratio);
  const auto springs = intervals_of(law, -5e-8, 5e-8, 0.3, 32);
  ContactElement element(springs);
  element.start(0, 0, 0);
  const auto path = walk(-5e-8, 5e-8, 3e-8, 40);
  for (int i = 0; i < 20; ++i) element.move_to(path[i][0], path[i][1], path[i][2]);
  ContactElement copy = element, restored(springs);
  restored.restore(element.state());
  element.forces(9e-8, 1e-6, 0);  // the step is not taken
  for (int i = 20; i < 40; ++i) {
    const auto expected = element.move_to(path[i][0], path[i][1], path[i][2]);
    CHECK(copy.move_to(path[i][0], path[i][1], path[i][2]).tangential_force ==
          expected.tangential_force);
    CHECK(restored.move_to(path[i][0], path[i][1], path[i][2]).tangential_force ==
          expected.tangential_force);
  }
  CHECK_THROWS_WITH(restored.restore(std::vector<double>{1.0, 2.0}),
                    Catch::Contains("numbers do not match the number of springs"));
}

TEST_CASE("An element that parts has no force, and forgets") {
  for (const double friction : {0.3, double(INFINITY)}) {
    const ExponentialLaw law(10, 1e-7, ratio);
    ContactElement element(intervals_of(law, -1e-7, 1e-7, friction, 32));
    element.start(0, 0, 0);
    CHECK(size_of(element.move_to(0, 1e-8, 2e-8)) > 0);
    // 1e-6 of the highest force lies 14 decay lengths below it, and the tangent reaches one
    // further.
    const ElementForces apart = element.move_to(-2e-6, 5e-7, 0);
    CHECK(apart.normal_force == 0);
    CHECK(size_of(apart) == 0);
    CHECK(apart.stiffness[0][0] == 0);
    // Springs that touch again at the same position are free of stress.
    CHECK(size_of(element.move_to(0, 5e-7, 0)) < 1e-12);
    // All springs stick at first, except in levels as thin as the depth that slips in 1e-9 m.
    CHECK(element.move_to(0, 5e-7 + 1e-9, 0).tangential_force[0] ==
          Approx(law.tangential_stiffness(0) * 1e-9).epsilon(0.02));
  }
}

TEST_CASE("Levels say what they cannot do") {
  const ExponentialLaw law(10, 1e-7, ratio);
  CHECK_THROWS_WITH(LawSprings(law, 0, 1e-8, {.friction_coefficient = -1}),
                    Catch::Contains("friction_coefficient"));
  CHECK_THROWS_WITH(LawSprings(law, 0, 1e-8, {.springs = 2}), Catch::Contains("springs"));
  CHECK_THROWS_WITH(LawSprings(law, 1e-8, 0), Catch::Contains("lowest"));
  CHECK_THROWS_WITH(LawSprings(PowerLaw(1e9, 1.5, ratio), -2e-8, -1e-8),
                    Catch::Contains("without contact"));
  ForceCurve falling{.model = "measured", .nominal_area = 1, .samples = {}};
  for (const double at : {1e-8, 2e-8, 3e-8, 4e-8, 5e-8, 6e-8})
    falling.samples.push_back({.indentation = at, .force = std::sqrt(at)});
  CHECK_THROWS_WITH(LawSprings(TabulatedLaw(falling, ratio), 2e-8, 5e-8),
                    Catch::Contains("falls by more than scatter"));
  CHECK_THROWS_WITH(ContactElement(nullptr), Catch::Contains("intervals"));
}
