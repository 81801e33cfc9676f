// SPDX-License-Identifier: GPL-3.0-or-later
// Losses along a sampled path, from a file or of a motion with finite friction.
#include "follow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/io/number_table.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/columns.hpp>
#include <salebra/results/quantity_group.hpp>

#include "figures.hpp"
#include "premise_options.hpp"

namespace salebra::cli {

void FollowOptions::add_to(Command& app) {
  const std::string group = "Friction and measured motion";
  add_quantity(app, "--friction", friction_coefficient, Dimension::dimensionless,
               "coefficient; without it full stick")
      ->group(group);
  app.add_option("--steps", steps, "straight steps a cycle where friction is followed")
      ->range(8, 10000000)
      ->group(group);
  app.add_option("--trajectory", trajectory,
                 "follow one period from a file of time, indentation, x and, without slip, y (SI)")
      ->file(FileUse::input)
      ->group(group);
}

double FollowOptions::coefficient() const {
  if (friction_coefficient)
    require(*friction_coefficient >= 0, "--friction", *friction_coefficient, "must be >= 0");
  return friction_coefficient.value_or(std::numeric_limits<double>::infinity());
}

DampingResult damping_of(const ContactLaw& law, const Position& position, const Motion& motion,
                         const DampingOptions& options) {
  return std::visit([&](const auto& m) { return relaxation_damping(law, position, m, options); },
                    motion);
}

SampledMotion sampled(const Motion& motion, double mean_indentation, int steps) {
  return std::visit([&](const auto& m) { return sample(m, mean_indentation, steps); }, motion);
}

TrajectoryDamping follow(const ContactLaw& law, const Motion& motion, const SampledMotion& path,
                         double friction, const Progress& on_progress) {
  TrajectoryDamping loss =
      trajectory_damping(law, path, {.friction_coefficient = friction, .on_progress = on_progress});
  const auto* equal = std::get_if<EqualFrequency>(&motion);
  if (equal != nullptr && !(equal->angular_frequency > 0))
    loss.power = loss.damping_constant = std::numeric_limits<double>::quiet_NaN();
  return loss;
}

void follow_file(const FollowOptions& options, const ContactLaw& law, const ContactFacts& facts,
                 Session& session) {
  const auto columns = read_number_table(options.trajectory, 3, 4);
  const SampledMotion path{columns[0], columns[1], columns[2]};
  const bool transverse = columns.size() > 3;
  require(!transverse || !options.friction_coefficient, "--friction",
          options.friction_coefficient.value_or(0),
          "cannot be combined with a trajectory in two directions, whose slip is not followed; "
          "leave it out, or the fourth column");
  const TrajectoryDamping loss =
      transverse ? trajectory_damping(law, path, columns[3])
                 : trajectory_damping(law, path,
                                      {.friction_coefficient = options.coefficient(),
                                       .on_progress = session.progress()});
  const Json object = json_of(loss);
  const double middle =
      0.5 * (std::ranges::min(path.indentation) + std::ranges::max(path.indentation));
  PremiseReport premises{{premises_of(law, path, at_state(facts, law, nullptr, middle))}};
  if (transverse) {
    // Slip is judged along x alone, where it is one of the vector.
    Premises& judged = premises.cases.front();
    judged.slip_of_opening_levels = judged.slip_of_closed_levels = {};
    judged.largest.clear();
    judged.regime = Regime::unknown;
  }
  if (session.has_output()) {
    ResultFile file(session.output(), session.provenance(), session.write_options());
    QuantityGroup group(file.group("trajectory"));
    group.coordinate("time", path.time);
    group.dataset("indentation", path.indentation, {"time"});
    group.dataset("tangential", path.displacement, {"time"});
    group.dataset("tangential_force", loss.tangential_force, {"time"});
    if (transverse) {
      group.dataset("transverse", columns[3], {"time"});
      group.dataset("transverse_force", loss.transverse_force, {"time"});
    }
    group.dataset("dissipated", loss.dissipated, {"time"});
    file.commit();
  }
  session.plot(cycle_figure(path, loss));
  premises.answer(session, object);
}

}  // namespace salebra::cli
