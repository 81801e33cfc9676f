// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of surfaces: finds the format by the extension; with the writers of HDF5, NPY and text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/io/write_surface.hpp>
#include <vector>

#include "atomic_file.hpp"
#include "base/checksum.hpp"
#include "hdf5_output.hpp"
#include "json.hpp"
#include "sidecar.hpp"
#include "surface_format.hpp"
#include "surface_writers.hpp"

namespace salebra::detail {

void write_hdf5(const std::filesystem::path& file, const Surface& surface,
                const Provenance& provenance, const WriteOptions& options) {
  std::optional<hdf5::Output> output;
  collectively(surface.communicator, [&] {
    output.emplace(file, provenance, options, surface.communicator, hdf5::Output::Fields::stay);
    const Grid2D& grid = surface.grid;
    const std::vector<double> x = positions(grid.nx, grid.dx()), y = positions(grid.ny, grid.dy());
    output->scale(output->root(), "x", x.data(), x.size(), {"m", "position along x"});
    output->scale(output->root(), "y", y.data(), y.size(), {"m", "position along y"});
    const auto heights = output->field(output->root(), "heights", surface.heights, {"x", "y"},
                                       {"m", "height, positive out of the material"});
    output->attribute(heights, "size_x", grid.lx);
    output->attribute(heights, "size_y", grid.ly);
    output->attribute(heights, "periodic", std::int64_t{surface.periodic});
    output->attribute(heights, "origin", surface.origin);
  });
  output->commit();
}

void write_npy(const std::filesystem::path& file, const Surface& surface,
               const Provenance& provenance, const WriteOptions& options) {
  static_assert(std::endian::native == std::endian::little);
  // The heights begin at a multiple of 64 bytes, as numpy.save() writes them.
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}",
                  surface.grid.nx, surface.grid.ny);
  constexpr std::size_t before = 10;
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  std::string start("\x93NUMPY\x01\x00", 8);
  start += {static_cast<char>(header.size() % 256), static_cast<char>(header.size() / 256)};
  start += header;
  const std::string_view heights(reinterpret_cast<const char*>(surface.heights.data()),
                                 static_cast<std::size_t>(surface.grid.points()) * sizeof(double));

  AtomicFile array(file, options), sidecar(sidecar_of(file), options);
  array.write(start);
  array.write(heights);
  Json description = description_of(surface, provenance);
  Checksum sum(start);
  sum.add(heights);
  description["checksum"] = sum.digits();
  sidecar.write(description.dump(2) + "\n");
  array.finish();
  sidecar.finish();
  // Renames the sidecar first. If the program ends before the array is renamed, the checksum of the
  // new sidecar does not fit the old array. In the reverse order an old sidecar without checksum
  // would seem to fit the new array.
  std::error_code ignored;
  const bool alone = !std::filesystem::exists(sidecar.target(), ignored);
  sidecar.rename_to_target();
  try {
    array.rename_to_target();
  } catch (const IoError&) {
    if (alone && !array.placed()) std::filesystem::remove(sidecar.target(), ignored);
    throw;
  }
}

void write_text(const std::filesystem::path& file, const Surface& surface, const Provenance&,
                const WriteOptions& options) {
  AtomicFile output(file, options);
  std::string line = "# Channel: heights\n# Width: ";
  append_number(line, surface.grid.lx);
  line += " m\n# Height: ";
  append_number(line, surface.grid.ly);
  line += " m\n# Value units: m\n# Points: " + std::to_string(surface.grid.points()) + "\n";
  for (Index iy = 0; iy < surface.grid.ny; ++iy) {
    for (Index ix = 0; ix < surface.grid.nx; ++ix) {
      append_number(line, surface.heights(ix, iy));
      line += ix + 1 < surface.grid.nx ? '\t' : '\n';
    }
    output.write(line);
    line.clear();
  }
  output.commit();
}

void append_number(std::string& text, double value) {
  std::array<char, 32> digits;
  const auto end = std::isnan(value)
                       ? std::copy_n("nan", 3, digits.data())
                       : std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

Json description_of(const Surface& surface, const Provenance& provenance) {
  Json description = {{"size_x", surface.grid.lx},
                      {"size_y", surface.grid.ly},
                      {"periodic", surface.periodic},
                      {"units", "m"},
                      {"origin", surface.origin},
                      {"program", "salebra"},
                      {"version", version()},
                      {"libraries", library_versions()},
                      {"created", provenance.created.empty() ? utc_now() : provenance.created},
                      {"command_line", provenance.command_line},
                      {"configuration", provenance.configuration}};
  if (provenance.seed) description["seed"] = *provenance.seed;
  return description;
}

}  // namespace salebra::detail

namespace salebra {
namespace {

const detail::SurfaceFormatEntry& written_format(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  for (const detail::SurfaceFormatEntry& format : detail::surface_format_table()) {
    const auto& extensions = format.facts.extensions;
    if (format.write && std::ranges::find(extensions, extension) != extensions.end()) return format;
  }
  throw InvalidInput(file.string(),
                     "has the extension '" + extension +
                         "', which is not a format that salebra writes; use one of " +
                         written_extensions());
}

}  // namespace

void require_surface_name(const std::filesystem::path& file) { written_format(file); }

void write_surface(const std::filesystem::path& file, const Surface& surface,
                   const Provenance& provenance, const WriteOptions& options) {
  const detail::SurfaceFormatEntry& format = written_format(file);
  if (format.write != detail::write_hdf5)
    surface.require_whole("a file of the format " + file.extension().string());
  collectively(surface.communicator, [&] {
    surface.grid.validate();
    require(surface.heights.rows() == surface.partition().count() &&
                surface.heights.cols() == surface.grid.ny,
            "heights", surface.heights.size(), "points do not match the grid");
  });
  format.write(file, surface, provenance, options);
}

}  // namespace salebra
