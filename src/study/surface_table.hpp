// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/configuration.hpp>

#include "toml_reader.hpp"

namespace salebra::detail {

/// The keys of a measured surface, of a study or of one of several scans. folder: of the document.
MeasuredSurface read_measured(TomlTable& table, const std::filesystem::path& folder);

/// A study file as read_study_configuration() reads it, with the spectrum of a twin in place of that
/// which its [surface] names: files of that are not opened, and need not be there.
StudyConfiguration read_study_of_twin(const std::filesystem::path& file,
                                      const std::filesystem::path& twin);

}  // namespace salebra::detail
