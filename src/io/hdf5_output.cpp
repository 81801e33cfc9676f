// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 file in the making: datasets with units, long names and dimension scales.
#include "hdf5_output.hpp"

#include <hdf5_hl.h>

#include <numeric>
#include <salebra/base/version.hpp>

#include "hdf5_read.hpp"

namespace salebra::detail::hdf5 {
namespace {

/// More than the metadata that one call and the closing of the file can add.
constexpr std::uint64_t metadata_room = 1 << 20;

/// Types in the file are little-endian whatever the machine, so that a file is the same everywhere.
struct Types {
  hid_t file, memory;
};
Types types_of(const double*) { return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE}; }
Types types_of(const float*) { return {H5T_IEEE_F32LE, H5T_NATIVE_FLOAT}; }
Types types_of(const std::int16_t*) { return {H5T_STD_I16LE, H5T_NATIVE_INT16}; }
Types types_of(const std::int64_t*) { return {H5T_STD_I64LE, H5T_NATIVE_INT64}; }
Types types_of(const std::uint64_t*) { return {H5T_STD_U64LE, H5T_NATIVE_UINT64}; }
Types types_of(const std::int8_t*) { return {H5T_STD_I8LE, H5T_NATIVE_INT8}; }

Type text_type(std::size_t size) {
  Type type(H5Tcopy(H5T_C_S1), "make a text type");
  check(H5Tset_size(type, size), "make a text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "make a text type");
  return type;
}

std::string joined(const std::vector<hsize_t>& shape) {
  std::string text;
  for (const hsize_t extent : shape) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text.empty() ? "a scalar" : text;
}

void require_free(hid_t group, const std::string& name) {
  require(!name.empty() && name.find('/') == std::string::npos, "dataset", "'" + name + "'",
          "is no name");
  require(H5Lexists(group, name.c_str(), H5P_DEFAULT) <= 0, "dataset", name,
          "is in the file already");
}

}  // namespace

Output::Output(const std::filesystem::path& file, const Provenance& provenance,
               const WriteOptions& options)
    : atomic_(file, options) {
  be_silent();
  atomic_.reserve(
      metadata_room);  // a disk that is full already must show before HDF5 has a file open
  file_ = File(H5Fcreate(atomic_.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
               "create " + file.string());
  make_room(provenance.command_line.size() + provenance.configuration.size());
  root_ = Group(H5Gopen2(file_, "/", H5P_DEFAULT), "open the root of " + file.string());
  attribute(root_, "program", std::string_view("salebra"));
  attribute(root_, "version", version());
  attribute(root_, "libraries", library_versions());
  attribute(root_, "arithmetic", arithmetic());
  attribute(root_, "created", provenance.created.empty() ? utc_now() : provenance.created);
  attribute(root_, "command_line", provenance.command_line);
  attribute(root_, "configuration", provenance.configuration);
  if (provenance.seed) attribute(root_, "seed", *provenance.seed);
}

void Output::make_room(std::uint64_t bytes) {
  hsize_t size = 0;
  check(H5Fget_filesize(file_, &size), "read the size of " + atomic_.target().string());
  atomic_.reserve(size + bytes + metadata_room);
}

Group Output::group(const std::string& path) {
  make_room(0);
  const Properties links(H5Pcreate(H5P_LINK_CREATE), "prepare a group");
  check(H5Pset_create_intermediate_group(links, 1), "prepare a group");
  bool exists = true;
  for (std::size_t end = 0; exists && end != std::string::npos;) {
    end = path.find('/', end + 1);
    exists = H5Lexists(root_, path.substr(0, end).c_str(), H5P_DEFAULT) > 0;
  }
  return {exists ? H5Gopen2(root_, path.c_str(), H5P_DEFAULT)
                 : H5Gcreate2(root_, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT),
          "create the group " + path};
}

template <class T>
void Output::number(hid_t object, const std::string& name, const T& value) {
  make_room(0);
  const Types types = types_of(&value);
  const Space space(H5Screate(H5S_SCALAR), "write " + name);
  const Attribute attribute(
      H5Acreate2(object, name.c_str(), types.file, space, H5P_DEFAULT, H5P_DEFAULT),
      "write " + name);
  check(H5Awrite(attribute, types.memory, &value), "write " + name);
}

void Output::attribute(hid_t object, const std::string& name, double value) {
  number(object, name, value);
}

void Output::attribute(hid_t object, const std::string& name, std::int64_t value) {
  number(object, name, value);
}

void Output::attribute(hid_t object, const std::string& name, std::uint64_t value) {
  number(object, name, value);
}

void Output::attribute(hid_t object, const std::string& name, std::string_view value) {
  make_room(value.size());
  // Variable length: h5py and xarray read it as str, fixed length as bytes; and it may exceed the 64 KiB of an object header.
  const Type type = text_type(H5T_VARIABLE);
  const Space space(H5Screate(H5S_SCALAR), "write " + name);
  const Attribute attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                            "write " + name);
  const std::string text(value);
  const char* pointer = text.c_str();
  check(H5Awrite(attribute, type, &pointer), "write " + name);
}

template <class T>
Dataset Output::create(hid_t group, const std::string& name, const T* values,
                       const std::vector<hsize_t>& shape, const Label& label) {
  require_free(group, name);
  require(!label.units.empty() && !label.long_name.empty(), "dataset", name,
          "has no units or long_name; give both");
  const auto count = std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
  make_room(count * sizeof(T));
  const Space space(shape.empty()
                        ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                    "write " + name);
  const Properties creation(H5Pcreate(H5P_DATASET_CREATE), "write " + name);
  check(H5Pset_obj_track_times(creation, false), "write " + name);
  Dataset dataset(H5Dcreate2(group, name.c_str(), types_of(values).file, space, H5P_DEFAULT,
                             creation, H5P_DEFAULT),
                  "write " + name);
  if (count > 0)
    check(H5Dwrite(dataset, types_of(values).memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
          "write " + name);
  attribute(dataset, "units", label.units);
  attribute(dataset, "long_name", label.long_name);
  return dataset;
}

template <class T>
Dataset Output::dataset(hid_t group, const std::string& name, const T* values, std::size_t count,
                        const std::vector<std::string>& dimensions, const Label& label) {
  std::vector<Dataset> scales;
  std::vector<hsize_t> shape;
  hsize_t points = 1;
  for (const std::string& dimension : dimensions) {
    require(H5Lexists(group, dimension.c_str(), H5P_DEFAULT) > 0, "dimension", dimension,
            "is no coordinate of the group of " + name + "; write it first");
    scales.emplace_back(H5Dopen2(group, dimension.c_str(), H5P_DEFAULT), "open " + dimension);
    require(H5DSis_scale(scales.back()) > 0, "dimension", dimension, "is no coordinate");
    shape.push_back(shape_of(scales.back()).at(0));
    points *= shape.back();
  }
  require(points == count, name, count, "values do not fill " + joined(shape));
  Dataset result = create(group, name, values, shape, label);
  for (std::size_t i = 0; i < scales.size(); ++i)
    check(H5DSattach_scale(result, scales[i], static_cast<unsigned>(i)), "write " + name);
  return result;
}

template <class T>
void Output::scale(hid_t group, const std::string& name, const T* values, std::size_t count,
                   const Label& label) {
  const Dataset dataset = create(group, name, values, {count}, label);
  check(H5DSset_scale(dataset, name.c_str()), "write " + name);
}

void Output::text_scale(hid_t group, const std::string& name,
                        const std::vector<std::string>& values, const std::string& long_name) {
  require_free(group, name);
  std::vector<const char*> pointers;
  std::size_t bytes = 0;
  for (const std::string& value : values) {
    pointers.push_back(value.c_str());
    bytes += value.size() + 64;
  }
  make_room(bytes);
  const Type type = text_type(H5T_VARIABLE);
  const hsize_t count = values.size();
  const Space space(H5Screate_simple(1, &count, nullptr), "write " + name);
  const Dataset dataset(
      H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      "write " + name);
  if (count > 0)
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), "write " + name);
  attribute(dataset, "long_name", long_name);
  check(H5DSset_scale(dataset, name.c_str()), "write " + name);
}

void Output::commit() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write " + atomic_.target().string());
  hsize_t size = 0;
  check(H5Fget_filesize(file_, &size), "read the size of " + atomic_.target().string());
  if (!root_.closed() || !file_.closed())
    throw IoError("cannot close " + atomic_.target().string());
  atomic_.resize(size);
  atomic_.commit();
}

template Dataset Output::dataset(hid_t, const std::string&, const double*, std::size_t,
                                 const std::vector<std::string>&, const Label&);
template Dataset Output::dataset(hid_t, const std::string&, const float*, std::size_t,
                                 const std::vector<std::string>&, const Label&);
template Dataset Output::dataset(hid_t, const std::string&, const std::int16_t*, std::size_t,
                                 const std::vector<std::string>&, const Label&);
template Dataset Output::dataset(hid_t, const std::string&, const std::int64_t*, std::size_t,
                                 const std::vector<std::string>&, const Label&);
template Dataset Output::dataset(hid_t, const std::string&, const std::int8_t*, std::size_t,
                                 const std::vector<std::string>&, const Label&);
template void Output::scale(hid_t, const std::string&, const double*, std::size_t, const Label&);
template void Output::scale(hid_t, const std::string&, const std::int64_t*, std::size_t,
                            const Label&);

}  // namespace salebra::detail::hdf5
