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

/// An input file, opened once. Later reads see the file that was checked, even if its name has
/// meanwhile been given to another file. Only regular files are opened: a reader could wait forever
/// for a pipe or a device, or read from it without end.
class InputFile {
 public:
  /// Opens the file. Throws InvalidInput naming the file if there is no such regular file or the
  /// user may not read it, and IoError if the system cannot open it.
  explicit InputFile(std::filesystem::path path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }

  /// The first bytes of the file; fewer if the file is shorter. Throws IoError if the disk fails.
  std::string head(std::uint64_t bytes) const;
  /// Fills `bytes` from the offset `location` on; several threads may call at the same time. Throws
  /// InvalidInput if the file ends before `bytes` is full, IoError if the disk fails.
  void read(std::uint64_t location, std::span<std::byte> bytes) const;
  /// The whole file. Throws InvalidInput for an empty file, for a file of more than `limit` bytes,
  /// and for a file that does not fit into the free memory.
  std::string content(std::uint64_t limit = std::numeric_limits<std::uint64_t>::max()) const;
  /// Checksum of all bytes. The file is read in blocks, so it may be larger than the memory. Throws
  /// IoError if the disk fails.
  std::uint64_t checksum() const;
  /// Whether the file begins with the HDF5 signature.
  bool is_hdf5() const;
  /// Whether the HDF5 library would accept the file. The signature may also follow a block of 512
  /// bytes, or of 1024, 2048 and so on, doubling each time.
  bool may_be_hdf5() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Sets a function that is called with the name of each input file before it is opened, and that
/// throws to refuse the file. By default there is none. All readers open files by InputFile, so
/// they all call it.
void set_input_watcher(std::function<void(const std::filesystem::path&)> watcher);

}  // namespace salebra::detail
