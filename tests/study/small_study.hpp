// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/configuration.hpp>
#include <string>

/// Surfaces of 64 × 64 cells at 12 loads: some 20 ms each.
inline salebra::StudyConfiguration small_study(const std::string& more = "") {
  return salebra::parse_study_configuration(R"(
[surface]
points = 64
size_x = "4um"
hurst = 0.8
rolloff = "1um"
short_cutoff = "0.5um"
rms_height = "10nm"
seeds = [1, 2, 3]
[material]
contact_modulus = "10GPa"
poisson = 0.3
[contact]
relative_pressures = "1e-3:0.2:12"
tolerance = 1e-8
[damping]
normal_amplitude = "0.1nm"
drag_velocity = "1mm/s"
frequency = "20kHz"
)" + more,
                                            "small.toml");
}
