// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/trajectory_damping.hpp>

#include "joint_springs.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double ratio = 0.82;  // G*/E*

// Mindlin and Deresiewicz (1953), Johnson's Contact Mechanics, Eq. (7.57), with his (2−ν1)/G1 +
// (2−ν2)/G2 = 4/G*.
double mindlin_loss(double force, double normal_force, double radius, double shear_modulus,
                    double friction) {
  const double q = force / (friction * normal_force);
  const double third = std::cbrt(1 - q), fifth = third * third * (1 - q);
  return 18 * friction * friction * normal_force * normal_force / (5 * radius * shear_modulus) *
         (1 - fifth - 5. / 6 * q * (1 + third * third));
}

}  // namespace

TEST_CASE("A sphere in partial slip loses what Mindlin and Deresiewicz say", "[joint]") {
  // x/x_s = 0.45, 0.6, 0.8 and 1, in eight digits. The whole contact slides at x_s = μE*δ/G*, with
  // T/(μF) = 1 − (1 − x/x_s)^{3/2}; W is mindlin_loss() of this T.
  const Material material = Material::of_contact_modulus(115e9, 0.3);
  const IndenterLaw sphere(paraboloid_profile(10e-3), material);
  const double friction = 0.3, force = 10;
  const double shear = material.tangential_modulus;
  const double radius = sphere.contact_radius(sphere.indentation_of(force));
  const std::pair<double, double> given[] = {{123.28123e-9, 42.812827e-9},
                                             {164.37496e-9, 107.64468e-9},
                                             {219.16662e-9, 282.28116e-9},
                                             {273.95827e-9, 657.49986e-9}};
  for (const auto& [amplitude, work] : given) {
    CAPTURE(amplitude);
    const JointLoss loss =
        joint_loss(sphere, at_force(force), TangentialAmplitude{amplitude}, friction);
    CHECK(loss.converged);
    // A change in the eighth digit of x changes W by 1e-7.
    CHECK(loss.work_per_cycle == Approx(work).epsilon(3e-7));
    CHECK(loss.relaxation_work == 0);
    // In the last of them the whole contact begins to slide, and neither T nor W determines x.
    if (loss.tangential_force > 0.999 * friction * force) continue;
    CHECK(
        loss.work_per_cycle ==
        Approx(mindlin_loss(loss.tangential_force, force, radius, shear, friction)).epsilon(1e-9));
    const JointLoss by_force =
        joint_loss(sphere, at_force(force), TangentialForce{loss.tangential_force}, friction);
    CHECK(by_force.tangential_amplitude == Approx(amplitude).epsilon(1e-9));
    CHECK(by_force.work_per_cycle == Approx(loss.work_per_cycle).epsilon(1e-8));
  }
  CHECK_THROWS_WITH(joint_loss(sphere, at_force(force), TangentialForce{3.0}, friction),
                    Catch::Contains("must be below 3 N, at which the contact slides"));
}

TEST_CASE(
    "The exponential law in partial slip has its closed form, and the third power of small forces",
    "[joint]") {
  // l = 100 nm, F = 1 N, μ = 0.3, ν = 0.3. Masing's rule on T = μ[F(δ) − F(δ − G*x/(μE*))] gives,
  // with q = T/(μF), x = −(μE*/G*) l ln(1 − q) and
  //     W = 8(μ²E*/G*) l F [−(1 − q/2) ln(1 − q) − q],
  // here in eight digits for q = 0.1, 0.3, 0.5 and 0.8.
  const double length = 1e-7, friction = 0.3, modulus_ratio = 1.4 / 1.7;
  const ExponentialLaw law(1, length, modulus_ratio);
  const std::pair<double, double> given[] = {{3.838133e-9, 8.0862576e-12},
                                             {12.993159e-9, 2.7747226e-10},
                                             {25.250362e-9, 1.7363651e-9},
                                             {58.629524e-9, 1.4483657e-8}};
  for (const auto& [amplitude, work] : given) {
    CAPTURE(amplitude);
    const JointLoss loss = joint_loss(law, at_force(1), TangentialAmplitude{amplitude}, friction);
    CHECK(loss.work_per_cycle == Approx(work).epsilon(2e-6));  // 3 × error of x
    const double q = loss.tangential_force / friction;
    CHECK(loss.work_per_cycle == Approx(8 * friction * friction / modulus_ratio * length *
                                        (-(1 - q / 2) * std::log1p(-q) - q))
                                     .epsilon(1e-9));
    // d ln W/d ln T of this W.
    const double slope = (0.5 * std::log1p(-q) + (1 - q / 2) / (1 - q) - 1) /
                         (-(1 - q / 2) * std::log1p(-q) - q) * q;
    CHECK(loss.exponent == Approx(slope).epsilon(1e-8));
  }
  // At small q, W is proportional to T³; the next term of its series is q times that.
  for (const double q : {1e-2, 1e-4, 1e-6}) {
    const JointLoss loss = joint_loss(law, at_force(1), TangentialForce{q * friction}, friction);
    const double cube = 2. / 3 * length / modulus_ratio * std::pow(q, 3) * friction * friction;
    // Tolerance: the term of order q², and the round-off of K_t.
    CHECK(loss.work_per_cycle == Approx(cube * (1 + q)).epsilon(q * q + 1e-14 / q));
    CHECK(loss.exponent == Approx(3).margin(2 * q + 1e-13 / q));
    CHECK(loss.storage_stiffness == Approx(law.tangential_stiffness(0)).epsilon(q));
  }
}

TEST_CASE("Storage and loss of a joint are the first harmonic of its loop", "[joint]") {
  // The exponent is not an integer, because sums over a period are exact for polynomials.
  const PowerLaw cone(1e9, 1.5, ratio);
  const double friction = 0.4, amplitude = 2e-7;
  const JointLoss loss =
      joint_loss(cone, at_indentation(1e-6), TangentialAmplitude{amplitude}, friction);
  // The error of sums over the steps of a smooth half loop falls faster than any power of the step.
  const JointLoss followed = joint_loss(cone, at_indentation(1e-6),
                                        JointMotion{TangentialAmplitude{amplitude}}, friction, 200);
  CHECK(followed.work_per_cycle == Approx(loss.work_per_cycle).epsilon(1e-9));
  CHECK(followed.tangential_force == Approx(loss.tangential_force).epsilon(1e-9));
  CHECK(followed.slip_work == Approx(loss.slip_work).epsilon(1e-9));
  CHECK(followed.storage_stiffness == Approx(loss.storage_stiffness).epsilon(1e-9));
  CHECK(loss.loss_stiffness == Approx(loss.work_per_cycle / (pi * amplitude * amplitude)));
  CHECK(loss.loss_factor == Approx(loss.work_per_cycle / (pi * amplitude * loss.tangential_force)));
}

TEST_CASE("A joint of a contact that may open: whole sliding, and beyond", "[joint]") {
  // F = Cδ², K = 2Cδ: slip reaches the last spring at c = δ; from there on T = μF, W = 4μF(x − mean
  // limit).
  const double depth = 1e-6, friction = 0.2, constant = 1e12;
  const PowerLaw cone(constant, 2, ratio);
  const double force = constant * depth * depth, last = friction / ratio * depth;
  for (const double factor : {1.0, 1.5, 4.0}) {
    const double x = factor * last;
    const JointLoss loss = joint_loss(cone, at_force(force), TangentialAmplitude{x}, friction);
    CHECK(loss.tangential_force == Approx(friction * force).epsilon(1e-9));
    // ∫4 s (x − s) dK_t with s = (μ/g)u, dK_t = 2gC du, u to δ.
    const double work = 8 * friction * constant *
                        (x * depth * depth / 2 - friction / ratio * std::pow(depth, 3) / 3);
    CHECK(loss.work_per_cycle == Approx(work).epsilon(1e-9));
    CHECK(std::isnan(loss.exponent));
  }
}

TEST_CASE("A joint whose normal force oscillates loses by slip and by relaxation", "[joint]") {
  const ExponentialLaw law(2, 2e-7, ratio);
  const double u_z = 5e-8, u_x = 2e-8;
  const auto at = [&](double friction, double phase) {
    return joint_loss(law, at_force(2), {TangentialAmplitude{u_x}, u_z, phase}, friction);
  };
  // In phase nothing slips above μ = g u_x/u_z. Out of phase and without slip the loss is that of
  // relaxation damping, up to the second-order error of the steps.
  const double critical = ratio * u_x / u_z;
  CHECK(at(1.01 * critical, 0).work_per_cycle == Approx(0).margin(1e-12 * u_x * u_x * 1e7));
  CHECK(std::isnan(at(1.01 * critical, 0).exponent));
  CHECK(at(1.01 * critical, 0).regime == Regime::no_slip);
  CHECK(at(0.8 * critical, 0).work_per_cycle > 1e-3 * u_x * u_x * 1e7);
  const EqualFrequency motion{u_z, u_x, pi / 2, 0};
  const double stuck = relaxation_damping(law, at_force(2), motion).work_per_cycle;
  const JointLoss stiff = at(1e4, pi / 2);
  CHECK(stiff.work_per_cycle == Approx(stuck).epsilon(1e-5));
  CHECK(stiff.slip_work == Approx(0).margin(1e-9 * stuck));
  CHECK(stiff.exponent == Approx(2).epsilon(1e-3));  // relaxation is linear in the springs
  // At small amplitude the response is harmonic, so control by force and by displacement give one
  // loop.
  const double small = 1e-11;
  const JointLoss moved =
      joint_loss(law, at_force(2), {TangentialAmplitude{small}, u_z, pi / 2}, 0.3, 1000);
  const JointLoss again =
      joint_loss(law, at_force(2), {TangentialAmplitude{small}, u_z, pi / 2}, 0.3, 1000);
  CHECK(moved.work_per_cycle == again.work_per_cycle);
}

TEST_CASE("A joint under a tangential force is the one under the displacement it answers with",
          "[joint]") {
  const ExponentialLaw law(2, 2e-7, ratio);
  const double friction = 0.3;
  // Without a normal oscillation both numbers have closed forms.
  const JointLoss exact = joint_loss(law, at_force(2), TangentialForce{0.3}, friction);
  const JointLoss followed =
      joint_loss(law, at_force(2), JointMotion{TangentialForce{0.3}}, friction, 400);
  CHECK(followed.work_per_cycle == Approx(exact.work_per_cycle).epsilon(1e-8));
  CHECK(followed.tangential_amplitude == Approx(exact.tangential_amplitude).epsilon(1e-8));
  // With an oscillation the force is met at every step, and the energy balance closes: W = ∮T dx.
  const JointLoss both =
      joint_loss(law, at_force(2), {TangentialForce{0.2}, 3e-8, pi / 3}, friction, 400);
  CHECK(both.tangential_force == Approx(0.2).epsilon(1e-12));
  const JointLoss finer =
      joint_loss(law, at_force(2), {TangentialForce{0.2}, 3e-8, pi / 3}, friction, 1600);
  CHECK(finer.work_per_cycle == Approx(both.work_per_cycle).epsilon(1e-2));
  CHECK_THROWS_WITH(joint_loss(law, at_force(2), {TangentialForce{0.55}, 1e-7, pi}, friction, 400),
                    Catch::Contains("at which the contact slides during the normal oscillation"));
}

TEST_CASE("Joints that cannot be are refused", "[joint]") {
  const ExponentialLaw law(2, 2e-7, ratio);
  const auto at = [&](const TangentialOscillation& motion, double friction) {
    return joint_loss(law, at_force(2), motion, friction);
  };
  CHECK_THROWS_WITH(at(TangentialAmplitude{0}, 0.3), Catch::Contains("tangential_amplitude"));
  CHECK_THROWS_WITH(at(TangentialForce{-1}, 0.3), Catch::Contains("tangential_force"));
  CHECK_THROWS_WITH(at(TangentialForce{0.1}, 0), Catch::Contains("friction_coefficient"));
  CHECK_THROWS_AS(joint_loss(law, at_force(2), {TangentialForce{0.1}, -1e-9, 0}, 0.3),
                  InvalidInput);
  CHECK_THROWS_WITH(joint_loss(law, at_force(2), {TangentialForce{0.1}, 2e-6, 0}, 0.3),
                    Catch::Contains("normal_amplitude") &&
                        Catch::EndsWith("at most 1.84 µm, hold the mean force, or give a "
                                        "`curve` that covers the motion"));
}

TEST_CASE("A joint that slides as a whole has no exponent", "[joint]") {
  const ExponentialLaw law(1, 1e-8, 0.8);
  const auto at = [&](double x) {
    return joint_loss(law, at_force(1), TangentialOscillation(TangentialAmplitude{x}), 0.3)
        .exponent;
  };
  // d ln W/d ln T from two motions that differ by a thousandth, while a part still sticks.
  const double x = 1e-8;
  const auto loss = [&](double one) {
    return joint_loss(law, at_force(1), TangentialOscillation(TangentialAmplitude{one}), 0.3);
  };
  const JointLoss low = loss(0.999 * x), high = loss(1.001 * x);
  CHECK(at(x) == Approx(std::log(high.work_per_cycle / low.work_per_cycle) /
                        std::log(high.tangential_force / low.tangential_force))
                     .epsilon(1e-3));
  // If T = µF to the last digit, W grows with x at a constant force.
  CHECK(std::isnan(at(2e-6)));
  const JointMotion follows{TangentialAmplitude{2e-6}, 1e-9, 0.5};
  CHECK(std::isnan(joint_loss(law, at_force(1), follows, 0.3, 400).exponent));
}

namespace {

// A curve of 40 loads from 1 % to 300 times 1 N, of a law that bends in the logarithm: between an
// exponential and a power law, as of a rough surface. It has no K_t of its own.
TabulatedLaw measured_curve(double first_load = 0.01) {
  ForceCurve curve{.model = "measured", .nominal_area = 1e-6, .samples = {}};
  for (int i = 0; i < 40; ++i) {
    const double t = std::log(first_load) + (std::log(300.0) - std::log(first_load)) * i / 39.0;
    // ln F = t, δ = l t (1 + t/60).
    const double length = 3e-8;
    curve.samples.push_back({.indentation = length * t * (1 + t / 60),
                             .force = std::exp(t),
                             .normal_stiffness = std::exp(t) / (length * (1 + t / 30))});
  }
  return TabulatedLaw(curve, ratio);
}

double relative(double value, double expected) { return std::abs(value / expected - 1); }

// Depth below δ at which no springs are left.
double lowest_spring(const ContactLaw& law, double indentation) {
  if (std::isfinite(law.first_touch())) return law.first_touch();
  return indentation - 25 * law.force(indentation) / law.normal_stiffness(indentation);
}

}  // namespace

TEST_CASE("A joint from partial slip to a hundred times its knee is a sum over springs",
          "[joint]") {
  const double friction = 0.4;
  const IndenterLaw sphere(paraboloid_profile(10e-3), Material::of_contact_modulus(115e9, 0.3));
  const ExponentialLaw rough(1, 3e-8, ratio);
  const TabulatedLaw curve = measured_curve();
  for (const ContactLaw* law :
       {static_cast<const ContactLaw*>(&sphere), static_cast<const ContactLaw*>(&rough),
        static_cast<const ContactLaw*>(&curve)}) {
    const double high = law->indentation_of(1);
    const double low = lowest_spring(*law, high);
    // The exponential law never slides as a whole; its scale is the decay length.
    const double knee =
        friction / law->modulus_ratio() * (std::isfinite(law->first_touch()) ? high - low : 3e-8);
    salebra_test::JointSprings springs(*law, low, high, friction, 4000);
    for (const double factor : {0.05, 0.3, 0.9, 1.0, 1.1, 3.0, 10.0, 100.0}) {
      const double x = factor * knee;
      CAPTURE(int(law == &sphere), int(law == &rough), factor);
      const JointLoss loss = joint_loss(*law, at_force(1), TangentialAmplitude{x}, friction);
      const auto loop = springs.cycle(high, 0, x, 0, 2000);
      CHECK(loss.converged);
      // The error of the sum is of second order in the width of a spring and in the step. At the
      // smallest amplitude a hundred springs slip.
      for (const auto& [value, expected] : {std::pair{loss.work_per_cycle, loop.work},
                                            {loss.tangential_force, loop.force},
                                            {loss.storage_stiffness, loop.storage_stiffness},
                                            {loss.loss_stiffness, loop.loss_stiffness}})
        CHECK(relative(value, expected) < 2e-4);
      CHECK(loss.loss_factor == Approx(loss.work_per_cycle / (pi * x * loss.tangential_force)));
      if (factor < 1 || !std::isfinite(loss.knee)) continue;
      CHECK(loss.knee == Approx(knee).epsilon(1e-12));
      CHECK(loss.regime == Regime::sliding);
      CHECK(std::isnan(loss.exponent));
      CHECK(loss.tangential_force == Approx(friction).epsilon(1e-9));
      CHECK(loss.loss_factor ==
            Approx(4 * (x - loss.elastic_displacement) / (pi * x)).epsilon(1e-9));
    }
  }
}

TEST_CASE("Gross slip in closed form: sphere, exponential law, and through the knee", "[joint]") {
  const double friction = 0.3;
  const IndenterLaw sphere(paraboloid_profile(10e-3), Material::of_contact_modulus(115e9, 0.3));
  const double depth = sphere.indentation_of(10);
  const double slope = friction / sphere.modulus_ratio();
  const JointLoss slid = joint_loss(sphere, at_force(10), TangentialAmplitude{1e-6}, friction);
  // U = (2/5) F δ for F ∝ δ^(3/2).
  CHECK(slid.elastic_displacement == Approx(0.8 * slope * depth).epsilon(1e-9));
  CHECK(slid.knee == Approx(slope * depth).epsilon(1e-12));
  CHECK(slid.work_per_cycle == Approx(4 * 3 * (1e-6 - 0.8 * slope * depth)).epsilon(1e-9));
  CHECK(slid.regime == Regime::sliding);

  // W = 4μμ'lF[(Y − 2) + (Y + 2) exp(−Y)], Y = x/(μ'l), from partial slip on.
  const double length = 3e-8;
  const ExponentialLaw law(2, length, ratio);
  const double unit = friction / ratio * length;
  for (const double y : {1e-3, 0.1, 1.0, 5.0, 30.0, 300.0, 1e5}) {
    CAPTURE(y);
    const JointLoss loss = joint_loss(law, at_force(2), TangentialAmplitude{y * unit}, friction);
    // The bracket is y³/6 for small y, where its terms cancel.
    const double bracket = y < 0.01 ? y * y * y / 6 * (1 - y / 2) : y - 2 + (y + 2) * std::exp(-y);
    CHECK(loss.work_per_cycle == Approx(4 * friction * unit * 2 * bracket).epsilon(1e-6));
    CHECK(loss.tangential_force == Approx(-2 * friction * std::expm1(-y)).epsilon(1e-9));
    CHECK(loss.elastic_displacement == Approx(2 * unit).epsilon(1e-9));
    CHECK(std::isinf(loss.knee));
    CHECK(loss.converged);
    // exp(−3) is 5 % of the force.
    CHECK(loss.regime == (y < 0.01   ? Regime::no_slip
                          : y < 2.99 ? Regime::partial_slip
                                     : Regime::sliding));
    CHECK(std::isnan(loss.exponent) == (y > 3));
  }

  // A curve with a K_t of its own, whose ratio to K grows by a fifth: the force is continuous at the
  // knee and is μF beyond it, and the loss is that of springs with one slope of the friction limit.
  ForceCurve stuck{.model = "measured", .nominal_area = 1e-6, .samples = {}};
  for (int i = 0; i < 60; ++i) {
    const double force = std::exp(-4 + 0.1 * i);
    stuck.samples.push_back(
        {.indentation = length * std::log(force),
         .force = force,
         .normal_stiffness = force / length,
         .tangential_stiffness = ratio * force / length * std::pow(force, 0.03)});
  }
  const TabulatedLaw table(stuck, ratio);
  const double knee = joint_loss(table, at_force(1), TangentialAmplitude{1e-6}, friction).knee;
  const JointLoss below =
      joint_loss(table, at_force(1), TangentialAmplitude{knee * (1 - 1e-9)}, friction);
  const JointLoss above =
      joint_loss(table, at_force(1), TangentialAmplitude{knee * (1 + 1e-9)}, friction);
  CHECK(below.tangential_force == Approx(friction).epsilon(1e-8));
  CHECK(above.tangential_force == friction);
  CHECK(above.work_per_cycle == Approx(below.work_per_cycle).epsilon(1e-7));
  CHECK(above.storage_stiffness == Approx(below.storage_stiffness).epsilon(1e-7));
  // K_t/K is 1, G/F is 1/1.03 of it on the exponential part; first touch changes this little.
  CHECK(knee == Approx(friction / (ratio / 1.03) * (table.indentation_of(1) - table.first_touch()))
                    .epsilon(0.01));
}

TEST_CASE("Slip below the lowest load of a curve is part of the error, or refused", "[joint]") {
  // The curves differ only in their lowest load. The loss of the one that begins at 1 % of the load
  // lies within the error of the one that begins at a tenth.
  const double friction = 0.3;
  const TabulatedLaw low = measured_curve(1e-4), high = measured_curve(0.1);
  for (const double x : {6e-8, 2e-7, 5e-6}) {
    CAPTURE(x);
    const JointLoss full = joint_loss(low, at_force(1), TangentialAmplitude{x}, friction);
    const JointLoss cut = joint_loss(high, at_force(1), TangentialAmplitude{x}, friction);
    CHECK(cut.work_error > 0);
    CHECK(cut.work_error < 0.05 * cut.work_per_cycle);
    CHECK(std::abs(cut.work_per_cycle - full.work_per_cycle) < cut.work_error);
  }
  // The slip stays within the loads, where the distances between them are the only error.
  const JointLoss within = joint_loss(high, at_force(1), TangentialAmplitude{1e-8}, friction);
  CHECK(within.work_error < 0.05 * within.work_per_cycle);
  // At its lowest load nothing of the loss comes from the curve.
  const TabulatedLaw none = measured_curve(0.99);
  CHECK_THROWS_WITH(joint_loss(none, at_force(1), TangentialAmplitude{1e-8}, friction),
                    Catch::Contains("curve") && Catch::Contains("990 mN is its lowest load"));
}

TEST_CASE("A curve of two thousand loads slides as a whole too", "[joint]") {
  const double length = 3e-8, friction = 0.3;
  ForceCurve curve{.model = "measured", .nominal_area = 1e-6, .samples = {}};
  for (int i = 0; i < 2000; ++i) {
    const double force = std::exp(-8 + 0.005 * i);
    curve.samples.push_back({.indentation = length * std::log(force), .force = force});
  }
  const TabulatedLaw law(curve, ratio);
  for (const double x : {1e-8, 5e-8, 5e-6}) {
    const JointLoss loss = joint_loss(law, at_force(1), TangentialAmplitude{x}, friction);
    CHECK(loss.converged);
    // The exponential law that the loads are of; the lowest is 3e-4 of the load.
    const JointLoss exact =
        joint_loss(ExponentialLaw(1, length, ratio), at_force(1), TangentialAmplitude{x}, friction);
    CHECK(loss.work_per_cycle == Approx(exact.work_per_cycle).epsilon(1e-3));
    CHECK(loss.storage_stiffness == Approx(exact.storage_stiffness).epsilon(1e-3));
  }
}

TEST_CASE("A joint under a normal oscillation is a sum over springs, through lift-off too",
          "[joint]") {
  const double friction = 0.4;
  const IndenterLaw sphere(paraboloid_profile(10e-3), Material::of_contact_modulus(115e9, 0.3));
  const ExponentialLaw rough(1, 3e-8, ratio);
  const TabulatedLaw curve = measured_curve();
  int lifted = 0;
  for (const ContactLaw* law :
       {static_cast<const ContactLaw*>(&sphere), static_cast<const ContactLaw*>(&rough),
        static_cast<const ContactLaw*>(&curve)}) {
    const double rest = law->indentation_of(1);
    const double scale = law == &sphere ? rest : 3e-8;
    for (const double normal : {0.4, 3.0})
      for (const Hold hold : {Hold::indentation, Hold::force})
        for (const double phase : {0.3, pi / 2, 2.5})
          for (const double factor : {0.1, 1.0, 10.0, 100.0}) {
            const double u_z = normal * scale;
            const double x = factor * friction / law->modulus_ratio() * scale;
            CAPTURE(int(law == &sphere), int(law == &rough), normal, int(hold), phase, factor);
            const JointLoss loss =
                joint_loss(*law, at_force(1), {TangentialAmplitude{x}, u_z, phase, hold}, friction);
            const double highest = loss.indentation + u_z;
            salebra_test::JointSprings springs(*law, lowest_spring(*law, highest), highest,
                                               friction, 800);
            const auto loop = springs.cycle(loss.indentation, u_z, x, phase, 2000);
            CHECK(loop.mean_force ==
                  Approx(hold == Hold::force ? 1 : loss.mean_force).epsilon(1e-4));
            CHECK(loss.mean_force == Approx(loop.mean_force).epsilon(1e-4));
            CHECK(loss.max_force == Approx(law->force(highest)).epsilon(1e-12));
            CHECK(loop.max_friction < friction * (1 + 1e-9));
            // The sum has an error of second order in the width of a spring and in the step, and of
            // first order in the moment at which a spring begins to stick.
            CHECK(std::abs(loss.work_per_cycle - loop.work) <
                  5e-4 * std::max(loop.work, 0.1 * x * loop.force));
            CHECK(relative(loss.tangential_force, loop.force) < 5e-4);
            if (loss.contact_time < 1) {
              // No spring stays closed.
              CHECK(loss.slip_work == 0);
              ++lifted;
            }
            if (factor == 100) CHECK(loss.regime == Regime::sliding);
            // A spring that touches still sticks for most of its time.
            if (factor == 0.1) CHECK(loss.regime != Regime::sliding);
            if (factor < 0.5 && normal > 1 && law == &sphere)
              CHECK(loss.regime == Regime::lifts_off);
          }
  }
  CHECK(lifted > 20);
  // A vibration of a hundred decay lengths: the exponential law has a force at every indentation, but
  // its springs open all the same. The bodies meet in a tenth of the steps, so the error is larger.
  const double u_z = 3e-6;
  for (const double x : {1e-9, 3e-8, 1e-6, 1e-5}) {
    const JointLoss loss =
        joint_loss(rough, at_force(1), {TangentialAmplitude{x}, u_z, 1.2, Hold::force}, friction);
    const double highest = loss.indentation + u_z;
    salebra_test::JointSprings springs(rough, lowest_spring(rough, highest), highest, friction,
                                       800);
    const auto loop = springs.cycle(loss.indentation, u_z, x, 1.2, 4000);
    CAPTURE(x);
    CHECK(loop.mean_force == Approx(1).epsilon(1e-3));
    CHECK(loss.work_per_cycle == Approx(loop.work).epsilon(5e-3));
    CHECK(loss.tangential_force == Approx(loop.force).epsilon(5e-3));
    CHECK((loss.regime == Regime::sliding) == (x > 1e-7));
  }
  // A tangential force cannot act between bodies that are apart.
  CHECK_THROWS_WITH(
      joint_loss(sphere, at_force(1), {TangentialForce{0.01}, 1e-6, 0, Hold::force}, friction),
      Catch::Contains("lifts the bodies apart"));
}
