// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <salebra/base/progress.hpp>
#include <salebra/study/study.hpp>
#include <string_view>
#include <vector>

namespace salebra::detail {

// A study with something changed: another configuration, and where given another surface in place of
// each of its own.
struct StudyVariant {
  StudyConfiguration configuration;
  std::function<Surface(Surface)> surface = {};
};

// The numbers by boundary elements of single surfaces of a study and of variants of it.
class BoundaryElementNumbers {
 public:
  static constexpr std::array<std::string_view, 6> outputs{
      "mean_gap",       "contact_area_fraction", "normal_stiffness", "tangential_stiffness",
      "work_per_cycle", "damping_constant"};
  using OfSurface = std::array<std::vector<double>, outputs.size()>;  // at each pressure

  // Throws InvalidInput for a parameter grid and for adhesion, and wherever study_loads() does.
  BoundaryElementNumbers(const StudyConfiguration& configuration, const Progress& progress);

  // The study as it is computed: pressures in Pa, boundary elements alone, and the mean value that
  // the motion keeps on the first surface.
  const StudyConfiguration& base() const { return base_; }
  const Grid2D& grid() const { return grid_; }
  Index surfaces() const { return Index(seeds_.size()); }
  void set_seeds(std::vector<std::uint64_t> seeds);
  const std::vector<std::uint64_t>& seeds() const { return seeds_; }

  // The surface of a seed with a configuration.
  Surface surface(const StudyConfiguration& configuration, std::uint64_t seed) const;
  // Runs tasks in parallel, each with a progress that says whether to go on. Returns false if the
  // progress of the study said stop.
  bool run(std::size_t tasks,
           const std::function<void(std::size_t task, const Progress& going_on)>& task) const;
  // Numbers of each surface (second index) of each variant; those of contacts that did not converge
  // are NaN. Empty if progress says stop, or without variants. In parallel over all; same bits for
  // any number of threads.
  std::vector<std::vector<OfSurface>> of(const std::vector<StudyVariant>& variants) const;

 private:
  StudyConfiguration base_;
  Grid2D grid_;
  std::optional<Surface> measured_;  // read once; empty for generated surfaces
  std::vector<std::uint64_t> seeds_;
  Progress progress_;
};

}  // namespace salebra::detail
