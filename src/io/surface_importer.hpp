// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/error.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Thrown for a file whose format the library does not know. The file may be undamaged.
class UnknownFormat : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// Function that converts the surface in the file `from` to the HDF5 file `to`, which
/// read_surface() then reads. refusal: why the library does not read `from`; channel: as in
/// ReadOptions. Returns lines for ReadOptions::warnings. Throws InvalidInput naming the file if it
/// cannot convert it.
using SurfaceImporter = std::vector<std::string> (*)(const std::filesystem::path& from,
                                                     const std::filesystem::path& to,
                                                     const std::string& channel,
                                                     const UnknownFormat& refusal);

/// Sets the function that imports files of unknown formats. With nullptr, the default, such files
/// are refused. The program installs one that calls salebra-import. The library alone never starts
/// a process.
void set_surface_importer(SurfaceImporter importer);

namespace detail {
/// Throws UnknownFormat with the text "<file>: <what>".
[[noreturn]] void refuse_unknown(const std::filesystem::path& file, const std::string& what);
}  // namespace detail

}  // namespace salebra
