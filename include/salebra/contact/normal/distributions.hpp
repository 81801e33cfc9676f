// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <vector>

namespace salebra {

/// How pressures and gaps of a contact are distributed, in bins of equal width from 0 to the
/// largest value; a value between two bins counts to the upper one, the largest to the last.
struct ContactDistributions {
  /// P(p) over the nominal area: cells in contact alone, ∫P dp = A/A0, the rest being at p = 0.
  std::vector<double> contact_pressure;  ///< middle of the bin, Pa
  std::vector<double> pressure_density;  ///< part of all cells in the bin over its width, 1/Pa
  double pressure_width = 0;             ///< of a bin, Pa
  /// P(g) over the nominal area: cells out of contact alone, ∫P dg = 1 − A/A0.
  std::vector<double> gap;          ///< middle of the bin, m
  std::vector<double> gap_density;  ///< part of all cells in the bin over its width, 1/m
  double gap_width = 0;             ///< of a bin, m
};

constexpr void describe(auto&& visit, std::type_identity<ContactDistributions>) {
  using enum Dimension;
  using S = ContactDistributions;
  visit(&S::contact_pressure,
        Quantity{"contact_pressure", Dimension::pressure, "contact pressure"});
  visit(&S::pressure_density, Quantity{"pressure_density", inverse_pressure,
                                       "density of contact pressures over the nominal area"});
  visit(&S::pressure_width, Kept{"pressure_width", "width of a bin", Dimension::pressure});
  visit(&S::gap, Quantity{"gap", length, "gap of the deformed surfaces"});
  visit(&S::gap_density,
        Quantity{"gap_density", inverse_length, "density of gaps over the nominal area"});
  visit(&S::gap_width, Kept{"gap_width", "width of a bin", length});
}

/// The distributions of a state; those of pressures are empty where nothing touches, those of gaps
/// in full contact. Cells with p > 0 are in contact, and pressures at the hardness are in the last
/// bin. Gaps below 0, within the solver's tolerance, count as 0.
/// bins     of each, 1 … 100000
/// throws   InvalidInput for bins, and for fields that do not fill the grid
/// cost     two passes. Collective where the state is spread: every process gets all bins, with the
///          bits of one process
ContactDistributions contact_distributions(const NormalContactState& state, const Grid2D& grid,
                                           int bins = 100);

}  // namespace salebra
