// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from an HDF5 file.
#include <unistd.h>

#include "hdf5_handle.hpp"
#include "hdf5_read.hpp"
#include "loaded_surface.hpp"
#include "rehearsal.hpp"

namespace salebra::detail {
namespace {

using namespace hdf5;

/// `heights`, or the only two-dimensional dataset at the root.
std::string heights_name(const std::filesystem::path& file, hid_t root) {
  if (H5Lexists(root, "heights", H5P_DEFAULT) > 0) return "heights";
  std::string found;
  for (const std::string& name : members(root, H5O_TYPE_DATASET)) {
    const Dataset dataset(H5Dopen2(root, name.c_str(), H5P_DEFAULT), "open " + name);
    if (shape_of(dataset).size() != 2) continue;
    if (!found.empty())
      refuse(file,
             "has several two-dimensional datasets at its root and none "
             "of them is named heights; name it so");
    found = name;
  }
  if (found.empty())
    refuse(file, "has no dataset heights (nx, ny) at its root; store the surface there");
  return found;
}

/// Contiguous heights are read without any decoding; packed ones pass through the library's least trusted parts.
bool is_chunked(hid_t dataset) {
  const Properties layout(H5Dget_create_plist(dataset), "read the layout of the heights");
  return H5Pget_layout(layout) == H5D_CHUNKED;
}

/// full: with the heights; otherwise only what must be known before they are read, and packed ones.
LoadedSurface load(const std::filesystem::path& file, bool full) {
  const File handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open it as HDF5");
  const Group root(H5Gopen2(handle, "/", H5P_DEFAULT), "open its root group");
  const std::string name = heights_name(file, root);
  const Dataset dataset(H5Dopen2(root, name.c_str(), H5P_DEFAULT), "open the dataset " + name);
  const std::vector<hsize_t> shape = shape_of(dataset);
  if (shape.size() != 2 || shape[0] == 0 || shape[1] == 0)
    refuse(file,
           "has heights that are not two-dimensional with nx, ny >= 1; store heights (nx, ny)");
  require_stored(file, dataset, name);
  LoadedSurface surface;
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto value = number_attribute(dataset, key);
    return value ? value : number_attribute(root, key);
  };
  surface.size_x = number("size_x");
  surface.size_y = number("size_y");
  if (const auto periodic = number("periodic")) surface.periodic = *periodic != 0;
  for (const hid_t object : {hid_t(dataset), hid_t(root)})
    if (surface.unit.empty()) surface.unit = text_attribute(object, "units").value_or("");
  if (!full) {
    if (!is_chunked(dataset)) return surface;
    // How long this takes is a matter of its size.
    alarm(0);
  }
  surface.heights.resize(static_cast<Index>(shape[0]), static_cast<Index>(shape[1]));
  check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, surface.heights.data()),
        "read the dataset " + name);
  return surface;
}

}  // namespace

LoadedSurface read_hdf5(const std::filesystem::path& file) {
  be_silent();
  rehearse(file, [&] { load(file, false); });
  try {
    return load(file, true);
  } catch (const IoError& error) {
    refuse(file, std::string(error.what()) + "; it is truncated or damaged");
  }
}

}  // namespace salebra::detail
