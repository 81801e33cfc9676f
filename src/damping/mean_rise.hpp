// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::detail {

/// Mean stretch of sliding springs. Under δ = δ_min + u_z(1 − cosφ), a spring of depth ζ (it
/// touches at the indentation ζ) that never
/// opens slides at the mean stretch (μK/K_t)(m − ζ), where m does not depend on ζ. Returns (m −
/// δ_min)/u_z, which tends to πv/v_c as v → 0 and is 1 for v >= v_c. The springs at depth ζ lose
/// K_t' dζ times the mean stretch times the distance moved in a cycle. velocity_ratio: v/v_c > 0.
double mean_rise(double velocity_ratio);

}  // namespace salebra::detail
