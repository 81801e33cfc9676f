// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/composite.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/shapes.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/study/study.hpp>
#include <salebra/surface/detrend.hpp>

#include "base/random.hpp"
#include "io/scratch.hpp"
#include "small_study.hpp"
#include "study/case_run.hpp"
#include "study/estimate.hpp"

using namespace salebra;

namespace {

StudyConfiguration quick_study(std::size_t seeds, const std::string& more = "") {
  StudyConfiguration configuration = small_study(more);
  configuration.stick = false;
  auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  surfaces.seeds.clear();
  for (std::size_t i = 1; i <= seeds; ++i) surfaces.seeds.push_back(i);
  return configuration;
}

}  // namespace

TEST_CASE("Bootstrap intervals of a small Greenwood-Williamson study cover the exact force",
          "[ensemble]") {
  // 60 summits, seven of them in contact: the force of a realisation has a skew distribution, and
  // its mean is known exactly.
  const SummitEnsemble ensemble{.summit_density = 6e11, .radius = 1e-6, .summit_rms = 1e-8};
  const Material material = Material::of_contact_modulus(1e10);
  const double area = 1e-10, separation = 1.2e-8;
  const double exact = StatisticalSummits(ensemble, material, area).force(separation);
  const Bootstrap bootstrap;
  int covered = 0, by_student = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<double> forces;
    for (int m = 0; m < 20; ++m) {
      double force = 0;
      // Heights count from z = 0 of the ensemble, not from their own mean.
      for (const Summit& summit : draw_summits(ensemble, 60, 1e-5, 7, 20 * repeat + m)) {
        const double depth = summit.height - separation;
        if (depth > 0) force += 4. / 3 * 1e10 * std::sqrt(1e-6) * depth * std::sqrt(depth);
      }
      forces.push_back(force);
    }
    const EnsembleMean estimate = bootstrap.mean(forces), student = student_mean(forces);
    covered += estimate.low <= exact && exact <= estimate.high;
    by_student += student.low <= exact && exact <= student.high;
  }
  // 95 % of 200 are 190 ± 3; skewness reduces the number by a few.
  CHECK(covered >= 180);
  CHECK(covered <= 198);
  INFO("bootstrap-t " << covered << ", Student " << by_student);
  CHECK(covered >= by_student - 2);
}

TEST_CASE("The bootstrap of symmetric values is close to Student's t, and deterministic",
          "[ensemble]") {
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) values.push_back(5 + gaussian_pair(3, i, 0).first);
  const EnsembleMean student = student_mean(values), resampled = Bootstrap().mean(values);
  const double half = (student.high - student.low) / 2;
  // 2000 resamples determine a 2.5 % quantile to some 5 % of the width; the sample's own skewness
  // shifts it by 10 %.
  CHECK(resampled.low == Approx(student.low).margin(0.15 * half));
  CHECK(resampled.high == Approx(student.high).margin(0.15 * half));
  CHECK(resampled.mean == student.mean);
  CHECK(Bootstrap().mean(values).low == resampled.low);
  CHECK(Bootstrap(2000, 2).mean(values).low != resampled.low);
  values.push_back(std::nan(""));
  CHECK(Bootstrap().mean(values).low == resampled.low);
  CHECK(Bootstrap().mean({1, 2, 3}).low == student_mean({1, 2, 3}).low);
  CHECK(Bootstrap().mean({4, 4, 4, 4, 4, 4, 4}).high == 4);
  CHECK_THROWS_AS(Bootstrap(10), InvalidInput);
}

TEST_CASE("An interval of positive values is positive", "[ensemble]") {
  // Two values: t = 12.7062 with one degree of freedom.
  const double half = 12.7062 * std::sqrt(0.5) / std::sqrt(2.0);
  const EnsembleMean two = student_mean({1, 2});
  CHECK(two.low == Approx(1.5 * std::exp(-half / 1.5)).epsilon(1e-5));
  CHECK(two.high == Approx(1.5 * std::exp(half / 1.5)).epsilon(1e-5));
  const std::vector<double> skew{0.01, 0.012, 0.02, 0.05, 0.9, 6};
  const EnsembleMean resampled = Bootstrap().mean(skew);
  CHECK(resampled.low > 0);
  CHECK(resampled.low < resampled.mean);
  // A quantity of either sign keeps Student's limits, whatever its values are.
  CHECK(student_mean({1, 2}, Sign::either).low == Approx(1.5 - half).epsilon(1e-5));
  CHECK(Bootstrap().mean(skew, Sign::either).low < resampled.low);
  // Values of both signs keep Student's limits.
  CHECK(student_mean({-1, 2}).low < 0);
}

TEST_CASE("Both limits of a bootstrap interval are 2.5 % quantiles", "[ensemble]") {
  // Values in pairs about the mean have no skewness. The differences come from the 20 000
  // resamples, 1 % of the width, and from the kurtosis of forty values, a few per cent.
  std::vector<double> values;
  for (int i = 0; i < 20; ++i) {
    const double step = gaussian_pair(3, i, 0).first;
    values.push_back(5 + step);
    values.push_back(5 - step);
  }
  const EnsembleMean student = student_mean(values), resampled = Bootstrap(20000).mean(values);
  const double half = (student.high - student.low) / 2;
  // A limit at 5 % would be off by a sixth.
  CHECK(resampled.low == Approx(student.low).margin(0.08 * half));
  CHECK(resampled.high == Approx(student.high).margin(0.08 * half));
}

TEST_CASE("No mean lies at the edge of its interval, however few or alike the values",
          "[ensemble]") {
  // Five of six seeds agree: resamples without the sixth have no scatter, and would put the mean at
  // the edge.
  std::vector<double> values{0.4205, 0.4198, 0.4201, 0.4203, 0.4196, 0.54};
  for (int count : {6, 12, 19, 20, 40}) {
    INFO(count);
    while (values.size() < std::size_t(count))
      values.push_back(0.42 + 1e-4 * gaussian_pair(5, std::int64_t(values.size()), 0).first);
    const EnsembleMean estimate = Bootstrap().mean(values), student = student_mean(values);
    const double half = student.high - student.mean;
    CHECK(estimate.mean - estimate.low >= 0.499 * half);
    CHECK(estimate.high - estimate.mean >= 0.499 * half);
    CHECK(estimate.mean - estimate.low <= 2.001 * half);
    CHECK(estimate.high - estimate.mean <= 2.001 * half);
  }
}

TEST_CASE("A bootstrap interval has the bits of its definition, on any threads", "[ensemble]") {
  // Resample r draws its value k by the first uniform number of (seed 1, r, k); t* = (mean* −
  // mean)/s*; quantiles are interpolated between order statistics.
  constexpr std::size_t n = 37, resamples = 400;
  std::vector<double> values, statistics;
  for (int i = 0; i < int(n); ++i) values.push_back(2 + gaussian_pair(8, i, 0).first);
  const auto moments = [](const std::vector<double>& of) {
    double mean = 0, squares = 0;
    for (const double value : of) mean += value;
    mean /= double(n);
    for (const double value : of) squares += (value - mean) * (value - mean);
    return std::pair{mean, std::sqrt(squares / (double(n) - 1))};
  };
  const auto [mean, deviation] = moments(values);
  for (int r = 0; r < int(resamples); ++r) {
    std::vector<double> drawn;
    for (int k = 0; k < int(n); ++k)
      drawn.push_back(values[std::size_t(uniform_pair(1, r, k, 0xb0075).first * double(n))]);
    const auto [drawn_mean, drawn_deviation] = moments(drawn);
    statistics.push_back((drawn_mean - mean) / drawn_deviation);
  }
  std::ranges::sort(statistics);
  const auto quantile = [&](double probability) {
    const double place = probability * (double(resamples) - 1);
    const auto below = std::size_t(place);
    return statistics[below] +
           (place - double(below)) * (statistics[below + 1] - statistics[below]);
  };
  for (const int threads : {1, 3}) {
    parallel::set_threads(threads);
    const EnsembleMean estimate = Bootstrap(int(resamples)).mean(values);
    CHECK(estimate.mean == mean);
    CHECK(estimate.low == mean - quantile(0.975) * deviation);
    CHECK(estimate.high == mean - quantile(0.025) * deviation);
  }
  parallel::set_threads(0);
}

TEST_CASE("A convergence curve looks at few numbers of many surfaces", "[ensemble]") {
  StudyResult result;
  for (std::size_t i = 0; i < 3000; ++i) {
    Realisation realisation;
    realisation.heights.rms_height = 1;
    realisation.models.resize(1);
    realisation.models.front().fit.decay_length = 1 + 0.1 * gaussian_pair(4, int(i), 0).first;
    result.realisations.push_back(realisation);
  }
  const std::vector<std::size_t> counts = result.convergence_counts();
  for (std::size_t count = 2; count <= 128; ++count) CHECK(counts[count - 2] == count);
  CHECK(counts[127] == 132);
  CHECK(counts.back() == 3000);
  // 32 in each of the four doublings from 128 to 2048, 14 in steps of 64 after that, and 3000.
  CHECK(counts.size() == 127 + 4 * 32 + 14 + 1);
  for (std::size_t i = 127; i + 1 < counts.size(); ++i)
    CHECK(double(counts[i + 1]) <= 1.04 * double(counts[i]));
  const std::vector<EnsembleMean> curve = result.convergence();
  REQUIRE(curve.size() == counts.size());
  std::vector<double> first;
  for (std::size_t i = 0; i < counts[200]; ++i)
    first.push_back(result.realisations[i].of(ContactModel::bem).fit.decay_length);
  CHECK(curve[200].low == Bootstrap().mean(first).low);
  CHECK(curve.back().high == result.decay_length().high);
}

TEST_CASE("Too many combinations of an ensemble are counted before one is made", "[ensemble]") {
  // A study file of 85 kB: 8e9 combinations would take the memory of the machine.
  StudyConfiguration configuration = quick_study(2);
  configuration.ensemble.hurst.assign(2000, 0.8);
  configuration.ensemble.rolloff.assign(2000, 1e-6);
  configuration.ensemble.short_cutoff.assign(2000, 0.5e-6);
  CHECK_THROWS_WITH(parameter_combinations(configuration),
                    Catch::StartsWith("ensemble: its lists make 8000000000 combinations"));
  // A few combinations with many seeds take as much.
  configuration.ensemble = {.hurst = std::vector(1000, 0.8)};
  auto& seeds = std::get<GeneratedSurfaces>(configuration.surfaces).seeds;
  seeds.resize(100000);
  CHECK_THROWS_WITH(parameter_combinations(configuration), Catch::Contains("split the study"));
  seeds.resize(1);
  CHECK(parameter_combinations(configuration).size() == 1000);
}

TEST_CASE("The lists of an ensemble make every combination, cells or size held", "[ensemble]") {
  StudyConfiguration configuration = quick_study(1);
  configuration.ensemble.hurst = {0.3, 0.8};
  configuration.ensemble.size_x = {4e-6, 8e-6};
  const auto points = parameter_combinations(configuration);
  REQUIRE(points.size() == 4);
  const auto& last = std::get<GeneratedSurfaces>(points[3].surfaces);
  CHECK(last.spectrum.hurst == 0.8);
  CHECK(last.grid == Grid2D{128, 128, 8e-6, 8e-6});
  CHECK(points[3].ensemble.empty());
  CHECK(describe_point(configuration.ensemble, points[1]) ==
        "H = 0.3, size 8 µm, 128 x 128 points");
  configuration.ensemble = {.points = {64, 128}};
  CHECK(std::get<GeneratedSurfaces>(parameter_combinations(configuration)[1].surfaces).grid ==
        Grid2D{128, 128, 4e-6, 4e-6});
  // A strip keeps its shape, and its cells stay square.
  StudyConfiguration strip = configuration;
  std::get<GeneratedSurfaces>(strip.surfaces).grid = {64, 32, 4e-6, 2e-6};
  const auto strips = parameter_combinations(strip);
  REQUIRE(strips.size() == 2);
  for (const Index factor : {1, 2})
    CHECK(std::get<GeneratedSurfaces>(strips[std::size_t(factor - 1)].surfaces).grid ==
          Grid2D{64 * factor, 32 * factor, 4e-6, 2e-6});
  CHECK(describe_point(strip.ensemble, strips[1]) == "128 x 64 points");
  configuration.ensemble = {.size_x = {4.01e-6}};
  CHECK_THROWS_WITH(parameter_combinations(configuration), Catch::Contains("a whole number"));
  configuration.ensemble = {.short_cutoff = {0.01e-6}};
  CHECK_THROWS_AS(parameter_combinations(configuration), InvalidInput);
  CHECK_THROWS_AS(run_study(quick_study(1, "[ensemble]\nrolloff = [\"1um\", \"2um\"]\n")),
                  InvalidInput);
}

TEST_CASE("An ensemble table varies what the surface table leaves out", "[ensemble]") {
  std::string text = quick_study(1).text;
  CHECK_THROWS_WITH(parse_study_configuration(text + "[ensemble]\nhurst = [0.3, 0.8]\n", "x.toml"),
                    Catch::Contains("surface.hurst: is varied by [ensemble]"));
  text.replace(text.find("hurst = 0.8\n"), 12, "");
  const auto configuration = parse_study_configuration(
      text + "[ensemble]\nhurst = [0.3, 0.8]\ntarget_precision = \"2%\"\n", "x.toml");
  CHECK(configuration.ensemble.hurst == std::vector{0.3, 0.8});
  CHECK(configuration.target_precision == 0.02);
  CHECK_THROWS_WITH(parse_study_configuration(text + "[ensemble]\nhurts = 1\n", "x.toml"),
                    Catch::Contains("hurts"));
}

TEST_CASE("A study ends at the surface that makes its mean precise enough, on any threads",
          "[ensemble]") {
  StudyConfiguration configuration = quick_study(40);
  configuration.target_precision = 0.2;
  configuration.min_realisations = 3;
  parallel::set_threads(1);
  const StudyResult one = run_study(configuration);
  parallel::set_threads(3);
  const StudyResult three = run_study(configuration);
  parallel::set_threads(0);
  REQUIRE(one.precision_reached);
  CHECK_FALSE(one.interrupted);
  REQUIRE(one.realisations.size() >= 3);
  REQUIRE(one.realisations.size() < 40);
  REQUIRE(three.realisations.size() == one.realisations.size());
  // The minimum number is enough if it is precise enough. If all seeds are used, precision_reached
  // stays false.
  configuration.target_precision = 100;
  const StudyResult least = run_study(configuration);
  CHECK(least.realisations.size() == 3);
  CHECK(least.precision_reached);
  std::get<GeneratedSurfaces>(configuration.surfaces).seeds.resize(3);
  const StudyResult all = run_study(configuration);
  CHECK(all.realisations.size() == 3);
  CHECK_FALSE(all.precision_reached);
  const EnsembleMean mean = one.decay_length_over_rms_height(ContactModel::bem);
  CHECK(mean.relative_precision() <= 0.2);
  CHECK(three.decay_length(ContactModel::bem).low == one.decay_length(ContactModel::bem).low);
  CHECK(three.realisations.back().seed == one.realisations.back().seed);
  // One fewer would not have been enough, unless the minimum number decided.
  if (one.realisations.size() > 3) {
    const EnsembleMean before = one.convergence()[one.realisations.size() - 3];
    std::vector<double> slopes;
    for (std::size_t i = 0; i + 1 < one.realisations.size(); ++i)
      slopes.push_back(one.realisations[i].of(ContactModel::bem).area_slope);
    const double slope = Bootstrap().mean(slopes).relative_precision();
    CHECK((before.relative_precision() > 0.2 || slope > 0.2));
  }
}

TEST_CASE("A study goes on until its decay length and its area slope are both precise enough",
          "[ensemble]") {
  StudyConfiguration configuration = quick_study(12);
  configuration.min_realisations = 3;
  // A single light load gives the area slope, which scatters; many heavy loads give l.
  configuration.pressures = {0.0022, 0.06, 0.075, 0.09, 0.11, 0.13, 0.16, 0.2};
  const double scale = study_loads(configuration).contact_scale;
  configuration.window = PressureWindow{0.05 * scale, 0.3 * scale, 0};
  const StudyResult all = run_study(configuration);
  REQUIRE(all.realisations.size() == 12);
  std::vector<double> lengths, slopes, length_precision, slope_precision;
  for (const Realisation& r : all.realisations) {
    lengths.push_back(r.of(ContactModel::bem).fit.decay_length / r.heights.rms_height);
    slopes.push_back(r.of(ContactModel::bem).area_slope);
    length_precision.push_back(Bootstrap().mean(lengths).relative_precision());
    slope_precision.push_back(Bootstrap().mean(slopes).relative_precision());
  }
  const auto enough = [&](double precision, bool by_slope) {
    std::size_t count = 3;
    while (count < 12 && (length_precision[count - 1] > precision ||
                          (by_slope && slope_precision[count - 1] > precision)))
      ++count;
    return count;
  };
  // At a precision between those of both quantities after some number of surfaces, one of them is
  // precise enough and the other is not.
  for (std::size_t count = 3; count < 12 && configuration.target_precision == 0; ++count) {
    const double between = std::sqrt(length_precision[count - 1] * slope_precision[count - 1]);
    if (enough(between, true) != enough(between, false)) configuration.target_precision = between;
  }
  INFO(length_precision[5] << ' ' << slope_precision[5]);
  REQUIRE(configuration.target_precision > 0);
  CHECK(run_study(configuration).realisations.size() ==
        enough(configuration.target_precision, true));
  // Without the light load there is no area slope to wait for, while the fit has the same loads.
  configuration.pressures.erase(configuration.pressures.begin());
  const StudyResult heavy = run_study(configuration);
  CHECK(std::isnan(heavy.realisations.front().of(ContactModel::bem).area_slope));
  CHECK(heavy.realisations.size() == enough(configuration.target_precision, false));
}

TEST_CASE("A precision ends an ensemble at a milestone only, from the least number on",
          "[ensemble]") {
  StudyConfiguration configuration;
  configuration.target_precision = 0.5;
  Realisation realisation;
  realisation.heights.rms_height = 1;
  ModelResult bem;
  bem.model = ContactModel::bem;
  bem.fit.decay_length = bem.area_slope = 2;
  realisation.models = {bem};
  // Equal surfaces are precise enough at once. Beyond 128 only every fourth number is a milestone.
  for (const auto& [least, end] : {std::pair{2, 2}, {7, 7}, {129, 132}, {132, 132}}) {
    configuration.min_realisations = least;
    detail::PrecisionRule rule(configuration);
    int count = 1;
    while (!rule.met_with(realisation) && count < 200) ++count;
    CHECK(count == end);
  }
}

TEST_CASE("Contacts that did not converge take no part in means and ratios", "[ensemble]") {
  StudyResult result = run_study(quick_study(2));
  Realisation &first = result.realisations[0], &second = result.realisations[1];
  first.of(ContactModel::gw_moments).curve.samples[3].converged = false;
  first.of(ContactModel::bem).curve.samples[5].converged = false;
  const auto gaps = result.curve(&ForceSample::mean_gap, ContactModel::gw_moments);
  CHECK(gaps[3].mean == second.of(ContactModel::gw_moments).curve.samples[3].mean_gap);
  CHECK(std::isnan(gaps[3].low));
  CHECK(gaps[4].mean == Approx((first.of(ContactModel::gw_moments).curve.samples[4].mean_gap +
                                second.of(ContactModel::gw_moments).curve.samples[4].mean_gap) /
                               2));
  const auto ratios = result.over_bem(&ForceSample::mean_gap, ContactModel::gw_moments);
  for (const std::size_t k : {3u, 5u})
    CHECK(ratios[k].mean == second.of(ContactModel::gw_moments).curve.samples[k].mean_gap /
                                second.of(ContactModel::bem).curve.samples[k].mean_gap);
}

TEST_CASE("A study's contacts, fits and area slopes follow the settings", "[ensemble]") {
  StudyConfiguration configuration = quick_study(1);
  configuration.tolerance = 1e-4;
  const StudyResult loose = run_study(configuration);
  configuration.tolerance = 1e-10;
  const StudyResult tight = run_study(configuration);
  configuration.window = PressureWindow{tight.pressures[6], tight.pressures[10], 0};
  const StudyResult windowed = run_study(configuration);
  for (std::size_t k = 0; k < 12; ++k) {
    const double gap = tight.realisations[0].of(ContactModel::bem).curve.samples[k].mean_gap,
                 rough = loose.realisations[0].of(ContactModel::bem).curve.samples[k].mean_gap;
    CHECK(rough != gap);
    // e_c is relative to the rms height, and so is the error of the gap.
    CHECK(rough == Approx(gap).margin(1e-2 * tight.realisations[0].heights.rms_height));
  }
  for (const StudyModel& model : windowed.models()) {
    const ModelResult& found = windowed.realisations[0].of(model.id);
    const ExponentialFit fit = fit_exponential(found.curve, configuration.window);
    CHECK(found.fit.window.points == 5);
    CHECK(found.fit.decay_length == fit.decay_length);
    CHECK(found.test.significance ==
          test_exponential(found.curve, configuration.window).significance);
    CHECK(found.sensitivity.decay_length_max ==
          window_sensitivity(found.curve, configuration.window).decay_length_max);
  }
  // α: least squares through the origin of K h_rms over F, in the window of the fit.
  const ModelResult& fitted = windowed.realisations[0].of(ContactModel::bem);
  double stiffness = 0, force = 0;
  for (std::size_t k = 6; k <= 10; ++k) {
    const ForceSample& sample = fitted.curve.samples[k];
    stiffness += sample.force * sample.normal_stiffness;
    force += sample.force * sample.force;
  }
  CHECK(fitted.stiffness_coefficient ==
        Approx(stiffness / force * windowed.realisations[0].heights.rms_height).epsilon(1e-12));
  // κ: least squares through the origin of A/A0 over p/(E*h'), from 0.002 to 0.05.
  const Realisation& r = tight.realisations[0];
  const double scale = 1e10 * r.moments.rms_slope();
  const auto slope = [&](const auto& area) {
    double product = 0, square = 0;
    for (std::size_t k = 0; k < 12; ++k) {
      const double load = tight.pressures[k] / scale;
      if (load < 0.002 || load > 0.05) continue;
      product += load * area(k);
      square += load * load;
    }
    return product / square;
  };
  CHECK(r.of(ContactModel::bem).area_slope ==
        Approx(slope([&](auto k) {
          return r.of(ContactModel::bem).curve.samples[k].contact_area_fraction;
        })).epsilon(1e-12));
  CHECK(r.corrected_area_slope ==
        Approx(slope([&](auto k) { return r.spots[k].corrected_area_fraction; })).epsilon(1e-12));
}

TEST_CASE("Each surface of a study has its own drawn summits", "[ensemble]") {
  StudyConfiguration configuration = quick_study(2);
  configuration.models = {ContactModel::bem, ContactModel::gw_moments,
                          ContactModel::gw_deterministic, ContactModel::gw_monte_carlo};
  const StudyResult result = run_study(configuration);
  for (const Realisation& r : result.realisations) {
    const double area = r.grid.area();
    const int count = int(std::lround(r.ensemble.summit_density * area));
    const DeterministicSummits drawn(draw_summits(r.ensemble, count, std::sqrt(area), r.seed),
                                     configuration.material, area, -r.ensemble.mean_height,
                                     r.heights.rms_height);
    const ForceCurve expected = curve_at_pressures(drawn, result.pressures);
    CHECK(r.of(ContactModel::gw_monte_carlo).curve.samples[4].mean_gap ==
          expected.samples[4].mean_gap);
    CHECK(r.of(ContactModel::gw_monte_carlo).curve.samples[4].contact_area_fraction ==
          expected.samples[4].contact_area_fraction);
  }
}

TEST_CASE("Two equal rough sides carry what the pairs of their summits carry", "[ensemble]") {
  StudyConfiguration configuration = quick_study(1);
  configuration.models = {ContactModel::bem, ContactModel::greenwood_tripp};
  const StudyResult result = run_study(configuration);
  const Realisation& r = result.realisations.front();
  const ForceSample& sample = r.of(ContactModel::greenwood_tripp).curve.samples[4];
  // A side has half of each moment. η and σ_s²/m0 of Nayak's theory depend only on α, which does
  // not change; R grows by √2.
  const double density = r.ensemble.summit_density,
               radius = std::numbers::sqrt2 * r.ensemble.radius,
               side_rms = r.ensemble.summit_rms / std::numbers::sqrt2;
  // F = (4/3)E*√(R/2) ∫∫ w^{3/2} over the positions and the heights of a pair, by Riemann sums,
  // with w = z − s − r²/(4R).
  const double sum_rms = std::numbers::sqrt2 * side_rms, area = r.grid.area();
  const double top = 8 * sum_rms - sample.separation;
  double force = 0;
  constexpr int steps = 400;
  for (int i = 0; i < steps; ++i) {
    const double depth = (i + 0.5) * top / steps, z = sample.separation + depth;
    const double height_density =
        std::exp(-z * z / (2 * sum_rms * sum_rms)) / (sum_rms * std::sqrt(2 * std::numbers::pi));
    for (int j = 0; j < steps; ++j) {
      // Fraction of the depth that the distance of the axes takes; r dr = 2R dw.
      const double part = (j + 0.5) / steps;
      force += height_density * std::pow(depth * (1 - part), 1.5) * 4 * std::numbers::pi * radius *
               depth / steps * top / steps;
    }
  }
  force *= 4. / 3 * 1e10 * std::sqrt(radius / 2) * density * density * area;
  // Midpoint sums of 400 steps over functions that are smooth except for a power 3/2 at one end:
  // 1e-6.
  CHECK(sample.force == Approx(force).epsilon(1e-5));
  CHECK(sample.force == Approx(result.pressures[4] * area).epsilon(1e-6));
}

TEST_CASE("A measured surface has the seam of its edges, and summits within them", "[ensemble]") {
  const Scratch scratch;
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 1e-6, .short_cutoff = 0.5e-6, .rms_height = 1e-8});
  const Surface whole = filtered_noise({128, 128, 8e-6, 8e-6}, spectrum, 2);
  const Surface part = crop_surface(whole, 0, 0, 64, 48);
  write_surface(scratch / "scan.npy", part, {});
  StudyConfiguration configuration = quick_study(1);
  configuration.surfaces = MeasuredSurface{.file = scratch / "scan.npy"};
  const Realisation r = run_study(configuration).realisations.front();
  CHECK_FALSE(r.periodic);
  const Surface level = detrended(part, Detrend::plane);
  double along_x = 0, along_y = 0;
  for (Index iy = 0; iy < 48; ++iy)
    along_x += std::pow(level.heights(0, iy) - level.heights(63, iy), 2) / 48;
  for (Index ix = 0; ix < 64; ++ix)
    along_y += std::pow(level.heights(ix, 0) - level.heights(ix, 47), 2) / 64;
  const double rms_height = height_statistics(level).rms_height;
  CHECK(r.seam_step == Approx(std::sqrt((along_x + along_y) / 2) / rms_height).epsilon(1e-9));
  // A point of the border lacks some of the eight neighbours, so summits are searched and counted
  // on 62 × 46 cells.
  const SummitList summits = find_summits(level);
  CHECK(r.of(ContactModel::gw_deterministic).curve.nominal_area ==
        Approx(62 * 46 * part.grid.cell_area()).epsilon(1e-12));
  CHECK(r.summits.summit_density ==
        Approx(double(summits.summits.size()) / summits.searched_area).epsilon(1e-12));
}

TEST_CASE("A smooth shape has no summits from moments, and everything else", "[ensemble]") {
  const Scratch scratch;
  // A paraboloid in a square has m0 m4/m2² below 1, unlike any random surface.
  write_surface(scratch / "ball.npy", paraboloid_surface({32, 32, 4e-6, 4e-6}, 100e-6), {});
  StudyConfiguration configuration = quick_study(1);
  configuration.surfaces = MeasuredSurface{.file = scratch / "ball.npy"};
  using enum ContactModel;
  configuration.models = {bem, gw_moments, gw_monte_carlo, gw_interacting};
  const StudyResult result = run_study(configuration);
  const Realisation& r = result.realisations.front();
  REQUIRE(r.moments.nayak() < 1);
  CHECK(r.of(bem).curve.samples.back().converged);
  CHECK(r.of(gw_interacting).curve.samples.back().converged);
  for (const ContactModel model : {gw_moments, gw_monte_carlo}) {
    CHECK(r.of(model).curve.samples.size() == result.pressures.size());
    CHECK(std::ranges::none_of(r.of(model).curve.samples, &ForceSample::converged));
    CHECK(std::isnan(r.of(model).fit.decay_length));
  }
  CHECK(std::ranges::count_if(result.warnings, [](const std::string& text) {
          return text.find("Nayak") != std::string::npos;
        }) == 1);
}

TEST_CASE("An ensemble says what is too small about it", "[ensemble]") {
  const auto names = [](const StudyResult& result) {
    std::vector<std::string> found;
    for (const EnsembleWarning& warning : result.ensemble_warnings) found.push_back(warning.name);
    return found;
  };
  StudyConfiguration configuration = quick_study(1);
  // Roll-off at a quarter of the size, cut-off at exactly eight cells, a handful of contact
  // patches.
  CHECK(names(run_study(configuration)) == std::vector<std::string>{"finite_size", "few_spots"});
  auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  surfaces.spectrum.rolloff = 0.25e-6;
  surfaces.spectrum.short_cutoff = 0.2e-6;
  const auto fine = names(run_study(configuration));
  CHECK(fine.front() == "discretisation");
  CHECK(std::ranges::find(fine, "finite_size") == fine.end());
  // The shorter side of a strip counts: eight roll-offs, however long the other side is.
  surfaces.grid = {128, 32, 8e-6, 2e-6};
  const auto strip = names(run_study(configuration));
  CHECK(strip.front() == "finite_size");
  // Patches count in the range of the fit: fifty there are enough, although the lightest loads have
  // fewer.
  surfaces.grid = {64, 64, 4e-6, 4e-6};
  configuration.relative_pressures = true;
  const double scale = study_loads(configuration).contact_scale;
  configuration.window = PressureWindow{0.009 * scale, 0.05 * scale, 0};
  const StudyResult many = run_study(configuration);
  const auto spots = [&](std::size_t k) { return many.realisations[0].spots[k].spot_count; };
  INFO(spots(0) << ' ' << spots(4) << ' ' << spots(5) << ' ' << spots(6) << ' ' << spots(7) << ' '
                << spots(8));
  REQUIRE(spots(0) < 50);
  CHECK(names(many) == std::vector<std::string>{"discretisation"});
}

TEST_CASE("Every model of a comparison has its curve, fit and damping", "[ensemble]") {
  StudyConfiguration configuration = quick_study(2);
  configuration.models = configuration.compared_models;
  const StudyResult result = run_study(configuration);
  REQUIRE(result.models().size() == all_contact_models().size());
  for (const StudyModel& model : result.models()) {
    INFO(model.name);
    for (const Realisation& realisation : result.realisations) {
      const ModelResult& found = realisation.of(model.id);
      REQUIRE(found.curve.samples.size() == 12);
      REQUIRE(found.damping.size() == 12);
      // For every model l/h_rms of a Gaussian surface is below one.
      CHECK(found.fit.decay_length / realisation.heights.rms_height > 0.1);
      CHECK(found.fit.decay_length / realisation.heights.rms_height < 1);
      CHECK(found.curve.samples[4].force == Approx(result.pressures[4] * 16e-12).epsilon(1e-6));
    }
  }
  // The ratio of a model to itself is one.
  const auto unity = result.over_bem(&ForceSample::mean_gap, ContactModel::bem);
  CHECK(unity[3].mean == 1);
  CHECK(result.damping_over_bem(&DampingPoint::work_per_cycle, ContactModel::bem)[5].mean == 1);
  // For another model it is the mean of the ratios on each surface.
  double stiffness = 0, work = 0;
  for (const Realisation& r : result.realisations) {
    stiffness += r.of(ContactModel::persson).curve.samples[3].normal_stiffness /
                 r.of(ContactModel::bem).curve.samples[3].normal_stiffness / 2;
    work += r.of(ContactModel::gw_deterministic).damping[5].work_per_cycle_closed_form /
            r.of(ContactModel::bem).damping[5].work_per_cycle / 2;
  }
  CHECK(result.over_bem(&ForceSample::normal_stiffness, ContactModel::persson)[3].mean ==
        Approx(stiffness).epsilon(1e-14));
  CHECK(result
            .damping_over_bem(&DampingPoint::work_per_cycle_closed_form,
                              ContactModel::gw_deterministic)[5]
            .mean == Approx(work).epsilon(1e-14));
  // The numbers by size add up to all patches, and their areas to the contact area.
  const Realisation& first = result.realisations.front();
  double spots = 0;
  for (const double count : first.spots[6].spots_by_size) spots += count;
  CHECK(spots == first.spots[6].spot_count);
  CHECK(first.spots[6].mean_spot_area * spots ==
        Approx(first.of(ContactModel::bem).curve.samples[6].contact_area_fraction * 16e-12)
            .epsilon(1e-12));
  CHECK(first.spots[6].corrected_area_fraction <
        first.of(ContactModel::bem).curve.samples[6].contact_area_fraction);
  // The same contact, solved again: patches of n cells count where 2^k <= n < 2^(k+1), and the
  // largest areas agree.
  const Surface surface = study_surface(result.configuration, first.seed);
  const NormalContactState state =
      press(surface, 1e10, at_pressure(result.pressures[6]), {.tolerance = 1e-8});
  std::vector<double> sizes(13, 0.0);
  double largest = 0;
  for (const ContactSpot& spot : contact_spots(state.contact_pressure, surface.grid).spots) {
    sizes[std::size_t(std::floor(std::log2(std::round(spot.area / surface.grid.cell_area()))))] +=
        1;
    largest = std::max(largest, spot.area);
  }
  CHECK(first.spots[6].spots_by_size == sizes);
  CHECK(first.spots[6].max_spot_area == Approx(largest).epsilon(1e-12));
  // Persson's theory has the slope of the surface's own modes; the mean radius of a ring differs
  // from its rms radius by at most 2^(1/16) − 1.
  CHECK(first.of(ContactModel::persson).curve.samples[6].contact_area_fraction ==
        Approx(persson_area_fraction(result.pressures[6], 1e10, first.moments.rms_slope()))
            .epsilon(0.02));
}

TEST_CASE("A comparison computes the models it was asked for, and no others", "[ensemble]") {
  StudyConfiguration configuration =
      quick_study(1, "[compare]\nmodels = [\"persson\", \"gw_moments\", \"persson\"]\n");
  CHECK(configuration.models.size() == 3);  // those of `study`, which [compare] does not change
  configuration.models = configuration.compared_models;
  CHECK(configuration.models ==
        std::vector{ContactModel::bem, ContactModel::gw_moments, ContactModel::persson});
  const StudyResult result = run_study(configuration);
  REQUIRE(result.models().size() == 3);
  CHECK(result.realisations.front().models.size() == 3);
  CHECK_THROWS_WITH(result.realisations.front().of(ContactModel::gw_interacting),
                    Catch::Contains("'gw_interacting' was not computed"));
  CHECK(result.realisations.front().of(ContactModel::persson).curve.samples.size() == 12);
  CHECK_THROWS_WITH(quick_study(1, "[compare]\nmodels = [\"gw\"]\n"),
                    Catch::Contains("compare.models: 'gw' is not known"));
  CHECK_THROWS_WITH(quick_study(1, "[compare]\nmodel = \"bem\"\n"), Catch::Contains("model"));
}

TEST_CASE("Exponential heights make Eq. (16) exact, with l = sigma", "[ensemble]") {
  const SummitEnsemble ensemble{.summit_density = 1e12,
                                .radius = 1e-6,
                                .summit_rms = 2e-8,
                                .distribution = SummitDistribution::exponential};
  const Material material = Material::of_contact_modulus(115e9, 0.3);
  const GreenwoodWilliamsonLaw law(ensemble, material, 1e-10);
  const Drag drag{.normal_amplitude = 1e-10, .drag_velocity = 1e-3, .angular_frequency = 1e5};
  const double force = 1e-3;
  const auto exact =
      relaxation_damping(law, at_force(force), drag, {.amplitude = Amplitude::small});
  const double by_paper =
      closed_form::work_per_cycle_rough(material.modulus_ratio(), force, 2e-8, drag);
  // Both are closed forms, so they differ by round-off only.
  CHECK(exact.work_per_cycle == Approx(by_paper).epsilon(1e-10));
  const ForceCurve curve =
      curve_at_pressures(StatisticalSummits(ensemble, material, 1e-10), {1e5, 1e6, 1e7, 1e8});
  CHECK(fit_exponential(curve).decay_length == Approx(2e-8).epsilon(1e-10));
}

TEST_CASE("Statistical, drawn and own summits agree on a Gaussian surface within their intervals",
          "[ensemble]") {
  // A narrow ring of wavelengths on a grid fine enough to find all summits, the case of Nayak's
  // theory.
  const Grid2D grid{256, 256, 16e-6, 16e-6};
  const SelfAffineSpectrum spectrum({.hurst = 0.8,
                                     .long_cutoff = 1e-6,
                                     .rolloff = 1e-6,
                                     .short_cutoff = 0.75e-6,
                                     .rms_height = 1e-8});
  const Material material = Material::of_contact_modulus(1e10, 0.3);
  const double distance = GENERATE(1.5, 2.2);  // ū over h_rms
  const int surfaces = 20, draws = 400;
  int own_inside = 0, statistical_inside = 0;
  double ratio = 0;
  for (int seed = 1; seed <= surfaces; ++seed) {
    const Surface surface = filtered_noise(grid, spectrum, std::uint64_t(seed));
    const SpectralMoments moments = surface_moments(surface);
    const SummitEnsemble ensemble =
        summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
    const double mean_gap = distance * std::sqrt(moments.moment0);
    const auto force_at_gap = [&](const AsperityModel& model) {
      return model.force(mean_gap - model.common().mean_height);
    };
    const double statistical = force_at_gap(StatisticalSummits(ensemble, material, grid.area()));
    const double own = force_at_gap(DeterministicSummits(find_summits(surface).summits, material,
                                                         grid.area(), surface.heights.mean()));
    // Draws as many summits of that density at random, which shows by how much one surface of this
    // size may differ from the mean, and where the mean is.
    const int count = int(std::lround(ensemble.summit_density * grid.area()));
    std::vector<double> drawn;
    for (int draw = 0; draw < draws; ++draw)
      drawn.push_back(force_at_gap(
          DeterministicSummits(draw_summits(ensemble, count, grid.lx, std::uint64_t(seed), draw),
                               material, grid.area(), -ensemble.mean_height)));
    const EnsembleMean mean = student_mean(drawn);
    // N is an integer, ηA0 is not.
    const double rounding = statistical * 0.5 / count;
    statistical_inside += mean.low - rounding < statistical && statistical < mean.high + rounding;
    std::ranges::sort(drawn);
    own_inside += drawn[draws / 40] < own && own < drawn[draws - 1 - draws / 40];
    ratio += own / statistical / surfaces;
  }
  INFO("at " << distance << " h_rms: " << own_inside << " and " << statistical_inside
             << " of 20, ratio " << ratio);
  // 95 % of 20 are 19 ± 1; by chance alone fewer than 16 would occur once in 400 times. The
  // surface's own summits are not equal spheres: the higher ones are sharper.
  CHECK(statistical_inside >= 16);
  CHECK(own_inside >= 16);
}
