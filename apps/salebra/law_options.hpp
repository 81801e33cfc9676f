// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/contact/law/roughness_law.hpp>
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
  std::vector<double> rms_height, rms_slope, skewness;  ///< of the two sides, if there is no map
  std::optional<double> nominal_area;                   ///< of the part, m²; with rms_height

  void add_to(Command& command);
  /// Adds the options for a contact of which only the roughness of the sides is known.
  void add_roughness_to(Command& command);
  bool of_roughness() const { return !rms_height.empty(); }
  /// The law of the sides' roughness. Throws InvalidInput if an option is missing.
  RoughnessLaw law_of_sides(const MaterialOptions& material) const;
  /// The contact for each surface of the study in --curve, or the one contact of problem().
  std::vector<ContactProblem> problems(const MaterialOptions& material, Session& session,
                                       const std::optional<double>& hardness,
                                       const std::string& direction) const;
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
  /// The normal force of a part whose roughness is given, N.
  double force_of_part() const;
};

}  // namespace salebra::cli
