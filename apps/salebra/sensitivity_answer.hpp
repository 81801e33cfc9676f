// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/sensitivity.hpp>
#include <string>

#include "session.hpp"

namespace salebra::cli {

/// JSON OUTPUT.PARAMETER of sensitivities, each with the lists mean, low and high over the
/// pressures, and OUTPUT.waves, a list of such objects with the limits of their wavelengths.
Json sensitivity_json(const StudySensitivity& found);
/// Table of the sensitivities at the middle pressure, what was left out, and what the waves say about
/// the damping constant or, without one, the normal stiffness.
std::string sensitivity_text(const StudySensitivity& found);

}  // namespace salebra::cli
