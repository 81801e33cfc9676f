// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of Digital Surf's SUR format.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "loaded_surface.hpp"
#include "surface_importer.hpp"
#include "text_numbers.hpp"

/// Digital Surf's SUR: a header of 512 bytes with fields at fixed offsets, a comment, a private
/// zone, then heights as integers row after row. All numbers are little-endian. The offsets and
/// meanings are those on which files of MountainsMap and other readers of SUR files agree.
namespace salebra::detail {
namespace {

constexpr std::size_t header_size = 512;

class SurHeader {
 public:
  explicit SurHeader(std::string_view content) : content_(content) {}

  std::int16_t int16(std::size_t at) const { return static_cast<std::int16_t>(bits(at, 2)); }
  std::size_t size(std::size_t at) const { return bits(at, 2); }
  std::int32_t int32(std::size_t at) const { return static_cast<std::int32_t>(bits(at, 4)); }
  double float32(std::size_t at) const {
    return static_cast<double>(std::bit_cast<float>(bits(at, 4)));
  }
  std::string words(std::size_t at) const {
    const std::string_view field = content_.substr(at, 16);
    const std::string text = utf8(trimmed(field.substr(0, field.find('\0'))));
    // Old programs write the micro sign of MS-DOS, whose byte is the letter æ in Latin-1.
    return text == "æm" ? "µm" : text;
  }

 private:
  std::uint32_t bits(std::size_t at, std::size_t bytes) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(content_[at + i])) << (8 * i);
    return value;
  }

  std::string_view content_;
};

/// How the heights of a replica were inverted, so that they represent the surface of which the
/// replica was cast: all heights change sign, and one axis may be reversed too.
enum class Inversion : std::int16_t { none, heights, along_x, along_y };

}  // namespace

LoadedSurface read_sur(const std::filesystem::path& file, std::string_view content,
                       const std::string&) {
  if (content.size() < header_size) refuse(file, "ends within its SUR header; it is truncated");
  if (content.starts_with("DSCOMPRESSED"))
    refuse_unknown(file, "is a compressed SUR file; save it uncompressed");
  const SurHeader header(content);
  if (header.int16(14) > 1)
    refuse_unknown(file, "holds " + std::to_string(header.int16(14)) +
                             " objects; export one surface of them to a file");
  const std::int16_t bits = header.int16(98);
  if (bits != 16 && bits != 32)
    refuse(file,
           "has points of " + std::to_string(bits) + " bits, not 16 or 32; is it a SUR file?");
  const std::int32_t nx = header.int32(108), ny = header.int32(112);
  if (nx < 1 || ny < 1)
    refuse(file, "declares " + std::to_string(nx) + " x " + std::to_string(ny) + " points");
  const std::uint64_t begin = header_size + header.size(334) + header.size(336);
  const std::uint64_t bytes = static_cast<std::uint64_t>(nx) * static_cast<std::uint64_t>(ny) *
                              static_cast<std::uint64_t>(bits / 8);
  if (begin > content.size() || bytes > content.size() - begin)
    refuse(file, "declares more points than it holds; it is truncated");

  LoadedSurface surface;
  surface.stated_unit = header.words(212);
  // If the file does not state a unit of the heights, the user must give it.
  if (!surface.stated_unit.empty()) surface.unit = "m";
  surface.lateral_unit_open = header.words(180).empty();
  if (surface.lateral_unit_open != header.words(196).empty())
    refuse(file, "states the unit of its size along only one axis; is it a SUR file?");
  const auto length = [&](std::size_t step, std::size_t unit) {
    return header.float32(step) * metres_per(file, header.words(unit));
  };
  surface.size_x = nx * length(120, 180);
  surface.size_y = ny * length(124, 196);
  const Inversion inversion{header.int16(290)};
  const double step = inversion == Inversion::none ? length(128, 212) : -length(128, 212);
  if (!std::isfinite(step) || step == 0)
    refuse(file, "does not state the height step; is it a SUR file?");
  if (inversion < Inversion::none || inversion > Inversion::along_y)
    refuse(file, "has an inversion of an unknown kind; is it a SUR file?");
  const bool has_undefined = header.int16(86) == 1;
  const std::int64_t undefined = std::int64_t{header.int32(100)} - 2;
  surface.heights = heights_of(file, nx, ny);
  const SurHeader data(content.substr(begin));
  for (Index iy = 0; iy < ny; ++iy) {
    for (Index ix = 0; ix < nx; ++ix) {
      const auto index = static_cast<std::size_t>(iy * nx + ix);
      const std::int32_t value = bits == 16 ? data.int16(2 * index) : data.int32(4 * index);
      surface.heights(inversion == Inversion::along_x ? nx - 1 - ix : ix,
                      inversion == Inversion::along_y ? ny - 1 - iy : iy) =
          has_undefined && value == undefined ? std::numeric_limits<double>::quiet_NaN()
                                              : value * step;
    }
  }
  return surface;
}

}  // namespace salebra::detail
