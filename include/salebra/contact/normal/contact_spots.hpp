// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/normal/normal.hpp>
#include <vector>

namespace salebra {

/// A contact patch: connected cells with p > 0 that share edges.
struct ContactSpot {
  double area = 0;   ///< m²
  double force = 0;  ///< N
};

constexpr void describe(auto&& visit, std::type_identity<ContactSpot>) {
  visit(&ContactSpot::area, Kept{"area", "area of a spot", Dimension::length_squared});
  visit(&ContactSpot::force, Kept{"force", "normal force on it", Dimension::force});
}

struct ContactSpots {
  std::vector<ContactSpot> spots;    ///< largest area first
  double contact_area_fraction = 0;  ///< cells with p > 0 over all cells
  double perimeter = 0;              ///< perimeter of all spots along cell edges, m
  double perimeter_along_x = 0;      ///< part of the perimeter that runs along x, m
  /// A/A0 corrected for the error that a boundary element solution makes along contact edges, where
  /// it overestimates the area,
  ///     A = A_cells − (π − 1 + ln 2)/24 · Σ (perimeter edges × cell width across them)
  /// by Yastrebov et al. (2017). It is never below 0.
  double corrected_area_fraction = 0;
};

constexpr void describe(auto&& visit, std::type_identity<ContactSpots>) {
  using S = ContactSpots;
  visit(&S::spots, Table{"spots", "largest area first"});
  visit(&S::contact_area_fraction,
        Kept{"contact_area_fraction", "cells with p > 0 over all cells"});
  visit(&S::perimeter, Kept{"perimeter", "of all spots, along cell edges", Dimension::length});
  visit(&S::perimeter_along_x,
        Kept{"perimeter_along_x", "the part of it along x", Dimension::length});
  visit(&S::corrected_area_fraction,
        Kept{"corrected_area_fraction",
             "contact area over nominal area, without the cells counted in excess along the edges, "
             "doi:10.1016/j.triboint.2017.04.023"});
}

/// Finds the contact patches of a pressure field (nx, ny), Pa:
///     const ContactSpots spots = contact_spots(state.contact_pressure, surface.grid);
/// Neighbours wrap for Boundary::periodic; for a free boundary the edge of the grid is an edge of
/// the contact. Throws InvalidInput unless pressure has the shape of the grid.
/// communicator  processes that share the rows of the pressure. Each process gets all spots, with
///               the same bits for any number of processes; the call is collective
/// Cost: two passes over the field, and 32 bytes per contact cell.
ContactSpots contact_spots(const Field& pressure, const Grid2D& grid,
                           Boundary boundary = Boundary::periodic,
                           const Communicator& communicator = {});

}  // namespace salebra
