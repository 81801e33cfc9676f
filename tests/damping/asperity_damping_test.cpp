// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/damping/asperity_damping.hpp>
#include <salebra/damping/dissipation.hpp>

using namespace salebra;

namespace {

const Material soft = Material::of_contact_modulus(3.0, 0.2);

std::vector<Summit> elliptical_summits(int count) {
  std::vector<Summit> summits =
      draw_summits({.summit_density = 1, .radius = 0.5, .summit_rms = 0.1}, count, 1, 7);
  for (std::size_t i = 0; i < summits.size(); ++i)
    summits[i].curvature2 *= 1 - 0.4 * static_cast<double>(i % 5) / 5;
  return summits;
}

const Oscillation motions[] = {
    EqualFrequency{
        .normal_amplitude = 1, .tangential_amplitude = 0.02, .phase = 0.7, .angular_frequency = 3},
    Drag{.normal_amplitude = 1, .drag_velocity = 0.04, .angular_frequency = 5}};

Oscillation with_amplitude(Oscillation motion, double amplitude) {
  std::visit([&](auto& of_kind) { of_kind.normal_amplitude = amplitude; }, motion);
  return motion;
}

}  // namespace

TEST_CASE("Springs of all summits lose what the force law of all summits loses, at any amplitude",
          "[asperities]") {
  // The two methods share nothing: released springs of each summit here, K_t(δ) by parts there.
  const std::vector<Summit> summits = elliptical_summits(60);
  const auto model =
      std::make_shared<DeterministicSummits>(summits, soft, 1, 0, 1, SummitShape::elliptical);
  const GreenwoodWilliamsonLaw law(model);
  for (const Oscillation& kind : motions)
    for (const double amplitude : {0.003, 0.05, 0.4}) {
      const Oscillation motion = with_amplitude(kind, amplitude);
      const double separation = 0.04;
      const AsperityDamping springs =
          asperity_damping(summits, soft, separation, motion, SummitShape::elliptical);
      const DampingResult whole =
          relaxation_damping(law, at_indentation(model->indentation(separation)), motion);
      REQUIRE(whole.converged);
      CHECK(springs.work_per_cycle == Approx(whole.work_per_cycle).epsilon(1e-9));
      CHECK(springs.power == Approx(whole.power).epsilon(1e-9));
      CHECK(springs.damping_constant == Approx(whole.damping_constant).epsilon(1e-9));
      CHECK(springs.small_amplitude_work == Approx(whole.small_amplitude_work).epsilon(1e-12));
      CHECK(springs.max_contacts == model->at(separation - amplitude).contacts);
      CHECK(springs.min_contacts == model->at(separation + amplitude).contacts);
      CHECK(std::accumulate(springs.work.begin(), springs.work.end(), 0.0) ==
            Approx(springs.work_per_cycle).epsilon(1e-14));
    }
}

TEST_CASE("At small amplitude the summits lose Eqs (12), (15) with the F'' of all",
          "[asperities]") {
  const std::vector<Summit> summits = elliptical_summits(60);
  for (const Oscillation& kind : motions) {
    const auto miss = [&](double amplitude) {
      const AsperityDamping damping =
          asperity_damping(summits, soft, 0.04, with_amplitude(kind, amplitude));
      REQUIRE(damping.min_contacts == damping.max_contacts);
      return damping.work_per_cycle / damping.small_amplitude_work - 1;
    };
    // The correction is of first order in u_z in case (b) and of second order in case (a); the
    // limit is Eqs (12), (15). u_z must be small against the indentation of the summit with the
    // smallest one.
    const double coarse = miss(2e-8), fine = miss(1e-8);
    const int order = std::holds_alternative<Drag>(kind) ? 1 : 2;
    CHECK(std::abs(fine - (coarse - fine) / (std::pow(2, order) - 1)) < 1e-9);
  }
}

TEST_CASE("Summits that open lose the intermittent part", "[asperities]") {
  const std::vector<Summit> one{{.curvature1 = 1, .curvature2 = 1}};
  const auto motion = [](double amplitude) {
    return EqualFrequency{.normal_amplitude = amplitude, .tangential_amplitude = 0.1, .phase = 1.5};
  };
  const AsperityDamping closed = asperity_damping(one, soft, -0.2, motion(0.1));
  CHECK(closed.intermittent_work == 0);
  CHECK(closed.min_contacts == 1);
  const AsperityDamping opens = asperity_damping(one, soft, -0.2, motion(0.3));
  CHECK(opens.intermittent_work == opens.work_per_cycle);
  CHECK(opens.min_contacts == 0);
  const AsperityDamping never = asperity_damping(one, soft, 0.2, motion(0.1));
  CHECK(never.work_per_cycle == 0);
  CHECK(never.max_contacts == 0);
  CHECK(asperity_damping(one, soft, -0.2, motion(0)).work_per_cycle == 0);
}

TEST_CASE("Asperity damping refuses what it cannot compute", "[asperities]") {
  const std::vector<Summit> one{{.curvature1 = 1, .curvature2 = 1}};
  CHECK_THROWS_WITH(asperity_damping(one, Material::of_contact_modulus(1), 0, EqualFrequency{}),
                    Catch::Contains("tangential_modulus"));
  CHECK_THROWS_AS(asperity_damping({}, soft, 0, EqualFrequency{}), InvalidInput);
  CHECK_THROWS_AS(asperity_damping(one, soft, 0, Drag{}), InvalidInput);
  CHECK_THROWS_WITH(asperity_damping(one, soft, 0, EqualFrequency{.normal_amplitude = -1}),
                    Catch::Contains("normal_amplitude"));
}
