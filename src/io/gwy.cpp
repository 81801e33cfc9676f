// SPDX-License-Identifier: GPL-3.0-or-later
// Reader and writer of Gwyddion's own format (.gwy).
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <salebra/base/error.hpp>

#include "atomic_file.hpp"
#include "loaded_surface.hpp"
#include "surface_format.hpp"
#include "surface_writers.hpp"

/// "GWYP", then one object: its type as text, its size, its components. A component is a name, a
/// letter for its type, and a value: b (1 byte), c (1), i (4), q (8), d (double), s (text), o (an
/// object). A capital letter denotes an array, which begins with its number of items. Texts end
/// with NUL, numbers are little-endian, sizes have four bytes. Channel N of a file is the object
/// /N/data, and /N/mask marks its points. Source: "Gwyddion file formats", part "GWY", of
/// Gwyddion's user guide.
namespace salebra::detail {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view gwy_magic = "GWYP";

template <class T>
T number_at(std::string_view bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// Takes bytes from the front of a content. Whatever sizes a file declares, nothing beyond the end
/// of the content is read.
class Bytes {
 public:
  Bytes(const std::filesystem::path& file, std::string_view rest) : file_(file), rest_(rest) {}

  bool empty() const { return rest_.empty(); }
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size())
      refuse(file_, "declares more bytes than it holds; it is truncated or damaged");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  template <class T>
  T number() {
    return number_at<T>(take(sizeof(T)));
  }
  std::string_view text() {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos) refuse(file_, "has a text that does not end; it is damaged");
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return found;
  }
  /// Takes an object: its type and the bytes of its components.
  std::pair<std::string_view, std::string_view> object() {
    const std::string_view type = text();
    return {type, take(number<std::uint32_t>())};
  }

 private:
  const std::filesystem::path& file_;
  std::string_view rest_;
};

struct Component {
  char type = 0;
  std::string_view value;  ///< of an array: only its items; of an object: its type too
};

using Components = std::map<std::string_view, Component>;

std::string_view value_of(const std::filesystem::path& file, char type, Bytes& bytes) {
  constexpr std::string_view letters = "bciqd";
  constexpr std::array<std::uint64_t, 5> sizes{1, 1, 4, 8, 8};
  if (const auto index = letters.find(type); index != letters.npos) return bytes.take(sizes[index]);
  if (type == 's') return bytes.text();
  const auto whole_object = [&bytes] {
    const auto [name, content] = Bytes(bytes).object();
    return bytes.take(name.size() + 1 + sizeof(std::uint32_t) + content.size());
  };
  if (type == 'o') return whole_object();
  constexpr std::string_view arrays = "CIQDSO";
  if (arrays.find(type) == arrays.npos)
    refuse(file, "has a component of an unknown type; it is damaged");
  const std::uint64_t items = bytes.number<std::uint32_t>();
  if (const auto index = arrays.find(type); index < sizes.size() - 1)
    return bytes.take(items * sizes[index + 1]);
  // Arrays of texts and of objects are skipped, since no reader needs them.
  for (std::uint64_t item = 0; item < items; ++item) {
    if (type == 'S')
      bytes.text();
    else
      whole_object();
  }
  return {};
}

/// The components of an object by their names. Nested objects stay unparsed until they are
/// requested, so deep nesting does no harm.
Components components_of(const std::filesystem::path& file, std::string_view content) {
  Components all;
  Bytes bytes(file, content);
  while (!bytes.empty()) {
    const std::string_view name = bytes.text();
    const char type = bytes.number<char>();
    all[name] = {type, value_of(file, type, bytes)};
  }
  return all;
}

/// The components of the object that `within` contains under this name, if it is of this type;
/// otherwise nothing.
std::optional<Components> object_in(const std::filesystem::path& file, const Components& within,
                                    std::string_view name, std::string_view type) {
  const auto found = within.find(name);
  if (found == within.end() || found->second.type != 'o') return {};
  const auto [kind, content] = Bytes(file, found->second.value).object();
  if (kind != type) return {};
  return components_of(file, content);
}

std::string unit_in(const std::filesystem::path& file, const Components& field,
                    std::string_view name) {
  const auto unit = object_in(file, field, name, "GwySIUnit");
  if (!unit) return "";
  const auto text = unit->find("unitstr");
  return text == unit->end() || text->second.type != 's' ? "" : std::string(text->second.value);
}

template <class T>
T number_in(const std::filesystem::path& file, const Components& field, std::string_view name,
            char type) {
  const auto found = field.find(name);
  if (found == field.end() || found->second.type != type)
    refuse(file, "has a channel without " + std::string(name) + "; it is damaged");
  return number_at<T>(found->second.value);
}

/// The bytes of the heights of a data field. Throws unless there is one value per point.
std::string_view values_of(const std::filesystem::path& file, const Components& field) {
  const auto nx = number_in<std::int32_t>(file, field, "xres", 'i'),
             ny = number_in<std::int32_t>(file, field, "yres", 'i');
  const auto data = field.find("data");
  if (nx < 1 || ny < 1 || data == field.end() || data->second.type != 'D' ||
      data->second.value.size() / sizeof(double) !=
          static_cast<std::uint64_t>(nx) * static_cast<std::uint64_t>(ny))
    refuse(file, "declares " + std::to_string(nx) + " x " + std::to_string(ny) +
                     " points in a channel that holds a different number; it is damaged");
  return data->second.value;
}

/// The number N in the name "/N/data" of a component; nothing for other names.
std::optional<std::uint32_t> channel_of(std::string_view name) {
  constexpr std::string_view end = "/data";
  if (!name.starts_with('/') || !name.ends_with(end) || name.size() <= end.size() + 1) return {};
  const std::string_view digits = name.substr(1, name.size() - end.size() - 1);
  std::uint32_t channel = 0;
  const auto [last, status] =
      std::from_chars(digits.data(), digits.data() + digits.size(), channel);
  if (status != std::errc{} || last != digits.data() + digits.size()) return {};
  return channel;
}

// The following functions return the bytes of components, from which the writer composes a file.
std::string text_bytes(std::string_view text) { return std::string(text) + '\0'; }

template <class T>
std::string number_bytes(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
std::string component(std::string_view name, char type, T value) {
  return text_bytes(name) + type + number_bytes(value);
}

std::string text_component(std::string_view name, std::string_view text) {
  // A NUL would end the text early, so the text is cut there.
  return text_bytes(name) + 's' + text_bytes(text.substr(0, text.find('\0')));
}

std::string object_component(std::string_view name, std::string_view type,
                             const std::string& components) {
  return text_bytes(name) + 'o' + text_bytes(type) +
         number_bytes(static_cast<std::uint32_t>(components.size())) + components;
}

/// The bytes of a data field that come before its values.
std::string field_head(std::string_view name, const Grid2D& grid, std::string_view unit) {
  const std::string facts =
      component("xres", 'i', static_cast<std::int32_t>(grid.nx)) +
      component("yres", 'i', static_cast<std::int32_t>(grid.ny)) +
      component("xreal", 'd', grid.lx) + component("yreal", 'd', grid.ly) +
      object_component("si_unit_xy", "GwySIUnit", text_component("unitstr", "m")) +
      object_component("si_unit_z", "GwySIUnit", text_component("unitstr", unit)) +
      component("data", 'D', static_cast<std::uint32_t>(grid.points()));
  const auto bytes = facts.size() + static_cast<std::size_t>(grid.points()) * sizeof(double);
  return text_bytes(name) + 'o' + text_bytes("GwyDataField") +
         number_bytes(static_cast<std::uint32_t>(bytes)) + facts;
}

}  // namespace

LoadedSurface read_gwy(const std::filesystem::path& file, std::string_view content,
                       const std::string& channel) {
  const auto [kind, whole] = Bytes(file, content.substr(gwy_magic.size())).object();
  if (kind != "GwyContainer")
    refuse(file, "does not contain a GwyContainer; is it a file of Gwyddion 2?");
  const Components container = components_of(file, whole);
  std::map<std::uint32_t, Components> fields;
  for (const auto& [name, value] : container)
    if (const auto number = channel_of(name))
      if (auto field = object_in(file, container, name, "GwyDataField"))
        fields[*number] = std::move(*field);
  if (fields.empty()) refuse(file, "does not contain a channel; export one from Gwyddion");
  std::vector<Channel> channels;
  for (const auto& [number, field] : fields) {
    const auto title = container.find("/" + std::to_string(number) + "/data/title");
    const bool is_named = title != container.end() && title->second.type == 's';
    channels.push_back({std::to_string(number), is_named ? std::string(title->second.value) : "",
                        unit_in(file, field, "si_unit_z")});
  }
  LoadedSurface surface;
  const auto chosen = chosen_channel(file, channels, channel, surface);
  const auto& [number, field] = *std::next(fields.begin(), static_cast<std::ptrdiff_t>(chosen));
  surface.unit = channels[chosen].unit;
  const std::string_view values = values_of(file, field);
  const auto nx = number_in<std::int32_t>(file, field, "xres", 'i'),
             ny = number_in<std::int32_t>(file, field, "yres", 'i');
  const std::string plane_unit = unit_in(file, field, "si_unit_xy");
  const double metres = plane_unit.empty() ? 1 : metres_per(file, plane_unit);
  surface.lateral_unit_open = plane_unit.empty();
  surface.size_x = metres * number_in<double>(file, field, "xreal", 'd');
  surface.size_y = metres * number_in<double>(file, field, "yreal", 'd');
  const auto mask =
      object_in(file, container, "/" + std::to_string(number) + "/mask", "GwyDataField");
  std::string_view marks;
  if (mask) {
    marks = values_of(file, *mask);
    if (number_in<std::int32_t>(file, *mask, "xres", 'i') != nx || marks.size() != values.size())
      refuse(file, "has a mask whose size differs from its channel; it is damaged");
  }
  surface.heights = heights_of(file, nx, ny);
  for (Index iy = 0; iy < ny; ++iy) {
    for (Index ix = 0; ix < nx; ++ix) {
      const auto index = static_cast<std::size_t>(iy * nx + ix) * sizeof(double);
      const bool undefined = mask && number_at<double>(marks.substr(index)) > 0;
      surface.heights(ix, iy) = undefined ? std::numeric_limits<double>::quiet_NaN()
                                          : number_at<double>(values.substr(index));
    }
  }
  return surface;
}

void write_gwy(const std::filesystem::path& file, const Surface& surface,
               const Provenance& provenance, const WriteOptions& options) {
  const Grid2D& grid = surface.grid;
  const Index undefined = surface.undefined_points();
  const std::string start =
      text_component("/0/data/title", "heights") +
      object_component("/0/meta", "GwyContainer",
                       text_component("salebra", description_of(surface, provenance).dump()));
  const std::string heights = field_head("/0/data", grid, "m"),
                    mask = undefined > 0 ? field_head("/0/mask", grid, "") : "";
  const std::uint64_t values = static_cast<std::uint64_t>(grid.points()) * sizeof(double),
                      bytes = start.size() + heights.size() + values +
                              (mask.empty() ? 0 : mask.size() + values);
  if (bytes > std::numeric_limits<std::uint32_t>::max())
    throw InvalidInput(file.string(), "would be larger than 4 GiB, the limit of .gwy; write .h5");
  // Gwyddion computes with every value of a channel, masked or not, so undefined points get the
  // mean height.
  double sum = 0;
  for (const double height : surface.heights.reshaped()) sum += std::isnan(height) ? 0 : height;
  const Index defined = grid.points() - undefined;
  const double filling = defined > 0 ? sum / static_cast<double>(defined) : 0;

  AtomicFile output(file, options);
  output.write(std::string(gwy_magic) + text_bytes("GwyContainer") +
               number_bytes(static_cast<std::uint32_t>(bytes)) + start);
  const auto write_field = [&](const std::string& head, const auto& value) {
    std::string row = head;
    for (Index iy = 0; iy < grid.ny; ++iy) {
      for (Index ix = 0; ix < grid.nx; ++ix) row += number_bytes(value(surface.heights(ix, iy)));
      output.write(row);
      row.clear();
    }
  };
  write_field(heights, [&](double height) { return std::isnan(height) ? filling : height; });
  if (!mask.empty())
    write_field(mask, [](double height) { return std::isnan(height) ? 1.0 : 0.0; });
  output.commit();
}

}  // namespace salebra::detail
