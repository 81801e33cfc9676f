// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of a force curve, and its division by the direction of the tangential stiffness.
#include <algorithm>
#include <cmath>
#include <salebra/contact/law/force_curve.hpp>

namespace salebra {

std::vector<double> ForceCurve::column(double ForceSample::*quantity) const {
  std::vector<double> values(samples.size());
  std::ranges::transform(samples, values.begin(),
                         [&](const ForceSample& sample) { return sample.*quantity; });
  return values;
}

std::vector<ForceCurve> by_direction(const ForceCurve& curve) {
  std::vector<ForceCurve> curves;
  for (const ForceSample& sample : curve.samples) {
    const auto same = std::ranges::find_if(curves, [&](const ForceCurve& one) {
      return one.direction() == sample.direction ||
             (std::isnan(one.direction()) && std::isnan(sample.direction));
    });
    if (same != curves.end()) {
      same->samples.push_back(sample);
    } else {
      curves.push_back(curve);
      curves.back().samples = {sample};
    }
  }
  if (curves.empty()) curves.push_back(curve);
  return curves;
}

ForceCurve joined(const std::vector<ForceCurve>& curves) {
  ForceCurve all = curves.front();
  for (std::size_t k = 1; k < curves.size(); ++k)
    all.samples.insert(all.samples.end(), curves[k].samples.begin(), curves[k].samples.end());
  return all;
}

}  // namespace salebra
