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
  keep,      ///< they stay NaN
  fill_few,  ///< filled if Holes::few() is true; otherwise the file is rejected
  fill       ///< filled, however many
};

/// Options that override or complete the file, and processing of the heights, applied in the order
/// of the members.
struct ReadOptions {
  bool transpose = false;             ///< exchanges x and y of the file, before everything below
  std::optional<double> size_x = {};  ///< m; overrides the file
  std::optional<double> size_y = {};  ///< m
  std::optional<std::pair<double, double>> pixel_size =
      {};                         ///< m, distance of the points along x and y, instead of sizes
  std::string lateral_unit = {};  ///< unit such as "um" for XYZ files that give none; empty: metres
  std::optional<bool> periodic = {};   ///< overrides the file
  std::string height_unit = {};        ///< such as "nm", for files that give none; empty: metres
  std::optional<double> despike = {};  ///< threshold of find_spikes(); spikes become undefined
  std::optional<Rectangle> crop = {};  ///< m, in the coordinates of the whole
  Undefined undefined = Undefined::keep;
  std::string channel =
      {};  ///< number or name of one of several surfaces in GWY, HDF5 (dataset) and
           ///< imported files; empty: the first whose unit is a length
  bool known_formats = false;  ///< ignores the installed importer of other formats
  bool profiles = false;       ///< reads a line profile as a surface of one row; otherwise it is
                               ///< rejected
  std::vector<std::string>* warnings =
      nullptr;  ///< receives warnings, "<file>: <what>", on likely mistakes and on processing; on a
                ///< distributed surface all processes give it or none, and all receive the same
};

/// Reads the heights of a surface:
///     const Surface surface = read_surface("scan.gwy", {.crop = Rectangle{0, 0, 1e-5, 1e-5}});
/// The first bytes of the file, not its name, determine the format:
///   HDF5    dataset `heights` (nx, ny) at the root, or the only two-dimensional one there, with
///           attributes size_x, size_y (m), periodic, units
///   NPY     two-dimensional real array [nx, ny], versions 1 to 3, any byte order, C or Fortran
///           order; size and unit from the sidecar FILE.json if there is one
///   X3P     ISO 25178-72, one surface on a grid; scales, directions of axes and mask
///   GWY     Gwyddion: the first channel whose unit is a length, without the points of its mask
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
/// All but HDF5 may be compressed with gzip, and text may be UTF-16 with its byte order mark.
/// Undefined points become NaN. Heights are in metres unless the file or the options name a unit.
/// throws   InvalidInput "<file>: <what is wrong>; <what to do>" for a file that is missing, of
///          another format, truncated, larger by its header than by its content, ambiguous, without
///          a size, or with an infinite height; for too many undefined points with
///          Undefined::fill_few, with the largest part without any
/// ranks    processes that share the surface: each reads its rows of an HDF5 file unless the
///          heights are processed; the root reads any other file whole. Collective; a failure in
///          one process is thrown on all
/// cost     one pass over the file; memory: the file and the heights. With warnings, a search for
///          spikes in a surface that is not periodic, 0.1 µs per point
Surface read_surface(const std::filesystem::path& file, const ReadOptions& options = {},
                     const Communicator& communicator = {});

}  // namespace salebra
