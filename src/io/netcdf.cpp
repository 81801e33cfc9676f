// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of classic NetCDF surfaces (CDF-1, 2 and 5) and their writer (CDF-2), as SurfaceTopography
// has them.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <salebra/base/error.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "atomic_file.hpp"
#include "loaded_surface.hpp"
#include "stored_number.hpp"
#include "surface_writers.hpp"

/// The classic NetCDF formats, CDF-1, 2 and 5 (Unidata, "NetCDF Classic Format Specification"): a
/// header of big-endian integers and padded names, then the data of each variable from a stated
/// offset on.
namespace salebra::detail {
namespace {

constexpr std::uint32_t absent = 0, dimension_tag = 10, variable_tag = 11, attribute_tag = 12;
constexpr std::uint32_t int8 = 1, text_kind = 2, int32 = 4, float64 = 6;  // types

/// A type by its number in the format; nullptr for texts, and for a number that is no type.
const StoredType* type_of(std::uint32_t kind) {
  constexpr std::array<std::string_view, 12> names{"",   "i1", "",   "i2", "i4", "f4",
                                                   "f8", "u1", "u2", "u4", "i8", "u8"};
  return kind < names.size() ? stored_type(names[kind]) : nullptr;
}

double big_endian(const char* bytes, const StoredType& type) {
  return type.read(bytes, std::endian::big);
}

struct Attribute {
  std::string words;                                         ///< of a text attribute
  double number = std::numeric_limits<double>::quiet_NaN();  ///< the first value of any other
};

struct Variable {
  std::vector<std::uint64_t> axes;  ///< numbers of its dimensions
  std::map<std::string, Attribute> notes;
  std::uint32_t kind = 0;
  std::uint64_t begin = 0;

  std::string words(const std::string& name) const {
    const auto found = notes.find(name);
    return found == notes.end() ? std::string() : found->second.words;
  }
  std::optional<double> number(const std::string& name) const {
    const auto found = notes.find(name);
    if (found == notes.end() || std::isnan(found->second.number)) return {};
    return found->second.number;
  }
};

struct Axis {
  std::string name;
  std::uint64_t length = 0;
};

class Header {
 public:
  Header(const std::filesystem::path& file, std::string_view content)
      : file_(file), content_(content), wide_(content[3] == 5), long_offsets_(content[3] != 1) {
    at_ = 4;
    count();  // of records, which surfaces have none of
    list(dimension_tag, [&] {
      std::string key = name();
      axes.push_back({std::move(key), count()});
    });
    notes();
    list(variable_tag, [&] {
      const std::string key = name();
      Variable variable;
      variable.axes.resize(bounded(count(), wide_ ? 8 : 4));
      for (std::uint64_t& axis : variable.axes) {
        axis = count();
        if (axis >= axes.size()) broken();
      }
      variable.notes = notes();
      variable.kind = word();
      count();  // its size, which follows from its dimensions
      variable.begin = long_offsets_ ? long_word() : word();
      named[key] = std::move(variable);
    });
  }

  std::vector<Axis> axes;
  std::map<std::string, Variable> named;

 private:
  [[noreturn]] void broken() const {
    refuse(file_, "has a truncated or damaged NetCDF header; copy or save the file again");
  }
  std::string_view take(std::uint64_t bytes) {
    if (bytes > content_.size() - at_) broken();
    const std::string_view taken = content_.substr(at_, bytes);
    at_ += bytes;
    return taken;
  }
  std::uint32_t word() {
    return static_cast<std::uint32_t>(
        stored_number<std::uint32_t>(take(4).data(), std::endian::big));
  }
  std::uint64_t long_word() {
    const std::uint64_t high = word();
    return high << 32 | word();
  }
  std::uint64_t count() { return wide_ ? long_word() : word(); }
  /// A number of entries of so many bytes each, which must fit into the rest of the file.
  std::uint64_t bounded(std::uint64_t entries, std::size_t bytes) const {
    if (entries > (content_.size() - at_) / bytes) broken();
    return entries;
  }
  std::string_view padded(std::uint64_t bytes) {
    const std::string_view taken = take(bytes);
    take((4 - bytes % 4) % 4);
    return taken;
  }
  std::string name() { return std::string(padded(count())); }

  template <class Entry>
  void list(std::uint32_t expected, const Entry& entry) {
    const std::uint32_t tag = word();
    const std::uint64_t entries = count();
    if (tag == absent && entries == 0) return;
    if (tag != expected) broken();
    for (std::uint64_t i = 0; i < entries; ++i) entry();
  }

  std::map<std::string, Attribute> notes() {
    std::map<std::string, Attribute> result;
    list(attribute_tag, [&] {
      const std::string key = name();
      const std::uint32_t kind = word();
      const StoredType* type = type_of(kind);
      if (!type && kind != text_kind) broken();
      const std::size_t size = type ? type->bytes() : 1;
      const std::uint64_t values = bounded(count(), size);
      const std::string_view bytes = padded(values * size);
      Attribute attribute;
      if (kind == text_kind)
        attribute.words = bytes.substr(0, bytes.find('\0'));
      else if (values > 0)
        attribute.number = big_endian(bytes.data(), *type);
      result[key] = std::move(attribute);
    });
    return result;
  }

  const std::filesystem::path& file_;
  std::string_view content_;
  bool wide_, long_offsets_;
  std::size_t at_ = 0;
};

/// The values of a two-dimensional variable, all of which the file holds.
struct Values {
  std::string_view bytes;
  const StoredType* type;

  double operator[](Index k) const {
    return big_endian(bytes.data() + static_cast<std::size_t>(k) * type->bytes(), *type);
  }
};

Values values_of(const std::filesystem::path& file, std::string_view content, const Header& header,
                 const Variable& variable) {
  const StoredType* type = type_of(variable.kind);
  std::uint64_t bytes = type ? type->bytes() : 0;
  for (const std::uint64_t axis : variable.axes)
    if (__builtin_mul_overflow(bytes, header.axes[axis].length, &bytes)) bytes = UINT64_MAX;
  if (bytes == 0 || variable.begin > content.size() || bytes > content.size() - variable.begin)
    refuse(file, "declares more heights than it holds, or none; it is truncated or damaged");
  return {content.substr(variable.begin, bytes), type};
}

/// SurfaceTopography writes "A" for Ångström.
std::string unit_of(const Variable& variable) {
  const std::string unit =
      variable.words("unit").empty() ? variable.words("units") : variable.words("unit");
  return unit == "A" ? "angstrom" : unit;
}

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
    word(text_kind);
    name(value);
  }
  void note(std::string_view key, double value) {
    name(key);
    word(float64);
    word(1);
    append(bytes_, value);
  }
  void note(std::string_view key, std::int32_t value) {
    name(key);
    word(int32);
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

LoadedSurface read_netcdf(const std::filesystem::path& file, std::string_view content) {
  const Header header(file, content);
  const auto found = header.named.find("heights");
  if (found == header.named.end())
    refuse(file, "has no variable heights(x, y); it is no surface in SurfaceTopography's layout");
  const Variable& heights = found->second;
  if (heights.axes.size() != 2)
    refuse(file, "has heights that are not two-dimensional; line scans are no surfaces");
  const Values values = values_of(file, content, header, heights);
  const bool transposed = header.axes[heights.axes[0]].name == "y";
  const auto rows = static_cast<Index>(header.axes[heights.axes[0]].length);
  const auto columns = static_cast<Index>(header.axes[heights.axes[1]].length);

  LoadedSurface surface;
  surface.unit = unit_of(heights);
  Field stored = heights_of(file, rows, columns);
  for (Index k = 0; k < stored.size(); ++k) stored.data()[k] = values[k];
  if (const auto fill = heights.number("_FillValue"))
    stored = (stored == *fill).select(std::numeric_limits<double>::quiet_NaN(), stored);
  if (const auto mask = header.named.find("mask");
      mask != header.named.end() && mask->second.axes == heights.axes) {
    const Values flags = values_of(file, content, header, mask->second);
    for (Index k = 0; k < stored.size(); ++k)
      if (flags[k] != 0) stored.data()[k] = std::numeric_limits<double>::quiet_NaN();
  }
  surface.heights = transposed ? Field(stored.transpose()) : std::move(stored);

  bool periodic = true, stated = false;
  for (const auto& [name, size_along] :
       {std::pair("x", &surface.size_x), std::pair("y", &surface.size_y)}) {
    const auto axis = header.named.find(name);
    if (axis == header.named.end()) continue;
    if (const auto length = axis->second.number("length")) {
      const std::string unit = unit_of(axis->second);
      *size_along = *length * (unit.empty() ? 1 : metres_per(file, unit));
    }
    if (const auto flag = axis->second.number("periodic")) {
      stated = true;
      periodic = periodic && *flag != 0;
    }
  }
  if (stated) surface.periodic = periodic;
  return surface;
}

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
