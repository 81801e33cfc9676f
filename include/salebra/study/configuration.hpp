// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/fit.hpp>
#include <salebra/contact/material.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/surface/detrend.hpp>
#include <string>
#include <variant>
#include <vector>

namespace salebra {

enum class GenerationMethod { filtered_noise, random_phase };

/// An ensemble of self-affine surfaces, one for each seed.
struct GeneratedSurfaces {
  Grid2D grid;
  SelfAffineParameters spectrum;
  GenerationMethod method = GenerationMethod::filtered_noise;
  std::vector<std::uint64_t> seeds;  ///< at least one
};

/// One surface from a file.
struct MeasuredSurface {
  std::filesystem::path file;
  std::optional<double> size_x, size_y;  ///< m, for files that do not know their size
  std::optional<Detrend> detrend;        ///< empty: as is customary for the kind of surface
  std::string height_unit;               ///< such as "nm", for files that do not name one; empty: m
};

/// Everything that decides the result of a study.
struct StudyConfiguration {
  std::variant<GeneratedSurfaces, MeasuredSurface> surfaces;
  Material material;  ///< with G*
  std::vector<double>
      pressures;  ///< of the BEM sweep, increasing: Pa, or in units of E*h'_rms if relative
  bool relative_pressures = false;
  double tolerance = 1e-8;  ///< e_c of each contact
  /// K_t of the boundary-element curve by a stick solve on each contact; false: (G*/E*)K. Moduli that no elastic body has leave
  /// only the latter.
  bool stick = true;
  std::optional<PressureWindow>
      window;  ///< of the exponential fit; empty: 1 … 2.5 h_rms in mean gap
  Oscillation motion;
  DampingOptions damping;
  std::string text;  ///< the file as it was read, for provenance
};

/// Reads a TOML file; README of data/ explains each key by example. Lengths, pressures and so on are numbers in SI units or
/// strings with a unit.
/// throws  InvalidInput "FILE:LINE: table.key: …" for an unknown key, a missing one, a wrong type or a value out of range
StudyConfiguration read_study_configuration(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in errors, relative paths are taken from `folder`.
StudyConfiguration parse_study_configuration(const std::string& text, const std::string& name,
                                             const std::filesystem::path& folder = ".");

/// `file` in place of the surfaces of the configuration, which keeps everything else.
StudyConfiguration with_surface(StudyConfiguration configuration, MeasuredSurface surface);

}  // namespace salebra
