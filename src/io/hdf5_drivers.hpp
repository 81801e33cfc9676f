// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "hdf5_handle.hpp"

namespace salebra::detail::hdf5 {

/// The HDF5 file behind an open descriptor, which stays the caller's. Nothing is opened by name,
/// locked or written.
File open_descriptor(int descriptor);

/// The error number of a read of this thread that the system refused since open_descriptor(); 0
/// where none. HDF5 takes what it cannot read of an optional message for absent.
int failed_read();

/// The bytes of an HDF5 file in memory, of which only those take any that were written: the fields
/// that other processes write are holes. The layout is that of HDF5's own files in memory.
class SparseImage {
 public:
  static constexpr std::size_t page_size = 1 << 14;

  void write(std::uint64_t place, const char* bytes, std::size_t count);
  /// Holes are zeros.
  void read(std::uint64_t place, char* bytes, std::size_t count) const;
  /// What was written, by place; each of page_size bytes, the last of which may lie beyond the end
  /// of the file.
  const std::map<std::uint64_t, std::vector<char>>& pages() const { return pages_; }

 private:
  std::map<std::uint64_t, std::vector<char>> pages_;
};

/// A new file in an image, which must outlive the file.
File create_in(SparseImage& image);

/// Bytes of a flushed file.
std::uint64_t size_of(hid_t file);

}  // namespace salebra::detail::hdf5
