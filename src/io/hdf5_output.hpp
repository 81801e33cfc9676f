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

/// The attributes of a dataset: unit and long name.
struct Label {
  std::string units;
  std::string long_name;
};

/// Writes an HDF5 file whose datasets have units, long names and dimension scales. HDF5 writes to
/// pages in memory; this class writes the pages to the temporary file and checks each call. HDF5
/// itself does not report every failed write (closing a handle flushes small datasets), and crashes
/// at the end of the program if a file could not be closed.
///
/// With several processes only the first one makes the file, and leaves holes for the distributed
/// fields. Then each process writes its rows of these fields. The file has the same bytes as from a
/// single process. With Fields::stay, a single process works in this way too.
/// cost     memory: some megabytes, whatever the size of the file
class Output {
 public:
  enum class Fields { copied, stay };
  /// Makes the temporary file in the first process. Only this process can fail, so the caller must
  /// use collectively(), by which all processes learn of a failure.
  Output(const std::filesystem::path& file, const Provenance& provenance,
         const WriteOptions& options, const Communicator& communicator = {},
         Fields fields = Fields::copied);

  hid_t root() const { return root_; }
  /// Opens the group at this path below the root, and creates groups that are missing.
  Group group(const std::string& path);

  void attribute(hid_t object, const std::string& name, double value);
  void attribute(hid_t object, const std::string& name, std::int64_t value);
  void attribute(hid_t object, const std::string& name, std::uint64_t value);
  void attribute(hid_t object, const std::string& name, std::string_view value);

  /// Writes a dataset. dimensions: names of scales of the group, one for each dimension; none: a
  /// single number. T: double, float, int64_t, int16_t, int8_t. Throws InvalidInput if a scale is
  /// missing, or if the scales give another number of values than `count`.
  template <class T>
  Dataset dataset(hid_t group, const std::string& name, const T* values, std::size_t count,
                  const std::vector<std::string>& dimensions, const Label& label);
  /// Writes a field with two scales. With several processes, `values` contains the rows of this
  /// process by RowPartition(communicator, length of the first scale). With several processes, and
  /// with Fields::stay, `values` must exist until commit().
  Dataset field(hid_t group, const std::string& name, const Field& values,
                const std::vector<std::string>& dimensions, const Label& label,
                FieldType type = FieldType::float64);
  /// Writes a one-dimensional dataset that serves as dimension scale of others.
  template <class T>
  void scale(hid_t group, const std::string& name, const T* values, std::size_t count,
             const Label& label);
  void text_scale(hid_t group, const std::string& name, const std::vector<std::string>& values,
                  const std::string& long_name);

  /// Completes the file and renames it to its target; afterwards nothing can be written. All
  /// processes must call: a failure of one process is thrown on all, and no file is left.
  void commit();

 private:
  template <class T>
  void number(hid_t object, const std::string& name, const T& value);
  template <class T>
  Dataset create(hid_t group, const std::string& name, const T* values,
                 const std::vector<hsize_t>& shape, const Label& label, bool spread = false);
  void write_without_fields();
  void write_fields();

  /// A distributed field, of which each process writes its rows.
  struct Spread {
    std::uint64_t location = 0;  ///< offset in the file
    std::int64_t rows = 0, columns = 0;
  };

  std::filesystem::path target_;
  Communicator communicator_;
  /// Fields are written to the pages, because this process has all rows and may copy them.
  bool copies_fields_;
  std::optional<AtomicFile> atomic_;  ///< only in the first process
  /// Distributed fields; only in the first process, until commit().
  std::vector<Spread> spread_;
  struct Rows {
    const Field* values;
    FieldType type;
  };
  std::vector<Rows> fields_;        ///< the rows of this process, for each distributed field
  std::optional<PagedFile> pages_;  ///< only in the first process
  int closed_before_ = 0;           ///< failed_closes() when this object was made
  File file_;
  Group root_;
};

}  // namespace salebra::detail::hdf5
