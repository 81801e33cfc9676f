// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.hpp"

namespace salebra::cli {

/// What the assumptions of a damping constant need beyond contact and motion.
struct AssumptionOptions {
  std::optional<double> friction_coefficient, hardness, density, excursion;

  /// excursion_judged: offers --excursion, for commands that judge slip.
  void add_to(Command& command, bool excursion_judged = true);
  /// Throws InvalidInput for values that are not > 0. followed: the --friction of a command that
  /// follows it, which is the same coefficient.
  ContactParameters parameters(const MaterialOptions& material,
                     const std::optional<double>& followed = {}) const;
};

/// The assumptions of an answer: of one case, or of a list of them.
struct AssumptionReport {
  std::vector<Assumptions> cases = {};
  bool list = false;
  std::vector<double> pressures = {};  ///< of the cases of a study, Pa
  std::string body = {};               ///< that was judged, where it is not the one of the answer
  bool slip_followed = false;          ///< the loss is that with slip

  /// Adds the keys `validity`, `verdicts`, `assumptions`, `max_motion` and, where it is known or
  /// was looked for, `regime`; of another body `assumptions_of`.
  void add_to(Json& answer) const;
  /// Stands above the numbers of a contact that slides as a whole, and says so; else empty.
  std::string warning() const;
  /// The verdict and the verdicts behind it, to stand below the answer.
  std::string text() const;
  /// The answer with its assumptions, as JSON or text.
  void answer(Session& session, Json object, const std::string& text) const;
  void answer(Session& session, Json object) const;

 private:
  std::vector<AssumptionVerdict> all_verdicts() const;
};

}  // namespace salebra::cli
