// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// Cells of a grid that are in contact, (nx, ny), x first, y contiguous:
///     const ContactSet contact = state.contact_pressure > 0;
using ContactSet = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A tangential vector per cell: traction in Pa, or displacement in m.
struct TangentialField {
  Field x;  ///< (nx, ny)
  Field y;  ///< (nx, ny)
};

constexpr void describe(auto&& visit, std::type_identity<TangentialField>) {
  visit(&TangentialField::x, Kept{"x", "along x"});
  visit(&TangentialField::y, Kept{"y", "along y"});
}

}  // namespace salebra
