// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/study/study.hpp>

namespace salebra {

/// Writes results to one HDF5 file, whose groups xarray opens directly. Names in parentheses are
/// the dimensions of the datasets (realisation: one entry per surface; limits: 95 % interval):
///
///     write_ensembles("study.h5", run_ensembles(study));
///
///   surface      statistics of the surfaces (realisation)
///   curve        every quantity of ForceSample (model, realisation, pressure), ensemble means with
///                limits (model, pressure)
///   local        local decay length (model, realisation, midpoint)
///   fit          decay length, its limits, area slope and further columns of ModelResult (model,
///                realisation); ensemble means with limits (model)
///   damping      law_*: by Eq. (16); small_*: by Eq. (15) with F'' of the curve; curve_*: by
///                relaxation_damping() with the curve (model, realisation, pressure); deviation and
///                ensemble means with limits (model, pressure)
///   spots        contact patches of the boundary elements (realisation, pressure), by size
///                (realisation, pressure, min_cells)
///   flow         flow factors of the gaps (realisation, pressure), if configured
///   comparison   ratio of each model to the boundary elements on the same surfaces, means with
///                limits (model, pressure)
///   convergence  mean l/h_rms over the first surfaces, with limits (surfaces)
///   picture      of the first surface: heights and the smallest load that touches each point (x,
///                y), spectrum (wavenumber), distribution (height); maps hold every stride-th
///                point, at most 512 per side
/// For several points of a parameter grid these groups are in one group per point (points/0,
/// points/1 and so on), and `ensemble` has the parameters and main results of all points (point).
/// The attribute `study` of `surface` or `ensemble` identifies the study for is_result_of(). The
/// configuration's text goes into the provenance. Throws wherever ResultFile does, and InvalidInput
/// for an empty list of results.
void write_ensembles(const std::filesystem::path& file, const std::vector<StudyResult>& results,
                     Provenance provenance = {}, const WriteOptions& options = {});

/// Whether the file is the finished result of this study, with all its surfaces, models and
/// settings. If so, a study that was killed after its result was written, but before its parts were
/// removed, need not run again. False for any other file, and if there is no file.
bool is_result_of(const std::filesystem::path& file, const StudyConfiguration& study);

/// Writes the result of a single point by write_ensembles().
void write_study(const std::filesystem::path& file, const StudyResult& result,
                 Provenance provenance = {}, const WriteOptions& options = {});

}  // namespace salebra
