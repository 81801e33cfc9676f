// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from an HDF5 file.
#include <algorithm>
#include <limits>
#include <set>

#include "hdf5_document.hpp"
#include "header_words.hpp"
#include "loaded_surface.hpp"
#include "surface_importer.hpp"

namespace salebra::detail {
namespace {

using namespace hdf5;

std::string unit_of(const Document& document, const Object& dataset) {
  const std::string unit = dataset.text("units").value_or("");
  return unit.empty() ? document.group("/").text("units").value_or("") : unit;
}

/// Name of the dataset with the heights: `channel` if it is given, otherwise "heights", otherwise
/// the only two-dimensional dataset at the root.
std::string heights_name(const Document& document, const std::string& channel,
                         LoadedSurface& surface) {
  surface.has_channels = true;
  if (!channel.empty() && document.find(channel)) return channel;
  std::vector<Channel> found;
  const bool has_heights = document.find("heights") != nullptr;
  if (has_heights) found.push_back({"", "heights", ""});
  std::string refused;
  for (const auto& [name, kind] : document.group("/").members) {
    if (kind == Object::Kind::refused) refused = name;
    if (kind == Object::Kind::group || kind == Object::Kind::refused || name == "heights") continue;
    const Object& dataset = document.dataset(name);
    // If the file has a dataset "heights", other two-dimensional datasets count as channels only if
    // their unit is a length or is not given. Maps of pressure and the like are no channels.
    const std::string unit = unit_of(document, dataset);
    if (dataset.shape.size() == 2 && (!has_heights || unit.empty() || metres_in(unit)))
      found.push_back({"", name, ""});
  }
  if (channel.empty() && !has_heights && found.size() > 1)
    refuse_unknown(document.path(),
                   "has several two-dimensional datasets at its root, " + found[0].name + " and " +
                       found[1].name +
                       " among them, and none is named heights; name one by `channel`");
  if (!found.empty()) return found[chosen_channel(document.path(), found, channel, surface)].name;
  if (!refused.empty()) return refused;
  refuse_unknown(document.path(),
                 "has no dataset heights (nx, ny) at its root; store the surface there");
}

/// The value of a numeric attribute; nothing if there is none. Throws if the attribute is not one
/// number.
std::optional<double> number_of(const Document& document, const Object& object,
                                const std::string& name) {
  const auto found = std::ranges::find(
      object.attributes, name, [](const auto& entry) { return std::string_view(entry.first); });
  if (found == object.attributes.end()) return {};
  if (const auto* number = std::get_if<double>(&found->second)) return *number;
  refuse(document.path(), "has an attribute " + name + " that is not a single number; correct it");
}

/// Refuses a dataset with an attribute about units, scales or masks that is not in `used`, since
/// this reader would ignore it. whose: the dataset in messages.
void require_used(const Document& document, const Object& object, const std::string& whose,
                  const std::set<std::string_view>& used) {
  for (const auto& [name, value] : object.attributes) {
    if (used.contains(name)) continue;
    const std::string word = plain_word(name);
    for (const char* meaning : {"unit", "scale", "factor", "offset", "fill", "missing", "nodata",
                                "valid", "mask", "gain", "calibration"})
      if (word.find(meaning) != std::string::npos)
        refuse(document.path(),
               "has an attribute " + name + whose +
                   ", which salebra does not apply; apply it and remove the attribute");
  }
}

/// Turns stored numbers into heights by the conventions for climate and forecast data (CF): values
/// that mark undefined points and limits of valid values apply before scale and offset.
void unpack(const Document& document, const Object& object, std::span<double> values) {
  const auto number = [&](const char* name) { return number_of(document, object, name); };
  const auto fill = number("_FillValue"), missing = number("missing_value"),
             least = number("valid_min"), greatest = number("valid_max"),
             scale = number("scale_factor"), offset = number("add_offset");
  require_used(document, object, " of its heights",
               {"_FillValue", "missing_value", "valid_min", "valid_max", "scale_factor",
                "add_offset", "units"});
  require_used(document, document.group("/"), "", {"units", "source_units"});
  if (object.attributes.end() !=
          std::ranges::find(object.attributes, "units",
                            &decltype(object.attributes)::value_type::first) &&
      !object.text("units"))
    refuse(document.path(), "has an attribute units that is not a text; correct it");
  if (!fill && !missing && !least && !greatest && !scale && !offset) return;
  for (double& value : values) {
    if (value == fill || value == missing || value < least.value_or(value) ||
        value > greatest.value_or(value))
      value = std::numeric_limits<double>::quiet_NaN();
    value = value * scale.value_or(1) + offset.value_or(0);
  }
}

/// Completes a line profile: one-dimensional heights, with their positions in the dataset `x` or
/// with the length in an attribute size_x.
LoadedSurface read_profile(const Document& document, const std::string& name,
                           LoadedSurface profile) {
  const auto column = [&](const std::string& of) {
    const Object& object = document.numeric(of);
    std::vector<double> values(object.count());
    document.numbers(of, values);
    unpack(document, object, values);
    return values;
  };
  const std::vector<double> heights = column(name);
  const Object& root = document.group("/");
  if (document.find("x")) {
    std::vector<double> positions = column("x");
    if (const auto unit = document.dataset("x").text("units"); unit && !unit->empty()) {
      const double metres = metres_per(document.path(), *unit);
      for (double& position : positions) position *= metres;
    }
    LoadedSurface even = profile_of(document.path(), positions, heights);
    even.warnings.insert(even.warnings.begin(), profile.warnings.begin(), profile.warnings.end());
    even.has_channels = true;
    profile = std::move(even);
  } else {
    profile.is_profile = true;
    profile.heights = Eigen::Map<const Eigen::ArrayXd>(heights.data(), Index(heights.size()));
    profile.size_x = root.number("size_x");
  }
  profile.unit = unit_of(document, document.dataset(name));
  profile.stated_unit = root.text("source_units").value_or("");
  return profile;
}

}  // namespace

LoadedSurface read_hdf5(const std::filesystem::path& file, const std::string& channel,
                        const Communicator& communicator) {
  const Document document{InputFile(file)};
  LoadedSurface surface;
  const std::string name = heights_name(document, channel, surface);
  const Object& heights = document.dataset(name);
  const Object& root = document.group("/");
  if (heights.shape.size() == 1 && communicator.alone())
    return read_profile(document, name, std::move(surface));
  if (heights.shape.size() != 2 || heights.shape[0] == 0 || heights.shape[1] == 0)
    refuse(document.path(),
           "has heights that are not two-dimensional with nx, ny >= 1; store heights (nx, ny)");
  document.numeric(name);
  const auto number = [&](const char* key) {
    const auto value = heights.number(key);
    return value ? value : root.number(key);
  };
  surface.size_x = number("size_x");
  surface.size_y = number("size_y");
  if (const auto periodic = number("periodic")) surface.periodic = *periodic != 0;
  surface.unit = unit_of(document, heights);
  surface.stated_unit = root.text("source_units").value_or("");
  const RowPartition partition(communicator, static_cast<Index>(heights.shape[0]));
  surface.rows = partition.rows();
  surface.heights = heights_of(file, partition.count(), static_cast<Index>(heights.shape[1]));
  document.rows(name, partition,
                {surface.heights.data(), static_cast<std::size_t>(surface.heights.size())});
  unpack(document, heights,
         {surface.heights.data(), static_cast<std::size_t>(surface.heights.size())});
  return surface;
}

}  // namespace salebra::detail
