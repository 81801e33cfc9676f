// SPDX-License-Identifier: GPL-3.0-or-later
// Map of the loss with friction divided by the loss in full stick, over the friction number M =
// μu_zK/(u_xK_t) and the phase.
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/trajectory_damping.hpp>

namespace salebra {

FrictionMap friction_map(const ContactLaw& law, double mean_indentation, double normal_amplitude,
                         double tangential_amplitude, const std::vector<double>& friction_numbers,
                         const std::vector<double>& phases, const FrictionMapOptions& options) {
  require_positive(normal_amplitude, "normal_amplitude");
  require_positive(tangential_amplitude, "tangential_amplitude");
  for (const double number : friction_numbers)
    require(number >= 0, "friction_number", number, "must be >= 0");
  for (const double phase : phases) require(std::isfinite(phase), "phase", phase, "must be finite");
  const auto rows = static_cast<Index>(friction_numbers.size());
  const auto columns = static_cast<Index>(phases.size());
  FrictionMap map{friction_numbers, phases, Field(rows, columns), Field(rows, columns),
                  Field(rows, columns)};
  const double friction_of_one =
      law.stiffness_ratio(mean_indentation) * tangential_amplitude / normal_amplitude;
  for (Index j = 0; j < columns; ++j) {
    const double phase = phases[static_cast<std::size_t>(j)];
    const SampledMotion path = sample(EqualFrequency{.normal_amplitude = normal_amplitude,
                                                     .tangential_amplitude = tangential_amplitude,
                                                     .phase = phase},
                                      mean_indentation, options.steps);
    double stick = trajectory_damping(law, path).work_per_cycle;
    if (std::abs(std::sin(phase)) < 1e-12) stick = std::numeric_limits<double>::quiet_NaN();
    parallel::for_slabs(rows, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const double number = friction_numbers[static_cast<std::size_t>(i)];
        const TrajectoryDamping rubbed =
            trajectory_damping(law, path, {.friction_coefficient = number * friction_of_one});
        map.loss_ratio(i, j) = rubbed.work_per_cycle / stick;
        map.relaxation_ratio(i, j) = rubbed.relaxation_work / stick;
        map.slip_ratio(i, j) = rubbed.slip_work / stick;
      }
    });
    const double done = static_cast<double>(j + 1) / static_cast<double>(columns);
    if (options.on_progress &&
        !options.on_progress({"friction map", done, static_cast<int>(j + 1), 0}))
      throw Interrupted("friction map: stopped before it was complete");
  }
  return map;
}

}  // namespace salebra
