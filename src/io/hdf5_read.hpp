// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace salebra::detail::hdf5 {

/// Names of the members of a group that are of one kind, in the order of their names.
std::vector<std::string> members(hid_t group, H5O_type_t kind);

/// Names of the attributes of an object, in the order of their names.
std::vector<std::string> attributes_of(hid_t object);

/// Extent of a dataset along each dimension; empty for a scalar.
std::vector<hsize_t> shape_of(hid_t dataset);

/// Refuses a dataset whose extent is larger than what the file stores can be: a damaged or hostile header must not
/// decide how much memory is allocated.
void require_stored(const std::filesystem::path& file, hid_t dataset, const std::string& name);

/// A scalar attribute of any numeric type, if there is one.
std::optional<double> number_attribute(hid_t object, const char* name);
/// A scalar text attribute of fixed or variable length, if there is one.
std::optional<std::string> text_attribute(hid_t object, const char* name);

}  // namespace salebra::detail::hdf5
