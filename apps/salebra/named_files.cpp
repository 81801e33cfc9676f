// SPDX-License-Identifier: GPL-3.0-or-later
// The files that a command reads and writes (named_files.hpp).
#include "named_files.hpp"

#include <fmt/format.h>

#include <salebra/base/error.hpp>

namespace salebra::cli {
namespace {

// Path of a file: its folder with all links resolved, and its name. If the name itself is a link it
// is not resolved, because a writer would replace the link and not the file behind it.
std::filesystem::path place_of(const std::filesystem::path& file) {
  std::error_code error;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const auto canonical = std::filesystem::weakly_canonical(folder, error);
  return (error ? folder.lexically_normal() : canonical) / file.filename();
}

}  // namespace

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  return std::filesystem::equivalent(a, b, error) || place_of(a) == place_of(b);
}

void NamedFiles::add(Named named) {
  for (const Named& other : named_) {
    if (!(named.written || other.written) || named.option == other.option ||
        named.partner == other.option || other.partner == named.option ||
        !same_file(named.file, other.file))
      continue;
    const auto& [field, too] = named.written ? std::pair(named, other) : std::pair(other, named);
    throw InvalidInput(field.option, field.file.string(),
                       fmt::format("is also the file of {}; name another file", too.option));
  }
  named_.push_back(std::move(named));
}

void NamedFiles::reads(std::string_view option, const std::filesystem::path& file) {
  add({std::string(option), "", file, false});
}

void NamedFiles::writes(std::string_view option, const std::filesystem::path& file,
                        std::string_view partner) {
  add({std::string(option), std::string(partner), file, true});
}

void NamedFiles::opens(const std::filesystem::path& file) const {
  for (const Named& named : named_)
    if (named.written && named.option != "--checkpoint" && named.option != "--fields" &&
        same_file(named.file, file))
      throw InvalidInput(named.option, named.file.string(),
                         "is also read by this command; name another file");
}

}  // namespace salebra::cli
