// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <salebra/io/output.hpp>
#include <string_view>

namespace salebra::detail {

/// A file that appears under its name complete or not at all. Throws IoError for what the system refuses.
class AtomicFile {
 public:
  /// Creates the temporary file beside its target. Throws as require_output does.
  AtomicFile(const std::filesystem::path& target, const WriteOptions& options);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes the temporary file unless it was committed.
  ~AtomicFile();

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Appends.
  void write(std::string_view bytes);
  /// Makes sure that the file can grow to that many bytes, and makes it so long.
  void reserve(std::uint64_t bytes);
  void resize(std::uint64_t bytes);
  /// Flushes to the disk and renames.
  void commit();

 private:
  [[noreturn]] void fail(const char* doing, int error) const;

  std::filesystem::path target_, temporary_;
  bool overwrite_;
  int descriptor_ = -1;
};

}  // namespace salebra::detail
