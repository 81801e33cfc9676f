// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace salebra::detail {

/// Follows the key of a realisation: the lock file of who computes it.
inline constexpr const char* claim_suffix = ".claim";

/// A lock file that lives as long as the object. It is made by link(), which is atomic on NFS too,
/// and says who holds it: host and boot, process and the time of its start. On the same host
/// whoever finds that process gone takes the lock over, and nobody else: a stopped process keeps
/// it. A thread touches it every sixth of `stale_after`; on another host, whose processes cannot be
/// seen, a lock that was not touched for longer, by the file system's own clock, is taken over.
/// Should two do so at once, the one whose name is not in the file notices at the next touch:
/// held() is then false.
class StudyLock {
 public:
  /// Throws InvalidInput where someone else holds it, IoError where the file cannot be made.
  explicit StudyLock(std::filesystem::path file,
                     std::chrono::milliseconds stale_after = std::chrono::seconds(60));
  /// Takes the lock, or returns nothing where someone else holds it.
  static std::unique_ptr<StudyLock> take(
      std::filesystem::path file, std::chrono::milliseconds stale_after = std::chrono::seconds(60));
  /// Throws InvalidInput where someone holds `file`, a lock beside one's own.
  static void require_free(const std::filesystem::path& file, const StudyLock& own);
  ~StudyLock();
  StudyLock(const StudyLock&) = delete;
  StudyLock& operator=(const StudyLock&) = delete;

  bool held() const { return held_; }

 private:
  struct Unlinked {};
  StudyLock(std::filesystem::path file, std::chrono::milliseconds stale_after, Unlinked);
  /// Who holds it in one's place, in words; empty: nobody.
  std::optional<std::string> acquire();
  /// Tries once: empty too where it has to be tried again.
  std::optional<std::string> try_link();
  void keep_fresh();

  std::filesystem::path file_;
  std::chrono::milliseconds stale_after_;
  std::string identity_;
  std::atomic<bool> held_ = false;
  bool ending_ = false;
  std::mutex guard_;
  std::condition_variable wake_;
  std::thread thread_;
};

}  // namespace salebra::detail
