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

/// A force law, a curve from a file, or a surface, and where the contact stands on it.
struct LawOptions {
  IndenterOptions indenter;  ///< --law, exponential beside the shapes
  std::string curve;
  SurfaceOptions surface;
  OperatingPointsOptions at;
  std::optional<double> decay_length;

  void add_to(Command& command);
  /// Throws InvalidInput naming the option that is missing or one too many. A surface is read.
  ContactProblem problem(const MaterialOptions& material, Session& session,
                         const std::optional<double>& hardness) const;
  /// The answer, whose doubts are told.
  ContactSolution contact(const MaterialOptions& material, Session& session,
                          const std::optional<double>& hardness, double normal_amplitude) const;
  /// Without operating points, for a motion that brings its own indentations. The exponential law's
  /// --normal-force is F at indentation 0.
  ContactProblem problem_of_law(const MaterialOptions& material) const;
  bool of_indenter() const {
    return !indenter.law.empty() && indenter.law != "exponential" && curve.empty() &&
           !surface.given();
  }

 private:
  /// Throws InvalidInput for a parameter of another law than the one that was chosen.
  void require_own_parameters() const;
  /// The problem; without operating points, where they are not needed, of what was given as one.
  ContactProblem read(const MaterialOptions& material, bool points) const;
};

}  // namespace salebra::cli
