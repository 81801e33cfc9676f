// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra {

/// The direction of the profiles that a surface is cut into.
enum class Axis { x, y };

}  // namespace salebra
