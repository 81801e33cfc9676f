// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a surface from main.xml and the binary members of an X3P file.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <pugixml.hpp>
#include <utility>

#include "stored_number.hpp"
#include "surface_importer.hpp"
#include "x3p.hpp"

namespace salebra::detail {
namespace {

std::string_view text_of(const pugi::xml_node& node) {
  std::string_view text = node.text().get();
  const auto is_space = [](char symbol) {
    return symbol == ' ' || symbol == '\t' || symbol == '\n' || symbol == '\r';
  };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// main.xml: gives access to its entries by their paths below the root, and names the file in
/// messages.
class Description {
 public:
  Description(const std::filesystem::path& file, const std::string& xml) : file_(file) {
    const pugi::xml_parse_result result = document_.load_buffer(xml.data(), xml.size());
    if (!result)
      refuse(file, std::string("has a main.xml that is not XML (") + result.description() +
                       "); it is damaged");
    root_ = document_.document_element();
    if (!std::string_view(root_.name()).ends_with("ISO5436_2"))
      refuse_unknown(
          file,
          "has a main.xml that does not describe a surface of ISO 25178-72; name an X3P file");
  }

  bool has(const char* path) const { return !root_.first_element_by_path(path).empty(); }
  std::string_view words(const char* path) const {
    return text_of(root_.first_element_by_path(path));
  }
  std::string_view required(const char* path) const {
    const std::string_view text = words(path);
    if (text.empty()) refuse(file_, std::string("lacks ") + path + " in its main.xml");
    return text;
  }
  double number(const char* path) const {
    double value = 0;
    parse(path, required(path), value);
    if (!std::isfinite(value)) wrong(path);
    return value;
  }
  double number(const char* path, double otherwise) const {
    return words(path).empty() ? otherwise : number(path);
  }
  Index count(const char* path) const {
    Index value = 0;
    parse(path, required(path), value);
    if (value < 1) wrong(path);
    return value;
  }
  /// Throws InvalidInput for entries and attributes below `path` that are not in `known`, such as a
  /// unit, since the reader would ignore them.
  void require_nothing_but(const char* path, std::initializer_list<std::string_view> known) const {
    for (const pugi::xml_node& entry : root_.first_element_by_path(path).children()) {
      if (entry.type() != pugi::node_element) continue;
      const std::string name = entry.name();
      const bool is_known = std::ranges::find(known, name) != known.end();
      if (!is_known || entry.first_attribute())
        refuse(file_, std::string("has ") + (*path ? std::string(path) + "/" : "") + name +
                          (is_known ? std::string("/@") + entry.first_attribute().name() : "") +
                          " in its main.xml, which salebra does not apply; remove it if it does "
                          "not affect the heights");
    }
  }
  [[noreturn]] void wrong(const char* path) const {
    refuse(file_, std::string("has ") + path + " = '" + std::string(words(path).substr(0, 24)) +
                      "' in its main.xml, which is impossible; correct it");
  }

 private:
  template <class Number>
  void parse(const char* path, std::string_view text, Number& value) const {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) wrong(path);
  }

  const std::filesystem::path& file_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

const StoredType& height_type(const Description& description) {
  constexpr std::pair<std::string_view, std::string_view> names[]{
      {"I", "i2"}, {"L", "i4"}, {"F", "f4"}, {"D", "f8"}};
  const std::string_view name = description.required("Record1/Axes/CZ/DataType");
  for (const auto& [known, type] : names)
    if (known == name) return *stored_type(type);
  description.wrong("Record1/Axes/CZ/DataType");
}

void require_height_map(const std::filesystem::path& file, const Description& description) {
  if (description.words("Record1/FeatureType") != "SUR")
    refuse_unknown(file, "holds a feature of type '" +
                             std::string(description.words("Record1/FeatureType").substr(0, 24)) +
                             "', not a surface (SUR); profiles and point clouds are not read");
  for (const char* axis : {"Record1/Axes/CX/AxisType", "Record1/Axes/CY/AxisType"})
    if (description.required(axis) != "I")
      refuse(file, "lists its points instead of a grid (" + std::string(axis) +
                       " is not I); resample them on one");
  if (description.required("Record1/Axes/CZ/AxisType") != "A")
    description.wrong("Record1/Axes/CZ/AxisType");
  for (const char* axis : {"Record1/Axes/CX", "Record1/Axes/CY", "Record1/Axes/CZ"})
    description.require_nothing_but(axis, {"AxisType", "DataType", "Increment", "Offset"});
  description.require_nothing_but("Record1/Axes", {"CX", "CY", "CZ", "Rotation"});
  description.require_nothing_but("Record1", {"Revision", "FeatureType", "Axes"});
  description.require_nothing_but("Record3/MatrixDimension", {"SizeX", "SizeY", "SizeZ"});
  if (description.number("Record3/MatrixDimension/SizeZ", 1) != 1)
    refuse(file, "holds several layers; save one of them");
  if (!description.has("Record3/DataLink"))
    refuse(file, "holds its heights within main.xml; save it with a binary data file");
  // A rotation within the plane of the surface is accepted: it does not change the heights over the
  // axes of the file.
  if (std::abs(description.number("Record1/Axes/Rotation/r33", 1) - 1) > 1e-6)
    refuse(file, "is rotated out of its plane; level it before saving");
}

}  // namespace

LoadedSurface x3p_surface(const std::filesystem::path& file, const X3pMember& member) {
  const auto xml = member("main.xml", {});
  if (!xml) refuse_unknown(file, "is a ZIP archive without main.xml; name an X3P file");
  const Description description(file, *xml);
  require_height_map(file, description);

  const Index nx = description.count("Record3/MatrixDimension/SizeX"),
              ny = description.count("Record3/MatrixDimension/SizeY");
  const StoredType& type = height_type(description);
  std::uint64_t points = 0, bytes = 0;
  if (__builtin_mul_overflow(static_cast<std::uint64_t>(nx), static_cast<std::uint64_t>(ny),
                             &points) ||
      __builtin_mul_overflow(points, type.bytes(), &bytes))
    refuse(file, "declares more points than any memory holds; it is damaged");
  const std::string data_name(description.required("Record3/DataLink/PointDataLink"));
  const auto data = member(data_name, bytes);
  if (!data) refuse(file, "lacks its member " + data_name + " of heights; it is damaged");

  const double step_x = description.number("Record1/Axes/CX/Increment"),
               step_y = description.number("Record1/Axes/CY/Increment");
  if (step_x == 0) description.wrong("Record1/Axes/CX/Increment");
  if (step_y == 0) description.wrong("Record1/Axes/CY/Increment");
  const double step_z = description.number("Record1/Axes/CZ/Increment", 1),
               offset_z = description.number("Record1/Axes/CZ/Offset", 0);

  LoadedSurface surface;
  surface.unit = "m";
  surface.size_x = std::abs(step_x) * static_cast<double>(nx);
  surface.size_y = std::abs(step_y) * static_cast<double>(ny);
  surface.heights = heights_of(file, nx, ny);
  Index infinite = 0;
  // If the increment of an axis is negative, the file lists points against its direction. x and y
  // of the surface must grow with the indices ix and iy.
  for (Index row = 0; row < ny; ++row) {
    const Index iy = step_y > 0 ? row : ny - 1 - row;
    for (Index column = 0; column < nx; ++column) {
      const Index ix = step_x > 0 ? column : nx - 1 - column;
      const auto index = static_cast<std::size_t>(row * nx + column);
      const double stored = type.read(data->data() + type.bytes() * index, std::endian::little);
      // Some programs write infinity for an undefined point.
      infinite += std::isinf(stored);
      surface.heights(ix, iy) = std::isinf(stored) ? std::numeric_limits<double>::quiet_NaN()
                                                   : stored * step_z + offset_z;
    }
  }
  if (infinite > 0)
    surface.warnings.push_back("has " + std::to_string(infinite) +
                               (infinite == 1 ? " infinite height, treated as undefined"
                                              : " infinite heights, treated as undefined"));
  if (const std::string mask_name(description.words("Record3/DataLink/ValidPointsLink"));
      !mask_name.empty()) {
    const auto valid = member(mask_name, (points + 7) / 8);
    if (!valid) refuse(file, "lacks its member " + mask_name + " of valid points; it is damaged");
    for (Index row = 0; row < ny; ++row) {
      for (Index column = 0; column < nx; ++column) {
        const auto index = static_cast<std::size_t>(row * nx + column);
        if ((static_cast<unsigned char>((*valid)[index / 8]) >> index % 8 & 1) == 0)
          surface.heights(step_x > 0 ? column : nx - 1 - column, step_y > 0 ? row : ny - 1 - row) =
              std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  return surface;
}

}  // namespace salebra::detail
