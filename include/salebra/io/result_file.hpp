// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace salebra {

/// Returns the positions k·step of the rows or columns k = 0 to count − 1 of a grid, m.
std::vector<double> positions(Index count, double step);

/// One group of a ResultFile, with coordinates and datasets on them. xarray opens a group with
/// xarray.open_dataset(file, engine="h5netcdf", group=name). Every dataset has `units` (SI, "1" for
/// pure numbers) and a `long_name`; unknown values are NaN.
/// throws   InvalidInput for a name used twice, a missing unit, or values without the shape of
///          their coordinates; IoError if the disk is full
class ResultGroup {
 public:
  /// Writes a one-dimensional coordinate, which becomes an HDF5 dimension scale.
  void coordinate(const std::string& name, std::span<const double> values, const std::string& units,
                  const std::string& long_name);
  /// Writes a coordinate with the integers from 0 to count − 1.
  void index(const std::string& name, std::size_t count, const std::string& long_name);
  /// Writes a coordinate of texts, such as names of models.
  void labels(const std::string& name, const std::vector<std::string>& values,
              const std::string& long_name);

  /// Writes values on coordinates of this group; the last coordinate varies fastest.
  void dataset(const std::string& name, std::span<const double> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  void dataset(const std::string& name, std::span<const std::int64_t> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  /// Writes values in single precision or as small integers, which suffices for images.
  void dataset(const std::string& name, std::span<const float> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  void dataset(const std::string& name, std::span<const std::int16_t> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  /// Writes a field on the coordinates x and y. In a file of several processes, `values` has the
  /// rows of this process according to RowPartition, and must exist until commit().
  void dataset(const std::string& name, const Field& values, const std::string& x,
               const std::string& y, const std::string& units, const std::string& long_name,
               FieldType type = FieldType::float64);
  /// Writes booleans, stored as 0 and 1, which xarray reads as bool.
  void flags(const std::string& name, const std::vector<bool>& values,
             const std::vector<std::string>& coordinates, const std::string& long_name);
  void scalar(const std::string& name, double value, const std::string& units,
              const std::string& long_name);

  void attribute(const std::string& name, double value);
  void attribute(const std::string& name, std::int64_t value);
  void attribute(const std::string& name, int value) { attribute(name, std::int64_t{value}); }
  void attribute(const std::string& name, std::string_view value);
  void attribute(const std::string& name, const char* value) {
    attribute(name, std::string_view(value));
  }

 private:
  friend class ResultFile;
  struct Place;
  explicit ResultGroup(std::shared_ptr<Place> location) : location_(std::move(location)) {}
  std::shared_ptr<Place> location_;
};

/// HDF5 file of results, with a group for each stage (for example `surface`, `curve`, `fit`,
/// `damping`) and the provenance at its root.
///     ResultFile file("result.h5", {});
///     file.group("fit").scalar("decay_length", 1e-7, "m", "decay length");
///     file.commit();
/// The file appears, complete, at commit(); without commit() no file remains. Only one thread may
/// use an object at a time.
class ResultFile {
 public:
  /// Throws InvalidInput and IoError wherever require_output does; IoError if the disk is full.
  /// communicator  processes that share fields. Each process makes the same calls; the root writes
  ///               everything except the rows of fields that other processes hold. A failure before
  ///               commit() is thrown in one process only: use collectively() to report it to all
  ///               processes
  ResultFile(const std::filesystem::path& file, const Provenance& provenance,
             const WriteOptions& options = {}, const Communicator& communicator = {});
  ResultFile(ResultFile&&) noexcept;
  ResultFile& operator=(ResultFile&&) noexcept;
  ~ResultFile();

  /// Returns the group at a path, such as "damping" or "realisations/3", and creates it if
  /// necessary.
  ResultGroup group(const std::string& path);
  /// Closes the file and gives it its final name. Collective; a failure in one process is thrown in
  /// all processes, and no file remains. The file and its groups cannot be used afterwards.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads files of ResultFile, or any HDF5 file of real numbers. Paths are like "curve/pressure":
///     const double length = ResultReader("result.h5").number("fit/decay_length");
/// throws   InvalidInput, whose message names the file, for data that are missing, of another type,
///          or damaged
class ResultReader {
 public:
  explicit ResultReader(const std::filesystem::path& file);
  ResultReader(ResultReader&&) noexcept;
  ~ResultReader();

  const std::filesystem::path& file() const;
  bool has(const std::string& path) const;
  std::vector<std::string> groups(const std::string& path = "/") const;
  std::vector<std::string> datasets(const std::string& path = "/") const;

  std::vector<Index> shape(const std::string& dataset) const;
  std::vector<double> numbers(const std::string& dataset) const;
  double number(const std::string& dataset) const;
  Field field(const std::string& dataset) const;
  /// Reads the rows of a field that belong to this process.
  Field field(const std::string& dataset, const RowPartition& partition) const;
  std::vector<std::string> labels(const std::string& dataset) const;
  /// Returns true if a dataset is a list of names, which labels() reads and numbers() rejects.
  bool holds_labels(const std::string& dataset) const;
  /// Returns the names of the coordinates of a dataset.
  std::vector<std::string> coordinates(const std::string& dataset) const;

  /// Reads an attribute of a group or dataset; "/" is the root. Empty if there is no attribute of
  /// that name and type.
  std::optional<double> number_attribute(const std::string& path, const std::string& name) const;
  std::optional<std::string> text_attribute(const std::string& path, const std::string& name) const;
  /// Returns the names of the attributes of a group or dataset in their order, without those that
  /// HDF5 uses for dimension scales.
  std::vector<std::string> attributes(const std::string& path = "/") const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace salebra
