// SPDX-License-Identifier: GPL-3.0-or-later
// Force curve as JSON.
#include "curve_json.hpp"

#include <algorithm>
#include <cmath>

#include "results/columns.hpp"

namespace salebra::cli {

Json to_json(const ForceCurve& curve) {
  Json object = json_of(curve.samples, curve.nominal_area);
  const auto unknown = [](const Json& value) { return !std::isfinite(value.number()); };
  for (const char* name :
       {"separation", "normal_stiffness_per_area", "tangential_stiffness_per_area"})
    if (object.contains(name) && std::ranges::all_of(object[name].elements(), unknown))
      object.erase(name);
  return object;
}

}  // namespace salebra::cli
