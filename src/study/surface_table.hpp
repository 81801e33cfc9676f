// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/configuration.hpp>

#include "toml_reader.hpp"

namespace salebra::detail {

/// Reads the keys of a measured surface, in a study or as one of several scans. folder: that of the
/// TOML file, to which the names of files are relative.
MeasuredSurface read_measured(TomlTable& table, const std::filesystem::path& folder);

/// Reads a study file as read_study_configuration() does, but uses the spectra of a surface twin
/// instead of the spectrum in [surface]. Files named in [surface] are not opened and need not
/// exist.
StudyConfiguration read_study_of_twin(const std::filesystem::path& file,
                                      const std::filesystem::path& twin);

}  // namespace salebra::detail
