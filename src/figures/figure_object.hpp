// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/figures/figure.hpp>

#include "io/json.hpp"

namespace salebra::figures {

/// The figure as the object that figure_json() writes.
Json figure_object(const Figure& figure);

}  // namespace salebra::figures
