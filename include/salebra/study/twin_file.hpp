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
  double weight = 1;  ///< > 0; number of scans that this one represents
};

/// Reads a TOML file of tables [[measurement]], with the keys of a measured surface in a study file
/// and
///     instrument          ideal, optical, stylus or afm
///     resolution          of an optical instrument, full width at half maximum
///     tip_radius          for stylus and afm
///     noise, height_calibration, scan_calibration, line_drift, weight
///     name                of the instrument, needed if two instruments of one kind have their own
///                         calibrations
/// throws  InvalidInput, whose message starts with "FILE:LINE: measurement.key", as
///         read_study_configuration() does, and for a file without a measurement
std::vector<TwinMeasurement> read_twin_measurements(const std::filesystem::path& file);

/// Computes the spectra of the scans, reading one scan after the other so that only one is in
/// memory. Throws wherever read_surface() and scan_spectrum() do; Interrupted.
std::vector<ScanSpectrum> spectra_of(const std::vector<TwinMeasurement>& measurements,
                                     const Progress& progress = {},
                                     std::vector<std::string>* warnings = nullptr);

/// Fits a surface twin by fit_twin() to the spectra of spectra_of(). Throws wherever these
/// functions do.
///
///     SurfaceTwin twin = twin_of(read_twin_measurements("scans.toml"));
SurfaceTwin twin_of(const std::vector<TwinMeasurement>& measurements,
                    const TwinOptions& options = {}, const Progress& progress = {},
                    std::vector<std::string>* warnings = nullptr);

/// Writes an HDF5 file with the group `twin`: parameters with their limits, `twin/spectrum` with
/// its band, `twin/draws`.
void write_twin(const std::filesystem::path& file, const SurfaceTwin& twin,
                const Provenance& provenance, const WriteOptions& options = {});

/// Reads the draws of a surface twin from a file of write_twin(). Throws InvalidInput, whose
/// message names the file, for another kind of file.
std::vector<TwinDraw> read_twin_draws(const std::filesystem::path& file);

/// Returns the spectra of a twin for GeneratedSurfaces::tables on a grid: first the draw whose rms
/// slope is the median, then all draws, from half the smallest wave number of the grid to its
/// Nyquist wave number.
std::vector<SpectrumTable> tables_of(const std::vector<TwinDraw>& draws, const Grid2D& grid);

/// Returns the textures that belong to tables_of(), for GeneratedSurfaces::textures.
std::vector<SurfaceTexture> textures_of(const std::vector<TwinDraw>& draws);

}  // namespace salebra
