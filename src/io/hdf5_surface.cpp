// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from an HDF5 file.
#include <algorithm>
#include <limits>
#include <set>

#include "hdf5_document.hpp"
#include "loaded_surface.hpp"
#include "surface_importer.hpp"

namespace salebra::detail {
namespace {

using namespace hdf5;

/// `heights`, or the only two-dimensional dataset at the root.
std::string heights_name(const Document& document) {
  if (document.find("heights")) return "heights";
  std::string found, refused;
  for (const auto& [name, kind] : document.group("/").members) {
    if (kind == Object::Kind::refused) refused = name;
    if (kind == Object::Kind::group || kind == Object::Kind::refused) continue;
    if (document.dataset(name).shape.size() != 2) continue;
    if (!found.empty())
      refuse_unknown(document.path(),
                     "has several two-dimensional datasets at its root and none "
                     "of them is named heights; name it so");
    found = name;
  }
  if (!found.empty()) return found;
  if (!refused.empty()) return refused;
  refuse_unknown(document.path(),
                 "has no dataset heights (nx, ny) at its root; store the surface there");
}

/// A number that an attribute of a dataset must be, where there is one.
std::optional<double> number_of(const Document& document, const Object& object,
                                const std::string& name) {
  const auto found = std::ranges::find(
      object.attributes, name, [](const auto& entry) { return std::string_view(entry.first); });
  if (found == object.attributes.end()) return {};
  if (const auto* number = std::get_if<double>(&found->second)) return *number;
  refuse(document.path(), "has an attribute " + name + " that is not one number; correct it");
}

/// Turns stored numbers into heights as the conventions for climate and forecast data (CF) have it:
/// marks of undefined points are stored numbers, and so are the limits of valid ones.
void unpack(const Document& document, const Object& object, std::span<double> values) {
  const auto number = [&](const char* name) { return number_of(document, object, name); };
  const auto fill = number("_FillValue"), missing = number("missing_value"),
             least = number("valid_min"), greatest = number("valid_max"),
             scale = number("scale_factor"), offset = number("add_offset");
  const std::set<std::string_view> used{"_FillValue",   "missing_value", "valid_min", "valid_max",
                                        "scale_factor", "add_offset",    "units"};
  for (const auto& [name, value] : object.attributes) {
    if (used.contains(name)) continue;
    std::string word = name;
    for (char& symbol : word)
      if (symbol >= 'A' && symbol <= 'Z') symbol = static_cast<char>(symbol - 'A' + 'a');
    for (const char* meaning : {"unit", "scale", "factor", "offset", "fill", "missing", "nodata",
                                "valid", "mask", "gain", "calibration"})
      if (word.find(meaning) != std::string::npos)
        refuse(document.path(), "has an attribute " + name +
                                    " of its heights, which is not used; apply it, and remove it");
  }
  if (object.attributes.end() !=
          std::ranges::find(object.attributes, "units",
                            &decltype(object.attributes)::value_type::first) &&
      !object.text("units"))
    refuse(document.path(), "has an attribute units that is no text; correct it");
  if (!fill && !missing && !least && !greatest && !scale && !offset) return;
  for (double& value : values) {
    if (value == fill || value == missing || value < least.value_or(value) ||
        value > greatest.value_or(value))
      value = std::numeric_limits<double>::quiet_NaN();
    value = value * scale.value_or(1) + offset.value_or(0);
  }
}

/// One-dimensional heights, with their positions `x` or an attribute size_x.
LoadedSurface read_profile(const Document& document, const std::string& name) {
  const auto column = [&](const std::string& of) {
    const Object& object = document.numeric(of);
    std::vector<double> values(object.count());
    document.numbers(of, values);
    unpack(document, object, values);
    return values;
  };
  const std::vector<double> heights = column(name);
  const Object& root = document.group("/");
  LoadedSurface profile;
  if (document.find("x")) {
    std::vector<double> positions = column("x");
    if (const auto unit = document.dataset("x").text("units"); unit && !unit->empty()) {
      const double metres = metres_per(document.path(), *unit);
      for (double& position : positions) position *= metres;
    }
    profile = profile_of(document.path(), positions, heights);
  } else {
    profile.is_profile = true;
    profile.heights = Eigen::Map<const Eigen::ArrayXd>(heights.data(), Index(heights.size()));
    profile.size_x = root.number("size_x");
  }
  for (const Object* object : {&document.dataset(name), &root})
    if (profile.unit.empty()) profile.unit = object->text("units").value_or("");
  return profile;
}

}  // namespace

LoadedSurface read_hdf5(const std::filesystem::path& file, const Communicator& ranks) {
  const Document document{InputFile(file)};
  const std::string name = heights_name(document);
  const Object& heights = document.dataset(name);
  const Object& root = document.group("/");
  if (heights.shape.size() == 1 && ranks.alone()) return read_profile(document, name);
  if (heights.shape.size() != 2 || heights.shape[0] == 0 || heights.shape[1] == 0)
    refuse(document.path(),
           "has heights that are not two-dimensional with nx, ny >= 1; store heights (nx, ny)");
  document.numeric(name);
  LoadedSurface surface;
  const auto number = [&](const char* key) {
    const auto value = heights.number(key);
    return value ? value : root.number(key);
  };
  surface.size_x = number("size_x");
  surface.size_y = number("size_y");
  if (const auto periodic = number("periodic")) surface.periodic = *periodic != 0;
  for (const Object* object : {&heights, &root})
    if (surface.unit.empty()) surface.unit = object->text("units").value_or("");
  const Share share(ranks, static_cast<Index>(heights.shape[0]));
  surface.rows = share.rows();
  surface.heights = heights_of(file, share.count(), static_cast<Index>(heights.shape[1]));
  document.rows(name, share,
                {surface.heights.data(), static_cast<std::size_t>(surface.heights.size())});
  unpack(document, heights,
         {surface.heights.data(), static_cast<std::size_t>(surface.heights.size())});
  return surface;
}

}  // namespace salebra::detail
