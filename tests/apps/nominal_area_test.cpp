// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "run_program.hpp"

using Catch::Contains;
using nlohmann::json;

namespace {

// A sample of 100 µm² with p = exp(δ/100 nm) MPa, K and K_t, as text.
const std::string sample = [] {
  std::string text =
      "# nominal_area: 100 um^2\nindentation [nm], pressure [MPa], normal_stiffness [N/m], "
      "tangential_stiffness [N/m]\n";
  for (int i = 0; i <= 10; ++i) {
    const double pressure = std::exp(i / 2.0), stiffness = pressure * 1e6 * 100e-12 / 100e-9;
    std::ostringstream row;
    row.precision(17);
    row << 50 * i << ", " << pressure << ", " << stiffness << ", " << 0.8 * stiffness << '\n';
    text += row.str();
  }
  return text;
}();

const std::string material = " --contact-modulus 115GPa --poisson 0.3 --friction-coefficient 0.3";

// Every column of the one answer is that of the other times the ratio, or the same per area and
// where it has nothing to do with the area.
void check_scaled(const json& of_sample, const json& of_part, double ratio) {
  int scaled = 0;
  for (const std::string name :
       {"tangential_force", "work_per_cycle", "secant_stiffness", "storage_stiffness",
        "loss_stiffness", "tangential_amplitude", "loss_factor"}) {
    CAPTURE(name);
    // Round-off of sums of forces.
    const double expected = of_sample[name][0];
    const bool extensive = of_sample.contains(name + "_per_area");
    CHECK(double(of_part[name][0]) == Approx((extensive ? ratio : 1) * expected).epsilon(1e-9));
    if (!extensive) continue;
    ++scaled;
    const double per_area = of_sample[name + "_per_area"][0];
    CHECK(double(of_part[name + "_per_area"][0]) == Approx(per_area).epsilon(1e-9));
  }
  CHECK(scaled == 5);
  CHECK(double(of_part["force"]) == Approx(ratio * double(of_sample["force"])).epsilon(1e-9));
}

// The numbers of all lines without a comment.
std::vector<double> numbers_of(const std::string& text) {
  std::istringstream lines(text);
  std::vector<double> numbers;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    for (char& symbol : line)
      if (symbol == ',') symbol = ' ';
    std::istringstream words(line);
    for (double number = 0; words >> number;) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

TEST_CASE("A joint of a part is that of its sample times the ratio of the areas",
          "[joint][nominal area]") {
  const ProgramTest test;
  test.write("curve.csv", sample);
  const std::string curve = "joint --curve curve.csv --pressure 20MPa" + material;
  const double ratio = 1e4;  // 1 mm² of 100 µm²
  check_scaled(test.answer(curve + " --tangential-amplitudes 5nm --json"),
               test.answer(curve + " --tangential-amplitudes 5nm --nominal-area 1mm2 --json"),
               ratio);
  // Forces are those of the part: the tangential one, and the normal one.
  check_scaled(test.answer(curve + " --tangential-forces 100uN --json"),
               test.answer("joint --curve curve.csv --normal-force 20N" + material +
                           " --tangential-forces 1N --nominal-area 1mm2 --json"),
               ratio);
  check_scaled(
      test.answer(curve + " --tangential-forces 100uN --normal-amplitude 10nm --json"),
      test.answer(curve +
                  " --tangential-forces 1N --normal-amplitude 10nm --nominal-area 1mm2 --json"),
      ratio);
  check_refused(test.run(curve + " --tangential-forces 7N --nominal-area 1mm2"), "below 6 N");
}

TEST_CASE("A joint of a part is that of its surface times the ratio of the areas",
          "[joint][nominal area]") {
  const ProgramTest test;
  test.done(
      "generate --size-x 10um --points 32 --hurst 0.8 --rms-height 50nm --short-cutoff 1.25um "
      "--seed 1 -o rough.h5 --quiet");
  const std::string surface =
      "joint --surface rough.h5 --pressure 50MPa --contact-modulus 10GPa --poisson 0.3 "
      "--friction-coefficient 0.3 ";
  check_scaled(test.answer(surface + "--tangential-amplitudes 2nm --json"),
               test.answer(surface + "--tangential-amplitudes 2nm --nominal-area 1mm2 --json"),
               1e4);
  check_refused(test.run(surface + "--tangential-forces 16N --nominal-area 1mm2"), "below 15");
}

TEST_CASE("Decks of a part have its forces, the pressures of the sample, and both areas",
          "[export][nominal area]") {
  const ProgramTest test;
  test.write("curve.csv", sample);
  const std::string start = "export curve.csv --poisson 0.3 --friction-coefficient 0.3 ";
  for (const std::string format :
       {"csv", "calculix", "abaqus", "ansys", "code-aster", "jenkins", "c-header"}) {
    CAPTURE(format);
    const std::string options = start + "--pressure 20MPa --to " + format;
    const std::string of_sample = test.done(options).out,
                      of_part = test.done(options + " --nominal-area 1mm2").out;
    CHECK_THAT(of_sample, Contains("Nominal area: 1e-10."));
    CHECK_THAT(of_part, Contains("Nominal area of the part: 1e-06.") &&
                            Contains("sample of 1e-10") && Contains("times 10000."));
  }
  const auto rows = [&](const std::string& options) {
    return numbers_of(test.done(start + options).out);
  };
  const auto sliders = rows("--pressure 20MPa --to jenkins"),
             of_part = rows("--pressure 20MPa --to jenkins --nominal-area 1mm2"),
             by_force = rows("--normal-force 20N --to jenkins --nominal-area 1mm2");
  REQUIRE(sliders.size() > 100);
  REQUIRE(of_part.size() == sliders.size());
  for (std::size_t i = 0; i < sliders.size(); ++i) {
    // Round-off of the numbers that each of the sliders is a difference of.
    const double round_off = 1e-9 * sliders[i % 2] * 1e4;
    CHECK(of_part[i] == Approx(1e4 * sliders[i]).epsilon(1e-6).margin(round_off));
    CHECK(by_force[i] == Approx(of_part[i]).epsilon(1e-6).margin(round_off));
  }
  const auto table = rows("--pressure 20MPa --to csv"),
             table_of_part = rows("--pressure 20MPa --to csv --nominal-area 1mm2");
  REQUIRE(table.size() > 100);
  REQUIRE(table_of_part.size() == table.size());
  for (std::size_t i = 0; i < table.size(); ++i)
    CHECK(table_of_part[i] == Approx(table[i]).epsilon(1e-9).margin(1e-15));
}

TEST_CASE("Forces of a sample whose area is not stated are not those of a part",
          "[export][joint][nominal area]") {
  const ProgramTest test;
  test.write("forces.csv", "indentation [nm], force [N]\n0, 1\n100, 3\n200, 9\n300, 27\n400, 81\n");
  test.write("pressures.csv",
             "indentation [nm], pressure [MPa]\n0, 1\n100, 3\n200, 9\n300, 27\n400, 81\n");
  const std::string joint = " --normal-force 9" + material + " --tangential-amplitudes 5nm ";
  check_refused(test.run("joint --curve forces.csv" + joint + "--nominal-area 1mm2"),
                "forces.csv has forces or stiffnesses of a sample");
  check_refused(test.run("export forces.csv --to csv --nominal-area 1mm2"), "nominal_area: 1 mm^2");
  // Pressures alone are of any area.
  CHECK(double(test.answer("joint --curve pressures.csv" + joint +
                           "--nominal-area 1mm2 --json")["tangential_force"][0]) ==
        Approx(double(test.answer("joint --curve forces.csv" + joint +
                                  "--json")["tangential_force"][0]))
            .epsilon(1e-9));
}
