// SPDX-License-Identifier: GPL-3.0-or-later
// Probability densities of the pressures and gaps of a contact.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/distributions.hpp>
#include <span>

namespace salebra {
namespace {

/// Histogram of one quantity. value(k) is the quantity in cell k of this process, or negative if it
/// is not defined in the cell.
struct Bins {
  std::vector<double> middle, density;
  double width = 0;
};

template <class Value>
Bins bins_of(const RowPartition& rows, Index columns, std::size_t count, const Value& value) {
  double largest = -1;
  for (const double part : parallel::map_blocks<double>(
           rows,
           [&](Index begin, Index end) {
             double most = -1;
             for (Index k = begin * columns; k < end * columns; ++k)
               most = std::max(most, value(k));
             return most;
           },
           rows.count() * columns))
    largest = std::max(largest, part);
  Bins bins;
  if (!(largest > 0)) return bins;
  bins.width = largest / static_cast<double>(count);
  const std::vector<double> cells =
      parallel::sum_blocks(rows, count, [&](Index begin, Index end, std::span<double> sums) {
        for (Index k = begin * columns; k < end * columns; ++k) {
          if (value(k) < 0) continue;
          const auto bin = static_cast<std::size_t>(value(k) / bins.width);
          sums[std::min(bin, count - 1)] += 1;
        }
      });
  const double all = static_cast<double>(rows.rows() * columns);
  for (std::size_t bin = 0; bin < count; ++bin) {
    bins.middle.push_back((static_cast<double>(bin) + 0.5) * bins.width);
    bins.density.push_back(cells[bin] / (all * bins.width));
  }
  return bins;
}

}  // namespace

ContactDistributions contact_distributions(const NormalContactState& state, const Grid2D& grid,
                                           int bins) {
  grid.validate();
  require(bins >= 1 && bins <= 100000, "bins", bins, "must lie in 1 … 100000");
  const RowPartition rows(state.communicator, grid.nx);
  collectively(state.communicator, [&] {
    for (const Field* field : {&state.contact_pressure, &state.gap})
      require(field->rows() == rows.count() && field->cols() == grid.ny, "state", field->size(),
              "points do not fill the grid");
  });
  const double *pressure = state.contact_pressure.data(), *gap = state.gap.data();
  const auto count = static_cast<std::size_t>(bins);
  Bins of_pressure =
      bins_of(rows, grid.ny, count, [&](Index k) { return pressure[k] > 0 ? pressure[k] : -1.0; });
  Bins of_gap = bins_of(rows, grid.ny, count,
                        [&](Index k) { return pressure[k] > 0 ? -1.0 : std::max(0.0, gap[k]); });
  return {std::move(of_pressure.middle), std::move(of_pressure.density), of_pressure.width,
          std::move(of_gap.middle),      std::move(of_gap.density),      of_gap.width};
}

}  // namespace salebra
