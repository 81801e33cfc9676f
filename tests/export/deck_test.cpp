// SPDX-License-Identifier: GPL-3.0-or-later
// Decks read back in every unit system, and refusals.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <salebra/base/error.hpp>

#include "decks.hpp"

using namespace salebra;
using namespace salebra::testing;
using Catch::Contains;

namespace {

/// Pressure over clearance of a deck, whatever coordinate its format uses.
std::vector<std::pair<double, double>> table_of(DeckFormat format, const std::string& text) {
  std::vector<std::pair<double, double>> table;
  if (format == DeckFormat::csv)
    for (const auto& row : rows_after(text, "clearance,pressure"))
      table.emplace_back(row[0], row[1]);
  if (format == DeckFormat::json) {
    const auto deck = nlohmann::json::parse(text);
    for (std::size_t i = 0; i < deck["clearance"].size(); ++i)
      table.emplace_back(deck["clearance"][i], deck["laws"]["mean"]["pressure"][i]);
  }
  if (format == DeckFormat::abaqus)
    for (const auto& row : rows_after(text, "PRESSURE-OVERCLOSURE"))
      table.emplace_back(-row[1], row[0]);
  if (format == DeckFormat::calculix) {
    const double zero = rows_after(text, "** mean")[0][0];
    for (const auto& row : rows_after(text, "PRESSURE-OVERCLOSURE"))
      table.emplace_back(zero - row[1], row[0]);
    table.pop_back();  // the row that continues the last slope
  }
  if (format == DeckFormat::code_aster) {
    const std::string distance = text.substr(text.find("DIST_1=") + 7);
    for (const auto& row : rows_after(text, "tabmean"))
      table.emplace_back(std::stod(distance) - row[0], row[1]);
  }
  if (format == DeckFormat::ansys) {
    const std::string apart = text.substr(text.find("surfaces are ") + 13);
    std::istringstream lines(text.substr(text.find("R,101,") + 6));
    std::vector<double> numbers;
    for (std::string line; std::getline(lines, line);) {
      for (char& symbol : line)
        if (symbol == ',' || symbol == '*') symbol = ' ';
      std::istringstream words(line);
      for (std::string word; words >> word;)
        if (word != "RMORE" && word != "SALEBRA_AREA") numbers.push_back(std::stod(word));
    }
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
      table.emplace_back(std::stod(apart) - numbers[i], numbers[i + 1]);
  }
  return table;
}

/// Of the cubic curve, which ends at 0.8 µm with K = 3F/(0.2 µm), and opens 1.5 F/K = 0.1 µm above.
constexpr double farthest = 0.8e-6, opens = 0.9e-6;
double pressure(double clearance) {
  const double share = std::clamp((opens - clearance) / (opens - farthest), 0., 1.);
  const double rest = 1 - std::min(clearance, farthest) / 1e-6;
  return force0 / area0 * rest * rest * rest * std::pow(share, 1.5);
}

std::string refusal(const DeckProblem& problem) {
  try {
    solve(problem);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Every deck of a table is read back as the law at its clearances, in every unit system",
          "[export]") {
  const auto format = GENERATE(DeckFormat::csv, DeckFormat::json, DeckFormat::calculix,
                               DeckFormat::abaqus, DeckFormat::ansys, DeckFormat::code_aster);
  // Length in m, mass in kg and time in s; pressure is mass/(length time²).
  struct System {
    const char* name;
    double length, mass, time;
  };
  const auto [name, length, mass, time] = GENERATE(
      System{"m,kg,s", 1, 1, 1}, System{"mm,t,s", 1e-3, 1e3, 1}, System{"mm,kg,ms", 1e-3, 1, 1e-3});
  INFO(name_of(format) << " " << name);
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.format = format;
  problem.units = parse_unit_system(name);
  problem.rows = 1000;
  const DeckSolution answer = solve(problem);
  auto table = table_of(format, answer.text);
  // A table begins where the surfaces part.
  CHECK(table.front().second == 0);
  CHECK(table.size() == (format == DeckFormat::ansys      ? 19
                         : format == DeckFormat::calculix ? 198
                                                          : 1000));
  // The interpolation of the curve of 200 samples has an error of 1e-8; decks have ten digits of
  // numbers whose differences are clearances.
  const double unit = mass / (length * time * time);
  for (const auto& [clearance, value] : table)
    REQUIRE(value * unit ==
            Approx(pressure(clearance * length)).epsilon(1e-6).margin(1e-9 * pressure(farthest)));
  CHECK(table.front().first * length == Approx(opens).epsilon(1e-6));
  CHECK(table.back().first * length == Approx(0.1e-6).epsilon(1e-6));
  // The table is monotone and convex, and lines between its rows are as accurate as the header
  // says.
  double worst = 0, last_slope = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const double slope =
        (table[i].second - table[i - 1].second) / (table[i - 1].first - table[i].first);
    CHECK(slope > (1 - 1e-6) * last_slope);
    last_slope = slope;
    const double line = (table[i].second + table[i - 1].second) / 2,
                 there = pressure((table[i].first + table[i - 1].first) / 2 * length) / unit;
    worst = std::max(worst, std::abs(line - there) / std::max(there, pressure(farthest) / unit));
  }
  CHECK(worst == Approx(answer.interpolation_error).epsilon(1e-2));
}

TEST_CASE("The rows of every table rise as another program reads them, or there is no deck",
          "[export]") {
  const auto format = GENERATE(DeckFormat::csv, DeckFormat::json, DeckFormat::calculix,
                               DeckFormat::abaqus, DeckFormat::ansys, DeckFormat::code_aster);
  INFO(name_of(format));
  DeckProblem problem;
  problem.format = format;
  problem.contacts = {cubic()};
  problem.units = parse_unit_system("mm,t,s");
  problem.pressure_window = {2e6, 2e6 * (1 + 1e-7)};
  const auto require_rows = [&] {
    const auto table = table_of(format, solve(problem).text);
    for (std::size_t i = 1; i < table.size(); ++i) {
      REQUIRE(table[i].first < table[i - 1].first);
      REQUIRE(table[i].second > table[i - 1].second);
    }
  };
  SECTION("rows that ten digits do not tell apart") {
    problem.rows = 1000;
    require_rows();
  }
  SECTION("more rows than there are numbers between the ends") {
    problem.pressure_window = {2e6, 2e6 * (1 + 1e-14)};
    problem.rows = 100000;
    CHECK_FALSE(refusal(problem).empty());
    // Twenty characters distinguish fewer numbers than a double does.
    const bool few = format == DeckFormat::calculix || format == DeckFormat::abaqus;
    problem.pressure_window->second = 2e6 * (1 + 4e-14);
    problem.rows = 40;
    if (few)
      CHECK_THAT(refusal(problem), Contains("rows: 40 are too many: two have the ") &&
                                       Contains("in all digits that are read; give fewer, or "
                                                "widen `pressure_window`"));
    // The remedy in the message helps.
    problem.rows = 4;
    problem.pressure_window->second = 2e6 * (1 + 1e-10);
    require_rows();
  }
  SECTION("a clearance that is counted from far away") {
    problem.pressure_window.reset();
    problem.contacts.front().clearance_origin += 1e-2;
    require_rows();
    // The last digit of this clearance is 2 mm, so nothing is left of a contact of 1 µm.
    problem.contacts.front().clearance_origin += 1e13;
    CHECK_FALSE(refusal(problem).empty());
  }
}

TEST_CASE("No text of a stranger leaves the comments of a deck", "[export]") {
  const auto format =
      GENERATE(DeckFormat::csv, DeckFormat::json, DeckFormat::calculix, DeckFormat::abaqus,
               DeckFormat::ansys, DeckFormat::code_aster, DeckFormat::moose, DeckFormat::elmer,
               DeckFormat::jenkins, DeckFormat::c_header);
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.format = format;
  problem.friction_coefficient = 0.3;
  if (format == DeckFormat::moose || format == DeckFormat::elmer) {
    problem.conductivity = conductivity;
    problem.contact_modulus = contact_modulus;
  }
  // The part that the other program would run: the deck without its comments.
  const auto commands = [&](const std::string& text) {
    if (format == DeckFormat::json) return nlohmann::json::parse(text)["laws"].dump();
    if (format == DeckFormat::c_header) {
      std::string rest = text;
      for (std::size_t begin; (begin = rest.find("/*")) != std::string::npos;)
        rest.erase(begin, rest.find("*/", begin) + 2 - begin);
      return rest;
    }
    const std::string mark = format == DeckFormat::ansys || format == DeckFormat::elmer       ? "!"
                             : format == DeckFormat::calculix || format == DeckFormat::abaqus ? "**"
                                                                                              : "#";
    std::string rest;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with(mark)) rest += line + "\n";
    return rest;
  };
  const std::string harmless = commands(solve(problem).text);
  for (const std::string& hostile :
       {std::string("a\n*INCLUDE,INPUT=secret.inp\n**"), std::string("a\r\n/SYS,touch x\r\n!"),
        std::string("a\n__import__('os').system('touch x')\n#"), std::string("\n\n1,2\n"),
        std::string("a */ int stranger; /* b"), std::string("a **/ int stranger; /** b */"),
        std::string("a $ /SYS,touch x"), "a\xe2\x80\xa8" + std::string("*b\v*c\f*d\x85*e\0*f", 14),
        std::string(2000, 'a') + "*STEP", std::string(1290, '*') + std::string(60, '/')}) {
    INFO(hostile);
    problem.source = problem.comment = problem.provenance.command_line = hostile;
    const std::string text = solve(problem).text;
    CHECK(commands(text) == harmless);
    if (format == DeckFormat::json) continue;
    CHECK(std::ranges::none_of(text, [](char symbol) {
      return symbol != '\n' && ((symbol >= 0 && symbol < ' ') || symbol == '\x7f');
    }));
    // CalculiX reads characters beyond 1320 as another line, and Ansys characters beyond 640. In
    // the C header, code has lines of more than 80 characters, comments do not.
    std::istringstream lines(text.substr(0, text.find("#define")));
    for (std::string line; std::getline(lines, line);)
      if (format != DeckFormat::csv) CHECK(line.size() <= 170);
    if (format == DeckFormat::ansys) CHECK(text.find('$') == std::string::npos);
  }
}

TEST_CASE("Friction of decks is the stick slope at the position and the slip that it allows",
          "[export]") {
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.friction_coefficient = 0.3;
  problem.units = parse_unit_system("mm,t,s");
  // p = p0/8 at 1 − ū/h = ½, K/A = 3p/(h/2), and K_t = 0.8 K; a stiffness per area of 1 N/mm³ is
  // 1e9 N/m³.
  const double slope = 0.8 * 3 * (force0 / area0 / 8) / 0.5e-6;
  problem.format = DeckFormat::calculix;
  const auto friction = rows_after(solve(problem).text, "*FRICTION");
  REQUIRE(friction.size() == 1);
  CHECK(friction[0][0] == 0.3);
  CHECK(friction[0][1] == Approx(slope * 1e-9).epsilon(1e-6));
  problem.format = DeckFormat::abaqus;
  const std::string text = solve(problem).text;
  const double slip = std::stod(text.substr(text.find("ELASTIC SLIP=") + 13));
  CHECK(slip == Approx(0.3 * force0 / area0 / 8 / slope * 1e3).epsilon(1e-6));
  CHECK(rows_after(text, "*FRICTION")[0][0] == 0.3);
}

TEST_CASE("Friction for MOOSE has the stiffnesses per area at the position", "[export]") {
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.friction_coefficient = 0.3;
  problem.units = parse_unit_system("mm,t,s");
  problem.format = DeckFormat::moose;
  const std::string text = solve(problem).text;
  const auto value = [&](const std::string& name) {
    return std::stod(text.substr(text.find(" " + name + " = ") + name.size() + 4));
  };
  // As in the test above: K/A = 3p/(h/2) at p = p0/8, K_t = 0.8 K, and 1 N/mm³ = 1e9 N/m³.
  const double slope = 3 * (force0 / area0 / 8) / 0.5e-6 * 1e-9;
  CHECK(value("friction_coefficient") == 0.3);
  CHECK(value("penalty") == Approx(slope).epsilon(1e-6));
  CHECK(value("penalty_friction") == Approx(0.8 * slope).epsilon(1e-6));
  const double slip = std::stod(text.substr(text.find("elastic slip ") + 13));
  CHECK(slip == Approx(0.3 * force0 / area0 / 8 * 1e-6 / (0.8 * slope)).epsilon(1e-6));
  CHECK_THAT(text, !Contains("gap_conductance"));
}

TEST_CASE("The conductance over the pressure is that of the stiffness, in every unit system",
          "[export]") {
  const auto format = GENERATE(DeckFormat::csv, DeckFormat::json, DeckFormat::abaqus,
                               DeckFormat::moose, DeckFormat::elmer);
  // The units of pressure, mass/(length time²), and of conductance, mass/(time³ K), in SI.
  const auto [name, pascal, unit] =
      GENERATE(std::tuple("m,kg,s", 1., 1.), std::tuple("mm,t,s", 1e6, 1e3),
               std::tuple("mm,kg,ms", 1e9, 1e9));
  INFO(name_of(format) << " " << name);
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.format = format;
  problem.units = parse_unit_system(name);
  problem.conductivity = conductivity;
  problem.contact_modulus = contact_modulus;
  const std::string text = solve(problem).text;
  std::vector<std::pair<double, double>> table;
  if (format == DeckFormat::json) {
    const auto law = nlohmann::json::parse(text)["laws"]["mean"];
    for (std::size_t i = 0; i < law["pressure"].size(); ++i)
      table.emplace_back(law["pressure"][i], law["thermal_conductance"][i]);
  } else if (format == DeckFormat::csv) {
    for (const auto& row : rows_after(text, "clearance,pressure"))
      table.emplace_back(row[1], row.back());
  } else if (format == DeckFormat::elmer) {
    for (const auto& row : rows_after(text, "    Real")) table.emplace_back(row[0], row[1]);
  } else if (format == DeckFormat::moose) {
    std::istringstream x(text.substr(text.find("x = '") + 5)),
        y(text.substr(text.find("y = '") + 5));
    for (double pressure = 0, value = 0; x >> pressure && y >> value;)
      table.emplace_back(pressure, value);
  } else {
    for (const auto& row : rows_after(text, "*GAP CONDUCTANCE")) table.emplace_back(row[1], row[0]);
  }
  if (format != DeckFormat::csv && format != DeckFormat::json) {
    CHECK(table.front() == std::pair(0., 0.));
    table.erase(table.begin());
  }
  CHECK(table.size() >= 198);
  for (const auto& [pressure, value] : table)
    // The samples begin at this pressure; below it the law opens like a sphere.
    if (pressure * pascal >= cubic_curve().samples.front().pressure)
      REQUIRE(value * unit == Approx(conductance(pressure * pascal)).epsilon(1e-5));
    else
      REQUIRE(value >= 0);
}

TEST_CASE("A conductance needs E*, and a format that has one", "[export]") {
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.conductivity = conductivity;
  CHECK_THAT(refusal(problem), Contains("contact_modulus"));
  problem.contact_modulus = contact_modulus;
  CHECK(refusal(problem).empty());
  problem.conductivity = {-1};
  CHECK_THAT(refusal(problem), Contains("conductivity"));
  problem.conductivity = {1, 2, 3};
  CHECK_THAT(refusal(problem), Contains("conductivity: 3"));
  problem.conductivity = conductivity;
  problem.format = DeckFormat::calculix;
  CHECK_THAT(refusal(problem), Contains("conductivity: given, but CalculiX"));
  for (const DeckFormat format : {DeckFormat::ansys, DeckFormat::code_aster, DeckFormat::jenkins,
                                  DeckFormat::c_header, DeckFormat::fmu}) {
    problem.format = format;
    CHECK_THAT(refusal(problem), Contains("conductivity: given, but"));
  }
  problem.conductivity = {};
  problem.format = DeckFormat::elmer;
  CHECK_THAT(refusal(problem), Contains("conductivity: not given"));
  problem.format = DeckFormat::moose;
  CHECK_THAT(refusal(problem), Contains("no conductivity either"));
}

TEST_CASE("CalculiX's exponential has the decay length of the law, and 1 % of p0 at c0",
          "[export]") {
  DeckProblem problem;
  problem.contacts = {exponential()};
  problem.format = DeckFormat::calculix;
  const std::string text = solve(problem).text;
  const auto row = rows_after(text, "PRESSURE-OVERCLOSURE=EXPONENTIAL").at(0);
  CHECK(row[1] == Approx(force0 / area0));
  CHECK(row[1] * std::exp(-row[0] / decay_length) == Approx(0.01 * row[1]).epsilon(1e-9));
  // The function of that name in Abaqus is a different one.
  problem.format = DeckFormat::abaqus;
  CHECK_THAT(solve(problem).text, Contains("TABULAR") && !Contains("EXPONENTIAL"));
}

TEST_CASE("Of several surfaces low and high are whole ones, ranked at one clearance", "[export]") {
  DeckProblem problem;
  for (const double factor : {1.1, 0.9, 1.3, 1.0}) problem.contacts.push_back(cubic(factor));
  problem.format = DeckFormat::json;
  const auto laws = nlohmann::json::parse(solve(problem).text)["laws"];
  CHECK_THAT(laws["low"]["surfaces"].get<std::string>(), Contains("surface 2 of 4"));
  CHECK_THAT(laws["high"]["surfaces"].get<std::string>(), Contains("surface 3 of 4"));
  const auto at = [&](const char* name, int row) {
    return laws[name]["pressure"][row].get<double>();
  };
  for (const int row : {1, 70, 199}) {
    CHECK(at("low", row) / at("mean", row) == Approx(0.9 / 1.075).epsilon(1e-9));
    CHECK(at("high", row) / at("mean", row) == Approx(1.3 / 1.075).epsilon(1e-9));
  }
}

TEST_CASE("Decks name license, units, source, revision, window and what the clearance is from",
          "[export]") {
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.units = parse_unit_system("mm,kg,ms");
  problem.source = "curve.h5";
  problem.provenance.revision = "abc123";
  for (const DeckFormat format : {DeckFormat::csv, DeckFormat::calculix, DeckFormat::ansys}) {
    problem.format = format;
    CHECK_THAT(solve(problem).text,
               Contains("MIT-0") && Contains("Units: mm, kg, ms. The unit of force is 1000 N") &&
                   Contains("of pressure 1e+09 Pa") && Contains("curve.h5") && Contains("abc123") &&
                   Contains("Window: ") && Contains("mean planes") && Contains("Assumptions"));
  }
}

TEST_CASE("What makes no deck is refused with what it lacks", "[export]") {
  DeckProblem problem;
  problem.contacts = {cubic()};
  problem.contacts.front().knows_tangential_stiffness = false;
  CHECK(refusal(problem).empty());
  problem.friction_coefficient = 0.3;
  CHECK_THAT(refusal(problem), Contains("tangential_stiffness: is not known"));
  problem.contacts = {exponential()};
  problem.contacts.front().nominal_area = DeckContact::unknown;
  CHECK_THAT(refusal(problem), Contains("nominal_area: not given"));
  problem.format = DeckFormat::jenkins;
  CHECK(refusal(problem).empty());
  problem.contacts.front().indentation = DeckContact::unknown;
  CHECK_THAT(refusal(problem), Contains("indentation: not given"));
  CHECK_THROWS_WITH(parse_unit_system("mm,stone,s"), Contains("stone is not a unit of mass"));
  CHECK_THROWS_WITH(parse_unit_system("mm,t"), Contains("a length, a mass and a time"));

  // One curve bends the wrong way at a kink, another one falls.
  ForceCurve bent = cubic_curve();
  for (ForceSample& sample : bent.samples) {
    sample.normal_stiffness = ForceSample::unknown;
    if (sample.mean_gap < 0.5e-6)
      sample.force = bent.samples[120].force * (1 + 0.5e-6 - sample.mean_gap);
  }
  problem = {};
  problem.contacts = {deck_contact(CurveContact{bent, 0.8, {}, "curve"})};
  CHECK_THAT(refusal(problem), Contains("is not convex"));
  for (ForceSample& sample : bent.samples)
    if (sample.mean_gap < 0.5e-6) sample.force = 0.1;
  CHECK_THROWS_WITH(deck_contact(CurveContact{bent, 0.8, {}, "curve"}),
                    Contains("does not grow with the indentation"));
  bent.samples.resize(1);
  CHECK_THROWS_WITH(deck_contact(CurveContact{bent, 0.8, {}, "curve"}), Contains("at least four"));
}
