// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/partition.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "input_file.hpp"
#include "json.hpp"

/// What an HDF5 file says, as plain values: the one interface between HDF5 and everything that
/// reads.
namespace salebra::detail::hdf5 {

/// A number of any type, a text, or something else.
using AttributeValue = std::variant<Json::Null, double, std::string>;

/// A group, a dataset, or what is refused under its name.
struct Object {
  enum class Kind : std::uint8_t { group, numbers, labels, refused };
  Kind kind = Kind::refused;
  std::string refusal;  ///< why it is not read, as in "is an external link; …"
  std::vector<std::pair<std::string, AttributeValue>> attributes;  ///< in the order of their names
  std::vector<std::pair<std::string, Kind>> members;  ///< of a group, in the order of their names
  std::vector<std::uint64_t> shape;                   ///< of a dataset; empty for a scalar
  std::vector<std::string> coordinates;               ///< names of a dataset's dimension scales
  std::vector<std::string> labels;                    ///< of a list of names
  std::optional<std::vector<double>> numbers;         ///< of a small dataset
  /// Where the file has the doubles of a dataset as memory has them, one behind the other.
  std::optional<std::uint64_t> location;

  /// Product of the extents.
  std::uint64_t count() const;
  std::optional<double> number(std::string_view attribute) const;
  std::optional<std::string> text(std::string_view attribute) const;
};

constexpr void describe(auto&& visit, std::type_identity<Object>) {
  using S = Object;
  keep(visit, &S::kind, &S::refusal, &S::attributes, &S::members, &S::shape, &S::coordinates,
       &S::labels, &S::numbers, &S::location);
}

/// The outline of a file with all attributes and small datasets; large datasets are read when they
/// are requested. Links and references to other files, symbolic links, external storage, virtual
/// datasets, and filters other than one shuffle, one deflate and one fletcher32 are refused where
/// they are requested; nothing beside the file is ever read. Doubles that are neither packed nor in
/// chunks are read without HDF5, from the place that the outline says.
/// cost     memory: at most 64 times the file and 256 MB, in the process that reads
class Document {
 public:
  /// Throws InvalidInput naming the file for what is not HDF5, or damaged.
  explicit Document(InputFile file);

  const std::filesystem::path& path() const { return file_.path(); }
  /// The object at "curve/pressure"; "/" is the root. nullptr: there is none.
  const Object* find(std::string_view path) const;
  /// The object of that kind. Throws InvalidInput where there is none, and where it is refused.
  const Object& group(const std::string& path) const;
  const Object& dataset(const std::string& path) const;
  /// A dataset whose numbers can be read: count() of them fit in memory. Throws InvalidInput for
  /// any other.
  const Object& numeric(const std::string& path) const;
  /// Copies the values of a dataset of numbers, count() of them, the last dimension contiguous.
  /// Throws InvalidInput as numeric() does, and where they turn out to be damaged.
  void numbers(const std::string& path, std::span<double> values) const;
  /// Reads the rows of a field that a process holds.
  void rows(const std::string& path, const RowPartition& partition, std::span<double> values) const;

 private:
  void read(const std::string& path, const Object& object, std::uint64_t begin, std::uint64_t end,
            std::span<double> values) const;

  InputFile file_;
  std::map<std::string, Object, std::less<>> objects_;  ///< by normal path: "/", "/curve/pressure"
};

/// What Document may take of a file: bytes of one dataset as doubles.
std::uint64_t max_bytes(std::uint64_t file_size);

/// The two sides of the runner. The reading side is the only one that calls HDF5 on a file.
using HandOver = std::function<void(std::span<const std::byte>)>;
void read_outline(const InputFile& file, const HandOver& hand_over);
/// shape       as the outline said; a file that changed since is refused
/// begin, end  along the first dimension
void read_numbers(const InputFile& file, const std::string& path,
                  const std::vector<std::uint64_t>& shape, std::uint64_t begin, std::uint64_t end,
                  const HandOver& hand_over);
/// Calls work while no other thread is inside HDF5.
void alone(const std::function<void()>& work);

/// Objects with their paths: what the outline hands over as the bytes of base/archive.hpp, of which
/// Document takes nothing for granted.
using Objects = std::vector<std::pair<std::string, Object>>;

}  // namespace salebra::detail::hdf5
