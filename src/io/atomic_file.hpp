// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <salebra/io/output.hpp>
#include <span>
#include <string_view>

namespace salebra::detail {

/// Writes bytes to an open file at a place. Throws IoError naming the target, under which the file
/// will be known.
void write_at(const std::filesystem::path& target, int descriptor, std::uint64_t location,
              std::string_view bytes);

/// Reads what was written there. Throws as write_at() does, also where the file is shorter.
void read_at(const std::filesystem::path& target, int descriptor, std::uint64_t location,
             std::span<char> bytes);

/// Flushes an open file to the disk. Throws as write_at() does.
void flush(const std::filesystem::path& target, int descriptor);

/// The temporary file of an AtomicFile of another process, open for writing. Throws IoError naming
/// the target.
class OthersFile {
 public:
  OthersFile(const std::filesystem::path& temporary, const std::filesystem::path& target);
  OthersFile(const OthersFile&) = delete;
  OthersFile& operator=(const OthersFile&) = delete;
  ~OthersFile();
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// A file that appears under its name complete or not at all. Throws IoError for what the system
/// refuses.
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
  /// Prepares for write_at() in place of write(): makes the file so long, with room on the disk
  /// where the file system can promise it.
  void reserve(std::uint64_t size);
  int descriptor() const { return descriptor_; }
  /// Flushes to the disk and closes: what can fail for want of space or by a fault of the disk.
  void finish();
  /// Renames the finished file.
  void location();
  bool placed() const { return placed_; }
  void commit() {
    finish();
    location();
  }

 private:
  [[noreturn]] void fail(const char* doing, int error) const;

  std::filesystem::path target_, temporary_;
  bool overwrite_, placed_ = false;
  int descriptor_ = -1;
};

}  // namespace salebra::detail
