// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>

namespace salebra::detail {

/// A file from outside, opened once: what is read later is what was judged, whatever happens to its
/// name. Only a regular file is opened. A pipe or a device would let a reader wait for ever or read
/// without end.
class InputFile {
 public:
  /// Throws InvalidInput naming the file if there is no such regular file, or the user may not read
  /// it; IoError where the system cannot open it.
  explicit InputFile(std::filesystem::path path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }

  /// Bytes from the start: all, or fewer where the file ends before. Throws IoError where the disk
  /// does not give them.
  std::string head(std::uint64_t bytes) const;
  /// Fills bytes from a place on, by any number of threads at once. Throws InvalidInput where the
  /// file ends before, IoError where the disk does not give them.
  void read(std::uint64_t location, std::span<std::byte> bytes) const;
  /// The whole file. Throws InvalidInput for an empty file, for one of more than `limit` bytes, and
  /// for one that does not fit in the memory that is free.
  std::string content(std::uint64_t limit = std::numeric_limits<std::uint64_t>::max()) const;
  /// Checksum of all bytes, a block at a time: the file may be larger than the memory. Throws
  /// IoError if the disk does not give them.
  std::uint64_t checksum() const;
  /// Whether the file begins as HDF5 does.
  bool is_hdf5() const;
  /// Whether the HDF5 library would take it for its own: the signature may also stand behind a block
  /// of 512 bytes, or of twice as many, and so on.
  bool may_be_hdf5() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Is called with the name of each file that is opened from now on, before it is opened; throws to
/// refuse it. None as at the start. All readers pass through InputFile, hence here too.
void set_input_watcher(std::function<void(const std::filesystem::path&)> watcher);

}  // namespace salebra::detail
