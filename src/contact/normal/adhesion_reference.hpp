// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/normal/adhesion.hpp>

namespace salebra::detail {

/// Unit of the tolerance of an adhesive contact, Pa: the larger of E* times the rms slope, and the
/// maximum tension φ'(0) of the adhesion. Collective.
double adhesion_reference(const Surface& surface, const Body& body, const Adhesion& adhesion);

}  // namespace salebra::detail
