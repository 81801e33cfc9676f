// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 file driver of a file in memory with holes.
#include "hdf5_sparse.hpp"

#include <algorithm>
#include <cstring>
#include <new>

#include "hdf5_driver.hpp"

namespace salebra::detail::hdf5 {
namespace {

/// What a file access property list carries.
struct Access {
  SparseImage* image;
};

struct SparseFile : DriverFile {
  SparseImage* image = nullptr;
};

H5FD_t* open_sparse(const char*, unsigned, hid_t access, haddr_t) {
  const auto* given = static_cast<const Access*>(H5Pget_driver_info(access));
  auto* file = given ? new (std::nothrow) SparseFile() : nullptr;
  if (!file) return nullptr;
  file->image = given->image;
  return file;
}

herr_t close_sparse(H5FD_t* file) {
  delete static_cast<SparseFile*>(file);
  return 0;
}

/// As HDF5's own driver of files in memory has it, on which the layout of the file depends.
herr_t features_of_sparse(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

herr_t read_sparse(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                   void* buffer) {
  static_cast<const SparseFile*>(file)->image->read(address, static_cast<char*>(buffer), size);
  return 0;
}

herr_t write_sparse(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                    const void* buffer) {
  auto& sparse = *static_cast<SparseFile*>(file);
  try {
    sparse.image->write(address, static_cast<const char*>(buffer), size);
  } catch (const std::bad_alloc&) {
    return -1;
  }
  sparse.end = std::max<haddr_t>(sparse.end, address + size);
  return 0;
}

herr_t lengthen_sparse(H5FD_t* file, hid_t, hbool_t) {
  auto& sparse = *static_cast<SparseFile*>(file);
  sparse.end = sparse.end_of_addresses;
  return 0;
}

/// Nothing else uses this memory. HDF5 marks a file as open only where it can lock it.
herr_t lock_sparse(H5FD_t*, hbool_t) { return 0; }
herr_t unlock_sparse(H5FD_t*) { return 0; }

H5FD_class_t sparse_driver_class() {
  H5FD_class_t driver = driver_class_of("salebra_sparse", sizeof(Access));
  driver.open = open_sparse;
  driver.close = close_sparse;
  driver.query = features_of_sparse;
  driver.read = read_sparse;
  driver.write = write_sparse;
  driver.lock = lock_sparse;
  driver.unlock = unlock_sparse;
  driver.truncate = lengthen_sparse;
  constexpr H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), driver.fl_map);
  return driver;
}

Properties access_to(SparseImage& image) {
  static const H5FD_class_t driver = sparse_driver_class();
  static const hid_t id = H5FDregister(&driver);
  Properties access = creation_access();
  const Access info{&image};
  check(H5Pset_driver(access, id, &info), "prepare a file");
  return access;
}

}  // namespace

void SparseImage::write(std::uint64_t place, const char* bytes, std::size_t count) {
  while (count > 0) {
    const std::size_t first = place % page_size, part = std::min(count, page_size - first);
    std::vector<char>& page = pages_[place - first];
    page.resize(page_size);
    std::memcpy(page.data() + first, bytes, part);
    place += part;
    bytes += part;
    count -= part;
  }
}

void SparseImage::read(std::uint64_t place, char* bytes, std::size_t count) const {
  while (count > 0) {
    const std::size_t first = place % page_size, part = std::min(count, page_size - first);
    const auto page = pages_.find(place - first);
    if (page == pages_.end()) {
      std::memset(bytes, 0, part);
    } else {
      std::memcpy(bytes, page->second.data() + first, part);
    }
    place += part;
    bytes += part;
    count -= part;
  }
}

File create_in(SparseImage& image) {
  // A name must be there. HDF5 would look for the folder of one that is relative.
  return {H5Fcreate("/sparse", H5F_ACC_TRUNC, H5P_DEFAULT, access_to(image)),
          "create an HDF5 file in memory"};
}

std::uint64_t size_of(hid_t file) {
  hsize_t size = 0;
  check(H5Fget_filesize(file, &size), "read the size of an HDF5 file in memory");
  return size;
}

}  // namespace salebra::detail::hdf5
