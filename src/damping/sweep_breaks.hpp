// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/law.hpp>
#include <vector>

namespace salebra::detail {

/// [low, the indentations between at which the law is not smooth, high], increasing: its own break
/// points, and first touch where F becomes 0 within the sweep. More than a few hundred break points
/// are left out: between so many a law is as good as smooth.
std::vector<double> sweep_breaks(const ContactLaw& law, double low, double high);

}  // namespace salebra::detail
