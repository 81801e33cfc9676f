// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

/// [material], [contact] and [damping] of a small study; loads: their number, from light contact to
/// a fifth of E*h'.
inline std::string contact_text(int loads = 10) {
  return R"([material]
contact_modulus = "10GPa"
poisson = 0.3
[contact]
relative_pressures = "1e-3:0.2:)" +
         std::to_string(loads) + R"("
tolerance = 1e-8
[damping]
normal_amplitude = "0.1nm"
drag_velocity = "1mm/s"
frequency = "20kHz"
)";
}

/// A study of surfaces of 64 × 64 cells, with eight cells to the shortest wave and four roll-offs
/// per side; a surface takes some 20 ms at a dozen loads.
inline std::string study_text(const std::string& seeds = "seeds = [1, 2, 3]", int loads = 10) {
  return R"([surface]
points = 64
size_x = "4um"
hurst = 0.8
rolloff = "1um"
short_cutoff = "0.5um"
rms_height = "10nm"
)" + seeds +
         "\n" + contact_text(loads);
}

/// A study of a soft adhesive body, with a cycle.
inline std::string adhesive_study_text() {
  std::string text = study_text("seeds = [1, 2, 3]", 5);
  text.resize(text.find("[damping]"));
  return text.replace(text.find("10GPa"), 5, "10MPa") + R"([adhesion]
work_of_adhesion = "10mJ/m2"
range = "20nm"
cycle = "400nm:5nm:14"
)";
}

/// The study at loads so high that no mean gap exceeds the rms height, so there is nothing to fit a
/// decay length to.
inline std::string close_study_text() {
  std::string text = study_text("seeds = [1, 2]", 5);
  const std::string usual = "1e-3:0.2:5";
  return text.replace(text.find(usual), usual.size(), "0.2:1:5");
}
