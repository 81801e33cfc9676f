// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/study/sensitivity.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Dimension of an output of study_sensitivity(). Throws InvalidInput for an unknown one.
Dimension dimension_of_output(std::string_view output);

/// A result that a contact should have at several forces.
struct DesignTarget {
  std::string output;          ///< an output of study_sensitivity(), such as "damping_constant"
  std::vector<double> values;  ///< > 0, SI: one for all forces, or one for each
  double tolerance = 0.2;      ///< largest relative deviation of the mean over surfaces, 0.01 to 1
  std::vector<double> force;   ///< at least 4, increasing, N

  double value(std::size_t k) const { return values.size() == 1 ? values.front() : values.at(k); }
};

/// A parameter that may be chosen between two limits.
struct FreeParameter {
  StudyParameter parameter = StudyParameter::rms_height;
  double low = 0, high = 0;  ///< 0 < low < high, SI
};

/// A study, a target, and what may change. The surfaces are generated from a self-affine spectrum.
struct DesignProblem {
  StudyConfiguration study;  ///< its pressures are replaced by those of the target
  DesignTarget target;
  std::vector<FreeParameter> free;
};

/// Reads a problem from a TOML file: `study`, a study file; [target] with `output`, `value`
/// (one, or one for each force), `tolerance` and `force` (two ends of a range, or at least four
/// forces); [free] with a pair of limits for each parameter. Throws InvalidInput with the line of
/// the key.
DesignProblem read_design_problem(const std::filesystem::path& file);

/// A parameter of a design.
struct DesignedParameter {
  std::string parameter;
  double value = 0, low = 0, high = 0;  ///< SI
  /// d ln output/d ln parameter at the design, mean over the forces; NaN if it is not known at one.
  double sensitivity = 0;
  bool at_limit = false;  ///< whether a limit binds it
  /// Whether its whole range changes the output by more than the tolerance, by `sensitivity`.
  bool matters = true;
};

constexpr void describe(auto&& visit, std::type_identity<DesignedParameter>) {
  using S = DesignedParameter;
  visit(&S::parameter, Kept{"parameter", "name of the parameter"});
  visit(&S::value, Kept{"value", "value of the design, SI"});
  visit(&S::low, Kept{"low", "lower limit, SI"});
  visit(&S::high, Kept{"high", "upper limit, SI"});
  visit(&S::sensitivity, Kept{"sensitivity", "d ln output / d ln parameter, mean over the forces"});
  visit(&S::at_limit, Kept{"at_limit", "whether a limit binds the parameter"});
  visit(&S::matters, Kept{"matters", "whether its whole range changes the output noticeably"});
}

/// What a design gives at one force, on surfaces that the search did not use.
struct DesignPoint {
  double force = 0, pressure = 0;
  double target = 0;     ///< SI
  EnsembleMean output;   ///< mean over the surfaces with its 95 % interval
  EnsembleMean surface;  ///< 95 % prediction interval of one more surface
};

constexpr void describe(auto&& visit, std::type_identity<DesignPoint>) {
  using S = DesignPoint;
  visit(&S::force, Kept{"force", "normal force", Dimension::force});
  visit(&S::pressure, Kept{"pressure", "nominal pressure", Dimension::pressure});
  visit(&S::target, Kept{"target", "wanted value, SI"});
  visit(&S::output, Kept{"output", "mean over the surfaces with its 95 % interval"});
  visit(&S::surface, Kept{"surface", "95 % interval of one more surface"});
}

/// Parameters for which a result is closest to a target, and what they give.
struct Design {
  StudyConfiguration study;  ///< the study with the parameters of the design
  std::vector<DesignedParameter> parameters;
  std::vector<DesignPoint> points;
  double deviation = 0;  ///< largest |mean/target − 1| of the points; NaN if a mean is not known
  bool met = false;      ///< whether `deviation` is within the tolerance
  int studies = 0;       ///< studies that the search computed
  bool interrupted = false;
};

constexpr void describe(auto&& visit, std::type_identity<Design>) {
  using S = Design;
  visit(&S::study, Kept{"study", "the study with the parameters of the design"});
  visit(&S::parameters, Kept{"parameters", "values of the parameters"});
  visit(&S::points, Kept{"points", "what the design gives at each force"});
  visit(&S::deviation, Kept{"deviation", "largest relative deviation of a mean from the target"});
  visit(&S::met, Kept{"met", "whether the target is met within its tolerance"});
  visit(&S::studies, Kept{"studies", "number of studies that were computed"});
  visit(&S::interrupted, Kept{"interrupted", "true: there is no design"});
}

/// The parameters for which a result is closest to a target at all its forces.
///
///     const Design found = design(read_design_problem("damper.design.toml"));
///
/// Minimises Σ[ln(⟨Y⟩/target)/ln(1 + tolerance)]² over the forces with the method of Levenberg and
/// Marquardt of GSL, in ln(parameter) between the limits. ⟨Y⟩ is the mean over the surfaces of the
/// seeds of the study, which have the same random numbers for all parameters, so that it is a smooth
/// function of them but for single cells. The search begins at the values of the study and, if it
/// does not meet the target, at two other points. The result is computed again with as many other
/// seeds. An unmet target is no error of the search alone: there may be a design that it did not
/// find.
/// throws  InvalidInput for bad limits, a target that is no number, and wherever study_sensitivity()
///         does
/// cost    about 10 to 60 studies by boundary elements
Design design(const DesignProblem& problem, const Progress& progress = {});

}  // namespace salebra
