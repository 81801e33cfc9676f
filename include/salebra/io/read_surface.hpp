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

/// What becomes of undefined points.
enum class Undefined {
  keep,      ///< they stay NaN
  fill_few,  ///< filled where Holes::few() holds; else the file is refused
  fill       ///< filled, however many
};

/// What the user knows better than the file, or what the file does not say, and what is done to the
/// heights before they are used, in the order of its members.
struct ReadOptions {
  bool transpose = false;             ///< exchanges x and y of the file, before all that follows
  std::optional<double> size_x = {};  ///< m; in place of the file's
  std::optional<double> size_y = {};  ///< m
  std::optional<std::pair<double, double>> pixel_size =
      {};  ///< m, distance of the points along x and y, in place of sizes
  std::string lateral_unit =
      {};  ///< such as "um", of XYZ points whose file gives none; empty: metres
  std::optional<bool> periodic = {};   ///< in place of the file's
  std::string height_unit = {};        ///< such as "nm", for files that give none; empty: metres
  std::optional<double> despike = {};  ///< threshold of find_spikes(), which become undefined
  std::optional<Rectangle> crop = {};  ///< m, in the coordinates of the whole
  Undefined undefined = Undefined::keep;
  std::string channel =
      {};  ///< number or name of one of several surfaces in GWY, HDF5 (dataset) and
           ///< imported files; empty: the first whose unit is a length
  bool known_formats = false;  ///< whoever was set to import others is not asked
  bool profiles = false;  ///< a line profile is read as a surface of one row; else it is refused
  std::vector<std::string>* remarks =
      nullptr;  ///< receives lines on what is most likely a slip, and on what was done, "<file>:
                ///< <what>"; of a surface that is spread the same in all processes, which all give
                ///< it or none
};

/// Reads the heights of a surface. What the file is follows from its first bytes, not from its
/// name:
///   HDF5    dataset `heights` (nx, ny) at the root, or the only two-dimensional one there, with
///           attributes size_x, size_y (m), periodic, units
///   NPY     two-dimensional real array [nx, ny], versions 1 to 3, any byte order, C or Fortran
///           order; size and unit from the sidecar FILE.json where there is one
///   X3P     ISO 25178-72, one surface on a grid; scales, directions of axes and mask
///   GWY     Gwyddion: the first channel whose unit is a length, less the points of its mask
///   GSF     Gwyddion Simple Field
///   SUR     Digital Surf, one surface of 16 or 32 bits
///   text    a matrix whose columns run along x and whose rows along y: heights(ix, iy) is the
///           value in column ix of row iy. Headers of Gwyddion and of instruments, in English and
///           German: sizes, distances of the points, units. Values separated by blanks, ';' or ',';
///           decimal point, or decimal comma where that is not ambiguous. Undefined points are
///           empty fields, "nan", "***", "---", "NA", "BAD" and "No Data"
///   XYZ     text of three columns that form a complete or partly filled regular grid; units in the
///           header or beside the names of its columns
///   profile text of one column, or of two whose first grows; HDF5 with one-dimensional heights and
///           positions x: a line profile, which ReadOptions::profiles asks for
/// Any of them but HDF5 may be packed by gzip, and text may be UTF-16 with its byte order mark.
/// Undefined points become NaN. Heights are metres unless the file or the options name a unit.
/// throws   InvalidInput "<file>: <what is wrong>; <what to do>" for a file that is absent, not one
///          of these, truncated, larger by its header than by its content, ambiguous, without a
///          size, or with an infinite height; and by Undefined::fill_few for too many undefined
///          points, with the largest part without any
/// ranks    processes over which the surface is spread: of an HDF5 file each reads its rows unless
///          something is to be done to the heights, any other is read by the root whole.
///          Collective; what fails in one process is thrown on all
/// cost     one pass over the file; memory: the file and the heights. With remarks, a search for
///          spikes in a surface that is not periodic, 0.1 µs a point
Surface read_surface(const std::filesystem::path& file, const ReadOptions& options = {},
                     const Communicator& ranks = {});

}  // namespace salebra
