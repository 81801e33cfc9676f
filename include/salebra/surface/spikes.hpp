// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// An isolated outlier: dust, or an error of the instrument.
struct Spike {
  Index ix = 0, iy = 0;
  double height = 0;  ///< height above the median of its neighbours, m; negative if below
};

/// Finds isolated outliers, in row order:
///     const std::vector<Spike> spikes = find_spikes(surface);
/// A point is an outlier if
///     |h − median(h_n)| > threshold · max(s, s_0),
/// where h_n are its defined neighbours (three to eight), s is 1.4826 times the median of
/// |h_n − median(h_n)|, and s_0 is 1.4826 times the median over the surface of |h − median(h_n)|;
/// both are standard deviations for Gaussian heights. A spike consists of such a point and of all
/// neighbours beyond half of its height, if these are at most four. A step, a scratch or a summit
/// has more of them and is kept. With a threshold of 6, a fraction of 2·10⁻⁹ of a Gaussian surface
/// is mistaken for spikes. Throws InvalidInput unless threshold >= 3. Cost: two passes and a
/// selection; memory for a field.
std::vector<Spike> find_spikes(const Surface& surface, double threshold = 6);

/// Makes these points undefined.
void remove_spikes(Surface& surface, const std::vector<Spike>& spikes);

/// Returns the surface with the points of find_spikes() undefined.
Surface despiked(Surface surface, double threshold = 6);

}  // namespace salebra
