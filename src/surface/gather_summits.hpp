// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/summits.hpp>

namespace salebra::detail {

/// Gathers the summits of all processes in the first process, in the order in which a single
/// process finds them. Collective.
SummitList gathered(SummitList list, const Grid2D& grid);

}  // namespace salebra::detail
