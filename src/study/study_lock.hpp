// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

namespace salebra::detail {

/// Follows the key of a realisation: the lock file of who computes it.
inline constexpr const char* claim_suffix = ".claim";

/// A lock file that lives as long as the object. The lock is the system's (flock): it goes with its
/// process, however that ends, is kept by one that is stopped, and holds between hosts whose folder
/// is on NFS or Lustre. The last of its holders removes the file.
class StudyLock {
 public:
  enum class Kind { alone, shared };
  /// shared: together with others that share it.
  /// Throws InvalidInput where another holds it, IoError where the file cannot be made or its file
  /// system has no locks.
  explicit StudyLock(std::filesystem::path file, Kind kind = Kind::alone);
  /// Takes the lock alone, or returns nothing where another holds it.
  static std::unique_ptr<StudyLock> take(std::filesystem::path file);
  ~StudyLock();
  StudyLock(const StudyLock&) = delete;
  StudyLock& operator=(const StudyLock&) = delete;

 private:
  struct Open {};
  StudyLock(std::filesystem::path file, Open) : file_(std::move(file)) {}
  /// False where another holds it.
  bool acquire(Kind kind);

  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace salebra::detail
