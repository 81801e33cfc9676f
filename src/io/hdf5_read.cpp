// SPDX-License-Identifier: GPL-3.0-or-later
// The only functions that call HDF5 on a file that is read. They read the outline of the file, or
// the numbers of one dataset.
#include <hdf5_hl.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "base/archive.hpp"
#include "hdf5_document.hpp"
#include "hdf5_drivers.hpp"
#include "loaded_surface.hpp"

namespace salebra::detail::hdf5 {
namespace {

/// The outline contains the values of datasets that have at most this number of values.
constexpr std::uint64_t small_dataset = 8192;
constexpr std::size_t deepest = 32, longest_path = 4096, longest_fixed_text = 1 << 20;
/// Number of bytes of doubles that are handed over at a time; more if a chunk is larger.
constexpr std::uint64_t block_bytes = 1 << 20;

/// The type that H5Oget_info2() fills in. In HDF5 1.12 and later the name H5O_info_t means another
/// type.
#if H5_VERSION_GE(1, 12, 0)
using ObjectInfo = H5O_info1_t;
#else
using ObjectInfo = H5O_info_t;
#endif

struct Link {
  std::string name;
  H5L_type_t type;
};

herr_t collect_link(hid_t, const char* name, const H5L_info_t* info, void* links) {
  static_cast<std::vector<Link>*>(links)->push_back({name, info->type});
  return 0;
}

herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

std::string text_of(hid_t attribute, hid_t type, const std::string& what) {
  if (H5Tis_variable_str(type) > 0) {
    char* stored = nullptr;
    const Type memory(H5Tcopy(type), what);
    check(H5Aread(attribute, memory, &stored), what);
    std::string text = stored ? stored : "";
    H5free_memory(stored);
    return text;
  }
  std::string text(std::min(H5Tget_size(type), longest_fixed_text), '\0');
  if (text.size() == longest_fixed_text) return {};
  check(H5Aread(attribute, type, text.data()), what);
  text.resize(std::min(text.find('\0'), text.size()));
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

/// The value of a scalar attribute if it is a number, a boolean as h5py writes it, or a text;
/// otherwise null.
AttributeValue value_of(hid_t object, const std::string& name) {
  const std::string what = "read the attribute " + name;
  const Attribute attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), what);
  const Space space(H5Aget_space(attribute), what);
  const Type type(H5Aget_type(attribute), what);
  if (H5Sget_simple_extent_npoints(space) != 1) return {};
  const H5T_class_t kind = H5Tget_class(type);
  if (kind == H5T_STRING) return text_of(attribute, type, what);
  if (kind == H5T_ENUM) {
    signed char flag = 0;
    const Type native(H5Tget_native_type(type, H5T_DIR_ASCEND), what);
    if (H5Tget_size(native) != sizeof flag) return {};
    check(H5Aread(attribute, native, &flag), what);
    return static_cast<double>(flag);
  }
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) return {};
  double value = 0;
  check(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), what);
  return value;
}

/// Names of dimension scales by their addresses in the file. HDF5 would search the file for each
/// name, which took nine tenths of the time to read a study.
using ScaleNames = std::map<haddr_t, std::string>;

std::string name_of(hid_t scale) {
  std::string path(static_cast<std::size_t>(std::max<ssize_t>(H5Iget_name(scale, nullptr, 0), 0)),
                   '\0');
  H5Iget_name(scale, path.data(), path.size() + 1);
  return path.substr(path.rfind('/') + 1);
}

std::vector<std::string> coordinates_of(hid_t dataset, std::size_t rank, ScaleNames& known) {
  std::vector<std::string> names;
  std::pair<ScaleNames&, std::vector<std::string>&> locations{known, names};
  const auto collect = [](hid_t, unsigned, hid_t scale, void* data) -> herr_t {
    auto& [by_place, list] = *static_cast<decltype(locations)*>(data);
    ObjectInfo info;
    if (H5Oget_info2(scale, &info, H5O_INFO_BASIC) < 0) return -1;
    const auto [found, is_new] = by_place.try_emplace(info.addr);
    if (is_new) found->second = name_of(scale);
    list.push_back(found->second);
    return 1;
  };
  for (unsigned i = 0; i < rank; ++i)
    check(H5DSiterate_scales(dataset, i, nullptr, collect, &locations), "read its axes");
  return names;
}

/// The reason to refuse a dataset for the way it is stored: its values lie in other files, or a
/// filter is not on the list of allowed ones. Empty if there is none. Must be called before the
/// shape is requested: for a virtual dataset, HDF5 would then open the source files.
std::string strange_storage(hid_t properties) {
  if (H5Pget_layout(properties) == H5D_VIRTUAL)
    return "is a virtual dataset, whose values lie in other files; store the values themselves";
  if (H5Pget_external_count(properties) != 0)
    return "lies in external files; store its values in the file itself";
  std::vector<H5Z_filter_t> known{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
  const int filters = H5Pget_nfilters(properties);
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(properties, static_cast<unsigned>(i), &flags,
                                               &values, nullptr, 0, nullptr, nullptr);
    if (std::erase(known, filter) == 0)
      return "passes through filter " + std::to_string(filter) +
             " or through one filter twice; use at most one each of shuffle, deflate and "
             "fletcher32";
  }
  return {};
}

std::vector<hsize_t> chunk_of(hid_t properties, std::size_t rank) {
  std::vector<hsize_t> chunk(rank);
  if (rank == 0 || H5Pget_layout(properties) != H5D_CHUNKED) return {};
  check(H5Pget_chunk(properties, static_cast<int>(rank), chunk.data()), "read its chunks");
  return chunk;
}

/// The reason to refuse a dataset for its size: it is larger than the file can contain, or takes
/// more memory than allowed. Empty if there is none. Thus a damaged or hostile header cannot decide
/// how much memory is allocated.
std::string excess(const InputFile& file, hid_t dataset, hid_t properties,
                   const std::vector<hsize_t>& shape) {
  const Type type(H5Dget_type(dataset), "read its type");
  const H5T_class_t kind = H5Tget_class(type);
  constexpr std::size_t max_number = 16;
  const std::size_t size = H5Tget_size(type);
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || size == 0 || size > max_number)
    return "is not of real numbers; store float64";
  hsize_t bytes = size, doubles = sizeof(double);
  for (const hsize_t extent : shape)
    if (__builtin_mul_overflow(bytes, extent, &bytes) ||
        __builtin_mul_overflow(doubles, extent, &doubles))
      return "is larger than any memory; the file is damaged";
  // A deflate stream has at least 1/1032 of the size of its content.
  constexpr hsize_t best_compression = 1032;
  const bool packed = H5Pget_nfilters(properties) > 0;
  if (bytes / (packed ? best_compression : 1) >
      std::min<hsize_t>(H5Dget_storage_size(dataset), file.size()))
    return "is larger than its data in the file; the file is truncated or damaged";
  if (doubles > max_bytes(file.size()))
    return "takes " + std::to_string(doubles) + " bytes unpacked, too many for a file of " +
           std::to_string(file.size()) + "; store it without deflate";
  // HDF5 unpacks whole chunks, even if the dataset needs only a small part of one.
  constexpr hsize_t any_chunk = 16 << 20;
  hsize_t chunk_bytes = size;
  for (const hsize_t extent : chunk_of(properties, shape.size()))
    if (__builtin_mul_overflow(chunk_bytes, extent, &chunk_bytes)) chunk_bytes = HSIZE_UNDEF;
  if (chunk_bytes > std::max(any_chunk, bytes))
    return "has chunks larger than itself; store it without chunks";
  return {};
}

/// Offset in the file of the doubles of a dataset, if they need no unpacking or conversion;
/// otherwise nothing.
std::optional<std::uint64_t> place_of(hid_t dataset, hid_t type, hid_t properties,
                                      std::uint64_t count) {
  if (H5Pget_layout(properties) != H5D_CONTIGUOUS || H5Tequal(type, H5T_NATIVE_DOUBLE) <= 0 ||
      H5Dget_storage_size(dataset) != count * sizeof(double))
    return {};
  const haddr_t location = H5Dget_offset(dataset);
  return location == HADDR_UNDEF ? std::nullopt : std::optional<std::uint64_t>(location);
}

class Outline {
 public:
  explicit Outline(const InputFile& file)
      : file_(file),
        bytes_left_(std::uint64_t{32 << 20} + 8 * file.size()),
        number_bytes_left_(bytes_left_ / 4),
        handle_(open_descriptor(file.descriptor())) {}

  Objects read() {
    visit("", H5Oopen(handle_, "/", H5P_DEFAULT), 0);
    return std::move(objects_);
  }

 private:
  using Any = Handle<H5Oclose>;

  /// Counts the memory of the outline and throws if it is too large: many links to one object would
  /// multiply it.
  void take(std::uint64_t bytes) {
    if (bytes > bytes_left_)
      refuse(
          file_.path(),
          "has more groups, links and attributes than a file of its size can hold; it is damaged");
    bytes_left_ -= bytes;
  }

  Object::Kind keep(const std::string& path, Object object) {
    const Object::Kind kind = object.kind;
    objects_.emplace_back(path.empty() ? "/" : path, std::move(object));
    return kind;
  }

  Object::Kind refuse_object(const std::string& path, std::string why) {
    take(512 + 2 * path.size());
    Object object;
    object.refusal = std::move(why);
    return keep(path, std::move(object));
  }

  Object::Kind visit(const std::string& path, hid_t id, std::size_t depth) {
    try {
      const Any opened(id, "open " + (path.empty() ? "the root" : path));
      ObjectInfo info;
      check(H5Oget_info2(opened, &info, H5O_INFO_BASIC), "read " + path);
      if (info.type == H5O_TYPE_DATASET) return visit_dataset(path, opened);
      if (info.type != H5O_TYPE_GROUP) return refuse_object(path, "is neither group nor dataset");
      // A group that contains itself, or can be reached by many paths, would be listed without end.
      if (!groups_.insert(info.addr).second)
        return refuse_object(path, "is a group with several names; give it one");
      if (depth > deepest)
        return refuse_object(path, "is nested too deeply in groups; the file is damaged");
      return visit_group(path, opened, depth);
    } catch (const IoError& error) {
      return refuse_object(path, std::string(error.what()) + "; the file is truncated or damaged");
    }
  }

  void read_attributes(hid_t id, Object& object) {
    std::vector<std::string> names;
    check(H5Aiterate2(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &names),
          "list attributes");
    for (const std::string& name : names) {
      AttributeValue value = value_of(id, name);
      const auto* text = std::get_if<std::string>(&value);
      take(128 + name.size() + (text ? text->size() : 0));
      object.attributes.emplace_back(name, std::move(value));
    }
  }

  Object::Kind visit_group(const std::string& path, hid_t id, std::size_t depth) {
    take(512 + 2 * path.size());
    Object object;
    object.kind = Object::Kind::group;
    read_attributes(id, object);
    std::vector<Link> links;
    check(H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_link, &links),
          "list a group");
    for (const auto& [name, type] : links) {
      const std::string inner = path + "/" + name;
      object.members.emplace_back(name, visit_link(inner, id, name, type, depth));
    }
    return keep(path, std::move(object));
  }

  Object::Kind visit_link(const std::string& path, hid_t group, const std::string& name,
                          H5L_type_t type, std::size_t depth) {
    if (path.size() > longest_path)
      refuse(file_.path(),
             "has names of more than " + std::to_string(longest_path) + " bytes; it is damaged");
    if (type == H5L_TYPE_HARD)
      return visit(path, H5Oopen(group, name.c_str(), H5P_DEFAULT), depth + 1);
    return refuse_object(path, type == H5L_TYPE_SOFT ? "is a symbolic link; store the object itself"
                               : type == H5L_TYPE_EXTERNAL
                                   ? "is an external link, to another file; store the object itself"
                                   : "is a link of an unknown kind; store the object itself");
  }

  Object::Kind visit_dataset(const std::string& path, hid_t id) {
    const Properties properties(H5Dget_create_plist(id), "read the layout of " + path);
    if (std::string why = strange_storage(properties); !why.empty())
      return refuse_object(path, std::move(why));
    take(512 + 2 * path.size());
    Object object;
    object.kind = Object::Kind::numbers;
    const std::vector<hsize_t> shape = shape_of(id);
    object.shape.assign(shape.begin(), shape.end());
    const Type type(H5Dget_type(id), "read the type of " + path);
    read_attributes(id, object);
    object.coordinates = coordinates_of(id, shape.size(), scale_names_);
    for (const std::string& name : object.coordinates) take(64 + name.size());
    if (H5Tget_class(type) == H5T_STRING) {
      object.kind = Object::Kind::labels;
      read_labels(id, type, object);
    } else {
      object.refusal = excess(file_, id, properties, shape);
      read_small(id, object);
      if (object.refusal.empty()) object.location = place_of(id, type, properties, object.count());
    }
    return keep(path, std::move(object));
  }

  void read_labels(hid_t id, hid_t type, Object& object) {
    if (H5Tis_variable_str(type) <= 0 || object.shape.size() != 1 ||
        H5Dget_storage_size(id) < object.shape[0]) {
      object.refusal = "is not a list of names";
      return;
    }
    take(8 * object.shape[0]);
    std::vector<char*> pointers(object.shape[0]);
    if (pointers.empty()) return;
    check(H5Dread(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), "read its names");
    for (const char* text : pointers) {
      object.labels.emplace_back(text ? text : "");
      take(64 + object.labels.back().size());
    }
    const Space space(H5Dget_space(id), "read its names");
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  }

  void read_small(hid_t id, Object& object) {
    if (!object.refusal.empty() || object.count() > small_dataset ||
        object.count() * sizeof(double) > number_bytes_left_)
      return;
    number_bytes_left_ -= object.count() * sizeof(double);
    std::vector<double> values(object.count());
    if (!values.empty())
      check(H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
            "read its values");
    object.numbers = std::move(values);
  }

  const InputFile& file_;
  std::uint64_t bytes_left_, number_bytes_left_;
  File handle_;
  Objects objects_;
  std::set<haddr_t> groups_;
  ScaleNames scale_names_;
};

/// Number of indices of the first dimension to read at a time: whole chunks, so that no chunk is
/// unpacked twice.
hsize_t rows_at_once(hid_t properties, const std::vector<hsize_t>& shape) {
  hsize_t row = sizeof(double);
  for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
  const std::vector<hsize_t> chunk = chunk_of(properties, shape.size());
  const hsize_t step = chunk.empty() ? 1 : std::max<hsize_t>(chunk[0], 1);
  return std::max<hsize_t>(block_bytes / std::max<hsize_t>(row, 1) / step, 1) * step;
}

/// Calls work(check), which calls HDF5, and turns HDF5's errors into exceptions that name the file.
/// check() throws if a read has failed; work must call it before it hands anything over.
template <class Work>
void about(const InputFile& file, const Work& work) {
  be_silent();
  H5PLset_loading_state(0);  // forbids HDF5 to load filters from plug-ins
  const auto require_read = [&] {
    if (const int error = failed_read(); error != 0)
      throw IoError(file.path().string() + ": cannot be read (" + std::strerror(error) +
                    "); check the disk");
  };
  try {
    work(require_read);
  } catch (const Error& error) {
    require_read();
    if (dynamic_cast<const InvalidInput*>(&error)) throw;
    refuse(file.path(), std::string(error.what()) + "; it is truncated or damaged");
  }
}

}  // namespace

void read_outline(const InputFile& file, const HandOver& hand_over) {
  about(file, [&](const auto& require_read) {
    const std::string bytes = detail::bytes_of(Outline(file).read());
    require_read();
    hand_over(std::as_bytes(std::span(bytes)));
  });
}

void read_numbers(const InputFile& file, const std::string& path,
                  const std::vector<std::uint64_t>& shape, std::uint64_t begin, std::uint64_t end,
                  const HandOver& hand_over) {
  about(file, [&](const auto& require_read) {
    const File handle = open_descriptor(file.descriptor());
    const Dataset dataset(H5Dopen2(handle, path.c_str(), H5P_DEFAULT), "open " + path);
    const Properties properties(H5Dget_create_plist(dataset), "read the layout of " + path);
    std::string why = strange_storage(properties);
    const std::vector<hsize_t> now = why.empty() ? shape_of(dataset) : std::vector<hsize_t>{};
    if (why.empty()) why = excess(file, dataset, properties, now);
    if (!std::ranges::equal(now, shape)) why = "changed while it was read";
    if (!why.empty()) refuse(file.path(), path + " " + why);
    if (now.empty()) {
      double value = 0;
      check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value),
            "read " + path);
      require_read();
      return hand_over(std::as_bytes(std::span(&value, 1)));
    }
    hsize_t row = 1;
    for (std::size_t i = 1; i < now.size(); ++i) row *= now[i];
    const hsize_t rows = std::min<hsize_t>(end - begin, rows_at_once(properties, now));
    std::vector<double> values(rows * row);
    const Space in_file(H5Dget_space(dataset), "read " + path);
    std::vector<hsize_t> start(now.size()), count = now;
    for (hsize_t first = begin; first < end && row > 0; first += rows) {
      start[0] = first;
      count[0] = std::min<hsize_t>(rows, end - first);
      check(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, count.data(),
                                nullptr),
            "read " + path);
      const Space in_memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                            "read " + path);
      check(H5Dread(dataset, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, values.data()),
            "read " + path);
      require_read();
      hand_over(std::as_bytes(std::span(values.data(), count[0] * row)));
    }
  });
}

void alone(const std::function<void()>& work) {
  be_silent();
  // HDF5 holds its lock while it calls this function, so no other thread is inside HDF5 then.
  const auto call = [](hid_t, const char*, void* argument) -> herr_t {
    (*static_cast<const std::function<void()>*>(argument))();
    return 1;
  };
  H5Piterate(H5P_FILE_ACCESS_DEFAULT, nullptr, call, const_cast<std::function<void()>*>(&work));
}

}  // namespace salebra::detail::hdf5
