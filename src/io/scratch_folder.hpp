// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <salebra/base/error.hpp>
#include <string>

namespace salebra::detail {

/// A temporary folder for the files of another program; the destructor removes it. Throws IoError if
/// it cannot be made. purpose: part of its name.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& purpose)
      : path_(std::filesystem::temp_directory_path() / ("salebra-" + purpose + "-XXXXXX")) {
    std::string name = path_.string();
    if (mkdtemp(name.data()) == nullptr)
      throw IoError(path_.string() + ": cannot be made (" + std::strerror(errno) + ")");
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace salebra::detail
