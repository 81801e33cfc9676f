// SPDX-License-Identifier: GPL-3.0-or-later
// Reader and writer of Gwyddion XYZ Field (.gxyzf).
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "atomic_file.hpp"
#include "gwyddion_header.hpp"
#include "loaded_surface.hpp"
#include "surface_writers.hpp"
#include "xyz.hpp"

/// Gwyddion XYZ Field: a text header padded by NUL bytes to a multiple of eight, then for each
/// point x, y and its channels as little-endian float64.
namespace salebra::detail {
namespace {

constexpr std::string_view gxyzf_magic = "Gwyddion XYZ Field 1.0\n";
constexpr std::size_t item = sizeof(double);

}  // namespace

LoadedSurface read_gxyzf(const std::filesystem::path& file, std::string_view content) {
  Index channels = 0, points = 0;
  std::string plane_unit, height_unit;
  const auto entry = [&](std::string_view key, std::string_view value) {
    if (key == "NChannels") channels = positive_entry<Index>(file, key, value);
    if (key == "NPoints") points = positive_entry<Index>(file, key, value);
    if (key == "XYUnits") plane_unit = value;
    if (key == "ZUnits1") height_unit = value;
  };
  const std::size_t data = read_gwyddion_header(file, content, item, entry);
  if (channels == 0 || points == 0) refuse(file, "lacks NChannels or NPoints in its GXYZF header");
  if (channels > 1)
    refuse(file, "holds " + std::to_string(channels) +
                     " channels; save the one with the heights to a file of its own");
  constexpr std::size_t values = 3;
  const std::uint64_t available =
      content.size() > data ? (content.size() - data) / (item * values) : 0;
  if (static_cast<std::uint64_t>(points) > available)
    refuse(file, fmt::format("declares {} points, more than it holds; it is truncated", points));
  std::vector<double> xyz(values * static_cast<std::size_t>(points));
  for (std::size_t i = 0; i < xyz.size(); ++i)
    xyz[i] = little_endian<double>(content.data() + data + item * i);
  LoadedSurface surface = grid_of_points(file, xyz);
  if (!plane_unit.empty()) scale_plane(file, plane_unit, surface);
  surface.unit = height_unit;
  return surface;
}

void write_gxyzf(const std::filesystem::path& file, const Surface& surface, const Provenance&,
                 const WriteOptions& options) {
  static_assert(std::endian::native == std::endian::little);
  require_points(file, surface);
  const Grid2D& grid = surface.grid;
  AtomicFile output(file, options);
  std::string bytes = fmt::format(
      "{}NChannels = 1\nNPoints = {}\nXRes = {}\nYRes = {}\nXYUnits = m\nZUnits1 = m\n"
      "Title1 = heights\n",
      gxyzf_magic, grid.points() - surface.undefined_points(), grid.nx, grid.ny);
  bytes.append(item - bytes.size() % item, '\0');
  for (Index ix = 0; ix < grid.nx; ++ix) {
    for (Index iy = 0; iy < grid.ny; ++iy) {
      if (std::isnan(surface.heights(ix, iy))) continue;
      for (const double value : {static_cast<double>(ix) * grid.dx(),
                                 static_cast<double>(iy) * grid.dy(), surface.heights(ix, iy)})
        bytes.append(reinterpret_cast<const char*>(&value), item);
    }
    output.write(bytes);
    bytes.clear();
  }
  output.commit();
}

}  // namespace salebra::detail
