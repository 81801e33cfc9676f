// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders on a spring: stick–slip, its suppression, and the averaged equation.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <vector>

#include "damping/slider_equation.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

constexpr double ratio = 0.7 / 0.85;  // G*/E* at ν = 0.3
constexpr double friction = 0.3;
constexpr double omega = 2 * pi * 20e3;
constexpr OperatingPoint load = at_force(0.02);

// The contact of docs/howto/stick_slip.md, and a sphere whose contact opens in the larger motions.
const ExponentialLaw rough(0.02, 30e-9, ratio);
const PowerLaw sphere(1e9, 1.5, ratio);

// √(k/m) = ω/slowness.
Slider slider_of(double mass, double slowness, double velocity, double support, double slope) {
  return {.mass = mass,
          .spring_stiffness = mass * std::pow(omega / slowness, 2),
          .velocity = velocity,
          .support_damping = support,
          .falling_slope = slope};
}

}  // namespace

TEST_CASE("A slider with falling friction on a rigid contact has the cycle of its closed form",
          "[slider]") {
  // Without oscillation T = μF during slip. With e = x − Vt minus its value in steady sliding, (bV
  // − μF)/k, a slip obeys m e'' − b e' + k e = 0. It begins when the spring has reached μF at rest,
  // −k(x − Vt) = μF: e = −bV/k, e' = −V. It grows, since b > 0, until e' = −V again; then the
  // slider sticks and e falls by V t to −bV/k, where the next slip begins. The duration of slip is
  // the root of e' = −V.
  const Slider slider{.mass = 0.01, .spring_stiffness = 1000, .velocity = 5e-5, .falling_slope = 1};
  const double limit = friction * load.value;
  const double growth = slider.falling_slope / (2 * slider.mass);
  const double frequency = std::sqrt(slider.spring_stiffness / slider.mass - growth * growth);
  const double begin = -slider.falling_slope * slider.velocity / slider.spring_stiffness;
  const double sine = (-slider.velocity - growth * begin) / frequency;
  const auto offset = [&](double t) {
    return std::exp(growth * t) *
           (begin * std::cos(frequency * t) + sine * std::sin(frequency * t));
  };
  const auto speed = [&](double t) {
    return std::exp(growth * t) * ((growth * begin + frequency * sine) * std::cos(frequency * t) +
                                   (growth * sine - frequency * begin) * std::sin(frequency * t));
  };
  const auto root = [&](double low, double high, double value) {
    const bool falls = speed(low) > value;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      ((speed(middle) > value) == falls ? low : high) = middle;
    }
    return low;
  };
  // tan(ω₁t) at the turning points: first the minimum of e, half a turn later the maximum.
  const double turn =
      std::atan2(-(growth * begin + frequency * sine), growth * sine - frequency * begin);
  const double first = (turn < 0 ? turn + pi : turn) / frequency, second = first + pi / frequency;
  const double slip = root(second, second + 0.5 * pi / frequency, -slider.velocity);
  const double stick = (offset(slip) - begin) / slider.velocity;
  const double amplitude = 0.5 * (offset(second) - offset(first));

  const NormalOscillation none{};
  const SliderMotion averaged = averaged_slider_motion(rough, load, none, slider, friction);
  REQUIRE(averaged.converged);
  CHECK(averaged.state == SliderState::stick_slip);
  // Turning points by parabolas through samples 2π/256 apart have errors of some 1e-8 of the range,
  // and the period of 1e-7.
  CHECK(averaged.slider_amplitude == Approx(amplitude).epsilon(1e-7));
  CHECK(averaged.slider_period == Approx(slip + stick).epsilon(1e-6));
  CHECK(averaged.max_spring_force == Approx(limit - slider.falling_slope * slider.velocity -
                                            slider.spring_stiffness * offset(first))
                                         .epsilon(1e-8));
  // The means may miss one of 260 samples.
  CHECK(averaged.stuck_fraction == Approx(stick / (slip + stick)).epsilon(4e-3));

  // The full equation has an elastic contact: its difference is proportional to the distance μl/g
  // over which the contact sticks elastically, 4 % of the amplitude for l = 30 nm. The factor
  // depends on the phase in which the contact swings when slip begins.
  for (const double decay_length : {32e-9, 16e-9, 8e-9}) {
    CAPTURE(decay_length);
    const ExponentialLaw law(load.value, decay_length, ratio);
    const SliderMotion full = slider_motion(law, load, none, slider, friction);
    REQUIRE(full.converged);
    CHECK(full.state == SliderState::stick_slip);
    CHECK(std::abs(full.slider_amplitude - amplitude) < 0.4 * friction / ratio * decay_length);
    CHECK(full.slider_period == Approx(slip + stick).epsilon(0.01));
    CHECK(full.mean_tangential_force == Approx(averaged.mean_tangential_force).epsilon(1e-3));
  }
}

TEST_CASE("Where δ is least the state of a sliding contact is its position and velocity",
          "[slider]") {
  // slider_stability() relies on this: a run of many periods continues like one that begins with
  // all springs at their limit.
  const Slider slider = slider_of(0.002, 40, 4e-5, 0, 0.5);
  const detail::SliderContact contact{rough, 0, 3e-9, omega, friction};
  detail::SliderEquation whole(contact, slider, 32), restarted(contact, slider, 32);
  whole.begin(-0.99 * friction * load.value / slider.spring_stiffness, 1e-5);
  for (int i = 0; i < 60; ++i) {
    whole.advance();
    REQUIRE(whole.min_velocity() > 0);
  }
  const double offset = whole.offset(), velocity = whole.relative_velocity();
  restarted.begin(offset, velocity);
  whole.advance();
  restarted.advance();
  CHECK(restarted.offset() - offset == Approx(whole.offset() - offset).epsilon(1e-6));
  CHECK(restarted.relative_velocity() - velocity ==
        Approx(whole.relative_velocity() - velocity).epsilon(1e-6));
  // This does not hold while the slider sticks.
  whole.begin(-0.5 * friction * load.value / slider.spring_stiffness, -slider.velocity);
  whole.advance();
  CHECK(std::abs(whole.tangential_force()) < 0.99 * whole.slid_force());
}

TEST_CASE("Steps of a slider are of second order, through stick and slip", "[slider]") {
  // The slider sticks, opens or slides, in one or two of its swings.
  struct Run {
    const ContactLaw* law;
    double amplitude, mass, velocity;
    int periods;
  };
  for (const Run& run : {Run{&rough, 2e-9, 0.002, 2e-5, 60}, Run{&rough, 30e-9, 0.002, 5e-4, 90},
                         Run{&sphere, 4e-7, 0.01, 3e-3, 60}}) {
    CAPTURE(run.amplitude, run.velocity);
    const double indentation = run.law->indentation_of(run.law == &rough ? 0.02 : 0.15);
    const Slider slider = slider_of(run.mass, 30, run.velocity, 0.1, 0.3);
    const auto end = [&](int steps) {
      detail::SliderEquation equation({*run.law, indentation, run.amplitude, omega, friction},
                                      slider, steps);
      equation.begin(-1.02 * equation.slid_force() / slider.spring_stiffness, -slider.velocity);
      for (int i = 0; i < run.periods; ++i) equation.advance();
      return equation.offset();
    };
    const double exact = end(2048);
    const double coarse = end(16) - exact, fine = end(128) - exact;
    // Eight times as many steps: the error falls 64 times at second order, 8 times at first. It is
    // uneven, because events fall on the end of a step for one number of steps and not for another.
    CHECK(std::abs(coarse / fine) > 30);
    // The scale of the motion is V√(m/k).
    CHECK(std::abs(fine) < 1e-3 * slider.velocity / (omega / 30));
  }
}

TEST_CASE("The energies of a slider balance", "[slider]") {
  struct Run {
    double amplitude, slope;
    SliderState state;
  };
  for (const Run& run : {Run{0.2e-9, 3, SliderState::stick_slip}, Run{2e-9, 1, SliderState::steady},
                         Run{1.1e-9, 1, SliderState::pulsating}}) {
    CAPTURE(run.amplitude);
    const Slider slider = slider_of(0.002, 30, 5e-5, 0.05, run.slope);
    SliderOptions options;
    options.tolerance = 0.05;
    const NormalOscillation normal{run.amplitude, omega};
    const SliderMotion motion = slider_motion(rough, load, normal, slider, friction, options);
    REQUIRE(motion.converged);
    CHECK(motion.state == run.state);
    // The trapezoidal rule over steps of 2π/64, in a balance in which T and ẋ vary by some per
    // cent.
    CHECK(motion.energy_error < 1e-5);
    CHECK(motion.contact_power > 0);
    CHECK(motion.support_power >= 0);
    CHECK(motion.falling_slope_power >=
          slider.falling_slope * slider.velocity * slider.velocity * (1 - 1e-3));
    CHECK((motion.stuck_fraction > 0) == (run.state == SliderState::stick_slip));
    // The mean force of the drive is that of friction minus its falling part.
    CHECK(motion.drive_power / slider.velocity ==
          Approx(motion.mean_tangential_force - slider.falling_slope * slider.velocity)
              .epsilon(2e-3));
    const SliderMotion averaged =
        averaged_slider_motion(rough, load, normal, slider, friction, options);
    CHECK(averaged.energy_error < 1e-10);
    CHECK(averaged.state == run.state);
  }
}

TEST_CASE("The full equation of a slider tends to the averaged one in first order", "[slider]") {
  // k ∝ ε, m ∝ 1/ε: the averaged equation is the same in the time εt and the length εx, while
  // √(k/m)/ω and K_t/(mω²) fall with ε.
  std::vector<double> amplitudes, forces;
  for (const double scale : {1., 0.5, 0.25}) {
    CAPTURE(scale);
    const Slider slider = slider_of(0.0008 / scale, 30 / scale, 5e-5, 0, 1);
    SliderOptions options;
    options.tolerance = 1e-3;
    const NormalOscillation normal{1.1e-9, omega};
    const SliderMotion full = slider_motion(rough, load, normal, slider, friction, options),
                       averaged =
                           averaged_slider_motion(rough, load, normal, slider, friction, options);
    REQUIRE(full.converged);
    REQUIRE(averaged.converged);
    CHECK(full.state == SliderState::pulsating);
    CHECK(averaged.state == SliderState::pulsating);
    amplitudes.push_back(full.slider_amplitude / averaged.slider_amplitude - 1);
    forces.push_back(full.mean_tangential_force / averaged.mean_tangential_force - 1);
  }
  // The ratio is 2 at order 1. It is 1.88 and 1.93 for the amplitudes, which have 5 % of second
  // order at ε = 1, and step errors of 1e-4.
  CHECK(std::abs(amplitudes[0]) < 0.1);
  for (std::size_t i = 1; i < amplitudes.size(); ++i) {
    CHECK(amplitudes[i - 1] / amplitudes[i] == Approx(2).margin(0.2));
    CHECK(forces[i - 1] / forces[i] == Approx(2).margin(0.2));
  }
}

TEST_CASE("The oscillation that stabilises a slider is the linear estimate's within its error",
          "[slider]") {
  struct Case {
    const ContactLaw* law;
    OperatingPoint point;
    double mass, slowness, velocity, support, slope, largest;
  };
  // K_t/(mω²) is 0.035 for 1 g on the rough contact: the error is then up to half of dT̄/dv.
  const Case cases[] = {
      {&rough, load, 0.001, 50, 20e-6, 0, 3, 50e-9},
      {&rough, load, 0.001, 50, 50e-6, 0, 1, 50e-9},
      {&rough, load, 0.001, 50, 100e-6, 0.5, 5, 50e-9},
      {&rough, load, 0.01, 50, 20e-6, 0, 3, 50e-9},
      {&rough, load, 0.01, 15, 50e-6, 0.2, 1, 50e-9},
      {&rough, load, 0.01, 250, 1e-3, 0, 2, 50e-9},
      {&sphere, at_force(0.2), 0.001, 50, 3e-3, 0.2, 1, 400e-9},
      {&sphere, at_force(0.2), 0.001, 20, 20e-3, 0, 0.5, 1e-6},
      {&sphere, at_force(0.2), 0.01, 50, 3e-3, 0.2, 1, 400e-9},
      {&sphere, at_force(0.2), 0.003, 50, 20e-3, 0, 0.5, 1e-6},
  };
  int number = 0;
  for (const Case& one : cases) {
    CAPTURE(++number);
    const Slider slider = slider_of(one.mass, one.slowness, one.velocity, one.support, one.slope);
    const SliderThreshold threshold =
        threshold_amplitude(*one.law, one.point, {one.largest, omega}, slider, friction);
    // A thousandth is allowed for the steps of the full equation.
    CHECK(std::abs(threshold.linear_estimate - threshold.value) <
          threshold.linear_estimate_error + 1e-3 * threshold.value);
    // The estimate is the threshold of dT̄/dv.
    CHECK(steady_sliding(*one.law, one.point, Drag{threshold.linear_estimate, one.velocity, omega},
                         friction)
              .sliding_damping == Approx(one.slope - one.support).epsilon(1e-6));
    if (one.mass > 0.001) continue;
    // Simulated in time: a tenth below the threshold sliding breaks down, a tenth above
    // disturbances decay.
    SliderOptions options;
    options.start = SliderStart::sliding;
    options.tolerance = 0.1;
    const auto state_at = [&](double part) {
      return slider_motion(*one.law, one.point, {part * threshold.value, omega}, slider, friction,
                           options)
          .state;
    };
    CHECK(state_at(0.9) != SliderState::steady);
    CHECK(state_at(1.1) == SliderState::steady);
  }
}

TEST_CASE("A threshold over frequency is that over amplitude, read the other way", "[slider]") {
  const Slider slider = slider_of(0.01, 50, 50e-6, 0, 1);
  const SliderThreshold amplitude =
      threshold_amplitude(rough, load, {50e-9, omega}, slider, friction);
  const SliderThreshold frequency =
      threshold_angular_frequency(rough, load, {amplitude.value, 10 * omega}, slider, friction);
  CHECK(frequency.value == Approx(omega).epsilon(1e-6));
  CHECK(threshold_angular_frequency(rough, load, {amplitude.linear_estimate, 10 * omega}, slider,
                                    friction)
            .linear_estimate == Approx(omega).epsilon(1e-9));
  // The damping is at most 3 N s/m at this velocity.
  Slider steep = slider;
  steep.falling_slope = 20;
  CHECK(std::isnan(threshold_amplitude(rough, load, {50e-9, omega}, steep, friction).value));
  CHECK(std::isnan(
      threshold_amplitude(rough, load, {50e-9, omega}, steep, friction).linear_estimate));
  // If the estimate is reached below four natural frequencies, it lies outside the range, and its
  // error is unknown. The full equation has its threshold further up.
  const SliderThreshold below =
      threshold_angular_frequency(rough, load, {200e-9, 10 * omega}, slider, friction);
  CHECK(std::isnan(below.linear_estimate));
  CHECK(std::isnan(below.linear_estimate_error));
  CHECK(below.value > 4.01 * std::sqrt(slider.spring_stiffness / slider.mass));
}

TEST_CASE("A slider on a tabulated contact with its own K_t slides as its averages say",
          "[slider]") {
  ForceCurve curve;
  for (int k = 0; k <= 400; ++k) {
    const double indentation = 30e-9 * (-8 + 10.0 * k / 400);
    ForceSample sample;
    sample.indentation = indentation;
    sample.force = rough.force(indentation);
    sample.normal_stiffness = rough.normal_stiffness(indentation);
    sample.tangential_stiffness = 0.9 * rough.tangential_stiffness(indentation);
    sample.converged = true;
    curve.samples.push_back(sample);
  }
  const TabulatedLaw table(curve, ratio);
  const Slider slider = slider_of(0.02, 60, 4e-5, 0.5, 0.5);
  const NormalOscillation normal{3e-9, omega};
  const SliderMotion full = slider_motion(table, load, normal, slider, friction),
                     averaged = averaged_slider_motion(table, load, normal, slider, friction);
  CHECK(full.state == SliderState::steady);
  CHECK(averaged.state == SliderState::steady);
  // Both are off by less than K_t/(mω²) = 0.0016, by which the mass yields. The springs below the
  // table, with 3e-4 of the force, slip by the law's G*/E* instead of its K_t/K.
  CHECK(full.mean_tangential_force == Approx(averaged.mean_tangential_force).epsilon(1e-3));
  CHECK(averaged.mean_tangential_force ==
        Approx(steady_sliding(table, load, Drag{3e-9, slider.velocity, omega}, friction)
                   .mean_tangential_force)
            .epsilon(1e-4));
}

TEST_CASE("A slider that holds its mean force has no largest oscillation", "[slider]") {
  // l ln 10⁴ = 276 nm is the largest amplitude about a held indentation.
  const Slider slider{.mass = 0.01, .spring_stiffness = 1000, .velocity = 5e-5, .falling_slope = 1};
  const NormalOscillation large{300e-9, omega};
  CHECK_THROWS_WITH(slider_stability(rough, load, large, slider, friction),
                    Catch::Contains("hold the mean force"));
  const SliderOptions held{.hold = Hold::force};
  const SliderStability found = slider_stability(rough, load, large, slider, friction, held);
  DampingOptions averages;
  averages.hold = Hold::force;
  const SteadySliding sliding = steady_sliding(
      rough, load, Drag{large.normal_amplitude, slider.velocity, omega}, friction, averages);
  CHECK(found.sliding_damping == sliding.sliding_damping);
  CHECK(averaged_slider_motion(rough, load, large, slider, friction, held).converged);
}

TEST_CASE("Bad input of a slider is named", "[slider]") {
  const Slider good{.mass = 0.01, .spring_stiffness = 1000, .velocity = 5e-5, .falling_slope = 1};
  const auto with = [&](double Slider::*member, double value) {
    Slider slider = good;
    slider.*member = value;
    return slider_motion(rough, load, {1e-9, omega}, slider, friction);
  };
  CHECK_THROWS_WITH(with(&Slider::mass, 0), Catch::StartsWith("mass: 0"));
  CHECK_THROWS_WITH(with(&Slider::mass, -1), Catch::StartsWith("mass: -1"));
  CHECK_THROWS_WITH(with(&Slider::spring_stiffness, 0), Catch::StartsWith("spring_stiffness: 0"));
  CHECK_THROWS_WITH(with(&Slider::velocity, 0), Catch::StartsWith("velocity: 0"));
  CHECK_THROWS_WITH(with(&Slider::velocity, -1e-6), Catch::StartsWith("velocity: -1e-06"));
  CHECK_THROWS_WITH(with(&Slider::support_damping, -1), Catch::StartsWith("support_damping: -1"));
  CHECK_THROWS_WITH(with(&Slider::falling_slope, -1), Catch::StartsWith("falling_slope: -1"));
  CHECK_THROWS_WITH(with(&Slider::falling_slope, NAN), Catch::StartsWith("falling_slope: nan"));
  // μF/b = 6 µm/s.
  CHECK_THROWS_WITH(with(&Slider::falling_slope, 1000),
                    Catch::StartsWith("falling_slope: 1 kN s/m makes friction negative"));
  const auto at = [&](double amplitude, double frequency, double coefficient) {
    return slider_motion(rough, load, {amplitude, frequency}, good, coefficient);
  };
  CHECK_THROWS_WITH(at(-1e-9, omega, friction), Catch::StartsWith("normal_amplitude: -1e-09"));
  CHECK_THROWS_WITH(at(1e-9, 0, friction), Catch::StartsWith("angular_frequency: 0"));
  CHECK_THROWS_WITH(at(1e-9, 1000, friction), Catch::Contains("must be above 4 times"));
  CHECK_THROWS_WITH(at(1e-9, omega, 0), Catch::StartsWith("friction_coefficient: 0"));
  CHECK_THROWS_WITH(at(1e-9, omega, INFINITY), Catch::StartsWith("friction_coefficient: inf"));
  SliderOptions options;
  options.steps = 8;
  CHECK_THROWS_WITH(slider_motion(rough, load, {1e-9, omega}, good, friction, options),
                    Catch::StartsWith("steps: 8"));
  CHECK_THROWS_WITH(threshold_amplitude(rough, load, {1e-8, omega}, {0.01, 1000, 5e-5}, friction),
                    Catch::StartsWith("falling_slope: 0 N s/m must exceed"));
  SliderOptions stopped;
  stopped.on_progress = [](const ProgressReport&) { return false; };
  CHECK_THROWS_AS(slider_motion(rough, load, {1e-9, omega}, good, friction, stopped), Interrupted);
}

TEST_CASE("A slider that takes too many steps is refused, and any other can be stopped",
          "[slider]") {
  const NormalOscillation normal{2e-9, omega};
  // The spring is so soft that the drive loads it for hours.
  Slider soft = slider_of(0.01, 100, 5e-5, 0, 0);
  soft.spring_stiffness *= 1e-9;
  CHECK_THROWS_WITH(slider_motion(rough, load, normal, soft, friction),
                    Catch::Contains("steps: ") && Catch::Contains("needed in a slow cycle"));
  CHECK_THROWS_WITH(averaged_slider_motion(rough, load, normal, soft, friction),
                    Catch::Contains("needed in a slow cycle"));
  // The mass is so light that the contact swings a million times in a period of the oscillation.
  const double stiffness = rough.tangential_stiffness(0);
  const auto of_resonances = [&](double count) {
    return slider_of(stiffness / std::pow(count * omega, 2), 100, 5e-5, 0, 0);
  };
  CHECK_THROWS_WITH(slider_stability(rough, load, normal, of_resonances(1e6), friction),
                    Catch::Contains("needed in a period of the oscillation"));
  const SliderOptions stopped{.on_progress = [](const ProgressReport&) { return false; }};
  CHECK_THROWS_AS(slider_stability(rough, load, normal, of_resonances(1e3), friction, stopped),
                  Interrupted);
  CHECK_THROWS_AS(
      slider_motion(rough, load, normal, slider_of(0.01, 300, 5e-5, 0, 0), friction, stopped),
      Interrupted);
  CHECK_THROWS_AS(averaged_slider_motion(rough, load, normal, slider_of(0.01, 3000, 5e-7, 0, 0),
                                         friction, stopped),
                  Interrupted);
}
