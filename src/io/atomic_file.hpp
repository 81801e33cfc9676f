// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <salebra/io/output.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "checksum.hpp"

namespace salebra::detail {

/// Bytes that are written to an open file at their places, and read back. Throws IoError naming the
/// target, under which the file will be known.
class FilePieces {
 public:
  FilePieces(std::filesystem::path target, int descriptor)
      : target_(std::move(target)), descriptor_(descriptor) {}
  void write(std::uint64_t place, std::string_view bytes);
  /// Flushes to the disk and compares what it returns with what was written.
  void finish() const;

 private:
  struct Piece {
    std::uint64_t place;
    Checksum bytes;
  };
  std::filesystem::path target_;
  int descriptor_;
  std::vector<Piece> pieces_;
};

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
  /// For FilePieces in place of write(): makes the file so long, with room on the disk where the
  /// file system can promise it.
  void reserve(std::uint64_t size);
  int descriptor() const { return descriptor_; }
  /// Flushes to the disk, reads the bytes back and closes: what can fail for want of space or by a
  /// fault of the disk.
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
  bool overwrite_, placed_ = false, in_pieces_ = false;
  int descriptor_ = -1;
  Checksum written_;
};

}  // namespace salebra::detail
