// SPDX-License-Identifier: GPL-3.0-or-later
// Jenkins' sliders against closed forms of partial slip, and against the loss of joints.
#include <catch2/catch.hpp>
#include <salebra/damping/joint.hpp>

#include "decks.hpp"

using namespace salebra;
using namespace salebra::testing;

namespace {

constexpr double friction = 0.3;

std::vector<std::vector<double>> sliders_of(const DeckContact& contact, int count) {
  DeckProblem problem;
  problem.contacts = {contact};
  problem.format = DeckFormat::jenkins;
  problem.friction_coefficient = friction;
  problem.sliders = count;
  return rows_after(solve(problem).text, "stiffness,slider_force");
}

/// Loss of a cycle between ±T; follows each slider in straight steps through the loop.
double loss_of(const std::vector<std::vector<double>>& sliders, double force) {
  // The displacement at which the sliders together carry T, by bisection.
  const auto carried = [&](double x) {
    double sum = 0;
    for (const auto& slider : sliders) sum += std::min(slider[0] * x, slider[1]);
    return sum;
  };
  double low = 0, high = 1;
  for (int i = 0; i < 200; ++i) (carried((low + high) / 2) < force ? low : high) = (low + high) / 2;
  double work = 0;
  for (const auto& slider : sliders) {
    double stretch = 0, lost = 0;
    // To +x, to −x and back: after the first step, each step loses what slides during it.
    for (const double way : {high, -2 * high, 2 * high}) {
      const double limit = slider[1] / slider[0], free = stretch + way;
      stretch = std::clamp(free, -limit, limit);
      lost += way == high ? 0 : slider[1] * std::abs(free - stretch);
    }
    work += lost;
  }
  return work;
}

}  // namespace

TEST_CASE("Sliders of the exponential law lose what the closed form says, with order 2",
          "[export]") {
  // W = 8μ²(E*/G*) l F[−(1 − q/2) ln(1 − q) − q], q = T/(μF).
  const double scale = 8 * friction * friction / modulus_ratio * decay_length * force0;
  // The position of T between the slips of two sliders changes the constant, not the order, so the
  // largest error of five counts.
  const auto worst = [&](int count) {
    const auto sliders = sliders_of(exponential(), count);
    double largest = 0;
    for (const double q : {0.05, 0.2, 0.5, 0.8, 0.95}) {
      const double exact = scale * (-(1 - q / 2) * std::log(1 - q) - q);
      largest = std::max(largest, std::abs(loss_of(sliders, q * friction * force0) / exact - 1));
    }
    return largest;
  };
  const double ten = worst(10), fifty = worst(50), many = worst(200), most = worst(800);
  INFO(ten << ' ' << fifty << ' ' << many << ' ' << most);
  CHECK(fifty < 0.02);
  CHECK(many < 1e-3);
  // With five forces in the range of each slider, the order is known to some tenths.
  CHECK(std::log(ten / fifty) / std::log(5.) > 1.5);
  CHECK(std::log(fifty / most) / std::log(16.) == Approx(2).margin(0.3));
}

TEST_CASE("Sliders have the stiffness and the force of the contact", "[export]") {
  const double stiffness = modulus_ratio * force0 / decay_length;
  for (const int count : {2, 10, 200}) {
    const auto sliders = sliders_of(exponential(), count);
    CHECK(sliders.size() == std::size_t(count));
    double sum = 0, forces = 0, last = 0;
    for (const auto& slider : sliders) {
      sum += slider[0];
      forces += slider[1];
      CHECK(slider[1] / slider[0] > last);
      last = slider[1] / slider[0];
    }
    CHECK(sum == Approx(stiffness).epsilon(1e-13));
    CHECK(forces == Approx(friction * force0).epsilon(1e-13));
  }
}

TEST_CASE("Sliders of a curve lose what joint_loss() says, and know where levels end", "[export]") {
  const DeckContact contact = cubic();
  const double force = force0 / 8;
  const auto sliders = sliders_of(contact, 400);
  // The springs beyond ū = 0.8 h, with 0.064 of F, are one slider.
  for (const double q : {0.02, 0.3, 0.7, 0.9}) {
    const JointLoss joint =
        joint_loss(*contact.law, at_force(force), TangentialForce{q * friction * force}, friction);
    CHECK(loss_of(sliders, q * friction * force) == Approx(joint.work_per_cycle).epsilon(1e-3));
  }
}

TEST_CASE("Sliders of a curve slip down to first touch", "[export]") {
  // A curve that begins at half the force: K_t = (G*/E*)K, and T(x) = μ[F(δ) − F(δ − (G*/E*)x/μ)].
  ForceCurve curve = cubic_curve();
  std::erase_if(curve.samples, [](const ForceSample& one) { return one.force < 0.5 * force0 / 8; });
  const DeckContact contact = deck_contact(CurveContact{
      curve, modulus_ratio, {ControlQuantity::pressure, {force0 / area0 / 8}}, "curve"});
  const ContactLaw& law = *contact.law;
  const double high = law.indentation_of(force0 / 8), force = friction * law.force(high);
  const auto carried = [&](double x) {
    return friction * (law.force(high) - law.force(high - modulus_ratio * x / friction));
  };
  const auto sliders = sliders_of(contact, 400);
  for (const double q : {0.05, 0.3, 0.6, 0.9, 0.99}) {
    CAPTURE(q);
    const double x =
        friction / modulus_ratio * (high - law.indentation_of((1 - q) * force / friction));
    CHECK(carried(x) == Approx(q * force));
    // Masing: the loss is eight times the area between first loading and its chord.
    double area = 0;
    constexpr int parts = 20000;
    for (int i = 0; i < parts; ++i)
      area += (carried((i + 0.5) * x / parts) - q * force / 2) * x / parts;
    CHECK(loss_of(sliders, q * force) == Approx(8 * area).epsilon(2e-3));
  }
}

TEST_CASE("Sliders of a curve whose K_t/K varies carry its friction force", "[export]") {
  for (const double rise : {-0.3, 0.3}) {
    ForceCurve curve = cubic_curve();
    for (ForceSample& one : curve.samples)
      one.tangential_stiffness = one.normal_stiffness * (0.7 + rise * one.mean_gap / 1e-6);
    const DeckContact contact = deck_contact(CurveContact{
        curve, DeckContact::unknown, {ControlQuantity::pressure, {force0 / area0 / 8}}, "curve"});
    double stiffness = 0, force = 0;
    const auto sliders = sliders_of(contact, 400);
    for (const auto& slider : sliders) {
      CHECK(slider[0] > 0);
      CHECK(slider[1] > 0);
      stiffness += slider[0], force += slider[1];
    }
    CHECK(stiffness == Approx(contact.law->tangential_stiffness(contact.indentation)));
    CHECK(force == Approx(friction * force0 / 8));
    const JointLoss joint =
        joint_loss(*contact.law, at_force(force0 / 8), TangentialForce{0.4 * force}, friction);
    CHECK(loss_of(sliders, 0.4 * force) == Approx(joint.work_per_cycle).epsilon(1e-3));
  }
}

TEST_CASE("Sliders of a curve of three thousand loads are as many as asked for", "[export]") {
  ForceCurve curve{.model = "measured", .nominal_area = area0, .rms_height = 1e-6, .samples = {}};
  for (int i = 0; i < 3000; ++i) {
    const double force = std::exp(1e-2 / 3 * i), stiffness = force / 3e-8;
    curve.samples.push_back({.indentation = 1e-10 * i,
                             .force = force,
                             .pressure = force / area0,
                             .normal_stiffness = stiffness,
                             .tangential_stiffness = (0.8 + 0.1 * i / 3000) * stiffness});
  }
  const DeckContact contact =
      deck_contact(CurveContact{curve, 0.8, {ControlQuantity::normal_force, {1000}}, "curve"});
  const auto sliders = sliders_of(contact, 60);
  CHECK(sliders.size() > 50);
  double force = 0;
  for (const auto& slider : sliders) force += slider[1];
  CHECK(force == Approx(friction * 1000));
  const JointLoss joint =
      joint_loss(*contact.law, at_force(1000), TangentialForce{0.5 * force}, friction);
  // With 60 sliders the loss is right to a per cent.
  CHECK(loss_of(sliders, 0.5 * force) == Approx(joint.work_per_cycle).epsilon(1e-2));
}

TEST_CASE("The loss at the smallest force is right to 1 % with the sliders by default",
          "[export]") {
  DeckProblem problem;
  problem.contacts = {exponential()};
  problem.format = DeckFormat::jenkins;
  problem.friction_coefficient = friction;
  const DeckSolution answer = solve(problem);
  CHECK(std::abs(answer.loss_error) < 0.01);
  const double q = problem.min_force;
  // At small q the bracket of the closed form cancels, so this is its series.
  const double exact = 8 * friction * friction / modulus_ratio * decay_length * force0 *
                       (q * q * q / 12 + q * q * q * q / 12);
  const double found =
      loss_of(rows_after(answer.text, "stiffness,slider_force"), q * friction * force0);
  // The next term of the series is 3/40 q⁵.
  CHECK(std::abs(found / exact - 1) < std::abs(answer.loss_error) + 2e-4);
  // The stated error holds for forces up to almost all of μF, by the closed form of the loss.
  double worst = 0;
  const auto sliders = rows_after(answer.text, "stiffness,slider_force");
  for (double share = q; share < 0.999; share *= 1.17) {
    const JointLoss joint = joint_loss(*problem.contacts.front().law,
                                       at_indentation(problem.contacts.front().indentation),
                                       TangentialForce{share * friction * force0}, friction);
    worst = std::max(
        worst, std::abs(loss_of(sliders, share * friction * force0) / joint.work_per_cycle - 1));
  }
  CHECK(worst < 1.1 * std::abs(answer.loss_error));
  CHECK(worst > 0.5 * std::abs(answer.loss_error));
  problem.sliders = 10;
  CHECK(std::abs(solve(problem).loss_error) > 0.01);
}
