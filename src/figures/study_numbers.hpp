// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/figures/figure.hpp>
#include <salebra/study/study.hpp>
#include <string>
#include <utility>
#include <vector>

namespace salebra::figures {

/// What the pictures of a study need of one point of its parameter grid, from a result in memory or
/// from its file. Unknown numbers are NaN, and lists that are not known are empty.
struct StudyNumbers {
  static constexpr double unknown = ForceSample::unknown;

  struct Model {
    int color = 6;  ///< number of the model in the list of all models: one colour in all figures
    std::string title = {};
    std::vector<std::vector<ForceSample>> curves = {};  ///< of each surface
    std::vector<EnsembleMean> damping_constant = {};    ///< without slip, N s/m
    /// Loss without slip over that of the boundary elements on the same surface.
    std::vector<EnsembleMean> over_bem = {};
  };

  std::vector<double> pressures = {};  ///< Pa
  double nominal_area = unknown, contact_modulus = unknown, modulus_ratio = unknown;
  double contact_scale = unknown;                       ///< E*h', Pa
  std::vector<double> rms_height = {}, rms_slope = {};  ///< of each surface
  bool twin = false;                                    ///< surfaces are drawn from a surface twin
  std::vector<Model> models = {};                       ///< boundary elements first
  std::vector<ExponentialFit> fits = {};     ///< of the boundary elements, of each surface
  std::vector<LocalDecayLength> local = {};  ///< likewise
  /// A/A0 of the boundary elements without the cells counted in excess, of each surface.
  std::vector<std::vector<double>> corrected_area_fraction = {};

  std::optional<Oscillation> motion = {};  ///< empty: no damping
  Hold hold = Hold::indentation;
  double excursion = unknown, friction_coefficient = unknown, direction = unknown;
  bool slips = false;                             ///< damping_constant is with slip
  std::vector<StatedMean> damping_constant = {};  ///< of the motion as described
  /// The same in further directions of the motion, rad.
  std::vector<std::pair<double, std::vector<StatedMean>>> other_directions = {};
  std::string validity = {}, law = {};  ///< what the headlines say of results that are not valid
  /// Of the boundary elements without slip: by the fitted law, by the curvature of the curve, and the
  /// deviation of the first from the computed loss.
  std::vector<EnsembleMean> closed_form = {}, small_amplitude = {}, deviation = {};
};

StudyNumbers numbers_of(const StudyResult& result);

/// "Motion: slow shear at 1 mm/s under 100 pm at 20 kHz, mean indentation held, along x, µ = 0.3."
std::string motion_sentence(const StudyNumbers& numbers);

/// The pictures of one point of the parameter grid, with one panel each: gap, area and stiffness over
/// the pressure, damping, stiffness ratio, local decay length, damping over that of boundary
/// elements. A picture without numbers is left out, and so is a stiffness ratio that is only assumed.
std::vector<Figure> study_pictures(const StudyNumbers& numbers);

}  // namespace salebra::figures
