// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/grid.hpp>
#include <salebra/io/json.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <string>

/// The writers behind write_surface, which has checked the surface.
namespace salebra::detail {

/// Size, unit, origin and provenance as a JSON object, for formats that have no place of their own for them.
Json description_of(const Surface& surface, const Provenance& provenance);

/// Appends the shortest digits that read back as the same double, or "nan".
void append_number(std::string& text, double value);

void write_netcdf(const std::filesystem::path& file, const Surface& surface,
                  const Provenance& provenance, const WriteOptions& options);
void write_x3p(const std::filesystem::path& file, const Surface& surface,
               const Provenance& provenance, const WriteOptions& options);
/// Points where the surface has a height; undefined points are left out.
void write_gxyzf(const std::filesystem::path& file, const Surface& surface,
                 const WriteOptions& options);
/// All points of the grid; undefined ones as nan.
void write_xyz(const std::filesystem::path& file, const Surface& surface,
               const WriteOptions& options);
void write_gsf(const std::filesystem::path& file, const Surface& surface,
               const WriteOptions& options);

}  // namespace salebra::detail
