// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/study/study.hpp>
#include <vector>

#include "estimate.hpp"

namespace salebra::detail {

/// The seeds of a point of the parameter grid; for a measured surface only 0.
std::vector<std::uint64_t> seeds_of(const StudyConfiguration& configuration);

/// The keys of all realisations of the study, in the order of the points and their seeds.
std::vector<std::uint64_t> keys_of(const std::vector<StudyConfiguration>& points);

/// Throws InvalidInput if the folder has parts and none of them has one of the keys of the study.
/// Such parts, perhaps days of work, would otherwise be ignored silently. All parts of a folder
/// were computed with the same arithmetic, so reading one part is enough to refuse another
/// arithmetic before any work.
void require_some_of(StudyParts& parts, const std::vector<StudyConfiguration>& points);

/// Makes the surface of the seed and analyses it. progress: reports on both, as
/// analyse_realisation() does. communicator: the processes over which the surface is spread; all
/// must call. Throws as the generator and analyse_realisation() do.
Realisation realise(const StudyConfiguration& configuration, std::uint64_t seed,
                    const std::vector<double>& pressures, const Progress& progress,
                    const Communicator& communicator = {});

/// Decides when an ensemble has the requested precision.
class PrecisionRule {
 public:
  explicit PrecisionRule(const StudyConfiguration& configuration) : configuration_(configuration) {}
  /// Takes the next realisation in the order of the seeds. Returns whether the realisations taken
  /// so far determine the decay length l/h_rms and the area slope κ to the requested precision.
  bool met_with(const Realisation& realisation);

 private:
  const StudyConfiguration& configuration_;
  const Bootstrap bootstrap_;
  std::vector<double> lengths_, slopes_;
};

/// Computes the realisations of one point of the parameter grid in parallel, and takes them in the
/// order of their seeds. result: contains configuration and pressures, and receives the rest.
/// start: what the whole run had finished before this point.
void run_case(StudyResult& result, const StudyRun& run, const RealisationReport& start);

}  // namespace salebra::detail
