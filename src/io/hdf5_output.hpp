// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "atomic_file.hpp"
#include "hdf5_drivers.hpp"
#include "hdf5_handle.hpp"

namespace salebra::detail::hdf5 {

/// What every dataset carries.
struct Label {
  std::string units;
  std::string long_name;
};

/// An HDF5 file in the making, whose datasets have units, names and dimension scales.
/// HDF5 writes to pages in memory, which go to the temporary file by calls whose failure is seen:
/// HDF5 does not report every failed write (small datasets are flushed by the closing of a handle)
/// and crashes at the end of a process where a file could not be closed. Over several processes the
/// root alone makes the file, with holes for the fields that are spread, which each process then
/// fills with its rows. What another process than the root adds is nothing but its rows. The bytes
/// are those of one process. One process that leaves its fields where they are does the same.
/// cost     memory: some megabytes, whatever the size of the file
class Output {
 public:
  enum class Fields { copied, stay };
  /// Not collective: a failure must be made known before commit(), by collectively().
  Output(const std::filesystem::path& file, const Provenance& provenance,
         const WriteOptions& options, const Communicator& communicator = {},
         Fields fields = Fields::copied);

  hid_t root() const { return root_; }
  /// Opens the group at that path below the root, creating what is missing.
  Group group(const std::string& path);

  void attribute(hid_t object, const std::string& name, double value);
  void attribute(hid_t object, const std::string& name, std::int64_t value);
  void attribute(hid_t object, const std::string& name, std::uint64_t value);
  void attribute(hid_t object, const std::string& name, std::string_view value);

  /// A dataset whose dimensions are the named scales of the group (none: a scalar). T: double,
  /// float, int64_t, int16_t, int8_t.
  /// Throws InvalidInput if a scale is missing or values have not the shape that the scales give.
  template <class T>
  Dataset dataset(hid_t group, const std::string& name, const T* values, std::size_t count,
                  const std::vector<std::string>& dimensions, const Label& label);
  /// A field on two scales. Over several processes it holds the rows of Share(ranks, rows of the
  /// first scale). There, and with Fields::stay, it must stay until commit().
  Dataset field(hid_t group, const std::string& name, const Field& values,
                const std::vector<std::string>& dimensions, const Label& label,
                FieldType type = FieldType::float64);
  /// A one-dimensional dataset that is a dimension scale.
  template <class T>
  void scale(hid_t group, const std::string& name, const T* values, std::size_t count,
             const Label& label);
  void text_scale(hid_t group, const std::string& name, const std::vector<std::string>& values,
                  const std::string& long_name);

  /// Writes the finished file and puts it in its place; nothing can be written afterwards.
  /// Collective: a failure of one process is thrown on all, and nothing is left.
  void commit();

 private:
  template <class T>
  void number(hid_t object, const std::string& name, const T& value);
  template <class T>
  Dataset create(hid_t group, const std::string& name, const T* values,
                 const std::vector<hsize_t>& shape, const Label& label, bool spread = false);
  void write_without_fields();
  void write_fields();

  /// A field of which each process writes its rows.
  struct Spread {
    std::uint64_t location = 0;  ///< in the file
    std::int64_t rows = 0, columns = 0;
  };

  std::filesystem::path target_;
  Communicator communicator_;
  bool copies_fields_;                ///< to the pages, as this process has all of them
  std::optional<AtomicFile> atomic_;  ///< of the root
  std::vector<Spread> spread_;        ///< of the root, until commit()
  struct Rows {
    const Field* values;
    FieldType type;
  };
  std::vector<Rows> fields_;        ///< the rows of this process, for each of them
  std::optional<PagedFile> pages_;  ///< of the root
  int closed_before_ = 0;           ///< failed_closes() at the start
  File file_;
  Group root_;
};

}  // namespace salebra::detail::hdf5
