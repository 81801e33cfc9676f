// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace salebra::cli {

/// The files that one run of a command reads and writes. Compared are the files, not their names:
/// "a.h5", "./a.h5" and a link to it are one.
class NamedFiles {
 public:
  /// option: names the file in messages. Throws InvalidInput where the file is written too.
  void reads(std::string_view option, const std::filesystem::path& file);
  /// Throws InvalidInput where the file is read or written under another option, `partner`
  /// excepted.
  void writes(std::string_view option, const std::filesystem::path& file,
              std::string_view partner = "");
  /// A file that is opened for reading, whoever named it: an option, or a file that an option names.
  /// Throws InvalidInput where it is written too. Checkpoints and the fields of a cycle are excepted,
  /// which their command reads itself to go on.
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

/// Whether both names are of one file, also where it is not there yet.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace salebra::cli
