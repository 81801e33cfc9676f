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

TEST_CASE("A dry run of one surface states memory and time for any number of processes",
          "[dry-run]") {
  const ProgramTest test;
  // 65536² points of 200 GB: nothing of it is made.
  test.write("large.toml",
             std::regex_replace(small_study, std::regex("points = 64"), "points = 65536"));
  const auto answer = [&](const std::string& command) {
    const auto run = test.done(command + " --dry-run --json --quiet --threads 1");
    return run.json();
  };
  const std::string pressed = " --recipe large.toml --contact-modulus 1GPa ";
  const auto contact = answer("contact" + pressed + "--pressure 1MPa --ranks 256 --nodes 64");
  CHECK(contact["ranks"] == 256);
  CHECK(contact["nodes"] == 64);
  CHECK(contact["contacts"] == 1);
  CHECK(contact["network_seconds"] > 0);
  CHECK(contact["seconds"] > contact["network_seconds"]);
  CHECK(contact["memory_bytes"] > 48 * 65536.0 * 65536.0);
  CHECK(contact["memory_bytes_of_node"] == Approx(contact["memory_bytes"].get<double>() / 64));
  // The position is not the load: a gap has a time too.
  CHECK(answer("contact" + pressed + "--mean-gap 10nm")["seconds"] > 0);
  CHECK(answer("contact" + pressed + "--pressure 1MPa --ranks 2 --stiffness")["memory_bytes"] >
        answer("contact" + pressed + "--pressure 1MPa --ranks 2")["memory_bytes"]);

  const std::string swept = "contact" + pressed + "--poisson 0.3 --pressure 1MPa,2MPa,4MPa,8MPa ";
  const auto sweep = answer(swept + "--ranks 256 --groups 4");
  CHECK(sweep["groups"] == 4);
  CHECK(sweep["contacts"] == 4);
  CHECK(answer(swept + "--stiffness --stick")["seconds"] > answer(swept)["seconds"]);
  // No machine of this test holds four of them.
  CHECK(answer(swept + "--ranks 256")["groups"] == 1);
  test.write("small.toml", small_study);
  const std::string small =
      std::regex_replace(swept, std::regex("large"), "small") + "--dry-run --threads 1 ";
  const auto text = test.run(small + "--ranks 4");
  CHECK_THAT(text.out, Contains("64 x 64 points") && Contains("seed 1") &&
                           Contains("in 4 groups") && Contains("give or take 15 %") &&
                           Contains("idle machines"));
  CHECK_THAT(text.err, !Contains("rows for each process"));
  CHECK_THAT(test.run(small + "--ranks 8 --groups 1").err, Contains("8 rows for each process"));

  const auto generated = answer(
      "generate --points 65536 --size-x 1mm --hurst 0.8 --rolloff 100um --short-cutoff 1um "
      "--rms-height 1um --ranks 16 --nodes 16");
  CHECK(generated["contacts"] == 0);
  CHECK(generated["memory_bytes"] > 8 * 65536.0 * 65536.0);
  CHECK(test.files() == "large.toml small.toml");
}

TEST_CASE("A dry run tells what would run and does nothing of it", "[dry-run]") {
  const ProgramTest test;
  test.write("small.toml", small_study);
  const auto run = test.run("study small.toml --dry-run --json -o small.h5 --threads 1");
  INFO(run.err);
  CHECK(run.status == 0);
  const auto answer = run.json();
  CHECK(answer["surfaces"] == 3);
  CHECK(answer["contacts"] == 15);
  CHECK(answer["threads"] == 1);
  CHECK(answer["points"][0]["pressure"].size() == 5);
  CHECK(answer["seconds"] > 0);
  CHECK(answer["memory_bytes"] > 64 * 64 * 80);
  CHECK(test.files() == "small.toml");

  // Four times the cells: a little more than four times the time, for each route; two lists
  // multiply the points.
  const auto seconds = [&](const std::string& options) {
    return test.answer("study small.toml --dry-run --json --threads 1 " + options);
  };
  CHECK(seconds("")["points"].size() == 1);
  test.write("grid.toml", "[ensemble]\nhurst = [0.5, 0.8]\npoints = [64, 128]\n" +
                              std::regex_replace(small_study, std::regex("hurst = 0.8\n"), ""));
  const auto grid = test.answer("study grid.toml --dry-run --json --threads 1");
  REQUIRE(grid["points"].size() == 4);
  CHECK(grid["surfaces"] == 12);
  const double ratio = double(grid["points"][1]["seconds_of_one_thread"]) /
                       double(grid["points"][0]["seconds_of_one_thread"]);
  CHECK(ratio > 4);
  CHECK(ratio < 5);

  // A hundred times the surfaces, a hundred times the time; each run measures its own speed, on a
  // machine that may be busy.
  test.write("many.toml", study_text("seed_count = 300", 5));
  const auto many = test.answer("study many.toml --dry-run --json --threads 1");
  CHECK(many["surfaces"] == 300);
  CHECK(many["seconds"].get<double>() > 15 * answer["seconds"].get<double>());

  const auto compared = test.run("compare small.toml --dry-run --threads 1");
  CHECK(compared.status == 0);
  CHECK_THAT(compared.out, Contains("Persson") && Contains("15 solves"));
  CHECK_THAT(test.run("study small.toml --dry-run --no-stick").out, Contains("(G*/E*)K"));
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
