// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers by boundary elements of the surfaces of a study and of variants of it.
#include "boundary_element_numbers.hpp"

#include <salebra/base/error.hpp>

#include "base/special_values.hpp"
#include "base/task_pool.hpp"
#include "case_run.hpp"

namespace salebra::detail {
namespace {

// Makes a seed the second one of an ensemble: the first surface also has its numerical error and its
// picture, which nobody needs here.
void put_second(StudyConfiguration& configuration, std::uint64_t seed) {
  if (auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces))
    recipe->seeds = {~seed, seed};
}

BoundaryElementNumbers::OfSurface numbers_of(const Realisation& realisation) {
  BoundaryElementNumbers::OfSurface numbers;
  const ModelResult& bem = realisation.of(ContactModel::bem);
  for (std::size_t k = 0; k < bem.curve.samples.size(); ++k) {
    const ForceSample& sample = bem.curve.samples[k];
    const DampingPoint loss = k < bem.damping.size() ? bem.damping[k] : DampingPoint{};
    const std::array<double, BoundaryElementNumbers::outputs.size()> values{
        sample.mean_gap,         sample.contact_area_fraction,
        sample.normal_stiffness, sample.tangential_stiffness,
        loss.work_per_cycle,     loss.damping_constant};
    for (std::size_t output = 0; output < values.size(); ++output)
      numbers[output].push_back(sample.converged ? values[output] : unknown);
  }
  return numbers;
}

}  // namespace

BoundaryElementNumbers::BoundaryElementNumbers(const StudyConfiguration& configuration,
                                               const Progress& progress)
    : base_(configuration), progress_(progress) {
  require_that(configuration.ensemble.empty(), "ensemble",
               "gives several values of a parameter; give one of each");
  require_that(!configuration.adhesion, "adhesion",
               "given; sensitivities and designs are those of contacts without adhesion");
  const StudyLoads loads = study_loads(configuration);
  base_.pressures = loads.pressures;
  base_.relative_pressures = false;
  base_.models = {ContactModel::bem};
  base_.flow_factors = false;
  base_.conduction = {};
  base_.target_precision = base_.relative_error = 0;
  base_.seam = {};
  base_.window = {};
  if (!base_.intervals) base_.intervals = 4;  // as for several surfaces
  seeds_ = seeds_of(configuration);
  Surface first = study_surface(base_, seeds_.front());
  grid_ = first.grid;
  if (!base_.found_hold) base_.found_hold = hold_of(base_, first, base_.pressures.front());
  if (std::holds_alternative<MeasuredSurface>(base_.surfaces)) measured_ = std::move(first);
}

void BoundaryElementNumbers::set_seeds(std::vector<std::uint64_t> seeds) {
  seeds_ = std::move(seeds);
}

Surface BoundaryElementNumbers::surface(const StudyConfiguration& configuration,
                                        std::uint64_t seed) const {
  return measured_ ? *measured_ : study_surface(configuration, seed);
}

bool BoundaryElementNumbers::run(
    std::size_t tasks,
    const std::function<void(std::size_t task, const Progress& going_on)>& task) const {
  TaskLoop loop({.at_once = 0, .communicator = {}, .talk = [&] {
                   return !progress_ ||
                          progress_({.stage = "surfaces",
                                     .fraction = double(loop.finished()) / double(tasks),
                                     .step = loop.finished()});
                 }});
  const Progress going_on = [&](const ProgressReport&) { return loop.going_on(); };
  try {
    loop.run(Index(tasks), [&](Index turn) { task(std::size_t(turn), going_on); });
  } catch (const Interrupted&) {
    return false;
  }
  return !loop.stopped();
}

std::vector<std::vector<BoundaryElementNumbers::OfSurface>> BoundaryElementNumbers::of(
    const std::vector<StudyVariant>& variants) const {
  if (variants.empty()) return {};
  std::vector<std::vector<OfSurface>> numbers(variants.size(),
                                              std::vector<OfSurface>(seeds_.size()));
  const bool finished =
      run(variants.size() * seeds_.size(), [&](std::size_t task, const Progress& going_on) {
        const std::size_t v = task / seeds_.size(), s = task % seeds_.size();
        StudyConfiguration configuration = variants[v].configuration;
        put_second(configuration, seeds_[s]);
        Surface surface = this->surface(configuration, seeds_[s]);
        if (variants[v].surface) surface = variants[v].surface(std::move(surface));
        numbers[v][s] = numbers_of(analyse_realisation(std::move(surface), configuration, seeds_[s],
                                                       configuration.pressures, going_on));
      });
  return finished ? numbers : std::vector<std::vector<OfSurface>>{};
}

}  // namespace salebra::detail
