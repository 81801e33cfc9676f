// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>

using namespace salebra;

TEST_CASE("Quantities are read with and without units", "[units]") {
  struct Case {
    const char* text;
    Dimension dimension;
    double value;
  };
  const auto [text, dimension, value] = GENERATE(values<Case>({
      {"10um", Dimension::length, 1e-5},
      {"10 \u00b5m", Dimension::length, 1e-5},
      {"10 \u03bcm", Dimension::length, 1e-5},
      {"2mm", Dimension::length, 2e-3},
      {"3 m", Dimension::length, 3},
      {"5\u00c5", Dimension::length, 5e-10},
      {"1e-7", Dimension::length, 1e-7},
      {"+.5nm", Dimension::length, 5e-10},
      {"20kHz", Dimension::frequency, 2e4},
      {"115GPa", Dimension::pressure, 1.15e11},
      {"2 N/mm^2", Dimension::pressure, 2e6},
      {"90deg", Dimension::angle, std::numbers::pi / 2},
      {"-45\u00b0", Dimension::angle, -std::numbers::pi / 4},
      {"10mrad", Dimension::angle, 0.01},
      {"0.1", Dimension::dimensionless, 0.1},
      {"3%", Dimension::dimensionless, 0.03},
      {"5mm/s", Dimension::velocity, 5e-3},
      {"1krad/s", Dimension::angular_frequency, 1e3},
      {"4/um2", Dimension::inverse_length_squared, 4e12},
      {"4 1/mm\u00b2", Dimension::inverse_length_squared, 4e6},
      {"4um^-2", Dimension::inverse_length_squared, 4e12},
      {"7mN", Dimension::force, 7e-3},
      {"2kg", Dimension::mass, 2},
      {"1kN/m", Dimension::stiffness, 1e3},
      {"5us", Dimension::time, 5e-6},
      {"90min", Dimension::time, 5400},
      {"1.5h", Dimension::time, 5400},
  }));
  INFO(text);
  // A parsed decimal and a power of ten cause two roundings.
  CHECK(parse_quantity(text, dimension, "--x") == Approx(value).epsilon(4e-16).margin(0));
}

TEST_CASE("Units are read by their names, plurals and in the letters that programs write",
          "[units]") {
  struct Case {
    Dimension dimension;
    double value;
    std::vector<const char*> units;
  };
  const std::vector<Case> cases{
      {Dimension::length,
       1e-6,
       {"\u00b5m", "\u03bcm", "um", "UM", "\u00b5M", "\u00b5", "micron", "Microns", "MICRONS",
        "micrometer", "micrometers", "micrometre", "Micrometres", "Mikrometer", "microm\u00e8tres",
        "micr\u00f3metros"}},
      {Dimension::length,
       1e-3,
       {"mm", "MM", "millimeter", "millimeters", "Millimetre", "millimetres", "MILLIMETERS"}},
      {Dimension::length, 1e-9, {"nm", "NM", "nanometer", "nanometers", "Nanometres"}},
      {Dimension::length, 1, {"m", "meter", "meters", "metre", "Metres"}},
      {Dimension::length, 1e-2, {"cm", "CM", "centimeter", "Zentimeter"}},
      {Dimension::length,
       1e-10,
       {"\u00c5", "\u212b", "A\u030a", "Angstrom", "angstroms", "Angstroem", "\u00c5ngstr\u00f6m",
        "\u00e5ngstr\u00f6m", "ANGSTROMS"}},
      {Dimension::length, 0.0254, {"in", "IN", "inch", "Inches"}},
      {Dimension::length, 25.4e-6, {"mil", "mils", "thou"}},
      {Dimension::length, 25.4e-9, {"uin", "\u00b5in", "microinch", "microinches"}},
      {Dimension::pressure,
       1e6,
       {"MPa", "MPA", "megapascal", "Megapascals", "N/mm2", "N/mm^2", "N/mm\u00b2", "MN/m2",
        "N/mm**2"}},
      {Dimension::pressure, 1e9, {"GPa", "GPA", "gpa", "Gigapascal", "kN/mm2"}},
      {Dimension::pressure, 1e2, {"hPa", "mbar", "millibar"}},
      {Dimension::pressure, 6894.757293168361, {"psi", "PSI"}},
      {Dimension::force, 1e-3, {"mN", "millinewton", "millinewtons"}},
      {Dimension::force, 9.80665, {"kgf"}},
      {Dimension::time, 1e-3, {"ms", "msec", "millisecond", "milliseconds", "Millisekunden"}},
      {Dimension::time, 1, {"s", "sec", "second", "Seconds", "Sekunden"}},
      {Dimension::time, 3600, {"h", "hour", "hours"}},
      {Dimension::frequency, 1e3, {"kHz", "KHz", "khz", "KHZ", "kilohertz", "Kilohertz"}},
      {Dimension::frequency, 1. / 60, {"rpm", "RPM"}},
      {Dimension::angle, std::numbers::pi / 180, {"deg", "\u00b0", "degree", "degrees"}},
      {Dimension::angle, 1e-3, {"mrad", "milliradian"}},
      {Dimension::velocity, 1e-3 / 60, {"mm/min"}},
      {Dimension::damping, 1, {"N s/m", "Ns/m", "N\u00b7s/m", "N*s/m"}},
      {Dimension::inverse_length, 1e6, {"1/um", "um-1", "\u00b5m\u207b\u00b9", "um^-1"}},
      {Dimension::wavenumber, 1e6, {"rad/um", "rad/\u00b5m"}},
      {Dimension::length_to_the_fourth, 1e-24, {"um4", "um^4", "\u00b5m\u2074"}},
      {Dimension::dimensionless, 0.01, {"%", "percent"}},
  };
  for (const auto& [dimension, value, units] : cases)
    for (const std::string unit : units) {
      INFO(unit);
      // A factor, a power of ten and their product cause three roundings.
      CHECK(parse_quantity("1 " + unit, dimension, "--x") ==
            Approx(value).epsilon(7e-16).margin(0));
    }
}

TEST_CASE("A unit that may mean two things, or something else, is refused by name", "[units]") {
  for (const auto& [dimension, unit] :
       std::initializer_list<std::pair<Dimension, std::string>>{{Dimension::length, "Mm"},
                                                                {Dimension::length, "Gm"},
                                                                {Dimension::length, "Nm"},
                                                                {Dimension::length, "A"},
                                                                {Dimension::length, "M"},
                                                                {Dimension::length, "V"},
                                                                {Dimension::length, "u"},
                                                                {Dimension::length, "px"},
                                                                {Dimension::length, "micros"},
                                                                {Dimension::length, "milli"},
                                                                {Dimension::length, "meterss"},
                                                                {Dimension::pressure, "mpa"},
                                                                {Dimension::pressure, "mm"},
                                                                {Dimension::frequency, "mhz"},
                                                                {Dimension::time, "S"},
                                                                {Dimension::wavenumber, "1/m"}}) {
    INFO(unit);
    CHECK_THROWS_WITH(parse_quantity("2 " + unit, dimension, "--x"),
                      Catch::StartsWith("--x: '2 " + unit + "' has a unit that is not known") &&
                          Catch::Contains("'" + unit + "'"));
  }
}

TEST_CASE("The unit of every dimension in files is read as one", "[units]") {
  for (int i = 0; i <= int(Dimension::thermal_conductance); ++i) {
    const Dimension dimension{i};
    INFO(si_unit(dimension));
    CHECK(parse_quantity("1 " + std::string(si_unit(dimension)), dimension, "--x") == 1);
  }
}

TEST_CASE("Round numbers with prefixes are the doubles of their decimals", "[units]") {
  CHECK(parse_quantity("10um", Dimension::length, "--x") == 1e-5);
  CHECK(parse_quantity("312.5nm", Dimension::length, "--x") == 312.5e-9);
  CHECK(parse_quantity("115GPa", Dimension::pressure, "--x") == 115e9);
}

TEST_CASE("What is not a quantity of the dimension is refused with the option's name", "[units]") {
  const auto [text, dimension] = GENERATE(table<const char*, Dimension>({
      {"", Dimension::length},
      {"um", Dimension::length},
      {"10 kg", Dimension::length},
      {"10 Pa", Dimension::length},
      {"1e", Dimension::length},
      {"1,5", Dimension::length},
      {"nan", Dimension::length},
      {"inf", Dimension::length},
      {"1e400", Dimension::length},
      {"0x10", Dimension::length},
      {"10kdeg", Dimension::angle},
      {"20 kHz", Dimension::angular_frequency},
      {"1 2", Dimension::dimensionless},
      {"--1", Dimension::dimensionless},
  }));
  INFO(text);
  CHECK_THROWS_WITH(parse_quantity(text, dimension, "--size-x"),
                    Catch::StartsWith("--size-x: '" + std::string(text) + "' "));
  CHECK_THROWS_AS(parse_quantity(text, dimension, "--size-x"), InvalidInput);
}

TEST_CASE("Values are one number, a list or a logarithmic range", "[units]") {
  CHECK(parse_values("3kPa", Dimension::pressure, "--p") == std::vector{3e3});
  CHECK(parse_values("1Pa,2kPa, 3 MPa", Dimension::pressure, "--p") == std::vector{1., 2e3, 3e6});
  CHECK(parse_values("1,2, 3e6", Dimension::pressure, "--p") == std::vector{1., 2., 3e6});

  const auto range = parse_values("1:100MPa:5", Dimension::pressure, "--p");
  REQUIRE(range.size() == 5);
  CHECK(range.front() == 1e6);
  CHECK(range.back() == 1e8);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(range[i] == Approx(1e6 * std::pow(10, 0.5 * double(i))).epsilon(1e-14));
  }
  const auto falling = parse_values("1e-2:1e-4:3", Dimension::length, "--p");
  CHECK(falling[1] == Approx(1e-3).epsilon(1e-14));

  for (const char* bad :
       {"1:2", "1:2:1", "1:2:x", "0:2:5", "-1:2:5", "2:2:5", "1:2:3:4", "1,,2", "1:2:2.5"}) {
    INFO(bad);
    CHECK_THROWS_AS(parse_values(bad, Dimension::length, "--p"), InvalidInput);
  }
}

TEST_CASE("A list has units at all of its numbers or at none", "[units]") {
  for (const auto& [text, with, without] : std::initializer_list<std::array<const char*, 3>>{
           {"10,20,50MPa", "write 10MPa,20MPa,50MPa", "in Pa, 10,20,5e+07"},
           {"1,5MPa", "write 1MPa,5MPa", "a decimal comma is written as a point"},
           {"0,5MPa", "write 0MPa,5MPa", "a decimal comma is written as a point"},
           {"1kPa,2", "write 1kPa,2kPa", "in Pa, 1000,2"},
           {"1,2kPa,3MPa", "write 1kPa,2kPa,3MPa", "in Pa, 1,2000,3e+06"},
           {"1MPa:100:5", "write 1MPa:100MPa:5", ""}}) {
    INFO(text);
    CHECK_THROWS_WITH(parse_values(text, Dimension::pressure, "--pressure"),
                      Catch::StartsWith("--pressure: '" + std::string(text) + "' has a unit on") &&
                          Catch::Contains(with) && Catch::Contains(without));
  }
  CHECK_THROWS_WITH(parse_values("1,2%", Dimension::dimensionless, "--x"),
                    Catch::Contains("write 1%,2% or, without a unit, 1,0.02"));
}

TEST_CASE(
    "A number written with a prefixed unit is the number times the prefix, for random numbers",
    "[units]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-30, 30);
  for (int repeat = 0; repeat < 500; ++repeat) {
    const double number = mantissa(random) * std::pow(10.0, exponent(random));
    const std::string text = fmt::format("{}", number);  // shortest text that reads back exactly
    CHECK(parse_quantity(text, Dimension::length, "--x") == number);
    CHECK(parse_quantity(text + " nm", Dimension::length, "--x") ==
          Approx(number * 1e-9).epsilon(4e-16).margin(0));
  }
}

TEST_CASE("A formatted quantity reads back to the digits shown, for random numbers", "[units]") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> mantissa(1, 10);
  std::uniform_int_distribution<int> exponent(-20, 18);
  for (int repeat = 0; repeat < 500; ++repeat) {
    const double number = mantissa(random) * std::pow(10.0, exponent(random));
    for (const Dimension dimension : {Dimension::length, Dimension::pressure, Dimension::velocity,
                                      Dimension::angle, Dimension::dimensionless}) {
      const std::string text = format_quantity(number, dimension);
      INFO(text);
      // Four digits: half a unit of the fourth is at most 5e-4 relative.
      CHECK(parse_quantity(text, dimension, "--x") == Approx(number).epsilon(5.1e-4).margin(0));
    }
  }
  CHECK(format_quantity(1.2344e-6, Dimension::length) == "1.234 \u00b5m");
  CHECK(format_quantity(9.99996e-7, Dimension::length) == "1 \u00b5m");
  // The prefix follows from the number rounded to four digits, which rounds up here; rounded to
  // five digits it would not.
  CHECK(format_quantity(9.9996e-7, Dimension::length) == "1 \u00b5m");
  CHECK(format_quantity(std::nan(""), Dimension::length) == "n/a");
  CHECK(format_quantity(1.25e15, Dimension::stiffness_per_area) == "1.25 GPa/\u00b5m");
  CHECK(parse_quantity("1.25 GPa/um", Dimension::stiffness_per_area, "k") == Approx(1.25e15));
  CHECK(parse_quantity("2MPa/m", Dimension::stiffness_per_area, "k") == 2e6);
}

TEST_CASE("A quantity whose square a double does not hold is refused", "[units]") {
  for (const char* text : {"1e308", "1e151", "-1e200", "1e-151", "5e-324", "1e145TPa"})
    CHECK_THROWS_WITH(
        parse_quantity(text, Dimension::pressure, "--p"),
        Catch::Contains("--p: '" + std::string(text) + "' must be 0, or from 1e-150 to 1e150"));
  CHECK(parse_quantity("0", Dimension::pressure, "--p") == 0);
  CHECK(parse_quantity("-1e150", Dimension::pressure, "--p") == -1e150);
  CHECK(parse_quantity("1e-138TPa", Dimension::pressure, "--p") == Approx(1e-126).epsilon(1e-15));
  CHECK_THROWS_WITH(parse_values("1e-200:1:3", Dimension::length, "--l"),
                    Catch::Contains("1e-150"));
}
