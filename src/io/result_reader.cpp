// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of results: groups, datasets, labels and attributes of an HDF5 file.
#include <hdf5_hl.h>

#include <algorithm>
#include <numeric>
#include <salebra/io/result_file.hpp>

#include "hdf5_handle.hpp"
#include "hdf5_read.hpp"
#include "loaded_surface.hpp"

namespace salebra {

using namespace detail::hdf5;

struct ResultReader::State {
  std::filesystem::path path;
  File file;

  /// Runs an HDF5 access; what HDF5 refuses becomes an error about the file.
  template <class Access>
  auto guarded(const Access& access) const {
    be_silent();
    try {
      return access();
    } catch (const IoError& error) {
      detail::refuse(path, std::string(error.what()) + "; it is not there, or the file is damaged");
    }
  }

  Dataset dataset(const std::string& name) const {
    if (!exists(name))
      detail::refuse(path, "has no dataset " + name + "; was it written by salebra?");
    return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), "open the dataset " + name};
  }

  bool exists(const std::string& name) const {
    for (std::size_t end = 0; end != std::string::npos;) {
      end = name.find('/', end + 1);
      const std::string head = name.substr(0, end);
      if (head != "/" && H5Lexists(file, head.c_str(), H5P_DEFAULT) <= 0) return false;
    }
    return true;
  }
};

ResultReader::ResultReader(const std::filesystem::path& file) : state_(std::make_unique<State>()) {
  state_->path = file;
  if (!std::filesystem::is_regular_file(file))
    detail::refuse(file, "does not exist; check the path");
  state_->guarded([&] {
    state_->file = File(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open it as HDF5");
  });
}

ResultReader::ResultReader(ResultReader&&) noexcept = default;
ResultReader::~ResultReader() = default;

const std::filesystem::path& ResultReader::file() const { return state_->path; }

bool ResultReader::has(const std::string& path) const {
  return state_->guarded([&] { return state_->exists(path); });
}

std::vector<std::string> ResultReader::groups(const std::string& path) const {
  return state_->guarded([&] {
    const Group group(H5Gopen2(state_->file, path.c_str(), H5P_DEFAULT), "open the group " + path);
    return members(group, H5O_TYPE_GROUP);
  });
}

std::vector<std::string> ResultReader::datasets(const std::string& path) const {
  return state_->guarded([&] {
    const Group group(H5Gopen2(state_->file, path.c_str(), H5P_DEFAULT), "open the group " + path);
    return members(group, H5O_TYPE_DATASET);
  });
}

std::vector<Index> ResultReader::shape(const std::string& dataset) const {
  return state_->guarded([&] {
    const std::vector<hsize_t> extents = shape_of(state_->dataset(dataset));
    return std::vector<Index>(extents.begin(), extents.end());
  });
}

std::vector<double> ResultReader::numbers(const std::string& dataset) const {
  return state_->guarded([&] {
    const Dataset handle = state_->dataset(dataset);
    require_stored(state_->path, handle, dataset);
    const std::vector<hsize_t> extents = shape_of(handle);
    std::vector<double> values(
        std::accumulate(extents.begin(), extents.end(), hsize_t{1}, std::multiplies<>()));
    if (!values.empty())
      check(H5Dread(handle, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
            "read the dataset " + dataset);
    return values;
  });
}

double ResultReader::number(const std::string& dataset) const {
  const std::vector<double> values = numbers(dataset);
  if (values.size() != 1) detail::refuse(state_->path, "has no single value in " + dataset);
  return values.front();
}

Field ResultReader::field(const std::string& dataset) const {
  const std::vector<Index> extents = shape(dataset);
  if (extents.size() != 2) detail::refuse(state_->path, "has no field in " + dataset);
  const std::vector<double> values = numbers(dataset);
  return Eigen::Map<const Field>(values.data(), extents[0], extents[1]);
}

std::vector<std::string> ResultReader::labels(const std::string& dataset) const {
  return state_->guarded([&] {
    const Dataset handle = state_->dataset(dataset);
    const Type type(H5Dget_type(handle), "read the type of " + dataset);
    const std::vector<hsize_t> extents = shape_of(handle);
    if (H5Tis_variable_str(type) <= 0 || extents.size() != 1 ||
        H5Dget_storage_size(handle) < extents[0])
      detail::refuse(state_->path, "has no list of names in " + dataset);
    std::vector<char*> pointers(extents[0]);
    std::vector<std::string> values;
    if (pointers.empty()) return values;
    check(H5Dread(handle, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()),
          "read the dataset " + dataset);
    for (const char* text : pointers) values.emplace_back(text ? text : "");
    const Space space(H5Dget_space(handle), "read " + dataset);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
    return values;
  });
}

bool ResultReader::holds_labels(const std::string& dataset) const {
  return state_->guarded([&] {
    const Type type(H5Dget_type(state_->dataset(dataset)), "read the type of " + dataset);
    return H5Tget_class(type) == H5T_STRING;
  });
}

std::vector<std::string> ResultReader::coordinates(const std::string& dataset) const {
  return state_->guarded([&] {
    const Dataset handle = state_->dataset(dataset);
    std::vector<std::string> names;
    const auto collect = [](hid_t, unsigned, hid_t scale, void* list) -> herr_t {
      std::string path(
          static_cast<std::size_t>(std::max<ssize_t>(H5Iget_name(scale, nullptr, 0), 0)), '\0');
      H5Iget_name(scale, path.data(), path.size() + 1);
      static_cast<std::vector<std::string>*>(list)->push_back(path.substr(path.rfind('/') + 1));
      return 1;
    };
    for (unsigned i = 0; i < shape_of(handle).size(); ++i)
      check(H5DSiterate_scales(handle, i, nullptr, collect, &names), "read the axes of " + dataset);
    return names;
  });
}

std::optional<double> ResultReader::number_attribute(const std::string& path,
                                                     const std::string& name) const {
  return state_->guarded([&]() -> std::optional<double> {
    if (!state_->exists(path)) return {};
    const Handle<H5Oclose> object(H5Oopen(state_->file, path.c_str(), H5P_DEFAULT), "open " + path);
    return detail::hdf5::number_attribute(object, name.c_str());
  });
}

std::optional<std::string> ResultReader::text_attribute(const std::string& path,
                                                        const std::string& name) const {
  return state_->guarded([&]() -> std::optional<std::string> {
    if (!state_->exists(path)) return {};
    const Handle<H5Oclose> object(H5Oopen(state_->file, path.c_str(), H5P_DEFAULT), "open " + path);
    return detail::hdf5::text_attribute(object, name.c_str());
  });
}

std::vector<std::string> ResultReader::attributes(const std::string& path) const {
  return state_->guarded([&] {
    const Handle<H5Oclose> object(H5Oopen(state_->file, path.c_str(), H5P_DEFAULT), "open " + path);
    std::vector<std::string> names = attributes_of(object);
    std::erase_if(names, [](const std::string& name) {
      constexpr std::string_view of_scales[] = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST",
                                                "_Netcdf4Dimid"};
      return std::ranges::find(of_scales, name) != std::end(of_scales);
    });
    return names;
  });
}

}  // namespace salebra
