// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "run_program.hpp"

using Catch::Contains;

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

/// The rows for which one with {a|b} stands.
std::vector<std::string> alternatives(const std::string& row) {
  const auto begin = row.find('{'), end = row.find('}', begin);
  if (begin == std::string::npos) return {row};
  std::vector<std::string> all;
  std::istringstream choices(row.substr(begin + 1, end - begin - 1) + "|");
  for (std::string choice; std::getline(choices, choice, '|');)
    for (const std::string& rest : alternatives(row.substr(end + 1)))
      all.push_back(row.substr(0, begin) + choice + rest);
  return all;
}

}  // namespace

TEST_CASE("Each mistake of the table is answered in one line, and nothing is written",
          "[bad-input]") {
  const ProgramTest test;
  test.done(recipe + "--seed 3 -o rough.h5");
  test.done(
      "contact rough.h5 --pressure 2:60MPa:8 --stiffness --contact-modulus 10GPa --poisson 0.3 -o "
      "curve.h5");
  test.write("study.toml", study);
  test.write("hirst.toml", replaced(study, "hurst", "hirst"));
  test.write("scan.txt", "1 2 3 4\n4 5 6 7\n7 8 9 5\n");
  std::string shell = "surfaces='" SALEBRA_SURFACES "'; ";
  Names files;
  int mistakes = 0;
  std::ifstream table(SALEBRA_MISTAKES);
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const auto arrow = line.find(" => ");
    if (arrow == std::string::npos) {
      shell += line + "; ";
      test.done("--version", shell);
      files = test.files();
      continue;
    }
    for (const std::string& command : alternatives(line.substr(0, arrow))) {
      INFO(command);
      const auto result = test.run(command, shell);
      for (auto at = arrow; at != std::string::npos; at = line.find(" => ", at + 4))
        check_refused(result, line.substr(at + 4, line.find(" => ", at + 4) - at - 4));
      CHECK(test.files() == files);
      ++mistakes;
    }
  }
  CHECK(mistakes > 300);
}

TEST_CASE("Files that are not what they seem are read with a warning or refused with what helps",
          "[bad-input]") {
  const ProgramTest test;
  // A folder without salebra-import, with the shell's own programs.
  std::string shell = "PATH=/usr/bin:/bin; ";
  Names files;
  int answers = 0;
  std::ifstream table(SALEBRA_FILE_MISTAKES);
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const bool refused = line.find(" => ") != std::string::npos;
    const std::string arrow = refused ? " => " : " ->";
    const auto end = line.find(arrow);
    if (end == std::string::npos) {
      shell += line + "; ";
      test.done("--version", shell);
      files = test.files();
      continue;
    }
    for (const std::string& command : alternatives(line.substr(0, end))) {
      INFO(command);
      const auto result = test.run(command, shell);
      if (!refused && line.size() == end + arrow.size()) CHECK(result.err.empty());
      for (auto at = end; at < line.size() && at != std::string::npos;) {
        const auto next = line.find(arrow, at + arrow.size());
        const std::string part =
            line.substr(at + arrow.size(), next - std::min(next, at + arrow.size()));
        if (refused)
          check_refused(result, part);
        else
          CHECK_THAT(result.err, Contains(part.substr(std::min<std::size_t>(part.size(), 1))));
        at = next;
      }
      if (!refused) CHECK(result.status == 0);
      if (refused) CHECK(test.files() == files);
      files = test.files();
      ++answers;
    }
  }
  CHECK(answers > 40);
}

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
      // Fewer than three pressures are in the window.
      {"relative_pressures = \"1e-3:0.2:8\"",
       "pressures = \"1MPa:1GPa:8\"\n[fit]\npressure_window = [\"1MPa\", \"3MPa\"]",
       "study.toml:17: fit.pressure_window"},
  }));
  INFO(expected);
  test.write("study.toml", replaced(study, from, to));
  check_refused(test.run("study study.toml -o result.h5"), expected);
  CHECK(test.files() == "study.toml");
}

TEST_CASE("Surfaces that are absent, truncated or without a size are refused", "[bad-input]") {
  const ProgramTest test;
  const std::string rest = " --pressure 1MPa --contact-modulus 1GPa -o result.h5";
  test.write("heights.txt", "1 2 3 4\n4 5 6 7\n7 8 9 5\n");

  test.done(recipe + "-o rough.h5");
  test.done(recipe + "-o rough.npy");
  for (const std::string name : {"rough.h5", "rough.npy"}) {
    INFO(name);
    const std::string whole = test.read(name);
    test.write("cut-" + name, whole.substr(0, whole.size() / 2));
    check_refused(test.run("contact cut-" + name + " --size-x 1um --size-y 1um" + rest),
                  "cut-" + name);
  }
  CHECK(!test.files().contains("result.h5"));
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
  CHECK(test.files() == "rough.h5");
  test.done(recipe + "-o rough.h5 --overwrite");
  test.done("statistics rough.h5");
}

TEST_CASE("On a full disk nothing half-written stays", "[bad-input]") {
  const ProgramTest test;
  // The limit of file size stands in for the disk: 4 KiB, where the heights alone take 32 KiB.
  for (const std::string name : {"rough.h5", "rough.npy", "rough.txt"}) {
    INFO(name);
    const auto result = test.run(recipe + "-o " + name, "ulimit -f 8;");
    CHECK(result.status == 1);
    CHECK_THAT(result.err, Contains("salebra: error: ") && Contains(name));
    CHECK(test.files().empty());
  }
}

TEST_CASE("Input that is allowed and most likely a slip is computed with a warning",
          "[bad-input]") {
  const ProgramTest test;
  const std::string surface = " --hurst 0.8 --rolloff 0.5um --short-cutoff 250nm --rms-height 1nm ";
  test.done("generate --points 16 --size-x 1um -o s.h5" + surface);
  const auto warns = [&](const std::string& command, const std::string& part) {
    const auto result = test.run(command);
    INFO(result.err);
    CHECK(result.status == 0);
    CHECK_THAT(result.err, Contains("salebra: warning: " + part));
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
  test.done(
      "generate --points 32 --size-x 10um -o r.h5 --hurst 0.8 --rolloff 5um --short-cutoff 1.2um "
      "--rms-height 60nm --quiet");
  test.done("convert r.h5 r.txt");
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
       {"statistics um.txt", "convert um.txt um.npy",
        "contact um.txt --pressure 1GPa --contact-modulus 115GPa",
        "contact um.txt --pressure 1GPa,2GPa --contact-modulus 115GPa",
        "contact --model gw_moments um.txt --pressure 1MPa,2MPa --contact-modulus 115GPa"})
    warns(command + size, doubt);
  warns("study --surface um.txt --no-stick --levels 0 " + size + steel + motion, doubt);
  CHECK_THAT(test.run("study --dry-run --surface um.txt" + size + steel + motion).out,
             Contains(doubt));
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
    CHECK_THAT(result.err, Contains("x\u2026x"));
  }
}
