// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of surfaces: finds the format by the content of the file, and completes size, unit and
// period by the options.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/base/units.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/surface/crop.hpp>
#include <salebra/surface/fill.hpp>
#include <salebra/surface/spikes.hpp>
#include <sstream>
#include <stdexcept>

#include "base/memory.hpp"
#include "base/printable.hpp"
#include "input.hpp"
#include "input_file.hpp"
#include "loaded_surface.hpp"
#include "plain_content.hpp"
#include "scratch_folder.hpp"
#include "surface/plausibility.hpp"
#include "surface_format.hpp"
#include "surface_importer.hpp"

namespace salebra {
namespace {

SurfaceImporter surface_importer = nullptr;

detail::LoadedSurface load(const std::filesystem::path& file, const ReadOptions& options) {
  try {
    const detail::InputFile input(file);
    // HDF5 files are not read into memory first: the HDF5 library reads the file in parts.
    if (input.is_hdf5()) return detail::read_hdf5(file, options.channel);
    if (detail::is_plain_text(input)) return detail::read_text(input);
    return detail::read_content(file, detail::file_content(input), options.channel);
  } catch (const UnknownFormat& refusal) {
    if (surface_importer == nullptr || options.known_formats) throw;
    // An HDF5 file is not passed to the importer, whose HDF5 library would follow links to other
    // files.
    if (detail::InputFile(file).may_be_hdf5()) throw;
    const detail::ScratchFolder scratch("import");
    std::vector<std::string> warnings =
        surface_importer(file, scratch / "surface.h5", options.channel, refusal);
    detail::LoadedSurface loaded = detail::read_hdf5(scratch / "surface.h5");
    loaded.warnings = std::move(warnings);
    loaded.has_channels = true;
    return loaded;
  }
}

double size_along(const std::filesystem::path& file, const char* field,
                  const std::optional<double>& given, const std::optional<double>& stated,
                  std::vector<std::string>* warnings) {
  // Spectra divide by products of four steps. Sizes outside these limits would make the products
  // underflow or overflow.
  const auto usable = [](double size) { return size >= 1e-60 && size <= 1e60; };
  if (given) {
    require_positive(*given, field);
    require(usable(*given), field, *given, "must be from 1e-60 to 1e60, m");
    // A difference below this is no contradiction, since users often round sizes.
    constexpr double rounding = 1e-3;
    if (warnings && stated && usable(*stated) && !(std::abs(*given / *stated - 1) < rounding))
      warnings->push_back("`" + std::string(field) +
                          "`: " + format_quantity(*given, Dimension::length) + " was given, but " +
                          file.string() + " states " + format_quantity(*stated, Dimension::length));
    return *given;
  }
  if (!stated)
    detail::refuse(file, "does not state its " + std::string(field) +
                             "; give `size_x` and `size_y`, or `pixel_size`");
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

void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InvalidInput(file.string(), printable_line(what));
}

void refuse_unknown(const std::filesystem::path& file, const std::string& what) {
  throw UnknownFormat(file.string(), printable_line(what));
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

namespace {

/// The entry of the table of formats for a content, found by its first bytes.
const SurfaceFormatEntry& entry_of(std::string_view content) {
  const auto begins = [&](std::string_view head) { return content.starts_with(head); };
  for (const SurfaceFormatEntry& format : surface_format_table())
    if (format.read && (format.heads.empty() || std::ranges::any_of(format.heads, begins)))
      return format;
  throw std::logic_error("text is no row of the table of formats");
}

}  // namespace

bool is_plain_text(const InputFile& input) {
  const std::string head = input.head(64);
  return !head.empty() && !is_wrapped(head) && entry_of(head).heads.empty();
}

std::string file_content(const InputFile& input) {
  std::string content = input.content();
  if (std::optional<std::string> plain = plain_content(input.path(), content))
    return std::move(*plain);
  return content;
}

LoadedSurface read_content(const std::filesystem::path& file, std::string_view content,
                           const std::string& channel) {
  return entry_of(content).read(file, content, channel);
}

std::size_t chosen_channel(const std::filesystem::path& file, const std::vector<Channel>& channels,
                           const std::string& wanted, LoadedSurface& surface) {
  surface.has_channels = true;
  const auto text = [](const Channel& channel) {
    if (channel.number.empty()) return channel.name;
    return channel.number + (channel.name.empty() ? "" : " (" + channel.name + ")");
  };
  // The names of all channels in a list, except the channel `without`.
  const auto list = [&](const auto& kind, const Channel* without) {
    std::string names;
    for (const Channel& channel : channels)
      if (&channel != without && kind(channel))
        names += (names.empty() ? "" : ", ") + text(channel);
    return names;
  };
  const auto any = [](const Channel&) { return true; };
  if (!wanted.empty()) {
    auto found = std::ranges::find(channels, wanted, &Channel::number);
    if (found == channels.end()) {
      found = std::ranges::find(channels, wanted, &Channel::name);
      const bool is_only = std::ranges::count(channels, wanted, &Channel::name) == 1;
      require(is_only, "channel", wanted,
              fmt::format("is {} of {}, which has {}; give one of them",
                          found == channels.end() ? "no channel" : "the name of several channels",
                          file.string(), list(any, nullptr)));
    }
    return static_cast<std::size_t>(found - channels.begin());
  }
  const auto is_length = [](const Channel& channel) { return metres_in(channel.unit).has_value(); };
  const auto is_bare = [](const Channel& channel) { return channel.unit.empty(); };
  const auto first_of = [&](const auto& kind) -> std::optional<std::size_t> {
    const auto found = std::ranges::find_if(channels, kind);
    if (found == channels.end()) return {};
    if (const std::string others = list(kind, &*found); !others.empty())
      surface.warnings.push_back(
          fmt::format("channel {} was read; the others are {}; choose one with `channel`",
                      text(*found), others));
    return found - channels.begin();
  };
  if (const auto found = first_of(is_length)) return *found;
  if (const auto found = first_of(is_bare)) return *found;
  refuse(file, "does not contain a channel of heights: the unit of the first one is '" +
                   channels.front().unit + "'");
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
  refuse(file,
         "has heights in '" + unit + "', which is not a unit of length; convert them to metres");
}

namespace {

/// The size along x (axis 0) or y (axis 1) that the user gave, directly or by the distance of
/// points.
std::optional<double> given_size(const ReadOptions& options, int axis, Index points) {
  const std::optional<double>& size = axis == 0 ? options.size_x : options.size_y;
  if (!options.pixel_size) return size;
  require(!size, axis == 0 ? "size_x" : "size_y", size.value_or(0),
          "was given together with `pixel_size`; give one of them");
  const auto [dx, dy] = *options.pixel_size;
  const double step = axis == 0 ? dx : dy;
  require_positive(step, "pixel_size");
  return step * static_cast<double>(points);
}

/// Returns a warning if the cells would be much closer to squares with the two sizes exchanged:
/// programs disagree on which index of an array is x.
std::optional<std::string> warning_of_axes(const Grid2D& grid) {
  const auto ratio = [](double a, double b) { return std::max(a, b) / std::min(a, b); };
  const double other_dx = grid.lx / static_cast<double>(grid.ny),
               other_dy = grid.ly / static_cast<double>(grid.nx);
  const double now = ratio(grid.dx(), grid.dy()), other = ratio(other_dx, other_dy);
  if (grid.nx == grid.ny || now <= other * (1 + 1e-9)) return {};
  const auto cells = [](double dx, double dy) {
    return format_quantity(dx, Dimension::length, 3) + " x " +
           format_quantity(dy, Dimension::length, 3);
  };
  return fmt::format("{} x {} points along x and y, cells of {}; with `transpose` they are {}",
                     grid.nx, grid.ny, cells(grid.dx(), grid.dy()), cells(other_dx, other_dy));
}

void scale_sizes(const std::filesystem::path& file, const ReadOptions& options,
                 LoadedSurface& loaded) {
  if (options.lateral_unit.empty()) return;
  const std::optional<double> metres = metres_in(options.lateral_unit);
  require(metres.has_value(), "lateral_unit", options.lateral_unit,
          "is not a unit of length; give one such as um");
  if (loaded.lateral_unit_open) {
    for (auto* size : {&loaded.size_x, &loaded.size_y})
      if (*size) **size *= *metres;
  } else if (options.warnings) {
    options.warnings->push_back(file.string() + ": `lateral_unit` " + options.lateral_unit +
                                " was not used: " +
                                (loaded.size_x ? "the size in the file has a unit or is in metres"
                                               : "the file states no size"));
  }
}

/// Completes the grid of a line profile: one row of points, as wide as a step. Throws InvalidInput
/// unless the options allow profiles.
void complete_profile(const std::filesystem::path& file, const ReadOptions& options,
                      const LoadedSurface& loaded, Grid2D& grid) {
  if (!options.profiles)
    refuse(file, fmt::format("is a line profile of {} points, but a contact needs an area; "
                             "statistics reports an isotropic surface to generate instead",
                             loaded.heights.rows()));
  if (options.transpose || options.crop)
    refuse(file, "is a line profile, which cannot be transposed or cropped");
  if (!options.size_x && !options.pixel_size && !loaded.size_x)
    refuse(file, fmt::format("is a line profile of {} points that does not state its length; give "
                             "`size_x` or `pixel_size`",
                             loaded.heights.rows()));
  grid.lx =
      size_along(file, "size_x", given_size(options, 0, grid.nx), loaded.size_x, options.warnings);
  grid.ly = grid.dx();
}

}  // namespace

namespace {

/// Throws InvalidInput if the file leaves questions open that the options do not answer.
void answer_questions(const std::filesystem::path& file, const ReadOptions& options,
                      LoadedSurface& loaded) {
  const bool size = options.pixel_size ||
                    (options.size_x && (options.size_y || loaded.is_profile)) ||
                    (loaded.lateral_unit_open && !options.lateral_unit.empty());
  const bool heights = !loaded.unit.empty() || !options.height_unit.empty();
  for (const OpenQuestion& question : loaded.questions) {
    if ((question.size && !size) || (question.heights && !heights)) refuse(file, question.text);
    loaded.warnings.push_back(question.text.substr(0, question.text.rfind(';')));
  }
  if (options.height_unit.empty() || loaded.unit.empty()) return;
  const std::string& unit = loaded.stated_unit.empty() ? loaded.unit : loaded.stated_unit;
  const auto given = metres_in(options.height_unit), stated = metres_in(unit);
  require(given && stated && std::abs(*given / *stated - 1) < 1e-9, "height_unit",
          options.height_unit,
          "was given, but " + file.string() + " states the unit of its heights, '" + unit +
              "'; leave it out");
}

}  // namespace

ReadSurface completed(const std::filesystem::path& file, LoadedSurface loaded,
                      const ReadOptions& options) {
  require(options.channel.empty() || loaded.has_channels, "channel", options.channel,
          "was given, but " + file.string() +
              " has a format that holds only one surface; leave it out");
  answer_questions(file, options, loaded);
  ReadSurface read{
      .names_unit = !loaded.unit.empty(),
      .names_lateral_unit = !loaded.lateral_unit_open || !options.lateral_unit.empty()};
  Surface& surface = read.surface;
  if (options.transpose) {
    loaded.heights = Field(loaded.heights.transpose());
    std::swap(loaded.size_x, loaded.size_y);
  }
  scale_sizes(file, options, loaded);
  surface.grid.nx = loaded.rows.value_or(loaded.heights.rows());
  surface.grid.ny = loaded.heights.cols();
  if (loaded.is_profile) {
    complete_profile(file, options, loaded, surface.grid);
  } else {
    const auto given_x = given_size(options, 0, surface.grid.nx),
               given_y = given_size(options, 1, surface.grid.ny);
    surface.grid.lx = size_along(file, "size_x", given_x, loaded.size_x, options.warnings);
    surface.grid.ly = size_along(file, "size_y", given_y, loaded.size_y, options.warnings);
    if (options.warnings && given_x && given_y && !loaded.size_x && !options.pixel_size)
      if (const auto warning = warning_of_axes(surface.grid))
        options.warnings->push_back(file.string() + ": " + *warning);
  }
  surface.heights = std::move(loaded.heights);
  const std::string unit = read.names_unit ? loaded.unit : options.height_unit;
  if (!unit.empty() && unit != "m") {
    read.metres_per_unit = metres_per(file, unit);
    surface.heights *= read.metres_per_unit;
  }
  // Quick test before the slow search: the sum of 0 · height is 0 unless a height is infinite or
  // undefined.
  const Field& heights = surface.heights;
  const double zero = parallel::sum_blocks(heights.rows(), [&](Index begin, Index end) {
    return (0. * heights.middleRows(begin, end - begin)).sum();
  });
  if (zero != 0 && heights.isInf().any())
    refuse(file, "holds an infinite height; mark undefined points as nan");
  surface.periodic = options.periodic.value_or(loaded.periodic.value_or(false));
  surface.origin = file.string();
  if (options.warnings) {
    for (const std::string& warning : loaded.warnings)
      options.warnings->push_back(file.string() + ": " + printable_line(warning));
  }
  return read;
}

}  // namespace detail

namespace {

/// Distributes the rows of a surface from the first process to all processes.
Surface spread(const Surface& surface, const Communicator& communicator) {
  std::string origin = surface.origin;
  struct {
    Grid2D grid;
    std::size_t length;
    bool periodic;
  } head{surface.grid, origin.size(), surface.periodic};
  communicator.broadcast(&head, sizeof head);
  origin.resize(head.length);
  communicator.broadcast(origin.data(), origin.size());
  Surface rows{head.grid, {}, head.periodic, origin, communicator};
  rows.heights = scattered(rows.partition(), head.grid.ny, surface.heights);
  return rows;
}

/// Replaces `lines` in all processes by those of the first process.
void share(std::vector<std::string>& lines, const Communicator& communicator) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  std::istringstream of_root(communicator.gather_all(text).front());
  lines.clear();
  for (std::string line; std::getline(of_root, line);) lines.push_back(line);
}

/// Adds warnings about suspicious heights and sizes of a surface. The surface may be distributed
/// over processes.
void warn_of_heights(const std::filesystem::path& file, const detail::ReadSurface& read,
                     const ReadOptions& options) {
  if (options.warnings == nullptr) return;
  const auto warning = [&](const std::string& text) {
    options.warnings->push_back(file.string() + ": " + text);
  };
  const Grid2D& grid = read.surface.grid;
  const double longest = std::max(grid.lx, grid.ly);
  if (longest > 1)
    warning(fmt::format("is {} long{}", format_quantity(longest, Dimension::length),
                        read.names_lateral_unit
                            ? ", more than instruments measure; check the unit of its size"
                            : ", its coordinates being in metres; see `lateral_unit`"));
  if (const auto slope = warning_of_heights(read.surface, read.metres_per_unit))
    warning(*slope + (read.names_unit ? "" : "; see `height_unit`"));
}

std::string points_text(Index points) {
  return points == 1 ? "1 point" : std::to_string(points) + " points";
}

/// Those spikes that a flat body would touch before the rest of the surface: they exceed their
/// neighbours by more than three standard deviations of the heights, estimated from the range that
/// contains 98 % of the heights.
std::vector<Spike> first_contacts(const Surface& surface, std::vector<Spike> spikes) {
  if (spikes.empty()) return spikes;
  std::vector<double> heights;
  for (const double height : surface.heights.reshaped<Eigen::RowMajor>())
    if (!std::isnan(height)) heights.push_back(height);
  const auto quantile = [&](double share) {
    const auto at = heights.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
    std::ranges::nth_element(heights, at);
    return *at;
  };
  constexpr double three_deviations = 3 / 4.65;
  const double least = three_deviations * (quantile(0.99) - quantile(0.01));
  std::erase_if(spikes, [&](const Spike& spike) { return !(spike.height > least); });
  return spikes;
}

/// A warning about spikes. removed: whether they were removed; otherwise the warning says what they
/// would do.
std::string spikes_text(const std::vector<Spike>& spikes, bool removed) {
  Index above = 0;
  double highest = 0;
  for (const Spike& spike : spikes) {
    above += spike.height > 0;
    highest = std::max(highest, removed ? std::abs(spike.height) : spike.height);
  }
  const std::string height = format_quantity(highest, Dimension::length, 3);
  const auto count = static_cast<Index>(spikes.size());
  if (removed)
    return fmt::format("{} far from {} neighbours, up to {}, {} now undefined", points_text(count),
                       count == 1 ? "its" : "their", height, count == 1 ? "is" : "are");
  if (above == 0) return "";
  return fmt::format(
      "{} isolated, up to {} above {} neighbours, and would touch first; `despike` removes {}",
      points_text(above) + (above == 1 ? " is" : " are"), height, above == 1 ? "its" : "their",
      above == 1 ? "it" : "them");
}

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

/// Position of the lower left corner of a cropped part in the whole surface, m.
struct Corner {
  double x = 0, y = 0;
};

/// Throws InvalidInput that says where the undefined points are and how the user can treat them.
/// corner: that of the surface in the file, if it was cropped.
[[noreturn]] void refuse_holes(const std::filesystem::path& file, const Surface& surface,
                               const Corner& corner, const Holes& holes) {
  std::string advice = "`fill` fills in the smoothest surface";
  const Grid2D& grid = surface.grid;
  if (const auto part = max_defined_part(surface)) {
    // Seven digits distinguish the cells of a side of 65536 cells.
    const auto text = [](double length) { return fmt::format("{:.7g}um", 1e6 * length); };
    const double share = (part->x1 - part->x0) * (part->y1 - part->y0) / grid.area();
    if (share >= 0.01)
      advice = fmt::format(
          "`crop` {},{},{},{} selects the largest part without undefined points, {} of the area; "
          "{}",
          text(corner.x + part->x0), text(corner.y + part->y0), text(corner.x + part->x1),
          text(corner.y + part->y1), percent(share), advice);
  }
  detail::refuse(file, fmt::format("has {} undefined {} of {} ({}), holes up to {} wide; {}",
                                   holes.points, holes.points == 1 ? "point" : "points",
                                   grid.points(), percent(holes.fraction),
                                   format_quantity(holes.width, Dimension::length, 3), advice));
}

/// Applies the options (spikes, crop, fill and so on) to a surface that one process holds as a
/// whole.
Surface prepared(const std::filesystem::path& file, Surface surface, const ReadOptions& options) {
  const auto warning = [&](const std::string& text) {
    if (options.warnings && !text.empty()) options.warnings->push_back(file.string() + ": " + text);
  };
  // On a smaller surface the scatter between neighbours cannot be estimated.
  constexpr Index min_points = 8;
  if (options.despike) {
    const std::vector<Spike> spikes = find_spikes(surface, *options.despike);
    remove_spikes(surface, spikes);
    if (!spikes.empty()) warning(spikes_text(spikes, true));
  } else if (options.warnings && !surface.periodic &&
             std::min(surface.grid.nx, surface.grid.ny) >= min_points) {
    warning(spikes_text(first_contacts(surface, find_spikes(surface)), false));
  }
  Corner corner;
  if (options.crop) {
    const Grid2D& grid = surface.grid;
    corner = {std::round(options.crop->x0 / grid.dx()) * grid.dx(),
              std::round(options.crop->y0 / grid.dy()) * grid.dy()};
    surface = cropped(surface, *options.crop);
  }
  if (options.undefined == Undefined::keep) return surface;
  const Holes holes = holes_of(surface);
  if (holes.points == 0) return surface;
  if (options.undefined == Undefined::fill_few && !holes.few())
    refuse_holes(file, surface, corner, holes);
  warning(fmt::format("{} of {} ({}) had no height; the smoothest surface was filled in",
                      points_text(holes.points), surface.grid.points(), percent(holes.fraction)));
  return filled(std::move(surface));
}

Surface read_whole(const std::filesystem::path& file, const ReadOptions& options) {
  detail::ReadSurface read = detail::completed(file, load(file, options), options);
  warn_of_heights(file, read, options);
  if (options.warnings)
    for (const std::string& what :
         warnings_of_values(read.surface.heights,
                            read.names_unit ? std::nullopt : std::optional(read.metres_per_unit)))
      options.warnings->push_back(file.string() + ": " + what);
  return prepared(file, std::move(read.surface), options);
}

}  // namespace

void set_surface_importer(SurfaceImporter importer) { surface_importer = importer; }

Surface read_surface(const std::filesystem::path& file, const ReadOptions& options,
                     const Communicator& communicator) {
  if (communicator.alone()) return read_whole(file, options);
  const bool changed = options.transpose || options.despike || options.crop;
  bool by_rows = false;
  collectively(communicator,
               [&] { by_rows = communicator.is_root() && !changed && detail::is_hdf5(file); });
  communicator.broadcast(&by_rows, sizeof by_rows);
  if (by_rows) {
    const std::size_t before = options.warnings ? options.warnings->size() : 0;
    // Each process reads its own rows.
    require_one_file(file, communicator);
    detail::ReadSurface rows;
    collectively(communicator, [&] {
      rows =
          detail::completed(file, detail::read_hdf5(file, options.channel, communicator), options);
    });
    rows.surface.communicator = communicator;
    const bool complete = options.undefined == Undefined::keep ||
                          communicator.all_agree(rows.surface.undefined_points() == 0);
    if (complete) {
      warn_of_heights(file, rows, options);
      return std::move(rows.surface);
    }
    if (options.warnings) options.warnings->resize(before);
  }
  Surface surface;
  collectively(communicator, [&] {
    if (communicator.is_root()) surface = read_whole(file, options);
  });
  if (options.warnings) share(*options.warnings, communicator);
  return spread(surface, communicator);
}

}  // namespace salebra
