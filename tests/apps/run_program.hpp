// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

/// A set of names; it equals a text of them with blanks between, in any order.
struct Names : std::set<std::string> {
  bool operator==(const std::string& listed) const;
};
Names words(const std::string& listed);

/// Runs of the real program in a folder of its own, which is removed with the object.
class ProgramTest {
 public:
  ProgramTest();
  ~ProgramTest();
  ProgramTest(const ProgramTest&) = delete;
  ProgramTest& operator=(const ProgramTest&) = delete;

  struct Result {
    int status = 0;
    std::string out, err;

    /// The one JSON object on stdout; throws if there is anything else.
    nlohmann::json json() const { return nlohmann::json::parse(out); }
  };

  /// `salebra ARGUMENTS` in the folder; arguments as a shell takes them. before: shell commands
  /// such as "ulimit -f 1;".
  Result run(const std::string& arguments, const std::string& before = "") const;

  /// A run that must succeed.
  Result done(const std::string& arguments, const std::string& before = "") const;

  /// The answer of a run with --json that must succeed.
  nlohmann::json answer(const std::string& arguments) const;

  const std::filesystem::path& folder() const { return folder_; }
  void write(const std::string& file, const std::string& text) const;
  std::string read(const std::string& file) const;
  /// Names of what lies in the folder.
  Names files() const;

 private:
  std::filesystem::path folder_;
};

/// Bad input as the user must see it: status 2 and one line "salebra: error: …" that holds `part`;
/// stdout is empty.
void check_refused(const ProgramTest::Result& result, const std::string& part);

Names keys(const nlohmann::json& object);
/// The number there: "/curve/pressure/0".
double number(const nlohmann::json& answer, const std::string& path);
