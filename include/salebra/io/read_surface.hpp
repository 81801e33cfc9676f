// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/surface/crop.hpp>
#include <string>
#include <utility>
#include <vector>

namespace salebra {

/// Treatment of undefined points.
enum class Undefined {
  keep,      ///< undefined points stay NaN
  fill_few,  ///< filled if Holes::few() is true; otherwise InvalidInput
  fill       ///< all are filled, however many there are
};

/// Options that override or complete the data of the file, and options for processing the heights,
/// which is done in the order of the members.
struct ReadOptions {
  bool transpose = false;             ///< exchanges x and y of the file, before all other options
  std::optional<double> size_x = {};  ///< size along x, m; overrides the file
  std::optional<double> size_y = {};  ///< size along y, m; overrides the file
  /// Distance of the points along x and along y, m; instead of size_x and size_y.
  std::optional<std::pair<double, double>> pixel_size = {};
  std::string lateral_unit = {};       ///< such as "um", for XYZ files without units; empty: metres
  std::optional<bool> periodic = {};   ///< whether periodic; overrides the file
  std::string height_unit = {};        ///< such as "nm", for files that give none; empty: metres
  std::optional<double> despike = {};  ///< threshold of find_spikes(); spikes become undefined
  std::optional<Rectangle> crop = {};  ///< m, in the coordinates of the full scan
  Undefined undefined = Undefined::keep;  ///< treatment of undefined points
  /// Number or name of one of several surfaces in GWY, HDF5 (name of the dataset) and imported
  /// files; empty: the first surface whose unit is a length.
  std::string channel = {};
  bool known_formats = false;  ///< true: does not use the importer of other formats
  /// true: reads a line profile as a surface of one row; false: a line profile is rejected.
  bool profiles = false;
  /// Receives warnings, "<file>: <text>", on likely mistakes and on processing; nullptr: none. For
  /// a distributed surface either all processes pass a list, and all lists receive the same
  /// warnings, or no process does.
  std::vector<std::string>* warnings = nullptr;
};

/// Reads the heights of a surface:
///     const Surface surface = read_surface("scan.gwy", {.crop = Rectangle{0, 0, 1e-5, 1e-5}});
/// The first bytes of the file, not its name, determine the format:
///   HDF5    dataset `heights` (nx, ny) at the root, or the only two-dimensional dataset at the
///           root, with attributes size_x, size_y (m), periodic, units
///   NPY     two-dimensional real array [nx, ny], versions 1 to 3, any byte order, C or Fortran
///           order; size and unit from the sidecar FILE.json if there is one
///   X3P     ISO 25178-72, one surface on a grid; scales, directions of axes and mask
///   GWY     Gwyddion: the first channel whose unit is a length; points of its mask become
///           undefined
///   GSF     Gwyddion Simple Field
///   SUR     Digital Surf, one surface of 16 or 32 bits
///   text    a matrix whose columns run along x and whose rows along y: heights(ix, iy) is the
///           value in column ix of row iy. Headers of Gwyddion and of instruments, in English and
///           German: sizes, distances of the points, units. Values separated by blanks, ';' or ',';
///           decimal point, or decimal comma if that is unambiguous. Undefined points are empty
///           fields, "nan", "***", "---", "NA", "BAD" and "No Data"
///   XYZ     text of three columns that form a complete or partly filled regular grid; units in the
///           header or next to the names of its columns
///   profile text of one column, or of two whose first grows; HDF5 with one-dimensional heights and
///           positions x: a line profile, which needs ReadOptions::profiles
/// All formats except HDF5 may be compressed with gzip, and text may be UTF-16 with its byte order
/// mark. Undefined points become NaN. Heights are in metres unless the file or the options name a
/// unit.
/// throws   InvalidInput "<file>: <what is wrong>; <what to do>" for a file that is missing, of
///          another format, truncated, smaller than its header says, ambiguous, without a size, or
///          with an infinite height. With Undefined::fill_few also if Holes::few() is false; the
///          message then names the largest rectangle of the surface that has no undefined points
/// communicator    processes that share the surface: each process reads its rows of an HDF5 file;
///                 if the heights are processed, or the file has another format, the root reads the
///                 whole file. Collective; a failure in one process is thrown in all
/// cost     one pass over the file; memory for the file and the heights. If `warnings` is given,
///          also a search for spikes in a surface that is not periodic, 0.1 µs per point
Surface read_surface(const std::filesystem::path& file, const ReadOptions& options = {},
                     const Communicator& communicator = {});

}  // namespace salebra
