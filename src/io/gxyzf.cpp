// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of Gwyddion XYZ Field (.gxyzf).
#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "gwyddion_header.hpp"
#include "loaded_surface.hpp"
#include "stored_number.hpp"
#include "xyz.hpp"

/// Gwyddion XYZ Field: a text header padded by NUL bytes to a multiple of eight, then for each
/// point x, y and its channels as little-endian float64.
namespace salebra::detail {
namespace {

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
    xyz[i] = stored_number<double>(content.data() + data + item * i);
  LoadedSurface surface = grid_of_points(file, xyz);
  if (!plane_unit.empty())
    for (auto* size : {&surface.size_x, &surface.size_y}) **size *= metres_per(file, plane_unit);
  surface.unit = height_unit;
  return surface;
}

}  // namespace salebra::detail
