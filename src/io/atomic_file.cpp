// SPDX-License-Identifier: GPL-3.0-or-later
// A file that appears under its name only when it is complete.
#include "atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <salebra/base/error.hpp>
#include <string>
#include <utility>

#include "text_file.hpp"

namespace salebra {
namespace {

/// Free space that a new result file needs: every result without fields is smaller than this.
constexpr std::uint64_t min_free_bytes = 1 << 20;

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Throws if a file may not be written under this name.
void require_free_name(const std::filesystem::path& file, const WriteOptions& options) {
  const auto folder = folder_of(file);
  require(!file.filename().empty(), "output", "'" + file.string() + "'", "does not name a file");
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw InvalidInput(file.string(),
                       "the folder " + folder.string() + " does not exist; create it first");
  const auto status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) {
    if (!options.overwrite && std::filesystem::is_symlink(file, ignored))
      throw InvalidInput(file.string(),
                         "is a symbolic link to a missing file; remove it or set `overwrite`");
    return;
  }
  if (!std::filesystem::is_regular_file(status))
    throw InvalidInput(file.string(), "exists and is not a regular file; name another one");
  if (!options.overwrite)
    throw InvalidInput(file.string(), "exists; name another file or set `overwrite`");
}

/// Repeats a system call that a signal has interrupted.
template <class Call>
auto without_interruption(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace

void require_output(const std::filesystem::path& file, const WriteOptions& options) {
  // The only sure test whether the file can be created is to create it. The temporary file is
  // removed at the end of this statement.
  detail::AtomicFile(file, options);
  struct statvfs space = {};
  if (statvfs(folder_of(file).c_str(), &space) != 0 || space.f_blocks == 0) return;
  if (std::uint64_t{space.f_bavail} * space.f_frsize < min_free_bytes)
    throw IoError(
        file.string() +
        ": less than 1 MB is free on its disk; free some space or name a file on another disk");
}

namespace detail {
namespace {

[[noreturn]] void fail_at(const std::filesystem::path& target, const char* doing, int error) {
  throw IoError(target.string() + ": cannot " + doing + " (" + std::strerror(error) +
                "); nothing was written");
}

}  // namespace

void write_at(const std::filesystem::path& target, int descriptor, std::uint64_t offset,
              std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = without_interruption(
        [&] { return pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset)); });
    if (written < 0) fail_at(target, "be written", errno);
    offset += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void read_at(const std::filesystem::path& target, int descriptor, std::uint64_t offset,
             std::span<char> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = without_interruption(
        [&] { return pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset)); });
    if (got <= 0) fail_at(target, "be read back", got < 0 ? errno : EIO);
    offset += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

void flush(const std::filesystem::path& target, int descriptor) {
  if (without_interruption([&] { return fsync(descriptor); }) != 0)
    fail_at(target, "be written", errno);
}

OthersFile::OthersFile(const std::filesystem::path& temporary, const std::filesystem::path& target)
    : descriptor_(
          without_interruption([&] { return open(temporary.c_str(), O_WRONLY | O_CLOEXEC); })) {
  if (descriptor_ < 0) fail_at(target, "be opened by each process", errno);
}

OthersFile::~OthersFile() { close(descriptor_); }

AtomicFile::AtomicFile(const std::filesystem::path& target, const WriteOptions& options)
    : target_(target), overwrite_(options.overwrite) {
  require_free_name(target, options);
  for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
    temporary_ =
        target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) +
                                "-" + std::to_string(attempt) + ".part");
    descriptor_ = without_interruption(
        [&] { return open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
    if (descriptor_ < 0 && errno == ENAMETOOLONG)
      throw InvalidInput(target.string(),
                         "the name is too long for this file system; shorten it to 225 bytes");
    if (descriptor_ < 0 && errno != EEXIST) fail("be created", errno);
  }
  if (descriptor_ < 0) fail("be created", EEXIST);
  // The new file keeps the permissions of the old one. A file system without permissions refuses
  // fchmod, which is no error.
  struct stat before = {};
  if (stat(target.c_str(), &before) == 0 && fchmod(descriptor_, before.st_mode & 0777) != 0) return;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!placed_) unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        without_interruption([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (written < 0) fail("be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::reserve(std::uint64_t size) {
  const auto length = static_cast<off_t>(size);
  if (without_interruption([&] { return ftruncate(descriptor_, length); }) != 0)
    fail("be written", errno);
  // fallocate() fails if the file system cannot reserve space, which is no error. posix_fallocate()
  // would then write to every block.
  if (size > 0 && without_interruption([&] { return fallocate(descriptor_, 0, 0, length); }) != 0 &&
      errno != EOPNOTSUPP && errno != ENOSYS)
    fail("be written", errno);
}

void AtomicFile::finish() {
  flush(target_, descriptor_);
  // EINTR is no error here: the descriptor is closed nevertheless, and the data are on the disk.
  if (close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail("be closed", errno);
}

void AtomicFile::rename_to_target() {
  if (overwrite_) {
    if (rename(temporary_.c_str(), target_.c_str()) != 0) fail("be put in its place", errno);
  } else if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) !=
             0) {
    // Some file systems cannot rename a file without replacing another. There a hard link, which
    // never replaces a file either, gives the file its name.
    if (errno != EINVAL && errno != ENOSYS) fail("be put in its place", errno);
    if (link(temporary_.c_str(), target_.c_str()) != 0) fail("be put in its place", errno);
    unlink(temporary_.c_str());
  }
  placed_ = true;
  // Flushes the folder too, so that the new name is on the disk. No error if the user may not read
  // the folder or the file system cannot flush folders.
  const int folder = without_interruption(
      [&] { return open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (folder < 0) return;
  const bool flushed = without_interruption([&] { return fsync(folder); }) == 0;
  const int error = errno;
  close(folder);
  if (!flushed && error != EINVAL && error != ENOTSUP && error != EBADF && error != EROFS)
    throw IoError(target_.string() + ": is written, but its folder could not be flushed to the " +
                  "disk (" + std::strerror(error) + "); check the disk");
}

void AtomicFile::fail(const char* doing, int error) const { fail_at(target_, doing, error); }

}  // namespace detail

void write_text_file(const std::filesystem::path& file, std::string_view text,
                     const WriteOptions& options) {
  detail::AtomicFile output(file, options);
  output.write(text);
  output.commit();
}

}  // namespace salebra
