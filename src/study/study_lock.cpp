// SPDX-License-Identifier: GPL-3.0-or-later
// Lock file of a folder of realisations, valid across hosts and taken over from dead processes.
#include "study_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <salebra/base/error.hpp>
#include <sstream>
#include <vector>

namespace salebra::detail {
namespace {

/// A small regular file; nothing where there is none. A pipe in its place would be waited for.
std::optional<std::string> read_text(const std::filesystem::path& file) {
  int descriptor;
  do {
    descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  } while (descriptor < 0 && errno == EINTR);
  if (descriptor < 0) return {};
  std::optional<std::string> text;
  struct stat status = {};
  if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) {
    std::array<char, 4096> piece;
    ssize_t got = 0;
    text.emplace();
    do {
      got = ::read(descriptor, piece.data(), piece.size());
      if (got > 0) text->append(piece.data(), static_cast<std::size_t>(got));
    } while (got > 0 ? text->size() < piece.size() : got < 0 && errno == EINTR);
    if (got < 0) text.reset();
  }
  ::close(descriptor);
  return text;
}

std::string first_line(const std::filesystem::path& file) {
  const std::string text = read_text(file).value_or("");
  return text.substr(0, text.find('\n'));
}

/// Where a process number means the same process: one boot of one host, in one namespace.
std::string process_space() {
  char host[256] = "unknown";
  gethostname(host, sizeof host - 1);
  std::error_code ignored;
  const auto space = std::filesystem::read_symlink("/proc/self/ns/pid", ignored);
  return fmt::format("{} {} {}", host, first_line("/proc/sys/kernel/random/boot_id"),
                     space.string());
}

struct ProcessStatus {
  char state = 0;  ///< one letter of proc_pid_stat(5); 0 where it is not known
  std::string
      started;  ///< ticks since boot, which tells a process from a later one of the same number
};

ProcessStatus status_of(pid_t process) {
  ProcessStatus status;
  const std::string text = first_line(fmt::format("/proc/{}/stat", process));
  const auto name_end = text.rfind(')');
  if (name_end == std::string::npos) return status;
  std::istringstream words(text.substr(name_end + 1));
  std::string word;
  words >> status.state;
  for (int field = 4; field <= 22; ++field) words >> word;
  status.started = word;
  return status;
}

struct Owner {
  std::string space, started;
  pid_t process = 0;
};

/// Lines: process space, process, start time, and a word that no other lock has.
Owner parse(const std::string& identity) {
  std::istringstream lines(identity);
  Owner owner;
  std::string process;
  std::getline(lines, owner.space);
  std::getline(lines, process);
  std::getline(lines, owner.started);
  owner.process = static_cast<pid_t>(std::atol(process.c_str()));
  return owner;
}

/// Whether the owner's process is there, running or stopped; empty where that cannot be known from
/// here.
std::optional<bool> lives(const Owner& owner) {
  if (owner.process <= 0 || owner.space != process_space()) return {};
  if (kill(owner.process, 0) != 0 && errno == ESRCH) return false;
  const ProcessStatus now = status_of(owner.process);
  if (now.started.empty() || owner.started.empty()) return {};
  const bool dead = now.state == 'Z' || now.state == 'X';  // killed, but its parent has not noticed
  return !dead && now.started == owner.started;
}

double modified(const struct stat& status) {
  return double(status.st_mtim.tv_sec) + 1e-9 * double(status.st_mtim.tv_nsec);
}

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw IoError(fmt::format("{}: cannot be created ({}); check permissions and space",
                            file.string(), std::strerror(error)));
}

/// A lock file of somebody.
struct Found {
  std::string text, holder;  ///< its content, and who that is in words
  bool stale = false;
};

/// Empty where there is no such file. now: of a file of the same file system that has just been
/// touched.
std::optional<Found> look_at(const std::filesystem::path& file, const struct stat& now,
                             std::chrono::milliseconds stale_after) {
  std::error_code ignored;
  const auto kind = std::filesystem::symlink_status(file, ignored).type();
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
    throw InvalidInput(file.string(), "is no regular file; remove it");
  struct stat present = {};
  const auto text = read_text(file);
  if (!text || stat(file.c_str(), &present) != 0) return {};
  const Owner owner = parse(*text);
  const double age = modified(now) - modified(present);
  // A process that was stopped touches nothing, and goes on later: where it can be looked at, the
  // clock has no say.
  const std::optional<bool> alive = lives(owner);
  // By a clock that is ahead or was set back. Its age counts from now on, unless its holder touches
  // it again.
  if (!alive && age < 0) utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
  return Found{*text,
               fmt::format("process {} on {}, which last touched it {:.0f} s ago", owner.process,
                           owner.space.substr(0, owner.space.find(' ')), std::max(age, 0.0)),
               alive ? !*alive : age > double(stale_after.count()) / 1000};
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& holder) {
  throw InvalidInput(file.parent_path().string(),
                     fmt::format("in use by {}; wait for it to end, or end it", holder));
}

}  // namespace

StudyLock::StudyLock(std::filesystem::path file, std::chrono::milliseconds stale_after, Unlinked)
    : file_(std::move(file)), stale_after_(stale_after) {
  const auto moment = std::chrono::steady_clock::now().time_since_epoch().count();
  identity_ =
      fmt::format("{}\n{}\n{}\n{:x}-{:x}\n", process_space(), getpid(), status_of(getpid()).started,
                  moment, reinterpret_cast<std::uintptr_t>(this));
}

StudyLock::StudyLock(std::filesystem::path file, std::chrono::milliseconds stale_after)
    : StudyLock(std::move(file), stale_after, Unlinked()) {
  if (const auto holder = acquire()) refuse(file_, *holder);
}

std::unique_ptr<StudyLock> StudyLock::take(std::filesystem::path file,
                                           std::chrono::milliseconds stale_after) {
  std::unique_ptr<StudyLock> lock(new StudyLock(std::move(file), stale_after, Unlinked()));
  return lock->acquire() ? nullptr : std::move(lock);
}

void StudyLock::require_free(const std::filesystem::path& file, const StudyLock& own) {
  struct stat now = {};
  // Its holder touches it every few seconds: this is what the file system's clock says.
  utimensat(AT_FDCWD, own.file_.c_str(), nullptr, 0);
  if (stat(own.file_.c_str(), &now) != 0) return;
  const auto found = look_at(file, now, own.stale_after_);
  if (found && !found->stale) refuse(file, found->holder);
}

std::optional<std::string> StudyLock::acquire() {
  // Each failed attempt saw a lock vanish or be taken over: not many in a row.
  std::optional<std::string> holder;
  for (int attempt = 0; attempt < 20 && !held_ && !holder; ++attempt) holder = try_link();
  if (holder) return holder;
  if (!held_) return "several processes, which take it over and over again";
  thread_ = std::thread([this] { keep_fresh(); });
  return {};
}

std::optional<std::string> StudyLock::try_link() {
  const std::string word = fmt::format("{}-{:x}", getpid(), reinterpret_cast<std::uintptr_t>(this));
  const std::filesystem::path own = file_.string() + "." + word;
  int descriptor;
  do {
    descriptor = ::open(own.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EINTR);
  if (descriptor < 0) fail(own, errno);
  ssize_t written = 0, part = 0;
  do {
    part = write(descriptor, identity_.data() + written, identity_.size() - std::size_t(written));
    if (part > 0) written += part;
  } while (part > 0 ? std::size_t(written) < identity_.size() : part < 0 && errno == EINTR);
  const int write_error = errno;
  ::close(descriptor);
  if (written != ssize_t(identity_.size())) {
    unlink(own.c_str());
    fail(own, write_error);
  }
  const bool linked = link(own.c_str(), file_.c_str()) == 0;
  const int link_error = errno;
  struct stat fresh = {};
  stat(own.c_str(), &fresh);
  unlink(own.c_str());
  // NFS may answer a link that was made with an error; the count of links tells.
  if (linked || fresh.st_nlink == 2) {
    held_ = true;
    return {};
  }
  // The holder of the folder has cleaned it up.
  if (link_error == ENOENT) return {};
  if (link_error != EEXIST) fail(file_, link_error);

  const std::optional<Found> found = look_at(file_, fresh, stale_after_);
  if (!found) return {};  // it has just gone
  if (!found->stale) return found->holder;
  // If several processes decide this, only the one that renames the file it read proceeds; the
  // others restore it.
  const std::filesystem::path aside = file_.string() + ".stale." + word;
  if (rename(file_.c_str(), aside.c_str()) != 0) return {};
  if (read_text(aside) != found->text && link(aside.c_str(), file_.c_str()) != 0) {
    // Another process took the name meanwhile: the owner that was put aside notices that its name
    // is gone.
  }
  unlink(aside.c_str());
  return {};
}

void StudyLock::keep_fresh() {
  std::unique_lock lock(guard_);
  while (!wake_.wait_for(lock, stale_after_ / 6, [&] { return ending_; })) {
    if (read_text(file_) != identity_) {
      held_ = false;
      return;
    }
    utimensat(AT_FDCWD, file_.c_str(), nullptr, 0);
  }
}

StudyLock::~StudyLock() {
  {
    const std::scoped_lock lock(guard_);
    ending_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (held_ && read_text(file_) == identity_) unlink(file_.c_str());
}

}  // namespace salebra::detail
