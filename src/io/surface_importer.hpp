// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/error.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Thrown for a file that is whole, as far as one can tell, and of no format that is read here.
class UnknownFormat : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// Writes the surface in `from` as the HDF5 file `to`, as read_surface reads it. refusal: why it is
/// not read here; channel: as ReadOptions has it. Returns lines for ReadOptions::warnings. Throws InvalidInput naming the file where
/// it cannot.
using SurfaceImporter = std::vector<std::string> (*)(const std::filesystem::path& from,
                                                     const std::filesystem::path& to,
                                                     const std::string& channel,
                                                     const UnknownFormat& refusal);

/// Who is asked from now on for files of unknown formats; nullptr, as at the start: nobody, and they
/// are refused. The program installs one that calls salebra-import; a library call never starts a
/// process on its own.
void set_surface_importer(SurfaceImporter importer);

namespace detail {
/// UnknownFormat "<file>: <what>".
[[noreturn]] void refuse_unknown(const std::filesystem::path& file, const std::string& what);
}  // namespace detail

}  // namespace salebra
