// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/report/report.hpp>
#include <salebra/study/study_file.hpp>
#include <salebra/study/study_solution.hpp>
#include <sstream>
#include <tuple>

#include "scratch.hpp"
#include "skipped.hpp"
#include "small_study.hpp"

using namespace salebra;
using Catch::Contains;
using Json = nlohmann::json;

namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The data in the page.
Json payload(const std::string& page) {
  const std::string mark = "<script type=\"application/json\" id=\"data\">";
  const auto begin = page.find(mark) + mark.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Writes a minimal file of a study with texts that try to inject markup.
void write_hostile(const std::filesystem::path& file) {
  Provenance provenance;
  provenance.command_line = "salebra study '</script><script>document.title=\"taken\"</script>'";
  provenance.configuration = "<img src=x onerror=\"document.title='taken'\"> <!-- {{script}}";
  provenance.started = "2026-01-31T11:29:54Z";
  provenance.created = "2026-01-31T12:34:56Z";
  provenance.revision = "0123456789ab-modified";
  ResultFile output(file, provenance, {.overwrite = true});
  ResultGroup curve = output.group("curve");
  curve.labels("model", {"bem", "<b onmouseover=\"document.title='taken'\">bold</b>"}, "model");
  curve.index("realisation", 1, "number of the surface");
  curve.coordinate("pressure", std::vector<double>{1e6, 1e7, 1e8}, "Pa", "nominal pressure");
  for (const auto& [name, values] :
       {std::pair("mean_gap", std::vector<double>{3e-8, 2e-8, 1e-8, 3e-8, 2e-8, 1e-8}),
        {"contact_area_fraction", {1e-3, 1e-2, 1e-1, 1e-3, 1e-2, 1e-1}},
        {"converged", {1, 1, 1, 1, 1, 1}}})
    curve.dataset(name, values, {"model", "realisation", "pressure"}, "1", name);
  ResultGroup surface = output.group("surface");
  surface.attribute("size_x", 1e-5);
  surface.attribute("size_y", 1e-5);
  surface.attribute("contact_modulus", 1e10);
  surface.index("realisation", 1, "number of the surface");
  for (const auto& [name, value] : {std::pair("rms_height", 1e-8), {"rms_slope", 0.1}})
    surface.dataset(name, std::vector{value}, {"realisation"}, "1", name);
  surface.attribute("warnings", "mind </script><script>document.title='taken'</script>\n");
  output.commit();
}

}  // namespace

TEST_CASE("A report holds the numbers of its study and needs nothing else", "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const Scratch scratch;
  const StudyResult result = run_study(small_study());
  write_study(scratch / "study.h5", result);
  write_report(scratch / "study.h5", scratch / "study.html");
  const std::string page = content(scratch / "study.html");
  for (const char* place : {"{{title}}", "{{style}}", "{{plotly}}", "{{data}}", "{{script}}"})
    CHECK(page.find(place) == std::string::npos);
  CHECK(count(page, "<script") == 3);
  CHECK(count(page, "</script>") == 3);
  CHECK(count(page, "<link") == 0);
  CHECK(count(page, " src=") == 0);
  CHECK_THAT(page, Contains("default-src 'none'"));

  const Json data = payload(page);
  REQUIRE(data["points"].size() == 1);
  const Json& point = data["points"][0];
  REQUIRE(point["pressure"].size() == result.pressures.size());
  // Numbers in the page have seven digits.
  const EnsembleMean length = result.decay_length();
  const Json& shown = point["fit"]["models"]["bem"]["decay_length"];
  CHECK(shown["mean"].get<double>() == Approx(length.mean).epsilon(1e-6));
  CHECK(shown["low"].get<double>() == Approx(length.low).epsilon(1e-6));
  CHECK(shown["high"].get<double>() == Approx(length.high).epsilon(1e-6));
  const EnsembleMean bend = result.fitted("law_bend");
  CHECK(point["fit"]["models"]["bem"]["law_bend"]["mean"].get<double>() ==
        Approx(bend.mean).epsilon(1e-6));
  CHECK(point["fit"]["models"]["bem"]["law_bend"]["low"].get<double>() ==
        Approx(bend.low).epsilon(1e-6));
  // The data and the text without scripts must give the same verdict as the file.
  const auto law = result.law_description();
  REQUIRE(law);
  CHECK(point["fit"]["models"]["bem"]["fair"] == double(law->fair));
  CHECK(point["fit"]["models"]["bem"]["law_off_at_min_gap"].get<double>() ==
        Approx(law->law_off_at_min_gap).epsilon(1e-6));
  CHECK_THAT(page,
             Contains(law->fair ? "law is a fair description." : "law is a poor description."));
  const auto curve = result.stated("damping_constant_without_slip");
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Json& value = point["damping"]["curve"]["damping_constant"]["bem"]["mean"][k];
    CHECK(value.is_null() == std::isnan(curve[k].mean));
    if (!value.is_null()) CHECK(value.get<double>() == Approx(curve[k].mean).epsilon(1e-6));
  }
  // A height has four bytes, and base64 has four characters for three bytes.
  const auto figure = [&](const char* kind) {
    for (const Json& one : point["figures"])
      if (one["kind"] == kind) return one["panels"][0];
    return Json();
  };
  CHECK(figure("height-map")["image"]["values"].get<std::string>().size() ==
        (64 * 64 * 4 + 2) / 3 * 4);
  // The figures of the library have the numbers of the file.
  const ResultReader file(scratch / "study.h5");
  const auto same = [](const Json& drawn, const std::vector<double>& stored) {
    REQUIRE(drawn.size() == stored.size());
    for (std::size_t i = 0; i < stored.size(); ++i)
      CHECK((drawn[i].is_null() ? std::isnan(stored[i]) : drawn[i].get<double>() == stored[i]));
  };
  for (const auto& [kind, curve, path] :
       {std::tuple("spectrum", 1, "picture/law_psd"),
        {"distribution", 0, "picture/height_density"},
        {"spots", 0, "spots/ensemble_spot_count_mean"},
        {"spot-areas", 0, "spots/ensemble_mean_spot_area_mean"},
        {"spot-areas", 1, "spots/ensemble_max_spot_area_mean"},
        {"convergence", 0, "convergence/decay_length_over_rms_height_mean"}})
    same(figure(kind)["curves"][curve]["y"], file.numbers(path));
  // The spectrum leaves out what is only round-off, beyond the shortest wave of the study.
  std::vector<double> psd = file.numbers("picture/psd");
  const double floor = 1e-13 * std::ranges::max(psd);
  CHECK(std::ranges::any_of(psd, [&](double density) { return density < floor; }));
  for (double& density : psd)
    if (density < floor) density = std::nan("");
  same(figure("spectrum")["curves"][0]["y"], psd);
  same(figure("spots")["curves"][0]["low"], file.numbers("spots/ensemble_spot_count_low"));
  same(figure("spots")["curves"][0]["x"], result.pressures);
  // The density of a Gaussian with the rms height of the distribution has its integral and its
  // second moment; the bins end where heights do, which leaves out less than 5 %.
  const Json gaussian = figure("distribution")["curves"][1], heights = gaussian["x"],
             histogram = figure("distribution")["curves"][0]["y"];
  double density = 0, squares = 0, drawn = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double height = heights[i].get<double>(),
                 bin = heights[1].get<double>() - heights[0].get<double>();
    density += gaussian["y"][i].get<double>() * bin;
    squares += gaussian["y"][i].get<double>() * bin * height * height;
    drawn += histogram[i].get<double>() * bin * height * height;
  }
  CHECK(density == Approx(1).epsilon(0.05));
  CHECK(squares == Approx(drawn).epsilon(0.2));
}

TEST_CASE("A page draws the panels that the program draws of the same study, to the last digit",
          "[report][figures]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const Scratch scratch;
  StudyConfiguration study = small_study();
  study.stick = true;
  study.known.friction_coefficient = 0.3;
  study.known.excursion = 2e-6;
  const StudyResult result = run_study(study);
  write_study(scratch / "study.h5", result);
  write_report(scratch / "study.h5", scratch / "study.html");
  Json drawn = Json::parse(figures::figure_json(figures::figure_of(result)))["panels"],
       shown = payload(content(scratch / "study.html"))["points"][0];
  std::size_t k = 0;
  for (const char* kind : {"gap-load", "area-load", "damping-curve", "stiffness-load",
                           "stiffness-ratio", "local-length", "damping-ratio"}) {
    INFO(kind);
    const auto figure = std::ranges::find_if(shown["figures"],
                                             [&](const Json& one) { return one["kind"] == kind; });
    REQUIRE(figure != shown["figures"].end());
    REQUIRE(k < drawn.size());
    Json &page = (*figure)["panels"][0], &own = drawn[k++];
    // Only the first panel of the program names the models.
    for (Json* panel : {&page, &own})
      for (Json& curve : (*panel)["curves"]) curve.erase("name");
    // A figure of one panel has no letter, and the summary of the page says why a result is not
    // valid.
    const std::string mark = {'(', char('a' + k - 1), ')'}, title = page["title"];
    CHECK(own["title"].get<std::string>().starts_with(mark));
    CHECK_THAT(own["title"].get<std::string>() + ")",
               Contains(title.substr(0, title.find_last_not_of(')') + 1)));
    page["title"] = own["title"];
    own["detail"] = false;
    // Only the first row of the program has the second scale of the pressure.
    if (!own.contains("second_x")) page.erase("second_x");
    CHECK(page == own);
  }
  CHECK(k == drawn.size());
  // The axis of K_t/K, which is near G*/E* = 0.82, has no empty room down to zero.
  CHECK(drawn[4]["y"]["low"].get<double>() > 0.6);
  // Without stick solves all ratios are G*/E*, and no panel shows that.
  study.stick = false;
  CHECK(figures::figure_of(run_study(study)).panels.size() == drawn.size() - 1);
  CHECK_THAT(figures::figure_of(result).caption, Contains(shown["motion"].get<std::string>()));
  CHECK_THAT(shown["motion"].get<std::string>(), Contains("Motion: slow shear over 2 µm at ") &&
                                                     Contains("mean indentation held") &&
                                                     Contains("µ = 0.3"));
}

TEST_CASE("Direct results stand beside the damping of the same motion and of no other",
          "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const Scratch scratch;
  write_study(scratch / "study.h5", run_study(small_study()));
  const auto cycle = [&](const std::string& name, double amplitude) {
    ResultFile output(scratch / name, {});
    ResultGroup group = output.group("cycle");
    group.coordinate("time", std::vector<double>{0, 0.25, 0.5}, "1", "time in periods");
    group.dataset("indentation", std::vector<double>{1e-8 + amplitude, 1e-8, 1e-8 - amplitude},
                  {"time"}, "m", "indentation");
    // As `oscillate` writes it.
    group.dataset("normal_force", std::vector<double>{3e-6, 2e-6, 1e-6}, {"time"}, "N",
                  "normal force");
    group.attribute("work_per_cycle", 4e-21);
    output.commit();
    return scratch / name;
  };
  ReportOptions options;
  options.direct = {cycle("same.h5", 1e-10)};
  write_report(scratch / "study.h5", scratch / "study.html", options);
  const Json direct = payload(content(scratch / "study.html"))["points"][0]["damping"]["direct"];
  REQUIRE(direct.size() == 1);
  CHECK(direct[0]["force"].get<double>() == Approx(2e-6));
  CHECK(direct[0]["work_per_cycle"].get<double>() == Approx(4e-21));
  // The picture of damping has it as a point at the same force and loss.
  for (const Json& figure : payload(content(scratch / "study.html"))["points"][0]["figures"]) {
    if (figure["kind"] != "damping-curve") continue;
    const Json& panel = figure["panels"][0];
    const Json& point = panel["curves"].back();
    CHECK(point["name"] == "direct simulation");
    CHECK(point["x"][0].get<double>() * panel["second_x"]["factor"].get<double>() == Approx(2e-6));
    CHECK(point["y"][0].get<double>() * panel["second_y"]["factor"].get<double>() == Approx(4e-21));
  }

  options.direct = {cycle("other.h5", 3e-10)};
  CHECK_THROWS_WITH(write_report(scratch / "study.h5", scratch / "other.html", options),
                    Contains("other.h5: oscillates by 300 pm, but the study by 100 pm"));
  options.direct = {scratch / "study.h5"};
  CHECK_THROWS_WITH(write_report(scratch / "study.h5", scratch / "other.html", options),
                    Contains("not contain an oscillation"));
}

TEST_CASE("A page of a surface with a lay has its two spectra and both directions of motion",
          "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const Scratch scratch;
  StudyConfiguration study = small_study();
  study.stick = true;
  std::get<GeneratedSurfaces>(study.surfaces).textures.front().lay.along = 6;
  const StudyResult result = run_study(study);
  write_study(scratch / "study.h5", result);
  write_report(scratch / "study.h5", scratch / "study.html");
  const std::string page = content(scratch / "study.html");
  const Json point = payload(page)["points"][0];
  CHECK(point["damping"]["direction_in_words"] == "along y");
  REQUIRE(point["other_directions"].size() == 1);
  const Json& other = point["other_directions"][0];
  CHECK(other["damping"]["direction_in_words"] == "along x");
  const StatedMean expected = solution_of(result.in_directions().at(1)).damping_constant.back();
  CHECK(other["solution"]["damping_constant"]["mean"].back().get<double>() ==
        Approx(expected.mean).epsilon(1e-6));
  CHECK(count(page, "<caption>Damping constant by boundary elements, motion along") == 2);
  for (const Json& figure : point["figures"])
    if (figure["kind"] == "spectrum")
      CHECK(figure["panels"][0]["y"]["quantity"] == "profile_psd");
    else if (figure["kind"] == "damping-curve")
      CHECK(figure["panels"][0]["curves"].back()["name"] == "along x");
}

TEST_CASE("The points of a parameter grid share the room for maps", "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const Scratch scratch;
  StudyConfiguration study = small_study();
  study.ensemble.hurst = {0.5, 0.8};
  write_ensembles(scratch / "grid.h5", run_ensembles(study));
  write_report(scratch / "grid.h5", scratch / "grid.html");
  const Json data = payload(content(scratch / "grid.html"));
  CHECK(data["names"] == Json({"H = 0.5", "H = 0.8"}));
  REQUIRE(data["points"].size() == 2);
  CHECK(data["points"][1]["picture"]["nx"] == 64);
  const Json& overview = data["figures"][0];
  CHECK(overview["kind"] == "overview");
  CHECK_THAT(overview["caption"].get<std::string>(), Contains("point 1: H = 0.5, 2: H = 0.8"));
  CHECK(overview["panels"][0]["curves"][0]["y"].get<std::vector<double>>() ==
        ResultReader(scratch / "grid.h5")
            .numbers("ensemble/ensemble_decay_length_over_rms_height_mean"));
}

TEST_CASE("Names in a results file stay text, and what an old one lacks is left out", "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const Scratch scratch;
  write_hostile(scratch / "hostile.h5");
  // The file is kept: the browser test checks that none of its scripts run.
  const std::filesystem::path html = std::filesystem::path(SALEBRA_PAGES) / "hostile.html";
  write_report(scratch / "hostile.h5", html,
               {.write = {.overwrite = true}, .title = "<script>document.title='taken'</script>"});
  const std::string page = content(html);
  CHECK(count(page, "<script") == 3);
  CHECK(count(page, "</script>") == 3);
  CHECK(count(page, "<img") == 0);
  CHECK(count(page, "<!--") == 1);
  const Json data = payload(page);
  const Json& point = data["points"][0];
  CHECK_FALSE(point.contains("picture"));
  CHECK_FALSE(point.contains("damping"));
  CHECK(point["models"][1]["title"] == "<b onmouseover=\"document.title='taken'\">bold</b>");
  CHECK_THAT(data["provenance"]["configuration"].get<std::string>(), Contains("{{script}}"));
}

TEST_CASE("A report of a bad file is refused and leaves nothing", "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const Scratch scratch;
  CHECK_THROWS_AS(write_report(scratch / "none.h5", scratch / "page.html"), InvalidInput);
  CHECK_THROWS_AS(write_report(scratch.file("text.h5", "not an HDF5"), scratch / "page.html"),
                  InvalidInput);
  {
    // Fewer values than the coordinates require.
    ResultFile output(scratch / "short.h5", {});
    ResultGroup curve = output.group("curve");
    curve.labels("model", {"bem", "gw_moments"}, "model");
    curve.coordinate("pressure", std::vector<double>{1, 2, 3}, "Pa", "pressure");
    curve.index("few", 2, "too few");
    curve.dataset("ensemble_mean_gap_mean", std::vector<double>{1, 2}, {"few"}, "m", "mean gap");
    output.commit();
  }
  CHECK_THROWS_WITH(write_report(scratch / "short.h5", scratch / "page.html"),
                    Contains("short.h5: curve/ensemble_mean_gap_mean has 2 values, 3 are needed"));
  CHECK_FALSE(std::filesystem::exists(scratch / "page.html"));

  write_hostile(scratch / "good.h5");
  scratch.file("mine.html", "mine");
  CHECK_THROWS_AS(write_report(scratch / "good.h5", scratch / "mine.html"), InvalidInput);
  CHECK(content(scratch / "mine.html") == "mine");
  CHECK_THROWS_AS(write_report(scratch / "good.h5", scratch / "no" / "page.html"), InvalidInput);
}
