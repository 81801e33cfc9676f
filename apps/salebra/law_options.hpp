// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/contact.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "indenter_options.hpp"
#include "options.hpp"

namespace salebra::cli {

/// Options for a contact law, a force curve from a file or a surface, and for the operating point.
struct LawOptions {
  IndenterOptions indenter;  ///< --law: exponential or the shape of an indenter
  std::string curve;
  SurfaceOptions surface;
  OperatingPointsOptions at;
  std::optional<double> decay_length;

  void add_to(Command& command);
  /// The contact that the options describe, with its operating points. Throws InvalidInput if an
  /// option is missing or does not fit the others. Reads the file of a surface. direction: value of
  /// --direction; empty for a command without this option, which takes motion along x.
  ContactProblem problem(const MaterialOptions& material, Session& session,
                         const std::optional<double>& hardness,
                         const std::string& direction = "") const;
  /// Solves problem() and prints the warnings of the solutions, one for each direction.
  std::vector<ContactSolution> contacts(const MaterialOptions& material, Session& session,
                                        const std::optional<double>& hardness,
                                        double normal_amplitude, Hold hold,
                                        const std::string& direction) const;
  /// The contact without operating points, for a motion that has its own indentations.
  /// --normal-force of the exponential law is then the force at indentation 0.
  ContactProblem problem_of_law(const MaterialOptions& material) const;
  bool of_indenter() const {
    return !indenter.law.empty() && indenter.law != "exponential" && curve.empty() &&
           !surface.given();
  }

 private:
  /// Throws InvalidInput for a parameter that the chosen law does not have.
  void require_own_parameters() const;
  /// The contact that the options describe, with its operating points or (points false) without
  /// them.
  ContactProblem read(const MaterialOptions& material, bool points) const;
};

}  // namespace salebra::cli
