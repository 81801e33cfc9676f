// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <vector>

#include "atomic_file.hpp"
#include "hdf5_handle.hpp"

namespace salebra::detail::hdf5 {

/// The HDF5 file behind an open descriptor, which stays the caller's. Nothing is opened by name,
/// locked or written.
File open_descriptor(int descriptor);

/// The error number of a read of this thread that the system refused since open_descriptor(); 0
/// where none. HDF5 takes what it cannot read of an optional message for absent.
int failed_read();

/// The bytes of an HDF5 file in the making: pages in memory, which go to the file when there are
/// too many. What is not written is a hole, such as the fields that other processes write. HDF5
/// never sees that the disk fails: require_written() and finish() throw it. The layout is that of
/// HDF5's own files in memory.
/// cost     memory: a megabyte
class PagedFile {
 public:
  static constexpr std::size_t page_size = 1 << 16, max_pages = 16;

  /// The file must outlive this.
  explicit PagedFile(AtomicFile& file) : file_(file) {}
  void write(std::uint64_t location, const char* bytes, std::size_t count);
  /// Holes are zeros.
  void read(std::uint64_t location, char* bytes, std::size_t count);
  /// Throws the IoError of the first byte that the system did not take.
  void require_written() const;
  /// Writes what is still in memory to the file, which becomes so long. Throws as
  /// require_written() does.
  void finish(std::uint64_t size);

 private:
  std::vector<char>& page(std::uint64_t start);
  void write_pages();
  void read_back(std::uint64_t location, char* bytes, std::size_t count);

  AtomicFile& file_;
  std::map<std::uint64_t, std::vector<char>> pages_;  ///< by place
  std::uint64_t end_on_disk_ = 0;
  std::exception_ptr failure_;
};

/// A new file in pages, which must outlive it.
File create_in(PagedFile& pages);

/// Bytes of a flushed file.
std::uint64_t size_of(hid_t file);

}  // namespace salebra::detail::hdf5
