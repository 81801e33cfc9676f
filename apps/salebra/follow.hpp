// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/premises.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <string>

#include "options.hpp"

namespace salebra::cli {

/// Following a path step by step: from a file, or because friction makes the loss depend on its
/// history.
struct FollowOptions {
  std::optional<double> friction_coefficient;
  std::string trajectory;
  int steps = 2000;

  void add_to(Command& app);
  /// μ; infinite where it was not given.
  double coefficient() const;
};

/// What stays of a motion when it meets the law: the same for any of its kinds.
DampingResult damping_of(const ContactLaw& law, const Position& position, const Motion& motion,
                         const DampingOptions& options = {});
/// One period, `steps` for each normal cycle. Throws InvalidInput where there is none.
SampledMotion sampled(const Motion& motion, double mean_indentation, int steps);

/// The loss along a sampled motion; power and damping constant are NaN where its frequency is not
/// known.
TrajectoryDamping follow(const ContactLaw& law, const Motion& motion, const SampledMotion& path,
                         double friction, const Progress& on_progress);

/// --trajectory: reads one period of (time, indentation, displacement), answers, writes --output
/// and --plot.
void follow_file(const FollowOptions& options, const ContactLaw& law, const ContactFacts& facts,
                 Session& session);

}  // namespace salebra::cli
