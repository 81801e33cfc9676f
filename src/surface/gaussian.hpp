// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/filters.hpp>

namespace salebra::detail {

/// The axes along which a filter acts.
struct FilterAxes {
  bool x = true, y = true;
};

/// As filtered(), along the given axes only. Axes of a single point are never filtered.
Surface filtered_along(Surface surface, const GaussianFilters& filters, FilterAxes axes);

}  // namespace salebra::detail
