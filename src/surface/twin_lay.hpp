// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "surface/twin_bins.hpp"

namespace salebra::twin_detail {

/// The lay that the maps among the scans have in common, found from the angular harmonics of their
/// periodograms in elliptic rings.
struct FoundLay {
  Lay lay;                       ///< stretch 1 unless the lay is significant (99 %)
  double log_stretch_error = 0;  ///< standard errors of ln of the stretch, and of the angle, rad
  double angle_error = 0;
  double greatest_stretch = std::numeric_limits<
      double>::quiet_NaN();        ///< 95 % limit of a lay that is not significant; NaN: unknown
  std::vector<bool> left_out;      ///< scans with another lay, and profiles of a surface with a lay
  std::vector<std::string> notes;  ///< why they are left out
};

/// Finds the lay of the scans. Wave numbers u in elliptic coordinates have the same area element as
/// q, so that u² = qᵀGq with det G = 1. With the true G, the power of the modes in a ring of u does
/// not depend on the direction φ in elliptic coordinates, which gives two estimating equations for
/// the two parameters of G: the second harmonics of the power over its mean vanish, but for what the
/// window adds. If G is wrong by ln of the stretch δ and by η = (s − 1/s)·(error of the angle), they
/// are pδ/4 and −pη/4 for a spectrum ∝ u^−p, which gives Newton's steps and the weights p·(number of
/// modes). Throws InvalidInput if the scans have two lays that cross, a lay whose stretch depends on
/// the wavelength, or differing lays.
FoundLay lay_of(const std::vector<ScanSpectrum>& scans);

/// The scan with its bins in elliptic wave numbers.
ScanSpectrum with_lay(const ScanSpectrum& scan, const Lay& lay);

}  // namespace salebra::twin_detail
