// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/force_curve.hpp>

#include "session.hpp"

namespace salebra::cli {

/// A list for each column of ForceSample, without separation and stiffnesses per area where no
/// sample has them.
Json to_json(const ForceCurve& curve);

}  // namespace salebra::cli
