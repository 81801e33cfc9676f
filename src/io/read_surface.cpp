// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of a surface: format by content, then size, unit and period from options or file.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/share.hpp>
#include <salebra/base/units.hpp>
#include <salebra/io/read_surface.hpp>
#include <sstream>
#include <stdexcept>

#include "base/memory.hpp"
#include "input.hpp"
#include "input_file.hpp"
#include "loaded_surface.hpp"
#include "surface/plausibility.hpp"
#include "surface_format.hpp"

namespace salebra {
namespace {

detail::LoadedSurface load(const std::filesystem::path& file) {
  // HDF5 is read through its own library, which need not hold the whole file.
  if (detail::is_hdf5(file)) return detail::read_hdf5(file);
  return detail::read_content(file, detail::file_content(file));
}

double size_along(const std::filesystem::path& file, const char* field,
                  const std::optional<double>& given, const std::optional<double>& stated,
                  std::vector<std::string>* remarks) {
  // Spectra divide by products of four steps, which must neither vanish nor overflow.
  const auto usable = [](double size) { return size >= 1e-60 && size <= 1e60; };
  if (given) {
    require_positive(*given, field);
    require(usable(*given), field, *given, "must be from 1e-60 to 1e60, m");
    // Sizes are often given rounded.
    constexpr double rounding = 1e-3;
    if (remarks && stated && usable(*stated) && !(std::abs(*given / *stated - 1) < rounding))
      remarks->push_back(std::string(field) + ": " + format_quantity(*given, Dimension::length) +
                         " was given, and " + file.string() + " states " +
                         format_quantity(*stated, Dimension::length));
    return *given;
  }
  if (!stated)
    detail::refuse(file,
                   "does not state its " + std::string(field) + "; give `size_x` and `size_y`");
  if (!std::isfinite(*stated) || *stated <= 0)
    detail::refuse(file, "states a " + std::string(field) + " of " + std::to_string(*stated) +
                             " m, which is not > 0; give `size_x` and `size_y`");
  if (!usable(*stated))
    detail::refuse(file, "states a " + std::string(field) +
                             " that is not from 1e-60 to 1e60 m; give `size_x` and `size_y`");
  return *stated;
}

}  // namespace

namespace detail {

namespace {

/// What is quoted from a file must neither break the line nor command the terminal.
std::string printable_line(std::string line) {
  std::ranges::replace_if(
      line, [](char symbol) { return (symbol >= '\0' && symbol < ' ') || symbol == '\x7f'; }, '?');
  return line;
}

}  // namespace

void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InvalidInput(file.string(), printable_line(what));
}

Field heights_of(const std::filesystem::path& file, Index nx, Index ny) {
  const double bytes = sizeof(double) * static_cast<double>(nx) * static_cast<double>(ny);
  if (!fits_into_memory(bytes))
    refuse(file, "holds " + std::to_string(nx) + " x " + std::to_string(ny) +
                     " points, which need " + memory_text(bytes) + " of memory, and " +
                     memory_text(static_cast<double>(available_memory())) +
                     " are available; crop it or use fewer points");
  return uninitialised_field(nx, ny);
}

bool is_hdf5(const std::filesystem::path& file) { return InputFile(file).is_hdf5(); }

std::string file_content(const std::filesystem::path& file) { return InputFile(file).content(); }

LoadedSurface read_content(const std::filesystem::path& file, std::string_view content) {
  const auto begins = [&](std::string_view head) { return content.starts_with(head); };
  for (const SurfaceFormatEntry& format : surface_format_table())
    if (format.read && (format.heads.empty() || std::ranges::any_of(format.heads, begins)))
      return format.read(file, content);
  throw std::logic_error("text is no row of the table of formats");
}

std::optional<double> metres_in(const std::string& unit) {
  try {
    const double metres = parse_quantity("1 " + unit, Dimension::length, "unit");
    if (metres > 0) return metres;
  } catch (const InvalidInput&) {
  }
  return {};
}

double metres_per(const std::filesystem::path& file, const std::string& unit) {
  if (const auto metres = metres_in(unit)) return *metres;
  refuse(file, "has heights in '" + unit + "', which is no unit of length; convert them to metres");
}

ReadSurface completed(const std::filesystem::path& file, LoadedSurface loaded,
                      const ReadOptions& options) {
  ReadSurface read{.names_unit = !loaded.unit.empty()};
  Surface& surface = read.surface;
  surface.grid.nx = loaded.rows.value_or(loaded.heights.rows());
  surface.grid.ny = loaded.heights.cols();
  surface.grid.lx = size_along(file, "size_x", options.size_x, loaded.size_x, options.remarks);
  surface.grid.ly = size_along(file, "size_y", options.size_y, loaded.size_y, options.remarks);
  surface.heights = std::move(loaded.heights);
  const std::string unit = read.names_unit ? loaded.unit : options.height_unit;
  if (!unit.empty() && unit != "m") {
    read.metres_per_unit = metres_per(file, unit);
    surface.heights *= read.metres_per_unit;
  }
  if (surface.heights.isInf().any())
    refuse(file, "holds an infinite height; mark undefined points as nan");
  surface.periodic = options.periodic.value_or(loaded.periodic.value_or(false));
  surface.origin = file.string();
  if (options.remarks)
    for (const std::string& remark : loaded.remarks)
      options.remarks->push_back(file.string() + ": " + printable_line(remark));
  return read;
}

}  // namespace detail

namespace {

/// The rows of each process of a surface that the root holds.
Surface spread(const Surface& surface, const Communicator& ranks) {
  std::string origin = surface.origin;
  struct {
    Grid2D grid;
    std::size_t length;
    bool periodic;
  } head{surface.grid, origin.size(), surface.periodic};
  ranks.broadcast(&head, sizeof head);
  origin.resize(head.length);
  ranks.broadcast(origin.data(), origin.size());
  Surface rows{head.grid, {}, head.periodic, origin, ranks};
  rows.heights = scattered(rows.share(), head.grid.ny, surface.heights);
  return rows;
}

/// Those of the root in all processes.
void share(std::vector<std::string>& lines, const Communicator& ranks) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  std::istringstream of_root(ranks.gather_all(text).front());
  lines.clear();
  for (std::string line; std::getline(of_root, line);) lines.push_back(line);
}

/// The surface, its heights doubted in the remarks. Collective of a surface that is spread.
Surface with_remarks(const std::filesystem::path& file, detail::ReadSurface read,
                     const ReadOptions& options) {
  if (options.remarks == nullptr) return std::move(read.surface);
  if (const auto doubt = doubt_of_heights(read.surface, read.metres_per_unit))
    options.remarks->push_back(file.string() + ": " + *doubt +
                               (read.names_unit ? "" : "; see `height_unit`"));
  return std::move(read.surface);
}

}  // namespace

Surface read_surface(const std::filesystem::path& file, const ReadOptions& options,
                     const Communicator& ranks) {
  const auto read = [&](detail::LoadedSurface loaded) {
    return detail::completed(file, std::move(loaded), options);
  };
  if (ranks.alone()) return with_remarks(file, read(load(file)), options);
  Surface surface;
  bool hdf5 = false;
  collectively(ranks, [&] {
    if (!ranks.is_root()) return;
    hdf5 = detail::is_hdf5(file);
    if (!hdf5) surface = with_remarks(file, read(load(file)), options);
  });
  ranks.broadcast(&hdf5, sizeof hdf5);
  if (!hdf5) {
    if (options.remarks) share(*options.remarks, ranks);
    return spread(surface, ranks);
  }
  // Each process reads its rows itself.
  require_one_file(file, ranks);
  detail::ReadSurface rows;
  collectively(ranks, [&] { rows = read(detail::read_hdf5(file, ranks)); });
  rows.surface.ranks = ranks;
  return with_remarks(file, std::move(rows), options);
}

}  // namespace salebra
