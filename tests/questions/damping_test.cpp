// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/questions/damping.hpp>
#include <vector>

#include "questions/answer_json.hpp"

using namespace salebra;

namespace {

constexpr double pi = std::numbers::pi, omega = 2 * pi * 2e4, ratio = 1.4 / 1.7;
const ExponentialContact contact{1e-7, ratio, {1}};

}  // namespace

TEST_CASE("A damping constant does not ask for the velocity of the slow motion", "[questions]") {
  const DampingAnswer moving = ask(DampingQuestion{
      .contact = contact, .motions = {Drag{2e-8, 1e-3, omega}, Drag{2e-8, 1e-6, omega}}});
  const DamperAnswer damper = ask(DamperQuestion{
      .contact = contact, .normal_amplitude = {1e-8, 2e-8}, .angular_frequency = {omega}});
  REQUIRE(moving.results.size() == 2);
  // Both are quadratures to 1e-10.
  for (const DampingResult& result : moving.results)
    CHECK(damper.map.damping_constant(1, 0) == Approx(result.damping_constant).epsilon(1e-9));
  CHECK(answer_json(moving)["damping_constant"].size() == 2);
}

TEST_CASE("Much friction is no slip, and little of it loses less by relaxation", "[questions]") {
  const EqualFrequency motion{5e-9, 2e-9, pi / 3, omega};
  const auto with = [&](double friction) {
    ContactFacts facts;
    facts.friction_coefficient = friction;
    return ask(DampingQuestion{.contact = contact, .motions = {motion}, .facts = facts});
  };
  const DampingAnswer much = with(1e5), little = with(0.1);
  // 2000 straight steps, of second order.
  CHECK(much.with_slip.at(0).work_per_cycle ==
        Approx(much.results.at(0).work_per_cycle).epsilon(1e-4));
  CHECK(little.with_slip.at(0).relaxation_work < much.results.at(0).work_per_cycle);
  CHECK(little.results.at(0).work_per_cycle == much.results.at(0).work_per_cycle);
  CHECK(ask(DampingQuestion{.contact = contact, .motions = {motion}}).with_slip.empty());
}

TEST_CASE("A slow motion that turns back slips less than one that goes on", "[questions]") {
  ContactFacts facts;
  facts.friction_coefficient = 0.3;
  const auto slow = [&] {
    return ask(DampingQuestion{
                   .contact = contact, .motions = {Drag{2e-8, 1e-5, omega}}, .facts = facts})
        .with_slip.at(0);
  };
  const TrajectoryDamping on = slow();
  facts.excursion = 100 * 2 * pi * 1e-5 / omega;  // a hundred normal cycles
  const TrajectoryDamping back = slow();
  CHECK(back.slip_work < on.slip_work);
  CHECK(back.damping_constant ==
        Approx(back.work_per_cycle * omega / (2 * pi) / 1e-10).epsilon(1e-12));
}

TEST_CASE("Cases that do not match in number are refused", "[questions]") {
  const DampingQuestion question{.contact = ExponentialContact{1e-7, ratio, {1, 2, 3}},
                                 .motions = {Drag{1e-8, 1e-3, omega}, Drag{2e-8, 1e-3, omega}}};
  CHECK_THROWS_AS(ask(question), InvalidInput);
}
