// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of a force curve: selection of one quantity from all samples.
#include <algorithm>
#include <salebra/contact/law/force_curve.hpp>

namespace salebra {

std::vector<double> ForceCurve::column(double ForceSample::*quantity) const {
  std::vector<double> values(samples.size());
  std::ranges::transform(samples, values.begin(),
                         [&](const ForceSample& sample) { return sample.*quantity; });
  return values;
}

}  // namespace salebra
