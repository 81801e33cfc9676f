// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <salebra/io/output.hpp>
#include <span>
#include <string_view>

namespace salebra::detail {

/// Writes bytes to an open file from `offset` on. target: the final name of the file, which the
/// IoError names if the call fails.
void write_at(const std::filesystem::path& target, int descriptor, std::uint64_t offset,
              std::string_view bytes);

/// Fills `bytes` from the file, from `offset` on. Throws as write_at() does, also if the file ends
/// before `bytes` is full.
void read_at(const std::filesystem::path& target, int descriptor, std::uint64_t offset,
             std::span<char> bytes);

/// Flushes an open file to the disk. Throws IoError naming the target.
void flush(const std::filesystem::path& target, int descriptor);

/// Opens the temporary file of an AtomicFile that belongs to another process, to write to it.
/// Throws IoError naming the target.
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

/// A file that appears under its name only when it is complete. It is written under a temporary
/// name. Throws IoError if a system call fails.
class AtomicFile {
 public:
  /// Creates the temporary file in the folder of its target. Throws as require_output() does.
  AtomicFile(const std::filesystem::path& target, const WriteOptions& options);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes the temporary file unless rename_to_target() has renamed it.
  ~AtomicFile();

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Appends bytes to the temporary file.
  void write(std::string_view bytes);
  /// Sets the size of the temporary file, so that write_at() can be used instead of write().
  /// Reserves the space on the disk if the file system can do that.
  void reserve(std::uint64_t size);
  int descriptor() const { return descriptor_; }
  /// Flushes the temporary file to the disk and closes it. Errors of a full or faulty disk are
  /// thrown here.
  void finish();
  /// Renames the finished temporary file to its target.
  void rename_to_target();
  bool placed() const { return placed_; }
  void commit() {
    finish();
    rename_to_target();
  }

 private:
  [[noreturn]] void fail(const char* doing, int error) const;

  std::filesystem::path target_, temporary_;
  bool overwrite_, placed_ = false;
  int descriptor_ = -1;
};

}  // namespace salebra::detail
