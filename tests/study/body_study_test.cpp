// SPDX-License-Identifier: GPL-3.0-or-later
// Damping, joints, sliding, oscillations and studies on bodies that are not half-spaces: each number
// asked in two ways.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <salebra/analysis/damping.hpp>
#include <salebra/analysis/oscillation.hpp>
#include <salebra/analysis/sliding.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>
#include <salebra/surface/moments.hpp>

#include "../contact/normal/rough_surface.hpp"
#include "small_study.hpp"

using namespace salebra;
using namespace salebra::test;
using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi, side = 1e-3;

Surface rough() { return rough_surface({48, 48, side, side}, {.seed = 2}); }

/// A rubbery film on steel, as thick as a fiftieth of the period.
Body film() { return Body::layered({{0.02 * side, 1e9, 0.45}}, {210e9, 0.3}); }
/// A pad on a rigid plate, from which the motion is measured.
Body pad() { return Body::layered({{0.05 * side, 1e9, 0.4}}).measured_from(Datum::base); }

constexpr double pressure = 5e6;

DampingProblem problem_on(const Body& body, double friction = ContactParameters::unknown) {
  return {.contact = SurfaceContact{.surface = rough(), .body = body, .pressure = {pressure}},
          .motions = {EqualFrequency{3e-7, 1e-7, pi / 2, 1e5}},
          .parameters = {.friction_coefficient = friction, .density = 1200}};
}

}  // namespace

TEST_CASE("A half-space in a file of a body has the losses of its constants", "[body]") {
  const ElasticBody elastic{2e9, 0.3};
  const auto by_body = solve(problem_on(Body::half_space(elastic))).results[0],
             by_constants = solve(problem_on(Material::of_bodies(elastic))).results[0];
  CHECK(by_body.work_per_cycle == by_constants.work_per_cycle);
  CHECK(by_body.small_amplitude_work == by_constants.small_amplitude_work);
}

TEST_CASE("Damping on a body is that of its contacts, without what only half-spaces have",
          "[body]") {
  const Body body = GENERATE(film(), pad());
  const DampingSolution solution = solve(problem_on(body));
  const DampingResult& result = solution.results[0];
  const ForceCurve curve =
      sweep_pressures(rough(), body, {pressure / 1.35, pressure, 1.35 * pressure}, {.stick = true});
  const SurfaceDamping loss =
      surface_damping(rough(), body, oscillation_of(problem_on(body).motions[0]).value(), curve)[1];
  // The neighbouring loads, from which the change of K_t/K follows, are the same thirteen.
  CHECK(result.work_per_cycle == Approx(loss.work_per_cycle).epsilon(1e-9));
  CHECK(result.tangential_stiffness == Approx(curve.samples[1].tangential_stiffness).epsilon(1e-9));
  CHECK(solution.leaving_share == std::vector<double>{loss.leaving_share});
  CHECK(std::isnan(result.small_amplitude_work));
  CHECK(std::isnan(solution.ratio[0]));
  DampingProblem small = problem_on(body);
  small.amplitude = Amplitude::small;
  CHECK_THROWS_WITH(solve(small), Contains("amplitude: small needs G*/E*"));
  DamperProblem damper{
      .contact = SurfaceContact{.surface = rough(), .body = body, .pressure = {pressure}},
      .normal_amplitude = {3e-7},
      .angular_frequency = {1e5},
      .falling_slope = 1};
  CHECK_THROWS_WITH(solve(damper), Contains("falling_slope"));
  // Density alone does not give a wave speed here, and Dundurs' constant has no meaning.
  CHECK(solution.assumptions[0].inertia.verdict == Verdict::unknown);
  CHECK(solution.assumptions[0].inertia.needs.empty());
  CHECK(solution.assumptions[0].coupling.verdict == Verdict::unknown);
}

TEST_CASE("A joint on a body loses what its simulation cell by cell loses", "[body]") {
  const Body body = GENERATE(film(), pad());
  JointProblem problem{
      .contact = SurfaceContact{.surface = rough(), .body = body, .pressure = {pressure}},
      .motions = {TangentialAmplitude{2e-7}},
      .parameters = {.friction_coefficient = 0.3}};
  // At half of the displacement at which the contact slides, many cells slip.
  problem.motions = {TangentialAmplitude{solve(problem).losses[0].knee / 2}};
  problem.direct_steps = 64;
  const JointSolution joint = solve(problem);
  CAPTURE(joint.losses[0].work_per_cycle, joint.losses[0].work_error,
          joint.simulated[0].work_per_cycle);
  REQUIRE(joint.losses[0].regime == Regime::partial_slip);
  // The simulation is on the given cells; the error of the loss contains these. Its steps leave
  // about 1 %.
  CHECK(std::abs(joint.losses[0].work_per_cycle - joint.simulated[0].work_per_cycle) <
        joint.losses[0].work_error + 0.01 * joint.simulated[0].work_per_cycle);
  // Springs in series: the pad shears as a whole under the mean traction.
  const double K_t =
      solve(JointProblem{.contact = SurfaceContact{.surface = rough(),
                                                   .body = pad().measured_from(Datum::mean_plane),
                                                   .pressure = {pressure}},
                         .motions = {TangentialAmplitude{2e-7}},
                         .parameters = {.friction_coefficient = 0.3}})
          .state.tangential_stiffness;
  const double shear = pad().compliance(0).in_plane / (side * side);
  if (body.datum() == Datum::base)
    CHECK(1 / joint.state.tangential_stiffness == Approx(1 / K_t + shear).epsilon(2e-3));
}

TEST_CASE("Sliding on a body has the relaxation damping of its loss", "[body]") {
  const ContactSolution contact = solve(SurfaceContact{
      .surface = rough(), .body = film(), .pressure = {pressure}, .normal_amplitude = 3e-7});
  const SlidingSolution sliding = solve(SlidingProblem{{3e-7}, 1e5, 0.3, {1e-4}}, contact, film());
  DampingProblem problem = problem_on(film());
  problem.motions = {Drag{3e-7, 1e-6, 1e5}};
  const DampingResult loss = solve(problem).results[0];
  const auto& [state, errors] = std::tie(sliding.points[0].state, sliding.points[0].errors);
  CHECK(std::abs(state.relaxation_damping - loss.damping_constant) <
        errors.relaxation_damping_error + loss.damping_constant_error());
}

TEST_CASE("A cycle on a body by intervals and by steps, with and without slip", "[body]") {
  OscillationCase contact;
  contact.material = film();
  contact.body.surface = rough();
  contact.body.boundary = Boundary::periodic;
  contact.motion = EqualFrequency{3e-7, 1e-7, pi / 2, 1e5};
  contact.indentation = mean_indentation(contact.body, contact.material, at_pressure(pressure));
  OscillationRoutes routes;
  routes.intervals.intervals = 16;
  routes.frictional = true;
  routes.cycle.friction_coefficient = 1e3;  // nothing slips but the last cells before they open
  OscillationOutcome outcome = oscillation_by_intervals(contact, routes);
  simulate_cycles(outcome, routes, [](const CycleOptions& options, const auto& simulate) {
    return simulate(options);
  });
  const double work = outcome.intervals.work_per_cycle;
  CHECK(std::abs(outcome.cycle->work_per_cycle - work) <
        outcome.cycle->step_error + outcome.intervals.error_estimate + 0.01 * work);
  CHECK(outcome.frictional->work_per_cycle == Approx(work).epsilon(0.03));
  CHECK(std::isnan(outcome.intervals.small_amplitude_work));
  routes.coupled = true;
  CHECK_THROWS_WITH(simulate_cycles(outcome, routes,
                                    [](const CycleOptions& options, const auto& simulate) {
                                      return simulate(options);
                                    }),
                    Contains("coupled") && Contains("half-spaces"));
}

TEST_CASE("The pressure scale of a body is twice the rms pressure of full contact", "[body]") {
  const Surface surface = rough();
  const Material material = Material::of_contact_modulus(3e9, 0.3);
  // The surface has no waves near the grid's, whose slope the moments would take for less.
  CHECK(pressure_scale(surface, material) ==
        Approx(3e9 * surface_moments(surface).rms_slope()).epsilon(1e-9));
  const Grid2D grid{32, 8, side, side / 4};
  Field wave(grid.nx, grid.ny);
  for (Index i = 0; i < grid.nx; ++i)
    wave.row(i) = 1e-6 * std::cos(2 * pi * 3 * double(i) / double(grid.nx));
  const double full = 1e-6 / pad().compliance(2 * pi * 3 / side).normal;
  CHECK(pressure_scale({grid, wave, true, "wave"}, pad()) ==
        Approx(std::sqrt(2.0) * full).epsilon(1e-12));
}

TEST_CASE("A study on a body has the contacts of a sweep and the losses of its surfaces",
          "[body]") {
  std::string text = study_text("seeds = [1]", 6);
  const std::string constants = "contact_modulus = \"10GPa\"\npoisson = 0.3\n";
  text.erase(text.find(constants), constants.size());
  text += R"([body]
datum = "base"
[[body.layer]]
thickness = "0.5um"
young = "5GPa"
poisson = 0.4
)";
  const StudyConfiguration study = parse_study_configuration(text, "body.toml");
  REQUIRE(study.body);
  const StudyResult result = run_study(study);
  const StudySolution solution = solution_of(result);
  const Surface surface = study_surface(study, 1);
  // Relative pressures are those of the scale of this surface, at the mean slope of all surfaces, by
  // which a half-space has E*h'.
  const double mean_slope = std::get<GeneratedSurfaces>(study.surfaces)
                                .spectrum_of_all()
                                ->lattice_moments(surface.grid)
                                .rms_slope();
  CHECK(result.pressures[0] == Approx(1e-3 * pressure_scale(surface, *study.body) * mean_slope /
                                      surface_moments(surface).rms_slope())
                                   .epsilon(1e-9));
  const ForceCurve curve = sweep_pressures(surface, *study.body, result.pressures, {.stick = true});
  const auto losses = surface_damping(surface, *study.body, study.motion, curve,
                                      surface_damping_options(study, surface.grid, 1));
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    CAPTURE(k);
    const ForceSample& sample = curve.samples[k];
    CHECK(result.curve(&ForceSample::normal_stiffness)[k].mean ==
          Approx(sample.normal_stiffness).epsilon(1e-6));
    CHECK(result.curve(&ForceSample::tangential_stiffness)[k].mean ==
          Approx(sample.tangential_stiffness).epsilon(1e-6));
    const double constant = solution.damping_constant[k].mean;
    if (std::isfinite(constant))
      CHECK(constant == Approx(losses[k].damping_constant).epsilon(1e-6));
  }
  CHECK(std::isnan(result.damping(&DampingPoint::work_per_cycle_closed_form)[2].mean));

  // A half-space in place of the moduli is these moduli, with all models.
  StudyConfiguration half_spaces = study;
  half_spaces.models = parse_study_configuration(study_text("seeds = [1]", 6), "m.toml").models;
  half_spaces.press_on(Body::half_space({9.1e9, 0.3}));
  CHECK_FALSE(half_spaces.body);
  CHECK(half_spaces.models.size() > 1);
  CHECK(study_loads(half_spaces).contact_scale == Approx(1e10 * mean_slope).epsilon(1e-12));

  // A curve knows its body, also from a file.
  for (const char* name : {"salebra_curve_of_body.csv", "salebra_curve_of_body.h5"}) {
    const auto path = std::filesystem::temp_directory_path() / name;
    write_force_curve(path, curve, {}, {.overwrite = true});
    CHECK(read_force_curve(path).body == study.body->fingerprint());
    std::filesystem::remove(path);
  }
  CHECK_THROWS_WITH(
      surface_damping(surface, study.body->measured_from(Datum::mean_plane), study.motion, curve),
      Contains("curve: is that of another body"));
  CHECK_THROWS_WITH(
      surface_damping(surface, Material::of_contact_modulus(1e10, 0.3), study.motion, curve),
      Contains("curve: is that of another body"));

  // What is known for half-spaces only is refused by name.
  StudyConfiguration other = study;
  other.models = {ContactModel::bem, ContactModel::gw_moments};
  CHECK_THROWS_WITH(study_loads(other),
                    Contains("body: given together with the models of summits"));
  other = study;
  other.known.hardness = 1e9;
  CHECK_THROWS_WITH(study_loads(other), Contains("body: given together with a `hardness`"));
  CHECK_THROWS_WITH(parse_study_configuration(text.replace(text.find("[material]\n"), 11,
                                                           "[material]\nyoung = \"1GPa\"\n"),
                                              "both.toml"),
                    Contains("material.young: is given together with [body]"));
}
