// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/io/output.hpp>
#include <string_view>

#include "checksum.hpp"

namespace salebra::detail {

/// A file that appears under its name complete or not at all. Throws IoError for what the system refuses.
class AtomicFile {
 public:
  /// Creates the temporary file beside its target. Throws as require_output does.
  AtomicFile(const std::filesystem::path& target, const WriteOptions& options);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes the temporary file unless it was put in its place.
  ~AtomicFile();

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Appends.
  void write(std::string_view bytes);
  /// Flushes to the disk, reads the bytes back and closes: what can fail for want of space or by a fault of the disk.
  void finish();
  /// Renames the finished file.
  void place();
  bool placed() const { return placed_; }
  void commit() {
    finish();
    place();
  }

 private:
  void read_back() const;
  [[noreturn]] void fail(const char* doing, int error) const;

  std::filesystem::path target_, temporary_;
  bool overwrite_, placed_ = false;
  int descriptor_ = -1;
  Checksum written_;
};

}  // namespace salebra::detail
