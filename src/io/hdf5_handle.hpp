// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <salebra/base/error.hpp>
#include <string>
#include <utility>
#include <vector>

/// HDF5 identifiers that close themselves, and calls of HDF5 that throw IoError with the failed
/// operation.
namespace salebra::detail::hdf5 {

/// Keeps HDF5 from printing its errors, because they are thrown as exceptions. Must be called
/// before every use of HDF5.
inline void be_silent() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// Number of handles of this thread that a destructor could not close. Closing a handle writes what
/// HDF5 has buffered, so a writer compares this number before and after its
/// work.
inline int& failed_closes() {
  thread_local int count = 0;
  return count;
}

template <herr_t (*close)(hid_t)>
class Handle {
 public:
  Handle() = default;
  /// what   the operation, completes the message "cannot <what>"
  Handle(hid_t id, const std::string& what) : id_(id) {
    if (id < 0) throw IoError("cannot " + what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0 && close(id_) < 0) ++failed_closes();
  }
  operator hid_t() const { return id_; }
  /// Closes the identifier now and returns whether that worked; the destructor cannot report it.
  [[nodiscard]] bool closed() { return close(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
};

using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Attribute = Handle<H5Aclose>;
using Properties = Handle<H5Pclose>;

inline void check(herr_t status, const std::string& what) {
  if (status < 0) throw IoError("cannot " + what);
}

/// Extent of a dataset along each dimension; empty for a scalar.
inline std::vector<hsize_t> shape_of(hid_t dataset) {
  const std::string what = "read the shape of a dataset";
  const Space space(H5Dget_space(dataset), what);
  const int rank = H5Sget_simple_extent_ndims(space);
  check(rank, what);
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), what);
  return shape;
}

/// Properties for creating files in the earliest format that can hold them. Every version of HDF5
/// then writes the same bytes; HDF5 2.0 would use another format by default.
inline Properties creation_access() {
  const std::string what = "prepare a file";
  Properties access(H5Pcreate(H5P_FILE_ACCESS), what);
  check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), what);
  return access;
}

}  // namespace salebra::detail::hdf5
