// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <string_view>

/// Functions that write parts of TOML files with comments, which commands make as a start for the
/// user.
namespace salebra::cli {

/// A TOML string of a file name, in which special characters are escaped.
inline std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result + '"';
}

inline std::string toml_length(double metres) {
  return toml_string(fmt::format("{:.12g}nm", 1e9 * metres));
}

/// The line of a key with its value. If `value` is empty, the line has the example as value and is
/// commented out.
inline std::string key_or_choice(std::string_view key, const std::string& value,
                                 std::string_view example, std::string_view comment) {
  return value.empty() ? fmt::format("# {} = {}  # {}", key, example, comment)
                       : fmt::format("{} = {}  # {}", key, value, comment);
}

/// The name of a file relative to the folder of `list`, the list of scans or the study file that
/// names it.
inline std::string toml_file(const std::string& file, const std::string& list) {
  namespace fs = std::filesystem;
  const fs::path found = fs::absolute(file);
  const fs::path name = fs::relative(found, fs::absolute(list).parent_path());
  return toml_string((name.empty() ? found : name).string());
}

}  // namespace salebra::cli
