// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdf5_handle.hpp"

namespace salebra::detail::hdf5 {

/// The HDF5 file behind an open descriptor, which stays the caller's. Nothing is opened by name,
/// locked or written.
File open_descriptor(int descriptor);

/// The error number of a read of this thread that the system refused since open_descriptor(); 0
/// where none. HDF5 takes what it cannot read of an optional message for absent.
int failed_read();

}  // namespace salebra::detail::hdf5
