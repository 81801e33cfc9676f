// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "run_program.hpp"

namespace {

const std::string recipe =
    "generate --points 64 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um --rms-height "
    "10nm ";
const std::string study = R"([surface]
points = 32
size_x = "4um"
hurst = 0.8
rolloff = "2um"
short_cutoff = "1um"
rms_height = "10nm"
seeds = [1, 2]

[material]
contact_modulus = "10GPa"
poisson = 0.3

[contact]
relative_pressures = "1e-3:0.2:8"

[damping]
normal_amplitude = "0.1nm"
drag_velocity = "1mm/s"
frequency = "20kHz"
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("A study file with a fault is refused with key and line, and nothing is written",
          "[bad-input]") {
  const ProgramTest test;
  struct Case {
    const char* from;
    const char* to;
    const char* expected;
  };
  const auto [from, to, expected] = GENERATE(values<Case>({
      {"hurst = 0.8", "hurts = 0.8", "study.toml:4: surface.hurts"},
      {"seeds = [1, 2]", "seeds = [1, 2]\ncolour = 1", "study.toml:9: surface.colour"},
      {"poisson = 0.3", "poison = 0.3", "study.toml:12: material.poison"},
      {"[contact]", "[contract]", "study.toml:14: contract"},
      {"hurst = 0.8", "hurst = 1.3", "study.toml:4: surface.hurst: 1.3"},
      {"hurst = 0.8", "hurst = nan", "study.toml:4: surface.hurst"},
      {"hurst = 0.8", "hurst = \"rough\"", "study.toml:4: surface.hurst"},
      {"\"4um\"", "\"-4um\"", "study.toml:3: surface.size_x"},
      {"\"4um\"", "\"4kg\"", "study.toml:3: surface.size_x"},
      {"\"1um\"", "\"0.2um\"", "study.toml:6: surface.short_cutoff"},
      {"points = 32", "points = 0", "study.toml:2: surface.points"},
      {"points = 32", "points = 3.5", "study.toml:2: surface.points"},
      {"seeds = [1, 2]", "seeds = [1, 1]", "study.toml:8: surface.seeds"},
      {"poisson = 0.3", "poisson = 0.7", "study.toml:12: material.poisson"},
      {"\"1e-3:0.2:8\"", "[0.1, 0.0, 0.2, 0.3]", "study.toml:15: contact.relative_pressures"},
      {"\"1e-3:0.2:8\"", "[0.1, 0.2]", "study.toml:15: contact.relative_pressures"},
      {"\"20kHz\"", "\"0Hz\"", "study.toml:20: damping.frequency"},
      {"\"20kHz\"", "20kHz", "study.toml:20"},
      {"\"0.1nm\"", "5e-324",
       "study.toml:18: damping.normal_amplitude: '5e-324' must be 0, or from"},
      {"\"0.1nm\"", "\"1e308m\"",
       "study.toml:18: damping.normal_amplitude: '1e308m' must be 0, or"},
  }));
  INFO(expected);
  test.write("study.toml", replaced(study, from, to));
  check_refused(test.run("study study.toml -o result.h5"), expected);
  CHECK(test.files() == std::set<std::string>{"study.toml"});
}

TEST_CASE("A grid that is too small for statistics is refused with its file", "[bad-input]") {
  const ProgramTest test;
  test.write("two_rows.txt", "1 2 3\n4 5 6\n");
  check_refused(test.run("statistics two_rows.txt"), "two_rows.txt: nx: 2");
}

TEST_CASE("A fit window that holds fewer than three pressures is refused", "[bad-input]") {
  const ProgramTest test;
  test.write(
      "study.toml",
      replaced(study, "relative_pressures = \"1e-3:0.2:8\"",
               "pressures = \"1MPa:1GPa:8\"\n[fit]\npressure_window = [\"1MPa\", \"3MPa\"]"));
  check_refused(test.run("study study.toml -o result.h5"), "study.toml:17: fit.pressure_window");
  CHECK(test.files() == std::set<std::string>{"study.toml"});
}

TEST_CASE("A surface file that cannot be one is refused, and nothing is written", "[bad-input]") {
  const ProgramTest test;
  const std::string press =
      "contact heights.txt --size-x 1um --size-y 1um --pressure 1MPa --contact-modulus 1GPa -o "
      "result.h5";
  const auto content =
      GENERATE(as<std::string>(), "This is nonsense.", "", "1 2 3\n4 5\n", "1 2 x\n3 4 5\n6 7 8\n",
               "1 2 nan\n3 4 5\n6 7 8\n", "1 2 inf\n3 4 5\n6 7 8\n", "# Width: 1 µm\n");
  INFO(content);
  test.write("heights.txt", content);
  check_refused(test.run(press), "");
  CHECK(test.files() == std::set<std::string>{"heights.txt"});
}

TEST_CASE("Surfaces that are absent, truncated or without a size are refused", "[bad-input]") {
  const ProgramTest test;
  const std::string rest = " --pressure 1MPa --contact-modulus 1GPa -o result.h5";
  check_refused(test.run("contact absent.h5" + rest), "absent.h5");
  test.write("heights.txt", "1 2 3 4\n4 5 6 7\n7 8 9 5\n");
  check_refused(test.run("contact heights.txt" + rest), "size_x");
  check_refused(test.run("contact heights.txt --size-x 0 --size-y 1um" + rest), "--size-x");

  REQUIRE(test.run(recipe + "-o rough.h5").status == 0);
  REQUIRE(test.run(recipe + "-o rough.npy").status == 0);
  for (const std::string name : {"rough.h5", "rough.npy"}) {
    INFO(name);
    const std::string whole = test.read(name);
    test.write("cut-" + name, whole.substr(0, whole.size() / 2));
    check_refused(test.run("contact cut-" + name + " --size-x 1um --size-y 1um" + rest),
                  "cut-" + name);
  }
  CHECK(!test.files().contains("result.h5"));
}

TEST_CASE("The measured surfaces that are broken on purpose are refused", "[bad-input]") {
  const ProgramTest test;
  check_refused(test.run("statistics " + std::string(SALEBRA_SURFACES "/nonsense_txt_file.txt")),
                "nonsense_txt_file.txt");
  check_refused(test.run("statistics " + std::string(SALEBRA_SURFACES "/wrongnpyfile.npy")),
                "wrongnpyfile.npy");
  check_refused(test.run("statistics " + std::string(SALEBRA_SURFACES "/example-2d.npy")),
                "size_x");
}

TEST_CASE("Grids and spectra that cannot be are refused, and nothing is written", "[bad-input]") {
  const ProgramTest test;
  const auto [options, expected] = GENERATE(table<std::string, std::string>({
      {"--points 0 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um --rms-height 1nm",
       "--points"},
      {"--points 64,-1 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um --rms-height "
       "1nm",
       "--points"},
      {"--points 64 --size-x 0 --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um --rms-height 1nm",
       "--size-x: 0"},
      {"--points 64 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.03um --rms-height "
       "1nm",
       "short_cutoff"},
      {"--points 64 --size-x 1um --hurst 0 --rolloff 0.5um --short-cutoff 0.2um --rms-height 1nm",
       "hurst"},
      {"--points 64 --size-x 1um --hurst nan --rolloff 0.5um --short-cutoff 0.2um --rms-height 1nm",
       "--hurst"},
      {"--points 64 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um", "--rms-height"},
      {"--points 64 --size-x 1um --hurst 0.8 --rolloff 0.1um --short-cutoff 0.2um --rms-height 1nm",
       "rolloff"},
      {"--points 64 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um --rms-height "
       "-1nm",
       "--rms-height"},
      {"--points 64 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um --rms-height 1nm "
       "--seed -1",
       "--seed"},
  }));
  INFO(options);
  check_refused(test.run("generate " + options + " -o rough.h5"), expected);
  CHECK(test.files().empty());
}

TEST_CASE("Pressures, gaps and materials that cannot be are refused, and nothing is written",
          "[bad-input]") {
  const ProgramTest test;
  REQUIRE(test.run(recipe + "-o rough.h5").status == 0);
  const auto [options, expected] = GENERATE(table<std::string, std::string>({
      {"contact rough.h5 --pressure 0 --contact-modulus 1GPa", "--pressure"},
      {"contact rough.h5 --pressure -1MPa --contact-modulus 1GPa", "--pressure"},
      {"contact rough.h5 --mean-gap 1m --contact-modulus 1GPa", "--mean-gap"},
      {"contact rough.h5 --contact-modulus 1GPa", "--pressure"},
      {"contact rough.h5 --pressure 1MPa --mean-gap 1nm --contact-modulus 1GPa", "--pressure"},
      {"contact rough.h5 --pressure 1MPa", "--contact-modulus"},
      {"contact rough.h5 --pressure 1MPa --contact-modulus 0", "--contact-modulus: 0"},
      {"contact rough.h5 --pressure 1MPa --young 1GPa", "--poisson"},
      {"contact rough.h5 --pressure 1MPa --contact-modulus 1GPa --tolerance 2", "tolerance"},
      {"contact rough.h5 --mean-gap 1nm,2nm --contact-modulus 1GPa",
       "--mean-gap: 2 values are given"},
      {"contact rough.h5 --pressure 1MPa,2MPa --contact-modulus 1GPa --fields none",
       "--fields: is of one position, and 2 are given"},
      {"contact rough.h5 --pressure 1MPa --contact-modulus 1GPa --groups 2",
       "--groups: is of several positions"},
      {"contact rough.h5 --pressure 1MPa --contact-modulus 1GPa --radius 1um",
       "--radius: is of summits; give --model gw_moments"},
      {"contact rough.h5 --model gw_moments --pressure 1MPa --contact-modulus 1GPa --hardness 1GPa",
       "--hardness: is of boundary elements; leave it out with --model gw_moments"},
      {"contact rough.h5 --model gw_moments --pressure 1MPa --contact-modulus 1GPa --radius 1um",
       "--radius: given together with a surface"},
      {"contact --model gw_deterministic --pressure 1MPa --contact-modulus 1GPa",
       "--model: gw_deterministic takes the summits of a surface"},
      {"contact rough.h5 --pressure 1MPa,0 --contact-modulus 1GPa", "--pressure"},
      {"contact rough.h5 --pressure 1MPa:2MPa:1 --contact-modulus 1GPa", "--pressure"},
      {"contact --model gw_moments rough.h5 --pressure -1 --contact-modulus 1GPa", "--pressure"},
      {"contact --model gw_moments --pressure 1MPa --contact-modulus 1GPa", "--summit-density"},
      {"contact --model gw_moments --summit-density 0 --radius 1um --summit-rms 1nm --pressure "
       "1MPa --contact-modulus "
       "1GPa",
       "--summit-density: 0 must"},
  }));
  INFO(options);
  check_refused(test.run(options + " -o result.h5"), expected);
  CHECK(test.files() == std::set<std::string>{"rough.h5"});
}

TEST_CASE("An existing output is refused before any work, and replaced with --overwrite",
          "[bad-input]") {
  const ProgramTest test;
  test.write("rough.h5", "precious");
  check_refused(test.run(recipe + "-o rough.h5"), "--overwrite");
  CHECK(test.read("rough.h5") == "precious");
  // The input is not even looked at.
  check_refused(test.run("contact absent.h5 --pressure 1MPa --contact-modulus 1GPa -o rough.h5"),
                "--overwrite");
  check_refused(test.run(recipe + "-o absent/rough.h5"), "absent");
  check_refused(test.run(recipe + "-o ."), ".");
  CHECK(test.files() == std::set<std::string>{"rough.h5"});
  CHECK(test.run(recipe + "-o rough.h5 --overwrite").status == 0);
  CHECK(test.run("statistics rough.h5").status == 0);
}

TEST_CASE("A curve's file that names no format is refused before the surface is read",
          "[bad-input]") {
  const ProgramTest test;
  for (const char* command :
       {"contact absent.h5 --pressure 1:2MPa:4 --contact-modulus 1GPa -o x.dat",
        "contact --model gw_moments absent.h5 --pressure 1:2MPa:4 --contact-modulus 1GPa -o x.dat"})
    check_refused(test.run(command), "x.dat: has the extension '.dat'");
}

TEST_CASE("A surface's file that names no format is refused before the work", "[bad-input]") {
  const ProgramTest test;
  for (
      const char* command :
      {"generate --points 64 --size-x 1um --shape cone --radius 1um --composite absent.h5 -o x.foo",
       "convert absent.h5 x.foo",
       "contact absent.h5 --pressure 1MPa --contact-modulus 1GPa --hardness 1GPa --residual x.foo"})
    check_refused(test.run(command), "x.foo: has the extension '.foo'");
}

TEST_CASE("All missing options are named at once", "[bad-input]") {
  const ProgramTest test;
  test.write("scan.txt", "1 2 3 4\n4 5 6 7\n7 8 9 5\n");
  const auto study = test.run("study --surface scan.txt");
  for (const char* option :
       {"--contact-modulus", "--poisson", "--normal-amplitude", "--drag-velocity", "--frequency"})
    check_refused(study, option);
  const auto two = test.run(
      "damping --law exponential --normal-force 1 --decay-length 1um "
      "--poisson 0.3 --mode two-frequencies --normal-amplitude 1nm");
  for (const char* option :
       {"--tangential-amplitude", "--phase", "--tangential-frequency", "--frequency"})
    check_refused(two, option);
  const auto contact = test.run("contact");
  for (const char* option : {"SURFACE (or --recipe)", "--pressure (or", "--contact-modulus"})
    check_refused(contact, option);
  const auto none = test.run("generate");
  for (const char* option : {"--points", "--size-x"}) check_refused(none, option);
}

TEST_CASE("What is called otherwise elsewhere is answered with its name", "[bad-input]") {
  const ProgramTest test;
  check_refused(test.run("contact scan.txt --force 10N"),
                "(did you mean --normal-force or --pressure?)");
  check_refused(test.run("damping --law exponential --load 3N"),
                "(did you mean --normal-force or --pressure?)");
  check_refused(test.run("study --force 10N"), "(did you mean --pressures?)");
  check_refused(test.run("contact scan.txt --E 210GPa"),
                "(did you mean --contact-modulus or --young?)");
  check_refused(test.run("contact scan.txt --pressures 1MPa"), "(did you mean --pressure?)");
  check_refused(test.run("contact scan.txt --separations 1nm"), "(did you mean --mean-gap?)");
  check_refused(test.run("contact scan.txt --summits moments"), "(did you mean --model?)");
  check_refused(test.run("roughness scan.txt"), "is not a command (did you mean statistics?)");
}

TEST_CASE("A decimal comma and a missing Poisson's ratio are told as such", "[bad-input]") {
  const ProgramTest test;
  const std::string contact = "contact scan.txt --pressure 1MPa ";
  for (const std::string modulus : {"--young 210GPa", "--contact-modulus 115GPa"})
    check_refused(test.run(contact + modulus + " --poisson 0,3"),
                  "--poisson: 0,3 has 2 values for 1 elastic body: a comma separates two bodies; "
                  "write a decimal point, as in 0.3");
  check_refused(test.run(contact + "--young 210GPa"), "--poisson: not given");
  check_refused(test.run(contact + "--young 210GPa,70GPa --poisson 0.3"), "--poisson: 0.3 is one");
}

TEST_CASE("A surface in the place of a study file is told as such", "[bad-input]") {
  const ProgramTest test;
  test.write("scan.csv", "1.5e-9,2e-9\n3e-9,4e-9\n");
  check_refused(test.run("study scan.csv"),
                "CONFIG: scan.csv is a surface, no study file; give it as --surface scan.csv");
  REQUIRE(test.run(recipe + "-o scan.h5 --quiet").status == 0);
  check_refused(test.run("compare scan.h5"), "give it as --surface scan.h5");
  test.write("broken.toml", "[surface]\npoints = \n");
  check_refused(test.run("study broken.toml"), "broken.toml:2");
}

TEST_CASE("A name that has changed is answered with the new one", "[bad-input]") {
  const ProgramTest test;
  check_refused(test.run("oscillate --shape ellipsoid --contact-modulus 1GPa --poisson 0.3"),
                "(did you mean elliptic-paraboloid?)");
}

TEST_CASE("On a full disk nothing half-written stays", "[bad-input]") {
  const ProgramTest test;
  // The limit of file size stands in for the disk: 4 KiB, where the heights alone take 32 KiB.
  for (const std::string name : {"rough.h5", "rough.npy", "rough.txt"}) {
    INFO(name);
    const auto result = test.run(recipe + "-o " + name, "ulimit -f 8;");
    CHECK(result.status == 1);
    CHECK_THAT(result.err, Catch::Contains("salebra: error: ") && Catch::Contains(name));
    CHECK(test.files().empty());
  }
}

TEST_CASE("Input that is allowed and most likely a slip is computed with a warning",
          "[bad-input]") {
  const ProgramTest test;
  const std::string surface = " --hurst 0.8 --rolloff 0.5um --short-cutoff 250nm --rms-height 1nm ";
  REQUIRE(test.run("generate --points 16 --size-x 1um -o s.h5" + surface).status == 0);
  const auto warns = [&](const std::string& command, const std::string& part) {
    const auto result = test.run(command);
    INFO(result.err);
    CHECK(result.status == 0);
    CHECK_THAT(result.err, Catch::Contains("salebra: warning: " + part));
    CHECK(test.run(command + " --quiet --overwrite").err.empty());
  };
  warns("contact s.h5 --pressure 1MPa --contact-modulus 1.15e6",
        "a nominal pressure of 1 MPa is 0.87 times E* = 1.15 MPa");
  warns("contact s.h5 --pressure 1MPa,20GPa --contact-modulus 100GPa",
        "a nominal pressure of 20 GPa is 0.2 times E* = 100 GPa");
  warns("statistics s.h5 --size-x 2um", "size_x: 2 µm was given, and s.h5 states 1 µm");
  warns("generate --points 16,16 --size-x 1um --size-y 1nm -o thin.h5" + surface,
        "cells of 62.5 nm x 62.5 pm have sides of 1000 to 1");
  warns("statistics thin.h5", "cells of 62.5 nm x 62.5 pm");
  // A scan in micrometres whose unit nobody gave, in every command that reads a surface.
  REQUIRE(test.run("generate --points 32 --size-x 10um -o r.h5 --hurst 0.8 --rolloff 5um "
                   "--short-cutoff 1.2um --rms-height 60nm --quiet")
              .status == 0);
  REQUIRE(test.run("convert r.h5 r.txt").status == 0);
  std::istringstream lines(test.read("r.txt"));
  std::string scan;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream row(line);
    for (double height; row >> height;) scan += std::to_string(1e6 * height) + ' ';
    scan += '\n';
  }
  test.write("um.txt", scan);
  const std::string size = " --size-x 10um --size-y 10um ";
  const std::string steel = "--contact-modulus 115GPa --poisson 0.3 ";
  const std::string motion = "--normal-amplitude 2nm --drag-velocity 1um/s --frequency 20kHz ";
  const std::string doubt =
      "um.txt: rms slope 1.04e+05 is above 1: heights in \u00b5m? rms slope would be 0.1; see "
      "--height-unit";
  for (const std::string command :
       {"statistics um.txt", "convert um.txt um.nc",
        "contact um.txt --pressure 1GPa --contact-modulus 115GPa",
        "contact um.txt --pressure 1GPa,2GPa --contact-modulus 115GPa",
        "contact --model gw_moments um.txt --pressure 1MPa,2MPa --contact-modulus 115GPa"})
    warns(command + size, doubt);
  warns("study --surface um.txt --no-stick --levels 0 " + size + steel + motion, doubt);
  CHECK_THAT(test.run("study --dry-run --surface um.txt" + size + steel + motion).out,
             Catch::Contains(doubt));
  CHECK(test.run("statistics um.txt --height-unit um" + size).err.empty());
  // Loads of a study: E*h' was 0.01 times E*, of which these are 10 to 20 times as much.
  warns("study --surface r.h5 --no-stick --levels 0 --pressures 12GPa,15GPa,18GPa,21GPa " + steel +
            motion,
        "a nominal pressure of 21 GPa is 0.18 times E* = 115 GPa");
  // Within what is usual nothing is said.
  CHECK(test.run("contact s.h5 --pressure 9MPa --contact-modulus 100MPa").err.empty());
  CHECK(test.run("statistics s.h5 --size-x 1.0001um").err.empty());
}

TEST_CASE("A value of a hundred thousand letters is quoted in part", "[bad-input]") {
  const ProgramTest test;
  const std::string word(100'000, 'x'), values = "1MPa" + word;
  // As arguments of several kinds, of the library and of the parser, and in a file.
  test.write("study.toml", replaced(study, "\"0.1nm\"", "\"" + word + "\""));
  test.write("names.toml", replaced(study, "points", word + " = 1\npoints"));
  for (const std::string& arguments :
       {"contact --model gw_moments --pressure " + values, "damping --law " + word,
        "damping --" + word + " 1", "generate --size-x 1um --points " + word,
        "generate --seed " + word, word, "statistics " + word, "verify --threads " + word,
        "verify " + word, std::string("study study.toml"), std::string("study names.toml")}) {
    INFO(arguments.substr(0, 30));
    const auto result = test.run(arguments);
    CHECK(result.status == 2);
    CHECK(result.err.size() < 2600);
    CHECK_THAT(result.err, Catch::Contains("x\u2026x"));
  }
}
