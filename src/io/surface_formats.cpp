// SPDX-License-Identifier: GPL-3.0-or-later
// The table of surface formats: how each format is recognised, read and written, and what it keeps.
#include "surface_formats.hpp"

#include "surface_format.hpp"

namespace salebra::detail {

// Readers and writers of the formats. A new format needs a source file with them, a declaration
// here, and an entry in the table below.
SurfaceFormatEntry::Read read_gsf, read_gwy, read_npy, read_sur, read_text, read_x3p;
SurfaceFormatEntry::Write write_gsf, write_gwy, write_hdf5, write_npy, write_text, write_xyz;

const std::vector<SurfaceFormatEntry>& surface_format_table() {
  static const std::vector<SurfaceFormatEntry> table{
      // HDF5 has no reader in this table: the HDF5 library needs the file itself and not its
      // content, so read_surface.cpp calls it.
      {"hdf5",
       {"\x89HDF\r\n\x1a\n"},
       nullptr,
       write_hdf5,
       {"HDF5",
        {".h5", ".hdf5"},
        "yes",
        "yes",
        "exact",
        "exact",
        "NaN",
        "kept",
        "attributes of the root"}},
      {"npy",
       {"\x93NUMPY"},
       read_npy,
       write_npy,
       {"NumPy array with a sidecar",
        {".npy"},
        "any real type",
        "float64",
        "exact",
        "exact",
        "NaN",
        "kept",
        "sidecar"}},
      {"x3p",
       {"PK\x03\x04"},
       read_x3p,
       nullptr,
       {"X3P, ISO 25178-72", {".x3p"}, "I, L, F, D", "", "", "", "NaN and mask", "", ""}},
      {"gwy",
       {"GWYP"},
       read_gwy,
       write_gwy,
       {"Gwyddion",
        {".gwy"},
        "a channel of heights",
        "yes",
        "exact",
        "exact",
        "mask",
        "lost",
        "`/0/meta`"}},
      {"gsf",
       {"Gwyddion Simple Field 1.0\n"},
       read_gsf,
       write_gsf,
       {"Gwyddion Simple Field",
        {".gsf"},
        "yes",
        "yes",
        "7 digits (float32)",
        "exact",
        "NaN",
        "lost",
        "lost"}},
      {"sur",
       {"DIGITAL SURF", "DSCOMPRESSED"},
       read_sur,
       nullptr,
       {"Digital Surf", {".sur"}, "16 and 32 bits", "", "", "", "marked value", "", ""}},
      {"xyz",
       {},
       nullptr,
       write_xyz,
       {"XYZ points as text",
        {".xyz"},
        "yes",
        "yes",
        "exact",
        "last digits",
        "`nan`, or no point",
        "lost",
        "lost"}},
      {"text",
       {},
       read_text,
       write_text,
       {"text matrix", {".txt", ".asc"}, "yes", "yes", "exact", "exact", "`nan`", "lost", "lost"}},
  };
  return table;
}

}  // namespace salebra::detail

namespace salebra {
namespace {

std::string extensions_with(std::string_view SurfaceFormat::*use) {
  std::string list;
  for (const SurfaceFormat& format : surface_formats())
    if (!(format.*use).empty())
      list += (list.empty() ? "" : " ") + std::string(format.extensions.front());
  return list;
}

}  // namespace

std::string read_extensions() { return extensions_with(&SurfaceFormat::read); }
std::string written_extensions() { return extensions_with(&SurfaceFormat::written); }

std::vector<SurfaceFormat> surface_formats() {
  std::vector<SurfaceFormat> all;
  for (const detail::SurfaceFormatEntry& entry : detail::surface_format_table())
    all.push_back(entry.facts);
  return all;
}

}  // namespace salebra
