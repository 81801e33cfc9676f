// SPDX-License-Identifier: GPL-3.0-or-later
// Force curve as JSON.
#include "curve_json.hpp"

namespace salebra::cli {

Json to_json(const ForceCurve& curve, bool with_separation) {
  Json object;
  if (with_separation) object["separation"] = curve.column(&ForceSample::separation);
  object["pressure"] = curve.column(&ForceSample::pressure);
  object["mean_gap"] = curve.column(&ForceSample::mean_gap);
  object["indentation"] = curve.column(&ForceSample::indentation);
  object["contact_area_fraction"] = curve.column(&ForceSample::contact_area_fraction);
  object["normal_stiffness"] = curve.column(&ForceSample::normal_stiffness);
  object["tangential_stiffness"] = curve.column(&ForceSample::tangential_stiffness);
  Json converged = Json::array();
  for (const ForceSample& sample : curve.samples) converged.push_back(sample.converged);
  object["converged"] = std::move(converged);
  return object;
}

}  // namespace salebra::cli
