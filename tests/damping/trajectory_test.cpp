// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/trajectory_damping.hpp>

using namespace salebra;
namespace cf = salebra::closed_form;
using std::numbers::pi;

namespace {

constexpr double ratio = 0.8;

EqualFrequency equal_frequency(double amplitude, double phase) {
  return {.normal_amplitude = amplitude,
          .tangential_amplitude = 2e-7,
          .phase = phase,
          .angular_frequency = 50};
}

Drag slow_drag(double amplitude) {
  return {.normal_amplitude = amplitude, .drag_velocity = 1e-4, .angular_frequency = 300};
}

}  // namespace

TEST_CASE("Sampled harmonic motion meets the theorem at second order in its step", "[trajectory]") {
  const double indentation = 1e-6;
  const double amplitude = GENERATE(1e-8, 5e-7, 1e-6, 1.5e-6);
  const PowerLaw law(1e9, GENERATE(1.5, 2.0), ratio);
  for (const Oscillation& motion :
       {Oscillation(equal_frequency(amplitude, 0.7)), Oscillation(slow_drag(amplitude))}) {
    CAPTURE(amplitude, law.exponent(), motion.index());
    const DampingResult exact = relaxation_damping(law, at_indentation(indentation), motion);
    auto at = [&](int steps) {
      return trajectory_damping(law, sample(motion, indentation, steps));
    };
    auto error = [&](int steps) {
      return std::abs(at(steps).work_per_cycle / exact.work_per_cycle - 1);
    };
    const double coarse = error(200), fine = error(800);
    // Straight steps cut the corners of a circle, by about (Δθ)²/12.
    CHECK(fine < 4e-5);
    CHECK(std::log2(coarse / fine) / 2 == Approx(2).margin(0.25));
    const TrajectoryDamping result = at(800);
    CHECK(result.power == Approx(exact.power).epsilon(1e-4));
    CHECK(result.damping_constant == Approx(exact.damping_constant).epsilon(1e-4));
    CHECK(result.slip_work == 0);
  }
}

TEST_CASE("The loop's area is the loss, and the mean drag force times v is the power",
          "[trajectory]") {
  const double indentation = 1e-6;
  const PowerLaw law(1e9, 1.5, ratio);
  const auto motion = equal_frequency(4e-7, 0.5);
  const SampledMotion path = sample(motion, indentation, 4000);
  const TrajectoryDamping loop = trajectory_damping(law, path);
  auto force_work = [](const SampledMotion& trajectory, const std::vector<double>& force) {
    double work = 0;
    for (std::size_t i = 1; i < force.size(); ++i)
      work += 0.5 * (force[i] + force[i - 1]) *
              (trajectory.displacement[i] - trajectory.displacement[i - 1]);
    return work;
  };
  // Trapezoidal rule with 4000 steps.
  CHECK(force_work(path, loop.tangential_force) == Approx(loop.work_per_cycle).epsilon(1e-5));
  CHECK(loop.dissipated.front() == 0);
  CHECK(loop.dissipated.back() == loop.work_per_cycle);
  CHECK(std::ranges::is_sorted(loop.dissipated));

  const SampledMotion dragged = sample(slow_drag(4e-7), indentation, 4000);
  const TrajectoryDamping drag = trajectory_damping(law, dragged);
  // The permanent core is left out: it is stretched without end and loses nothing.
  CHECK(force_work(dragged, drag.tangential_force) == Approx(drag.work_per_cycle).epsilon(1e-5));
  CHECK(drag.tangential_force.front() == Approx(drag.tangential_force.back()).margin(1e-12));
  CHECK(std::isnan(drag.storage_stiffness));
}

TEST_CASE("A trajectory may begin anywhere in its period", "[trajectory]") {
  const PowerLaw law(1e9, 1.5, ratio);
  SampledMotion path = sample(slow_drag(4e-7), 1e-6, 360);
  const TrajectoryDamping whole = trajectory_damping(law, path);
  const double friction = 0.3;
  const TrajectoryDamping rubbed = trajectory_damping(
      law, sample(equal_frequency(4e-7, 0.5), 1e-6, 360), {.friction_coefficient = friction});
  const std::size_t shift = 100, count = path.time.size() - 1;
  auto rotate = [&](const SampledMotion& from) {
    SampledMotion turned;
    for (std::size_t i = 0; i <= count; ++i) {
      const std::size_t at = i + shift;
      const bool wraps = at > count;
      turned.time.push_back(wraps ? from.time[at - count] + from.period() : from.time[at]);
      turned.indentation.push_back(from.indentation[wraps ? at - count : at]);
      turned.displacement.push_back(wraps ? from.displacement[at - count] + from.drift()
                                          : from.displacement[at]);
    }
    return turned;
  };
  const TrajectoryDamping turned = trajectory_damping(law, rotate(path));
  CHECK(turned.work_per_cycle == Approx(whole.work_per_cycle).epsilon(1e-12));
  CHECK(turned.tangential_force[0] == Approx(whole.tangential_force[shift]).epsilon(1e-12));
  CHECK(turned.dissipated[50] ==
        Approx(whole.dissipated[shift + 50] - whole.dissipated[shift]).epsilon(1e-10));
  CHECK(turned.dissipated[count - 20] ==
        Approx(whole.work_per_cycle + whole.dissipated[shift - 20] - whole.dissipated[shift])
            .epsilon(1e-10));
  const TrajectoryDamping turned_rubbed =
      trajectory_damping(law, rotate(sample(equal_frequency(4e-7, 0.5), 1e-6, 360)),
                         {.friction_coefficient = friction});
  CHECK(turned_rubbed.work_per_cycle == Approx(rubbed.work_per_cycle).epsilon(1e-10));
}

TEST_CASE("Tangential motion alone is elastic: K_t and no loss", "[trajectory]") {
  const PowerLaw law(1e9, 1.5, ratio);
  const TrajectoryDamping result = trajectory_damping(law, sample(equal_frequency(0, 0), 1e-6, 64));
  CHECK(result.storage_stiffness == Approx(law.tangential_stiffness(1e-6)).epsilon(1e-12));
  CHECK(result.work_per_cycle == 0);
  CHECK(result.loss_factor == 0);
  CHECK(std::isnan(
      trajectory_damping(law, sample(EqualFrequency{1e-7, 0, 0, 50}, 1e-6, 64)).damping_constant));
}

TEST_CASE("Two frequencies: closed form, theorem and trajectory are one", "[trajectory]") {
  const double indentation = 1e-6, amplitude = 6e-7, curvature = 2e9;
  const PowerLaw cone(curvature / 2, 2, ratio), paraboloid(1e9, 1.5, ratio);
  struct Ratio {
    int p, q;
  };
  const Ratio cycles = GENERATE(Ratio{1, 1}, Ratio{2, 1}, Ratio{3, 1}, Ratio{3, 2}, Ratio{1, 2},
                                Ratio{5, 3}, Ratio{2, 3}, Ratio{20, 1});
  const TwoFrequencies motion{amplitude, 2e-7, 0.4, 300, 300.0 * cycles.q / cycles.p};
  CAPTURE(cycles.p, cycles.q);
  const CommonPeriod period = common_period(motion);
  CHECK(period.normal_cycles == cycles.p);
  CHECK(period.tangential_cycles == cycles.q);
  const DampingResult result = relaxation_damping(cone, at_indentation(indentation), motion);
  const double closed = 2 * ratio * curvature * 4e-14 * amplitude *
                        cf::frequency_ratio_phase_sum(cycles.p, 0.4) *
                        cf::frequency_ratio_integral(static_cast<double>(cycles.q) / cycles.p);
  CHECK(result.work_per_cycle == Approx(closed).epsilon(1e-10));
  CHECK(result.small_amplitude_work == Approx(closed).epsilon(1e-12));
  for (const PowerLaw& law : {cone, paraboloid}) {
    const TrajectoryDamping followed = trajectory_damping(law, sample(motion, indentation, 1000));
    const DampingResult theorem = relaxation_damping(law, at_indentation(indentation), motion);
    // Second order in 2π/1000 of the normal cycle and 2πr/1000 of the tangential one.
    CHECK(followed.work_per_cycle == Approx(theorem.work_per_cycle).epsilon(1e-4));
    CHECK(followed.power == Approx(theorem.power).epsilon(1e-4));
    CHECK(followed.damping_constant == Approx(theorem.damping_constant).epsilon(1e-4));
  }
}

TEST_CASE("Frequencies without a common period have the mean power of their neighbours",
          "[trajectory]") {
  const PowerLaw law(1e9, 1.5, ratio);
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  const TwoFrequencies motion{6e-7, 2e-7, 0.4, 300, 300 * golden};
  const DampingResult mean = relaxation_damping(law, at_indentation(1e-6), motion);
  CHECK(std::isnan(mean.work_per_cycle));
  TwoFrequencies near = motion;
  near.tangential_angular_frequency = 300.0 * 377 / 610;
  CHECK(mean.power ==
        Approx(relaxation_damping(law, at_indentation(1e-6), near).power).epsilon(1e-4));
  CHECK_THROWS_WITH(sample(motion, 1e-6, 100), Catch::Contains("common period"));
  // A slow tangential motion is the tunable damper of case (b).
  TwoFrequencies slow = motion;
  slow.tangential_angular_frequency = 300 * 1e-4 * golden;
  CHECK(relaxation_damping(law, at_indentation(1e-6), slow).damping_constant ==
        Approx(relaxation_damping(law, at_indentation(1e-6), slow_drag(6e-7)).damping_constant)
            .epsilon(1e-6));
}

TEST_CASE("Finite friction: W(μ)/W(∞) tends to 1 as docs/theory.md, section 8 says",
          "[trajectory]") {
  // For a cone at small u_z, M = μE*u_z/(G*u_x) is the only parameter.
  const PowerLaw law(1e9, 2, ratio);
  const double indentation = 1e-6, amplitude = 1e-8;
  auto loss = [&](double M, double phase) {
    EqualFrequency motion = equal_frequency(amplitude, phase);
    motion.tangential_amplitude = 1e-8;
    const SampledMotion path = sample(motion, indentation, 4000);
    const double friction = M * ratio * motion.tangential_amplitude / amplitude;
    const TrajectoryDamping with =
        trajectory_damping(law, path, {.friction_coefficient = friction});
    return with.work_per_cycle / trajectory_damping(law, path).work_per_cycle;
  };
  // Leading coefficients, up to the next order at M = 20 and 40.
  CHECK((1 - loss(20, pi / 2)) * 400 == Approx(0.5).epsilon(0.05));
  CHECK((1 - loss(40, pi / 4)) * 40 == Approx(0.67).epsilon(0.05));
}

TEST_CASE("Slip and relaxation part as friction grows and as the normal motion dies",
          "[trajectory]") {
  const PowerLaw law(1e9, 1.5, ratio);
  const SampledMotion path = sample(equal_frequency(3e-7, 1.0), 1e-6, 1000);
  const double relaxation = trajectory_damping(law, path).work_per_cycle;
  double last_slip = INFINITY;
  for (const double friction : {0.3, 1.0, 3.0, 1000.0}) {
    const TrajectoryDamping result =
        trajectory_damping(law, path, {.friction_coefficient = friction});
    CHECK(result.work_per_cycle ==
          Approx(result.slip_work + result.relaxation_work).epsilon(1e-14));
    CHECK(result.slip_work <= last_slip);
    last_slip = result.slip_work;
  }
  const TrajectoryDamping rough = trajectory_damping(law, path, {.friction_coefficient = 1e5});
  CHECK(rough.relaxation_work == Approx(relaxation).epsilon(1e-4));
  CHECK(rough.slip_work < 1e-8 * relaxation);
  // Without normal motion the whole loss is Mindlin's slip.
  const TrajectoryDamping still = trajectory_damping(law, sample(equal_frequency(0, 0), 1e-6, 400),
                                                     {.friction_coefficient = 0.2});
  CHECK(still.relaxation_work == Approx(0).margin(1e-12 * still.work_per_cycle));
  CHECK(still.work_per_cycle > 0);
}

TEST_CASE("With friction a drag ends in sliding at μF", "[trajectory]") {
  const PowerLaw law(1e9, 1.5, ratio);
  Drag motion = slow_drag(0);
  motion.drag_velocity = 1e-4;
  const double friction = 0.3;
  const TrajectoryDamping result =
      trajectory_damping(law, sample(motion, 1e-6, 50), {.friction_coefficient = friction});
  CHECK(result.tangential_force[20] == Approx(friction * law.force(1e-6)).epsilon(1e-9));
}

TEST_CASE("Trajectories that are not one period are refused with the reason", "[trajectory]") {
  const PowerLaw law(1e9, 1.5, ratio);
  const SampledMotion good = sample(equal_frequency(3e-7, 1.0), 1e-6, 100);
  auto refuse = [&](auto&& spoil, const std::string& reason) {
    SampledMotion bad = good;
    spoil(bad);
    CHECK_THROWS_WITH(trajectory_damping(law, bad), Catch::Contains(reason));
  };
  refuse([](SampledMotion& t) { t.indentation.back() += 1e-8; }, "one whole period");
  refuse([](SampledMotion& t) { t.time[5] = t.time[4]; }, "not later");
  refuse([](SampledMotion& t) { t.displacement[5] = NAN; }, "not finite");
  refuse([](SampledMotion& t) { t.displacement.pop_back(); }, "the same number of");
  refuse([](SampledMotion& t) { t = {{0, 1}, {0, 0}, {0, 0}}; }, "samples given");
  CHECK_THROWS_AS(sample(equal_frequency(3e-7, 1.0), 1e-6, 2), InvalidInput);
  CHECK_THROWS_AS(trajectory_damping(law, good, {.friction_coefficient = -1}), InvalidInput);
}

TEST_CASE("The force of a periodic motion does not depend on where its samples begin") {
  // Under a constant load T runs between ∓T of the joint: springs that never slip are free of
  // stress in the middle of the motion, wherever its record begins.
  const ExponentialLaw law(10, 1e-7, 0.8);
  const double friction = 0.3, amplitude = 1e-8;
  const double expected =
      joint_loss(law, at_indentation(0), TangentialAmplitude{amplitude}, friction).tangential_force;
  for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
    SampledMotion path;
    for (int i = 0; i <= 400; ++i) {
      path.time.push_back(i);
      path.indentation.push_back(0);
      path.displacement.push_back(3e-8 + amplitude * std::cos(2 * pi * (i % 400 / 400.0 + phase)));
    }
    const auto force =
        trajectory_damping(law, path, {.friction_coefficient = friction}).tangential_force;
    // 400 steps include both ends; the rest is round-off of the table of K_t.
    CHECK(std::ranges::max(force) == Approx(expected).epsilon(1e-9));
    CHECK(std::ranges::min(force) == Approx(-expected).epsilon(1e-9));
  }
}
