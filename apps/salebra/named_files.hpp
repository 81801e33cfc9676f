// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace salebra::cli {

/// The files that one run of a command reads and writes. It compares files, not names: "a.h5",
/// "./a.h5" and a link to it are the same file.
class NamedFiles {
 public:
  /// Adds a file to read. option: how messages name it. Throws InvalidInput if the file is also
  /// written.
  void reads(std::string_view option, const std::filesystem::path& file);
  /// Adds a file to write. Throws InvalidInput if the file is also read or written under another
  /// option, except under the option `partner`.
  void writes(std::string_view option, const std::filesystem::path& file,
              std::string_view partner = "");
  /// Checks a file that is opened for reading, whether an option names it or a file that an option
  /// names. Throws InvalidInput if it is also written. Checkpoints and fields of a cycle are
  /// exceptions: their command reads them to continue.
  void opens(const std::filesystem::path& file) const;

 private:
  struct Named {
    std::string option, partner;
    std::filesystem::path file;
    bool written;
  };
  void add(Named named);

  std::vector<Named> named_;
};

/// Whether two names, which need not exist yet, mean the same file.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace salebra::cli
