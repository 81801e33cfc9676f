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

/// The parts that a message must have: what stands behind each arrow.
std::vector<std::string> expected_parts(const std::string& line, const std::string& arrow) {
  std::vector<std::string> found;
  for (auto at = line.find(arrow); at != std::string::npos;) {
    const auto end = line.find(arrow, at += arrow.size());
    found.push_back(line.substr(at, end - at));
    at = end;
  }
  return found;
}

/// Runs the commands of a table and checks what they say of each mistake; how many they are.
int check_table(const ProgramTest& test, const std::string& name, std::string shell = "") {
  shell += "surfaces='" SALEBRA_SURFACES "'; ";
  int answers = 0;
  std::ifstream table(SALEBRA_TABLES "/" + name);
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const bool refused = line.find(" => ") != std::string::npos,
               warned = !refused && line.find(" -> ") != std::string::npos;
    const std::string arrow = refused ? " => " : warned ? " -> " : " ->";
    const auto end = line.find(arrow);
    if (end == std::string::npos) {
      if (line.starts_with("! "))
        test.done("--version", shell + line.substr(2) + ";");
      else
        shell += line + "; ";
      continue;
    }
    for (std::string command : alternatives(line.substr(0, end))) {
      INFO(command);
      const auto border = command.find(" ;; ");
      const std::string before = border == command.npos ? "" : command.substr(0, border) + ";";
      if (border != command.npos) command.erase(0, border + 4);
      const Names files = test.files();
      const auto result = test.run(command, shell + before);
      ++answers;
      if (refused) {
        for (const std::string& part : expected_parts(line, arrow)) check_refused(result, part);
        CHECK(test.files() == files);
        continue;
      }
      CHECK(result.status == 0);
      // A wave has no Hurst exponent, which is not what the line is about.
      if (!warned) CHECK((result.err.empty() || result.err.starts_with("no Hurst exponent")));
      for (const std::string& part :
           warned ? expected_parts(line, arrow) : std::vector<std::string>{})
        CHECK_THAT(result.err, Contains(part));
      if (warned) CHECK(test.run(command + " --quiet --overwrite", shell).err.empty());
    }
  }
  return answers;
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
  test.write("scan.txt", "1 2 3 4\n4 5 6 7\n7 8 9 5\n");
  const std::string surface = test.read("rough.h5"), curve = test.read("curve.h5");
  CHECK(check_table(test, "mistakes.txt") > 350);
  CHECK(test.read("rough.h5") == surface);
  CHECK(test.read("curve.h5") == curve);
}

TEST_CASE("Files that are not what they seem are read with a warning or refused with what helps",
          "[bad-input]") {
  const ProgramTest test;
  // A folder without salebra-import, with the shell's own programs.
  CHECK(check_table(test, "file_mistakes.txt", "PATH=/usr/bin:/bin; ") > 85);
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
