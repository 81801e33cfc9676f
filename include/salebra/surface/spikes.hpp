// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// An isolated outlier of the heights, such as dust or an error of the instrument.
struct Spike {
  Index ix = 0, iy = 0;  ///< grid indices of the point
  double height = 0;     ///< height above the median of its neighbours, m; negative if below
};

/// Finds isolated outliers, in row order:
///     const std::vector<Spike> spikes = find_spikes(surface);
/// A point is an outlier if
///     |h − median(h_n)| > threshold · max(s, s_0),
/// where h_n are its defined neighbours (three to eight), s is 1.4826 times the median of
/// |h_n − median(h_n)|, and s_0 is 1.4826 times the median over the surface of |h − median(h_n)|;
/// for Gaussian heights s and s_0 are standard deviations. A spike consists of an outlier and of
/// those of its neighbours that rise beyond half of its height, if these are at most four. A step,
/// a scratch or a summit has more such neighbours and is kept. With a threshold of 6, a fraction of
/// 2·10⁻⁹ of the points of a Gaussian surface is mistaken for spikes. Throws InvalidInput unless
/// threshold >= 3. Cost: two passes over the heights and a selection of the median; memory for one
/// field.
std::vector<Spike> find_spikes(const Surface& surface, double threshold = 6);

/// Makes the points of the given spikes undefined.
void remove_spikes(Surface& surface, const std::vector<Spike>& spikes);

/// Returns the surface with the points of find_spikes() undefined.
Surface despiked(Surface surface, double threshold = 6);

}  // namespace salebra
