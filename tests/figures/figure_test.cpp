// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/results/assumption_verdicts.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>

#include "figures/gnuplot_script.hpp"

using namespace salebra;
using namespace salebra::figures;
using Catch::Contains;
using nlohmann::json;

TEST_CASE("The descriptions of figures list every member", "[figures]") {
  STATIC_REQUIRE(describes_all<figures::Axis>());
  STATIC_REQUIRE(describes_all<SecondAxis>());
  STATIC_REQUIRE(describes_all<Curve>());
  STATIC_REQUIRE(describes_all<Image>());
  STATIC_REQUIRE(describes_all<ReferenceLine>());
  STATIC_REQUIRE(describes_all<ShadedRange>());
  STATIC_REQUIRE(describes_all<Panel>());
  STATIC_REQUIRE(describes_all<Figure>());
}

TEST_CASE("JSON of a figure has enumerations by name, lists of one number, and null for NaN",
          "[figures]") {
  Figure figure{.kind = "test", .columns = 2};
  Panel& panel = figure.panels.emplace_back();
  panel.x = {.quantity = "pressure", .unit = "Pa", .logarithmic = true, .low = 1.5};
  panel.second_x = SecondAxis{.label = "p/(E^{*}h')", .factor = 1e-9};
  panel.curves.push_back({.x = {1}, .y = {std::nan("")}, .style = Style::line_and_points});
  panel.legend = Legend::bottom_left;
  panel.image = Image{.x = {0, 1}, .y = {0, 1, 2}, .values = Field(2, 3), .palette = Palette::grey};
  panel.image->values << 1, 2, 3, 4, 5, 6;
  const json text = json::parse(figure_json(figure));
  CHECK(text["kind"] == "test");
  CHECK(text["columns"] == 2);
  const json& first = text["panels"][0];
  CHECK(first["x"]["logarithmic"] == true);
  CHECK(first["x"]["low"] == 1.5);
  CHECK_FALSE(first["x"].contains("high"));
  CHECK(first["second_x"]["factor"] == 1e-9);
  CHECK_FALSE(first.contains("second_y"));
  CHECK(first["curves"][0]["x"] == json{1.0});
  CHECK(first["curves"][0]["y"][0].is_null());
  CHECK(first["curves"][0]["style"] == "line_and_points");
  CHECK(first["legend"] == "bottom_left");
  CHECK(first["image"]["palette"] == "grey");
  // values[x][y]
  CHECK(first["image"]["values"] == json{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("A curve that follows the exponential law lies on its fit in every panel", "[figures]") {
  constexpr double length = 20e-9, reference = 1e8;
  ForceCurve curve;
  for (double gap = 20e-9; gap < 80e-9; gap += 4e-9) {
    ForceSample sample;
    sample.mean_gap = gap;
    sample.pressure = reference * std::exp(-gap / length);
    sample.converged = true;
    curve.samples.push_back(sample);
  }
  ExponentialFit fit;
  fit.decay_length = length;
  fit.reference_pressure = reference;
  fit.decay_length_low = 19e-9;
  fit.decay_length_high = 21e-9;
  fit.window = {curve.samples.back().pressure, curve.samples.front().pressure};
  const Figure figure = figure_of(curve, fit);
  CHECK_THAT(figure.panels[0].title, Contains("20 nm (19 … 21)") && !Contains("do not use"));
  const ShadedRange& window = figure.panels[0].ranges.at(0);
  CHECK(window.low == Approx(curve.samples.front().mean_gap));
  CHECK(window.high == Approx(curve.samples.back().mean_gap));
  bool local = false, deviation = false;
  for (const Panel& panel : figure.panels) {
    if (panel.y.quantity == "local_decay_length") {
      local = true;
      CHECK(panel.lines.at(0).at == length);
      for (const double value : panel.curves.at(0).y) CHECK(value == Approx(length).epsilon(1e-9));
    }
    if (panel.y.label == "deviation from the fit (%)") {
      deviation = true;
      // Of exp and its inverse, in per cent.
      for (const double value : panel.curves.at(0).y) CHECK(std::abs(value) < 1e-11);
    }
  }
  CHECK(local);
  CHECK(deviation);
  // A curve that is nowhere near the fit shows it.
  fit.decay_length *= 2;
  const Figure wrong = figure_of(curve, fit);
  CHECK(std::abs(wrong.panels.back().curves.at(0).y.front()) > 10);
  // The window is where its samples are, and not where the law has their pressures.
  CHECK(wrong.panels[0].ranges.at(0).low == curve.samples.front().mean_gap);
  CHECK(wrong.panels[0].ranges.at(0).high == curve.samples.back().mean_gap);
  // A law that is far from the curve at the ends of the window is not to be used.
  fit.window.points = curve.samples.size();
  CHECK_THAT(figure_of(curve, fit).panels[0].title, Contains("do not use Eq. (16)"));
}

TEST_CASE("The 95 % interval of a spectrum holds the law of most rings", "[figures]") {
  // White noise: a ring of the spectrum is the mean of independent squares, and the law is constant.
  int held = 0, rings = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Surface surface;
    surface.grid = {64, 64, 1e-6, 1e-6};
    surface.periodic = true;  // without a window, which would make modes depend on each other
    surface.heights = Field(64, 64);
    std::uint64_t state = seed * 0x9E3779B97F4A7C15ull;
    const auto uniform = [&state] {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      return (static_cast<double>(state >> 11) + 0.5) / 9007199254740992.0;
    };
    for (Index i = 0; i < 64; ++i)
      for (Index j = 0; j < 64; ++j)
        surface.heights(i, j) =
            std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform());
    const PowerSpectrum spectrum = power_spectrum(surface);
    // h_rms² = ΣC d²q over 64² modes.
    const double law = 1 / (64 * 64 * spectrum.cell());
    const Figure figure = figure_of(surface, {spectrum, {}});
    const Curve& curve = figure.panels.at(1).curves.at(0);
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      CHECK(curve.low[k] < curve.y[k]);
      CHECK(curve.y[k] < curve.high[k]);
      held += curve.low[k] < law && law < curve.high[k];
      ++rings;
    }
  }
  // Some 600 rings: three standard deviations of a share of 95 % are 0.027.
  REQUIRE(rings > 200);
  CAPTURE(held, rings);
  CHECK(held / double(rings) == Approx(0.95).margin(0.027));
}

TEST_CASE("A second scale has the same limits, times its factor", "[figures]") {
  Figure figure;
  Panel& panel = figure.panels.emplace_back();
  panel.x = {.label = "p", .unit = "Pa", .logarithmic = true, .low = 1e6, .high = 1e8};
  panel.y = {.label = "l", .unit = "m", .low = 0, .high = 2e-8};
  panel.second_x = SecondAxis{.label = "relative", .factor = 1e-9};
  panel.second_y = SecondAxis{.label = "over h", .factor = 1e8};
  panel.curves.push_back({.x = {1e6, 1e8}, .y = {1e-8, 2e-8}});
  const std::string script = gnuplot_script(figure, PictureFormat::svg);
  CHECK_THAT(script, Contains("set xrange [0:2]"));     // lg of MPa
  CHECK_THAT(script, Contains("set x2range [-3:-1]"));  // lg p/1 GPa
  CHECK_THAT(script, Contains("set yrange [0:20]"));    // nm
  CHECK_THAT(script, Contains("set y2range [0:2]"));
  CHECK_THAT(script, Contains("set x2label 'relative'") && Contains("set y2label 'over h'"));
}

TEST_CASE("Figures of surfaces and spots show their numbers", "[figures]") {
  Surface surface;
  surface.grid = {16, 8, 2e-6, 1e-6};
  surface.heights = Field(16, 8);
  for (Index i = 0; i < 16; ++i)
    for (Index j = 0; j < 8; ++j) surface.heights(i, j) = double(i * 8 + j);
  const Figure bearing = figure_of(BearingCurve(surface));
  CHECK(bearing.panels.at(0).curves.at(0).y.front() == Approx(127));
  const Figure lags = figure_of(correlation_map(surface));
  CHECK(lags.panels.at(0).image->x.at(8) == Approx(0).margin(1e-20));
  const Figure all = figure_of(surface);
  CHECK(all.panels.at(0).image->values(3, 5) == 29);
  // Of 0 … 127: (128² − 1)/12.
  CHECK_THAT(all.panels.at(0).title, Contains("36.9 m") || Contains("37 m"));

  ContactSpots spots;
  spots.spots = {{4e-12, 0}, {2e-12, 0}, {1e-12, 0}};
  const Curve curve = figure_of(spots).panels.at(0).curves.at(0);
  CHECK(curve.x == std::vector<double>{4e-12, 2e-12, 1e-12});
  CHECK(curve.y == std::vector<double>{1, 2, 3});
}

TEST_CASE("One curve has labels and units of its quantities, and scales that suit its values",
          "[figures]") {
  const Figure figure =
      curve_figure("pressure", "spot_count",
                   {.x = {1e6, 1e7, 1e8}, .y = {3, 4, 5}, .low = {2, 3, 4}, .high = {4, 5, 6}});
  const Panel& panel = figure.panels.at(0);
  CHECK(panel.x.unit == "Pa");
  CHECK(panel.x.logarithmic);
  CHECK_FALSE(panel.y.logarithmic);
  CHECK(panel.y.quantity == "spot_count");
  CHECK(panel.y.unit.empty());
  CHECK(panel.curves.at(0).high.at(2) == 6);
}

TEST_CASE("Limits hold what is drawn, do not magnify a constant, and a quantity has one prefix",
          "[figures]") {
  Panel constant, decades, loop;
  constant.curves = {{.x = {0, 1}, .y = {5, 5.001}}};
  decades.x = {.quantity = "force", .unit = "N", .logarithmic = true};
  decades.y = {.logarithmic = true};
  // The last point cannot be drawn, and the lower end of the bar would add twelve decades.
  decades.curves = {{.x = {0.1, 2, 1e9},
                     .y = {1, 100, 0},
                     .low = {1e-12, 90, 0},
                     .high = {2, 110, 0},
                     .style = Style::points}};
  loop.y = {.quantity = "force", .unit = "N"};
  loop.curves = {{.x = {-1, 1}, .y = {-3, 3}}};
  loop.lines = {{.at = 5, .name = "limit"}};
  const Figure out = with_limits({.panels = {constant, decades, loop}});
  CHECK(*out.panels[0].y.low == Approx(4.9).epsilon(1e-3));
  CHECK(*out.panels[0].y.high == Approx(5.1).epsilon(1e-3));
  CHECK(*out.panels[0].x.low == 0);
  CHECK(*out.panels[1].x.high < 3);
  CHECK(*out.panels[1].x.low < 0.1);
  CHECK(*out.panels[1].y.low > 0.5);
  CHECK(*out.panels[1].y.high > 110);
  CHECK(*out.panels[2].y.low < -3);
  CHECK(*out.panels[2].y.high > 5);
  CHECK(*out.panels[2].x.low < -1);
  // Newtons, as along the axis of the loop.
  CHECK(out.panels[1].x.prefix_of == out.panels[2].y.prefix_of);
  CHECK(*out.panels[1].x.prefix_of == *out.panels[2].y.high);
}

TEST_CASE("Panels have letters in order, their sentences become the caption, and details go first",
          "[figures]") {
  Figure figure{.caption = "Two curves."};
  for (const char* title : {"first", "", "third"})
    figure.panels.push_back({.title = title,
                             .caption = std::string(title) + " panel.",
                             .curves = {{.x = {1, 2}, .y = {1, 2}}}});
  figure.panels[2].detail = true;
  const Figure all = with_limits(figure);
  CHECK(all.panels[0].title == "(a) first");
  CHECK(all.panels[1].title == "(b)");
  CHECK(all.caption == "Two curves. (a) first panel. (b)  panel. (c) third panel.");
  // JSON and pictures may ask again.
  CHECK(figure_json(all) == figure_json(figure));
  const Figure narrow = for_width(figure, 0.085);
  CHECK(narrow.panels.size() == 2);
  CHECK_THAT(narrow.caption, !Contains("third"));
  CHECK(for_width(figure, 0.17).panels.size() == 3);
  figure.panels.resize(1);
  CHECK(with_limits(figure).panels[0].title == "first");
  CHECK(with_limits(figure).caption == "Two curves. first panel.");
}

TEST_CASE("A ratio of stiffnesses is drawn only where it was computed", "[figures]") {
  ForceCurve curve;
  for (const double pressure : {1e6, 2e6, 4e6}) {
    ForceSample& sample = curve.samples.emplace_back();
    sample.mean_gap = 1e-8 * std::log(1e7 / pressure);
    sample.pressure = pressure;
    sample.force = 1e-6 * pressure;
    sample.normal_stiffness = 10 * pressure;
    sample.tangential_stiffness = 8 * pressure;
    sample.converged = true;
  }
  // K_t = 0.8 K at all loads is that of the moduli.
  const Figure assumed = figure_of(curve, std::nullopt);
  CHECK(assumed.panels.back().curves.back().name == "tangential, K_t = (G^{*}/E^{*})K, assumed");
  curve.samples[2].tangential_stiffness *= 1.01;
  // A load without K has no ratio, and the others keep their places.
  curve.samples[1].normal_stiffness = std::nan("");
  const Curve ratio = figure_of(curve, std::nullopt).panels.back().curves.front();
  REQUIRE(ratio.x.size() == ratio.y.size());
  CHECK(ratio.y[0] == Approx(0.8));
  CHECK(std::isnan(ratio.y[1]));
  CHECK(ratio.y[2] == Approx(0.808));
  // A curve by pressures without forces has no stiffnesses over the force.
  for (ForceSample& sample : curve.samples) sample.force = std::nan("");
  curve.samples[2].tangential_stiffness = 8 * curve.samples[2].pressure;
  CHECK(figure_of(curve, std::nullopt).panels.size() == 1);
}

TEST_CASE("The headline of viscoelastic cycles is that of the last one with a loss", "[figures]") {
  std::vector<ViscoelasticCycle> cycles(3);
  cycles[0].work_per_cycle = 1e-12;
  cycles[1].work_per_cycle = 2e-12;
  cycles[1].work_per_cycle_error = 1e-13;
  cycles[1].damping_constant = 3;
  cycles[2].work_per_cycle = std::nan("");
  const std::vector<double> frequencies{2 * std::numbers::pi, 20 * std::numbers::pi,
                                        200 * std::numbers::pi};
  CHECK(figure_of("angular_frequency", frequencies, cycles).panels[0].title ==
        "W = 2 pJ ± 5 %, γ = 3 N s/m at 10 Hz");
  CHECK_THROWS_AS(
      figure_of("angular_frequency", std::vector<double>(), std::vector<ViscoelasticCycle>()),
      InvalidInput);
}

TEST_CASE("A headline says that its result is not valid, and why", "[figures]") {
  Figure figure;
  for (const char* title : {"γ = 14.1 N s/m", "no headline"})
    figure.panels.push_back({.title = title, .curves = {{.x = {1, 2}, .y = {1, 2}}}});
  Assumptions sliding;
  sliding.regime = Regime::sliding;
  Figure stated = figure;
  state_validity(stated, std::vector{sliding}, true);
  CHECK(stated.panels[0].title == "γ = 14.1 N s/m (not valid: Coulomb friction, not a damper)");
  CHECK(stated.panels[1].title == "no headline");
  Assumptions flowing;
  flowing.plasticity.verdict = Verdict::broken;
  flowing.plasticity.value = 2;
  stated = figure;
  state_validity(stated, std::vector{flowing}, true);
  CHECK(stated.panels[0].title == "γ = 14.1 N s/m (not valid: plasticity)");
  stated = figure;
  state_validity(stated, std::vector{Assumptions{}}, true);
  CHECK(stated.panels[0].title == "γ = 14.1 N s/m (validity not checked)");
  CHECK(stated.caption.empty());
  figure.panels[0].title = "a map";
  state_validity(figure, std::vector<AssumptionVerdict>());
  CHECK(figure.caption == " Validity not checked.");
}

TEST_CASE("The maps of a surface of a study hold its values where its points are", "[figures]") {
  SurfacePicture picture;
  picture.stride = 1;
  picture.nx = 2;
  picture.ny = 3;
  picture.step_x = 1e-6;
  picture.step_y = 2e-6;
  picture.heights = {0, 1, 2, 3, 4, 5};  // y contiguous
  picture.first_load = {-1, 0, 1, -1, -1, 1};
  picture.mapped_load = 1;
  picture.contact_pressure = {0, 5e6F, 7e6F, 0, 0, 1e6F};
  picture.wavenumber = {1e6, 2e6};
  picture.psd = {1e-20, 1e-21};
  picture.hurst = std::nan("");
  const Figure figure = figure_of(picture, {1e6, 2e6});
  REQUIRE(figure.panels.size() == 4);  // no gap, no histogram
  const Image &heights = *figure.panels[0].image, &touch = *figure.panels[1].image,
              &pressure = *figure.panels[2].image;
  CHECK(heights.values(1, 2) == 5);
  CHECK(heights.y.at(1) - heights.y.at(0) == Approx(2e-6));
  // The map ends at the edges of the surface.
  CHECK(heights.y.back() + 1e-6 == Approx(3 * picture.step_y));
  CHECK(std::isnan(touch.values(0, 0)));
  CHECK(touch.values(0, 1) == 1e6);
  CHECK(touch.values(1, 2) == 2e6);
  CHECK(std::isnan(pressure.values(0, 0)));
  CHECK(pressure.values(1, 2) == 1e6);
  CHECK_THAT(figure.panels[2].title, Contains("at 2 MPa"));
  CHECK(figure.panels[3].title == "power spectral density");
}
