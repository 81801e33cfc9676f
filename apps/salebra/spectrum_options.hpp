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

/// The power spectral density of a random surface: self-affine, of a correlation function, or from
/// a table; stretched or not.
struct SpectrumOptions {
  std::optional<double> hurst, long_cutoff, rolloff, short_cutoff, rms_height, rms_slope,
      correlation_length, stretch_along, stretch_across, lay_angle;
  std::string table, convention = "salebra", correlation;

  void add_to(Command& app);
  bool given() const { return hurst || !table.empty() || !correlation.empty(); }
  /// cell: the longest period of the surface, m; no wave of a self-affine one is longer, unless a
  /// limit is given.
  std::shared_ptr<const Spectrum> spectrum(double cell) const;
  SelfAffineProfileSpectrum profile_spectrum(double cell) const;
  /// Peklenik's number and the lay, where the surface is stretched; else null.
  Json anisotropy() const;

 private:
  SelfAffineParameters self_affine(double cell) const;
  std::shared_ptr<const IsotropicSpectrum> isotropic(double cell) const;
  std::shared_ptr<const IsotropicSpectrum> tabulated() const;
};

}  // namespace salebra::cli
