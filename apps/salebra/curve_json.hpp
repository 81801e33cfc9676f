// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/force_curve.hpp>

#include "session.hpp"

namespace salebra::cli {

/// A list for each column of ForceSample, without the separation where no sample has one.
Json to_json(const ForceCurve& curve);

}  // namespace salebra::cli
