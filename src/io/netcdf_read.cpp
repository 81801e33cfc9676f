// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of classic NetCDF surfaces (CDF-1, 2 and 5) as SurfaceTopography writes them.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "loaded_surface.hpp"
#include "netcdf_tags.hpp"
#include "stored_number.hpp"

/// The classic NetCDF formats, CDF-1, 2 and 5 (Unidata, "NetCDF Classic Format Specification"): a
/// header of big-endian integers and padded names, then the data of each variable from a stated
/// offset on.
namespace salebra::detail {
namespace {

constexpr std::uint32_t absent = 0, text_kind = 2;

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

}  // namespace salebra::detail
