// SPDX-License-Identifier: GPL-3.0-or-later
// RMS height, RMS slope and Nayak's parameter from the spectral moments.
#include <cmath>
#include <salebra/base/spectral_moments.hpp>

namespace salebra {

double SpectralMoments::rms_height() const { return std::sqrt(moment0); }
double SpectralMoments::rms_slope() const { return std::sqrt(moment2_x + moment2_y); }
double SpectralMoments::nayak() const { return moment0 * moment4() / (moment2() * moment2()); }

}  // namespace salebra
