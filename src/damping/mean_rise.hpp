// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::detail {

/// (m − δ_min)/u_z, where levels ζ that never open slide at the mean stretch (μ/g)(m − ζ) under δ =
/// δ_min + u_z(1 − cosφ): what they lose in a cycle is K_t' dζ times this and the way.
/// velocity_ratio: v/v_c > 0. πv/v_c as v → 0, and 1 from v_c on.
double mean_rise(double velocity_ratio);

}  // namespace salebra::detail
