// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/grid.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>

namespace salebra {

/// Writes heights in metres, e.g. `write_surface("scan.h5", surface)`. The extension selects the
/// format:
///   .h5 .hdf5   dataset heights (nx, ny) with dimension scales x, y and attributes size_x, size_y,
///               periodic, units, origin; provenance at the root
///   .npy        float64 [nx, ny], little-endian, with a file FILE.json for size_x, size_y,
///               periodic, units, checksum, provenance
///   .gwy        Gwyddion: one channel, undefined points as its mask, provenance in /0/meta; up to
///               4 GiB. `periodic` is lost
///   .gsf        Gwyddion Simple Field: heights rounded to float32. `periodic` is lost
///   .txt .asc   matrix with Gwyddion's header, a row for each y; undefined points as nan; 17
///               digits, so that reading gives the same doubles. `periodic` is lost
///   .xyz        points (x, y, z), undefined points as nan; needs at least two lines in each
///               direction and half of the points defined. Sizes may change in their last digits.
///               `periodic` is lost
/// read_surface reads all these formats. A surface distributed over processes gives the same HDF5
/// file as one process, byte for byte except for the dates; collective. Throws InvalidInput for
/// another extension, for an invalid surface, and wherever require_output does; IoError if the
/// operating system refuses. Cost: one pass over the heights; memory, in addition to the heights,
/// for one row, or for .h5 for the whole file.
void write_surface(const std::filesystem::path& file, const Surface& surface,
                   const Provenance& provenance = {}, const WriteOptions& options = {});

/// Checks the extension of a file name before a long computation. Throws InvalidInput if
/// write_surface would reject the extension.
void require_surface_name(const std::filesystem::path& file);

}  // namespace salebra
