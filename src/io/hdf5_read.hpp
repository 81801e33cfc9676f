// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <vector>

namespace salebra::detail::hdf5 {

/// Extent of a dataset along each dimension; empty for a scalar.
std::vector<hsize_t> shape_of(hid_t dataset);

}  // namespace salebra::detail::hdf5
