// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/analysis/damping.hpp>
#include <salebra/analysis/sliding.hpp>
#include <salebra/base/error.hpp>
#include <vector>

#include "results/answer_json.hpp"
#include "study/cost.hpp"

using namespace salebra;

namespace {

constexpr double pi = std::numbers::pi, omega = 2 * pi * 2e4, ratio = 1.4 / 1.7;
const ExponentialContact contact{1e-7, ratio, {1}};

}  // namespace

TEST_CASE("A damping constant does not ask for the velocity of the slow motion", "[analysis]") {
  const DampingSolution moving = solve(DampingProblem{
      .contact = contact, .motions = {Drag{2e-8, 1e-3, omega}, Drag{2e-8, 1e-6, omega}}});
  const DamperSolution damper = solve(DamperProblem{
      .contact = contact, .normal_amplitude = {1e-8, 2e-8}, .angular_frequency = {omega}});
  REQUIRE(moving.results.size() == 2);
  // Both are quadratures with an error of 1e-10.
  for (const DampingResult& result : moving.results)
    CHECK(damper.map.damping_constant(1, 0) == Approx(result.damping_constant).epsilon(1e-9));
  CHECK(answer_json(moving)["damping_constant"].size() == 2);
}

TEST_CASE("Much friction is no slip, and little of it loses less by relaxation", "[analysis]") {
  const EqualFrequency motion{5e-9, 2e-9, pi / 3, omega};
  const auto with = [&](double friction) {
    ContactParameters parameters;
    parameters.friction_coefficient = friction;
    return solve(DampingProblem{.contact = contact, .motions = {motion}, .parameters = parameters});
  };
  const DampingSolution much = with(1e5), little = with(0.1);
  // 2000 straight steps, at second order.
  const DampingSolution without = solve(DampingProblem{.contact = contact, .motions = {motion}});
  const double stuck = without.results.at(0).work_per_cycle;
  CHECK(much.results.at(0).work_per_cycle == Approx(stuck).epsilon(1e-4));
  CHECK(little.results.at(0).relaxation_work < 0.99 * stuck);
  CHECK(little.results.at(0).work_per_cycle_without_slip == stuck);
  CHECK(little.results.at(0).damping_constant_without_slip ==
        without.results.at(0).damping_constant);
  CHECK(std::isnan(without.results.at(0).slip_share()));
  CHECK(!answer_json(without).contains("slip_share"));
}

TEST_CASE("What decides and is missing leaves the loss unknown, with what to give", "[analysis]") {
  ContactParameters parameters;
  parameters.friction_coefficient = 0.3;
  const double way = 2 * pi * 1e-5 / omega;  // distance per normal cycle
  const auto ask_of = [&](const Motion& motion, const std::string& why) {
    const DampingSolution solution =
        solve(DampingProblem{.contact = contact, .motions = {motion}, .parameters = parameters});
    CHECK(std::isnan(solution.results.at(0).work_per_cycle) == !why.empty());
    CHECK(std::isnan(solution.results.at(0).damping_constant) == !why.empty());
    CHECK(std::isnan(solution.results.at(0).slip_share()) == !why.empty());
    CHECK(solution.results.at(0).damping_constant_without_slip > 0);
    if (!why.empty()) CHECK_THAT(solution.warnings.at(0), Catch::Contains(why));
    return solution.results.at(0);
  };
  const Drag slow{2e-8, 1e-5, omega};
  ask_of(slow, "`excursion`; give it");
  parameters.excursion = 0.9 * way;
  ask_of(slow, "reverses within one normal cycle");
  parameters.excursion = 100 * way;
  const DampingResult back = ask_of(slow, "");
  CHECK(back.damping_constant ==
        Approx(back.work_per_cycle * omega / (2 * pi) / 1e-10).epsilon(1e-12));
  CHECK(back.power == Approx(back.work_per_cycle * omega / (2 * pi)).epsilon(1e-12));
}

TEST_CASE("Cases that do not match in number are refused", "[analysis]") {
  const DampingProblem problem{.contact = ExponentialContact{1e-7, ratio, {1, 2, 3}},
                               .motions = {Drag{1e-8, 1e-3, omega}, Drag{2e-8, 1e-3, omega}}};
  CHECK_THROWS_AS(solve(problem), InvalidInput);
}

TEST_CASE("A joint is that of its law, and what a surface alone has is refused of a law",
          "[analysis]") {
  JointProblem problem{.contact = contact,
                       .motions = {TangentialAmplitude{2e-9}, TangentialForce{0.05}}};
  problem.parameters.friction_coefficient = 0.3;
  const JointSolution constant = solve(problem);
  const ExponentialLaw law(1, 1e-7, ratio);
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(constant.losses.at(i).work_per_cycle ==
          joint_loss(law, at_force(1), problem.motions[i], 0.3).work_per_cycle);
  CHECK(constant.state.normal_stiffness == Approx(1e7));  // F/l
  // The larger of the two motions is judged.
  CHECK(constant.largest.tangential_amplitude ==
        std::max(2e-9, constant.losses[1].tangential_amplitude));
  problem.normal_amplitude = 2e-8;
  problem.phase = pi / 2;
  const JointSolution shaken = solve(problem);
  CHECK(shaken.losses.at(0).work_per_cycle ==
        joint_loss(law, at_force(1), {problem.motions[0], 2e-8, pi / 2}, 0.3).work_per_cycle);
  CHECK(shaken.simulated.empty());

  problem.direct_steps = 16;
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("direct_steps"));
  problem.direct_steps = {};
  problem.contact = ExponentialContact{1e-7, ratio, {1, 2}};
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("2 operating points"));
}

TEST_CASE("An solution has what is there: estimates as members, words as lists, structs as objects",
          "[analysis]") {
  const StudyCost cost{{.seconds = 3}, {{.pressures = {1, 2}, .surfaces = 4, .warnings = {"few"}}}};
  const Json plan = answer_json(cost);
  CHECK(plan["seconds"].number() == 3);
  REQUIRE(plan["points"].size() == 1);
  CHECK(plan["points"][0]["pressure"].size() == 2);
  CHECK(plan["points"][0]["warnings"][0].text() == "few");
  SliderThresholds thresholds;
  CHECK(answer_json(thresholds).empty());
  thresholds.amplitude = {.value = 1e-9};
  CHECK(answer_json(thresholds).size() == 1);
  CHECK(answer_json(thresholds)["threshold_amplitude"]["value"].number() == 1e-9);
}
