// SPDX-License-Identifier: GPL-3.0-or-later
// Complementarity error of a contact solution over all cells, and the height of its contact plane.
#include "contact_residual.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/parallel.hpp>

namespace salebra::detail {
namespace {

struct DenseSums {
  // Minimum of the gap g (not relative to the plane) over the cells whose pressure is below its
  // bound.
  double min_gap = std::numeric_limits<double>::infinity();
  double pressure = 0;                  // Σp
  double free_count = 0, free_gap = 0;  // number of cells with 0 < p < bound, and Σg over them
};

}  // namespace

ContactResidual contact_residual(const Grid2D& grid, const RowPartition& rows,
                                 const ScaledOperatingPoint& target, double rms_height,
                                 const double* p, const double* g) {
  const double bound = target.bound;
  DenseSums total;
  for (const DenseSums& part : parallel::map_blocks<DenseSums>(
           rows,
           [&](Index begin, Index end) {
             DenseSums sums;
             for (Index k = begin * grid.ny; k < end * grid.ny; ++k) {
               sums.pressure += p[k];
               if (p[k] >= bound) continue;
               sums.min_gap = std::min(sums.min_gap, g[k]);
               if (p[k] > 0) {
                 sums.free_count += 1;
                 sums.free_gap += g[k];
               }
             }
             return sums;
           },
           rows.count() * grid.ny)) {
    total.min_gap = std::min(total.min_gap, part.min_gap);
    total.pressure += part.pressure;
    total.free_count += part.free_count;
    total.free_gap += part.free_gap;
  }
  const double plane = target.load_given() ? total.min_gap : target.value;
  const double misfit = parallel::sum_blocks(
      rows,
      [&](Index begin, Index end) {
        double part = 0;
        for (Index k = begin * grid.ny; k < end * grid.ny; ++k) {
          const double apart = g[k] - plane;
          part += p[k] * (p[k] < bound ? std::abs(apart) : std::max(apart, 0.0));
        }
        return part;
      },
      rows.count() * grid.ny);
  ContactResidual result;
  result.residual = total.pressure > 0 ? misfit / (total.pressure * rms_height) : 0;
  if (target.load_given()) {
    result.plane_height = total.free_count > 0 ? total.free_gap / total.free_count : total.min_gap;
  } else {
    result.residual += std::max(0.0, plane - total.min_gap) / rms_height;
    result.plane_height = target.value;
  }
  return result;
}

}  // namespace salebra::detail
