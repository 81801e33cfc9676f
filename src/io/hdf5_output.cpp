// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of HDF5 files: datasets with units, long names and dimension scales.
#include "hdf5_output.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <salebra/base/row_partition.hpp>
#include <salebra/base/version.hpp>

namespace salebra::detail::hdf5 {
namespace {

/// Type of a number in the file and in memory. In the file it is little-endian on every machine, so
/// files have the same bytes everywhere.
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

/// The dimension scales (coordinates) of a dataset.
struct Scales {
  std::vector<Dataset> handles;
  std::vector<hsize_t> shape;
};

Scales scales_of(hid_t group, const std::string& name, const std::vector<std::string>& dimensions) {
  Scales scales;
  for (const std::string& dimension : dimensions) {
    require(H5Lexists(group, dimension.c_str(), H5P_DEFAULT) > 0, "dimension", dimension,
            "is not a coordinate of the group of " + name + "; write it first");
    scales.handles.emplace_back(H5Dopen2(group, dimension.c_str(), H5P_DEFAULT),
                                "open " + dimension);
    require(H5DSis_scale(scales.handles.back()) > 0, "dimension", dimension, "is not a coordinate");
    scales.shape.push_back(shape_of(scales.handles.back()).at(0));
  }
  return scales;
}

hsize_t points_of(const std::vector<hsize_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
}

Dataset attached(const Scales& scales, Dataset dataset, const std::string& name) {
  for (std::size_t i = 0; i < scales.handles.size(); ++i)
    check(H5DSattach_scale(dataset, scales.handles[i], static_cast<unsigned>(i)), "write " + name);
  return dataset;
}

template <class T>
std::string_view bytes_of(const T* values, Index count) {
  return {reinterpret_cast<const char*>(values), static_cast<std::size_t>(count) * sizeof(T)};
}

/// Writes a field as float32, in blocks, because a converted copy of the whole field would need
/// more memory.
void write_rounded(const std::filesystem::path& target, int descriptor, std::uint64_t location,
                   const Field& values) {
  constexpr Index most = 1 << 18;
  std::vector<float> rounded;
  for (Index first = 0; first < values.size(); first += most) {
    const Index count = std::min(most, values.size() - first);
    rounded.assign(values.data() + first, values.data() + first + count);
    write_at(target, descriptor, location + static_cast<std::uint64_t>(first) * sizeof(float),
             bytes_of(rounded.data(), count));
  }
}

void require_free(hid_t group, const std::string& name) {
  require(!name.empty() && name.find('/') == std::string::npos, "dataset", "'" + name + "'",
          "is not a valid name");
  require(H5Lexists(group, name.c_str(), H5P_DEFAULT) <= 0, "dataset", name,
          "is in the file already");
}

}  // namespace

Output::Output(const std::filesystem::path& file, const Provenance& provenance,
               const WriteOptions& options, const Communicator& communicator, Fields fields)
    : target_(file),
      communicator_(communicator),
      copies_fields_(communicator.alone() && fields == Fields::copied) {
  if (!communicator_.is_root()) return;
  atomic_.emplace(file, options);
  be_silent();
  closed_before_ = failed_closes();
  file_ = create_in(pages_.emplace(*atomic_));
  root_ = Group(H5Gopen2(file_, "/", H5P_DEFAULT), "open the root of " + file.string());
  attribute(root_, "program", std::string_view("salebra"));
  attribute(root_, "version", version());
  attribute(root_, "libraries", library_versions());
  attribute(root_, "arithmetic",
            provenance.arithmetic.empty() ? arithmetic() : provenance.arithmetic);
  if (!provenance.revision.empty()) attribute(root_, "revision", provenance.revision);
  if (!provenance.started.empty()) attribute(root_, "started", provenance.started);
  attribute(root_, "created", provenance.created.empty() ? utc_now() : provenance.created);
  attribute(root_, "command_line", provenance.command_line);
  attribute(root_, "configuration", provenance.configuration);
  if (provenance.seed) attribute(root_, "seed", *provenance.seed);
}

Group Output::group(const std::string& path) {
  if (!communicator_.is_root()) return {};
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
  if (!communicator_.is_root()) return;
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
  if (!communicator_.is_root()) return;
  // Texts have variable length: h5py and xarray read these as str, texts of fixed length as bytes.
  // They may also exceed the 64 KiB of an object header.
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
                       const std::vector<hsize_t>& shape, const Label& label, bool spread) {
  require_free(group, name);
  require(!label.units.empty() && !label.long_name.empty(), "dataset", name,
          "has no units or long_name; give both");
  const hsize_t count = points_of(shape);
  const Space space(shape.empty()
                        ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                    "write " + name);
  const Properties creation(H5Pcreate(H5P_DATASET_CREATE), "write " + name);
  check(H5Pset_obj_track_times(creation, false), "write " + name);
  Dataset dataset(H5Dcreate2(group, name.c_str(), types_of(values).file, space, H5P_DEFAULT,
                             creation, H5P_DEFAULT),
                  "write " + name);
  if (spread) {
    // Writes one number, since HDF5 then allocates the space of the dataset in the file.
    const std::vector<hsize_t> first(shape.size(), 0), one(shape.size(), 1);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, one.data(), nullptr),
          "write " + name);
    const Space single(H5Screate(H5S_SCALAR), "write " + name);
    check(H5Dwrite(dataset, types_of(values).memory, single, space, H5P_DEFAULT, values),
          "write " + name);
  } else {
    if (count > 0)
      check(H5Dwrite(dataset, types_of(values).memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
            "write " + name);
  }
  pages_->require_written();
  attribute(dataset, "units", label.units);
  attribute(dataset, "long_name", label.long_name);
  return dataset;
}

template <class T>
Dataset Output::dataset(hid_t group, const std::string& name, const T* values, std::size_t count,
                        const std::vector<std::string>& dimensions, const Label& label) {
  if (!communicator_.is_root()) return {};
  const Scales scales = scales_of(group, name, dimensions);
  require(points_of(scales.shape) == count, name, count,
          "values do not fill " + joined(scales.shape));
  return attached(scales, create(group, name, values, scales.shape, label), name);
}

Dataset Output::field(hid_t group, const std::string& name, const Field& values,
                      const std::vector<std::string>& dimensions, const Label& label,
                      FieldType type) {
  const bool single = type == FieldType::float32;
  if (copies_fields_) {
    const auto count = static_cast<std::size_t>(values.size());
    if (!single) return dataset(group, name, values.data(), count, dimensions, label);
    const std::vector<float> rounded(values.data(), values.data() + count);
    return dataset(group, name, rounded.data(), count, dimensions, label);
  }
  fields_.push_back({&values, type});
  if (!communicator_.is_root()) return {};
  const Scales scales = scales_of(group, name, dimensions);
  const auto first = static_cast<float>(*values.data());
  Dataset result = single ? create(group, name, &first, scales.shape, label, true)
                          : create(group, name, values.data(), scales.shape, label, true);
  // This offset counts from the superblock, which is at the beginning of the file, since the file
  // has no user block.
  const haddr_t location = H5Dget_offset(result);
  check(location == HADDR_UNDEF ? -1 : 0, "place " + name);
  spread_.push_back({location, static_cast<std::int64_t>(scales.shape[0]),
                     static_cast<std::int64_t>(scales.shape[1])});
  return attached(scales, std::move(result), name);
}

template <class T>
void Output::scale(hid_t group, const std::string& name, const T* values, std::size_t count,
                   const Label& label) {
  if (!communicator_.is_root()) return;
  const Dataset dataset = create(group, name, values, {count}, label);
  check(H5DSset_scale(dataset, name.c_str()), "write " + name);
}

void Output::text_scale(hid_t group, const std::string& name,
                        const std::vector<std::string>& values, const std::string& long_name) {
  if (!communicator_.is_root()) return;
  require_free(group, name);
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  const Type type = text_type(H5T_VARIABLE);
  const hsize_t count = values.size();
  const Space space(H5Screate_simple(1, &count, nullptr), "write " + name);
  const Properties creation(H5Pcreate(H5P_DATASET_CREATE), "write " + name);
  check(H5Pset_obj_track_times(creation, false), "write " + name);
  const Dataset dataset(
      H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
      "write " + name);
  if (count > 0)
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), "write " + name);
  attribute(dataset, "long_name", long_name);
  check(H5DSset_scale(dataset, name.c_str()), "write " + name);
}

void Output::write_without_fields() {
  const std::string name = target_.string();
  if (!root_.closed()) throw IoError("cannot close the root of " + name);
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write " + name);
  pages_->finish(size_of(file_));
  if (!file_.closed() || failed_closes() != closed_before_) throw IoError("cannot close " + name);
}

void Output::commit() {
  collectively(communicator_, [&] {
    if (communicator_.is_root()) write_without_fields();
  });
  if (!copies_fields_) write_fields();
  collectively(communicator_, [&] {
    if (atomic_) atomic_->commit();
  });
}

void Output::write_fields() {
  static_assert(std::endian::native == std::endian::little);
  std::string temporary = atomic_ ? atomic_->temporary().string() : "";
  std::array<std::size_t, 2> lengths{temporary.size(), spread_.size()};
  communicator_.broadcast(lengths.data(), sizeof lengths);
  temporary.resize(lengths[0]);
  communicator_.broadcast(temporary.data(), temporary.size());
  spread_.resize(lengths[1]);
  communicator_.broadcast(spread_.data(), spread_.size() * sizeof(Spread));
  collectively(communicator_, [&] {
    require(fields_.size() == spread_.size(), "result file", fields_.size(),
            "fields are given by one process, and others by another");
    const OthersFile file(temporary, target_);
    for (std::size_t k = 0; k < spread_.size(); ++k) {
      const auto& [location, rows, columns] = spread_[k];
      const RowPartition partition(communicator_, rows);
      const Field& mine = *fields_[k].values;
      require(mine.rows() == partition.count() && mine.cols() == columns, "field", mine.rows(),
              "rows are not those of this process");
      const auto begin = static_cast<std::uint64_t>(partition.begin() * columns);
      if (mine.size() > 0 && fields_[k].type == FieldType::float32)
        write_rounded(target_, file.descriptor(), location + begin * sizeof(float), mine);
      else if (mine.size() > 0)
        write_at(target_, file.descriptor(), location + begin * sizeof(double),
                 bytes_of(mine.data(), mine.size()));
    }
    flush(target_, file.descriptor());
  });
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
