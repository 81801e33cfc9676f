// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <salebra/damping/cycle.hpp>

/// Contact of several islands that grow and merge as the indentation rises from 0 to 1, which is
/// its force too.
inline salebra::ContactSets island_levels(const salebra::Grid2D& grid) {
  using namespace salebra;
  using std::numbers::pi;
  return [grid](double indentation) {
    ContactSetAt level{.contact = ContactSet(grid.nx, grid.ny), .force = indentation};
    for (Index ix = 0; ix < grid.nx; ++ix)
      for (Index iy = 0; iy < grid.ny; ++iy) {
        const double x = 2 * pi * static_cast<double>(ix) / static_cast<double>(grid.nx);
        const double y = 2 * pi * static_cast<double>(iy) / static_cast<double>(grid.ny);
        level.contact(ix, iy) =
            std::sin(x + 0.3) * std::cos(2 * y) + 0.7 * std::sin(3 * x - y) > 1.2 - indentation;
      }
    return level;
  };
}

/// Uneven pressures on them, of the size that leaves some cells stuck and lets others slip.
inline salebra::PressureFields island_pressures(const salebra::Grid2D& grid) {
  using namespace salebra;
  return [grid, levels = island_levels(grid)](double indentation) {
    PressureAt level{.contact_pressure = Field::Zero(grid.nx, grid.ny), .force = indentation};
    const ContactSet contact = contact_sets(indentation).contact;
    for (Index ix = 0; ix < grid.nx; ++ix)
      for (Index iy = 0; iy < grid.ny; ++iy)
        if (contact(ix, iy))
          level.contact_pressure(ix, iy) =
              2e7 * (0.2 + indentation + 0.1 * std::sin(static_cast<double>(ix * iy)));
    return level;
  };
}
