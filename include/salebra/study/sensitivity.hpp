// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/study/study.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace salebra {

/// Parameters of a study that are positive numbers.
enum class StudyParameter {
  rms_height,
  hurst,
  rolloff,
  short_cutoff,
  contact_modulus,
  friction_coefficient,
  pressure,
  normal_amplitude,
  tangential_amplitude
};

template <>
struct EnumNames<StudyParameter> {
  using enum StudyParameter;
  static constexpr auto values = std::to_array<std::pair<StudyParameter, std::string_view>>(
      {{rms_height, "rms_height"},
       {hurst, "hurst"},
       {rolloff, "rolloff"},
       {short_cutoff, "short_cutoff"},
       {contact_modulus, "contact_modulus"},
       {friction_coefficient, "friction_coefficient"},
       {pressure, "pressure"},
       {normal_amplitude, "normal_amplitude"},
       {tangential_amplitude, "tangential_amplitude"}});
};

/// Dimension of a parameter.
Dimension dimension_of(StudyParameter parameter);
/// The value of a parameter in a study, of `pressure` the largest one; NaN if the study does not
/// have it: a spectrum parameter of measured surfaces or of tables, the amplitude of a drag, a
/// coefficient of friction that is not given, the modulus of a body.
double value_of(const StudyConfiguration& configuration, StudyParameter parameter);
/// The study with a parameter multiplied by a factor > 0. rms_height multiplies the rms slope if the
/// spectrum is given by that; contact_modulus keeps Poisson's ratio; hurst, rolloff and short_cutoff
/// keep the rms height or slope that is given. Throws InvalidInput for a parameter without a value
/// and for a spectrum that no surface can have.
StudyConfiguration scaled(StudyConfiguration configuration, StudyParameter parameter,
                          double factor);

/// How a result responds to a change: d ln output/d ln parameter at each pressure.
struct OutputSensitivity {
  std::string output;  ///< "mean_gap", "contact_area_fraction", "normal_stiffness", …
  std::vector<EnsembleMean> at_pressures;
};

constexpr void describe(auto&& visit, std::type_identity<OutputSensitivity>) {
  using S = OutputSensitivity;
  visit(&S::output, Kept{"output", "name of the result"});
  visit(&S::at_pressures, Kept{"at_pressures", "d ln output / d ln parameter at each pressure"});
}

/// Responses of all results to one parameter.
struct ParameterSensitivity {
  std::string parameter;  ///< name of a StudyParameter, or "waves": amplitudes of a band of waves
  double value = 0;       ///< value of the parameter; NaN for waves
  double shortest = std::numeric_limits<double>::quiet_NaN();  ///< band of the waves, m
  double longest = std::numeric_limits<double>::quiet_NaN();
  std::vector<OutputSensitivity> outputs;
};

constexpr void describe(auto&& visit, std::type_identity<ParameterSensitivity>) {
  using S = ParameterSensitivity;
  visit(&S::parameter, Kept{"parameter", "name of the parameter"});
  visit(&S::value, Kept{"value", "value of the parameter, SI"});
  visit(&S::shortest, Kept{"shortest", "shortest wave of the band", Dimension::length});
  visit(&S::longest, Kept{"longest", "longest wave of the band", Dimension::length});
  visit(&S::outputs, Kept{"outputs", "responses of the results"});
}

/// How the results of a study respond to its parameters and to bands of waves.
struct StudySensitivity {
  std::vector<double> pressures;  ///< Pa
  Index surfaces = 0;
  double step = 0;  ///< change of ln(parameter) to each side
  std::vector<ParameterSensitivity> parameters;
  std::vector<std::string> left_out;  ///< sentences: parameters that cannot change, with the reason
  bool interrupted = false;           ///< true: there are no numbers

  /// The sensitivity of an output to a parameter; nullptr if there is none.
  const OutputSensitivity* find(std::string_view parameter, std::string_view output) const;
  /// Names of the outputs that some parameter has, each once.
  std::vector<std::string> outputs() const;
  /// The largest factor by which an output leaves its mean if each parameter leaves its own by up to
  /// a relative tolerance t, exp Σ|r| ln(1 + t), to first order in ln(parameter). It leaves out the
  /// error of r. NaN if a sensitivity is not known.
  double factor_of(const std::vector<std::pair<StudyParameter, double>>& tolerances,
                   std::string_view output, std::size_t pressure) const;
  /// What the bands of waves say about a result at a pressure, as a sentence: which waves decide it,
  /// and whether it depends on the shortest ones. Empty without bands.
  std::string sentence(std::string_view output, std::size_t pressure) const;
};

constexpr void describe(auto&& visit, std::type_identity<StudySensitivity>) {
  using S = StudySensitivity;
  visit(&S::pressures, Kept{"pressures", "nominal pressures", Dimension::pressure});
  visit(&S::surfaces, Kept{"surfaces", "number of surfaces"});
  visit(&S::step, Kept{"step", "change of ln(parameter) to each side"});
  visit(&S::parameters, Kept{"parameters", "responses to each parameter"});
  visit(&S::left_out, Kept{"left_out", "what cannot change, with the reason"});
  visit(&S::interrupted, Kept{"interrupted", "true: there are no numbers"});
}

/// How sensitivities are computed.
struct SensitivityOptions {
  /// Change s of ln(parameter) of surfaces and studies to each side, 1e-3 to 0.2.
  double step = 0.07;
  bool waves = true;  ///< also the octaves of wavelengths that the surfaces have
  Progress on_progress = {};
};

/// How the results of a study by boundary elements respond to its parameters.
///
///     const StudySensitivity found = study_sensitivity(study);
///     const auto* gamma = found.find("hurst", "damping_constant");
///
/// On half-spaces without plasticity the numbers of a surface are those of a smooth law through its
/// contacts: F and K of the gap, a polynomial of ln F. The law changes without new contacts,
/// - under a change dh of the heights by d⟨gap⟩ = Σw dh/Σw − ⟨dh⟩ at each force, with the pressure w
///   of a flat punch on the contact set;
/// - under rms_height and contact_modulus by similarity.
/// dh is the difference of the surfaces of θe^s and θe^−s with the same random numbers. The area has
/// no such response to a change of shape; there it is that of contacts of these two surfaces. K_t/K
/// is kept, which is why 0.04 is added to the limits of K_t and of losses: the largest response of
/// ln(K_t/K) found, at ν = 0.49; at ν = 0.3 it was 0.015.
/// On other bodies and with a hardness the whole study is computed with θe^s and θe^−s.
///
/// With the results Y of surface i on both sides,
///     d ln⟨Y⟩/d ln θ ≈ r = ln(⟨Y⁺⟩/⟨Y⁻⟩)/2s,
/// with s = 0.001 for a law. The 95 % interval of r is that of the mean of
/// r + (Y⁺_i/⟨Y⁺⟩ − Y⁻_i/⟨Y⁻⟩)/2s. Waves of a band are the Fourier modes of the heights with
/// wavelengths in it; the sum over all bands is the response to rms_height. For a single surface, the
/// limits of a law are r ± √(d² + j²) with its change d by polynomials of two degrees less and twice
/// the standard error j of a jackknife over its contacts; nine of ten contain the r of a law with six
/// times as many contacts. Those of contacts are r ± |r(2s) − r|.
/// Outputs: mean_gap, contact_area_fraction, normal_stiffness, tangential_stiffness, work_per_cycle,
/// damping_constant; those that are not known are left out.
/// throws  InvalidInput for a parameter grid, adhesion, an option out of range, and wherever
///         run_study() does
/// cost    by laws 1 to 3 times the study, and up to 10 times with slip in an oscillation: 10 to 30
///         contacts with K for a surface and, for each load, two contacts without K for each parameter
///         of shape and octave (four for one surface); otherwise two studies for each parameter and
///         octave (four for one surface)
StudySensitivity study_sensitivity(const StudyConfiguration& configuration,
                                   const SensitivityOptions& options = {});

}  // namespace salebra
