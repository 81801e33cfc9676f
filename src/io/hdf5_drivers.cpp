// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 file drivers: one reads through an open descriptor, one writes a new file to a PagedFile.
#include "hdf5_drivers.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>

namespace salebra::detail::hdf5 {
namespace {

/// What the files of both drivers have in common. HDF5 sees it as its base class, and the drivers
/// cast it back.
struct DriverFile : H5FD_t {
  haddr_t end_of_addresses = 0, end = 0;
};

/// A driver class with those functions that need only a DriverFile. Each driver adds its own
/// functions.
H5FD_class_t driver_class_of(const char* name, std::size_t access_size) {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // HDF5 1.14 and later require these two members
  driver.version = H5FD_CLASS_VERSION;
  driver.value = H5_VFD_RESERVED;  // the first number that is free for drivers outside HDF5
#endif
  driver.name = name;
  driver.maxaddr = std::numeric_limits<std::int64_t>::max();
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = access_size;
  // Compares two open files; without this function HDF5 would take them for the same file.
  driver.cmp = [](const H5FD_t* a, const H5FD_t* b) { return a < b ? -1 : a > b ? 1 : 0; };
  driver.get_eoa = [](const H5FD_t* file, H5FD_mem_t) {
    return static_cast<const DriverFile*>(file)->end_of_addresses;
  };
  driver.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t address) {
    static_cast<DriverFile*>(file)->end_of_addresses = address;
    return herr_t{0};
  };
  driver.get_eof = [](const H5FD_t* file, H5FD_mem_t) {
    return static_cast<const DriverFile*>(file)->end;
  };
  for (H5FD_mem_t& kind : driver.fl_map) kind = H5FD_MEM_DEFAULT;
  return driver;
}

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

/// What a file access property list passes to the driver.
struct Access {
  PagedFile* pages;
};

struct NewFile : DriverFile {
  PagedFile* pages = nullptr;
};

H5FD_t* open_new(const char*, unsigned, hid_t access, haddr_t) {
  const auto* given = static_cast<const Access*>(H5Pget_driver_info(access));
  auto* file = given ? new (std::nothrow) NewFile() : nullptr;
  if (!file) return nullptr;
  file->pages = given->pages;
  return file;
}

herr_t close_new(H5FD_t* file) {
  delete static_cast<NewFile*>(file);
  return 0;
}

/// Declares the same features as HDF5's own driver of files in memory, since the layout of the file
/// depends on them.
herr_t features_of_new(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

herr_t read_new(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  static_cast<const NewFile*>(file)->pages->read(address, static_cast<char*>(buffer), size);
  return 0;
}

herr_t write_new(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                 const void* buffer) {
  auto& made = *static_cast<NewFile*>(file);
  try {
    made.pages->write(address, static_cast<const char*>(buffer), size);
  } catch (const std::bad_alloc&) {
    return -1;
  }
  made.end = std::max<haddr_t>(made.end, address + size);
  return 0;
}

herr_t lengthen_new(H5FD_t* file, hid_t, hbool_t) {
  auto& made = *static_cast<NewFile*>(file);
  made.end = made.end_of_addresses;
  return 0;
}

/// Locking does nothing, because nobody else writes to this file. HDF5 needs the function, since it
/// marks a file as open only if it can lock it.
herr_t lock_new(H5FD_t*, hbool_t) { return 0; }
herr_t unlock_new(H5FD_t*) { return 0; }

H5FD_class_t new_driver_class() {
  H5FD_class_t driver = driver_class_of("salebra_new", sizeof(Access));
  driver.open = open_new;
  driver.close = close_new;
  driver.query = features_of_new;
  driver.read = read_new;
  driver.write = write_new;
  driver.lock = lock_new;
  driver.unlock = unlock_new;
  driver.truncate = lengthen_new;
  constexpr H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), driver.fl_map);
  return driver;
}

Properties access_to(PagedFile& pages) {
  static const H5FD_class_t driver = new_driver_class();
  static const hid_t id = H5FDregister(&driver);
  Properties access = creation_access();
  const Access info{&pages};
  check(H5Pset_driver(access, id, &info), "prepare a file");
  return access;
}

}  // namespace

int failed_read() { return read_failure; }

File open_descriptor(int descriptor) {
  read_failure = 0;
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = H5FDregister(&driver);
  const Properties access(H5Pcreate(H5P_FILE_ACCESS), "prepare reading");
  check(H5Pset_driver(access, id, &descriptor), "prepare reading");
  // HDF5 requires a name, which the driver does not use. It must be absolute; otherwise HDF5 looks
  // for the folder of the name.
  return {H5Fopen("/descriptor", H5F_ACC_RDONLY, access), "open it as HDF5"};
}

void PagedFile::write(std::uint64_t location, const char* bytes, std::size_t count) {
  if (count >= page_size * max_pages) {
    write_pages();
    if (failure_) return;
    try {
      write_at(file_.target(), file_.descriptor(), location, {bytes, count});
    } catch (const IoError&) {
      failure_ = std::current_exception();
    }
    end_on_disk_ = std::max(end_on_disk_, location + count);
    return;
  }
  while (count > 0) {
    const std::size_t first = location % page_size, part = std::min(count, page_size - first);
    std::memcpy(page(location - first).data() + first, bytes, part);
    location += part;
    bytes += part;
    count -= part;
  }
}

void PagedFile::read(std::uint64_t location, char* bytes, std::size_t count) {
  while (count > 0) {
    const std::size_t first = location % page_size, part = std::min(count, page_size - first);
    const auto page = pages_.find(location - first);
    if (page == pages_.end())
      read_back(location, bytes, part);
    else
      std::memcpy(bytes, page->second.data() + first, part);
    location += part;
    bytes += part;
    count -= part;
  }
}

void PagedFile::require_written() const {
  if (failure_) std::rethrow_exception(failure_);
}

void PagedFile::finish(std::uint64_t size) {
  require_written();
  file_.reserve(size);
  for (const auto& [location, page] : pages_)
    if (location < size)
      write_at(file_.target(), file_.descriptor(), location,
               {page.data(), std::min<std::uint64_t>(page.size(), size - location)});
}

std::vector<char>& PagedFile::page(std::uint64_t start) {
  const auto found = pages_.find(start);
  if (found != pages_.end()) return found->second;
  if (pages_.size() >= max_pages) write_pages();
  std::vector<char> bytes(page_size);
  read_back(start, bytes.data(), page_size);
  return pages_.emplace(start, std::move(bytes)).first->second;
}

/// If the disk fails, the pages stay in memory, so that HDF5 can still read what it wrote; the
/// error is thrown later.
void PagedFile::write_pages() {
  if (failure_) return;
  try {
    for (const auto& [location, page] : pages_) {
      write_at(file_.target(), file_.descriptor(), location, {page.data(), page.size()});
      end_on_disk_ = std::max(end_on_disk_, location + page.size());
    }
    pages_.clear();
  } catch (const IoError&) {
    failure_ = std::current_exception();
  }
}

void PagedFile::read_back(std::uint64_t location, char* bytes, std::size_t count) {
  const std::size_t there = location < end_on_disk_ ? std::min(count, end_on_disk_ - location) : 0;
  std::memset(bytes + there, 0, count - there);
  if (there == 0) return;
  try {
    read_at(file_.target(), file_.descriptor(), location, {bytes, there});
  } catch (const IoError&) {
    if (!failure_) failure_ = std::current_exception();
  }
}

File create_in(PagedFile& pages) {
  return {H5Fcreate("/new", H5F_ACC_TRUNC, H5P_DEFAULT, access_to(pages)), "create an HDF5 file"};
}

std::uint64_t size_of(hid_t file) {
  hsize_t size = 0;
  check(H5Fget_filesize(file, &size), "read the size of an HDF5 file");
  return size;
}

}  // namespace salebra::detail::hdf5
