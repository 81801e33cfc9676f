// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/premises.hpp>
#include <string>
#include <vector>

#include "options.hpp"

namespace salebra::cli {

/// A force law, a curve from a file, or a surface, and where the contact stands on it.
struct LawOptions {
  std::string law, curve;
  SurfaceOptions surface;
  std::vector<double> force, indentation, pressure, mean_gap;
  std::optional<double> decay_length, angle, radius, exponent, coefficient;

  struct Contact {
    std::unique_ptr<ContactLaw> law;
    std::vector<Position> positions;
    std::optional<ForceCurve> curve = {};            ///< that the law was made from
    std::vector<std::string> doubts = {};            ///< remarks on the options, for people
    std::optional<Surface> surface = {};             ///< that the curve was computed of
    std::optional<FirstLoading> first_loading = {};  ///< whose residual surface it is

    /// The facts at an indentation, with what the law, the curve and the first loading say.
    ContactFacts facts_at(ContactFacts facts, double indentation) const;
  };

  void add_to(Command& command);
  /// Throws InvalidInput naming the option that is missing or one too many.
  /// The law alone, for a motion that brings its own indentations. The exponential law's
  /// --normal-force is F at indentation 0.
  std::unique_ptr<ContactLaw> law_alone(const MaterialOptions& material) const;
  /// Takes the law of a surface after some ten contacts at pressures about those that were given;
  /// with a hardness after the first loading to the largest of them and by an oscillation about it.
  Contact contact(const MaterialOptions& material, Session& session,
                  const std::optional<double>& hardness, double normal_amplitude) const;

 private:
  /// Throws InvalidInput for a parameter of another law than the one that was chosen.
  void require_own_parameters() const;
};

}  // namespace salebra::cli
