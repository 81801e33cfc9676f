// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/progress.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/surface/twin.hpp>
#include <string>
#include <vector>

/// Several scans of one surface: their list, and the file of the surface twin that they make.
namespace salebra {

/// A scan, and what it was made with.
struct TwinMeasurement {
  MeasuredSurface surface;
  ScanInstrument instrument;
  double weight = 1;  ///< > 0; how many scans of its kind it counts as
};

/// Reads a TOML file of tables [[measurement]]: the keys of a measured surface in a study file, and
///     instrument          ideal, optical, stylus or afm
///     resolution          of optical ones, full width at half maximum
///     tip_radius          of stylus and afm
///     noise, height_calibration, scan_calibration, line_drift, weight
///     name                of the instrument, where two of one kind differ in calibration
/// throws  InvalidInput "FILE:LINE: measurement.key: …" as read_study_configuration(), and for no
///         measurement
std::vector<TwinMeasurement> read_twin_measurements(const std::filesystem::path& file);

/// Reads one scan after the other, so that one is in memory at a time. Throws as read_surface() and
/// scan_spectrum(); Interrupted.
std::vector<ScanSpectrum> spectra_of(const std::vector<TwinMeasurement>& measurements,
                                     const Progress& progress = {},
                                     std::vector<std::string>* remarks = nullptr);

/// fit_twin() of spectra_of(), and throws as they do.
SurfaceTwin twin_of(const std::vector<TwinMeasurement>& measurements,
                    const TwinOptions& options = {}, const Progress& progress = {},
                    std::vector<std::string>* remarks = nullptr);

/// An HDF5 file with the group `twin`: parameters with their limits, `twin/spectrum` with its band,
/// `twin/draws`.
void write_twin(const std::filesystem::path& file, const SurfaceTwin& twin,
                const Provenance& provenance, const WriteOptions& options = {});

/// The draws of such a file. Throws InvalidInput naming the file where it is another.
std::vector<TwinDraw> read_twin_draws(const std::filesystem::path& file);

/// What a study takes of a twin on a grid, for GeneratedSurfaces::tables: first the draw of median
/// slope, then every draw, from half the least wave number of the grid to its Nyquist wave number.
std::vector<SpectrumTable> tables_of(const std::vector<TwinDraw>& draws, const Grid2D& grid);

}  // namespace salebra
