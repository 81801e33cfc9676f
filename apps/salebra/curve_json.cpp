// SPDX-License-Identifier: GPL-3.0-or-later
// Force curve as JSON.
#include "curve_json.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/contact/law/force_curve.hpp>

namespace salebra::cli {

Json to_json(const ForceCurve& curve) {
  Json object;
  for_each_column<ForceSample>([&](const auto& access, const Quantity& quantity) {
    Json& values = object[std::string(quantity.name)] = Json::array();
    for (const ForceSample& sample : curve.samples) values.push_back(access(sample));
  });
  const auto nowhere = [](const ForceSample& sample) { return std::isnan(sample.separation); };
  if (std::ranges::all_of(curve.samples, nowhere)) object.erase("separation");
  // What does not depend on the size of the surface.
  const auto per_area = [&](const char* name, double ForceSample::*stiffness) {
    std::vector<double> values = curve.column(stiffness);
    for (double& value : values) value /= curve.nominal_area;
    if (std::ranges::any_of(values, [](double value) { return std::isfinite(value); }))
      object[name] = values;
  };
  per_area("normal_stiffness_per_area", &ForceSample::normal_stiffness);
  per_area("tangential_stiffness_per_area", &ForceSample::tangential_stiffness);
  return object;
}

}  // namespace salebra::cli
