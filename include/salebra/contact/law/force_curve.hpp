// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <string>
#include <vector>

namespace salebra {

namespace quantity {
/// Which way a tangential motion goes, in every result that depends on it.
inline constexpr Quantity direction{"direction", Dimension::angle,
                                    "direction of the tangential motion, from the x axis"};
}  // namespace quantity

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
  double tangential_stiffness = unknown;   ///< K_t in full stick along `direction`, N/m
  /// Direction of K_t, from the x axis, rad; NaN for models whose K_t has no direction.
  double direction = unknown;
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
  visit(&S::direction, WhereKnown{quantity::direction});
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
  /// Body::fingerprint() of the body under the surface; empty: half-spaces, or not known.
  std::string body = {};

  /// Direction of the tangential stiffnesses, from the x axis, rad: that of the first sample; NaN
  /// without samples.
  double direction() const {
    return samples.empty() ? ForceSample::unknown : samples.front().direction;
  }
  /// Returns one member of every sample.
  std::vector<double> column(double ForceSample::*quantity) const;
};

/// Divides a curve that has the K_t of several directions, one after the other, into the curves of
/// single directions; a curve of one direction stays whole.
///     const std::vector<ForceCurve> curves = by_direction(read_force_curve("ground.h5"));
std::vector<ForceCurve> by_direction(const ForceCurve& curve);
/// Joins the samples of curves in one list, as files of several directions have them. At least one
/// curve.
ForceCurve joined(const std::vector<ForceCurve>& curves);

constexpr void describe(auto&& visit, std::type_identity<ForceCurve>) {
  using enum Dimension;
  visit(&ForceCurve::model, Kept{"model", "contact model"});
  visit(&ForceCurve::nominal_area, Quantity{"nominal_area", length_squared, "nominal area"});
  visit(&ForceCurve::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&ForceCurve::samples, Table{"samples", "from the lowest force to the highest"});
  visit(&ForceCurve::adhesive, Kept{"adhesive", "whether its contacts adhere"});
  visit(&ForceCurve::body,
        Kept{"body", "checksum of the body under the surface; empty: half-spaces"});
}

}  // namespace salebra
