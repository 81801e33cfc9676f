// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/study/study.hpp>

namespace salebra {

/// Writes results to one HDF5 file, whose groups xarray opens directly (realisation: one per
/// surface):
///
///     write_ensembles("study.h5", run_ensembles(study));
///
///   surface      statistics (realisation)
///   curve        every quantity of ForceSample (model, realisation, pressure), ensemble means with
///   limits (model, pressure)
///   local        local decay length (model, realisation, midpoint)
///   fit          decay length, its limits, area slope, … (model, realisation); ensemble means with
///   limits (model)
///   damping      law_…: Eq. (16); small_…: Eq. (15) with F'' of the curve; curve_…: the theorem on
///   the curve (model, realisation, pressure), deviation and ensemble means with limits (model,
///   pressure)
///   spots        contact patches of the boundary elements (realisation, pressure), by size (…,
///   min_cells)
///   flow         flow factors of the gaps (realisation, pressure), where configured
///   comparison   each model over the boundary elements on the same surfaces, means with limits
///   (model, pressure)
///   convergence  mean l/h_rms over the first surfaces, with limits (surfaces)
///   picture      of the first surface: heights and the smallest load that touches each point (x,
///   y), spectrum (wavenumber), distribution (height); maps hold every stride-th point, at most 512
///   per side
/// For several points of a parameter grid these groups are under points/0, points/1, …, and
/// `ensemble` has their parameters and main results (point). Attribute `study` of `surface` or
/// `ensemble` names the study (is_result_of). The configuration's text goes into the provenance.
/// Throws as ResultFile does, and for no results.
void write_ensembles(const std::filesystem::path& file, const std::vector<StudyResult>& results,
                     Provenance provenance = {}, const WriteOptions& options = {});

/// Whether the file is the finished result of this study, with all its surfaces, models and
/// settings: a study that was killed between the last byte and the removal of its parts need not
/// run again. False for any other file, and for none.
bool is_result_of(const std::filesystem::path& file, const StudyConfiguration& study);

/// Writes one point by write_ensembles().
void write_study(const std::filesystem::path& file, const StudyResult& result,
                 Provenance provenance = {}, const WriteOptions& options = {});

}  // namespace salebra
