// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <salebra/base/fft.hpp>
#include <salebra/contact/half_space/material.hpp>

// Touches a header-only type, a compiled function of salebra::salebra, and FFTW behind
// salebra::base.
int main() {
  const auto material = salebra::Material::of_contact_modulus(115e9, 0.3);
  salebra::Field field = salebra::Field::Constant(4, 4, 1.0);
  Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> modes(4, 3);
  salebra::RealFft2D<double>(4, 4).forward(field.data(), modes.data());
  std::printf("G*/E* = %.4f, sum = %.0f\n", material.modulus_ratio(), modes(0, 0).real());
  const bool right = std::abs(material.modulus_ratio() - 1.4 / 1.7) < 1e-12 &&
                     std::abs(modes(0, 0).real() - 16) < 1e-12;
  return right ? 0 : 1;
}
