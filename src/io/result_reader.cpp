// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of results: groups, datasets, labels and attributes of an HDF5 file.
#include <algorithm>
#include <salebra/io/result_file.hpp>

#include "hdf5_document.hpp"
#include "loaded_surface.hpp"

namespace salebra {

using detail::hdf5::Object;

struct ResultReader::State {
  detail::hdf5::Document document;

  std::vector<std::string> members(const std::string& path, Object::Kind first,
                                   Object::Kind second) const {
    std::vector<std::string> names;
    for (const auto& [name, kind] : document.group(path).members)
      if (kind == first || kind == second) names.push_back(name);
    return names;
  }

  /// The object at this path, for its attributes; nullptr if there is none. Throws InvalidInput if
  /// the object is of a refused kind.
  const Object* described(const std::string& path) const {
    const Object* object = document.find(path);
    if (!object) return nullptr;
    return object->kind == Object::Kind::group ? &document.group(path) : &document.dataset(path);
  }
};

ResultReader::ResultReader(const std::filesystem::path& file)
    : state_(std::make_unique<State>(State{detail::hdf5::Document(detail::InputFile(file))})) {}

ResultReader::ResultReader(ResultReader&&) noexcept = default;
ResultReader::~ResultReader() = default;

const std::filesystem::path& ResultReader::file() const { return state_->document.path(); }

bool ResultReader::has(const std::string& path) const {
  return state_->document.find(path) != nullptr;
}

std::vector<std::string> ResultReader::groups(const std::string& path) const {
  return state_->members(path, Object::Kind::group, Object::Kind::group);
}

std::vector<std::string> ResultReader::datasets(const std::string& path) const {
  return state_->members(path, Object::Kind::numbers, Object::Kind::labels);
}

std::vector<Index> ResultReader::shape(const std::string& dataset) const {
  const auto& extents = state_->document.dataset(dataset).shape;
  return std::vector<Index>(extents.begin(), extents.end());
}

std::vector<double> ResultReader::numbers(const std::string& dataset) const {
  std::vector<double> values(state_->document.numeric(dataset).count());
  state_->document.numbers(dataset, values);
  return values;
}

double ResultReader::number(const std::string& dataset) const {
  const std::vector<double> values = numbers(dataset);
  if (values.size() != 1) detail::refuse(file(), "has no single value in " + dataset);
  return values.front();
}

Field ResultReader::field(const std::string& dataset) const {
  const auto& extents = state_->document.numeric(dataset).shape;
  if (extents.size() != 2) detail::refuse(file(), "has no field in " + dataset);
  Field values(static_cast<Index>(extents[0]), static_cast<Index>(extents[1]));
  state_->document.numbers(dataset, {values.data(), static_cast<std::size_t>(values.size())});
  return values;
}

Field ResultReader::field(const std::string& dataset, const RowPartition& partition) const {
  const auto& extents = state_->document.numeric(dataset).shape;
  if (extents.size() != 2) detail::refuse(file(), "has no field in " + dataset);
  Field values(partition.count(), static_cast<Index>(extents[1]));
  state_->document.rows(dataset, partition,
                        {values.data(), static_cast<std::size_t>(values.size())});
  return values;
}

std::vector<std::string> ResultReader::labels(const std::string& dataset) const {
  const Object& object = state_->document.dataset(dataset);
  if (object.kind != Object::Kind::labels || !object.refusal.empty())
    detail::refuse(file(), "has no list of names in " + dataset);
  return object.labels;
}

bool ResultReader::holds_labels(const std::string& dataset) const {
  return state_->document.dataset(dataset).kind == Object::Kind::labels;
}

std::vector<std::string> ResultReader::coordinates(const std::string& dataset) const {
  return state_->document.dataset(dataset).coordinates;
}

std::optional<double> ResultReader::number_attribute(const std::string& path,
                                                     const std::string& name) const {
  const Object* object = state_->described(path);
  if (!object) return {};
  const auto value = object->number(name);
  return value ? value : object->number(detail::hdf5::former_name(name));
}

std::optional<std::string> ResultReader::text_attribute(const std::string& path,
                                                        const std::string& name) const {
  const Object* object = state_->described(path);
  if (!object) return {};
  const auto text = object->text(name);
  return text ? text : object->text(detail::hdf5::former_name(name));
}

std::vector<std::string> ResultReader::attributes(const std::string& path) const {
  const Object* object = state_->described(path);
  if (!object) detail::refuse(file(), "has nothing in " + path);
  std::vector<std::string> names;
  for (const auto& [name, value] : object->attributes) {
    constexpr std::string_view of_scales[] = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST",
                                              "_Netcdf4Dimid"};
    if (std::ranges::find(of_scales, name) == std::end(of_scales)) names.push_back(name);
  }
  return names;
}

}  // namespace salebra
