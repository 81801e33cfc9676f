// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/law.hpp>
#include <vector>

namespace salebra::detail {

/// Returns, in increasing order, low, the indentations between low and high at which the law is not
/// smooth, and high. These are the break points of the law, and first touch if F becomes 0 between
/// low and high. If there are more than a few hundred break points, none is returned: such a law is
/// as good as smooth.
std::vector<double> sweep_breaks(const ContactLaw& law, double low, double high);

}  // namespace salebra::detail
