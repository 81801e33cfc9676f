// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of NetCDF surfaces (CDF-2) as SurfaceTopography reads them.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <salebra/base/error.hpp>
#include <string>
#include <tuple>

#include "atomic_file.hpp"
#include "netcdf_tags.hpp"
#include "surface_writers.hpp"

namespace salebra::detail {
namespace {

void append_big_endian(std::string& bytes, std::uint64_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> shift & 0xff);
}

void append(std::string& bytes, double value) {
  append_big_endian(bytes, std::bit_cast<std::uint64_t>(value), 8);
}

/// Header of a CDF-2 file: big-endian integers of four bytes, offsets of eight, names and values
/// padded to four.
class WrittenHeader {
 public:
  void word(std::uint32_t value) { append_big_endian(bytes_, value, 4); }
  void offset(std::uint64_t value) { append_big_endian(bytes_, value, 8); }
  void name(std::string_view value) {
    word(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
    bytes_.append((4 - value.size() % 4) % 4, '\0');
  }
  void note(std::string_view key, std::string_view value) {
    name(key);
    word(2);
    name(value);
  }
  void note(std::string_view key, double value) {
    name(key);
    word(6);
    word(1);
    append(bytes_, value);
  }
  void note(std::string_view key, std::int32_t value) {
    name(key);
    word(4);
    word(1);
    word(static_cast<std::uint32_t>(value));
  }
  void list(std::uint32_t tag, std::uint32_t entries) {
    word(tag);
    word(entries);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_ = std::string("CDF\x02", 4);
};

constexpr std::uint32_t int8 = 1, float64 = 6;

/// Sizes of variables, and so their places, are multiples of four bytes.
std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

std::string header_of(const Surface& surface, const std::string& information,
                      std::uint64_t data_begin) {
  const Grid2D& grid = surface.grid;
  WrittenHeader header;
  header.word(0);
  header.list(dimension_tag, 2);
  header.name("x");
  header.word(static_cast<std::uint32_t>(grid.nx));
  header.name("y");
  header.word(static_cast<std::uint32_t>(grid.ny));
  header.list(attribute_tag, 1);
  header.note("json", information);
  // SurfaceTopography asks for a mask where points are undefined; NaN among the heights is not
  // enough for it.
  const bool masked = surface.undefined_points() > 0;
  header.list(variable_tag, masked ? 4 : 3);
  std::uint64_t begin = data_begin;
  const auto place = [&](Index points, std::uint32_t kind) {
    const std::uint64_t bytes =
        padded((kind == float64 ? sizeof(double) : 1) * static_cast<std::uint64_t>(points));
    header.word(kind);
    header.word(static_cast<std::uint32_t>(bytes));
    header.offset(begin);
    begin += bytes;
  };
  for (const auto& [name, axis, length, points] :
       {std::tuple("x", 0u, grid.lx, grid.nx), std::tuple("y", 1u, grid.ly, grid.ny)}) {
    header.name(name);
    header.word(1);
    header.word(axis);
    header.list(attribute_tag, 3);
    header.note("length", length);
    header.note("periodic", std::int32_t{surface.periodic});
    header.note("unit", "m");
    place(points, float64);
  }
  header.name("heights");
  header.word(2);
  header.word(0);
  header.word(1);
  header.list(attribute_tag, 1);
  header.note("unit", "m");
  place(grid.points(), float64);
  if (masked) {
    header.name("mask");
    header.word(2);
    header.word(0);
    header.word(1);
    header.list(0, 0);
    place(grid.points(), int8);
  }
  return header.bytes();
}

}  // namespace

void write_netcdf(const std::filesystem::path& file, const Surface& surface,
                  const Provenance& provenance, const WriteOptions& options) {
  const Grid2D& grid = surface.grid;
  if (grid.points() > static_cast<Index>(std::numeric_limits<std::uint32_t>::max() / 8))
    throw InvalidInput(
        file.string(),
        "would need more than 4 GiB, which NetCDF CDF-2 cannot hold; write HDF5 (.h5)");
  const std::string information = description_of(surface, provenance).dump();
  const std::size_t size = header_of(surface, information, 0).size();
  AtomicFile output(file, options);
  output.write(header_of(surface, information, size));
  std::string bytes;
  for (Index ix = 0; ix < grid.nx; ++ix) append(bytes, static_cast<double>(ix) * grid.dx());
  for (Index iy = 0; iy < grid.ny; ++iy) append(bytes, static_cast<double>(iy) * grid.dy());
  output.write(bytes);
  for (Index ix = 0; ix < grid.nx; ++ix) {
    bytes.clear();
    for (Index iy = 0; iy < grid.ny; ++iy) append(bytes, surface.heights(ix, iy));
    output.write(bytes);
  }
  if (surface.undefined_points() > 0) {
    bytes.clear();
    for (Index ix = 0; ix < grid.nx; ++ix)
      for (Index iy = 0; iy < grid.ny; ++iy)
        bytes += static_cast<char>(std::isnan(surface.heights(ix, iy)));
    bytes.resize(padded(bytes.size()));
    output.write(bytes);
  }
  output.commit();
}

}  // namespace salebra::detail
