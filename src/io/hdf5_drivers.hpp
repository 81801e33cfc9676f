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

/// Opens the HDF5 file behind an open descriptor, which still belongs to the caller. Nothing is
/// opened by name, locked or written.
File open_descriptor(int descriptor);

/// The error number (errno) of a failed read of this thread since open_descriptor(); 0 if none
/// failed. HDF5 does not report all failed reads: it treats an optional part of a header that it
/// cannot read as absent.
int failed_read();

/// The bytes of an HDF5 file that is being written. They are kept in pages in memory, which are
/// written to the file when there are too many. Bytes that this object does not write, such as the
/// fields of other processes, stay holes of the file. HDF5 never sees a failure of the disk;
/// require_written() and finish() throw it. The layout of the file is that of HDF5's own files in
/// memory.
/// cost     memory: a megabyte
class PagedFile {
 public:
  static constexpr std::size_t page_size = 1 << 16, max_pages = 16;

  /// The AtomicFile must outlive this object.
  explicit PagedFile(AtomicFile& file) : file_(file) {}
  void write(std::uint64_t location, const char* bytes, std::size_t count);
  /// Reads bytes that were written; holes read as zeros.
  void read(std::uint64_t location, char* bytes, std::size_t count);
  /// Throws the IoError of the first write that failed.
  void require_written() const;
  /// Writes the pages that are still in memory, and sets the size of the file. Throws the IoError
  /// of the first write that failed.
  void finish(std::uint64_t size);

 private:
  std::vector<char>& page(std::uint64_t start);
  void write_pages();
  void read_back(std::uint64_t location, char* bytes, std::size_t count);

  AtomicFile& file_;
  std::map<std::uint64_t, std::vector<char>> pages_;  ///< by offset in the file
  std::uint64_t end_on_disk_ = 0;
  std::exception_ptr failure_;
};

/// Creates an HDF5 file whose bytes go to `pages`, which must outlive the file.
File create_in(PagedFile& pages);

/// Size of an HDF5 file that has been flushed, bytes.
std::uint64_t size_of(hid_t file);

}  // namespace salebra::detail::hdf5
