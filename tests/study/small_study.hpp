// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/configuration.hpp>
#include <string>

#include "study_text.hpp"

/// The small study with a dozen loads, followed by `more`.
inline salebra::StudyConfiguration small_study(const std::string& more = "") {
  return salebra::parse_study_configuration(study_text("seeds = [1, 2, 3]", 12) + more,
                                            "small.toml");
}
