// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the assumptions of a damping constant against scaling laws, closed forms and simulated
// paths.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/results/assumption_verdicts.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

constexpr double ratio = 0.8;

ForceCurve exponential_curve(double length) {
  ForceCurve curve;
  for (int i = 0; i <= 60; ++i) {
    ForceSample sample;
    sample.indentation = length * (i - 40) / 5;
    sample.force = std::exp(sample.indentation / length);
    sample.normal_stiffness = sample.force / length;
    // Its own K_t, 10 % above (G*/E*)K.
    sample.tangential_stiffness = 1.1 * ratio * sample.normal_stiffness;
    curve.samples.push_back(sample);
  }
  return curve;
}

/// A path over X and back, `cycles` normal cycles in each direction, with turning points `offset`
/// steps after the smallest indentation.
SampledMotion turning_at(const Drag& drag, double mean, int cycles, int steps, int offset) {
  SampledMotion path;
  for (int i = 0; i <= 2 * cycles * steps; ++i) {
    const double angle = 2 * pi * i / steps;
    path.time.push_back(angle / drag.angular_frequency);
    path.indentation.push_back(mean - drag.normal_amplitude *
                                          std::cos(2 * pi * ((i + offset) % steps) / steps));
    path.displacement.push_back(drag.drag_velocity / drag.angular_frequency *
                                std::min(angle, 4 * pi * cycles - angle));
  }
  return path;
}

/// Losses of a normal cycle, averaged over sixteen phases of the turning points.
struct TurningLoss {
  double stick = 0, work = 0, slip_work = 0;
};
TurningLoss loss_of_turning(const ContactLaw& law, const Drag& drag, double mean, int cycles,
                            double friction) {
  constexpr int phases = 16, steps = 320;
  TurningLoss loss;
  for (int phase = 0; phase < phases; ++phase) {
    const SampledMotion path =
        turning_at(drag, mean, cycles, steps, (2 * phase + 1) * steps / (2 * phases));
    const double part = 1.0 / (phases * 2 * cycles);
    const TrajectoryDamping slips =
        trajectory_damping(law, path, {.friction_coefficient = friction});
    loss.stick += part * trajectory_damping(law, path).work_per_cycle;
    loss.work += part * slips.work_per_cycle;
    loss.slip_work += part * slips.slip_work;
  }
  return loss;
}

}  // namespace

TEST_CASE("Slip limits are where the simulated path loses 5 and 20 % more or less",
          "[assumptions]") {
  const double mean = 1e-6;
  const PowerLaw cone(1e9, 2, ratio), paraboloid(1e7, 1.5, ratio);
  const ExponentialLaw exponential(1, 1e-7, ratio);
  const TabulatedLaw table(exponential_curve(1e-7), ratio);
  struct Case {
    const ContactLaw* law;
    double mean;
    Oscillation motion;
    double friction;
  };
  const auto equal = [](double amplitude, double phase) {
    return EqualFrequency{
        .normal_amplitude = amplitude, .tangential_amplitude = 1e-8, .phase = phase};
  };
  const Case cases[] = {
      {&cone, mean, equal(2e-7, pi / 2), 0.3},      {&paraboloid, mean, equal(5e-7, pi / 4), 0.1},
      {&paraboloid, mean, equal(1.2e-6, 2.3), 1},   {&exponential, 0, equal(1e-8, 3 * pi / 4), 0.2},
      {&table, 0, equal(4e-8, pi / 2), 0.5},        {&cone, mean, Drag{1e-7, 1e-3, 1e5}, 0.3},
      {&exponential, 0, Drag{3e-8, 1e-3, 1e5}, 0.2}};
  for (const Case& one : cases) {
    CAPTURE(&one - cases);
    const Assumptions assumptions =
        assumptions_of(*one.law, one.mean, one.motion, {.friction_coefficient = one.friction});
    const Assumption& opening = assumptions.slip_of_opening_springs;
    // With this friction the same motion has the M of the limit.
    const auto change_at = [&](double limit) {
      const double friction = one.friction * limit / opening.value;
      const SampledMotion path = sample(one.motion, one.mean, 2000);
      const double stick = trajectory_damping(*one.law, path).work_per_cycle;
      const TrajectoryDamping loss =
          trajectory_damping(*one.law, path, {.friction_coefficient = friction});
      return std::abs(
          (std::holds_alternative<Drag>(one.motion) ? loss.relaxation_work : loss.work_per_cycle) /
              stick -
          1);
    };
    // 2 % around the limit, where the change is proportional to 1/M or 1/M².
    CHECK(change_at(0.98 * opening.limit_5_percent) > 0.05);
    CHECK(change_at(1.02 * opening.limit_5_percent) < 0.05);
    CHECK(change_at(0.98 * opening.limit_20_percent) > 0.2);
    CHECK(change_at(1.02 * opening.limit_20_percent) < 0.2);
    CHECK(opening.limit_5_percent > opening.limit_20_percent);
  }
  // The path of a slide in one direction would leave the table; its K_t is proportional to that of
  // the law.
  for (const Oscillation& motion :
       {Oscillation(Drag{1e-7, 1e-3, 1e5}), Oscillation(equal(3e-8, 1))}) {
    const ContactParameters parameters{.friction_coefficient = 0.5};
    // The table has cubics through 5 samples in each l.
    CHECK(assumptions_of(table, 0, motion, parameters).slip_of_opening_springs.limit_5_percent ==
          Approx(assumptions_of(exponential, 0, motion, parameters)
                     .slip_of_opening_springs.limit_5_percent)
              .epsilon(1e-3));
  }
}

TEST_CASE("Limits of slip scale with mu/g and with the lengths of the contact", "[assumptions]") {
  const auto limits = [](double scale, double modulus_ratio, double friction, double drag) {
    const ExponentialLaw law(7, 1e-7 * scale, modulus_ratio);
    Oscillation motion = EqualFrequency{2e-8 * scale, 1e-9 * scale, 1.0};
    if (drag > 0) motion = Drag{2e-8 * scale, drag * scale, 1e5};
    return assumptions_of(law, 0, motion, {.friction_coefficient = friction});
  };
  for (const double drag : {0.0, 1e-8}) {
    const Assumptions one = limits(1, 0.8, 0.3, drag), larger = limits(5, 0.8, 0.3, drag);
    const double more = 2 * (0.6 / 0.3) * (0.8 / 0.7) / 2;  // of μ/g
    const Assumptions rougher = limits(1, 0.7, 0.6, drag * more);
    // The limits are bisected to 1e-6.
    CHECK(larger.slip_of_opening_springs.limit_5_percent ==
          Approx(one.slip_of_opening_springs.limit_5_percent).epsilon(1e-4));
    CHECK(larger.slip_of_closed_springs.limit_5_percent ==
          Approx(5 * one.slip_of_closed_springs.limit_5_percent).epsilon(1e-4));
    CHECK(rougher.slip_of_opening_springs.limit_20_percent ==
          Approx(one.slip_of_opening_springs.limit_20_percent).epsilon(1e-4));
    CHECK(rougher.slip_of_closed_springs.limit_20_percent ==
          Approx(more * one.slip_of_closed_springs.limit_20_percent).epsilon(1e-4));
    CHECK(larger.amplitude.limit_5_percent ==
          Approx(5 * one.amplitude.limit_5_percent).epsilon(1e-4));
  }
}

TEST_CASE("A flat punch slips where Coulomb's limit of its one level is passed", "[assumptions]") {
  const IndenterLaw law(flat_punch_profile(1e-3), Material::of_contact_modulus(1e9, 0.3));
  const double mean = 1e-6, amplitude = 3e-7, stretch = 0.3 / law.modulus_ratio();
  // |x| <= (μ/g)(δ0 + u_z sin ωt) with x = u_x cos ωt at 90°: u_x = (μ/g)√(δ0² − u_z²).
  const Assumptions equal = assumptions_of(law, mean, EqualFrequency{amplitude, 1e-8, pi / 2},
                                           {.friction_coefficient = 0.3});
  const double onset = stretch * std::sqrt(mean * mean - amplitude * amplitude);
  CHECK(equal.slip_of_closed_springs.limit_5_percent == Approx(onset).epsilon(1e-3));
  CHECK(equal.slip_of_closed_springs.verdict == Verdict::holds);
  // With both turning points at the limit: X = 2(μ/g)δ_min.
  const Assumptions drag =
      assumptions_of(law, mean, Drag{amplitude, 1e-6, 1e5},
                     {.friction_coefficient = 0.3, .excursion = 3 * stretch * (mean - amplitude)});
  CHECK(drag.slip_of_closed_springs.limit_5_percent ==
        Approx(2 * stretch * (mean - amplitude)).epsilon(1e-2));
  CHECK(drag.slip_of_closed_springs.verdict == Verdict::broken);
}

TEST_CASE("A table of constant stiffness has no levels but the noise of its last digits",
          "[assumptions]") {
  ForceCurve punch;
  for (int i = 1; i <= 20; ++i) {
    ForceSample sample;
    sample.indentation = 1e-8 * i;
    sample.force = 3.3e3 * sample.indentation;
    punch.samples.push_back(sample);
  }
  const TabulatedLaw law(punch, ratio);
  for (const Oscillation& motion :
       {Oscillation(EqualFrequency{5e-8, 1e-9, 1}), Oscillation(Drag{5e-8, 1e-9, 1})}) {
    const Assumptions assumptions =
        assumptions_of(law, 1e-7, motion, {.friction_coefficient = 0.3});
    CHECK(assumptions.amplitude.verdict == Verdict::holds);
    CHECK(assumptions.slip_of_opening_springs.verdict != Verdict::unknown);
  }
}

TEST_CASE("The excursion of a slow motion is limited by slip of the closed levels",
          "[assumptions]") {
  const ExponentialLaw law(1, 1e-7, ratio);
  const double friction = 0.3;
  for (const int cycles : {3, 10, 40}) {
    CAPTURE(cycles);
    Drag drag{2e-8, 0, 1e5};
    // Slow enough for the limit to be near an excursion of that many cycles.
    const double number = 1.5 * std::pow(cycles / 0.238, 2);
    drag.drag_velocity = friction / ratio * drag.normal_amplitude * drag.angular_frequency / number;
    const TurningLoss simulated = loss_of_turning(law, drag, 0, cycles, friction);
    const double excursion = cycles * 2 * pi * drag.drag_velocity / drag.angular_frequency;
    const Loss loss = loss_with_slip(law, 0, drag, friction, excursion);
    INFO(loss.slip_work / simulated.slip_work - 1 << ' '
                                                  << loss.work_per_cycle / simulated.work - 1);
    // Exact to first order in a normal cycle over the excursion; 360 steps miss 1e-3.
    CHECK(loss.slip_work == Approx(simulated.slip_work).epsilon(0.1 / (cycles * cycles) + 3e-3));
    CHECK(loss.work_per_cycle == Approx(simulated.work).epsilon(0.1 / (cycles * cycles) + 3e-3));
    const Assumptions assumptions =
        assumptions_of(law, 0, drag, {.friction_coefficient = friction, .excursion = excursion});
    // The slip share is proportional to X².
    const double steady = relaxation_damping(law, at_indentation(0), drag).work_per_cycle;
    const double expected = excursion * std::sqrt(0.05 * steady / simulated.slip_work);
    CHECK(assumptions.slip_of_closed_springs.limit_5_percent ==
          Approx(expected).epsilon(1.0 / cycles));
  }
  // The example of many introductions: 1 mm/s, 1 nm, 20 kHz, l = 30 nm.
  const ExponentialLaw rough(1, 3e-8, ratio);
  const Assumptions fast =
      assumptions_of(rough, 0, Drag{1e-9, 1e-3, 2 * pi * 2e4}, {.friction_coefficient = 0.3});
  CHECK(fast.slip_of_opening_springs.verdict == Verdict::broken);
  CHECK(fast.slip_of_closed_springs.verdict == Verdict::broken);
  CHECK(fast.slip_of_closed_springs.limit_20_percent == 0);
  CHECK(fast.largest.front().excursion == 0);
}

TEST_CASE("The turning points of a slow motion cost what the simulated path misses",
          "[assumptions]") {
  const double mean = 1e-6;
  const ExponentialLaw shallow(1, 1e-7, ratio), deep(1, 3e-8, ratio);
  const PowerLaw opened(1e7, 1.5, ratio), cone(1e9, 2, ratio);
  struct Case {
    const ContactLaw* law;
    double amplitude;
  };
  for (const Case& one :
       {Case{&shallow, 1e-8}, Case{&deep, 3e-8}, Case{&opened, 1.3e-6}, Case{&cone, 1e-7}}) {
    CAPTURE(one.amplitude);
    const Drag drag{one.amplitude, 1e-6, 1e5};
    const double way = 2 * pi * drag.drag_velocity / drag.angular_frequency;
    const double steady = relaxation_damping(*one.law, at_indentation(mean), drag).work_per_cycle;
    for (const int cycles : {2, 9}) {
      const Assumption slow =
          assumptions_of(*one.law, mean, drag, {.excursion = cycles * way}).slow_motion;
      CHECK(slow.value == Approx(cycles));
      constexpr int phases = 16, steps = 320;
      double loss = 0;
      for (int phase = 0; phase < phases; ++phase)
        loss += trajectory_damping(*one.law, turning_at(drag, mean, cycles, steps,
                                                        (2 * phase + 1) * steps / (2 * phases)))
                    .work_per_cycle /
                phases;
      // Straight steps miss up to 1e-3 of the whole; a mean over 16 phases is the mean over all to
      // 1e-3 of the cost of a turning point.
      CHECK(1 - loss / (2 * cycles * steady) ==
            Approx(0.05 * slow.limit_5_percent / cycles).margin(1e-3));
      CHECK(slow.limit_20_percent == Approx(std::max(1.0, slow.limit_5_percent / 4)));
    }
  }
  // Constant K_t', with the midpoint rule of second order.
  const double exact = 2.0 / 3 * (pi * pi - 6) / (pi * pi - 4);
  const auto judged = [&](double cycles) {
    const Drag drag{1e-7, 1e-6, 1e5};
    return assumptions_of(cone, mean, drag, {.excursion = cycles * 2 * pi * 1e-11}).slow_motion;
  };
  CHECK(judged(2).limit_5_percent == Approx(exact / 0.05).epsilon(1e-4));
  CHECK(judged(9).verdict == Verdict::holds);
  CHECK(judged(8).verdict == Verdict::doubtful);
  CHECK(judged(2).verdict == Verdict::broken);
  // A contact that touches for a moment loses little at a turning point, but no excursion below w
  // is slow.
  const PowerLaw tip(1e7, 1.5, ratio);
  const ContactParameters half{.excursion = 0.99 * 2 * pi * 1e-11};
  const Assumption brief = assumptions_of(tip, -9.9e-7, Drag{1e-6, 1e-6, 1e5}, half).slow_motion;
  CHECK(brief.limit_20_percent == 1);
  CHECK(brief.verdict == Verdict::broken);
  // Two frequencies and case (a) follow the motion itself, so nothing has to be slow.
  CHECK(assumptions_of(cone, mean, EqualFrequency{1e-7, 1e-9, 1}, half).slow_motion.verdict ==
        Verdict::holds);
  const Drag drag{1e-7, 1e-6, 1e5};
  CHECK(assumptions_of(cone, mean, drag).slow_motion.needs == "excursion");
  CHECK(assumptions_of(cone, mean, Drag{1e-7, ContactParameters::unknown, 1e5}, half)
            .slow_motion.needs == "drag_velocity");
}

TEST_CASE("A sine is slow where a triangle is", "[assumptions]") {
  // Excursion 2u_x, v² the mean square velocity: X/w = √2 ω_z/(π ω_x). A triangle needs more
  // cycles, so a sine within its limits is off by less.
  for (const auto& [change, limit] : {std::pair{0.05, 8.79}, std::pair{0.2, 2.198}}) {
    const double r = std::sqrt(2) / (pi * limit);
    CHECK((pi * pi - 4) * r * r / closed_form::frequency_ratio_integral(r) - 1 < change);
  }
}

TEST_CASE("The loss with slip is that of the simulated path", "[assumptions]") {
  const PowerLaw law(1e7, 1.5, ratio);
  for (const Oscillation& motion :
       {Oscillation(EqualFrequency{3e-7, 1e-7, 1.0}), Oscillation(Drag{3e-7, 1e-2, 1e5})}) {
    const TrajectoryDamping path =
        trajectory_damping(law, sample(motion, 1e-6, 2000), {.friction_coefficient = 0.3});
    const Loss loss = loss_with_slip(law, 1e-6, motion, 0.3);
    // 360 steps instead of 2000, at second order.
    CHECK(loss.work_per_cycle == Approx(path.work_per_cycle).epsilon(1e-3));
    CHECK(loss.relaxation_work == Approx(path.relaxation_work).epsilon(1e-3));
    CHECK(loss.slip_work == Approx(path.slip_work).epsilon(1e-3));
    const double stuck = relaxation_damping(law, at_indentation(1e-6), motion).work_per_cycle;
    CHECK(loss.work_per_cycle_without_slip == Approx(stuck).epsilon(1e-6));
  }
}

TEST_CASE("The limit of amplitude is where the closed forms of the exponential law part",
          "[assumptions]") {
  const double length = 1e-7;
  const ExponentialLaw law(1, length, ratio);
  const Assumptions drag = assumptions_of(law, 0, Drag{1e-9, 1, 1e5}),
                    equal = assumptions_of(law, 0, EqualFrequency{6e-8, 1e-9, pi / 2, 1e5});
  const auto off = [&](const Oscillation& motion) {
    const DampingResult result = relaxation_damping(law, at_indentation(0), motion);
    return std::abs(result.small_amplitude_work / result.work_per_cycle - 1);
  };
  CHECK(off(Drag{drag.amplitude.limit_5_percent, 1, 1e5}) == Approx(0.05).epsilon(1e-3));
  CHECK(off(Drag{drag.amplitude.limit_20_percent, 1, 1e5}) == Approx(0.2).epsilon(1e-3));
  // W/Eq. (12) = 4(k cosh k − sinh k)/k³·3/4 = 1 + k²/10 + …: 20/19 at k = 0.72.
  CHECK(off(EqualFrequency{equal.amplitude.limit_5_percent, 1, pi / 2}) ==
        Approx(0.05).epsilon(1e-3));
  CHECK(equal.amplitude.limit_5_percent == Approx(0.72 * length).epsilon(0.02));
  CHECK(drag.amplitude.verdict == Verdict::holds);
  // F'' of a cone is constant, so only a contact that opens changes it.
  const PowerLaw cone(1e9, 2, ratio);
  CHECK(assumptions_of(cone, 1e-6, Drag{1e-7, 1, 1e5}).amplitude.limit_5_percent > 1e-6);
}

TEST_CASE("Assumptions name what they need, and refuse parameters that cannot be",
          "[assumptions]") {
  const ExponentialLaw law(1, 1e-7, ratio);
  const Drag motion{1e-9, 1e-6, 1e5};
  const Assumptions bare = assumptions_of(law, 0, motion);
  CHECK(bare.slip_of_opening_springs.needs == "friction_coefficient");
  CHECK(bare.slip_of_opening_springs.limit_5_percent > 1);
  CHECK(bare.plasticity.needs == "hardness");
  CHECK(bare.inertia.needs == "density");
  REQUIRE(bare.largest.size() == 3);
  CHECK(bare.largest[2].drag_velocity == Approx(10 * bare.largest[0].drag_velocity));
  // v at the limit has the M of the limit.
  ContactParameters parameters{.friction_coefficient = 0.3};
  Drag slow = motion;
  slow.drag_velocity = bare.largest[1].drag_velocity;
  const Assumption at_limit = assumptions_of(law, 0, slow, parameters).slip_of_opening_springs;
  CHECK(at_limit.value == Approx(at_limit.limit_5_percent).epsilon(1e-6));
  CHECK(assumptions_of(law, 0, motion, parameters).slip_of_closed_springs.needs == "excursion");
  slow.drag_velocity = ContactParameters::unknown;
  CHECK(assumptions_of(law, 0, slow, parameters).slip_of_opening_springs.needs == "drag_velocity");

  parameters = {.hardness = 1e9,
                .density = 8000,
                .contact_modulus = 1e11,
                .loaded_size = 1e-3,
                .nominal_pressure = 1e8,
                .mean_contact_pressure = 5e8};
  const Assumptions known = assumptions_of(law, 0, motion, parameters);
  CHECK(known.plasticity.value == Approx(0.75));
  CHECK(known.plasticity.verdict == Verdict::doubtful);
  CHECK(known.plasticity.onset == 0.6);
  CHECK(std::isnan(known.plasticity.limit_5_percent));
  // ν = 1/3, G = G*(2 − ν)/4 = 33.3 GPa, c_s = 2041 m/s.
  CHECK(known.inertia.value == Approx(1e5 * 1e-3 / 2041).epsilon(1e-3));
  // The effect of coupling on a slow motion is unknown. ν = 0 has G* = E*, where it is largest.
  CHECK(known.coupling.verdict == Verdict::unknown);
  const EqualFrequency equal{.normal_amplitude = 1e-9,
                             .tangential_amplitude = 1e-9,
                             .phase = std::numbers::pi / 4,
                             .angular_frequency = 1e5};
  const auto coupling = [&](const ContactLaw& contact, double at) {
    return assumptions_of(contact, at, equal).coupling;
  };
  CHECK(coupling(ExponentialLaw(1, 1e-7, 1), 0).verdict == Verdict::doubtful);
  CHECK(coupling(ExponentialLaw(1, 1e-7, 2.0 / 3), 0).value == Approx(0).margin(1e-12));
  // Simulated: 12 % for a paraboloid at 45° and ν = 0.3, at most 4 % for rough surfaces.
  CHECK(
      coupling(IndenterLaw(paraboloid_profile(1e-2), Material::of_contact_modulus(1e9, 0.3)), 1e-6)
          .value == Approx(0.12).epsilon(0.02));
  CHECK(coupling(ExponentialLaw(1, 1e-7, 2 * 0.7 / 1.7), 0).value == Approx(0.04).epsilon(0.02));

  for (const double bad : {0.0, -1.0, double(HUGE_VAL)}) {
    CHECK_THROWS_AS(assumptions_of(law, 0, motion, {.friction_coefficient = bad}), InvalidInput);
    CHECK_THROWS_AS(assumptions_of(law, 0, motion, {.hardness = bad}), InvalidInput);
    CHECK_THROWS_AS(assumptions_of(law, 0, motion, {.density = bad}), InvalidInput);
    CHECK_THROWS_AS(assumptions_of(law, 0, motion, {.excursion = bad}), InvalidInput);
  }
  CHECK_THROWS_AS(assumptions_of(law, 0, motion, {.hardness = 1e6, .nominal_pressure = 2e6}),
                  InvalidInput);
}

TEST_CASE("Numbers beyond what a double can square end in an answer or a refusal",
          "[assumptions]") {
  // Each of these took for ever, or all memory, when tables and searches had no last step.
  for (const double length : {1e308, 1e290, 1e-7, 1e-300})
    for (const double amplitude : {5e-324, 1e-9, 1e300})
      for (const double velocity : {1e-6, 1e300, 5e-324}) {
        INFO("l = " << length << ", u_z = " << amplitude << ", v = " << velocity);
        const ExponentialLaw law(1, length, ratio);
        const Drag drag{amplitude, velocity, 1e5};
        for (const double excursion : {1e-6, 1e300}) {
          try {
            assumptions_of(law, 0, drag, {.friction_coefficient = 0.3, .excursion = excursion});
          } catch (const Error&) {
          }
          try {
            trajectory_damping(law, sample(drag, 0, 32), {.friction_coefficient = 0.3});
          } catch (const Error&) {
          }
        }
      }
  // If the stiffness overflows, so does its table.
  CHECK_THROWS_WITH(TangentialContact(ExponentialLaw(1, 1e-3, ratio), 0, 1, {}),
                    Catch::Contains("overflow"));
}

TEST_CASE("After a first loading the plasticity is the load over the first load", "[assumptions]") {
  const ExponentialLaw law(1, 1e-7, ratio);
  const Drag motion{1e-9, 1e-6, 1e5};
  // Pressures of the residual surface reach the hardness where the first loading did, and nowhere
  // else.
  ContactParameters parameters{.hardness = 1e9, .mean_contact_pressure = 9e8, .rms_slope = 1};
  parameters.contact_modulus = 1e11;
  CHECK(assumptions_of(law, 0, motion, parameters).plasticity.verdict == Verdict::broken);
  parameters.first_load = 1.25;
  const Assumption below = assumptions_of(law, 0, motion, parameters).plasticity;
  // The value at the peak, F exp(u_z/l).
  CHECK(below.value == Approx(0.8 * std::exp(0.01)));
  CHECK(below.verdict == Verdict::holds);
  parameters.first_load = 1;
  CHECK(assumptions_of(law, 0, motion, parameters).plasticity.verdict == Verdict::holds);
  parameters.first_load = 0.99;
  CHECK(assumptions_of(law, 0, motion, parameters).plasticity.verdict == Verdict::broken);
  parameters.first_load = -1;
  CHECK_THROWS_AS(assumptions_of(law, 0, motion, parameters), InvalidInput);
}

TEST_CASE("A sampled path has the assumptions of the motion that it samples", "[assumptions]") {
  const PowerLaw law(1e7, 1.5, ratio);
  const ContactParameters parameters{.friction_coefficient = 0.3};
  for (const Oscillation& motion :
       {Oscillation(EqualFrequency{3e-7, 1e-7, 1.0, 1e5}), Oscillation(Drag{3e-7, 1e-2, 1e5})}) {
    SampledMotion path = sample(motion, 1e-6, 360);
    const double drift = path.drift();
    // A file may begin anywhere in its period.
    for (int i = 1; i <= 100; ++i) {
      const auto at = static_cast<std::size_t>(i);
      path.time.push_back(path.time[360] + path.time[at]);
      path.indentation.push_back(path.indentation[at]);
      path.displacement.push_back(path.displacement[at] + drift);
    }
    for (auto* column : {&path.time, &path.indentation, &path.displacement})
      column->erase(column->begin(), column->begin() + 100);
    const Assumptions whole = assumptions_of(law, 1e-6, motion, parameters),
                      sampled = assumptions_of(law, path, parameters);
    CHECK(sampled.slip_of_opening_springs.value ==
          Approx(whole.slip_of_opening_springs.value).epsilon(1e-3));
    CHECK(sampled.slip_of_opening_springs.limit_5_percent ==
          Approx(whole.slip_of_opening_springs.limit_5_percent).epsilon(1e-3));
    CHECK(sampled.slip_of_closed_springs.limit_20_percent ==
          Approx(whole.slip_of_closed_springs.limit_20_percent).epsilon(2e-3));
    CHECK(sampled.amplitude.verdict == Verdict::holds);
  }
}

namespace {

constexpr double friction = 0.3, stretch = friction / ratio;  // μ/g
const PowerLaw paraboloid(1e7, 1.5, ratio);
const Material material{.contact_modulus = 1e9, .tangential_modulus = ratio * 1e9};

std::vector<double> decades(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(from * std::pow(to / from, double(i) / (count - 1)));
  return values;
}

}  // namespace

TEST_CASE("Sliding begins at Cattaneo's and Mindlin's excursion, and at that of each law",
          "[regimes]") {
  const NormalOscillation normal{1e-8, 1e5};
  const auto border = [&](const ContactLaw& law, double mean) {
    return regime_map(law, mean, normal, {1e-9}, {1e-9}, friction).sliding_excursion;
  };
  // At x = X/2 the springs that never slipped carry F(δ_min − gx/μ), 5 % of the mean force; bisected
  // to round-off.
  const double least = 1e-6 - normal.normal_amplitude;
  const auto share = [&](const ContactLaw& law, double mean) {
    return 0.05 * mean_force_of_cycle(law, mean, normal.normal_amplitude) /
           law.force(mean - normal.normal_amplitude);
  };
  CHECK(border(paraboloid, 1e-6) ==
        Approx(2 * stretch * least * (1 - std::pow(share(paraboloid, 1e-6), 2.0 / 3)))
            .epsilon(1e-11));
  const IndenterLaw sphere(paraboloid_profile(1e-2), material);
  CHECK(border(sphere, 1e-6) == Approx(border(paraboloid, 1e-6)).epsilon(1e-9));
  const IndenterLaw punch(flat_punch_profile(1e-3), material);
  CHECK(border(punch, 1e-6) ==
        Approx(2 * stretch * least * (1 - share(punch, 1e-6))).epsilon(1e-11));
  const PowerLaw square(1e9, 2, ratio);
  CHECK(border(square, 1e-6) ==
        Approx(2 * stretch * least * (1 - std::sqrt(share(square, 1e-6)))).epsilon(1e-11));
  const ExponentialLaw exponential(1, 1e-7, ratio);
  CHECK(border(exponential, 0) ==
        Approx(-2 * stretch * 1e-7 * std::log(share(exponential, 0))).epsilon(1e-11));
  // The table ends four l below and continues as an exponential. Its K_t is 1.1 times as large.
  CHECK(border(TabulatedLaw(exponential_curve(1e-7), ratio), 0) ==
        Approx(border(exponential, 0) / 1.1).epsilon(1e-3));
  CHECK(std::isnan(
      regime_map(paraboloid, 1e-6, {2e-6, 1e5}, {1e-9}, {1e-9}, friction).sliding_excursion));
}

TEST_CASE("A law with a K_t of its own slips at its K_t/K, and a way in sliding loses the friction",
          "[assumptions]") {
  const double length = 1e-7, friction = 0.3, omega = 1e5;
  const TabulatedLaw own(exponential_curve(length), ratio);
  const ExponentialLaw like(1, length, 1.1 * ratio);
  CHECK(own.stiffness_ratio(-2e-8) == Approx(1.1 * ratio).epsilon(1e-12));
  CHECK(own.stiffness_ratio(-1e-5) == Approx(1.1 * ratio).epsilon(1e-12));  // beyond its end
  CHECK(like.stiffness_ratio(0) == 1.1 * ratio);
  const double critical = friction / (1.1 * ratio) * 2e-9 * omega;
  // The table ends four lengths below, at 2 % of the force. A long drag stores energy in its springs
  // twice in 2X, in those below the table 2 % of 6e-3 of the loss; the other motions hardly reach
  // them. The sum over the closed springs is accurate to 3e-4 for the exponential law.
  const auto same = [&](const Oscillation& motion, double excursion) {
    const Loss table = loss_with_slip(own, 0, motion, friction, excursion),
               formula = loss_with_slip(like, 0, motion, friction, excursion);
    CHECK(table.work_per_cycle == Approx(formula.work_per_cycle).epsilon(1e-3));
    CHECK(table.slip_work == Approx(formula.slip_work).epsilon(1e-3));
    return table.work_per_cycle;
  };
  same(EqualFrequency{.normal_amplitude = 2e-8, .tangential_amplitude = 1e-8, .phase = 1}, NAN);
  same(Drag{2e-8, 0.01 * critical, omega}, 2e-8);
  // Ten times faster than springs can stick, over many depths: a turning point stores the work of
  // μF over 1.3 x_c = 1.3 (μ/g)l, twice in 2X.
  const Drag fast{2e-9, 10 * critical, omega};
  const double excursion = 1e-4, stored = 1.3 * friction / ratio * length / excursion;
  CHECK(same(fast, excursion) / (friction * own.force(0) * fast.distance_per_cycle()) ==
        Approx(1).margin(2 * stored + 1e-3));
  // A joint carries μF when all of it slips; at twenty depths it carries (1 − e^{−20}) of that.
  const JointLoss joint =
      joint_loss(like, at_indentation(0),
                 TangentialAmplitude{20 * friction / (1.1 * ratio) * length}, friction);
  CHECK(joint.tangential_force == Approx(friction * like.force(0)).epsilon(1e-8));
  const double few = 3.5 * friction / (1.1 * ratio) * length;
  CHECK(joint_loss(own, at_indentation(0), TangentialAmplitude{few}, friction).tangential_force ==
        Approx(friction * own.force(0) * (1 - std::exp(-3.5))).epsilon(1e-6));
}

TEST_CASE("A map of regimes has the borders of the assumptions, and they are monotone",
          "[regimes]") {
  const ExponentialLaw exponential(1, 1e-7, ratio);
  const TabulatedLaw table(exponential_curve(1e-7), ratio);
  const IndenterLaw punch(flat_punch_profile(1e-3), material);
  struct Case {
    const ContactLaw* law;
    double mean, amplitude;
  };
  const Case cases[] = {{&exponential, 0, 2e-8},
                        {&paraboloid, 1e-6, 3e-7},
                        {&paraboloid, 1e-6, 2e-6},  // opens in each cycle
                        {&table, 0, 2e-8},
                        {&punch, 1e-6, 3e-7}};
  for (const Case& one : cases) {
    CAPTURE(&one - cases);
    const NormalOscillation normal{one.amplitude, 1e5};
    const double critical =
        stretch / (one.law == &table ? 1.1 : 1) * one.amplitude * normal.angular_frequency;
    const std::vector<double> velocities = decades(1e-5 * critical, 3 * critical, 9);
    const std::vector<double> excursions = decades(1e-4 * one.amplitude, 1e3 * one.amplitude, 15);
    const RegimeMap map = regime_map(*one.law, one.mean, normal, velocities, excursions, friction);
    CHECK(map.critical_velocity == Approx(critical).epsilon(1e-12));
    // The punch loses nothing without slip, so its slip is measured against round-off, 1e-7 of ½K_t
    // X².
    const double noise = one.law == &punch ? 0.02 : 1e-4;
    bool ended = false;
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      const double way = 2 * pi * velocities[i] / normal.angular_frequency;
      // The excursion without slip grows with the velocity, until none is left.
      ended = ended || map.no_slip_excursion[i] == 0;
      if (ended) CHECK(map.no_slip_excursion[i] == 0);
      if (!ended && i > 0)
        CHECK_FALSE(map.no_slip_excursion[i] < map.no_slip_excursion[i - 1] * (1 - noise));
      Regime before = Regime::no_slip;
      double less = 0;
      for (std::size_t j = 0; j < excursions.size(); ++j) {
        CAPTURE(velocities[i], excursions[j]);
        const Assumptions assumptions = assumptions_of(
            *one.law, one.mean, Drag{one.amplitude, velocities[i], normal.angular_frequency},
            {.friction_coefficient = friction, .excursion = excursions[j]});
        CHECK(name_of(map.regime[i][j]) == name_of(assumptions.regime));
        const double loss = map.loss_ratio(Index(i), Index(j));
        if (excursions[j] < way) {
          CHECK(map.regime[i][j] == Regime::unknown);
          CHECK(std::isnan(loss));
          continue;
        }
        CHECK(map.regime[i][j] >= before);
        before = map.regime[i][j];
        CHECK_FALSE(loss < less * (1 - 1e-9));
        less = loss;
        if (map.regime[i][j] == Regime::no_slip && !std::isnan(loss)) {
          // 5 % for each of both assumptions, and the loss that the turning points prevent.
          const Assumption& slow = assumptions.slow_motion;
          const double taken = one.law == &punch ? 0 : 0.05 * slow.limit_5_percent / slow.value;
          CHECK(std::abs(loss - 1 + taken) < 0.1001);
          CHECK(assumptions.slip_of_closed_springs.verdict == Verdict::holds);
          CHECK(assumptions.slip_of_opening_springs.verdict == Verdict::holds);
        }
      }
    }
    // Slow and short motions have the loss without slip; 360 steps miss 0.02 % of the slip at the
    // edge.
    if (one.law != &punch) {
      const bool lifts_off = one.mean - one.amplitude < one.law->first_touch();
      CHECK(map.regime[0][0] == (lifts_off ? Regime::lifts_off : Regime::no_slip));
      const Assumption slow =
          assumptions_of(*one.law, one.mean,
                         Drag{one.amplitude, velocities[0], normal.angular_frequency},
                         {.friction_coefficient = friction, .excursion = excursions[0]})
              .slow_motion;
      CHECK(map.loss_ratio(0, 0) ==
            Approx(1 - 0.05 * slow.limit_5_percent / slow.value).epsilon(2e-3));
    }
  }
}

TEST_CASE("The loss in each regime is that of the simulated springs", "[regimes]") {
  const double mean = 1e-6, amplitude = 1e-7, omega = 1e5;
  const double critical = stretch * amplitude * omega;
  struct Point {
    double velocity_ratio;
    int cycles;
    Regime regime;
  };
  for (const Point& point : {Point{1e-4, 10, Regime::no_slip}, Point{2e-3, 3, Regime::no_slip},
                             Point{0.01, 10, Regime::partial_slip},
                             Point{0.1, 20, Regime::partial_slip}, Point{0.1, 40, Regime::sliding},
                             Point{0.7, 10, Regime::sliding}, Point{1.5, 10, Regime::sliding}}) {
    CAPTURE(point.velocity_ratio, point.cycles);
    const Drag drag{amplitude, point.velocity_ratio * critical, omega};
    const TurningLoss loss = loss_of_turning(paraboloid, drag, mean, point.cycles, friction);
    const double excursion = point.cycles * 2 * pi * drag.drag_velocity / omega;
    const double stick = relaxation_damping(paraboloid, at_indentation(mean), drag).work_per_cycle;
    const RegimeMap map = regime_map(paraboloid, mean, {amplitude, omega}, {drag.drag_velocity},
                                     {excursion}, friction);
    CHECK(name_of(map.regime[0][0]) == name_of(point.regime));
    INFO(map.slip_ratio(0, 0) * stick / loss.slip_work - 1
         << ' ' << map.loss_ratio(0, 0) * stick / loss.work - 1);
    // Exact to first order in a normal cycle over the excursion; 360 steps miss 1e-3.
    CHECK(map.slip_ratio(0, 0) ==
          Approx(loss.slip_work / stick).epsilon(0.1 / (point.cycles * point.cycles) + 3e-3));
    CHECK(map.loss_ratio(0, 0) ==
          Approx(loss.work / stick).epsilon(0.1 / (point.cycles * point.cycles) + 3e-3));
  }
}

TEST_CASE("A long slow way loses what steady sliding does", "[regimes]") {
  const ExponentialLaw exponential(1, 1e-7, ratio);
  const NormalOscillation normal{3e-8, 1e5};
  const double critical = stretch * normal.normal_amplitude * normal.angular_frequency;
  const std::vector<double> velocities{1e-3 * critical, 0.1 * critical, 0.7 * critical,
                                       3 * critical};
  const RegimeMap map = regime_map(exponential, 0, normal, velocities, {1.0}, friction);
  const std::vector<SteadySliding> sliding =
      steady_sliding(exponential, at_indentation(0), normal, velocities, friction);
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    CAPTURE(i);
    const double stuck = 2 * pi * velocities[i] * velocities[i] / normal.angular_frequency *
                         sliding[i].relaxation_damping;
    // 256 cells over 21 l, which carry 1 − 1e-9 of the force; 360 steps.
    CHECK(map.slip_ratio(Index(i), 0) == Approx(sliding[i].slip_work / stuck).epsilon(1e-3));
    CHECK(map.loss_ratio(Index(i), 0) - map.slip_ratio(Index(i), 0) ==
          Approx(sliding[i].relaxation_work / stuck).epsilon(2e-3));
    CHECK(map.regime[i][0] == Regime::sliding);
  }
}

TEST_CASE("A sheared contact slides where no anchor holds its levels", "[regimes]") {
  const double mean = 1e-6, amplitude = 3e-7;
  const double kept =
      paraboloid.indentation_of(0.05 * mean_force_of_cycle(paraboloid, mean, amplitude));
  const auto regime = [&](double displacement, double phase) {
    return assumptions_of(paraboloid, mean,
                          EqualFrequency{amplitude, stretch * displacement, phase},
                          {.friction_coefficient = friction})
        .regime;
  };
  // 2L = |u_x e^{iφ0} − A| + |u_x e^{iφ0} + A| in units of μ/g: at 90° L² = u_x² + u_z², at 0° L =
  // u_x.
  const double depth = mean - kept;
  const double quarter = std::sqrt(depth * depth - amplitude * amplitude);
  CHECK(regime(0.999 * quarter, pi / 2) == Regime::partial_slip);
  CHECK(regime(1.001 * quarter, pi / 2) == Regime::sliding);
  CHECK(regime(0.999 * depth, 1e-6) == Regime::partial_slip);
  CHECK(regime(1.001 * depth, 1e-6) == Regime::sliding);
  CHECK(regime(1e-3 * amplitude, pi / 2) == Regime::no_slip);
  // Without friction or excursion the regime is unknown.
  CHECK(assumptions_of(paraboloid, mean, EqualFrequency{amplitude, 1e-8, 1}).regime ==
        Regime::unknown);
  CHECK(assumptions_of(paraboloid, mean, Drag{amplitude, 1e-9, 1e5}, {.friction_coefficient = 0.3})
            .regime == Regime::unknown);
}

TEST_CASE("Bad input of a map of regimes is refused", "[regimes][input]") {
  const NormalOscillation normal{1e-8, 1e5};
  CHECK_THROWS_AS(regime_map(paraboloid, 1e-6, normal, {0}, {1e-9}, 0.3), InvalidInput);
  CHECK_THROWS_AS(regime_map(paraboloid, 1e-6, normal, {1e-9}, {-1e-9}, 0.3), InvalidInput);
  CHECK_THROWS_AS(regime_map(paraboloid, 1e-6, normal, {1e-9}, {1e-9}, 0), InvalidInput);
  CHECK_THROWS_AS(regime_map(paraboloid, 1e-6, {0, 1e5}, {1e-9}, {1e-9}, 0.3), InvalidInput);
  CHECK_THROWS_AS(regime_map(paraboloid, 1e-6, {1e-8, 0}, {1e-9}, {1e-9}, 0.3), InvalidInput);
  CHECK(regime_map(paraboloid, 1e-6, normal, {}, {}, 0.3).sliding_excursion > 0);
}

TEST_CASE("Conditions name their limit, what holds, at which loads, and what to do, worst first",
          "[assumptions][validity]") {
  Assumptions fine;
  for (const AssumptionName& name : assumption_names())
    fine.*name.assumption = {
        .value = 0.5, .limit_5_percent = 1, .limit_20_percent = 2, .verdict = Verdict::holds};
  std::vector<Assumptions> cases(5, fine);
  const std::vector<double> pressures{1e6, 2e6, 3e6, 4e6, 5e6};
  const auto validity = [&](bool slip_followed = false) {
    return validity_of(verdicts_of(cases, slip_followed, pressures));
  };
  CHECK(validity() == Validity::valid);
  // The amplitude is an assumption of the closed forms only.
  cases[0].amplitude.verdict = Verdict::broken;
  CHECK(validity() == Validity::valid);
  CHECK(closed_form_verdict(cases).verdict == Verdict::broken);
  // An unknown verdict leaves the whole open, and ranks below a broken one.
  cases[1].inertia = {.verdict = Verdict::unknown, .needs = "angular_frequency"};
  CHECK(validity() == Validity::not_checked);
  CHECK(verdicts_of(cases, false)[0].here == "`frequency` not given");
  for (const std::size_t k : {0u, 2u, 3u})
    cases[k].slow_motion = {.value = k + 2., .limit_5_percent = 9, .verdict = Verdict::doubtful};
  CHECK(validity() == Validity::valid_with_care);
  const AssumptionVerdict slow = verdicts_of(cases, false, pressures)[0];
  CHECK(slow.name == "slow_motion");
  CHECK(slow.assumption == "slow: at least 9 normal cycles in an excursion");
  CHECK(slow.here == "2, at 1 MPa, 3 MPa to 4 MPa");
  CHECK(!slow.remedy.empty());
  CHECK_THAT(verdicts_of(cases, false)[0].here, Catch::EndsWith(", in 3 of 5"));
  // If slip is computed, it is no assumption.
  for (Assumptions& one : cases) one.slip_of_opening_springs.verdict = Verdict::broken;
  CHECK(validity() == Validity::not_valid);
  CHECK_THAT(verdicts_of(cases, false, pressures)[0].here, Catch::EndsWith(", at all loads"));
  CHECK(validity(true) == Validity::valid_with_care);
  // The limit comes from the least tolerant case.
  cases[0].largest = {{.friction_coefficient = 0.3, .drag_velocity = 5e-6, .excursion = 2e-9}};
  cases[3].largest = {{.friction_coefficient = 0.3, .drag_velocity = 2e-6, .excursion = 3e-9}};
  CHECK(motion_without_slip(cases) == "2 nm at 2 \u00b5m/s (\u00b5 = 0.3)");
  cases[0].largest =
      cases[3].largest = {{.friction_coefficient = 0.1, .tangential_amplitude = 1e-9},
                          {.friction_coefficient = 0.3, .tangential_amplitude = 3e-9}};
  CHECK(motion_without_slip(cases) == "1 nm (\u00b5 = 0.1), 3 nm (\u00b5 = 0.3)");
}

TEST_CASE("Pressure and size are judged at the deepest point of the oscillation", "[assumptions]") {
  const double modulus = 1e10, radius = 1e-3, rest = 1e-6, amplitude = 5e-6;
  const Drag motion{amplitude, 1e-6, 1e5};
  const auto judged = [&](const ContactLaw& law, const ForceCurve* curve, double rests,
                          const Drag& drag) {
    ContactParameters parameters{.hardness = 1e9, .density = 7800};
    parameters.contact_modulus = modulus;
    return assumptions_of(law, rests, drag,
                          at_state(parameters, law, curve, rests, rests + drag.normal_amplitude));
  };
  const Material material = Material::of_contact_modulus(modulus, 0.3);
  // Hertz: p0 = 2E*√(δ/R)/π = 1.5 times the mean, a = √(Rδ).
  const IndenterLaw ball(paraboloid_profile(radius), material);
  const Assumptions found = judged(ball, nullptr, rest, motion);
  CHECK(found.plasticity.value ==
        Approx(2 * modulus / pi * std::sqrt((rest + amplitude) / radius) / 1e9).epsilon(1e-9));
  const Assumptions still = judged(ball, nullptr, rest, Drag{1e-6 * rest, 1e-6, 1e5});
  CHECK(found.inertia.value / still.inertia.value ==
        Approx(std::sqrt((rest + amplitude) / rest)).epsilon(1e-5));
  // The mean pressure of a cone is the same at all loads, that of a flat punch grows with δ.
  const IndenterLaw cone(cone_profile(std::atan(0.01)), material);
  CHECK(judged(cone, nullptr, rest, motion).plasticity.value ==
        Approx(1.5 * modulus * 0.01 / 2 / 1e9).epsilon(1e-9));
  const IndenterLaw punch(flat_punch_profile(radius), material);
  CHECK(judged(punch, nullptr, rest, motion).plasticity.value ==
        Approx(1.5 * 2 * modulus * (rest + amplitude) / (pi * radius) / 1e9).epsilon(1e-9));
  // A curve gives the load nearest to the peak, and its last load beyond its end.
  const double length = 1e-7;
  ForceCurve curve = exponential_curve(length);
  curve.nominal_area = 1e-6;
  for (ForceSample& sample : curve.samples)
    sample.contact_area_fraction =
        sample.force / curve.nominal_area / (1e8 * (2 + sample.indentation / length / 8));
  const TabulatedLaw table(curve, ratio);
  CHECK(judged(table, &curve, 0, Drag{2 * length, 1e-6, 1e5}).plasticity.value ==
        Approx(1.5 * 1e8 * 2.25 / 1e9).epsilon(1e-9));
  CHECK(judged(table, &curve, 4 * length, Drag{2 * length, 1e-6, 1e5}).plasticity.value ==
        Approx(1.5 * 1e8 * 2.5 / 1e9).epsilon(1e-9));
  CHECK(in_words(verdicts_of({&found, 1}, true)).find("at peak") != std::string::npos);
}

TEST_CASE("A contact that slides as a whole is no damper: its friction is that of the mean force",
          "[assumptions][regimes]") {
  const double friction = 0.3, omega = 1e5;
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const IndenterLaw ball(paraboloid_profile(1e-3), material), cone(cone_profile(0.1), material);
  const ExponentialLaw exponential(10, 1e-7, ratio);
  const TabulatedLaw table(exponential_curve(1e-7), ratio);
  const auto said = [](const Assumptions& assumptions) {
    return in_words(verdicts_of({&assumptions, 1}, true));
  };
  const auto word = [](const Assumptions& assumptions) {
    const auto verdicts = verdicts_of({&assumptions, 1}, true);
    return std::ranges::any_of(verdicts, [](const AssumptionVerdict& one) {
      return one.name == "regime" && one.verdict == Verdict::broken;
    });
  };
  for (const auto& [law, rest, amplitude] :
       {std::tuple<const ContactLaw*, double, double>{&ball, 1e-6, 1e-8},
        {&cone, 1e-6, 1e-7},
        {&exponential, 0, 1e-8},
        {&table, 0, 1e-8}}) {
    const double force = mean_force_of_cycle(*law, rest, amplitude);
    // A thousand times the elastic displacement of any of these, far above the velocity at which
    // springs stick: turning points and the force above δ_min change less than 1 %.
    const Drag drag{amplitude, 10 * friction * amplitude * omega, omega};
    const double excursion = 1e3 * friction * law->force(rest) / law->normal_stiffness(rest);
    const Assumptions slides = assumptions_of(
        *law, rest, drag, {.friction_coefficient = friction, .excursion = excursion});
    CHECK(slides.regime == Regime::sliding);
    const Loss loss = loss_with_slip(*law, rest, drag, friction, excursion);
    CHECK(closed_form::damping_constant(loss.work_per_cycle, drag) ==
          Approx(friction * force / drag.drag_velocity).epsilon(0.01));
    CHECK(word(slides));
    CHECK(validity_of(verdicts_of({&slides, 1}, true)) == Validity::not_valid);
    CHECK(said(slides).find("γ = µF/v: Coulomb friction, not a damper") != std::string::npos);
    CHECK(said(slides).find("use `salebra sliding`") != std::string::npos);

    // Case (a): W = 4µF u_x, less twice the elastic displacement.
    const EqualFrequency shear{amplitude, excursion, pi / 2, omega};
    const Assumptions sheared =
        assumptions_of(*law, rest, shear, {.friction_coefficient = friction});
    CHECK(sheared.regime == Regime::sliding);
    const double work = loss_with_slip(*law, rest, shear, friction).work_per_cycle;
    // At φ0 = 90° the force has its mean where the velocity is largest, and ∮F|dx| = 4F̄u_x.
    CHECK(work == Approx(4 * friction * force * excursion).epsilon(0.02));
    CHECK(said(sheared).find("γ = 4µF/(πωu_x)") != std::string::npos);

    // A short motion is a damper.
    const Assumptions sticks =
        assumptions_of(*law, rest, EqualFrequency{amplitude, 1e-13, pi / 4, omega},
                       {.friction_coefficient = friction});
    CHECK(sticks.regime == Regime::no_slip);
    CHECK_FALSE(word(sticks));
  }
  // Under a large oscillation the springs that are always closed slide but carry almost nothing.
  // Under a slow drag the contact relaxes, and its force is far from µF.
  const Drag slow{5e-7, 0.1 * friction / ratio * 5e-7 * omega, omega};
  const ContactParameters parameters{.friction_coefficient = friction, .excursion = 1e-4};
  CHECK(assumptions_of(exponential, 0, slow, parameters).regime == Regime::partial_slip);
  const double force =
      closed_form::damping_constant(
          loss_with_slip(exponential, 0, slow, friction, 1e-4).work_per_cycle, slow) *
      slow.drag_velocity;
  CHECK(force < 0.5 * friction * mean_force_of_cycle(exponential, 0, 5e-7));
  // A contact that lifts off slides in case (a) too.
  const EqualFrequency wide{2e-6, 1e-4, pi / 2, omega};
  CHECK(assumptions_of(ball, 1e-6, wide, {.friction_coefficient = friction}).regime ==
        Regime::sliding);
  // For several loads the line names those that slide.
  const Assumptions none{}, sliding = [] {
    Assumptions one;
    one.regime = Regime::sliding;
    return one;
  }();
  const std::vector<Assumptions> loads{none, sliding, sliding};
  const double pressures[] = {1e6, 2e6, 5e6};
  CHECK(regimes_in_words(loads, pressures) == "sliding at 2 MPa to 5 MPa, unknown at 1 MPa");
  CHECK(regimes_in_words({&none, 1}).empty());
}
