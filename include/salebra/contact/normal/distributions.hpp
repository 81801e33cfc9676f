// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <vector>

namespace salebra {

/// Distributions of pressure and gap in a contact, in bins of equal width from 0 to the largest
/// value. A value on the border of two bins belongs to the upper bin, the largest value to the last
/// bin.
struct ContactDistributions {
  /// Probability density P(p) of the pressure over the nominal area, for cells in contact only: ∫P
  /// dp = A/A0; the remaining cells have p = 0.
  std::vector<double> contact_pressure;  ///< middle of the bin, Pa
  std::vector<double> pressure_density;  ///< P(p): cells in the bin over all cells and width, 1/Pa
  double pressure_width = 0;             ///< width of a bin, Pa
  /// Probability density P(g) of the gap over the nominal area, for cells out of contact only: ∫P
  /// dg = 1 − A/A0.
  std::vector<double> gap;          ///< middle of the bin, m
  std::vector<double> gap_density;  ///< P(g): cells in the bin over all cells and width, 1/m
  double gap_width = 0;             ///< width of a bin, m
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

/// Computes the distributions of a state:
///     const ContactDistributions bins = contact_distributions(state, surface.grid);
/// The distribution of pressure is empty if nothing touches, the distribution of the gap is empty
/// in full contact. Cells with p > 0 are in contact, and pressures at the hardness fall into the
/// last bin. Gaps below 0, within the tolerance of the solver, count as 0.
/// bins     number of bins of each distribution, 1 to 100000
/// throws   InvalidInput for a wrong number of bins, and for fields that do not have the shape of
///          the grid
/// cost     two passes over the fields. Collective if the state is distributed: every process gets
///          all bins, with the same bits as in one process
ContactDistributions contact_distributions(const NormalContactState& state, const Grid2D& grid,
                                           int bins = 100);

}  // namespace salebra
