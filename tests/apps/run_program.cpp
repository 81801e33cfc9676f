// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_program.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace {

std::string slurp(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

bool Names::operator==(const std::string& listed) const { return *this == words(listed); }

Names words(const std::string& listed) {
  std::istringstream text(listed);
  Names names;
  for (std::string name; text >> name;) names.insert(name);
  return names;
}

ProgramTest::ProgramTest() {
  std::string name = (fs::temp_directory_path() / "salebra-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

ProgramTest::~ProgramTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::remove_all(folder_.string() + ".streams", ignored);
}

ProgramTest::Result ProgramTest::run(const std::string& arguments,
                                     const std::string& before) const {
  // The streams lie beside the folder: what is in the folder came from the program or the test.
  const fs::path streams = folder_.string() + ".streams";
  fs::create_directory(streams);
  const std::string command =
      fmt::format("exec >'{0}/out' 2>'{0}/err'; cd '{1}'; export COLUMNS=1000; {2} exec '{3}' {4}",
                  streams.string(), folder_.string(), before, SALEBRA_PROGRAM, arguments);
  const int raw = std::system(command.c_str());
  Result result;
  result.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : -WTERMSIG(raw);
  result.out = slurp(streams / "out");
  result.err = slurp(streams / "err");
  return result;
}

ProgramTest::Result ProgramTest::done(const std::string& arguments,
                                      const std::string& before) const {
  Result result = run(arguments, before);
  INFO(arguments << "\n" << result.err);
  REQUIRE(result.status == 0);
  return result;
}

nlohmann::json ProgramTest::answer(const std::string& arguments) const {
  return done(arguments + " --json").json();
}

void ProgramTest::write(const std::string& file, const std::string& text) const {
  std::ofstream(folder_ / file, std::ios::binary) << text;
}

std::string ProgramTest::read(const std::string& file) const { return slurp(folder_ / file); }

Names ProgramTest::files() const {
  Names names;
  for (const auto& entry : fs::directory_iterator(folder_))
    names.insert(entry.path().filename().string());
  return names;
}

void check_refused(const ProgramTest::Result& result, const std::string& part) {
  CHECK(result.status == 2);
  CHECK(result.out.empty());
  CHECK_THAT(result.err, Catch::StartsWith("salebra: error: "));
  CHECK_THAT(result.err, Catch::Contains(part));
  CHECK(std::ranges::count(result.err, '\n') == 1);
}

Names keys(const nlohmann::json& object) {
  Names names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

double number(const nlohmann::json& answer, const std::string& path) {
  return answer.at(nlohmann::json::json_pointer(path));
}
