// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_file.hpp>
#include <salebra/study/study_solution.hpp>

#include "io/scratch.hpp"
#include "ranks_in_threads.hpp"
#include "small_study.hpp"
#include "study/estimate.hpp"
#include "study_text.hpp"

using namespace salebra;

TEST_CASE("The Student interval of a mean is the textbook's", "[study]") {
  const EnsembleMean estimate = student_mean({1, 2, 3, 4});
  // t(0.975, 3) = 3.18244630528371; s = sqrt(5/3).
  CHECK(estimate.mean == 2.5);
  CHECK(estimate.high - 2.5 == Approx(3.18244630528371 * std::sqrt(5. / 3) / 2).epsilon(1e-10));
  CHECK(2.5 - estimate.low == Approx(estimate.high - 2.5).epsilon(1e-14));
  CHECK(student_mean({1, std::nan(""), 3}).mean == 2);
  // A precision of 25 % is ±25 % of the mean, of either sign.
  CHECK(EnsembleMean{2, 1.5, 2.5}.relative_precision() == 0.25);
  CHECK(EnsembleMean{-2, -2.5, -1.5}.relative_precision() == 0.25);
  CHECK(std::isnan(student_mean({7}).low));
  CHECK(std::isnan(student_mean({}).mean));
}

TEST_CASE(
    "Eq. (16) in a study is Eq. (16) of the fit, and the curve is near it where the curve is "
    "exponential",
    "[study]") {
  const StudyResult result = run_study(small_study());
  REQUIRE(result.realisations.size() == 3);
  const auto& drag = std::get<Drag>(result.configuration.motion);
  const double ratio = result.configuration.material.modulus_ratio();
  for (const Realisation& realisation : result.realisations) {
    REQUIRE(realisation.of(ContactModel::bem).damping.size() == 12);
    const DampingPoint& point = realisation.of(ContactModel::bem).damping[5];
    CHECK(point.work_per_cycle_closed_form ==
          Approx(closed_form::work_per_cycle_rough(
                     ratio, point.force, realisation.of(ContactModel::bem).fit.decay_length, drag))
              .epsilon(1e-12));
    // γ = P/v².
    CHECK(point.damping_constant ==
          Approx(point.work_per_cycle * drag.angular_frequency / (2 * std::numbers::pi) /
                 (drag.drag_velocity * drag.drag_velocity))
              .epsilon(1e-12));
    CHECK(point.force == Approx(point.pressure * 16e-12).epsilon(1e-12));
    // l varies by tens of per cent along the curve, and F'' with its square.
    CHECK(std::abs(point.deviation()) < 0.8);
  }
  CHECK(result.realisations[0].of(ContactModel::bem).fit.decay_length !=
        result.realisations[1].of(ContactModel::bem).fit.decay_length);
  CHECK(result.decay_length(ContactModel::bem).low < result.decay_length(ContactModel::bem).high);
}

TEST_CASE("How far Eq. (16) is off follows from the two columns beside it", "[study]") {
  StudyResult result = run_study(small_study());
  REQUIRE(result.realisations.size() == 3);
  // For surfaces that scatter, the mean of the ratios, 1.75, is a different number.
  const std::array law{3.0, 2.0, 5.0}, computed{1.0, 2.0, 4.0};
  for (std::size_t i = 0; i < 3; ++i) {
    DampingPoint& point = result.realisations[i].of(ContactModel::bem).damping[5];
    point.damping_constant_closed_form = law[i];
    point.damping_constant_without_slip = computed[i];
    point.error_without_slip = {};
  }
  const auto deviation = result.deviation();
  const double ratio = 10.0 / 7;
  CHECK(deviation[5].mean == Approx(ratio - 1).epsilon(1e-14));
  CHECK(result.damping("deviation")[5].mean == deviation[5].mean);
  // Variance of a ratio of means to first order, from both variances and the covariance.
  const double s_law = 14.0 / 6, s_computed = 14.0 / 6, covariance = 11.0 / 6;
  const double variance =
      (s_law + ratio * ratio * s_computed - 2 * ratio * covariance) / 3 / (7.0 / 3) / (7.0 / 3);
  constexpr double student = 4.302652729911275;  // t of 97.5 %, two degrees of freedom
  CHECK(deviation[5].low == Approx(ratio - 1 - student * std::sqrt(variance)).epsilon(1e-10));
  CHECK(deviation[5].high == Approx(ratio - 1 + student * std::sqrt(variance)).epsilon(1e-10));
  // The same holds at every load.
  const auto by_law = result.damping("damping_constant_closed_form"),
             stated = result.damping("damping_constant_without_slip");
  for (std::size_t k = 0; k < deviation.size(); ++k)
    if (!std::isnan(deviation[k].mean))
      CHECK(deviation[k].mean == Approx(by_law[k].mean / stated[k].mean - 1).epsilon(1e-12));
  CHECK(std::isnan(deviation[0].mean) ==
        (std::isnan(by_law[0].mean) || std::isnan(stated[0].mean)));
}

TEST_CASE("Eight surfaces say how many an interval needs", "[study]") {
  const auto study = [](int seeds) {
    return run_study(parse_study_configuration(
        study_text(fmt::format("first_seed = 1\nseed_count = {}", seeds), 6) + "intervals = 0\n",
        "x.toml"));
  };
  const StudyResult few = study(8), many = study(32);
  CHECK_THROWS_WITH(surfaces_for(few, 0), Catch::Contains("precision"));
  const auto reached = many.stated("damping_constant");
  std::vector<double> counts;
  for (std::size_t k = 0; k < reached.size(); ++k)
    if (!std::isnan(reached[k].low))
      counts.push_back(surfaces_for(few, reached[k].relative_precision())[k]);
  // The number follows from the variance of eight surfaces, which is known to √(2/7) for normal
  // values; all loads share this error. The limits are two of these deviations, and 1.18² from t
  // for few surfaces.
  REQUIRE(counts.size() >= 4);
  std::ranges::sort(counts);
  const double median = counts[counts.size() / 2];
  INFO(counts.front() << ' ' << median << ' ' << counts.back());
  CHECK(median > 32 / 2.1);
  CHECK(median < 32 * 2.1 * 1.4);
  CHECK(std::isnan(surfaces_for(study(1), 0.1)[3]));
}

TEST_CASE("A study is the same in every bit for one and two threads and when run again",
          "[study]") {
  StudyConfiguration configuration = small_study();
  std::get<GeneratedSurfaces>(configuration.surfaces).seeds = {4};
  parallel::set_threads(1);
  const StudyResult one = run_study(configuration);
  parallel::set_threads(2);
  const StudyResult two = run_study(configuration);
  parallel::set_threads(0);
  CHECK(one.realisations[0].of(ContactModel::bem).fit.decay_length ==
        two.realisations[0].of(ContactModel::bem).fit.decay_length);
  for (std::size_t i = 0; i < one.pressures.size(); ++i) {
    const double a = one.realisations[0].of(ContactModel::bem).damping[i].work_per_cycle,
                 b = two.realisations[0].of(ContactModel::bem).damping[i].work_per_cycle;
    CHECK((a == b || (std::isnan(a) && std::isnan(b))));
  }
}

TEST_CASE("A stopped study holds the realisations that were finished", "[study]") {
  int calls = 0;
  const StudyResult result = run_study(small_study(), {[&](const ProgressReport& report) {
                                         ++calls;
                                         return report.fraction < 0.5;
                                       }});
  CHECK(calls > 1);
  CHECK(result.interrupted);
  CHECK(result.realisations.size() < 3);
}

TEST_CASE("A study's file holds its curves and fits with units", "[study]") {
  StudyConfiguration configuration = small_study();
  std::get<GeneratedSurfaces>(configuration.surfaces).seeds = {4, 5};
  const StudyResult result = run_study(configuration);
  const auto file = std::filesystem::temp_directory_path() /
                    ("salebra-study-" + std::to_string(getpid()) + ".h5");
  write_study(file, result, {}, {.overwrite = true});
  const ResultReader reader(file);
  CHECK(reader.coordinates("curve/mean_gap") ==
        std::vector<std::string>{"model", "realisation", "pressure"});
  CHECK(reader.shape("curve/mean_gap") == std::vector<Index>{3, 2, 12});
  CHECK(reader.text_attribute("curve/mean_gap", "units") == "m");
  CHECK(reader.numbers("curve/pressure") == result.pressures);
  CHECK(reader.numbers("fit/decay_length")[1] ==
        result.realisations[1].of(ContactModel::bem).fit.decay_length);
  CHECK(reader.numbers("damping/work_per_cycle")[12 + 5] ==
        result.realisations[1].of(ContactModel::bem).damping[5].work_per_cycle);
  CHECK(reader.text_attribute("/", "configuration") == configuration.text);
  std::filesystem::remove(file);
}

TEST_CASE("A study without a surface is refused", "[study]") {
  StudyConfiguration configuration = small_study();
  configuration.surfaces = MeasuredSurface{};
  CHECK_THROWS_AS(run_study(configuration), InvalidInput);
}

TEST_CASE("A window of the fit that holds no pressures is refused before anything is computed",
          "[study]") {
  // Relative pressures are known only with the surface; here they are of order 1e6 Pa and more.
  const StudyConfiguration configuration =
      small_study("[fit]\npressure_window = [\"1Pa\", \"2Pa\"]\n");
  CHECK_THROWS_WITH(run_study(configuration), Catch::Contains("pressure_window: 0 pressures"));
}

TEST_CASE("Curves without a decay length keep their damping, and the study says so", "[study]") {
  const StudyResult result = run_study(parse_study_configuration(close_study_text(), "few.toml"));
  REQUIRE(result.realisations.size() == 2);
  for (const Realisation& realisation : result.realisations) {
    CHECK(std::isnan(realisation.of(ContactModel::bem).fit.decay_length));
    CHECK(std::isnan(realisation.of(ContactModel::bem).test.decay_length_at_min_gap));
    CHECK(realisation.of(ContactModel::bem).damping.size() == 5);
    for (const DampingPoint& point : realisation.of(ContactModel::bem).damping)
      CHECK(std::isnan(point.work_per_cycle_closed_form));
    CHECK(std::ranges::any_of(realisation.of(ContactModel::bem).damping,
                              [](const DampingPoint& point) { return point.work_per_cycle > 0; }));
  }
  CHECK(std::ranges::any_of(result.warnings, [](const std::string& warning) {
    return warning.starts_with("bem: no decay length on 2 of 2 surfaces");
  }));
}

TEST_CASE("Damping of a study rests on K_t of stick solves, which at nu = 0 is (G*/E*)K",
          "[study]") {
  StudyConfiguration configuration = small_study();
  std::get<GeneratedSurfaces>(configuration.surfaces).seeds = {1};
  const double poisson = GENERATE(0.0, 0.3);
  configuration.material = Material::of_contact_modulus(10e9, poisson);
  const StudyResult stick = run_study(configuration);
  configuration.stick = false;
  const StudyResult proportional = run_study(configuration);
  double largest = 0;
  for (std::size_t i = 0; i < stick.pressures.size(); ++i) {
    const double a = stick.realisations[0].of(ContactModel::bem).damping[i].work_per_cycle,
                 b = proportional.realisations[0].of(ContactModel::bem).damping[i].work_per_cycle;
    REQUIRE(std::isnan(a) == std::isnan(b));
    if (!std::isnan(a)) largest = std::max(largest, std::abs(a / b - 1));
  }
  // At ν = 0 the kernels coincide, and both solves stop within 1e-5 of K. Otherwise the patches are
  // not round.
  if (poisson == 0)
    CHECK(largest < 3e-3);
  else
    CHECK(largest > 3e-3);
}

TEST_CASE("Moduli that no elastic body has leave a study with (G*/E*)K, and it says so",
          "[study]") {
  StudyConfiguration configuration = small_study();
  std::get<GeneratedSurfaces>(configuration.surfaces).seeds = {1};
  configuration.material = Material::of_moduli(10e9, 2e9);
  const StudyResult result = run_study(configuration);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings[0], Catch::Contains("leave out the stick solves"));
  const ForceSample& sample = result.realisations[0].of(ContactModel::bem).curve.samples[5];
  CHECK(sample.tangential_stiffness == Approx(0.2 * sample.normal_stiffness));
}

TEST_CASE("The surface of a seed is made by several processes to the bits of one",
          "[study][share]") {
  StudyConfiguration study = small_study();
  std::get<GeneratedSurfaces>(study.surfaces).method =
      GENERATE(GenerationMethod::filtered_noise, GenerationMethod::random_phase);
  const Surface alone = study_surface(study, 2);
  std::atomic<int> right = 0;
  salebra::testing::run_ranks(3, [&](const Communicator& together) {
    const Surface mine = study_surface(study, 2, {}, together);
    const RowPartition rows = mine.partition();
    right += together.size() == mine.communicator.size() && mine.origin == alone.origin &&
             mine.heights.rows() == rows.count() &&
             std::memcmp(mine.heights.data(), alone.heights.data() + rows.begin() * alone.grid.ny,
                         static_cast<std::size_t>(mine.heights.size()) * sizeof(double)) == 0;
  });
  CHECK(right == 3);
}

TEST_CASE(
    "A table of a power spectrum makes the surfaces of its law, and of several each seed has its "
    "own",
    "[study]") {
  // Plateau, corner and end of the spectrum with H = 0.8 are straight lines in ln C over ln q, so
  // the table is the same law.
  const StudyConfiguration law = small_study();
  const auto& recipe = std::get<GeneratedSurfaces>(law.surfaces);
  const SelfAffineSpectrum spectrum(recipe.spectrum);
  const double corner = 2 * std::numbers::pi / *recipe.spectrum.rolloff,
               end = spectrum.highest_wavenumber() * (1 + 1e-12);
  const SpectrumTable table{
      {1e-3 * corner, corner, end},
      {spectrum.plateau(), spectrum.plateau(), spectrum.plateau() * std::pow(end / corner, -3.6)}};
  const auto folder = std::filesystem::temp_directory_path();
  const std::string name = "salebra-psd-" + std::to_string(getpid()) + ".txt";
  {
    std::ofstream file(folder / name);
    file.precision(17);
    file << "# q, C\n";
    for (std::size_t k = 0; k < 3; ++k) file << table.wavenumber[k] << ' ' << table.psd[k] << '\n';
  }
  const std::string surface =
      "[surface]\npoints = 64\nsize_x = \"4um\"\npsd_table = \"" + name + "\"\nseeds = [1, 2]\n";
  StudyConfiguration tabulated =
      parse_study_configuration(surface + contact_text(), "x.toml", folder);
  std::filesystem::remove(folder / name);
  // Powers and logarithms round differently.
  const auto heights = [](const StudyConfiguration& study, std::uint64_t seed) {
    return study_surface(study, seed).heights;
  };
  const Field of_law = heights(law, 2), of_table = heights(tabulated, 2);
  CHECK((of_law - of_table).abs().maxCoeff() < 1e-9 * of_law.abs().maxCoeff());
  CHECK(study_loads(tabulated).contact_scale ==
        Approx(study_loads(law).contact_scale).epsilon(1e-9));
  // Heights are proportional to the root of the density. Of the table of all and two others, seeds
  // 4 and 5 use the second, 2 and 3 the third.
  auto& tables = std::get<GeneratedSurfaces>(tabulated.surfaces).tables;
  for (const double factor : {4, 9}) {
    tables.push_back(table);
    for (double& density : tables.back().psd) density *= factor;
  }
  CHECK((heights(tabulated, 4) - 2 * heights(law, 4)).abs().maxCoeff() <
        1e-8 * of_law.abs().maxCoeff());
  CHECK((heights(tabulated, 3) - 3 * heights(law, 3)).abs().maxCoeff() <
        1e-8 * of_law.abs().maxCoeff());
  CHECK(study_loads(tabulated).contact_scale ==
        Approx(study_loads(law).contact_scale).epsilon(1e-9));
  CHECK_THROWS_WITH(parse_study_configuration(surface + contact_text(), "x.toml", folder),
                    Catch::Contains(name));  // the file is gone
}

TEST_CASE("Conductances of a study are its stiffness times a constant, and so are their intervals",
          "[study]") {
  StudyConfiguration configuration =
      small_study("[conduction]\nconductivity = [\"50W/mK\", \"400W/mK\"]\nresistivity = 2e-8\n");
  configuration.intervals = 0;
  const StudyResult result = run_study(configuration);
  const StudySolution answer = solution_of(result);
  const auto stiffness = result.curve(&ForceSample::normal_stiffness);
  const double modulus = configuration.material.contact_modulus, area = result.grid.area();
  REQUIRE(answer.thermal_conductance.size() == result.pressures.size());
  for (std::size_t k = 0; k < stiffness.size(); ++k) {
    const double thermal = thermal_conductance(1 / area, modulus, 50, 400),
                 electrical = electrical_conductance(1 / area, modulus, 2e-8, 2e-8);
    for (double EnsembleMean::*part :
         {&EnsembleMean::mean, &EnsembleMean::low, &EnsembleMean::high}) {
      CHECK(answer.thermal_conductance[k].*part == Approx(thermal * stiffness[k].*part));
      CHECK(answer.electrical_conductance[k].*part == Approx(electrical * stiffness[k].*part));
    }
  }
  // The conductivities of the bodies do not change the surfaces, but they change the result.
  StudyConfiguration other = configuration;
  other.conduction = {};
  CHECK(StudyParts::keys(other) == StudyParts::keys(configuration));
  CHECK(solution_of({.configuration = other,
                     .grid = result.grid,
                     .pressures = result.pressures,
                     .realisations = result.realisations})
            .thermal_conductance.empty());
}

TEST_CASE("A study has the flow through the gap of each contact where it is asked for",
          "[study][flow]") {
  StudyConfiguration configuration = small_study();
  configuration.intervals = 0;
  CHECK(
      std::isnan(run_study(configuration).flow(&FlowFactors::pressure_flow_factor_x).front().mean));
  const auto keys = StudyParts::keys(configuration);
  configuration.flow_factors = true;
  CHECK(StudyParts::keys(configuration) != keys);
  const StudyResult result = run_study(configuration);
  const Realisation& first = result.realisations.front();
  const Surface surface = study_surface(configuration, first.seed);
  NormalContactOptions options;
  options.tolerance = configuration.tolerance;
  for (const std::size_t k : {std::size_t(0), result.pressures.size() - 1}) {
    const FlowFactors flow = flow_factors(press(surface, configuration.material.contact_modulus,
                                                at_pressure(result.pressures[k]), options),
                                          surface.grid);
    CHECK(first.flow[k].percolates_x == flow.percolates_x);
    if (flow.percolates_x)
      CHECK(first.flow[k].pressure_flow_factor_x == Approx(flow.pressure_flow_factor_x));
  }
  // A light contact lets flow pass on all surfaces, a heavier one less.
  const auto factors = result.flow(&FlowFactors::pressure_flow_factor_x);
  const auto part = result.flow([](const FlowFactors& one) { return one.percolates_x; });
  CHECK(part[0].mean == 1);
  CHECK(part.back().mean <= 1);
  CHECK(factors[0].mean < 1);
  CHECK(factors[5].mean < factors[0].mean);
}

TEST_CASE("A study with adhesion has the curve, the cycle and the pull-off of each surface",
          "[study][adhesion]") {
  StudyConfiguration configuration =
      parse_study_configuration(adhesive_study_text(), "sticky.toml");
  configuration.models = configuration.compared_models;
  REQUIRE(configuration.has(ContactModel::gw_jkr));
  const AdhesionPlan& plan = *configuration.adhesion;
  const StudyResult result = run_study(configuration);
  REQUIRE(result.realisations.size() == 3);
  const Realisation& first = result.realisations.front();
  const Surface surface = study_surface(configuration, first.seed);
  const double modulus = configuration.material.contact_modulus;
  // The smallest load begins without a previous state, as in press_adhesive().
  const ForceCurve& curve = first.of(ContactModel::bem).curve;
  const AdhesiveContactState light =
      press_adhesive(surface, modulus, at_pressure(result.pressures[0]), plan.adhesion);
  CHECK(curve.adhesive);
  CHECK(curve.samples[0].mean_gap == Approx(light.mean_gap).epsilon(1e-9));
  CHECK(curve.samples[0].contact_area_fraction == light.contact_area_fraction);
  CHECK(curve.samples[0].contact_area_fraction >
        2 * press(surface, modulus, at_pressure(result.pressures[0])).contact_area_fraction);
  CHECK(first.spots[0].spot_count > 0);
  std::vector<OperatingPoint> gaps;
  for (const double gap : plan.cycle) gaps.push_back(at_mean_gap(gap));
  const AdhesiveCycle cycle =
      adhesive_cycle(surface, modulus, gaps, plan.adhesion, {.unload = true});
  CHECK(first.adhesion.pull_off_pressure == cycle.pull_off_pressure);
  CHECK(first.adhesion.adhesion_work_per_cycle == cycle.adhesion_work_per_cycle);
  CHECK(first.adhesion.samples[3].unloading_pressure ==
        cycle.unloading[gaps.size() - 4].mean_pressure);
  // Means have intervals; the pull-off is that of the adhesive models only.
  const EnsembleMean pull = result.adhesion_cycle(&AdhesiveCycleNumbers::pull_off_pressure);
  CHECK(pull.low < pull.mean);
  CHECK(pull.mean < pull.high);
  CHECK(result.fitted("pull_off_pressure").mean == pull.mean);
  CHECK(result.fitted("pull_off_pressure", ContactModel::gw_jkr).mean > 0);
  CHECK(std::isnan(result.fitted("pull_off_pressure", ContactModel::gw_moments).mean));
  CHECK(result.adhesion(&AdhesionSample::unloading_pressure).size() == plan.cycle.size());
  // The loss is unknown.
  for (const DampingPoint& point : first.of(ContactModel::bem).damping)
    CHECK(std::isnan(point.damping_constant_closed_form));
  for (const std::string more :
       {"[damping]\nnormal_amplitude = 1e-9\ndrag_velocity = 1e-6\nfrequency = 1\n"})
    CHECK_THROWS_WITH(parse_study_configuration(adhesive_study_text() + more, "x.toml"),
                      Catch::Contains("damping: cannot be combined with adhesion"));
  StudyConfiguration hard = configuration;
  hard.known.hardness = 1e9;
  CHECK_THROWS_WITH(run_study(hard), Catch::Contains("hardness"));
}

TEST_CASE("A study with adhesion on layers has the cycles of its surfaces on this body",
          "[study][adhesion]") {
  StudyConfiguration configuration =
      parse_study_configuration(adhesive_study_text(), "sticky.toml");
  configuration.models = {ContactModel::bem};
  const ElasticBody same{configuration.material.contact_modulus * (1 - 0.3 * 0.3), 0.3};
  const StudyResult half_space = run_study(configuration);
  const Surface surface = study_surface(configuration, half_space.realisations.front().seed);
  const std::vector<double> pressures = half_space.pressures;
  configuration.relative_pressures = false;
  configuration.pressures = pressures;
  const auto on = [&](const Body& body) {
    configuration.press_on(body);
    REQUIRE(configuration.body);
    return run_study(configuration);
  };
  // A layer on a base of the same material is a half-space, solved as a body.
  const StudyResult alike = on(Body::layered({{1e-6, same.young, 0.3}}, same));
  for (const auto& number :
       {&AdhesiveCycleNumbers::pull_off_pressure, &AdhesiveCycleNumbers::adhesion_work_per_cycle})
    CHECK(alike.adhesion_cycle(number).mean ==
          Approx(half_space.adhesion_cycle(number).mean).epsilon(1e-4));
  CHECK(alike.curve(&ForceSample::mean_gap)[0].mean ==
        Approx(half_space.curve(&ForceSample::mean_gap)[0].mean).epsilon(1e-6));
  // A film sticks as the cycle of each surface says.
  const Body film = Body::layered({{0.2 * surface.grid.lx, same.young, 0.3}});
  const StudyResult stuck = on(film);
  std::vector<OperatingPoint> gaps;
  for (const double gap : configuration.adhesion->cycle) gaps.push_back(at_mean_gap(gap));
  const AdhesiveCycle cycle =
      adhesive_cycle(surface, film, gaps, configuration.adhesion->adhesion, {.unload = true});
  CHECK(stuck.realisations.front().adhesion.pull_off_pressure == cycle.pull_off_pressure);
  CHECK(stuck.realisations.front().adhesion.pull_off_pressure !=
        Approx(half_space.realisations.front().adhesion.pull_off_pressure).epsilon(1e-3));
}

TEST_CASE("A study keeps one mean value at all its loads, and says which", "[study]") {
  // The lowest load lifts off under 30 nm, three rms heights; the highest would not.
  std::string text = study_text("seeds = [1, 2]", 5);
  const std::string amplitude = "normal_amplitude = ";
  const std::size_t at = text.find(amplitude) + amplitude.size();
  text.replace(at, text.find('\n', at) - at, "\"30nm\"");
  const StudyConfiguration study = parse_study_configuration(text, "wide.toml");
  CHECK(study.hold() == Hold::automatic);
  const StudyResult result = run_study(study);
  REQUIRE(result.realisations.size() == 2);
  CHECK(result.configuration.hold() == Hold::force);
  int known = 0;
  for (const Realisation& realisation : result.realisations)
    for (const DampingPoint& point : realisation.of(ContactModel::bem).damping) {
      // Beyond full contact there is no loss, but an amplitude that is possible.
      REQUIRE(std::isnan(point.work_per_cycle) == !std::isnan(point.possible_amplitude));
      if (std::isnan(point.work_per_cycle)) continue;
      ++known;
      // The mean force is held at each load, and the motion presses far beyond it.
      CHECK(point.mean_force == Approx(point.force).epsilon(1e-3));
      CHECK(point.max_force > 2 * point.force);
      CHECK(point.contact_time <= 1);
    }
  CHECK(known >= 6);
  const Scratch scratch;
  write_study(scratch / "wide.h5", result, {});
  CHECK(ResultReader(scratch / "wide.h5").text_attribute("damping", "hold") == "force");
}
