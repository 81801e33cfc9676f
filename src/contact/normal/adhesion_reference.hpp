// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/normal/adhesion.hpp>

namespace salebra::detail {

/// What the tolerance of an adhesive contact is relative to, max(E*·rms slope, φ'(0)), Pa. Collective.
double adhesion_reference(const Surface& surface, double contact_modulus, const Adhesion& adhesion);

}  // namespace salebra::detail
