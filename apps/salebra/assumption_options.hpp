// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/figures/figure.hpp>
#include <salebra/results/assumption_verdicts.hpp>
#include <string>
#include <vector>

#include "options.hpp"

namespace salebra::cli {

/// Options for the contact parameters with which the assumptions of a damping constant are checked.
struct AssumptionOptions {
  std::optional<double> friction_coefficient, hardness, density, excursion;

  /// excursion_judged: whether to add --excursion, for commands that check for slip.
  void add_to(Command& command, bool excursion_judged = true);
  /// The contact parameters given by the options. Throws InvalidInput for values that are not > 0.
  /// followed: the coefficient of friction of --friction, if a command simulates slip with it; it
  /// is also used to check for slip.
  ContactParameters parameters(const MaterialOptions& material,
                               const std::optional<double>& followed = {}) const;
};

/// The assumptions of an answer, checked for one case or a list of cases.
struct AssumptionReport {
  std::vector<Assumptions> cases = {};
  bool list = false;
  std::vector<double> pressures = {};  ///< pressure of each case of a study, Pa
  /// Name of the body that was checked, if it is not that of the answer.
  std::string body = {};
  bool slip_followed = false;                  ///< whether the loss includes slip
  std::vector<AssumptionVerdict> others = {};  ///< on what Assumptions does not have

  /// Adds the keys `validity`, `verdicts`, `assumptions` and `max_motion`; `regime` if it is known
  /// or was requested; `assumptions_of` if another body was checked than that of the answer.
  void add_to(Json& answer) const;
  /// Adds the validity to the headlines of a figure.
  void state_in(figures::Figure& figure) const;
  /// A warning to print above the numbers if a contact slides as a whole; otherwise empty.
  std::string warning() const;
  /// The overall verdict and the line of each assumption, to print below the answer.
  std::string text() const;
  /// Prints the answer with its assumptions, as JSON or text.
  void answer(Session& session, Json object, const std::string& text) const;
  void answer(Session& session, Json object) const;

 private:
  std::vector<AssumptionVerdict> all_verdicts() const;
};

}  // namespace salebra::cli
