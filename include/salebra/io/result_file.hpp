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

/// Returns the positions of the rows or columns of a grid, m: 0, step, 2 step, …
std::vector<double> positions(Index count, double step);

/// One group of a ResultFile, with coordinates and datasets on them. xarray opens it with
/// xarray.open_dataset(file, engine="h5netcdf", group=…). Every dataset has `units` (SI, "1" for
/// pure numbers) and a `long_name`; unknown values are NaN.
/// throws   InvalidInput for a name used twice, a missing unit, or values without the shape of
///          their coordinates; IoError if the disk is full
class ResultGroup {
 public:
  /// A one-dimensional coordinate, an HDF5 dimension scale.
  void coordinate(const std::string& name, std::span<const double> values, const std::string& units,
                  const std::string& long_name);
  /// The coordinate 0, 1, …, count − 1.
  void index(const std::string& name, std::size_t count, const std::string& long_name);
  /// A coordinate of names, such as those of models.
  void labels(const std::string& name, const std::vector<std::string>& values,
              const std::string& long_name);

  /// Values on coordinates of this group, the last one contiguous.
  void dataset(const std::string& name, std::span<const double> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  void dataset(const std::string& name, std::span<const std::int64_t> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  /// Single precision and small integers suffice for images.
  void dataset(const std::string& name, std::span<const float> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  void dataset(const std::string& name, std::span<const std::int16_t> values,
               const std::vector<std::string>& coordinates, const std::string& units,
               const std::string& long_name);
  /// Writes a field on the coordinates x and y. In a file of several processes it has the rows of
  /// this one according to Share, and must exist until commit().
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

/// HDF5 file of results: a group for each stage (`surface`, `curve`, `fit`, `damping`, …), with
/// provenance at its root.
///     ResultFile file("result.h5", {});
///     file.group("fit").scalar("decay_length", 1e-7, "m", "decay length");
///     file.commit();
/// The file appears complete at commit(); without commit nothing remains. Use by one thread at a
/// time.
class ResultFile {
 public:
  /// Throws as require_output does; IoError if the disk is full.
  /// ranks  processes that share fields. Each makes the same calls; the root writes everything
  ///        except the rows of the others. A failure before commit() affects one process only: use
  ///        collectively() to report it
  ResultFile(const std::filesystem::path& file, const Provenance& provenance,
             const WriteOptions& options = {}, const Communicator& communicator = {});
  ResultFile(ResultFile&&) noexcept;
  ResultFile& operator=(ResultFile&&) noexcept;
  ~ResultFile();

  /// Returns the group at a path, such as "damping" or "realisations/3", and creates it if
  /// necessary.
  ResultGroup group(const std::string& path);
  /// Closes the file and gives it its name. Collective; a failure in one process is thrown on all,
  /// and nothing remains. The file and its groups cannot be used afterwards.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads files of ResultFile, or any HDF5 file of real numbers. Paths are like "curve/pressure":
///     const double length = ResultReader("result.h5").number("fit/decay_length");
/// throws   InvalidInput naming the file, for data that are missing, of another kind, or damaged
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

  /// Reads an attribute of a group or dataset; "/" is the root. Empty if there is none of that name
  /// and kind.
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
