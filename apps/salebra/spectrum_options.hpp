// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/generators/profile.hpp>
#include <salebra/generators/spectrum.hpp>
#include <string>

#include "command.hpp"
#include "session.hpp"

namespace salebra::cli {

/// Options for the power spectral density of a random surface: self-affine, from a correlation
/// function or from a table; isotropic or stretched along a direction.
struct SpectrumOptions {
  std::optional<double> hurst, long_cutoff, rolloff, short_cutoff, rms_height, rms_slope,
      correlation_length, stretch_along, stretch_across, lay_angle;
  std::string table, convention = "salebra", correlation;

  void add_to(Command& app);
  bool given() const { return hurst || !table.empty() || !correlation.empty(); }
  /// cell: length of the period of the surface, m. It is the longest wavelength of a self-affine
  /// spectrum if no long cut-off is given.
  std::shared_ptr<const Spectrum> spectrum(double cell) const;
  SelfAffineProfileSpectrum profile_spectrum(double cell) const;
  /// JSON of the anisotropy of a stretched surface (Peklenik's number and direction of the lay);
  /// null for an isotropic one.
  Json anisotropy() const;

 private:
  SelfAffineParameters self_affine(double cell) const;
  std::shared_ptr<const IsotropicSpectrum> isotropic(double cell) const;
  std::shared_ptr<const IsotropicSpectrum> tabulated() const;
};

}  // namespace salebra::cli
