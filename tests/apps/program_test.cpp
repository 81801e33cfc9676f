// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <salebra/base/version.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "run_program.hpp"

using Catch::Contains;

TEST_CASE("The program tells its version", "[program]") {
  const auto result = ProgramTest().run("--version");
  CHECK(result.status == 0);
  CHECK(result.out == "salebra " + std::string(salebra::version()) + "\n");
}

TEST_CASE("What a report of a fault needs is printed at once", "[program]") {
  const auto result = ProgramTest().done("--version --verbose");
  CHECK(result.err.empty());
  for (const std::string line :
       {"salebra " + std::string(salebra::version()), std::string("revision "),
        "arithmetic " + salebra::arithmetic(), std::string("libraries  Eigen "),
        std::string("build "), std::string("threads "), std::string("processes  one"),
        std::string("system     Linux ")})
    CHECK_THAT("\n" + result.out, Contains("\n" + line));
}

TEST_CASE("Help of every command shows two examples, and the options that it has alone",
          "[program]") {
  const ProgramTest test;
  const std::string screen = test.run("--help").out;
  const auto command =
      GENERATE(as<std::string>(), "generate", "convert", "contact", "fit", "damping", "sliding",
               "joint", "viscoelastic", "study", "verify", "init", "statistics", "compare",
               "oscillate", "export", "report", "completion");
  // The shell alone calls it.
  CHECK((screen.find(" " + command + "  ") < screen.find("Which")) == (command != "completion"));
  const auto help = test.done(command + " --help");
  CHECK(help.err.empty());
  CHECK_THAT(help.out, Contains("\nExamples:\n  salebra " + command));
  const auto second = help.out.find("  salebra " + command, help.out.find("Examples:") + 20);
  CHECK(second < help.out.find("\n\n", help.out.find("Examples:")));
  CHECK_THAT(help.out, !Contains("  --json") && Contains("salebra help options"));
}

TEST_CASE("The options of every command stand once", "[program]") {
  const std::string help = ProgramTest().run("help options").out;
  for (const char* option : {"--help", "--json", "-o, --output FILE", "--overwrite", "--threads",
                             "--quiet", "--progress NAME"})
    CHECK_THAT(help, Contains(option));
}

TEST_CASE("Help is what a bare call, help and --help show", "[program]") {
  const ProgramTest test;
  const auto help = test.done("--help");
  CHECK_THAT(help.out, Contains("Which command?"));
  for (const char* words : {"", "help"}) {
    test.done(words);
    CHECK(test.run(words).out == help.out);
  }
  CHECK(test.run("help statistics").out == test.run("statistics --help").out);
}

namespace {

// Characters of the longest line, a byte that continues one not counted.
std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0, length = 0;
  for (const char c : text) {
    length = c == '\n' ? 0 : length + ((c & 0xC0) != 0x80 ? 1 : 0);
    longest = std::max(longest, length);
  }
  return longest;
}

// One line, runs of blanks and backslashes as one blank.
std::string in_a_line(const std::string& text) {
  std::istringstream words(text);
  std::string line, word;
  while (words >> word)
    if (word != "\\") line += word + " ";
  return line;
}

}  // namespace

TEST_CASE("Help fits the width that it is given and loses no word", "[program]") {
  const ProgramTest test;
  for (const std::string command : {"", "damping", "generate", "statistics"}) {
    const auto wide = test.run("help " + command, "export COLUMNS=1000;");
    for (const int columns : {60, 80, 120}) {
      INFO(command << " in " << columns);
      const auto help =
          test.run("help " + command, "export COLUMNS=" + std::to_string(columns) + ";");
      CHECK(longest_line(help.out) <= std::size_t(columns));
      CHECK(in_a_line(help.out) == in_a_line(wide.out));
    }
  }
  // Without a terminal and COLUMNS the width is 80.
  CHECK(longest_line(test.run("help damping", "unset COLUMNS;").out) <= 80);
}

TEST_CASE("The chart of commands keeps its columns at 80, and README names commands", "[program]") {
  const ProgramTest test;
  const auto chart = [](const std::string& help) {
    const auto start = help.find("Which command?");
    return help.substr(start, help.find("Options of every command") - start);
  };
  const std::string screen = test.run("--help", "export COLUMNS=80;").out;
  CHECK(std::ranges::count(screen, '\n') <= 41);
  CHECK(chart(screen) == chart(test.run("--help", "export COLUMNS=1000;").out));

  // In the second column of its table, in backticks.
  std::ifstream readme(SALEBRA_README);
  std::vector<std::string> commands;
  for (std::string line; std::getline(readme, line);) {
    if (commands.empty() && line != "| question | command | guide |") continue;
    if (line.empty()) break;
    const auto column = line.find(" | ") + 3;
    std::istringstream cell(line.substr(column, line.find(" | ", column) - column));
    for (std::string command; std::getline(cell, command, '`') && std::getline(cell, command, '`');)
      commands.push_back(command);
    if (commands.empty()) commands.emplace_back("study");
  }
  REQUIRE(commands.size() > 10);
  for (const std::string& command : commands) {
    INFO(command);
    CHECK_THAT(screen, Contains(" " + command + "  "));
  }
}

TEST_CASE("A table that is wider than the text comes in parts with its first column", "[program]") {
  const ProgramTest test;
  test.run(
      "generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff 0.25mm "
      "--rms-height 1um -o rough.h5");
  const std::string sweep =
      "contact rough.h5 --contact-modulus 1GPa --poisson 0.3 --stiffness --pressure 1:10MPa:4";
  const auto wide = test.run(sweep, "export COLUMNS=300;"),
             narrow = test.run(sweep, "unset COLUMNS;");
  CHECK(longest_line(wide.out) > 80);
  CHECK(longest_line(narrow.out) <= 80);
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  CHECK(count(wide.out, "indentation") == 1);
  CHECK(count(narrow.out, "indentation") >= 2);
  for (const char* column : {"mean_gap", "pressure", "contact_area_fraction", "converged"})
    CHECK(count(narrow.out, column) == 1);
}

TEST_CASE("Quiet, a command leaves nothing on stderr but errors", "[program]") {
  const ProgramTest test;
  // Too coarse for its spectrum, which generate warns of.
  const std::string coarse =
      "generate --points 32 --size-x 10um --hurst 0.8 --rolloff 10um --short-cutoff 0.625um "
      "--rms-height 30nm -o rough.h5 --overwrite";
  CHECK_THAT(test.run(coarse).err, Contains("warning"));
  CHECK(test.run(coarse + " --quiet").err.empty());
  CHECK_THAT(test.run("statistics none.txt --quiet").err, Contains("error"));
}

TEST_CASE("This installation agrees with the analytic solutions", "[program][verify]") {
  const auto result = ProgramTest().run("verify --json");
  INFO(result.out);
  CHECK(result.status == 0);
  CHECK(result.err.empty());
  const auto answer = result.json();
  CHECK(keys(answer) == "checks");
  CHECK(answer["checks"].size() >= 12);
  for (const auto& check : answer["checks"]) {
    CHECK(keys(check) == "name value expected tolerance passed");
    CHECK(check["passed"] == true);
  }
}

TEST_CASE("A reader of the answer that has what it wanted makes no error", "[program]") {
  // The shell waits until the program that reads the pipe has gone.
  const auto result = ProgramTest().run("help damping", "mkfifo p; : <p & exec >p; wait;");
  CHECK(result.status == 0);
  CHECK(result.err.empty());
}

TEST_CASE("The version has a short option", "[program]") {
  const ProgramTest test;
  CHECK(test.run("-V").out == test.run("--version").out);
}

TEST_CASE("Warnings that cannot be printed stop no work, and an answer that cannot is an error",
          "[program]") {
  const ProgramTest test;
  const std::string surface =
      "generate --points 16 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 250nm "
      "--rms-height 10nm --progress always ";
  const auto status = [&](const std::string& arguments) { return test.run(arguments).status; };
  CHECK(status(surface + "2>/dev/full") == 0);
  CHECK(status(surface + "2>&-") == 0);
  CHECK(status("generate --points x 2>/dev/full") == 2);
  CHECK(status("generate --points x 2>&-") == 2);
  for (const char* command : {"--help", "--version", "generate --help", "help study"})
    for (const char* nowhere : {" >/dev/full", " >&-"}) {
      const auto result = test.run(command + std::string(nowhere));
      INFO(command << nowhere);
      CHECK(result.status == 1);
      CHECK(result.err ==
            "salebra: error: standard output: cannot be written; check the disk or the program "
            "that reads the pipe\n");
    }
}

TEST_CASE("What is printed never goes into an output file", "[program]") {
  const ProgramTest test;
  const auto result = test.run(
      "generate --points 16 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 250nm "
      "--rms-height 10nm --progress always -o surface.npy 0<&- 1>&- 2>&-");
  CHECK(result.status == 1);  // the answer was not printed
  test.done("statistics surface.npy");
}

TEST_CASE("SIGINT stops work that reports no progress", "[program]") {
  const ProgramTest test;
  test.done(
      "generate --points 2048 --size-x 1mm --hurst 0.8 --rolloff 0.25mm --short-cutoff 2um "
      "--rms-height 1um -o surface.h5");
  // Its tables take more than a second, and were printed with status 0.
  const auto result = test.run("statistics surface.h5 --all -o out.h5 --quiet --threads 1",
                               "(until grep -q '^SigCgt:.*[2367abef]$' /proc/$$/status; do sleep "
                               "0.01; done; sleep 0.2; kill "
                               "-INT $$) &");
  CHECK(result.status == 130);
  CHECK(result.out.empty());
  CHECK(test.files() == words("surface.h5"));
}

TEST_CASE("SIGINT stops every command that computes for long, and nothing is written",
          "[program]") {
  const ProgramTest test;
  const std::string law =
      "--law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 ";
  const std::string normal = "--normal-amplitude 2nm --frequency 20kHz ";
  const std::string sphere =
      "--law sphere --radius 5mm --indentation 20um --contact-modulus 4MPa --poisson 0.5 ";
  const std::string motion =
      "--mode equal-frequency --normal-amplitude 2um --tangential-amplitude 1um --phase 80deg "
      "--frequency 1kHz ";
  const std::string surface =
      "generate --points 4096 --size-x 1mm --hurst 0.8 --rolloff 0.25mm --short-cutoff 1um "
      "--rms-height 1um ";
  const std::string cylinder = "oscillate --shape cylinder --contact-modulus 1GPa --poisson 0.3 ";
  // Each takes a second to minutes; the slider because 1 kHz leaves it unstable, so that its
  // slow cycles are followed.
  for (const std::string& command :
       {"sliding " + law +
            "--normal-amplitude 2nm --frequency 1kHz --mass 10g --spring-stiffness 1kN/m "
            "--velocities 3um/s --falling-slope 1 --friction-coefficient 0.3 --tolerance 1e-6",
        "viscoelastic " + sphere + motion + "--prony 3MPa:1ms --steps 20000 --springs 20000",
        "damping " + sphere + motion + "--friction-coefficient 0.3 --steps 4000000",
        "damping " + law + normal +
            "--mode two-frequencies --tangential-amplitude 1nm --phase 0.5 --tangential-frequency "
            "10kHz --friction-coefficient 0.3 --steps 4000000",
        "joint " + law +
            "--friction-coefficient 0.3 --normal-amplitude 2nm --tangential-forces 3mN --steps "
            "400000",
        "sliding " + law +
            "--friction-coefficient 0.3 --frequency 20kHz --normal-amplitude 1:20nm:40 "
            "--velocity-ratios 0.001:0.9:4000",
        "damping " + law + "--normal-amplitude 1:20nm:2000 --frequency 1:100kHz:2000",
        cylinder + "--size-y 1m", cylinder + "--points 16 --intervals 4000", surface,
        surface + "--skewness 1 --kurtosis 5"}) {
    INFO(command);
    const auto start = std::chrono::steady_clock::now();
    // Once the program handles it: a signal before would end it at once.
    const auto result = test.run(command + " -o out.h5 --quiet --threads 1",
                                 "(until grep -q '^SigCgt:.*[2367abef]$' /proc/$$/status; do sleep "
                                 "0.01; done; sleep 0.05; kill -INT $$) &");
    CHECK(result.status == 130);
    // A second, and what a busy machine with sanitizers takes to start the program.
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(8));
    CHECK(result.out.empty());
    CHECK(std::ranges::count(result.err, '\n') == 1);
    CHECK(test.files().empty());
  }
}
