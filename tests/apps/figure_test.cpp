// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers behind the pictures, and those of the comparison's answer.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <regex>
#include <salebra/io/result_file.hpp>
#include <set>
#include <sstream>

#include "drawing.hpp"
#include "run_program.hpp"
#include "study/study_text.hpp"

using Catch::Contains;
using nlohmann::json;

namespace {

using Values = std::vector<double>;

/// null is what JSON has for an unknown number.
Values numbers(const json& list) {
  Values values;
  for (const json& value : list)
    values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                     : value.get<double>());
  return values;
}

/// Nine digits go to gnuplot.
void check_alike(const Values& found, const Values& expected, double tolerance = 1e-7) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    INFO(k);
    if (std::isnan(expected[k]))
      CHECK(std::isnan(found[k]));
    else
      CHECK(found[k] == Approx(expected[k]).epsilon(tolerance).margin(tolerance));
  }
}

/// Two lists are the same but for a common addend, which is the SI prefix of a logarithmic axis.
void check_parallel(const Values& found, const Values& expected) {
  REQUIRE(found.size() == expected.size());
  std::size_t first = 0;
  while (first < found.size() && std::isnan(expected[first])) ++first;
  REQUIRE(first < found.size());
  Values shifted = found;
  for (double& value : shifted) value += expected[first] - found[first];
  check_alike(shifted, expected);
  // Prefixes are powers of 1000.
  const double prefix = (found[first] - expected[first]) / 3;
  CHECK(prefix == Approx(std::round(prefix)).margin(1e-6));
}

Values logarithms(Values values) {
  for (double& value : values) value = std::log10(value);
  return values;
}

/// row of (model, pressure) in a file of a study.
Values row_of(const salebra::ResultReader& file, const std::string& dataset, std::size_t model,
              std::size_t loads) {
  const Values all = file.numbers(dataset);
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(model * loads);
  return {begin, begin + static_cast<std::ptrdiff_t>(loads)};
}

}  // namespace

TEST_CASE("The picture of a comparison draws the numbers of its answer", "[compare][plot]") {
  const ProgramTest test;
  // There is one surface, so that means of ratios are ratios of means.
  test.write("study.toml", study_text("seeds = [3]"));
  const std::string command =
      "compare study.toml --no-stick --no-report --json --models gw_moments,persson -o result.h5";
  const Drawing drawing(test, command);
  const json answer = drawing.answer();
  const salebra::ResultReader file(test.folder() / "result.h5");
  const double rms_height = file.numbers("surface/rms_height").front();
  const double scale = 1e10 * file.numbers("surface/rms_slope").front();  // E*h'
  const Values pressure = numbers(answer["pressure"]);
  Values force;
  for (const double p : pressure) force.push_back(p * 16e-12);
  const Values loads = logarithms(pressure);
  const auto each = [&](const auto& value) {
    Values values;
    for (std::size_t k = 0; k < pressure.size(); ++k) values.push_back(value(k));
    return values;
  };
  int curve = 0;
  for (const std::string model : {"bem", "gw_moments", "persson"}) {
    INFO(model);
    const json& found = answer["models"][model];
    const Values gap = numbers(found["curve"]["mean_gap"]["mean"]),
                 area = numbers(found["curve"]["contact_area_fraction"]["mean"]),
                 stiffness = numbers(found["curve"]["normal_stiffness"]["mean"]);
    for (const int panel : {1, 2, 3, 4}) check_parallel(drawing.column(panel, curve, 0), loads);
    check_alike(drawing.column(1, curve, 1), each([&](auto k) { return gap[k] / rms_height; }));
    check_alike(drawing.column(2, curve, 1),
                each([&](auto k) { return area[k] * scale / pressure[k]; }));
    check_alike(drawing.column(4, curve, 1),
                each([&](auto k) { return stiffness[k] * rms_height / force[k]; }));
    check_parallel(drawing.column(3, curve, 1),
                   logarithms(numbers(found["damping"]["damping_constant"]["mean"])));
    ++curve;
  }
  // The fitted law.
  const double length = file.numbers("fit/decay_length").front(),
               reference = file.numbers("fit/reference_pressure").front();
  check_alike(drawing.column(1, curve, 1), each([&](auto k) {
                return length / rms_height * std::log(reference / pressure[k]);
              }));
  const Values corrected = numbers(answer["spots"]["corrected_area_fraction"]["mean"]);
  check_alike(drawing.column(2, curve, 1),
              each([&](auto k) { return corrected[k] * scale / pressure[k]; }));
  check_parallel(drawing.column(3, curve, 1),
                 logarithms(numbers(
                     answer["models"]["bem"]["damping"]["damping_constant_closed_form"]["mean"])));
  // The pressures of the fit, at mean gaps from two and a half rms heights to one.
  const Values ends{file.numbers("fit/pressure_min").front(),
                    file.numbers("fit/pressure_max").front()};
  static const std::regex window(
      "rectangle from first ([-0-9.e]+),graph 0 to first ([-0-9.e]+),graph 1");
  const std::string script = drawing.script();
  std::smatch found;
  REQUIRE(std::regex_search(script, found, window));
  check_parallel({std::stod(found[1]), std::stod(found[2])}, logarithms(ends));
  CHECK_THAT(script, Contains("window of the fit"));

  // Two surfaces have intervals, with the mean between their limits.
  test.write("study.toml", study_text("seeds = [3, 4]"));
  const Drawing bands(test, command);
  const json two = bands.answer();
  for (const int panel : {1, 2, 4}) {
    const Values mean = bands.column(panel, 1, 1), low = bands.column(panel, 1, 2),
                 high = bands.column(panel, 1, 3);
    for (std::size_t k = 0; k < mean.size(); ++k) {
      CHECK(low[k] < mean[k]);
      CHECK(mean[k] < high[k]);
      // Student's limits, or those of the logarithm where these would reach 0.
      const bool student = mean[k] - low[k] == Approx(high[k] - mean[k]).epsilon(1e-3);
      CHECK((student || low[k] * high[k] == Approx(mean[k] * mean[k]).epsilon(1e-3)));
    }
  }
  const json& damping = two["models"]["gw_moments"]["damping"]["damping_constant"];
  check_parallel(bands.column(3, 1, 3), logarithms(numbers(damping["high"])));
}

TEST_CASE("The picture of a study draws the damping constants of its table with their errors",
          "[study][plot]") {
  const ProgramTest test;
  for (const std::string seeds : {"seeds = [3]", "seeds = [1, 2, 3]"})
    for (const std::string slip : {"", " --friction-coefficient 0.3 --excursion 1um"}) {
      CAPTURE(seeds, slip);
      const bool sample = seeds.size() > 12;
      test.write("study.toml", study_text(seeds));
      const Drawing drawing(test, "study study.toml --no-report --json" + slip);
      const json table = drawing.answer()["damping"]["damping_constant"];
      Values mean = numbers(table["mean"]), low = numbers(table["low"]),
             high = numbers(table["high"]);
      const Values error = numbers(table["error"]);
      const int points = 4;  // after three models and the law
      const auto drawn = [&](std::size_t column) { return drawing.column(3, points, column); };
      check_parallel(drawn(1), logarithms(mean));
      const double prefix = drawn(1)[9] - std::log10(mean[9]);
      int bars = 0;
      for (std::size_t k = 0; k < mean.size(); ++k) {
        const double from = sample ? low[k] : mean[k] - error[k],
                     to = sample ? high[k] : mean[k] + error[k];
        // A bar below zero has no end on a logarithmic axis.
        if (std::isnan(from) || from <= 0) continue;
        ++bars;
        CHECK(drawn(2)[k] == Approx(std::log10(from) + prefix).margin(1e-6));
        CHECK(drawn(3)[k] == Approx(std::log10(to) + prefix).margin(1e-6));
      }
      CHECK(bars > 3);
      CHECK_THAT(drawing.script(), Contains("with yerrorbars"));
      CHECK_THAT(drawing.script(),
                 Contains(std::string(slip.empty() ? "'without slip" : "'with slip, µ = 0.3") +
                          (sample ? ", 95 % interval'" : ", ± error'")));
      CHECK_THAT(drawing.script(),
                 Contains("nominal pressure p (") && Contains("normal force F ("));
    }
}

TEST_CASE("Every model of a comparison is in its legend, of bodies that adhere as well",
          "[compare][plot]") {
  const ProgramTest test;
  for (const std::string& text : {study_text("seeds = [3]"), adhesive_study_text()}) {
    test.write("study.toml", text);
    const Drawing drawing(test, "compare study.toml --no-stick --no-report --json");
    const json models = drawing.answer()["models"];
    CHECK(models.size() >= 7);
    int curve = 0;
    for (const std::string name :
         {"bem", "gw_moments", "gw_deterministic", "gw_monte_carlo", "gw_interacting", "persson",
          "greenwood_tripp", "gw_dmt", "gw_jkr"}) {
      if (!models.contains(name)) continue;
      const json& model = models[name];
      std::string title = model["title"];
      INFO(title);
      for (std::size_t at = 0; (at = title.find('\'', at)) != title.npos; at += 2)
        title.insert(at, 1, '\'');
      CHECK_THAT(drawing.script(), Contains("title '" + title + "'"));
      // The curve below the title is that of the model: its gaps fall alike.
      const Values gap = numbers(model["curve"]["mean_gap"]["mean"]),
                   found = drawing.column(1, curve++, 1);
      CHECK((found[4] - found[0]) * (gap[1] - gap[0]) ==
            Approx((found[1] - found[0]) * (gap[4] - gap[0])).epsilon(0.2).margin(1e-12));
    }
  }
}

namespace {

struct TextBox {
  std::string text;
  double left, right, bottom, top;  ///< y grows downwards in a file: bottom > top
  bool to_the_right;                ///< its left end is where it is placed
};

/// Texts of a picture that run from left to right, each with the place that it takes at least: half
/// an em for each character.
std::vector<TextBox> texts_of(const std::string& svg) {
  static const std::regex pattern(
      "translate\\(([-0-9.]+),([-0-9.]+)\\)\" "
      "stroke[^>]*font-size=\"([0-9.]+)\"[^>]*text-anchor=\"(\\w+)\">\\s*<text>(.*?)</text>");
  std::vector<TextBox> boxes;
  for (std::sregex_iterator at(svg.begin(), svg.end(), pattern), end; at != end; ++at) {
    const std::string text = std::regex_replace((*at)[5].str(), std::regex("<[^>]*>"), "");
    const double x = std::stod((*at)[1]), y = std::stod((*at)[2]);
    if (text.empty()) continue;  // of a tic without a number
    const double font = std::stod((*at)[3]);
    const double width = font / 2 * double(std::ranges::count_if(text, [](char c) {
                           return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
                         }));
    const double left = (*at)[4] == "start" ? x : (*at)[4] == "end" ? x - width : x - width / 2;
    boxes.push_back(
        {text, left, left + width, y + font / 12, y - 0.75 * font, (*at)[4] == "start"});
  }
  return boxes;
}

/// Points along all curves and bands of a picture, a pixel or two apart; legends' samples too.
std::vector<std::pair<double, double>> curves_of(const std::string& svg) {
  std::vector<std::pair<double, double>> points;
  static const std::regex number("([ML]?)([-0-9.]+),([-0-9.]+)");
  for (auto at = svg.find("<g id=\"gnuplot_plot_"); at != svg.npos;) {
    const auto next = svg.find("<g id=\"gnuplot_plot_", at + 1);
    const std::string group = svg.substr(at, std::min(next, svg.find("</g>\n\t</g>", at)) - at);
    at = next;
    for (const std::string attribute : {" d='", "points = '"})
      for (auto path = group.find(attribute); path != group.npos;
           path = group.find(attribute, path + 1)) {
        const auto start = path + attribute.size();
        const std::string list = group.substr(start, group.find('\'', start) - start);
        double x0 = 0, y0 = 0;
        bool begun = false;
        for (std::sregex_iterator one(list.begin(), list.end(), number), end; one != end; ++one) {
          const double x = std::stod((*one)[2]), y = std::stod((*one)[3]);
          const int steps = begun && (*one)[1] != "M" ? 1 + int(std::hypot(x - x0, y - y0)) : 0;
          for (int i = 1; i <= steps; ++i)
            points.emplace_back(x0 + (x - x0) * i / steps, y0 + (y - y0) * i / steps);
          x0 = x, y0 = y, begun = true;
        }
      }
  }
  return points;
}

/// No text of a picture may lie on a curve, on another text or across the border. on_curves: texts
/// that interrupt a curve, the values of contour lines.
void check_texts(const std::string& svg, const std::set<std::string>& on_curves = {}) {
  const auto texts = texts_of(svg);
  const double width = std::stod(svg.substr(svg.find("width=\"") + 7));
  const auto curves = curves_of(svg);
  REQUIRE(texts.size() > 5);
  REQUIRE((curves.size() > 50 || Contains("<image").match(svg)));  // a map has no curves
  for (const TextBox& one : texts) {
    CAPTURE(one.text);
    CHECK(one.top > 0);
    // Some texts have wide characters: a tenth of the width beyond the half em of each.
    const double more = (one.right - one.left) / 20;
    CHECK(one.left - (one.to_the_right ? 0 : more) > 0);
    CHECK(one.right + more < width);
    CHECK((on_curves.contains(one.text) || std::ranges::none_of(curves, [&](const auto& point) {
             const auto [x, y] = point;
             return x > one.left && x < one.right && y > one.top && y < one.bottom;
           })));
    for (const TextBox& other : texts) {
      if (&one == &other) continue;
      CAPTURE(other.text);
      CHECK_FALSE((one.left < other.right && other.left < one.right && one.top < other.bottom &&
                   other.top < one.bottom));
    }
  }
}

/// The commands of docs/figures.md, with fewer points, steps and values, and their input files.
std::vector<std::string> commands_of_page(const ProgramTest& test) {
  std::ostringstream text;
  text << std::ifstream(std::filesystem::path(SALEBRA_README).parent_path() / "docs/figures.md")
              .rdbuf();
  std::string page = text.str();
  static const std::regex input("\n```toml\n# (\\S+)\n([^`]*)```");
  for (std::sregex_iterator at(page.begin(), page.end(), input), end; at != end; ++at)
    test.write((*at)[1].str(), (*at)[2].str());
  page = std::regex_replace(page, std::regex("\\\\\n"), " ");
  std::vector<std::string> commands;
  static const std::regex command("\nsalebra (.*?)( --plot \\S+)?\n"),
      count("(--points|--map-phases|--map-radii|--steps|--intervals) [0-9]+"),
      values("(:[^ :]+):[0-9]+");
  for (std::sregex_iterator at(page.begin(), page.end(), command), end; at != end; ++at)
    commands.push_back(
        std::regex_replace(std::regex_replace((*at)[1].str(), count, "$1 32"), values, "$1:4"));
  return commands;
}

}  // namespace

TEST_CASE("No text of a picture of a study lies on a curve or on another text", "[study][plot]") {
  const ProgramTest test;
  const std::string scan =
      "study --no-report --no-stick --surface " +
      (std::filesystem::path(SALEBRA_README).parent_path() / "data/surfaces/afm-scan.txt")
          .string() +
      " --contact-modulus 115GPa --poisson 0.3 --friction-coefficient 0.3 --intervals 0 "
      "--normal-amplitude 1nm --drag-velocity 1um/s --excursion 1nm --frequency 20kHz --pressures ";
  test.write("study.toml", study_text("seeds = [1, 2, 3]"));
  test.write("adhesive.toml", adhesive_study_text());
  for (const std::string& command :
       {scan + "100:300MPa:4", scan + "100:300MPa:5", scan + "11MPa:4.4GPa:10",
        std::string("compare study.toml --no-report --no-stick --models gw_moments,persson"),
        std::string("compare study.toml --no-report --no-stick"),
        std::string("compare adhesive.toml --no-report --no-stick")}) {
    CAPTURE(command);
    test.done(command + " --plot a.svg --overwrite");
    check_texts(test.read("a.svg"));
  }
}

TEST_CASE("Texts of the pictures of the documentation keep apart at the widths of journals",
          "[plot]") {
  const ProgramTest test;  // later commands read the files of earlier ones
  const std::vector<std::string> commands = commands_of_page(test);
  REQUIRE(commands.size() >= 10);
  for (const std::string& command : commands) {
    CAPTURE(command);
    test.done(command + " --quiet --overwrite --plot a.json");
    std::set<std::string> contours;
    const json figure = json::parse(test.read("a.json"));
    for (const json& panel : figure["panels"])
      if (panel.contains("image"))
        for (const double value : panel["image"]["contours"])
          contours.insert(fmt::format("{:g}", value));
    for (const auto& [width, pixels] : {std::pair("85mm", 321), {"170mm", 643}}) {
      CAPTURE(width);
      test.done(command + " --quiet --overwrite --plot a.svg --figure-width " + width);
      const std::string svg = test.read("a.svg");
      // 96 pixels to an inch.
      CHECK_THAT(svg, Contains(fmt::format("width=\"{}\"", pixels)));
      check_texts(svg, contours);
    }
  }
}

namespace {

/// The member of an object, at any depth, that has this name.
const json* member_of(const json& object, const std::string& name) {
  if (!object.is_object()) return nullptr;
  if (object.contains(name)) return &object[name];
  for (const json& inner : object)
    if (const json* found = member_of(inner, name)) return found;
  return nullptr;
}

/// The curves of a figure whose y is this quantity.
std::vector<json> curves_with(const json& figure, const std::string& quantity) {
  std::vector<json> found;
  for (const json& panel : figure["panels"])
    for (const json& curve : panel["curves"]) {
      const std::string own = curve["quantity"];
      if ((own.empty() ? panel["y"]["quantity"].get<std::string>() : own) == quantity)
        found.push_back(curve);
    }
  return found;
}

}  // namespace

TEST_CASE("The numbers of every picture are those of the answer of its command", "[plot]") {
  const ProgramTest test;
  test.write("study.toml", study_text("seeds = [3]"));
  test.done(
      "generate --points 64 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um "
      "--rms-height "
      "10nm -o rough.h5");
  test.done(
      "contact rough.h5 --pressure 2:60MPa:10 --stiffness -o curve.h5 --contact-modulus 10GPa "
      "--poisson 0.3");
  const std::string body = " --contact-modulus 10GPa --poisson 0.3 ",
                    law = " --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 ",
                    drag = " --drag-velocity 1mm/s --frequency 20kHz ";
  struct Drawn {
    std::string command;
    std::vector<std::string> quantities;
    /// The error of a quantity, in the answer; empty: none is drawn.
    std::string error = "";
  };
  for (const auto& [command, quantities, error] :
       {Drawn{"contact rough.h5 --pressure 2:60MPa:10 --stiffness" + body,
              {"pressure", "contact_area_fraction", "normal_stiffness", "tangential_stiffness"}},
        Drawn{"damping --normal-amplitude 1:50nm:4" + law + drag,
              {"work_per_cycle", "small_amplitude_work", "damping_constant"}},
        Drawn{"damping --normal-amplitude 1:50nm:4 --friction-coefficient 0.3 --excursion 1um" +
                  law + drag,
              {"work_per_cycle", "damping_constant", "damping_constant_without_slip"}},
        Drawn{"damping --curve curve.h5 --normal-force 0.1mN --poisson 0.3 --normal-amplitude "
              "0.1:1nm:4" +
                  drag,
              {"work_per_cycle", "damping_constant"},
              "damping_constant"},
        Drawn{"joint --friction-coefficient 0.3 --tangential-amplitudes 1:10nm:4" + law,
              {"work_per_cycle"}},
        Drawn{"sliding --friction-coefficient 0.3 --normal-amplitude 10nm --frequency 20kHz "
              "--velocities 1um/s,10um/s,1mm/s" +
                  law,
              {"friction_coefficient", "relaxation_work"}},
        Drawn{"viscoelastic --law paraboloid --radius 5mm --indentation 20um --prony "
              "1MPa:1ms,2MPa:20ms --normal-amplitude 2um --drag-velocity 1um/s --frequency 10,100 "
              "--steps 64" +
                  body,
              {"relaxation_work", "elastic_work", "storage_modulus", "loss_modulus"}},
        // Over the force a joint that slides would be a vertical line.
        Drawn{"joint --friction-coefficient 0.3 --tangential-amplitudes 10nm:10um:5" + law,
              {"work_per_cycle"}},
        Drawn{"damping --normal-amplitude 1:50nm:4 --frequency 20kHz" + law, {"damping_constant"}},
        Drawn{"fit curve.h5", {"local_decay_length"}},
        Drawn{"statistics rough.h5 --all", {"height_density"}}}) {
    CAPTURE(command);
    const json answer = test.answer(command + " --json --plot f.json --overwrite");
    const json figure = json::parse(test.read("f.json"));
    CHECK_FALSE(figure["kind"].get<std::string>().empty());
    CHECK_FALSE(figure["caption"].get<std::string>().empty());
    for (const std::string& quantity : quantities) {
      CAPTURE(quantity);
      const json* table = member_of(answer, quantity);
      REQUIRE(table);
      const auto curves = curves_with(figure, quantity);
      REQUIRE_FALSE(curves.empty());
      // Both come from the same numbers, and both are written with all digits.
      CHECK(std::ranges::any_of(curves, [&](const json& curve) { return curve["y"] == *table; }));
      if (quantity != error) continue;
      const json* errors = member_of(answer, quantity + "_error");
      REQUIRE(errors);
      const json& curve = curves.front();
      for (std::size_t k = 0; k < table->size(); ++k) {
        const double value = (*table)[k], bar = (*errors)[k];
        CHECK(curve["high"][k].get<double>() - value == Approx(bar).epsilon(1e-6));
        CHECK(value - curve["low"][k].get<double>() == Approx(bar).epsilon(1e-6));
      }
    }
    for (const json& panel : figure["panels"])
      for (const json& line : panel["lines"]) CHECK_FALSE(line["name"].get<std::string>().empty());
  }
}

TEST_CASE("The map of sliding and the work of an oscillation are those of the answer", "[plot]") {
  const ProgramTest test;
  const json sliding = test.answer(
      "sliding --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--friction-coefficient 0.3 --normal-amplitude 1:50nm:4 --frequency 20kHz --velocities "
      "1um/s:1mm/s:3 --json --plot f.json");
  const auto map_of_figure = [&] {
    return json::parse(test.read("f.json"))["panels"][0]["image"]["values"];
  };
  json map = map_of_figure();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      CHECK(map[i][j] == sliding["friction_coefficient"][3 * j + i]);

  const json regimes = test.answer(
      "sliding --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
      "--friction-coefficient 0.3 --normal-amplitude 10nm --frequency 20kHz --velocities "
      "1nm/s:10um/s:3 --excursions 1nm:1um:4 --json --plot f.json --overwrite")["regime_map"];
  map = map_of_figure();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) CHECK(map[i][j] == regimes["loss_ratio"][4 * i + j]);

  const std::string cone =
      "damping --law cone --angle 10deg --indentation 1um --contact-modulus 1GPa --poisson 0.3 "
      "--mode equal-frequency --normal-amplitude 10nm --tangential-amplitude 10nm --phase 90deg "
      "--overwrite --plot f.json ";
  test.done(cone + "--steps 200 --friction-numbers 0.1:100:4 --friction-map map.h5");
  const auto check_map = [&](const std::string& dataset, bool by_column) {
    const Values values = salebra::ResultReader(test.folder() / "map.h5").numbers(dataset);
    map = map_of_figure();
    const std::size_t rows = map.size(), columns = map[0].size();
    REQUIRE(values.size() == rows * columns);
    std::size_t known = 0;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) {
        if (map[i][j].is_null()) continue;
        ++known;
        CHECK(map[i][j] == values[by_column ? j * rows + i : i * columns + j]);
      }
    CHECK(known > values.size() / 2);
  };
  check_map("friction_map/loss_ratio", false);
  // The figure has the radius along x, the file the phase first.
  test.done(cone + "--map-phases 16 --map-radii 20 --stress-map map.h5");
  check_map("stress_map/shear", true);

  test.done(
      "generate --points 64 --size-x 8um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um "
      "--rms-height 10nm -o rough.h5");
  test.write("scans.toml", "[[measurement]]\nfile = \"rough.h5\"\ninstrument = \"ideal\"\n");
  test.done("twin scans.toml -o twin.h5 --plot f.json --overwrite");
  const salebra::ResultReader twin(test.folder() / "twin.h5");
  const json curve = json::parse(test.read("f.json"))["panels"][0]["curves"][0];
  for (const auto& [name, dataset] :
       {std::pair("x", "wavenumber"), {"y", "psd"}, {"low", "psd_low"}, {"high", "psd_high"}})
    check_alike(numbers(curve[name]), twin.numbers(std::string("twin/spectrum/") + dataset), 0);

  const json cycle = test.answer(
      "oscillate --shape paraboloid --contact-modulus 1GPa --poisson 0.3 --points 32 --steps 16 "
      "--json --plot f.json --overwrite");
  const json figure = json::parse(test.read("f.json"));
  const json& work = figure["panels"][1];
  check_alike(numbers(work["curves"][0]["x"]), numbers(cycle["time_in_periods"]));
  // In units of the loss of Eq. (12).
  for (std::size_t k = 0; k < cycle["work"].size(); ++k)
    CHECK(work["curves"][0]["y"][k].get<double>() * cycle["small_amplitude_work"].get<double>() ==
          Approx(cycle["work"][k].get<double>()).epsilon(1e-12).margin(1e-20));
  CHECK_THAT(figure["caption"].get<std::string>(),
             Contains("Motion: 6 µm tangential and 6 µm normal, 90° apart, mean") &&
                 Contains("free boundary; no slip"));
}

TEST_CASE("A series of factors is along a logarithmic axis", "[plot]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--drag-velocity 1mm/s --frequency 20kHz ";
  test.done(law + "--normal-amplitude 1:8nm:4 --plot f.json");
  CHECK(json::parse(test.read("f.json"))["panels"][0]["x"]["logarithmic"] == true);
  test.done(law + "--normal-amplitude 1nm,2nm,3nm,4nm --plot f.json --overwrite");
  CHECK(json::parse(test.read("f.json"))["panels"][0]["x"]["logarithmic"] == false);
}

TEST_CASE("A --plot without a name names the picture as its input", "[plot]") {
  const ProgramTest test;
  test.write(
      "scan.txt",
      "# Width: 4 um\n# Height: 4 um\n# Value units: nm\n1 2 1 3\n1 4 1 1\n2 1 1 1\n1 3 1 2\n");
  test.done("statistics scan.txt --plot");
  CHECK(test.read("scan.png").substr(1, 3) == "PNG");
  check_refused(test.run("statistics scan.txt --plot"), "--overwrite");
  test.done("statistics scan.txt --plot --overwrite");
  test.done("statistics --plot other.svg scan.txt");
  CHECK_THAT(test.read("other.svg"), Contains("</svg>"));
  check_refused(test.run("statistics --plot scan.txt"), "scan.txt");
  const std::string law =
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--drag-velocity 1mm/s --frequency 20kHz --normal-amplitude 1:50nm:6 ";
  test.done(law + "--plot");
  CHECK(test.read("damping.png").substr(1, 3) == "PNG");
  check_refused(test.run(law + "--figure-width 85mm"), "needs a picture");
  check_refused(test.run(law + "--figure-width 85mm --plot a.json"), "needs a picture");
  check_refused(test.run(law + "--figure-width 5mm --plot a.png"), "from 60 mm to 1 m");
  check_refused(test.run(law + "--figure-width wide --plot a.png"), "--figure-width");
}

TEST_CASE("The numbers of a comparison are those of its file, and the theories' of their formulas",
          "[compare]") {
  const ProgramTest test;
  test.write("study.toml", study_text("seeds = [3]"));
  const auto run = test.run("compare study.toml --no-stick --no-report --json -o result.h5");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const json answer = run.json();
  const salebra::ResultReader file(test.folder() / "result.h5");
  const Values pressure = file.numbers("curve/pressure");
  const std::size_t loads = pressure.size();
  REQUIRE(loads == 10);
  CHECK(numbers(answer["pressure"]) == pressure);
  // The study gives it in E*h' of the spectrum.
  CHECK(answer["relative_pressure"][0] == Approx(1e-3).epsilon(1e-12));
  CHECK(answer["relative_pressure"][9] == Approx(0.2).epsilon(1e-12));
  std::size_t row = 0;
  for (const std::string model :
       {"bem", "gw_moments", "gw_deterministic", "gw_monte_carlo", "gw_interacting", "persson"}) {
    INFO(model);
    const json& found = answer["models"][model];
    for (const std::string name : {"mean_gap", "separation", "force", "contact_area_fraction",
                                   "normal_stiffness", "tangential_stiffness"}) {
      INFO(name);
      check_alike(numbers(found["curve"][name]["mean"]),
                  row_of(file, "curve/ensemble_" + name + "_mean", row, loads), 1e-14);
    }
    for (const auto& [constant, work] :
         {std::pair<std::string, std::string>{"damping_constant_closed_form",
                                              "work_per_cycle_closed_form"},
          {"small_amplitude_damping_constant", "small_amplitude_work"},
          {"damping_constant", "work_per_cycle"}}) {
      INFO(constant);
      check_alike(numbers(found["damping"][constant]["mean"]),
                  row_of(file, "damping/ensemble_" + constant + "_mean", row, loads), 1e-14);
      check_alike(numbers(found["over_bem"][work]["mean"]),
                  row_of(file, "comparison/" + work + "_mean", row, loads), 1e-14);
    }
    for (const std::string name : {"mean_gap", "contact_area_fraction", "normal_stiffness"})
      check_alike(numbers(found["over_bem"][name]["mean"]),
                  row_of(file, "comparison/" + name + "_mean", row, loads), 1e-14);
    const auto single = [&](const char* dataset) { return file.numbers(dataset)[row]; };
    CHECK(found["decay_length"]["mean"] == single("fit/ensemble_decay_length_mean"));
    CHECK(found["area_slope"]["mean"] == single("fit/ensemble_area_slope_mean"));
    CHECK(
        found["law_bend"]["mean"] ==
        Approx(single("fit/decay_length_at_max_gap") / single("fit/decay_length_at_min_gap") - 1));
    ++row;
  }
  for (const std::string name :
       {"spot_count", "max_spot_area", "mean_spot_area", "corrected_area_fraction"})
    check_alike(numbers(answer["spots"][name]["mean"]),
                file.numbers("spots/ensemble_" + name + "_mean"), 1e-14);

  const double rms_height = file.numbers("surface/rms_height").front();
  const Values gap = row_of(file, "curve/mean_gap", 0, loads);
  const json& simple = answer["theories"]["campana_persson_muser"];
  const double length = simple["decay_length_over_rms_height"]["mean"].get<double>() * rms_height;
  for (std::size_t k = 0; k < loads; ++k) {
    // Share of a Gaussian surface above the plane at the mean gap; K = F/u0.
    CHECK(answer["theories"]["bearing_area_fraction"]["mean"][k] ==
          Approx(std::erfc(gap[k] / (std::numbers::sqrt2 * rms_height)) / 2).epsilon(1e-12));
    CHECK(simple["normal_stiffness"]["mean"][k] ==
          Approx(pressure[k] * 16e-12 / length).epsilon(1e-12));
  }

  // Words: percentages, with half the width of the interval beside them.
  test.write("study.toml", study_text("seeds = [3, 4]"));
  const auto words = test.run("compare study.toml --no-stick --models persson");
  const json two = test.answer("compare study.toml --no-stick --models persson --json");
  REQUIRE(words.status == 0);
  const auto table = words.out.find("Boundary elements at some loads");
  REQUIRE(table != std::string::npos);
  const auto row_begin =
      words.out.find_first_of("0123456789", words.out.find("largest/all", table));
  REQUIRE(row_begin != std::string::npos);
  std::istringstream rows(words.out.substr(row_begin));
  const Values relative = numbers(two["relative_pressure"]);
  const json& fraction = two["models"]["bem"]["curve"]["contact_area_fraction"];
  int shown = 0;
  for (std::string row; std::getline(rows, row) && !row.empty(); ++shown) {
    INFO(row);
    std::istringstream columns(row);
    double load = 0, gap_mean = 0, gap_error = 0, area = 0, area_error = 0, corrected = 0;
    std::string plus_minus;
    REQUIRE(columns >> load >> gap_mean >> plus_minus >> gap_error >> area >> plus_minus >>
            area_error >> corrected);
    std::size_t k = 0;
    while (k < loads && std::abs(relative[k] / load - 1) > 0.05) ++k;
    REQUIRE(k < loads);
    const auto at_load = [k](const json& list) { return list[k].get<double>(); };
    // Three digits of a value, two of an error.
    CHECK(area == Approx(100 * at_load(fraction["mean"])).epsilon(6e-3));
    CHECK(area_error == Approx(50 * (at_load(fraction["high"]) - at_load(fraction["low"])))
                            .epsilon(6e-2)
                            .margin(1e-9));
    CHECK(corrected ==
          Approx(100 * at_load(two["spots"]["corrected_area_fraction"]["mean"])).epsilon(6e-3));
  }
  CHECK(shown >= 4);
}

TEST_CASE("Pictures of a contact and of its curve draw the numbers of the answers",
          "[contact][plot]") {
  const ProgramTest test;
  test.done(
      "generate --points 32 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 250nm "
      "--rms-height 10nm -o s.h5");
  const std::string material = " --contact-modulus 1GPa --poisson 0.3 --json";
  const Drawing press(test, "contact s.h5 --pressure 10MPa" + material);
  double largest = 0;
  for (const Values& row : press.image(1))
    for (const double value : row) largest = std::max(largest, value);
  // The map has five digits, in MPa.
  CHECK(largest == Approx(1e-6 * press.answer()["max_pressure"].get<double>()).epsilon(1e-4));

  const Drawing sweep(test, "contact s.h5 --pressure 1:30MPa:6 --stiffness -o curve.h5" + material);
  const json curve = sweep.answer()["curve"];
  check_parallel(sweep.column(1, 0, 1), logarithms(numbers(curve["pressure"])));
  check_parallel(sweep.column(2, 0, 1), logarithms(numbers(curve["contact_area_fraction"])));
  check_parallel(sweep.column(3, 1, 1), logarithms(numbers(curve["tangential_stiffness"])));

  // The dashed line falls by one power of e in a decay length, in nm.
  const Drawing fit(test, "fit curve.h5 --json");
  const Values gap = fit.column(1, 1, 0), pressure = fit.column(1, 1, 1);
  REQUIRE(gap.size() == 2);
  CHECK((gap[1] - gap[0]) / (std::log(10) * (pressure[0] - pressure[1])) ==
        Approx(1e9 * fit.answer()["decay_length"].get<double>()).epsilon(1e-6));

  CHECK_THAT(fit.script(), Contains("title 'boundary elements'"));
  test.write("mine.csv",
             "# model: my bench_1\nmean_gap [m],pressure "
             "[Pa]\n3.0e-8,1.0e6\n2.0e-8,3.0e6\n1.0e-8,9.0e6\n0.0,27.0e6\n");
  const Drawing measured(test, "fit mine.csv --json --pressure-window 1MPa,27MPa");
  CHECK_THAT(measured.script(), Contains("title 'my bench\\_1'"));

  test.write("study.toml", study_text("seeds = [3]"));
  const Drawing study(test, "study study.toml --no-stick --no-report --json");
  CHECK_THAT(study.script(), Contains("damping constant"));
}

TEST_CASE("A picture of damping draws how far the small-amplitude form is off", "[damping][plot]") {
  const ProgramTest test;
  const Drawing drawing(
      test,
      "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 --json "
      "--normal-amplitude 10nm,50nm,90nm --drag-velocity 1mm/s --frequency 20kHz");
  const json answer = drawing.answer();
  const Values work = numbers(answer["work_per_cycle"]),
               small = numbers(answer["small_amplitude_work"]);
  Values deviation;
  for (std::size_t k = 0; k < 3; ++k) deviation.push_back(100 * (small[k] / work[k] - 1));
  check_alike(drawing.column(3, 0, 1), deviation, 1e-6);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(drawing.column(1, 1, 1)[k] / drawing.column(1, 0, 1)[k] ==
          Approx(small[k] / work[k]).epsilon(1e-7));
}

TEST_CASE("A picture of a damper shows its map over frequency, and how it decays",
          "[damper][plot]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 --json ";
  const Drawing map(test, law + "--normal-amplitude 1:50nm:4 --frequency 1:100kHz:3");
  const json gamma = map.answer()["damping_constant"];  // (amplitude, frequency)
  const auto image = map.image(1);
  REQUIRE(image.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    REQUIRE(image[i].size() == 3);
    for (std::size_t j = 0; j < 3; ++j)
      // Five digits.
      CHECK(image[i][j] - image[0][0] ==
            Approx(std::log10(gamma[i][j].get<double>() / gamma[0][0].get<double>())).margin(2e-4));
  }
  // Released at rest from x0, below and beyond critical damping, γ = 2√(km) with k of the contact.
  const std::string oscillator = law + "--normal-amplitude 20nm --frequency 20kHz --mass ";
  const json one = test.answer(oscillator + "1g");
  const double constant = one["damping_constant"],
               stiffness = 1e-3 * std::pow(one["decay"]["natural_frequency"].get<double>(), 2);
  for (const double ratio : {0.1, 2.0}) {
    INFO(ratio);
    const double mass = std::pow(constant / (2 * ratio), 2) / stiffness;
    const Drawing decay(test, oscillator + std::to_string(1e9 * mass) + "ug");
    CHECK(decay.answer()["decay"]["damping_ratio"] == Approx(ratio).epsilon(1e-3));
    const Values x = decay.column(1, 0, 1);
    CHECK(x[0] == Approx(1).epsilon(1e-9));
    // ẋ = 0: the first of 4000 steps loses a quarter of what the first two lose, but for the third
    // order.
    CHECK((1 - x[1]) / (1 - x[2]) == Approx(0.25).margin(0.05));
  }
}

TEST_CASE("A picture of a cycle counts the energy lost over one period", "[damping][plot]") {
  const ProgramTest test;
  const Drawing drawing(
      test,
      "damping --law cone --angle 0.1 --indentation 1um --contact-modulus 1GPa --poisson 0.3 "
      "--friction-coefficient 0.5 --mode equal-frequency --normal-amplitude 500nm "
      "--tangential-amplitude 200nm --phase 60deg --frequency 300Hz --json");
  const Values time = drawing.column(3, 0, 0), lost = drawing.column(3, 0, 1);
  CHECK(time.front() == Approx(0).margin(1e-12));
  CHECK(time.back() == Approx(1).epsilon(1e-7));
  const double work = drawing.answer()["work_per_cycle"], prefix = std::log10(lost.back() / work);
  CHECK(prefix == Approx(std::round(prefix)).margin(1e-6));
}

TEST_CASE("The tips of a loop of a joint are the numbers of its table", "[joint][plot]") {
  const ProgramTest test;
  const std::string law =
      "joint --law paraboloid --radius 10mm --normal-force 10 --contact-modulus 115GPa --poisson "
      "0.3 "
      "--friction-coefficient 0.3 --json --steps 400 ";
  struct Motion {
    std::string options;
    bool symmetric;
  };
  // Beside a normal oscillation T of a given x has its largest values where F is not the same, and so
  // has x of a given T: then the table holds half the range.
  for (const auto& [options, symmetric] :
       {Motion{"--tangential-forces 20mN,200mN,2.9N", true},
        Motion{"--tangential-forces 200mN", true},
        Motion{"--tangential-amplitudes 1nm,5nm,20nm", true},
        Motion{"--tangential-forces 0.1,0.5 --normal-amplitude 20nm --phase 50deg", false},
        Motion{"--tangential-amplitudes 1nm,20nm --normal-amplitude 20nm --phase 50deg", false}}) {
    CAPTURE(options);
    const Drawing drawing(test, law + options);
    for (const bool force : {false, true}) {
      CAPTURE(force);
      const Values drawn = drawing.column(2, 0, force ? 1 : 0);
      const auto [low, high] = std::ranges::minmax(drawn);
      const Values all =
          numbers(drawing.answer()[force ? "tangential_force" : "tangential_amplitude"]);
      const double expected = std::ranges::max(all);
      // The axis has a prefix: a power of 1000.
      const double prefix = std::log10((high - low) / 2 / expected) / 3;
      CHECK(prefix == Approx(std::round(prefix)).margin(1e-6));
      // Springs are followed in steps, and 400 of them meet both ends of the motion.
      if (symmetric) CHECK(high == Approx(-low).epsilon(1e-6));
      CHECK(drawn.back() == Approx(drawn.front()).margin(1e-6 * high));
    }
  }
}

TEST_CASE("A surface with a lay is drawn the same by all commands", "[statistics][plot]") {
  const ProgramTest test;
  test.done(
      "generate --points=128 --size-x 40um --hurst 0.8 --rolloff 10um --short-cutoff 1um "
      "--rms-height 100nm --lay-angle 20deg --stretch-along 5 --seed 2 -o ground.h5 --plot a.json");
  test.done("statistics ground.h5 --plot b.json");
  test.done("statistics ground.h5 --plot b.svg");
  const json generated = json::parse(test.read("a.json"))["panels"],
             read = json::parse(test.read("b.json"))["panels"];
  CHECK_THAT(generated[0]["title"].get<std::string>(), Contains("lay at 1"));
  CHECK(read[0]["title"] == generated[0]["title"]);
  for (const std::size_t along : {0u, 2u})
    CHECK(read[1]["curves"][along]["y"].size() == generated[1]["curves"][along]["y"].size());
}

TEST_CASE("The headline of an oscillation with friction is the loss with slip",
          "[oscillate][plot]") {
  const ProgramTest test;
  const json answer = test.answer(
      "oscillate --shape paraboloid,sinusoids --contact-modulus 1GPa --poisson 0.3 --friction 0.3 "
      "--points 32 --steps 16 --plot f.json");
  const json figure = json::parse(test.read("f.json"));
  int k = 2;
  for (const std::string shape : {"paraboloid", "sinusoids"}) {
    const json panel = figure["panels"][k++];
    const double work = answer[shape]["friction"]["work_per_cycle"];
    CHECK_THAT(
        panel["title"].get<std::string>(),
        Contains(fmt::format("W = {:.3g} µJ with slip", 1e6 * work)) && Contains("(not valid: "));
    CHECK(panel["curves"][1]["y"].back() ==
          Approx(work / answer[shape]["small_amplitude_work"].get<double>()).epsilon(1e-5));
  }
  CHECK_THAT(figure["caption"].get<std::string>(),
             Contains("paraboloid, 6 µm") && Contains("sinusoids, 1.35 µm"));
}

TEST_CASE("A flat surface is drawn without a spectrum, by every command alike",
          "[statistics][plot]") {
  const ProgramTest test;
  test.write(
      "flat.txt",
      "# Width: 4 um\n# Height: 4 um\n# Value units: nm\n1 1 1 1\n1 1 1 1\n1 1 1 1\n1 1 1 1\n");
  for (const std::string command : {"statistics flat.txt", "convert flat.txt o.h5"}) {
    INFO(command);
    const Drawing drawing(test, command);
    CHECK_THAT(drawing.script(),
               Contains("'rms height 0 m'") && !Contains("power spectral density"));
  }
}

TEST_CASE("Pictures of damping name what they show", "[damping][plot]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--drag-velocity 1mm/s --frequency 20kHz --json ";
  test.done(law + "--normal-amplitude 1:50nm:6 --plot curve.svg");
  const std::string curve = test.read("curve.svg");
  CHECK_THAT(curve, Contains("normal amplitude "));
  CHECK_THAT(curve, Contains("closed form"));
  test.done(law + "--normal-amplitude 50nm --plot cycle.png");
  CHECK(test.read("cycle.png").substr(1, 3) == "PNG");
  check_refused(test.run(law + "--normal-amplitude 50nm --plot cycle.png"), "--overwrite");
  // Without gnuplot there is one line, status 1, and no answer is lost for a picture that was not
  // asked for.
  const auto without = test.run(law + "--normal-amplitude 50nm --plot new.png", "PATH=/nowhere;");
  CHECK(without.status == 1);
  CHECK_THAT(without.err, Contains("salebra: error: new.png: gnuplot is not installed"));
  CHECK(std::count(without.err.begin(), without.err.end(), '\n') == 1);
  CHECK(without.out.empty());
  test.done(law + "--normal-amplitude 50nm", "PATH=/nowhere;");
  // A headline says what the answer says of its validity.
  const std::string slow = std::regex_replace(law, std::regex("1mm/s"), "1um/s");
  for (const std::string excursion : {"10nm", "1mm"}) {
    const json answer = json::parse(
        test.done(slow +
                  "--normal-amplitude 1:50nm:6 --friction-coefficient 0.3 --plot v.json "
                  "--overwrite --excursion " +
                  excursion)
            .out);
    const std::string title = json::parse(test.read("v.json"))["panels"][1]["title"];
    CAPTURE(title, answer["validity"].dump());
    CHECK((title.find("not valid") != title.npos) == (answer["validity"] == "not valid"));
    CHECK((answer["validity"] == "not valid") == (excursion == "1mm"));
    CHECK_THAT(title, Contains("(b) γ = "));
  }
  std::filesystem::remove(test.folder() / "v.json");
  CHECK(test.files() == "curve.svg cycle.png");
}

TEST_CASE("A picture is drawn where it was asked for, and its name never runs as a command",
          "[plot]") {
  const ProgramTest test;
  // gnuplot starts a name that begins with '|' as a command; quotes would end the name.
  const std::string folder = "|touch PWNED;'\"`touch PWNED`";
  std::filesystem::create_directory(test.folder() / folder);
  const std::string quoted = "\"|touch PWNED;'\\\"\\`touch PWNED\\`/x.png\"";
  test.done(
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--drag-velocity 1mm/s --frequency 20kHz --normal-amplitude 50nm --plot " +
      quoted);
  CHECK(test.read(folder + "/x.png").substr(1, 3) == "PNG");
  CHECK(test.files() == std::set<std::string>{folder});
}
