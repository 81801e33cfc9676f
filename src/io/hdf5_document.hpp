// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/row_partition.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "input_file.hpp"
#include "json.hpp"

/// The content of an HDF5 file as plain values. All readers use HDF5 through this interface.
namespace salebra::detail::hdf5 {

/// A number of any type, a text, or null for an attribute of another type.
using AttributeValue = std::variant<Json::Null, double, std::string>;

/// A group, a dataset, or an object that is not read; `refusal` then says why.
struct Object {
  enum class Kind : std::uint8_t { group, numbers, labels, refused };
  Kind kind = Kind::refused;
  std::string refusal;  ///< why the object is not read, as in "is an external link; …"
  std::vector<std::pair<std::string, AttributeValue>> attributes;  ///< sorted by name
  std::vector<std::pair<std::string, Kind>> members;               ///< of a group, sorted by name
  std::vector<std::uint64_t> shape;      ///< of a dataset; empty for a scalar
  std::vector<std::string> coordinates;  ///< names of a dataset's dimension scales
  std::vector<std::string> labels;       ///< texts of a list of names
  /// Values of a small dataset; large ones are read on request.
  std::optional<std::vector<double>> numbers;
  /// Offset in the file at which the doubles of the dataset lie one after another, in the byte
  /// order of this machine. Empty if they are stored in another way.
  std::optional<std::uint64_t> location;

  /// Number of values: the product of the extents.
  std::uint64_t count() const;
  std::optional<double> number(std::string_view attribute) const;
  std::optional<std::string> text(std::string_view attribute) const;
};

constexpr void describe(auto&& visit, std::type_identity<Object>) {
  using S = Object;
  keep(visit, &S::kind, &S::refusal, &S::attributes, &S::members, &S::shape, &S::coordinates,
       &S::labels, &S::numbers, &S::location);
}

/// Returns the name that version 1.0 used for a path or an attribute, or `name` itself if it has
/// not changed. Readers try this name if a file does not have the present one.
std::string former_name(std::string_view name);

/// The outline of an HDF5 file, which contains all attributes and the values of small datasets.
/// Large datasets are read when they are requested. No other file is ever read: a request is
/// refused for an object that uses links or references to other files, symbolic links, external
/// storage or virtual datasets, and also for filters other than one shuffle, one deflate and one
/// fletcher32. Doubles that are neither packed nor in chunks are read without HDF5, from the offset
/// that the outline gives.
/// cost     memory of the process that reads: at most 64 times the file and 256 MB
class Document {
 public:
  /// Throws InvalidInput naming the file if it is not HDF5 or is damaged.
  explicit Document(InputFile file);

  const std::filesystem::path& path() const { return file_.path(); }
  /// The object at a path such as "curve/pressure"; "/" is the root. nullptr if there is none.
  const Object* find(std::string_view path) const;
  /// The group or dataset at this path. Throws InvalidInput if there is none, or it is of a refused
  /// kind.
  const Object& group(const std::string& path) const;
  const Object& dataset(const std::string& path) const;
  /// The dataset at this path. Throws InvalidInput unless it contains numbers that fit into memory.
  const Object& numeric(const std::string& path) const;
  /// Copies the values of a dataset of numbers to `values`, which has the size count(); the index
  /// of the last dimension varies fastest. Throws InvalidInput as numeric() does, and if the values
  /// are damaged.
  void numbers(const std::string& path, std::span<double> values) const;
  /// Reads only the rows of a two-dimensional dataset that belong to this process.
  void rows(const std::string& path, const RowPartition& partition, std::span<double> values) const;

 private:
  void read(const std::string& path, const Object& object, std::uint64_t begin, std::uint64_t end,
            std::span<double> values) const;

  InputFile file_;
  /// The objects of the file by their paths in normal form: "/", "/curve/pressure".
  std::map<std::string, Object, std::less<>> objects_;
};

/// The largest dataset, in bytes of doubles, that Document reads from a file of this size.
std::uint64_t max_bytes(std::uint64_t file_size);

/// The functions that a runner calls. Only these functions call HDF5 on a file that is read.
using HandOver = std::function<void(std::span<const std::byte>)>;
void read_outline(const InputFile& file, const HandOver& hand_over);
/// Reads rows begin … end − 1 of a dataset.
/// shape       from the outline; if the file now has another shape it is refused
/// begin, end  along the first dimension
void read_numbers(const InputFile& file, const std::string& path,
                  const std::vector<std::uint64_t>& shape, std::uint64_t begin, std::uint64_t end,
                  const HandOver& hand_over);
/// Calls work() while no other thread is inside HDF5.
void alone(const std::function<void()>& work);

/// Objects with their paths. The outline is handed over as such a list in the bytes of
/// base/archive.hpp. Document checks all objects.
using Objects = std::vector<std::pair<std::string, Object>>;

}  // namespace salebra::detail::hdf5
