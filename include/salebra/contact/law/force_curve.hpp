// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace salebra {

/// One state of a contact. A quantity that a model does not have is NaN.
struct ForceSample {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double indentation =
      unknown;  ///< δ, m; larger is closer. From first touch where the model knows it
  double mean_gap = unknown;  ///< ū, m; dū = −dδ
  double separation =
      unknown;  ///< s, m: smooth plane to mean plane of the summits (Greenwood–Williamson)
  double force = unknown;                  ///< F, N
  double pressure = unknown;               ///< p = F/A0, Pa
  double contact_area_fraction = unknown;  ///< A/A0
  double normal_stiffness = unknown;       ///< K = dF/dδ, N/m
  double tangential_stiffness = unknown;   ///< K_t = dF_x/dx in full stick, N/m
  bool converged = true;
};

/// What every contact model returns, ordered from the lowest force to the highest.
struct ForceCurve {
  std::string model;                         ///< "bem", "greenwood-williamson", …
  double nominal_area = 0;                   ///< A0, m²
  double rms_height = ForceSample::unknown;  ///< h_rms of the surface, m
  std::vector<ForceSample> samples;

  /// One member of every sample, such as column(&ForceSample::pressure).
  std::vector<double> column(double ForceSample::*quantity) const;
};

}  // namespace salebra
