// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/force_curve.hpp>

#include "session.hpp"

namespace salebra::cli {

/// {pressure[], mean_gap[], indentation[], contact_area_fraction[], normal_stiffness[], tangential_stiffness[], converged[]},
/// led by separation[] where the model has one.
Json to_json(const ForceCurve& curve, bool with_separation = false);

}  // namespace salebra::cli
