// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <vector>

using namespace salebra;
using std::numbers::pi;

namespace {

constexpr double ratio = 0.8;

}  // namespace

TEST_CASE("A tangential oscillator decays by γ under fast normal oscillation", "[damper]") {
  // Compares the equation of motion with the full history of the contact to the linear damper.
  const PowerLaw law(1e9, 2, ratio);
  const double mean = 1e-6, amplitude = 4e-7, slow = 1;
  const double kept = law.tangential_stiffness(mean - amplitude);
  const int per_cycle = 64, fast = 200;  // normal cycles in one tangential cycle
  const NormalOscillation normal{amplitude, fast * slow};
  const TangentialOscillator oscillator{.mass = 3 * kept, .spring_stiffness = 2 * kept};
  const OscillatorDecay decay = oscillator_decay(law, at_indentation(mean), normal, oscillator);
  CHECK(decay.natural_frequency == Approx(slow).epsilon(1e-12));
  CHECK(decay.contact_stiffness == Approx(kept).epsilon(1e-14));
  CHECK(decay.frequency_ratio == Approx(1.0 / fast).epsilon(1e-12));
  CHECK(decay.decay_time == Approx(2 * oscillator.mass / decay.damping_constant).epsilon(1e-12));

  TangentialContact contact(law, mean - amplitude, mean + amplitude);
  const double step = 2 * pi / (fast * per_cycle);
  double x = 1e-9, v = 0;
  contact.start(mean - amplitude, 0);
  contact.move_to(mean - amplitude, x);
  double a = -(oscillator.spring_stiffness * x + contact.tangential_force()) / oscillator.mass;
  const int cycles = 10;
  for (int i = 1; i <= cycles * fast * per_cycle; ++i) {
    x += step * (v + 0.5 * step * a);
    contact.move_to(mean - amplitude * std::cos(2 * pi * (i % per_cycle) / per_cycle), x);
    const double next =
        -(oscillator.spring_stiffness * x + contact.tangential_force()) / oscillator.mass;
    v += 0.5 * step * (a + next);
    a = next;
  }
  const double energy = 0.5 * (v * v + slow * slow * x * x) / (0.5 * 1e-18);
  const double time = 2 * pi * cycles;
  // The force of separating springs has a ripple and a mean shift of order ω0/ω = 0.5 % of γ.
  CHECK(-std::log(energy) / time == Approx(2 / decay.decay_time).epsilon(0.02));
}

TEST_CASE("Decay numbers agree among each other, overdamped too", "[damper]") {
  const ExponentialLaw law(1, 1e-7, ratio);
  const NormalOscillation normal{5e-8, 1e3};
  const OscillatorDecay light =
      oscillator_decay(law, at_force(1), normal, {.mass = 1000, .spring_stiffness = 1});
  CHECK(light.damping_ratio < 1);
  CHECK(light.quality_factor == Approx(0.5 / light.damping_ratio));
  CHECK(light.decay_time ==
        Approx(1 / (light.damping_ratio * light.natural_frequency)).epsilon(1e-12));
  CHECK(light.logarithmic_decrement == Approx(2 * pi * light.damping_ratio).epsilon(0.5));
  const OscillatorDecay heavy =
      oscillator_decay(law, at_force(1), normal, {.mass = 1e-9, .spring_stiffness = 0});
  CHECK(heavy.damping_ratio > 1);
  CHECK(std::isnan(heavy.logarithmic_decrement));
  // Far in the overdamped range the mass does not matter: x decays with γ/k.
  CHECK(heavy.decay_time == Approx(heavy.damping_constant / heavy.contact_stiffness).epsilon(1e-3));
  CHECK_THROWS_WITH(oscillator_decay(law, at_force(1), normal, {.mass = 0}),
                    Catch::Contains("mass"));
  const PowerLaw cone(1e9, 2, ratio);
  CHECK_THROWS_WITH(oscillator_decay(cone, at_indentation(1e-8), normal, {.mass = 1}),
                    Catch::Contains("opens"));
}

TEST_CASE("The stabilising amplitude is where γ meets the falling slope", "[damper]") {
  const double decay_length = 1e-7, omega = 1e5;
  const ExponentialLaw law(1, decay_length, ratio);
  const double wanted = 0.3 * decay_length;
  const DampingResult at = relaxation_damping(law, at_force(2), Drag{wanted, 1, omega});
  CHECK(stabilising_amplitude(law, at_force(2), omega, at.damping_constant, 1e-6) ==
        Approx(wanted).epsilon(1e-9));
  // Small amplitude, Eq. (16): u_z = πωl²b/((π² − 4)(G*/E*)F).
  const double slope = 1e-4 * at.damping_constant;
  CHECK(stabilising_amplitude(law, at_force(2), omega, slope, 1e-6) ==
        Approx(pi * omega * decay_length * decay_length * slope / ((pi * pi - 4) * ratio * 2))
            .epsilon(1e-4));
  // With the mean force held γ has a maximum over u_z; beyond it no amplitude helps.
  const DampingOptions weight{.hold = Hold::force};
  double most = 0;
  for (double k = 0.5; k < 20; k += 0.1)
    most = std::max(most,
                    relaxation_damping(law, at_force(2), Drag{k * decay_length, 1, omega}, weight)
                        .damping_constant);
  CHECK(std::isnan(stabilising_amplitude(law, at_force(2), omega, 1.01 * most, 2e-6, weight)));
  CHECK(stabilising_amplitude(law, at_force(2), omega, 0.9 * most, 2e-6, weight) > 0);
  CHECK_THROWS_AS(stabilising_amplitude(law, at_force(2), omega, 0, 1e-6), InvalidInput);
}

TEST_CASE("The stabilising amplitude of a measured curve is that of the law behind it",
          "[damper]") {
  // A sampled exponential curve: the table interpolates ln F linearly and so reproduces it. δ is
  // far from 0, as if counted from first touch: the search must not reach amplitudes at which the
  // sweep is lost in the last digits of δ.
  const double decay_length = 3e-8, omega = 1e5, area = 1e-10, highest = 2.5e-7;
  ForceCurve curve{.model = "made", .nominal_area = area};
  for (int i = 0; i <= 40; ++i) {
    const double indentation = 5e-9 * i + highest - 2e-7;
    const double force = 1e-2 * std::exp((indentation - 2e-7) / decay_length);
    curve.samples.push_back({.indentation = indentation, .force = force, .pressure = force / area});
  }
  const TabulatedLaw table(curve, ratio);
  const ExponentialLaw law(1, decay_length, ratio);
  for (const double slope : {1e-3, 1e-1, 1.0})
    CHECK(stabilising_amplitude(table, at_force(1e-2), omega, slope, 4e-8) ==
          Approx(stabilising_amplitude(law, at_force(1e-2), omega, slope, 4e-8)).epsilon(1e-6));
}

TEST_CASE("The damper map is γ of each amplitude over each frequency", "[damper]") {
  const ExponentialLaw law(1, 1e-7, ratio);
  const DamperMap map = damper_map(law, at_force(1), {1e-9, 1e-8, 1e-7}, {1e3, 1e5});
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 2; ++j) {
      const Drag motion{map.normal_amplitude[static_cast<std::size_t>(i)], 1,
                        map.angular_frequency[static_cast<std::size_t>(j)]};
      CHECK(map.damping_constant(i, j) ==
            Approx(relaxation_damping(law, at_force(1), motion).damping_constant).epsilon(1e-12));
    }
  CHECK_THROWS_AS(damper_map(law, at_force(1), {1e-9}, {0}), InvalidInput);
}

TEST_CASE("The friction map tends to the paper's result for large M and to none for small",
          "[damper]") {
  const PowerLaw law(1e9, 2, ratio);
  const FrictionMap map =
      friction_map(law, 1e-6, 1e-8, 1e-8, {1e-3, 1, 1000}, {0.0, 0.3, pi / 2}, {.steps = 200});
  CHECK(std::isnan(map.loss_ratio(1, 0)));
  for (Index j = 1; j < 3; ++j) {
    CHECK(map.loss_ratio(2, j) == Approx(1).epsilon(0.01));
    CHECK(map.slip_ratio(2, j) < 1e-6);
    CHECK(map.relaxation_ratio(0, j) < 0.1);
    CHECK(map.loss_ratio(1, j) ==
          Approx(map.slip_ratio(1, j) + map.relaxation_ratio(1, j)).epsilon(1e-12));
  }
  CHECK_THROWS_AS(friction_map(law, 1e-6, 0, 1e-8, {1}, {1}), InvalidInput);
  CHECK_THROWS_AS(friction_map(law, 1e-6, 1e-8, 1e-8, {-1}, {1}), InvalidInput);
}
