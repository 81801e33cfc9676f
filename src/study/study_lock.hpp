// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

namespace salebra::detail {

/// Ending of the name of a lock file: the process that computes a realisation holds the file
/// "key.claim".
inline constexpr const char* claim_suffix = ".claim";

/// A lock file that exists as long as the object. The operating system manages the lock (flock): it
/// ends with the process that holds it, however the process ends, and a stopped process keeps it.
/// It also works between machines that share the folder by NFS or Lustre. The last holder removes
/// the file.
class StudyLock {
 public:
  enum class Kind { alone, shared };
  /// Takes the lock. kind: `alone`, or `shared` with other holders. Throws InvalidInput if another
  /// process prevents this, IoError if the file cannot be made or its file system has no locks.
  explicit StudyLock(std::filesystem::path file, Kind kind = Kind::alone);
  /// Takes the lock without sharing it; returns nullptr if another process holds it.
  static std::unique_ptr<StudyLock> take(std::filesystem::path file);
  ~StudyLock();
  StudyLock(const StudyLock&) = delete;
  StudyLock& operator=(const StudyLock&) = delete;

 private:
  struct Open {};
  StudyLock(std::filesystem::path file, Open) : file_(std::move(file)) {}
  /// Takes the lock; returns false if another process prevents this.
  bool acquire(Kind kind);

  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace salebra::detail
