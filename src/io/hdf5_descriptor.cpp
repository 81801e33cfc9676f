// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 file driver that reads an open descriptor.
#include "hdf5_descriptor.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <new>

#include "hdf5_driver.hpp"

namespace salebra::detail::hdf5 {
namespace {

constexpr haddr_t longest = std::numeric_limits<off_t>::max();

thread_local int read_failure = 0;

struct OpenFile : DriverFile {
  int descriptor = -1;
};

H5FD_t* open_file(const char*, unsigned flags, hid_t access, haddr_t) {
  const auto* descriptor = static_cast<const int*>(H5Pget_driver_info(access));
  struct stat status {};
  if (!descriptor || (flags & H5F_ACC_RDWR) != 0 || fstat(*descriptor, &status) != 0)
    return nullptr;
  auto* file = new (std::nothrow) OpenFile();
  if (!file) return nullptr;
  file->descriptor = *descriptor;
  file->end = static_cast<haddr_t>(status.st_size);
  return file;
}

herr_t close_file(H5FD_t* file) {
  delete static_cast<OpenFile*>(file);
  return 0;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                  void* buffer) {
  if (address > longest || size > longest - address) return -1;
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t got = pread(static_cast<const OpenFile*>(file)->descriptor, to, size,
                              static_cast<off_t>(address));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) read_failure = errno;
    if (got <= 0) return -1;
    to += got;
    address += static_cast<haddr_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return 0;
}

herr_t refuse_to_write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, std::size_t, const void*) { return -1; }

H5FD_class_t driver_class() {
  H5FD_class_t driver = driver_class_of("salebra_descriptor", sizeof(int));
  driver.open = open_file;
  driver.close = close_file;
  driver.read = read_bytes;
  driver.write = refuse_to_write;
  return driver;
}

}  // namespace

int failed_read() { return read_failure; }

File open_descriptor(int descriptor) {
  read_failure = 0;
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = H5FDregister(&driver);
  const Properties access(H5Pcreate(H5P_FILE_ACCESS), "prepare reading");
  check(H5Pset_driver(access, id, &descriptor), "prepare reading");
  // A name must be there. HDF5 would look for the folder of one that is relative.
  return {H5Fopen("/descriptor", H5F_ACC_RDONLY, access), "open it as HDF5"};
}

}  // namespace salebra::detail::hdf5
