// SPDX-License-Identifier: GPL-3.0-or-later
// Studies in processes of their own, to be killed, and what they have finished.
#include "study_parts.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <regex>
#include <system_error>

#include "study/study_text.hpp"

namespace fs = std::filesystem;

std::string study_of(int seeds) {
  return std::regex_replace(
      std::regex_replace(study_text("seed_count = " + std::to_string(seeds), 5),
                         std::regex("hurst = 0.8\n"), ""),
      std::regex("\\[contact\\]"),
      "[ensemble]\nhurst = [0.5, 0.8]\n[contact]\ntangential_stiffness = \"proportional\"");
}

std::size_t parts_in(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code gone;
  for (fs::directory_iterator entry(folder, gone), end; !gone && entry != end;
       entry.increment(gone))
    count += entry->path().extension() == ".realisation";
  return count;
}

pid_t start_study(const ProgramTest& test, const std::vector<const char*>& options) {
  std::vector<const char*> words{"salebra", "study", "study.toml", "-o", "result.h5"};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  const int silence = open("/dev/null", O_WRONLY);
  dup2(silence, 1);
  dup2(silence, 2);
  if (chdir(test.folder().c_str()) != 0) _exit(99);
  execv(SALEBRA_PROGRAM, const_cast<char* const*>(words.data()));
  _exit(99);
}
