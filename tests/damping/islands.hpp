// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <salebra/damping/cycle.hpp>

/// Contact of several islands that grow and merge as the indentation rises from 0 to 1. The force
/// equals the indentation.
inline salebra::ContactSets island_contact_sets(const salebra::Grid2D& grid) {
  using namespace salebra;
  using std::numbers::pi;
  return [grid](double indentation) {
    ContactSetAt found{.contact = ContactSet(grid.nx, grid.ny), .force = indentation};
    for (Index ix = 0; ix < grid.nx; ++ix)
      for (Index iy = 0; iy < grid.ny; ++iy) {
        const double x = 2 * pi * static_cast<double>(ix) / static_cast<double>(grid.nx);
        const double y = 2 * pi * static_cast<double>(iy) / static_cast<double>(grid.ny);
        found.contact(ix, iy) =
            std::sin(x + 0.3) * std::cos(2 * y) + 0.7 * std::sin(3 * x - y) > 1.2 - indentation;
      }
    return found;
  };
}

/// Uneven pressures on these islands, at which some cells stick and others slip.
inline salebra::PressureFields island_pressures(const salebra::Grid2D& grid) {
  using namespace salebra;
  return [grid, contact_sets = island_contact_sets(grid)](double indentation) {
    PressureAt found{.contact_pressure = Field::Zero(grid.nx, grid.ny), .force = indentation};
    const ContactSet contact = contact_sets(indentation).contact;
    for (Index ix = 0; ix < grid.nx; ++ix)
      for (Index iy = 0; iy < grid.ny; ++iy)
        if (contact(ix, iy))
          found.contact_pressure(ix, iy) =
              2e7 * (0.2 + indentation + 0.1 * std::sin(static_cast<double>(ix * iy)));
    return found;
  };
}
