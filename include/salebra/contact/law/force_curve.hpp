// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <string>
#include <vector>

namespace salebra {

/// One state of a contact. Quantities that a model does not provide are NaN.
struct ForceSample {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  /// Indentation δ, m, which grows with approach; measured from first touch if the model knows it.
  double indentation = unknown;
  double mean_gap = unknown;  ///< mean gap ū, m; dū = −dδ
  double separation =
      unknown;  ///< s, m: distance of the smooth plane from the mean plane of the summits
                ///< (Greenwood–Williamson)
  double force = unknown;                  ///< F, N
  double pressure = unknown;               ///< p = F/A0, Pa
  double contact_area_fraction = unknown;  ///< A/A0
  double normal_stiffness = unknown;       ///< K = dF/dδ, N/m
  double tangential_stiffness = unknown;   ///< K_t = dF_x/dx in full stick, N/m
  bool converged = true;
};

constexpr void describe(auto&& visit, std::type_identity<ForceSample>) {
  using enum Dimension;
  using S = ForceSample;
  visit(&S::indentation, Quantity{"indentation", length, "indentation"});
  visit(&S::mean_gap, Quantity{"mean_gap", length, "mean gap of the deformed surfaces"});
  visit(&S::separation, Quantity{"separation", length,
                                 "distance of the smooth plane from the mean plane of summits"});
  visit(&S::force, Quantity{"force", Dimension::force, "normal force"});
  visit(&S::pressure, Quantity{"pressure", Dimension::pressure, "nominal pressure"});
  visit(&S::contact_area_fraction,
        Quantity{"contact_area_fraction", dimensionless, "contact area over nominal area"});
  visit(&S::normal_stiffness,
        Extensive{"normal_stiffness", stiffness, "normal stiffness dF/d(indentation)"});
  visit(&S::tangential_stiffness,
        Extensive{"tangential_stiffness", stiffness, "tangential stiffness in full stick"});
  visit(&S::converged, Quantity{"converged", dimensionless, "whether the contact converged"});
}

/// The result of every contact model, ordered from the lowest force to the highest:
///     const std::vector<double> pressures = curve.column(&ForceSample::pressure);
struct ForceCurve {
  std::string model;        ///< name of the model, e.g. "bem", "greenwood-williamson"
  double nominal_area = 0;  ///< A0, m²
  double rms_height = ForceSample::unknown;  ///< h_rms of the surface, m
  std::vector<ForceSample> samples;
  bool adhesive = false;  ///< true for contacts with adhesion, which TabulatedLaw rejects because
                          ///< they have no single-valued law

  /// Returns one member of every sample.
  std::vector<double> column(double ForceSample::*quantity) const;
};

constexpr void describe(auto&& visit, std::type_identity<ForceCurve>) {
  using enum Dimension;
  visit(&ForceCurve::model, Kept{"model", "contact model"});
  visit(&ForceCurve::nominal_area, Quantity{"nominal_area", length_squared, "nominal area"});
  visit(&ForceCurve::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&ForceCurve::samples, Table{"samples", "from the lowest force to the highest"});
  visit(&ForceCurve::adhesive, Kept{"adhesive", "whether its contacts adhere"});
}

}  // namespace salebra
