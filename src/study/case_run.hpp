// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/study/study.hpp>
#include <vector>

#include "estimate.hpp"

namespace salebra::detail {

/// The seeds of a point; one, 0, for a measured surface.
std::vector<std::uint64_t> seeds_of(const StudyConfiguration& configuration);

/// The keys of all realisations of the study, over points and seeds in their order.
std::vector<std::uint64_t> keys_of(const std::vector<StudyConfiguration>& points);

/// Throws InvalidInput for a folder with parts none of which has one of these keys: they would be
/// passed over in silence, and days of work with them. Of one arithmetic are all or none: reading
/// one refuses them before any work.
void require_some_of(StudyParts& parts, const std::vector<StudyConfiguration>& points);

/// Makes the surface of the seed and analyses it. progress: of both, as analyse_realisation() reports
/// it. ranks: the processes over which the surface is spread; collective. Throws as both do.
Realisation realise(const StudyConfiguration& configuration, std::uint64_t seed,
                    const std::vector<double>& pressures, const Progress& progress,
                    const Communicator& communicator = {});

/// The rule by which a precision ends an ensemble.
class PrecisionRule {
 public:
  explicit PrecisionRule(const StudyConfiguration& configuration) : configuration_(configuration) {}
  /// Takes the next realisation, in the order of the seeds: whether those taken determine l/h_rms
  /// and κ to the precision requested.
  bool met_with(const Realisation& realisation);

 private:
  const StudyConfiguration& configuration_;
  const Bootstrap bootstrap_;
  std::vector<double> lengths_, slopes_;
};

/// The realisations of one point of the parameter grid, computed side by side and looked at in the
/// order of their seeds. result has configuration and pressures, and receives the rest. start: what
/// the whole run had finished before.
void run_case(StudyResult& result, const StudyRun& run, const RealisationReport& start);

}  // namespace salebra::detail
