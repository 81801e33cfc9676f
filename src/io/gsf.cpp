// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <salebra/base/error.hpp>

#include "atomic_file.hpp"
#include "loaded_surface.hpp"
#include "surface_writers.hpp"
#include "text_numbers.hpp"

/// Gwyddion Simple Field: a text header "Key = value" ended by 1 to 4 NUL bytes that pad it to a multiple of four, then float32
/// values, little-endian, row after row from the top left; undefined points are NaN.
namespace salebra::detail {
namespace {

constexpr std::string_view magic = "Gwyddion Simple Field 1.0\n";

template <class Number>
Number number_of(const std::filesystem::path& file, std::string_view key, std::string_view text) {
  Number value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || !(value > 0))
    refuse(file, "has the GSF entry " + std::string(key) + " = '" +
                     std::string(text.substr(0, 20)) + "', which is no number > 0");
  return value;
}

}  // namespace

bool is_gsf(std::string_view content) { return content.starts_with(magic); }

LoadedSurface read_gsf(const std::filesystem::path& file, std::string_view content) {
  const std::size_t header_end = content.find('\0');
  if (header_end == std::string_view::npos)
    refuse(file, "ends within its GSF header; it is truncated");
  LoadedSurface surface;
  Index nx = 0, ny = 0;
  Lines lines(content.substr(0, header_end));
  std::string_view line;
  lines.next(line);
  while (lines.next(line)) {
    const auto equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string_view key = trimmed(line.substr(0, equals)),
                           value = trimmed(line.substr(equals + 1));
    if (key == "XRes") nx = number_of<Index>(file, key, value);
    if (key == "YRes") ny = number_of<Index>(file, key, value);
    if (key == "XReal") surface.size_x = number_of<double>(file, key, value);
    if (key == "YReal") surface.size_y = number_of<double>(file, key, value);
    if (key == "ZUnits") surface.unit = value;
    if (key == "XYUnits" && !value.empty() && value != "m")
      refuse(file,
             "has its size in '" + std::string(value.substr(0, 20)) + "', which is not metres");
  }
  if (nx == 0 || ny == 0) refuse(file, "lacks XRes or YRes in its GSF header");
  const std::size_t data = header_end + 4 - header_end % 4;
  const std::uint64_t available = content.size() > data ? (content.size() - data) / 4 : 0;
  if (static_cast<std::uint64_t>(nx) > available / static_cast<std::uint64_t>(ny))
    refuse(file,
           fmt::format("declares {} x {} points, more than it holds; it is truncated", nx, ny));
  surface.heights.resize(nx, ny);
  for (Index iy = 0; iy < ny; ++iy) {
    for (Index ix = 0; ix < nx; ++ix) {
      std::array<unsigned char, 4> bytes;
      std::memcpy(bytes.data(), content.data() + data + 4 * static_cast<std::size_t>(iy * nx + ix),
                  4);
      const std::uint32_t bits =
          static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
          static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
      surface.heights(ix, iy) = static_cast<double>(std::bit_cast<float>(bits));
    }
  }
  return surface;
}

void write_gsf(const std::filesystem::path& file, const Surface& surface,
               const WriteOptions& options) {
  const Grid2D& grid = surface.grid;
  std::string bytes = fmt::format(
      "{}XRes = {}\nYRes = {}\nXReal = {}\nYReal = {}\nXYUnits = m\nZUnits = m\nTitle = heights\n",
      magic, grid.nx, grid.ny, grid.lx, grid.ly);
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
