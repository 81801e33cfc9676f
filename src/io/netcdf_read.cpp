// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of classic NetCDF surfaces (CDF-1, 2 and 5) as SurfaceTopography writes them.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "loaded_surface.hpp"
#include "netcdf_tags.hpp"

/// The classic NetCDF formats, CDF-1, 2 and 5 (Unidata, "NetCDF Classic Format Specification"): a
/// header of big-endian integers and padded names, then the data of each variable from a stated
/// offset on.
namespace salebra::detail {
namespace {

constexpr std::uint32_t absent = 0, text_kind = 2;

/// Bytes of one value of a type, by its number in the format; 0 for a number that is no type.
std::size_t size_of(std::uint32_t kind) {
  constexpr std::array<std::size_t, 12> sizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return kind < sizes.size() ? sizes[kind] : 0;
}

template <class Stored>
double big_endian(const char* bytes) {
  std::array<char, sizeof(Stored)> buffer;
  std::memcpy(buffer.data(), bytes, sizeof(Stored));
  if constexpr (std::endian::native == std::endian::little)
    for (std::size_t i = 0; i < sizeof(Stored) / 2; ++i)
      std::swap(buffer[i], buffer[sizeof(Stored) - 1 - i]);
  return static_cast<double>(std::bit_cast<Stored>(buffer));
}

double value_at(const char* bytes, std::uint32_t kind) {
  switch (kind) {
    case 1:
      return big_endian<std::int8_t>(bytes);
    case 3:
      return big_endian<std::int16_t>(bytes);
    case 4:
      return big_endian<std::int32_t>(bytes);
    case 5:
      return big_endian<float>(bytes);
    case 6:
      return big_endian<double>(bytes);
    case 7:
      return big_endian<std::uint8_t>(bytes);
    case 8:
      return big_endian<std::uint16_t>(bytes);
    case 9:
      return big_endian<std::uint32_t>(bytes);
    case 10:
      return big_endian<std::int64_t>(bytes);
    case 11:
      return big_endian<std::uint64_t>(bytes);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
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
    return static_cast<std::uint32_t>(big_endian<std::uint32_t>(take(4).data()));
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
      const std::size_t size = size_of(kind);
      if (size == 0) broken();
      const std::uint64_t values = bounded(count(), size);
      const std::string_view bytes = padded(values * size);
      Attribute attribute;
      if (kind == text_kind)
        attribute.words = bytes.substr(0, bytes.find('\0'));
      else if (values > 0)
        attribute.number = value_at(bytes.data(), kind);
      result[key] = std::move(attribute);
    });
    return result;
  }

  const std::filesystem::path& file_;
  std::string_view content_;
  bool wide_, long_offsets_;
  std::size_t at_ = 0;
};

/// Where the values of a two-dimensional variable lie, once it is known that the file holds them
/// all.
std::string_view values_of(const std::filesystem::path& file, std::string_view content,
                           const Header& header, const Variable& variable) {
  const std::size_t size = size_of(variable.kind);
  std::uint64_t bytes = size;
  for (const std::uint64_t axis : variable.axes)
    if (__builtin_mul_overflow(bytes, header.axes[axis].length, &bytes)) bytes = UINT64_MAX;
  if (size == 0 || bytes == 0 || variable.begin > content.size() ||
      bytes > content.size() - variable.begin)
    refuse(file, "declares more heights than it holds, or none; it is truncated or damaged");
  return content.substr(variable.begin, bytes);
}

/// SurfaceTopography writes "A" for Ångström.
std::string unit_of(const Variable& variable) {
  const std::string unit =
      variable.words("unit").empty() ? variable.words("units") : variable.words("unit");
  return unit == "A" ? "angstrom" : unit;
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
  const std::string_view bytes = values_of(file, content, header, heights);
  const std::size_t size = size_of(heights.kind);
  const bool transposed = header.axes[heights.axes[0]].name == "y";
  const auto rows = static_cast<Index>(header.axes[heights.axes[0]].length);
  const auto columns = static_cast<Index>(header.axes[heights.axes[1]].length);

  LoadedSurface surface;
  surface.unit = unit_of(heights);
  Field stored = heights_of(file, rows, columns);
  for (Index k = 0; k < stored.size(); ++k)
    stored.data()[k] = value_at(bytes.data() + static_cast<std::size_t>(k) * size, heights.kind);
  if (const auto fill = heights.number("_FillValue"))
    stored = (stored == *fill).select(std::numeric_limits<double>::quiet_NaN(), stored);
  if (const auto mask = header.named.find("mask");
      mask != header.named.end() && mask->second.axes == heights.axes) {
    const std::string_view flags = values_of(file, content, header, mask->second);
    const std::size_t step = size_of(mask->second.kind);
    for (Index k = 0; k < stored.size(); ++k)
      if (value_at(flags.data() + static_cast<std::size_t>(k) * step, mask->second.kind) != 0)
        stored.data()[k] = std::numeric_limits<double>::quiet_NaN();
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

}  // namespace salebra::detail
