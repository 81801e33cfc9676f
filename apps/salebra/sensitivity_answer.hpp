// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/sensitivity.hpp>
#include <string>
#include <utility>
#include <vector>

#include "session.hpp"

namespace salebra::cli {

/// JSON OUTPUT.PARAMETER of sensitivities, each with the lists mean, low and high over the
/// pressures, and OUTPUT.waves, a list of such objects with the limits of their wavelengths.
Json sensitivity_json(const StudySensitivity& found);
using Tolerances = std::vector<std::pair<StudyParameter, double>>;
/// Reads "rms_height=10%". Throws InvalidInput for the option --tolerance.
Tolerances tolerances_of(const std::vector<std::string>& texts);
/// Adds tolerance.OUTPUT, a list of factors at the pressures, to the sensitivities, and returns the
/// table of the outputs between mean/factor and mean·factor.
std::string add_tolerances(Json& json, const StudySensitivity& found, const Tolerances& tolerances);

/// Table of the sensitivities at the middle pressure, what was left out, and what the waves say about
/// the damping constant or, without one, the normal stiffness.
std::string sensitivity_text(const StudySensitivity& found);

}  // namespace salebra::cli
