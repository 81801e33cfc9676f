// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/surface/axis.hpp>
#include <salebra/surface/filters.hpp>

namespace salebra {

/// Profile parameters of ISO 21920-2, means over all complete profiles of a surface along one axis,
/// with the standard deviations between the profiles. Heights h are measured from the mean of each
/// profile. Values are NaN if unknown.
struct ProfileParameters {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double Ra = unknown;  ///< ⟨|h|⟩ over the whole profile, m
  double Rq = unknown;  ///< √⟨h²⟩ over the whole profile, m
  double Rz = unknown;  ///< highest minus lowest point of a section, mean over the sections, m
  /// Mean spacing of profile elements, m: of the points where the profile rises through its mean
  /// line. A hill and a dale count if they reach 10 % of Rz above and below the mean line. NaN if
  /// more than a tenth of the profiles have fewer than two such points.
  double Rsm = unknown;
  /// Standard deviations between profiles, m; NaN for a single profile.
  double Ra_deviation = unknown, Rq_deviation = unknown, Rz_deviation = unknown,
         Rsm_deviation = unknown;
  Index profiles = 0;  ///< profiles without undefined points
  Index sections = 0;  ///< sections of a profile for Rz
};

constexpr void describe(auto&& visit, std::type_identity<ProfileParameters>) {
  using enum Dimension;
  using S = ProfileParameters;
  visit(&S::Ra, Quantity{"Ra", length, "ISO 21920-2 arithmetic mean height of profiles"});
  visit(&S::Rq, Quantity{"Rq", length, "ISO 21920-2 root mean square height of profiles"});
  visit(&S::Rz, Quantity{"Rz", length, "ISO 21920-2 maximum height per section of profiles"});
  visit(&S::Rsm, Quantity{"Rsm", length, "ISO 21920-2 mean spacing of profile elements"});
  visit(&S::Ra_deviation,
        Quantity{"Ra_deviation", length, "standard deviation of Ra between profiles"});
  visit(&S::Rq_deviation,
        Quantity{"Rq_deviation", length, "standard deviation of Rq between profiles"});
  visit(&S::Rz_deviation,
        Quantity{"Rz_deviation", length, "standard deviation of Rz between profiles"});
  visit(&S::Rsm_deviation,
        Quantity{"Rsm_deviation", length, "standard deviation of Rsm between profiles"});
  visit(&S::profiles, Quantity{"profiles", dimensionless, "profiles without undefined points"});
  visit(&S::sections, Quantity{"sections", dimensionless, "sections of a profile for Rz"});
}

/// Computes the parameters of the profiles of a surface along an axis:
///     const ProfileParameters across = profile_parameters(surface, Axis::x, {{}, 0.8e-3});
/// filters  applied to each profile (ISO 16610-21), not to the surface: R-parameters by the
///          standard need the L-filter; without it they are those of the primary profile (Pa, Pq,
///          Pz, Psm) after subtraction of the mean
/// Rz: with an L-filter a section is as long as its cut-off, and as many whole sections as fit lie
/// in the middle of the profile (the standard takes five); without it the profile is one section.
/// Throws InvalidInput as filtered() does. Cost: one pass over the heights, and filtered() along
/// the axis.
ProfileParameters profile_parameters(const Surface& surface, Axis axis,
                                     const GaussianFilters& filters = {});

}  // namespace salebra
