// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/study/study.hpp>

namespace salebra {

/// The models of a study under the names that files and JSON have for them.
struct StudyModel {
  const char* name;
  ModelResult Realisation::*result;
};
inline constexpr std::array study_models{
    StudyModel{"bem", &Realisation::bem}, StudyModel{"gw_moments", &Realisation::gw_moments},
    StudyModel{"gw_deterministic", &Realisation::gw_deterministic}};

/// One HDF5 file, each group of which xarray opens as it is (realisation: one per surface):
///   surface   statistics (realisation)
///   curve     every quantity of ForceSample (model, realisation, pressure); local_decay_length (model, realisation, midpoint)
///   fit       decay length, its limits, … (model, realisation); ensemble means with limits (model)
///   damping   Eq. (16) as law_…, the result from the BEM curve as curve_… (realisation, pressure), deviation and ensemble
///             means with limits (pressure)
/// The configuration's text goes into the provenance. Throws as ResultFile does.
void write_study(const std::filesystem::path& file, const StudyResult& result,
                 Provenance provenance = {}, const WriteOptions& options = {});

}  // namespace salebra
