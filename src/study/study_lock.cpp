// SPDX-License-Identifier: GPL-3.0-or-later
// Locks by flock() of a folder of realisations, and of single surfaces in it.
#include "study_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <salebra/base/error.hpp>
#include <string>

namespace salebra::detail {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* doing, const char* remedy) {
  throw IoError(
      fmt::format("{}: cannot be {} ({}); {}", file.string(), doing, std::strerror(errno), remedy));
}

/// Reads from the lock file which process holds the lock; used only in messages.
std::string holder_in(const std::filesystem::path& file) {
  std::array<char, 400> text = {};
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const ssize_t got = descriptor < 0 ? 0 : ::read(descriptor, text.data(), text.size());
  if (descriptor >= 0) close(descriptor);
  return got > 0 ? std::string(text.data(), static_cast<std::size_t>(got)) : "another process";
}

void write_holder(int descriptor, StudyLock::Kind kind) {
  std::array<char, 256> host = {};
  gethostname(host.data(), host.size() - 1);
  const std::string text = fmt::format(
      "{}process {} on {}", kind == StudyLock::Kind::shared ? "shards, the latest of them " : "",
      getpid(), host.data());
  // A failure, for example because the disk is full, only leaves the name out of messages.
  if (ftruncate(descriptor, 0) == 0 && pwrite(descriptor, text.data(), text.size(), 0) < 0) return;
}

}  // namespace

StudyLock::StudyLock(std::filesystem::path file, Kind kind) : StudyLock(std::move(file), Open()) {
  if (!acquire(kind))
    throw InvalidInput(
        file_.parent_path().string(),
        fmt::format("in use by {}; wait for it to end, or end it", holder_in(file_)));
}

std::unique_ptr<StudyLock> StudyLock::take(std::filesystem::path file) {
  std::unique_ptr<StudyLock> lock(new StudyLock(std::move(file), Open()));
  return lock->acquire(Kind::alone) ? std::move(lock) : nullptr;
}

bool StudyLock::acquire(Kind kind) {
  // An attempt fails if another holder ends between opening and locking the file, or on a signal.
  // One or two attempts are usually enough.
  for (int attempt = 0; attempt < 20; ++attempt) {
    // O_NONBLOCK avoids waiting if the file is a pipe.
    const int opened = open(file_.c_str(), O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0666);
    if (opened < 0 && errno == EINTR) continue;
    if (opened < 0) fail(file_, "created", "check permissions and space");
    struct stat mine = {}, present = {};
    if (fstat(opened, &mine) != 0 || !S_ISREG(mine.st_mode)) {
      close(opened);
      throw InvalidInput(file_.string(), "is not a regular file; remove it");
    }
    if (flock(opened, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0) {
      const int error = errno;
      close(opened);
      if (error == EINTR) continue;
      if (error == EWOULDBLOCK) return false;
      errno = error;
      fail(file_, "locked", "put the results on a file system with file locks");
    }
    // If the last holder has removed the file meanwhile, other processes lock a new file and not
    // this one; then it tries again.
    if (stat(file_.c_str(), &present) == 0 && present.st_ino == mine.st_ino &&
        present.st_dev == mine.st_dev) {
      descriptor_ = opened;
      write_holder(opened, kind);
      return true;
    }
    close(opened);
  }
  throw IoError(
      fmt::format("{}: cannot be locked (tried 20 times); repeat the command", file_.string()));
}

StudyLock::~StudyLock() {
  if (descriptor_ < 0) return;
  // Of the holders of a shared lock only the last one gets it exclusively, and removes the file.
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) unlink(file_.c_str());
  close(descriptor_);
}

}  // namespace salebra::detail
