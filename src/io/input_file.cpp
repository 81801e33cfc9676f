// SPDX-License-Identifier: GPL-3.0-or-later
// Input files: only regular files, each opened once.
#include "input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <salebra/base/error.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "base/checksum.hpp"
#include "base/memory.hpp"
#include "input.hpp"
#include "loaded_surface.hpp"

namespace salebra {
namespace detail {
namespace {

std::function<void(const std::filesystem::path&)> input_watcher;

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

[[noreturn]] void refuse_unreadable(const std::filesystem::path& path, int error) {
  const std::string why = std::string("cannot be read (") + std::strerror(error) + ")";
  if (error == EACCES || error == EPERM || error == ENAMETOOLONG || error == EISDIR)
    refuse(path, why + "; check its name and its permissions");
  throw IoError(path.string() + ": " + why + "; check the disk");
}

}  // namespace

void set_input_watcher(std::function<void(const std::filesystem::path&)> watcher) {
  input_watcher = std::move(watcher);
}

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  if (input_watcher) input_watcher(path_);
  // Without O_NONBLOCK, opening a named pipe would wait for its other end. The pipe is refused
  // below.
  do {
    descriptor_ = open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  } while (descriptor_ < 0 && errno == EINTR);
  const int error = errno;
  if (descriptor_ < 0 && (error == ENOENT || error == ENOTDIR || error == ELOOP))
    refuse(path_, "does not exist; check the path");
  if (descriptor_ < 0 && error == ENXIO) refuse(path_, "is not a regular file; name another file");
  if (descriptor_ < 0) refuse_unreadable(path_, error);
  struct stat status {};
  const bool known = fstat(descriptor_, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    close(std::exchange(descriptor_, -1));
    refuse(path_, "is not a regular file; name another file");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::string InputFile::head(std::uint64_t bytes) const {
  std::string content(std::min(bytes, size_), '\0');
  read(0, std::as_writable_bytes(std::span(content)));
  return content;
}

void InputFile::read(std::uint64_t location, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got =
        pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(location));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse_unreadable(path_, errno);
    if (got == 0) refuse(path_, "ended while it was read; is another program writing it?");
    location += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

std::string InputFile::content(std::uint64_t limit) const {
  if (size_ == 0) refuse(path_, "is empty; name another file");
  // A sparse file may be much larger than the memory, so a large file is limited to the free
  // memory.
  constexpr std::uint64_t any_memory = 64 << 20;
  if (size_ > any_memory) limit = std::min<std::uint64_t>(limit, available_memory());
  if (size_ > limit)
    refuse(path_, "has " + std::to_string(size_) + " bytes, and at most " + std::to_string(limit) +
                      " can be read here; name another file");
  return head(size_);
}

std::uint64_t InputFile::checksum() const {
  Checksum sum;
  std::string block(std::size_t{1} << 20, '\0');
  for (off_t at = 0;;) {
    const ssize_t count = pread(descriptor_, block.data(), block.size(), at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_unreadable(path_, errno);
    if (count == 0) return sum.value();
    sum.add(std::string_view(block.data(), static_cast<std::size_t>(count)));
    at += count;
  }
}

bool InputFile::is_hdf5() const { return head(hdf5_signature.size()) == hdf5_signature; }

bool InputFile::may_be_hdf5() const {
  if (is_hdf5()) return true;
  std::string found(hdf5_signature.size(), '\0');
  for (std::uint64_t at = 512; size_ >= found.size() && at <= size_ - found.size(); at *= 2) {
    read(at, std::as_writable_bytes(std::span(found)));
    if (found == hdf5_signature) return true;
  }
  return false;
}

}  // namespace detail

void require_one_file(const std::filesystem::path& file, const Communicator& communicator) {
  if (communicator.alone()) return;
  struct stat status = {};
  const bool there = stat(file.c_str(), &status) == 0;
  const std::vector<std::string> copies =
      communicator.gather_all(there ? fmt::format("{} {} {} {}", status.st_ino, status.st_size,
                                                  status.st_mtim.tv_sec, status.st_mtim.tv_nsec)
                                    : "");
  const auto require_equal = [&](const std::vector<std::string>& all) {
    for (std::size_t rank = 1; rank < all.size(); ++rank)
      if (all[rank] != all.front())
        throw InvalidInput(file.string(), fmt::format("is a different file for process {} than for "
                                                      "process 1; give all processes the same file",
                                                      rank + 1));
  };
  if (std::ranges::count(copies, copies.front()) == std::ssize(copies)) return;
  if (std::ranges::find(copies, "") != copies.end()) return require_equal(copies);
  const auto mine = copies.begin() + communicator.rank();
  const bool first = std::find(copies.begin(), mine, *mine) == mine;
  std::string content;
  collectively(communicator, [&] {
    if (!first) return;
    const detail::InputFile input(file);
    content = fmt::format("{} {}", input.size(), input.checksum());
  });
  std::vector<std::string> contents = communicator.gather_all(content);
  // Each process that shares a copy gets the checksum from the process that has read the copy.
  for (std::size_t rank = 0; rank < contents.size(); ++rank)
    contents[rank] = contents[static_cast<std::size_t>(std::ranges::find(copies, copies[rank]) -
                                                       copies.begin())];
  require_equal(contents);
}

}  // namespace salebra
