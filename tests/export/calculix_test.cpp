// SPDX-License-Identifier: GPL-3.0-or-later
// Runs decks for CalculiX with CalculiX, if it is installed (Debian: calculix-ccx).
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "decks.hpp"
#include "io/scratch.hpp"
#include "skipped.hpp"

using namespace salebra;
using namespace salebra::testing;

namespace {

bool has_calculix() { return std::system("command -v ccx >/dev/null 2>&1") == 0; }

/// Forces on a cube of 1 mm² that is pressed against another one at the distance `gap`, after each
/// of the approaches; m, N. The cubes are so stiff that their own compression is at most 3e-5 of l.
std::vector<double> press(const std::string& deck, double gap, const std::vector<double>& ways) {
  const Scratch scratch;
  const double side = 1e-3;
  std::ofstream input(scratch / "press.inp");
  input.precision(12);
  input << "*NODE\n";
  for (int k = 0, node = 1; k < 4; ++k)
    for (const auto& [x, y] : {std::pair(0., 0.), {side, 0.}, {side, side}, {0., side}})
      input << node++ << ", " << x << ", " << y << ", " << (k + 1) / 2 * side + k / 2 * gap << '\n';
  input << "*ELEMENT, TYPE=C3D8, ELSET=BOTH\n1, 1,2,3,4,5,6,7,8\n2, 9,10,11,12,13,14,15,16\n"
           "*MATERIAL, NAME=STIFF\n*ELASTIC\n1e16, 0\n*SOLID SECTION, ELSET=BOTH, MATERIAL=STIFF\n"
           "*SURFACE, NAME=LOWER\n1, S2\n*SURFACE, NAME=UPPER\n2, S1\n"
        << deck
        << "*CONTACT PAIR, INTERACTION=SALEBRA_MEAN, TYPE=NODE TO SURFACE\nUPPER, LOWER\n"
           "*NSET, NSET=FIXED, GENERATE\n1, 8\n*NSET, NSET=SIDES, GENERATE\n9, 16\n"
           "*NSET, NSET=TOP, GENERATE\n13, 16\n*BOUNDARY\nFIXED, 1, 3\nSIDES, 1, 2\n";
  for (const double way : ways)
    input << "*STEP, NLGEOM, INC=1000\n*STATIC\n0.25, 1\n*BOUNDARY\nTOP, 3, 3, " << -way
          << "\n*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1000\nRF\n*END STEP\n";
  input.close();
  const std::string run = "cd '" + scratch.folder().string() + "' && ccx press >press.log 2>&1";
  REQUIRE(std::system(run.c_str()) == 0);
  std::ifstream stream(scratch / "press.dat");
  std::vector<double> forces;
  for (double x = 0, y = 0, z = 0; stream;)
    if (std::string line; std::getline(stream, line)) {
      std::istringstream words(line);
      if (words >> x >> y >> z) forces.push_back(-z);
    }
  return forces;
}

/// Pressure and heat flux, Pa and W/m², between two cubes of 1 mm² pressed together from first touch
/// by an approach, with 1 K between their outer faces. The cubes conduct so well that they take
/// 1e-5 of this.
std::pair<double, double> heat(const std::string& deck, double way) {
  const Scratch scratch;
  const double side = 1e-3, area = side * side;
  std::ofstream input(scratch / "heat.inp");
  input.precision(12);
  input << "*NODE\n";
  for (int k = 0, node = 1; k < 4; ++k)
    for (const auto& [x, y] : {std::pair(0., 0.), {side, 0.}, {side, side}, {0., side}})
      input << node++ << ", " << x << ", " << y << ", " << (k + 1) / 2 * side << '\n';
  input << "*ELEMENT, TYPE=C3D8, ELSET=BOTH\n1, 1,2,3,4,5,6,7,8\n2, 9,10,11,12,13,14,15,16\n"
           "*MATERIAL, NAME=STIFF\n*ELASTIC\n1e16, 0\n*CONDUCTIVITY\n1e10\n"
           "*SOLID SECTION, ELSET=BOTH, MATERIAL=STIFF\n"
           "*SURFACE, NAME=LOWER\n1, S2\n*SURFACE, NAME=UPPER\n2, S1\n"
        << deck
        << "*CONTACT PAIR, INTERACTION=SALEBRA_MEAN, TYPE=NODE TO SURFACE\nUPPER, LOWER\n"
           "*NSET, NSET=BOTTOM, GENERATE\n1, 4\n*NSET, NSET=FIXED, GENERATE\n1, 8\n"
           "*NSET, NSET=SIDES, GENERATE\n9, 16\n*NSET, NSET=TOP, GENERATE\n13, 16\n"
           "*NSET, NSET=ALL, GENERATE\n1, 16\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0\n"
           "*BOUNDARY\nFIXED, 1, 3\nSIDES, 1, 2\n"
           "*STEP, NLGEOM, INC=1000\n*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE\n0.25, 1\n"
           "*BOUNDARY\nTOP, 3, 3, "
        << -way
        << "\nBOTTOM, 11, 11, 0\nTOP, 11, 11, 1\n"
           "*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1000\nRF, RFL\n*END STEP\n";
  input.close();
  const std::string run = "cd '" + scratch.folder().string() + "' && ccx heat >heat.log 2>&1";
  REQUIRE(std::system(run.c_str()) == 0);
  std::ifstream stream(scratch / "heat.dat");
  double force = 0, flow = 0;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    double x = 0, y = 0, z = 0;
    if (!(words >> x)) continue;
    if (words >> y >> z)
      force = -z;
    else
      flow = x;
  }
  return {force / area, flow / area};
}

}  // namespace

TEST_CASE("CalculiX conducts heat with the conductance of an exponential law",
          "[export][calculix]") {
  if (skipped(!has_calculix(), "ccx is not installed")) return;
  DeckProblem problem;
  problem.format = DeckFormat::calculix;
  problem.contacts = {exponential()};
  problem.conductivity = conductivity;
  problem.contact_modulus = contact_modulus;
  const std::string deck = solve(problem).text;
  for (const double way : {1e-8, 5e-8, 1e-7}) {
    const auto [pressure, flux] = heat(deck, way);
    // CalculiX stops its iterations at 0.5 % of the average force, and was within 1e-4 here. K/A = p/l.
    CHECK(pressure == Approx(force0 / area0 * std::exp(way / decay_length)).epsilon(1e-3));
    CHECK(flux == Approx(2 * (pressure / decay_length) / (contact_modulus * (1 / 50. + 1 / 400.)))
                      .epsilon(1e-3));
  }
}

TEST_CASE("CalculiX presses a cube with the force of the law", "[export][calculix]") {
  if (skipped(!has_calculix(), "ccx is not installed")) return;
  DeckProblem problem;
  problem.format = DeckFormat::calculix;
  SECTION("exponential") {
    problem.contacts = {exponential()};
    // The clearances run from 3 l down to −l.
    const double gap = 4 * decay_length;
    const std::vector<double> ways{1e-7, 2e-7, 3e-7, 4e-7, 5e-7};
    const auto forces = press(solve(problem).text, gap, ways);
    REQUIRE(forces.size() == ways.size());
    for (std::size_t i = 0; i < ways.size(); ++i)
      CHECK(forces[i] == Approx(force0 * std::exp((ways[i] - gap) / decay_length)).epsilon(1e-3));
  }
  SECTION("a table, from apart through first touch and back") {
    problem.contacts = {cubic()};
    const DeckSolution answer = solve(problem);
    const ContactLaw& law = *problem.contacts.front().law;
    const double zero = rows_after(answer.text, "** mean")[0][0];
    CHECK(-zero == Approx(law.first_touch()).epsilon(1e-9));
    // The lowest load of the curve lies 0.1 µm beyond first touch.
    const double lowest = 1e-7 * (1 - 1e-9);
    const std::vector<double> ways{-1e-7, 2e-8, 6e-8, lowest, 4e-7, 7e-8, -5e-8, 3e-7};
    const auto forces = press(answer.text, 0, ways);
    REQUIRE(forces.size() == ways.size());
    for (std::size_t i = 0; i < ways.size(); ++i) {
      CAPTURE(ways[i]);
      const double force = law.force(ways[i] - zero);
      // The deck states the error of its lines, of at least the lowest load. That of the cubes'
      // own compression is 1e-3, as in the other sections.
      const double allowed = answer.interpolation_error * std::max(force, law.force(lowest - zero));
      CHECK(std::abs(forces[i] - force) <= allowed + 1e-3 * force + 1e-9 * force0);
    }
    CHECK(std::abs(forces[0]) < 1e-9 * force0);
    CHECK(std::abs(forces[6]) < 1e-9 * force0);
  }
  SECTION("table") {
    problem.contacts = {cubic()};
    const std::string deck = solve(problem).text;
    const double zero = rows_after(deck, "** mean")[0][0];
    const std::vector<double> ways{1.5e-7, 3e-7, 5e-7, 7e-7};
    const auto forces = press(deck, 0, ways);
    REQUIRE(forces.size() == ways.size());
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const double rest = 1 - (zero - ways[i]) / 1e-6;  // all lie above the lowest load
      CHECK(forces[i] == Approx(force0 * rest * rest * rest).epsilon(1e-3));
    }
  }
}
