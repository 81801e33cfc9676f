// SPDX-License-Identifier: GPL-3.0-or-later
// Result file of a study, and whether an existing file holds the same study.
#include <fmt/format.h>

#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/study/study_file.hpp>

#include "realisation_record.hpp"
#include "study_groups.hpp"

namespace salebra {
namespace {

std::string key_text(const std::vector<StudyConfiguration>& points) {
  return fmt::format("{:016x}", detail::study_key(points));
}

}  // namespace

bool is_result_of(const std::filesystem::path& file, const StudyConfiguration& study) {
  if (!std::filesystem::is_regular_file(file)) return false;
  try {
    const ResultReader reader(file);
    const std::string key = key_text(parameter_combinations(study));
    for (const char* group : {"surface", "ensemble"})
      if (reader.has(group) && reader.text_attribute(group, "study") == key) return true;
  } catch (const InvalidInput&) {
    // Some other file.
  }
  return false;
}

void write_ensembles(const std::filesystem::path& file, const std::vector<StudyResult>& results,
                     Provenance provenance, const WriteOptions& options) {
  require_that(!results.empty(), "study", "no surface was finished; there is nothing to write");
  provenance.configuration = results.front().configuration.text;
  if (!results.front().realisations.empty())
    provenance.seed = results.front().realisations.front().seed;
  ResultFile output(file, provenance, options);
  std::vector<StudyConfiguration> points;
  for (const StudyResult& result : results) points.push_back(result.configuration);
  if (results.size() == 1) {
    detail::write_study_groups(output, "", results.front());
    output.group("surface").attribute("study", key_text(points));
  } else {
    ResultGroup overview = output.group("ensemble");
    detail::write_study_overview(overview, results);
    overview.attribute("study", key_text(points));
    for (std::size_t i = 0; i < results.size(); ++i)
      detail::write_study_groups(output, "points/" + std::to_string(i) + "/", results[i]);
  }
  output.commit();
}

void write_study(const std::filesystem::path& file, const StudyResult& result,
                 Provenance provenance, const WriteOptions& options) {
  write_ensembles(file, {result}, std::move(provenance), options);
}

}  // namespace salebra
