// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>

// A sinusoidal surface closes at Westergaard's pressure, πE*·amplitude/wavelength: one wave, which
// the grid has exactly. Touches a compiled function of salebra::salebra, and FFTW behind
// salebra::base.
int main() {
  const auto material = salebra::Material::of_contact_modulus(115e9, 0.3);
  const salebra::Grid2D grid{64, 64, 1e-3, 1e-3};
  salebra::Surface surface{grid, salebra::Field(64, 64)};
  for (salebra::Index i = 0; i < 64; ++i)
    surface.heights.row(i) = 1e-6 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / 64);
  const double closing = std::numbers::pi * material.contact_modulus * 1e-6 / 1e-3;
  const auto state =
      salebra::press(surface, material.contact_modulus, salebra::at_pressure(1.01 * closing));
  std::printf("area fraction %.4f, mean gap %.3g m\n", state.contact_area_fraction, state.mean_gap);
  return state.converged() && state.contact_area_fraction == 1 ? 0 : 1;
}
