// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from an HDF5 file.
#include "hdf5_document.hpp"
#include "loaded_surface.hpp"

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
      refuse(document.path(),
             "has several two-dimensional datasets at its root and none "
             "of them is named heights; name it so");
    found = name;
  }
  if (!found.empty()) return found;
  if (!refused.empty()) return refused;
  refuse(document.path(), "has no dataset heights (nx, ny) at its root; store the surface there");
}

}  // namespace

LoadedSurface read_hdf5(const std::filesystem::path& file, const Communicator& ranks) {
  const Document document{InputFile(file)};
  const std::string name = heights_name(document);
  const Object& heights = document.dataset(name);
  const Object& root = document.group("/");
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
