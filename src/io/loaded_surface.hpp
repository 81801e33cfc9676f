// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Types and functions that the readers of surface formats share. A reader returns what the file
/// states and adds nothing.
namespace salebra {
struct ReadOptions;
}

namespace salebra::detail {

class InputFile;

/// Something in a file that its reader did not understand. The file is refused unless an option of
/// the user answers the question.
struct OpenQuestion {
  std::string text;
  /// The question is answered by sizes; by the unit of the heights.
  bool size = false, heights = false;
};

struct LoadedSurface {
  Field heights;  ///< in `unit`
  /// Number of rows of the whole surface, if `heights` only contains those of one process.
  std::optional<Index> rows;
  std::optional<double> size_x;  ///< m
  std::optional<double> size_y;  ///< m
  std::optional<bool> periodic;
  std::string unit;  ///< of the heights; empty if the file names none
  /// Unit in the file, if the reader has already converted the heights to `unit`.
  std::string stated_unit = {};
  bool lateral_unit_open = false;  ///< the file does not state the unit of the sizes
  bool is_profile = false;         ///< the file holds a line profile: one row
  bool has_channels = false;       ///< the reader takes account of ReadOptions::channel
  std::vector<OpenQuestion> questions = {};
  /// About statements in the file that the reader did not use.
  std::vector<std::string> warnings = {};
};

/// Throws InvalidInput "<file>: <what>".
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what);

/// One of several surfaces (channels) in a file.
struct Channel {
  std::string number;  ///< empty: the user can select the channel only by its name
  std::string name;    ///< may be empty
  std::string unit;    ///< of its values; empty: unknown
};

/// Index of the channel whose number or name is `wanted`. If `wanted` is empty, it is the first
/// channel whose unit is a length, or else the first channel without a unit; `surface` then gets a
/// warning that names the other channels. Throws InvalidInput if no channel has this name, several
/// have it, or no channel can contain heights.
std::size_t chosen_channel(const std::filesystem::path& file, const std::vector<Channel>& channels,
                           const std::string& wanted, LoadedSurface& surface);

/// Allocates the heights of a surface, without initialising them. Throws InvalidInput naming the
/// file if they do not fit into the free memory.
Field heights_of(const std::filesystem::path& file, Index nx, Index ny);

/// The whole content of a file, after unwrapping by plain_content(). Throws InvalidInput if the
/// file cannot be read.
std::string file_content(const InputFile& input);

/// Whether the file begins with the HDF5 signature.
bool is_hdf5(const std::filesystem::path& file);

/// Length of one `unit` in metres; nothing if it is not a unit of length.
std::optional<double> metres_in(const std::string& unit);
/// Length of one `unit` in metres. Throws InvalidInput naming the file if it is not a unit of
/// length.
double metres_per(const std::filesystem::path& file, const std::string& unit);

/// A line profile with equal steps, from heights at increasing positions. If a position deviates by
/// more than a tenth of a step from equal steps, the straight lines between the points are
/// evaluated on a fine grid from the first to the last point. size_x of the result is in the unit
/// of the positions.
LoadedSurface profile_of(const std::filesystem::path& file, const std::vector<double>& positions,
                         const std::vector<double>& heights);

/// Whether the file is text: it has no binary format, is not wrapped (gzip, UTF-16) and not empty.
bool is_plain_text(const InputFile& input);

/// Reads a text file a piece at a time. Memory: 8 to 17 bytes a value.
LoadedSurface read_text(const InputFile& input);

/// Reads a surface in any format except HDF5, recognised by the first bytes of `content`. `file` is
/// only used in messages and to find a sidecar.
LoadedSurface read_content(const std::filesystem::path& file, std::string_view content,
                           const std::string& channel = {});

/// A surface in metres, and what is known of the file.
struct ReadSurface {
  Surface surface = {};        ///< m
  double metres_per_unit = 1;  ///< of the unit in which the file states the heights
  bool names_unit = false;     ///< whether the file names the unit of its heights
  bool names_lateral_unit = true;
};

/// Completes a loaded surface: converts it to metres, and applies the options, which override what
/// the file states. Throws InvalidInput as read_surface() does.
ReadSurface completed(const std::filesystem::path& file, LoadedSurface loaded,
                      const ReadOptions& options);

/// Reads a surface from HDF5; the readers of other formats are listed in surface_formats.cpp. Each
/// process of the communicator gets its rows.
LoadedSurface read_hdf5(const std::filesystem::path& file, const std::string& channel = {},
                        const Communicator& communicator = {});

}  // namespace salebra::detail
