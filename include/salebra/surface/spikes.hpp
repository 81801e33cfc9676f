// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// A point that stands alone: dust, or an instrument's mistake.
struct Spike {
  Index ix = 0, iy = 0;
  double height = 0;  ///< above the median of its neighbours, m; below it where negative
};

/// Points that no continuous surface holds, in the order of their rows. A point is far from its
/// surroundings where
///     |h − median(h_n)| > threshold · max(s, s_0),
/// h_n being its eight neighbours, those that are defined and three at least, s = 1.4826 times the
/// median of |h_n − median(h_n)|, and s_0 = 1.4826 times the median over the surface of
/// |h − median(h_n)|: both are standard deviations where heights are Gaussian. Such a point is a
/// spike with all points beside it that lie beyond half of its height, where these are four at most.
/// A step, a scratch or a summit has more of them and remains. Of a Gaussian surface a share of 2·10⁻⁹
/// is taken for spikes by a threshold of 6.
/// Throws InvalidInput unless threshold >= 3. Cost: two passes and a selection; memory: a field.
std::vector<Spike> find_spikes(const Surface& surface, double threshold = 6);

/// Makes these points undefined.
void remove_spikes(Surface& surface, const std::vector<Spike>& spikes);

/// The surface with find_spikes() undefined.
Surface despiked(Surface surface, double threshold = 6);

}  // namespace salebra
