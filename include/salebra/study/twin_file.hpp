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

/// Several scans of one surface, and the file of the surface twin made from them.
namespace salebra {

/// A scan and its instrument.
struct TwinMeasurement {
  MeasuredSurface surface;
  ScanInstrument instrument;
  double weight = 1;  ///< > 0; number of scans of its kind that it counts as
};

/// Reads a TOML file of tables [[measurement]], with the keys of a measured surface in a study file
/// and
///     instrument          ideal, optical, stylus or afm
///     resolution          for optical ones, full width at half maximum
///     tip_radius          for stylus and afm
///     noise, height_calibration, scan_calibration, line_drift, weight
///     name                of the instrument, where two of one kind differ in calibration
/// throws  InvalidInput "FILE:LINE: measurement.key: …" as read_study_configuration(), and for no
///         measurement
std::vector<TwinMeasurement> read_twin_measurements(const std::filesystem::path& file);

/// Computes the spectra of the scans, reading one after the other so that only one is in memory.
/// Throws as read_surface() and scan_spectrum(); Interrupted.
std::vector<ScanSpectrum> spectra_of(const std::vector<TwinMeasurement>& measurements,
                                     const Progress& progress = {},
                                     std::vector<std::string>* warnings = nullptr);

/// Fits a surface twin: fit_twin() of spectra_of(). Throws as they do.
///
///     SurfaceTwin twin = twin_of(read_twin_measurements("scans.toml"));
SurfaceTwin twin_of(const std::vector<TwinMeasurement>& measurements,
                    const TwinOptions& options = {}, const Progress& progress = {},
                    std::vector<std::string>* warnings = nullptr);

/// Writes an HDF5 file with the group `twin`: parameters with their limits, `twin/spectrum` with
/// its band, `twin/draws`.
void write_twin(const std::filesystem::path& file, const SurfaceTwin& twin,
                const Provenance& provenance, const WriteOptions& options = {});

/// Reads the draws of such a file. Throws InvalidInput naming the file if it is of another kind.
std::vector<TwinDraw> read_twin_draws(const std::filesystem::path& file);

/// Returns the spectra of a twin for GeneratedSurfaces::tables on a grid: first the draw of median
/// slope, then every draw, from half the smallest wave number of the grid to its Nyquist wave
/// number.
std::vector<SpectrumTable> tables_of(const std::vector<TwinDraw>& draws, const Grid2D& grid);

}  // namespace salebra
