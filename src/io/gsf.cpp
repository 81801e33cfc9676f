// SPDX-License-Identifier: GPL-3.0-or-later
// Reader and writer of Gwyddion Simple Field (.gsf).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "atomic_file.hpp"
#include "header_words.hpp"
#include "loaded_surface.hpp"
#include "stored_number.hpp"
#include "surface_writers.hpp"
#include "text_numbers.hpp"

/// Gwyddion Simple Field: a text header of lines "Key = value", 1 to 4 NUL bytes that pad it to a
/// multiple of four, then little-endian float32 values, row after row from the top left; undefined
/// points are NaN.
namespace salebra::detail {
namespace {

constexpr std::string_view gsf_magic = "Gwyddion Simple Field 1.0\n";

/// The value of a header entry that must be a number > 0.
template <class Number>
Number positive_entry(const std::filesystem::path& file, std::string_view key,
                      std::string_view value) {
  Number number{};
  const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (status != std::errc{} || end != value.data() + value.size() || !(number > 0) ||
      !std::isfinite(static_cast<double>(number)))
    refuse(file, "has the entry " + std::string(key) + " = '" + std::string(value.substr(0, 20)) +
                     "' in its header, which is not a number > 0");
  return number;
}

}  // namespace

LoadedSurface read_gsf(const std::filesystem::path& file, std::string_view content,
                       const std::string&) {
  LoadedSurface surface;
  surface.lateral_unit_open = true;
  Index nx = 0, ny = 0;
  const std::size_t end = content.find('\0');
  if (end == std::string_view::npos) refuse(file, "ends within its header; it is truncated");
  Lines lines(content.substr(0, end));
  for (std::string_view line; lines.next(line);) {
    const auto equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string_view key = trimmed(line.substr(0, equals));
    const std::string_view value = trimmed(line.substr(equals + 1));
    constexpr std::array known{"XRes",   "YRes",  "XReal",   "YReal",  "XYUnits",
                               "ZUnits", "Title", "XOffset", "YOffset"};
    if (std::ranges::find(known, key) == known.end() && is_about_numbers(key, value))
      refuse(file,
             "has the entry '" + std::string(line.substr(0, 60)) +
                 "' in its header, which salebra does not apply; apply it and remove the entry");
    if (key == "XRes") nx = positive_entry<Index>(file, key, value);
    if (key == "YRes") ny = positive_entry<Index>(file, key, value);
    if (key == "XReal") surface.size_x = positive_entry<double>(file, key, value);
    if (key == "YReal") surface.size_y = positive_entry<double>(file, key, value);
    if (key == "ZUnits") surface.unit = value;
    if (key == "XYUnits" && !value.empty()) surface.lateral_unit_open = false;
    if (key == "XYUnits" && !value.empty() && value != "m")
      refuse(file,
             "has its size in '" + std::string(value.substr(0, 20)) + "', which is not in metres");
  }
  const std::size_t data = end + 4 - end % 4;
  if (nx == 0 || ny == 0) refuse(file, "lacks XRes or YRes in its GSF header");
  const std::uint64_t available = content.size() > data ? (content.size() - data) / 4 : 0;
  if (static_cast<std::uint64_t>(nx) > available / static_cast<std::uint64_t>(ny))
    refuse(file,
           fmt::format("declares {} x {} points, more than it holds; it is truncated", nx, ny));
  surface.heights = heights_of(file, nx, ny);
  for (Index iy = 0; iy < ny; ++iy) {
    for (Index ix = 0; ix < nx; ++ix) {
      const auto index = static_cast<std::size_t>(iy * nx + ix);
      surface.heights(ix, iy) = stored_number<float>(content.data() + data + 4 * index);
    }
  }
  return surface;
}

void write_gsf(const std::filesystem::path& file, const Surface& surface, const Provenance&,
               const WriteOptions& options) {
  const Grid2D& grid = surface.grid;
  std::string bytes = fmt::format(
      "{}XRes = {}\nYRes = {}\nXReal = {}\nYReal = {}\nXYUnits = m\nZUnits = m\nTitle = heights\n",
      gsf_magic, grid.nx, grid.ny, grid.lx, grid.ly);
  bytes.append(4 - bytes.size() % 4, '\0');
  AtomicFile output(file, options);
  for (Index iy = 0; iy < grid.ny; ++iy) {
    for (Index ix = 0; ix < grid.nx; ++ix) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(surface.heights(ix, iy)));
      for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
    }
    output.write(bytes);
    bytes.clear();
  }
  output.commit();
}

}  // namespace salebra::detail
