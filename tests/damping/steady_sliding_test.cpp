// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <salebra/damping/trajectory_damping.hpp>

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double ratio = 0.82;   // G*/E*
constexpr double omega = 1.3e5;  // rad/s

const PowerLaw cone(1e12, 2, ratio);
const ExponentialLaw rough(3, 2e-7, ratio);

struct SlidingCase {
  const ContactLaw* law;
  double middle, amplitude, speed;
};
// The last contact opens in every period.
const SlidingCase sliding_cases[] = {{&cone, 1e-6, 4e-7, 0.3},
                                     {&rough, 0, 2e-7, 0.03},
                                     {&rough, 1e-7, 5e-8, 0.8},
                                     {&cone, 2e-7, 5e-7, 0.2}};

// Mean tangential force from the springs simulated on a path of straight steps.
double simulated_force(const ContactLaw& law, double middle, const Drag& motion, double friction,
                       int steps) {
  const SampledMotion path = sample(motion, middle, steps);
  return trajectory_damping(law, path, {.friction_coefficient = friction}).work_per_cycle /
         path.drift();
}

}  // namespace

TEST_CASE("A sliding flat punch has the friction of Popov and Popov", "[sliding]") {
  // A punch that stays closed has F = Kδ, so μ_macro/μ = 1 − (u_z/δ0) R(v/v_c). Another program
  // computed R, in five digits; it is within 0.015 of ¾(r − 1)² + ¼(r − 1)⁴, r = v/v_c, which Popov
  // et al. (2017) fitted to their results.
  const PowerLaw punch(2e6, 1, ratio);
  const double middle = 1e-6, amplitude = 3e-7, friction = 0.4;
  const double critical = friction / ratio * amplitude * omega;
  const std::pair<double, double> values[] = {{0.05, 0.86841}, {0.1, 0.75717}, {0.2, 0.57096},
                                              {0.3, 0.42064},  {0.4, 0.29889}, {0.5, 0.20145},
                                              {0.6, 0.12547},  {0.7, 0.06883}, {0.8, 0.02989},
                                              {0.9, 0.00731},  {1, 0},         {3, 0}};
  for (const auto& [speed, reduction] : values) {
    CAPTURE(speed);
    const SteadySliding sliding = steady_sliding(punch, at_indentation(middle),
                                                 {amplitude, speed * critical, omega}, friction);
    CHECK(sliding.converged);
    CHECK(sliding.critical_velocity == Approx(critical).epsilon(1e-12));
    CHECK((1 - sliding.friction_coefficient / friction) * middle / amplitude ==
          Approx(reduction).margin(5.1e-6));
    CHECK(sliding.relaxation_work == Approx(0).margin(1e-9 * sliding.slip_work));
  }
  CHECK(steady_sliding(punch, at_indentation(middle), {amplitude, 1e-9 * critical, omega}, friction)
            .static_friction_coefficient == Approx(friction * 0.7).epsilon(1e-12));
}

TEST_CASE("At low speed sliding has the damping constant of the stick during a cycle",
          "[sliding]") {
  const double decay_length = 1e-7, amplitude = 3e-8, friction = 0.3;
  const ExponentialLaw law(2, decay_length, ratio);
  const auto at = [&](double part) {
    const double critical = friction / ratio * amplitude * omega;
    return steady_sliding(law, at_force(2), {amplitude, part * critical, omega}, friction);
  };
  // ∫_0^π θ K_t dθ by series of modified Bessel functions: e^{z cosθ} = I_0 + 2ΣI_k cos kθ, ∫θ cos
  // kθ = −2/k² for odd k.
  const double z = amplitude / decay_length;
  double integral = pi * pi / 2 * std::cyl_bessel_i(0., z);
  for (int k = 1; k < 30; k += 2) integral -= 4 * std::cyl_bessel_i(double(k), z) / (double(k) * k);
  // δ has its maximum at θ = 0, where the cosine is +1, so the odd terms reduce the weight there.
  const double stiffness = ratio * 2 / decay_length;
  const double slope = 2 / (pi * omega) * stiffness * integral;
  const SteadySliding slow = at(1e-3);
  CHECK(slow.low_speed_damping == Approx(slope).epsilon(1e-10));
  CHECK(slow.relaxation_damping ==
        Approx(slope - pi * stiffness * std::exp(-z) / omega).epsilon(1e-8));
  CHECK(slow.static_friction_coefficient * slow.mean_force ==
        Approx(friction * 2 * std::exp(-z)).epsilon(1e-12));
  // The rest is proportional to v^{3/2}: it falls 8 times when v falls 4 times, up to a relative
  // term of order v^{1/2}.
  const auto rest = [&](double part) {
    const SteadySliding sliding = at(part);
    const double velocity = part * sliding.critical_velocity;
    return sliding.mean_tangential_force -
           sliding.static_friction_coefficient * sliding.mean_force - slope * velocity;
  };
  for (const double part : {1e-3, 1e-4, 1e-5}) {
    CAPTURE(part);
    CHECK(std::log(rest(part) / rest(part / 4)) / std::log(4.) ==
          Approx(1.5).margin(0.1 * std::sqrt(part / 1e-3) * 0.1 + 2e-3));
  }
  // From v_c on nothing sticks, and the force is μ times the mean normal force F·I_0.
  for (const double part : {1., 1.0000001, 5.})
    CHECK(at(part).mean_tangential_force ==
          Approx(friction * 2 * std::cyl_bessel_i(0., z)).epsilon(1e-10));
  CHECK(at(0.999).mean_tangential_force < friction * 2 * std::cyl_bessel_i(0., z));
}

TEST_CASE("The damping of a sliding contact is the slope of its friction over velocity",
          "[sliding]") {
  for (const SlidingCase& one : sliding_cases) {
    CAPTURE(one.middle, one.amplitude, one.speed);
    const double friction = 0.25, critical = friction / ratio * one.amplitude * omega;
    const auto force_at = [&](double speed) {
      return steady_sliding(*one.law, at_indentation(one.middle),
                            {one.amplitude, speed * critical, omega}, friction)
          .mean_tangential_force;
    };
    const auto slope = [&](double step) {
      return (force_at(one.speed * (1 + step)) - force_at(one.speed * (1 - step))) /
             (2 * step * one.speed * critical);
    };
    const double damping = steady_sliding(*one.law, at_indentation(one.middle),
                                          {one.amplitude, one.speed * critical, omega}, friction)
                               .sliding_damping;
    // Central differences have an error of the square of the step.
    CHECK(slope(1e-3) == Approx(damping).epsilon(1e-5));
    CHECK((slope(0.04) - damping) / (slope(0.02) - damping) == Approx(4).margin(0.1));
  }
  // The damping is Γ as v → 0, and 0 from v_c on. A list of velocities gives the same values.
  const double amplitude = 5e-8, friction = 0.25, critical = friction / ratio * amplitude * omega;
  const double velocities[] = {1e-8 * critical, 0.4 * critical, 2 * critical};
  const auto list = steady_sliding(rough, at_force(3), {amplitude, omega}, velocities, friction);
  CHECK(list[0].sliding_damping == Approx(list[0].low_speed_damping).epsilon(1e-3));
  CHECK(list[2].sliding_damping == 0);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(list[i].mean_tangential_force ==
          Approx(steady_sliding(rough, at_force(3), {amplitude, velocities[i], omega}, friction)
                     .mean_tangential_force)
              .epsilon(1e-14));
}

TEST_CASE("Steady sliding is what the springs do, with second order in their steps", "[sliding]") {
  for (const SlidingCase& one : sliding_cases) {
    CAPTURE(one.middle, one.amplitude, one.speed);
    const double friction = 0.25, critical = friction / ratio * one.amplitude * omega;
    const Drag motion{one.amplitude, one.speed * critical, omega};
    const SteadySliding sliding =
        steady_sliding(*one.law, at_indentation(one.middle), motion, friction);
    REQUIRE(sliding.converged);
    const double coarse = simulated_force(*one.law, one.middle, motion, friction, 400);
    const double fine = simulated_force(*one.law, one.middle, motion, friction, 3200);
    const double force = sliding.mean_tangential_force;
    // Steps 8 times smaller are 64 times more accurate at second order, 8 times at first. Slip
    // begins and ends somewhere within a step, which makes the error uneven.
    CHECK(std::abs(fine / force - 1) < 1e-6);
    CHECK(std::abs(fine - force) < std::abs(coarse - force) / 12);
    const TrajectoryDamping path = trajectory_damping(*one.law, sample(motion, one.middle, 3200),
                                                      {.friction_coefficient = friction});
    CHECK(path.slip_work == Approx(sliding.slip_work).epsilon(1e-5).margin(1e-20));
    CHECK(path.relaxation_work == Approx(sliding.relaxation_work).epsilon(1e-4));
  }
}

TEST_CASE("One period from the slid state is what a long way leads to", "[sliding]") {
  std::mt19937 chance(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(chance);
  };
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const double middle = uniform(0.5e-6, 2e-6);
    const std::unique_ptr<ContactLaw> law =
        trial % 2 == 0
            ? std::unique_ptr<ContactLaw>(std::make_unique<PowerLaw>(1e9, uniform(1.2, 3), ratio))
            : std::make_unique<ExponentialLaw>(2, uniform(1e-7, 4e-7), ratio);
    const double friction = uniform(0.1, 1);
    // Any closed path in δ, and a path in x that may turn back while it drifts in either direction.
    const double drift = uniform(0.2e-6, 2e-6) * (trial % 3 == 0 ? -1 : 1),
                 swing = uniform(0, 2e-6);
    const double first = uniform(0, 2 * pi), second = uniform(0, 2 * pi);
    const double amplitude = uniform(0.05, 0.6) * 1e-6;
    SampledMotion path;
    constexpr int steps = 120;
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      path.time.push_back(t);
      path.indentation.push_back(
          middle + amplitude * (std::cos(2 * pi * (k % steps) / steps) +
                                0.4 * std::cos(4 * pi * (k % steps) / steps + first)));
      path.displacement.push_back(
          drift * t + swing * (std::sin(2 * pi * (k % steps) / steps + second) - std::sin(second)));
    }
    const TrajectoryDamping steady =
        trajectory_damping(*law, path, {.friction_coefficient = friction});
    // Starts from rest and follows the path until the deepest relevant spring has been dragged
    // along. Springs of exponential laws below 30 l carry 1e-13 of the force.
    const double lowest = std::ranges::min(path.indentation),
                 highest = std::ranges::max(path.indentation);
    const double depth = trial % 2 == 0 ? highest : highest + 32 * 4e-7;
    const double way = friction / ratio * depth * 2 + 3 * std::abs(drift) + 2 * swing;
    const int periods = static_cast<int>(way / std::abs(drift)) + 2;
    TangentialContact contact(*law, lowest, highest,
                              {.friction_coefficient = friction, .tangential_range = INFINITY});
    contact.start(path.indentation[0], path.displacement[0]);
    double before = 0;
    for (int period = 0; period < periods; ++period) {
      before = contact.dissipated();
      for (int k = 1; k <= steps; ++k)
        contact.move_to(path.indentation[k], path.displacement[k] + drift * period);
    }
    CHECK(contact.dissipated() - before == Approx(steady.work_per_cycle).epsilon(1e-9));
    CHECK(contact.tangential_force() == Approx(steady.tangential_force[0])
                                            .epsilon(1e-9)
                                            .margin(1e-9 * friction * law->force(highest)));
  }
}

TEST_CASE("Springs below the samples of a table slide along", "[sliding]") {
  // The table begins at a tenth of the force; the springs below carry the rest in both.
  const double decay_length = 1e-7;
  const ExponentialLaw whole(1, decay_length, ratio);
  ForceCurve curve;
  for (int k = 0; k <= 400; ++k) {
    const double indentation = decay_length * (-2.3 + 4.6 * k / 400);
    ForceSample sample;
    sample.indentation = indentation;
    sample.force = whole.force(indentation);
    sample.normal_stiffness = whole.normal_stiffness(indentation);
    sample.converged = true;
    curve.samples.push_back(sample);
  }
  const TabulatedLaw table(curve, ratio);
  const SampledMotion path = sample(Drag{5e-8, 1e-3, omega}, 0, 500);
  const TrajectoryDamping expected = trajectory_damping(whole, path, {.friction_coefficient = 0.3});
  const TrajectoryDamping found = trajectory_damping(table, path, {.friction_coefficient = 0.3});
  // The table has cubics through 87 samples in each l.
  CHECK(found.work_per_cycle == Approx(expected.work_per_cycle).epsilon(1e-6));
  CHECK(found.slip_work == Approx(expected.slip_work).epsilon(1e-6));
  CHECK(found.tangential_force[250] == Approx(expected.tangential_force[250]).epsilon(1e-6));
  // Work and loss balance over a period of the steady state.
  TangentialContact contact(table, -5e-8, 5e-8,
                            {.friction_coefficient = 0.3, .tangential_range = INFINITY});
  contact.slide(path.indentation[0], 0, 1);
  const double force = contact.tangential_force();
  CHECK(force == Approx(0.3 * table.force(-5e-8)).epsilon(1e-9));
  for (std::size_t k = 1; k < path.time.size(); ++k)
    contact.move_to(path.indentation[k], path.displacement[k] - path.displacement[0]);
  CHECK(contact.tangential_force() == Approx(force).epsilon(1e-9));
  CHECK(contact.external_work() == Approx(contact.dissipated()).epsilon(1e-9));
  // Backwards, all of them slide the other way. The tolerance is that of the table of K_t, whose
  // slope is infinite at first touch.
  contact.move_to(-5e-8, -2e-6);
  CHECK(contact.tangential_force() == Approx(-0.3 * table.force(-5e-8)).epsilon(1e-7));
}

TEST_CASE("A drag far too short for sliding to begin has its steady state all the same",
          "[sliding]") {
  // A drag of 0.5 nm per period would need 10⁵ periods to stretch the springs that never open to
  // their limit at μ = 100.
  const ExponentialLaw law(1, 1e-7, 1.4 / 1.7);
  const Drag motion{2e-8, 1e-5, 2 * pi * 20e3};
  const auto followed =
      trajectory_damping(law, sample(motion, 0, 2000), {.friction_coefficient = 100});
  const auto slid = steady_sliding(law, at_indentation(0), motion, 100);
  // 2000 straight steps; slip begins at the phase v/v_c = 3e-5 rad, less than one step.
  CHECK(followed.work_per_cycle == Approx(slid.relaxation_work + slid.slip_work).epsilon(1e-4));
}

TEST_CASE("Bad input of steady sliding is named", "[sliding]") {
  const PowerLaw law(1e9, 1.5, ratio);
  const auto at = [&](double friction, double velocity, double amplitude = 1e-7) {
    return steady_sliding(law, at_indentation(1e-6), {amplitude, velocity, omega}, friction);
  };
  CHECK_THROWS_WITH(at(0.3, 0), Catch::StartsWith("drag_velocity: 0"));
  CHECK_THROWS_WITH(at(0.3, -1), Catch::StartsWith("drag_velocity: -1"));
  CHECK_THROWS_WITH(at(-0.1, 1), Catch::StartsWith("friction_coefficient: -0.1"));
  CHECK_THROWS_WITH(at(INFINITY, 1), Catch::StartsWith("friction_coefficient: inf"));
  CHECK_THROWS_AS(at(0.3, 1, -1), InvalidInput);
  // Without friction nothing resists, and without oscillation Coulomb's law holds.
  CHECK(at(0, 1).mean_tangential_force == 0);
  const SteadySliding still = at(0.3, 1e-9, 0);
  CHECK(still.friction_coefficient == Approx(0.3).epsilon(1e-12));
  CHECK(std::isnan(still.low_speed_damping));
  TangentialContact stuck(law, 0, 1e-6);
  CHECK_THROWS_WITH(stuck.slide(1e-6, 0, 1), Catch::StartsWith("friction_coefficient"));
}
