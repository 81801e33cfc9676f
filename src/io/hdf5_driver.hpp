// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "hdf5_handle.hpp"

namespace salebra::detail::hdf5 {

/// What the file drivers of this folder have in common. HDF5 casts its base to a driver's file and
/// back.
struct DriverFile : H5FD_t {
  haddr_t end_of_addresses = 0, end = 0;
};

/// A class of drivers with the functions that need no more than a DriverFile; the others are the
/// driver's own.
inline H5FD_class_t driver_class_of(const char* name, std::size_t access_size) {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // HDF5 1.14 and later refuse a class without them
  driver.version = H5FD_CLASS_VERSION;
  driver.value = H5_VFD_RESERVED;  // the first number that is not of a driver of HDF5's own
#endif
  driver.name = name;
  driver.maxaddr = std::numeric_limits<std::int64_t>::max();
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = access_size;
  // Without a comparison HDF5 would take two files for one.
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

}  // namespace salebra::detail::hdf5
