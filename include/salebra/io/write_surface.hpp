// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/grid.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>

namespace salebra {

/// Writes heights in metres, in the format that the extension names:
///   .h5 .hdf5   dataset heights (nx, ny) with dimension scales x, y and attributes size_x, size_y,
///               periodic, units, origin; provenance at the root
///   .npy        float64 [nx, ny], little-endian, and beside it FILE.json with size_x, size_y,
///               periodic, units, checksum, provenance
///   .gwy        Gwyddion: one channel, undefined points as its mask, provenance in /0/meta; up to
///               4 GiB. Whether it is periodic is lost
///   .gsf        Gwyddion Simple Field: heights rounded to float32. Whether it is periodic is lost
///   .txt .asc   matrix with Gwyddion's header, a row for each y; undefined points as nan; 17
///               digits, so that reading gives the same doubles. Whether it is periodic is lost
///   .xyz        points (x, y, z), undefined ones as nan; at least two lines either way, half of
///               the grid defined. Sizes may change in their last digits. Whether it is periodic is
///               lost
/// read_surface reads each of them back. throws InvalidInput for another extension, an invalid
/// surface, and as require_output does; IoError when the system refuses. A surface that is spread
/// over processes goes into an HDF5 file that is byte for byte that of one process, the dates
/// apart; collective. Cost: one pass; memory in addition to the heights: one row; for .h5 the file
void write_surface(const std::filesystem::path& file, const Surface& surface,
                   const Provenance& provenance = {}, const WriteOptions& options = {});

/// To be asked before long work. throws InvalidInput where write_surface would refuse the
/// extension.
void require_surface_name(const std::filesystem::path& file);

}  // namespace salebra
