// SPDX-License-Identifier: GPL-3.0-or-later
// File that appears under its name complete or not at all.
#include "atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <salebra/base/error.hpp>
#include <salebra/io/text_file.hpp>
#include <string>

namespace salebra {

void require_output(const std::filesystem::path& file, const WriteOptions& options) {
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  require(!file.filename().empty(), "output", "'" + file.string() + "'", "names no file");
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw InvalidInput(file.string() + ": the folder " + folder.string() +
                       " does not exist; create it first");
  const auto status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) return;
  if (!std::filesystem::is_regular_file(status))
    throw InvalidInput(file.string() + ": exists and is not a regular file; name another one");
  if (!options.overwrite)
    throw InvalidInput(file.string() + ": exists; name another file or overwrite it (--force)");
}

namespace detail {

AtomicFile::AtomicFile(const std::filesystem::path& target, const WriteOptions& options)
    : target_(target), overwrite_(options.overwrite) {
  require_output(target, options);
  for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
    temporary_ =
        target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) +
                                "-" + std::to_string(attempt) + ".part");
    descriptor_ = open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) fail("be created", errno);
  }
  if (descriptor_ < 0) fail("be created", EEXIST);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::reserve(std::uint64_t bytes) {
  int error;
  do {
    error = posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  } while (error == EINTR);
  if (error != 0) fail("be written", error);
}

void AtomicFile::resize(std::uint64_t bytes) {
  if (ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) fail("be written", errno);
}

void AtomicFile::commit() {
  if (fsync(descriptor_) != 0) fail("be written", errno);
  if (overwrite_) {
    if (rename(temporary_.c_str(), target_.c_str()) != 0) fail("be put in its place", errno);
  } else if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) !=
             0) {
    // Some file systems cannot rename without replacing; a hard link cannot replace either.
    if (errno != EINVAL && errno != ENOSYS) fail("be put in its place", errno);
    if (link(temporary_.c_str(), target_.c_str()) != 0) fail("be put in its place", errno);
    unlink(temporary_.c_str());
  }
  close(descriptor_);
  descriptor_ = -1;
  const auto folder = target_.has_parent_path() ? target_.parent_path() : ".";
  if (const int parent = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); parent >= 0) {
    fsync(parent);
    close(parent);
  }
}

void AtomicFile::fail(const char* doing, int error) const {
  throw IoError(target_.string() + ": cannot " + doing + " (" + std::strerror(error) +
                "); nothing was written");
}

}  // namespace detail

void write_text_file(const std::filesystem::path& file, std::string_view text,
                     const WriteOptions& options) {
  detail::AtomicFile output(file, options);
  output.write(text);
  output.commit();
}

}  // namespace salebra
