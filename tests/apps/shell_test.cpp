// SPDX-License-Identifier: GPL-3.0-or-later
// What meets a person at the keyboard: the first study file, the cost of a run before it is run,
// suggestions, help, completion, colours.
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "run_program.hpp"
#include "study/study_text.hpp"

using Catch::Contains;

namespace {

/// Keys that a table of a study file knows, as the reader itself tells them of a key that it does
/// not know.
std::vector<std::string> known_keys(const ProgramTest& test, const std::string& table,
                                    const std::string& others) {
  test.write("unknown.toml", others + "[" + table + "]\nno_such_key = 1\n");
  const std::string error = test.run("study unknown.toml").err;
  INFO(error);
  const auto list = error.find("known here are ");
  REQUIRE(list != std::string::npos);
  std::vector<std::string> keys;
  std::istringstream words(error.substr(list + 15));
  for (std::string word; words >> word;) keys.push_back(word.substr(0, word.find_first_of(",\n")));
  return keys;
}

/// All that the program writes to a terminal as its standard streams.
std::string on_a_terminal(const std::string& arguments, const std::string& environment) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  REQUIRE(child >= 0);
  if (child == 0) {
    const std::string command = environment + " exec '" + SALEBRA_PROGRAM + "' " + arguments;
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  std::string text;
  char part[4096];
  for (ssize_t count; (count = read(terminal, part, sizeof part)) > 0;)
    text.append(part, static_cast<std::size_t>(count));
  close(terminal);
  waitpid(child, nullptr, 0);
  return text;
}

const std::string small_study = study_text("seeds = [3, 4, 5]", 5);

}  // namespace

TEST_CASE("A study file made by init is run by study as it is, and names every key", "[init]") {
  const ProgramTest test;
  const auto made = test.run("init my.toml");
  CHECK(made.status == 0);
  CHECK_THAT(made.out, Contains("salebra study my.toml"));
  const std::string text = test.read("my.toml");
  // What stands before a table is read before it.
  const std::string material = "[material]\ncontact_modulus = 1e9\npoisson = 0.3\n";
  const std::string loads = "[contact]\npressures = [1e5, 2e5, 3e5, 4e5]\n";
  const std::string motion =
      "[damping]\nnormal_amplitude = 1e-9\ndrag_velocity = 1e-3\nfrequency = 1e4\n";
  for (const auto& [table, others] : {std::pair<std::string, std::string>{"ensemble", ""},
                                      {"fit", material + loads},
                                      {"compare", material + loads + motion}}) {
    for (const std::string& key : known_keys(test, table, others)) {
      INFO(table << "." << key);
      CHECK(std::regex_search(text, std::regex("\n(# )?" + key + " = |also: [^\n]*" + key)));
    }
  }
  for (const std::string& key :
       words("points size_x size_y hurst rolloff long_cutoff short_cutoff rms_height rms_slope "
             "method seeds seed_count first_seed young contact_modulus tangential_modulus "
             "pressures relative_pressures tolerance tangential_stiffness mode "
             "tangential_amplitude phase angular_frequency hold"))
    CHECK(std::regex_search(text, std::regex("\n(# )?" + key + " = ")));
  // The file of init at 128² points: seconds, by the same text.
  std::string quick = std::regex_replace(text, std::regex("points = 512 "), "points = 128 ");
  quick = std::regex_replace(quick, std::regex("156.25nm"), "625nm");
  quick = std::regex_replace(quick, std::regex("1.25um"), "2.5um");
  test.write("quick.toml", quick);
  const auto run = test.run("study quick.toml --json --quiet");
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.json()["realisations"] == 4);
  check_refused(test.run("init my.toml"), "my.toml");
  test.done("init my.toml --overwrite");
}

TEST_CASE("What init offers for adhesion and conduction is accepted, word by word", "[init]") {
  const ProgramTest test;
  test.done("init my.toml");
  std::string text = test.read("my.toml");
  text = text.substr(0, text.find("\n[damping]"));
  text = std::regex_replace(
      text,
      std::regex("\n# (\\[(?:adhesion|conduction)\\]|(?:work_of_adhesion|range|potential|cycle|"
                 "force_coarse|conductivity|resistivity|flow_factors) = )"),
      "\n$1");
  const auto line = text.find("\npotential = ");
  REQUIRE(line != std::string::npos);
  const std::string potentials = text.substr(line + 1, text.find('\n', line + 1) - line - 1);
  const std::regex word("\"[^\"]+\"");
  int words = 0;
  for (auto found = std::sregex_iterator(potentials.begin(), potentials.end(), word);
       found != std::sregex_iterator(); ++found, ++words) {
    INFO(found->str());
    test.write("sticky.toml", text.substr(0, line) + "\npotential = " + found->str() +
                                  text.substr(line + 1 + potentials.size()));
    test.done("study sticky.toml --dry-run");
  }
  CHECK(words == 3);
}

TEST_CASE("init for a measured surface names it from where the study file lies", "[init]") {
  const ProgramTest test;
  test.done(
      "generate --points 32 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 125nm "
      "--rms-height 9nm --seed 2 -o scan.npy --quiet");
  test.done("init -o scan.toml --surface scan.npy");
  const std::string text = test.read("scan.toml");
  CHECK_THAT(text, Contains("\nfile = \"scan.npy\""));
  // A thirtieth of about 9 nm, to one digit.
  CHECK_THAT(text, Contains("normal_amplitude = \"0.3nm\""));
  const auto run = test.run("study scan.toml --dry-run --json");
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.json()["points"][0]["nx"] == 32);
  CHECK(test.files().count("other.toml") == 0);
}

TEST_CASE("The program's help lists the commands by what they are for", "[help]") {
  const std::string help = ProgramTest().run("--help").out;
  std::size_t before = 0;
  for (const char* heading :
       {"\nStart    init", "\nSurface  generate", "\nContact  contact", "\nDamping  damping"}) {
    CHECK(help.find(heading) > before);
    before = help.find(heading);
  }
  CHECK(before < help.find("\nFirst steps:"));
  CHECK_THAT(ProgramTest().run("contact --help").out, Contains("salebra fit for the decay length"));
}

TEST_CASE("bash completes commands, options and their choices", "[completion]") {
  const ProgramTest test;
  const auto script = test.run("completion bash -o salebra.bash");
  CHECK(script.status == 0);
  const auto complete = [&](const std::string& words, int place) {
    test.write("complete.sh", "source salebra.bash\nCOMP_WORDS=(" + words +
                                  ")\nCOMP_CWORD=" + std::to_string(place) +
                                  "\n_salebra\nprintf '%s\\n' \"${COMPREPLY[@]}\" >answer\n");
    const std::string command = "cd '" + test.folder().string() + "' && bash complete.sh 2>errors";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(test.read("errors").empty());
    return test.read("answer");
  };
  CHECK(complete("salebra stat", 1) == "statistics\n");
  CHECK(complete("salebra generate --short", 2) == "--short-cutoff\n");
  CHECK(complete("salebra verify --progress al", 3) == "always\n");
  CHECK(complete("salebra study comp", 2) == "complete.sh\n");
  CHECK_THAT(test.run("completion zsh").out,
             Contains("#compdef salebra") && Contains("'*--short-cutoff[") && !Contains("{}"));
}

TEST_CASE("Colours are for terminals, and for those who want them", "[colour]") {
  CHECK(ProgramTest().run("polish", "TERM=xterm").err.find('\033') == std::string::npos);
  CHECK_THAT(on_a_terminal("polish", "TERM=xterm NO_COLOR="), Contains("\033[1;31merror:\033[0m"));
  CHECK_THAT(on_a_terminal("polish", "TERM=xterm NO_COLOR=1"),
             Contains("salebra: error:") && !Contains("\033"));
  CHECK_THAT(on_a_terminal("polish", "TERM=dumb NO_COLOR="), !Contains("\033"));
  CHECK_THAT(on_a_terminal("verify --help", "TERM=xterm NO_COLOR=1"), !Contains("\033"));
}
