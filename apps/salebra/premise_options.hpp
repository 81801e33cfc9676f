// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.hpp"

namespace salebra::cli {

/// What the premises of a damping constant need beyond contact and motion.
struct PremiseOptions {
  std::optional<double> friction_coefficient, hardness, density, excursion;

  /// excursion_judged: offers --excursion, for commands that judge slip.
  void add_to(Command& command, bool excursion_judged = true);
  /// Throws InvalidInput for values that are not > 0. followed: the --friction of a command that
  /// follows it, which is the same coefficient.
  ContactFacts facts(const MaterialOptions& material,
                     const std::optional<double>& followed = {}) const;
};

/// The premises of an answer: of one case, or of a list of them.
struct PremiseReport {
  std::vector<Premises> cases = {};
  bool list = false;
  std::vector<double> pressures = {};  ///< of the cases of a study, Pa
  std::string body = {};               ///< that was judged, where it is not the one of the answer
  bool slip_followed = false;          ///< the loss is that with slip

  /// Adds the keys `validity`, `conditions`, `premises`, `largest_motion` and, where it is known or
  /// was looked for, `regime`; of another body `premises_of`.
  void add_to(Json& answer) const;
  /// Stands above the numbers of a contact that slides as a whole, and says so; else empty.
  std::string warning() const;
  /// The verdict and the conditions behind it, to stand below the answer.
  std::string text() const;
  /// The answer with its premises, as JSON or text.
  void answer(Session& session, Json object, const std::string& text) const;
  void answer(Session& session, Json object) const;

 private:
  std::vector<Condition> all_conditions() const;
};

}  // namespace salebra::cli
