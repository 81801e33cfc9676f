// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from an HDF5 file.
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

/// One-dimensional heights, with their positions `x` or an attribute size_x.
LoadedSurface read_profile(const Document& document, const std::string& name) {
  const auto column = [&](const std::string& of) {
    std::vector<double> values(document.numeric(of).count());
    document.numbers(of, values);
    return values;
  };
  const std::vector<double> heights = column(name);
  const Object& root = document.group("/");
  LoadedSurface profile;
  if (document.find("x")) {
    profile = profile_of(document.path(), column("x"), heights);
  } else {
    profile.is_profile = true;
    profile.heights = Eigen::Map<const Eigen::ArrayXd>(heights.data(), Index(heights.size()));
    profile.size_x = root.number("size_x");
  }
  profile.unit = root.text("units").value_or("");
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
  return surface;
}

}  // namespace salebra::detail
