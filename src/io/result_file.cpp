// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of results: HDF5 groups of datasets with names, units and coordinates.
#include <numeric>
#include <salebra/io/result_file.hpp>

#include "hdf5_output.hpp"

namespace salebra {

using detail::hdf5::Output;

std::vector<double> positions(Index count, double step) {
  std::vector<double> values;
  for (Index k = 0; k < count; ++k) values.push_back(static_cast<double>(k) * step);
  return values;
}

/// What a ResultFile and its groups share. Each group keeps the Output alive, so no handle of a
/// group outlives it.
struct ResultFile::State {
  std::shared_ptr<Output> output;
  std::vector<std::weak_ptr<ResultGroup::Place>> groups;
};

struct ResultGroup::Place {
  std::shared_ptr<Output> output;
  detail::hdf5::Group group;

  Output& open() const {
    require_that(output != nullptr, "result file", "a group is used after commit; write before");
    return *output;
  }
};

void ResultGroup::coordinate(const std::string& name, std::span<const double> values,
                             const std::string& units, const std::string& long_name) {
  location_->open().scale(location_->group, name, values.data(), values.size(), {units, long_name});
}

void ResultGroup::index(const std::string& name, std::size_t count, const std::string& long_name) {
  std::vector<std::int64_t> values(count);
  std::iota(values.begin(), values.end(), 0);
  location_->open().scale(location_->group, name, values.data(), count, {"1", long_name});
}

void ResultGroup::labels(const std::string& name, const std::vector<std::string>& values,
                         const std::string& long_name) {
  location_->open().text_scale(location_->group, name, values, long_name);
}

void ResultGroup::dataset(const std::string& name, std::span<const double> values,
                          const std::vector<std::string>& coordinates, const std::string& units,
                          const std::string& long_name) {
  location_->open().dataset(location_->group, name, values.data(), values.size(), coordinates,
                            {units, long_name});
}

void ResultGroup::dataset(const std::string& name, std::span<const std::int64_t> values,
                          const std::vector<std::string>& coordinates, const std::string& units,
                          const std::string& long_name) {
  location_->open().dataset(location_->group, name, values.data(), values.size(), coordinates,
                            {units, long_name});
}

void ResultGroup::dataset(const std::string& name, std::span<const float> values,
                          const std::vector<std::string>& coordinates, const std::string& units,
                          const std::string& long_name) {
  location_->open().dataset(location_->group, name, values.data(), values.size(), coordinates,
                            {units, long_name});
}

void ResultGroup::dataset(const std::string& name, std::span<const std::int16_t> values,
                          const std::vector<std::string>& coordinates, const std::string& units,
                          const std::string& long_name) {
  location_->open().dataset(location_->group, name, values.data(), values.size(), coordinates,
                            {units, long_name});
}

void ResultGroup::dataset(const std::string& name, const Field& values, const std::string& x,
                          const std::string& y, const std::string& units,
                          const std::string& long_name, FieldType type) {
  location_->open().field(location_->group, name, values, {x, y}, {units, long_name}, type);
}

void ResultGroup::flags(const std::string& name, const std::vector<bool>& values,
                        const std::vector<std::string>& coordinates, const std::string& long_name) {
  const std::vector<std::int8_t> bytes(values.begin(), values.end());
  Output& output = location_->open();
  const auto dataset = output.dataset(location_->group, name, bytes.data(), bytes.size(),
                                      coordinates, {"1", long_name});
  output.attribute(dataset, "dtype", std::string_view("bool"));
}

void ResultGroup::scalar(const std::string& name, double value, const std::string& units,
                         const std::string& long_name) {
  location_->open().dataset(location_->group, name, &value, 1, {}, {units, long_name});
}

void ResultGroup::attribute(const std::string& name, double value) {
  location_->open().attribute(location_->group, name, value);
}

void ResultGroup::attribute(const std::string& name, std::int64_t value) {
  location_->open().attribute(location_->group, name, value);
}

void ResultGroup::attribute(const std::string& name, std::string_view value) {
  location_->open().attribute(location_->group, name, value);
}

ResultFile::ResultFile(const std::filesystem::path& file, const Provenance& provenance,
                       const WriteOptions& options, const Communicator& communicator)
    : state_(std::make_unique<State>()) {
  state_->output = std::make_shared<Output>(file, provenance, options, communicator);
}

ResultFile::ResultFile(ResultFile&&) noexcept = default;
ResultFile& ResultFile::operator=(ResultFile&&) noexcept = default;
ResultFile::~ResultFile() = default;

ResultGroup ResultFile::group(const std::string& path) {
  require(state_->output != nullptr, "result file", path, "is requested after commit");
  auto location = std::make_shared<ResultGroup::Place>(
      ResultGroup::Place{state_->output, state_->output->group(path)});
  state_->groups.push_back(location);
  return ResultGroup(std::move(location));
}

void ResultFile::commit() {
  require_that(state_->output != nullptr, "result file", "commit was called twice");
  for (const auto& weak : state_->groups) {
    if (const auto location = weak.lock()) {
      location->group = {};
      location->output.reset();
    }
  }
  const auto output = std::move(state_->output);
  output->commit();
}

}  // namespace salebra
