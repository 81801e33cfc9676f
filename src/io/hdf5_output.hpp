// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <salebra/io/provenance.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "atomic_file.hpp"
#include "hdf5_handle.hpp"

namespace salebra::detail::hdf5 {

/// What every dataset carries.
struct Label {
  std::string units;
  std::string long_name;
};

/// An HDF5 file in the making, whose datasets have units, names and dimension scales.
/// HDF5 1.10 leaves handles behind that crash the process at its end when a file cannot be closed for want of space. Hence room
/// for data and metadata is reserved on the disk before anything is handed to HDF5, and a full disk shows there.
class Output {
 public:
  Output(const std::filesystem::path& file, const Provenance& provenance,
         const WriteOptions& options);

  hid_t root() const { return root_; }
  /// Opens the group at that path below the root, creating what is missing.
  Group group(const std::string& path);

  void attribute(hid_t object, const std::string& name, double value);
  void attribute(hid_t object, const std::string& name, std::int64_t value);
  void attribute(hid_t object, const std::string& name, std::uint64_t value);
  void attribute(hid_t object, const std::string& name, std::string_view value);

  /// A dataset whose dimensions are the named scales of the group (none: a scalar). T: double, float, int64_t, int16_t, int8_t.
  /// Throws InvalidInput if a scale is missing or values have not the shape that the scales give.
  template <class T>
  Dataset dataset(hid_t group, const std::string& name, const T* values, std::size_t count,
                  const std::vector<std::string>& dimensions, const Label& label);
  /// A one-dimensional dataset that is a dimension scale.
  template <class T>
  void scale(hid_t group, const std::string& name, const T* values, std::size_t count,
             const Label& label);
  void text_scale(hid_t group, const std::string& name, const std::vector<std::string>& values,
                  const std::string& long_name);

  /// Closes the file and puts it in its place; nothing can be written afterwards.
  void commit();

 private:
  template <class T>
  void number(hid_t object, const std::string& name, const T& value);
  template <class T>
  Dataset create(hid_t group, const std::string& name, const T* values,
                 const std::vector<hsize_t>& shape, const Label& label);
  void make_room(std::uint64_t bytes);

  AtomicFile atomic_;
  File file_;
  Group root_;
};

}  // namespace salebra::detail::hdf5
