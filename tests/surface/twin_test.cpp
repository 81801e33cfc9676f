// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/twin.hpp>

#include "rough_patches.hpp"
#include "surface/twin_fit.hpp"

using namespace salebra;
using Catch::Contains;
using std::numbers::pi;

namespace {

TwinDraw law(SpectrumForm form, double hurst, double rolloff, double short_cutoff) {
  TwinDraw draw;
  draw.form = form;
  draw.hurst = hurst;
  draw.rolloff = rolloff;
  draw.short_cutoff = short_cutoff;
  draw.reference = 2e6;
  draw.amplitude = std::log(3e-30);
  return draw;
}

struct Moments {
  double rms_height = 0, rms_slope = 0;
};

/// Moments by Simpson's rule in ln q, from 10⁻⁴ of the roll-off to the end.
Moments integrated(const TwinDraw& draw) {
  constexpr int steps = 20000;
  const double end = 2 * pi / draw.short_cutoff, start = 2 * pi / draw.rolloff * 1e-4;
  const double step = std::log(end / start) / steps;
  double height = 0, slope = 0;
  for (int k = 0; k <= steps; ++k) {
    const double q = end * std::exp(step * (k - steps)) * (1 - 1e-14);
    const double part = (k == 0 || k == steps ? 1
                         : k % 2              ? 4
                                              : 2) *
                        step / 3 * 2 * pi * q * q * draw.density(q);
    height += part;
    slope += part * q * q;
  }
  return {std::sqrt(height), std::sqrt(slope)};
}

ScanInstrument instrument(Instrument kind, double noise, double size, std::string name = {}) {
  ScanInstrument made;
  made.kind = kind;
  made.noise = noise;
  (kind == Instrument::optical ? made.resolution : made.tip_radius) = size;
  made.name = std::move(name);
  return made;
}

ScanSpectrum scan_of(RoughPatches& patches, const TwinDraw& truth, Index n, double side,
                     const ScanInstrument& with, double gain = 1) {
  Field heights;
  if (with.kind == Instrument::optical) {
    const double sigma = with.resolution / std::sqrt(8 * std::numbers::ln2);
    heights = patches.patch(
        n, side, [&](double q) { return truth.density(q) * std::exp(-(q * sigma) * (q * sigma)); });
  } else {
    heights = patches.patch(n, side, [&](double q) { return truth.density(q); });
    if (with.has_tip())
      heights = dilated(std::move(heights), side / static_cast<double>(n), with.tip_radius);
  }
  const double noise = std::isnan(with.noise) ? 1e-10 : with.noise;
  for (double& height : heights.reshaped()) height = gain * (height + noise * patches.normal());
  return scan_spectrum(heights, {n, n, side, side}, with);
}

/// Two optical maps of 200 µm and three scans of 20 µm.
std::vector<ScanSpectrum> two_instruments(RoughPatches& patches, const TwinDraw& truth) {
  std::vector<ScanSpectrum> scans;
  for (int scan = 0; scan < 2; ++scan)
    scans.push_back(scan_of(patches, truth, 160, 200e-6,
                            instrument(Instrument::optical, 1e-9, 3e-6, "interferometer")));
  for (int scan = 0; scan < 3; ++scan)
    scans.push_back(scan_of(patches, truth, 160, 20e-6,
                            instrument(Instrument::afm, 1e-10, 2e-8, "microscope")));
  return scans;
}

/// A quick fit with fewer draws and without checks. It uses one thread; another test shows that
/// more threads change no bits.
SurfaceTwin quick_twin(const std::vector<ScanSpectrum>& scans, TwinOptions options = {}) {
  const int before = parallel::threads();
  parallel::set_threads(1);
  options.draws = 300;
  SurfaceTwin twin = fit_twin(scans, options);
  parallel::set_threads(before);
  return twin;
}

bool holds(const IntervalEstimate& interval, double truth) {
  return interval.low <= truth && truth <= interval.high;
}

}  // namespace

TEST_CASE("Moments of a draw are those of its density", "[twin]") {
  for (const SpectrumForm form : {SpectrumForm::corner, SpectrumForm::smooth})
    for (const double hurst : {0.02, 0.5, 1.0, 1.2}) {
      const TwinDraw truth = law(form, hurst, 4e-5, 5e-7);
      const twin_detail::TwinLaw own{form, truth.reference, {}};
      const std::vector<double> parameters{truth.amplitude, hurst, std::log(4e-5), std::log(5e-7)};
      const TwinDraw draw = twin_detail::draw_of(own, parameters, 1e5);
      const Moments moments = integrated(truth);
      INFO(name_of(form) << ", H = " << hurst);
      // The corner between two points causes an error of 1e-6 in Simpson's rule.
      CHECK(draw.rms_height == Approx(moments.rms_height).epsilon(1e-5));
      CHECK(draw.rms_slope == Approx(moments.rms_slope).epsilon(1e-5));
      CHECK(draw.density(1e6) == Approx(truth.density(1e6)).epsilon(1e-12));
      CHECK(draw.density(2e7) == 0);
    }
  // A spline through a power law equals that law between and beyond its knots.
  twin_detail::TwinLaw table{SpectrumForm::table, 1e6, {}};
  std::vector<double> parameters;
  const TwinDraw power = law(SpectrumForm::corner, 0.7, 1, 5e-7);
  for (int k = 0; k < 7; ++k) {
    table.knots.push_back(-2 + 0.6 * k);
    parameters.push_back(std::log(power.density(1e6 * std::exp(table.knots.back()))));
  }
  parameters.push_back(std::log(5e-7));
  const TwinDraw draw = twin_detail::draw_of(table, parameters, 1e5);
  for (const double q : {1e5, 4e5, 3e6, 1.2e7})
    CHECK(draw.density(q) == Approx(power.density(q)).epsilon(1e-9));
  // ∫2πq³C dq in closed form.
  const double end = 2 * pi / 5e-7, exponent = 2 - 2 * 0.7;
  const double slope = std::sqrt(2 * pi * power.density(1e6) * std::pow(1e6, 3.4) / exponent *
                                 (std::pow(end, exponent) - std::pow(1e5, exponent)));
  CHECK(draw.rms_slope == Approx(slope).epsilon(1e-6));
}

TEST_CASE("A tabulated draw is straight between points that its density has", "[twin]") {
  for (const SpectrumForm form : {SpectrumForm::corner, SpectrumForm::smooth}) {
    const TwinDraw draw = law(form, 0.8, 3e-5, 6e-7);
    const SpectrumTable table = tabulated(draw, 1e4);
    CHECK(std::is_sorted(table.wavenumber.begin(), table.wavenumber.end()));
    CHECK(table.wavenumber.back() == Approx(2 * pi / 6e-7).epsilon(1e-12));
    CHECK(table.psd.back() > 0);
    for (std::size_t k = 0; k + 1 < table.psd.size(); ++k) {
      const double middle = std::sqrt(table.wavenumber[k] * table.wavenumber[k + 1]);
      // Second differences of a smooth roll-off: (ln 10/60)²/8 of a curvature of ½(1 + H).
      CHECK(std::sqrt(table.psd[k] * table.psd[k + 1]) ==
            Approx(draw.density(middle)).epsilon(4e-4));
    }
  }
  CHECK_THROWS_AS(tabulated(law(SpectrumForm::corner, 0.8, 3e-5, 6e-7), 1e8), InvalidInput);
}

TEST_CASE("Slopes of the residuals are their differences", "[twin]") {
  RoughPatches patches(21);
  const TwinDraw truth = law(SpectrumForm::corner, 0.7, 3e-5, 6e-7);
  const std::vector<ScanSpectrum> scans = two_instruments(patches, truth);
  twin_detail::Responses responses;
  const std::vector<twin_detail::TwinData> gaussian =
      twin_detail::grouped(scans, std::vector<bool>(scans.size(), false), {}, responses);
  std::vector<twin_detail::TwinData> skew = gaussian;
  twin_detail::allow_skew_heights(scans, skew);
  for (const auto& [form, heights] : {std::pair{SpectrumForm::corner, "gaussian"},
                                      {SpectrumForm::smooth, "gaussian"},
                                      {SpectrumForm::table, "gaussian"},
                                      {SpectrumForm::corner, "skew"}}) {
    const auto& data = heights == std::string_view("skew") ? skew : gaussian;
    twin_detail::TwinLaw own{form, 1e6, {}};
    Eigen::VectorXd at;
    if (form == SpectrumForm::table) own.knots = {-3, -2, -1, 0, 1, 2, 3};
    const twin_detail::TwinModel model(data, own);
    at = Eigen::VectorXd::Zero(model.size());
    if (form == SpectrumForm::table) {
      const TwinDraw endless = law(SpectrumForm::corner, 0.7, 3e-5, 1e-8);
      for (Index k = 0; k < 7; ++k)
        at[k] = std::log(endless.density(1e6 * std::exp(own.knots[static_cast<std::size_t>(k)]))) +
                0.1 * std::sin(static_cast<double>(k));
    } else {
      at.head(3) << std::log(truth.density(1e6)) + 0.2, 0.63, std::log(2.53e-5);
    }
    // Of skew heights the lens, too, has bins beyond the cut-off.
    at[own.cutoff()] = std::log(&data == &skew ? 5.83e-6 : 5.83e-7);
    for (Index p = own.size(); p < model.size(); ++p)
      at[p] = 0.1 * std::cos(static_cast<double>(p));
    twin_detail::TwinModel::Work work;
    Eigen::VectorXd values, up, down;
    Eigen::MatrixXd slopes;
    model.residuals(at, work, values, &slopes);
    CHECK(model.log_posterior(at, work) == Approx(-values.squaredNorm() / 2).epsilon(1e-10));
    for (Index p = 0; p < model.size(); ++p) {
      constexpr double step = 1e-6;
      Eigen::VectorXd moved = at;
      moved[p] += step;
      model.residuals(moved, work, up, nullptr);
      moved[p] -= 2 * step;
      model.residuals(moved, work, down, nullptr);
      const Eigen::VectorXd difference = (up - down) / (2 * step);
      INFO(name_of(form) << ", " << heights << ", parameter " << p);
      // Central differences have errors of 1e-16/1e-6 of residuals up to 1000, and of the third
      // derivative.
      CHECK((slopes.col(p) - difference).norm() <= 2e-5 * (difference.norm() + 1));
    }
  }
}

TEST_CASE("The twin of two instruments holds the truth", "[twin]") {
  // With three surfaces and five quantities, one of 20 intervals misses by chance; with these seeds
  // at most one may miss. The widths come from the posterior and hardly depend on the seeds.
  int missed = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    RoughPatches patches(seed);
    const double hurst = 0.4 + 0.2 * seed;
    const TwinDraw truth =
        law(seed == 2 ? SpectrumForm::smooth : SpectrumForm::corner, hurst, 2.5e-5, 6e-7);
    const SurfaceTwin twin = quick_twin(two_instruments(patches, truth));
    const Moments moments = integrated(truth);
    INFO("seed " << seed << ": H " << twin.hurst.low << " " << twin.hurst.high << ", roll-off "
                 << twin.rolloff.low << " " << twin.rolloff.high << ", cut-off "
                 << twin.short_cutoff.low << " " << twin.short_cutoff.high << ", h "
                 << twin.rms_height.low / moments.rms_height << " "
                 << twin.rms_height.high / moments.rms_height << ", h' "
                 << twin.rms_slope.low / moments.rms_slope << " "
                 << twin.rms_slope.high / moments.rms_slope << ", misfit " << twin.misfit);
    CHECK(twin.form == truth.form);
    CHECK(twin.misfit < 2.2);
    REQUIRE(twin.rolloff.seen);
    REQUIRE(twin.short_cutoff.seen);
    missed += !holds(twin.hurst, hurst) + !holds(twin.rolloff, truth.rolloff) +
              !holds(twin.short_cutoff, truth.short_cutoff) +
              !holds(twin.rms_height, moments.rms_height) +
              !holds(twin.rms_slope, moments.rms_slope);
    CHECK(missed <= 1);
    CHECK(twin.hurst.high - twin.hurst.low < 0.2);
    CHECK(twin.rms_slope.high / twin.rms_slope.low < 1.3);
    // The interval includes the calibration of 5 % of two instruments.
    CHECK(twin.rms_slope.high / twin.rms_slope.low > 1.08);
    CHECK(twin.draws.size() == 300);
    CHECK(twin.draw(7).hurst == twin.draw(7).hurst);
    // The band contains the truth nearly everywhere, up to the interval of the cut-off.
    int inside = 0, asked = 0;
    for (std::size_t k = 0; k < twin.spectrum.wavenumber.size(); ++k) {
      const double q = twin.spectrum.wavenumber[k];
      if (q > 2 * pi / twin.short_cutoff.high) continue;
      ++asked;
      inside +=
          twin.spectrum.low[k] <= truth.density(q) && truth.density(q) <= twin.spectrum.high[k];
    }
    CHECK(inside >= 0.8 * asked);
    CHECK(twin.without.size() == 2);
  }
}

TEST_CASE("What no scan sees is said and gets a limit", "[twin]") {
  RoughPatches patches(11);
  // Waves extend to 40 times the scans and to a tenth of their cells.
  const TwinDraw truth = law(SpectrumForm::corner, 0.7, 4e-3, 2e-8);
  std::vector<ScanSpectrum> scans;
  for (int scan = 0; scan < 3; ++scan)
    scans.push_back(
        scan_of(patches, truth, 160, 100e-6, instrument(Instrument::optical, 1e-9, 2e-6)));
  const SurfaceTwin twin = quick_twin(scans);
  CHECK(!twin.rolloff.seen);
  CHECK(!twin.rolloff.found());
  CHECK(twin.rolloff.low < truth.rolloff);
  CHECK(twin.rolloff.low > 20e-6);
  CHECK(std::isnan(twin.rolloff.high));
  CHECK(!twin.short_cutoff.seen);
  CHECK(twin.short_cutoff.high > truth.short_cutoff);
  CHECK(twin.short_cutoff.high < 5e-6);
  CHECK(std::isnan(twin.short_cutoff.low));
  const Moments moments = integrated(truth);
  CHECK(twin.rms_height.low < moments.rms_height);
  CHECK(!twin.rms_height.found());
  CHECK(!twin.rms_slope.seen);
  CHECK(holds(twin.hurst, 0.7));
  std::string warnings;
  for (const std::string& warning : twin.warnings) warnings += warning + "\n";
  CHECK_THAT(warnings, Contains("do not show the roll-off"));
  CHECK_THAT(warnings, Contains("do not resolve the short cut-off"));
  // Draws extend to the limit of the prior, 30 times the largest scan, not only to the size of the
  // scan.
  double longest = 0;
  for (const TwinDraw& draw : twin.draws) longest = std::max(longest, draw.rolloff);
  CHECK(longest > 1e-3);
}

TEST_CASE("A tip is believed up to R κ_rms of 0.08", "[twin]") {
  RoughPatches patches(31);
  TwinDraw truth = law(SpectrumForm::corner, 0.7, 3e-5, 3e-7);
  truth.amplitude = std::log(2e-29);
  std::vector<ScanSpectrum> scans{
      scan_of(patches, truth, 160, 20e-6, instrument(Instrument::afm, 1e-10, 1e-6))};
  twin_detail::Responses responses;
  const auto data = twin_detail::grouped(scans, {false}, {}, responses);
  REQUIRE(data.size() == 1);
  REQUIRE(data[0].tip_limit > 0);
  CHECK(data[0].wavenumber.back() < data[0].tip_limit);
  // κ_rms² = ⅜∫q⁴C d²q of the truth up to the limit, within the bin ratio of 1.15 in q and the
  // scatter of few modes.
  double square = 0;
  for (double q = 2 * pi / 20e-6; q < data[0].tip_limit; q *= 1.001)
    square += 3.0 / 8 * 2 * pi * 0.001 * std::pow(q, 6) * truth.density(q);
  CHECK(1e-6 * std::sqrt(square) == Approx(0.08).epsilon(0.3));
  // A ten times sharper tip reaches shorter waves.
  scans.front().instrument.tip_radius = 1e-7;
  const auto finer = twin_detail::grouped(scans, {false}, {}, responses);
  CHECK(finer[0].wavenumber.back() > 2 * data[0].wavenumber.back());
  const SurfaceTwin twin = quick_twin(scans);
  CHECK(twin.groups.size() == 1);
}

TEST_CASE("Heights are as uncertain as their calibration", "[twin]") {
  RoughPatches patches(41);
  const TwinDraw truth = law(SpectrumForm::corner, 0.7, 2.5e-5, 6e-7);
  std::vector<ScanSpectrum> scans = two_instruments(patches, truth);
  const auto width = [](const SurfaceTwin& twin) {
    return std::log(twin.rms_slope.high / twin.rms_slope.low);
  };
  std::vector<double> widths;
  for (const double calibration : {0.01, 0.1}) {
    for (ScanSpectrum& scan : scans) scan.instrument.height_calibration = calibration;
    widths.push_back(width(quick_twin(scans, {.leave_one_out = false})));
  }
  // The width is 3.92 times 10 %/√2 if both instruments determine the slope equally, and 3.92 times
  // 10 % if one of them does alone. With a calibration of 1 %, only modes and scans contribute.
  CHECK(widths[1] > 3.92 * 0.1 / std::sqrt(2) * 0.75);
  CHECK(widths[1] < 3.92 * 0.1 * 1.1);
  CHECK(widths[0] < widths[1] / 2);
}

TEST_CASE("A bad scan is left out, and a bad instrument is named", "[twin]") {
  RoughPatches patches(51);
  const TwinDraw truth = law(SpectrumForm::corner, 0.7, 2.5e-5, 6e-7);
  std::vector<ScanSpectrum> scans = two_instruments(patches, truth);
  const SurfaceTwin good = quick_twin(scans);
  for (const TwinScan& scan : good.scans) CHECK(!scan.left_out);
  for (const TwinWithout& without : good.without) CHECK(without.agrees);

  // Spikes in one scan add white power.
  std::vector<ScanSpectrum> spoiled = scans;
  spoiled[3].name = "C3";
  for (double& power : spoiled[3].psd) power += 1e-32;
  const SurfaceTwin twin = quick_twin(spoiled);
  CHECK(twin.scans[3].left_out);
  CHECK(twin.scans[3].misfit > 3 * twin.scans[2].misfit);
  CHECK(std::count_if(twin.scans.begin(), twin.scans.end(),
                      [](const TwinScan& scan) { return scan.left_out; }) == 1);
  CHECK_THAT(twin.warnings.front(), Contains("scan C3 is left out"));
  CHECK(twin.hurst.value == Approx(good.hurst.value).margin(0.03));
  CHECK(!quick_twin(spoiled, {.drop_bad_scans = false, .leave_one_out = false}).scans[3].left_out);

  // Doubled heights of the microscope exceed any calibration of 5 %. Where both instruments
  // overlap, one of them must be wrong.
  for (std::size_t scan = 2; scan < 5; ++scan)
    for (double& power : scans[scan].psd) power *= 4;
  const SurfaceTwin wrong = quick_twin(scans);
  CHECK(std::any_of(wrong.without.begin(), wrong.without.end(),
                    [](const TwinWithout& without) { return !without.agrees; }));
}

TEST_CASE("The twin has the same bits for every number of threads and the same seed", "[twin]") {
  RoughPatches patches(61);
  const TwinDraw truth = law(SpectrumForm::corner, 0.6, 2.5e-5, 6e-7);
  const std::vector<ScanSpectrum> scans = two_instruments(patches, truth);
  const int before = parallel::threads();
  std::vector<SurfaceTwin> twins;
  for (const int threads : {1, 3}) {
    parallel::set_threads(threads);
    twins.push_back(fit_twin(scans, {.draws = 100, .leave_one_out = false}));
  }
  parallel::set_threads(before);
  REQUIRE(twins[0].draws.size() == twins[1].draws.size());
  for (std::size_t k = 0; k < twins[0].draws.size(); ++k) {
    CHECK(twins[0].draws[k].hurst == twins[1].draws[k].hurst);
    CHECK(twins[0].draws[k].rms_slope == twins[1].draws[k].rms_slope);
  }
  CHECK(twins[0].draw(3).rolloff == twins[1].draw(3).rolloff);
  const SurfaceTwin other = fit_twin(scans, {.seed = 2, .draws = 100, .leave_one_out = false});
  CHECK(other.draws[0].hurst != twins[0].draws[0].hurst);
}

TEST_CASE("A spectrum that is not self-affine becomes a table", "[twin]") {
  RoughPatches patches(71);
  const TwinDraw base = law(SpectrumForm::corner, 0.7, 2.5e-5, 6e-7);
  // A hump by a factor of ten at 5 µm, wide enough for the spline to follow.
  const auto density = [&](double q) {
    const double off = std::log(q / (2 * pi / 5e-6)) / 0.5;
    return base.density(q) * (1 + 9 * std::exp(-off * off / 2));
  };
  std::vector<ScanSpectrum> scans;
  for (int scan = 0; scan < 4; ++scan) {
    Field heights = patches.patch(192, 60e-6, density);
    for (double& height : heights.reshaped()) height += 1e-10 * patches.normal();
    ScanInstrument ideal;
    ideal.noise = 1e-10;
    scans.push_back(scan_spectrum(heights, {192, 192, 60e-6, 60e-6}, ideal));
  }
  const SurfaceTwin twin = quick_twin(scans);
  CHECK(twin.form == SpectrumForm::table);
  CHECK(!twin.hurst.found());
  int inside = 0, asked = 0;
  for (std::size_t k = 0; k < twin.spectrum.wavenumber.size(); ++k) {
    const double q = twin.spectrum.wavenumber[k];
    if (q < 3 * 2 * pi / 60e-6 || q > 0.8 * 2 * pi / 6e-7) continue;
    ++asked;
    CHECK(twin.spectrum.psd[k] == Approx(density(q)).epsilon(0.5));
    inside += twin.spectrum.low[k] <= density(q) && density(q) <= twin.spectrum.high[k];
  }
  REQUIRE(asked > 20);
  CHECK(inside >= 0.6 * asked);
}

TEST_CASE("Noise eight decades below the longest waves is kept as it is", "[twin]") {
  // Waves are far longer than the scan: C at κ = 1 is 5e8 times the noise.
  const TwinDraw truth = law(SpectrumForm::corner, 0.9, 2e-3, 1e-6);
  RoughPatches patches(21);
  const std::vector<ScanSpectrum> scans = two_instruments(patches, truth);
  REQUIRE(scans[0].psd.front() > 1e8 * scans[0].psd.back());
  twin_detail::Responses responses;
  const std::vector<twin_detail::TwinData> groups =
      twin_detail::grouped(scans, std::vector<bool>(scans.size()), {}, responses);
  CHECK(groups[0].noise == Approx(1e-18 * scans[0].grid.cell_area() / (4 * pi * pi)));
  for (std::size_t k = 0; k < groups[0].bins.size(); ++k) {
    const std::size_t bin = groups[0].bins[k];
    CHECK(groups[0].psd[k] == Approx((scans[0].psd[bin] + scans[1].psd[bin]) / 2));
    CHECK(groups[0].leaked[k] < 0.1 * groups[0].psd[k]);
  }
}

TEST_CASE("Beyond a sharp end of the waves there is what the window leaks", "[twin]") {
  // 100 modes per side, no noise. The formula is for waves along an axis, the maximum; the mean
  // over directions is about a fifteenth of it at every distance from the end.
  const TwinDraw truth = law(SpectrumForm::corner, 0.7, 5e-5, 2e-6);
  RoughPatches patches(22);
  ScanInstrument ideal;
  ideal.noise = 0;
  const ScanSpectrum scan =
      scan_spectrum(patches.patch(480, 200e-6, [&](double q) { return truth.density(q); }),
                    {480, 480, 200e-6, 200e-6}, ideal);
  twin_detail::Responses responses;
  const twin_detail::TwinData group = twin_detail::grouped({scan}, {false}, {}, responses).front();
  int beyond = 0;
  for (std::size_t k = 0; k < group.bins.size(); ++k) {
    if (group.wavenumber[k] < 1.2 * 2 * pi / 2e-6) continue;
    ++beyond;
    const double share = scan.psd[group.bins[k]] / group.leaked[k];
    CHECK(share > 0.04);
    CHECK(share < 0.12);
  }
  CHECK(beyond == 4);
}

TEST_CASE("Profiles of a surface give the spectrum of the surface", "[twin]") {
  // Ten lines of 100 µm, far apart, on one surface.
  RoughPatches patches(81);
  const TwinDraw truth = law(SpectrumForm::corner, 0.8, 2e-5, 2e-6);
  std::vector<ScanSpectrum> lines;
  for (int patch = 0; patch < 5; ++patch) {
    const Field heights = patches.patch(256, 100e-6, [&](double q) { return truth.density(q); });
    for (const Index row : {20, 150}) {
      std::vector<double> line(256);
      for (Index i = 0; i < 256; ++i)
        line[static_cast<std::size_t>(i)] = heights(i, row) + 1e-10 * patches.normal();
      ScanInstrument ideal;
      ideal.noise = 1e-10;
      lines.push_back(profile_spectrum(line, 100e-6, ideal));
    }
  }
  const SurfaceTwin twin = quick_twin(lines);
  const Moments moments = integrated(truth);
  INFO("H " << twin.hurst.low << " " << twin.hurst.high << ", roll-off " << twin.rolloff.low << " "
            << twin.rolloff.high << ", cut-off " << twin.short_cutoff.low << " "
            << twin.short_cutoff.high << ", h' " << twin.rms_slope.low / moments.rms_slope << " "
            << twin.rms_slope.high / moments.rms_slope << " misfit " << twin.misfit);
  CHECK(twin.misfit < 2.2);
  // One of 20 intervals misses by chance, and these are close.
  CHECK(holds(twin.hurst, 0.8) + holds(twin.rms_slope, moments.rms_slope) +
            holds(twin.rolloff, truth.rolloff) >=
        2);
  CHECK(twin.short_cutoff.value == Approx(2e-6).epsilon(0.1));
  CHECK(twin.hurst.high - twin.hurst.low < 0.6);
}

TEST_CASE("A twin of nothing is refused", "[twin]") {
  CHECK_THROWS_WITH(fit_twin({}), Contains("scans"));
  RoughPatches patches(91);
  const ScanSpectrum scan = scan_of(patches, law(SpectrumForm::corner, 0.7, 2e-5, 2e-6), 64, 1e-4,
                                    instrument(Instrument::optical, 1e-9, 1e-6));
  CHECK_THROWS_WITH(fit_twin({scan}, {.draws = 3}), Contains("draws"));
  ScanSpectrum blunt = scan;
  blunt.instrument = instrument(Instrument::stylus, 1e-9, 1);
  CHECK_THROWS_WITH(fit_twin({blunt}), Contains("too few"));
}
