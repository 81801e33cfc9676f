// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <vector>

/// What the readers of single formats share. Each takes a file apart and returns what it says, no
/// more.
namespace salebra {
struct ReadOptions;
}

namespace salebra::detail {

class InputFile;

/// What the reader of a file did not understand, unless the user settles it.
struct OpenQuestion {
  std::string text;
  bool size = false, heights = false;  ///< settled by sizes, by the unit of the heights
};

struct LoadedSurface {
  Field heights;                 ///< in `unit`
  std::optional<Index> rows;     ///< of the surface, where `heights` has those of one process
  std::optional<double> size_x;  ///< m
  std::optional<double> size_y;  ///< m
  std::optional<bool> periodic;
  std::string unit;                ///< of the heights; empty where the file names none
  std::string stated_unit = {};    ///< as the file states it, where the reader has converted it
  bool lateral_unit_open = false;  ///< the sizes are in a unit that the file does not name
  bool is_profile = false;         ///< one row
  bool has_channels = false;       ///< the reader chose one by ReadOptions::channel
  std::vector<OpenQuestion> questions = {};
  std::vector<std::string> warnings = {};  ///< on what it says and the reader did not use
};

/// InvalidInput "<file>: <what>".
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what);

/// One of the surfaces of a file.
struct Channel {
  std::string number;  ///< empty: it is called by its name alone
  std::string name;    ///< may be empty
  std::string unit;    ///< of its values; empty: unknown
};

/// The index of the channel with this number or name. Where `wanted` is empty, it is that of the
/// first length, else of the first without a unit, and `surface` gets a warning on the others.
/// Throws InvalidInput where no channel has that name, several have it, or none can be heights.
std::size_t chosen_channel(const std::filesystem::path& file, const std::vector<Channel>& channels,
                           const std::string& wanted, LoadedSurface& surface);

/// Room for the heights of a file, not initialised. Throws InvalidInput where they do not fit into
/// the memory that is free.
Field heights_of(const std::filesystem::path& file, Index nx, Index ny);

/// The whole of a file, by plain_content(). Throws InvalidInput where it cannot be read.
std::string file_content(const InputFile& input);

/// Whether the file begins as HDF5 does.
bool is_hdf5(const std::filesystem::path& file);

/// Metres in one `unit` of length; nothing for anything else.
std::optional<double> metres_in(const std::string& unit);
/// The same, where it must be one; throws InvalidInput naming the file.
double metres_per(const std::filesystem::path& file, const std::string& unit);

/// Points at these positions, which increase, as a profile of equal steps. Where they are off by more
/// than a tenth of a step, the straight lines between them are evaluated on a fine grid from the
/// first point to the last. size_x is in the unit of x.
LoadedSurface profile_of(const std::filesystem::path& file, const std::vector<double>& positions,
                         const std::vector<double>& heights);

/// Whether the file is of no other format and is not wrapped; an empty file is no text.
bool is_plain_text(const InputFile& input);

/// Such a text, a piece at a time. Memory: 8 to 17 bytes a value.
LoadedSurface read_text(const InputFile& input);

/// Any format but HDF5, by its first bytes. `file` is only named in messages, and where a sidecar
/// may lie.
LoadedSurface read_content(const std::filesystem::path& file, std::string_view content,
                           const std::string& channel = {});

/// A surface as it was read.
struct ReadSurface {
  Surface surface = {};        ///< m
  double metres_per_unit = 1;  ///< of the heights in the file
  bool names_unit = false;     ///< the file does
  bool names_lateral_unit = true;
};

/// The surface in metres, with what the options say in place of the file. Throws InvalidInput as
/// read_surface does.
ReadSurface completed(const std::filesystem::path& file, LoadedSurface loaded,
                      const ReadOptions& options);

/// The reader of HDF5; those of other formats are in surface_formats.cpp.
/// ranks: each gets its rows.
LoadedSurface read_hdf5(const std::filesystem::path& file, const std::string& channel = {},
                        const Communicator& communicator = {});

}  // namespace salebra::detail
