// SPDX-License-Identifier: GPL-3.0-or-later
// Members, shapes and attributes of HDF5 objects, read with checks.
#include "hdf5_read.hpp"

#include <algorithm>

#include "hdf5_handle.hpp"
#include "loaded_surface.hpp"

namespace salebra::detail::hdf5 {
namespace {

herr_t collect(hid_t, const char* name, const H5L_info_t* info, void* names) {
  if (info->type == H5L_TYPE_HARD) static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

struct OpenAttribute {
  Attribute attribute;
  Type type;
};

std::optional<OpenAttribute> open_scalar(hid_t object, const char* name, H5T_class_t kind) {
  if (H5Aexists(object, name) <= 0) return {};
  OpenAttribute result;
  result.attribute = Attribute(H5Aopen(object, name, H5P_DEFAULT), std::string("open ") + name);
  const Space space(H5Aget_space(result.attribute), std::string("read ") + name);
  result.type = Type(H5Aget_type(result.attribute), std::string("read ") + name);
  const H5T_class_t found = H5Tget_class(result.type);
  const bool fits = found == kind || (kind == H5T_FLOAT && found == H5T_INTEGER) ||
                    (kind == H5T_FLOAT && found == H5T_ENUM);
  if (!fits || H5Sget_simple_extent_npoints(space) != 1) return {};
  return result;
}

}  // namespace

std::vector<std::string> members(hid_t group, H5O_type_t kind) {
  std::vector<std::string> names;
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list a group");
  std::erase_if(names, [&](const std::string& name) {
    H5O_info_t info;
    return H5Oget_info_by_name2(group, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0 ||
           info.type != kind;
  });
  return names;
}

std::vector<std::string> attributes_of(hid_t object) {
  std::vector<std::string> names;
  check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &names),
        "list attributes");
  return names;
}

std::vector<hsize_t> shape_of(hid_t dataset) {
  const Space space(H5Dget_space(dataset), "read the shape of a dataset");
  const int rank = H5Sget_simple_extent_ndims(space);
  check(rank, "read the shape of a dataset");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "read the shape of a dataset");
  return shape;
}

void require_stored(const std::filesystem::path& file, hid_t dataset, const std::string& name) {
  const Type type(H5Dget_type(dataset), "read the type of " + name);
  if (const H5T_class_t kind = H5Tget_class(type); kind != H5T_FLOAT && kind != H5T_INTEGER)
    refuse(file, "has a dataset " + name + " that is not of real numbers; store float64");
  hsize_t bytes = H5Tget_size(type);
  for (const hsize_t extent : shape_of(dataset))
    if (__builtin_mul_overflow(bytes, extent, &bytes))
      refuse(file, "declares a dataset " + name + " larger than any memory; it is damaged");
  const Properties layout(H5Dget_create_plist(dataset), "read the layout of " + name);
  // No deflate stream is shorter than 1/1032 of its content.
  constexpr hsize_t best_compression = 1032;
  const bool packed = H5Pget_nfilters(layout) > 0;
  std::error_code error;
  const hsize_t stored =
      std::min<hsize_t>(H5Dget_storage_size(dataset), std::filesystem::file_size(file, error));
  if (error || bytes / (packed ? best_compression : 1) > stored)
    refuse(file, "declares a dataset " + name +
                     " larger than what it holds; it is truncated or "
                     "damaged");
}

std::optional<double> number_attribute(hid_t object, const char* name) {
  const auto open = open_scalar(object, name, H5T_FLOAT);
  if (!open) return {};
  if (H5Tget_class(open->type) == H5T_ENUM) {  // h5py's booleans
    signed char flag = 0;
    const Type native(H5Tget_native_type(open->type, H5T_DIR_ASCEND), "read an attribute");
    if (H5Tget_size(native) != sizeof flag) return {};
    check(H5Aread(open->attribute, native, &flag), std::string("read ") + name);
    return flag;
  }
  double value = 0;
  check(H5Aread(open->attribute, H5T_NATIVE_DOUBLE, &value), std::string("read ") + name);
  return value;
}

std::optional<std::string> text_attribute(hid_t object, const char* name) {
  const auto open = open_scalar(object, name, H5T_STRING);
  if (!open) return {};
  const std::string what = std::string("read ") + name;
  if (H5Tis_variable_str(open->type) > 0) {
    char* stored = nullptr;
    const Type memory(H5Tcopy(open->type), what);
    check(H5Aread(open->attribute, memory, &stored), what);
    std::string text = stored ? stored : "";
    H5free_memory(stored);
    return text;
  }
  // An attribute lies in the object's header, where HDF5 itself has bounded its length.
  std::string text(H5Tget_size(open->type), '\0');
  check(H5Aread(open->attribute, open->type, text.data()), what);
  text.resize(std::min(text.find('\0'), text.size()));
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

}  // namespace salebra::detail::hdf5
