// SPDX-License-Identifier: GPL-3.0-or-later
// Design of a contact: parameters of a study for which a result meets a target.
#include <fmt/format.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/study/design.hpp>

#include "base/quiet_gsl.hpp"
#include "base/special_values.hpp"
#include "boundary_element_numbers.hpp"
#include "estimate.hpp"
#include "io/input_file.hpp"
#include "toml_reader.hpp"

namespace salebra {
namespace {

using detail::BoundaryElementNumbers;
using detail::StudyVariant;

std::size_t index_of(std::string_view output) {
  const auto& names = BoundaryElementNumbers::outputs;
  const auto found = std::ranges::find(names, output);
  require(found != names.end(), "output", output,
          "is unknown; take mean_gap, contact_area_fraction, normal_stiffness, "
          "tangential_stiffness, work_per_cycle or damping_constant");
  return std::size_t(found - names.begin());
}

bool is_loss(std::string_view output) {
  return output == "work_per_cycle" || output == "damping_constant";
}

void validate(const DesignTarget& target) {
  index_of(target.output);
  require(target.values.size() == 1 || target.values.size() == target.force.size(), "value",
          target.values.size(), "values given; give one, or one for each force");
  for (const double value : target.values) {
    require_positive(value, "value");
    require(target.output != "contact_area_fraction" || value <= 1, "value", value,
            "is a fraction of the area, which must be <= 1");
  }
  require(target.tolerance >= 0.01 && target.tolerance <= 1, "tolerance", target.tolerance,
          "must be between 1 % and 100 %");
  for (std::size_t k = 0; k < target.force.size(); ++k) {
    require_positive(target.force[k], "force");
    require(k == 0 || target.force[k] > target.force[k - 1], "force", target.force[k],
            "must be above the force before it");
  }
  require(target.force.size() >= 4, "force", target.force.size(),
          "forces given; give the two ends of a range or at least 4 forces");
}

void validate_study(const DesignProblem& problem) {
  const auto* recipe = std::get_if<GeneratedSurfaces>(&problem.study.surfaces);
  require_that(recipe && recipe->tables.empty(), "surface",
               "of a design is generated from a self-affine spectrum; give one in the study");
  require(recipe->seeds.size() >= 2, "seeds", recipe->seeds.size(),
          "given; a design needs at least 2 surfaces");
}

void validate_free(const DesignProblem& problem) {
  const std::size_t forces = problem.target.force.size();
  require(!problem.free.empty() && problem.free.size() <= forces, "free", problem.free.size(),
          fmt::format("parameters; give between 1 and as many as forces, {}", forces));
  for (const FreeParameter& one : problem.free) {
    const std::string name(name_of(one.parameter));
    require_that(one.parameter != StudyParameter::pressure, name,
                 "follows from the forces of the target; leave it out");
    require_positive(one.low, name);
    require(std::isfinite(one.high) && one.high > one.low, name, one.high,
            "is the upper limit, which must be above the lower one");
    const double value = value_of(problem.study, one.parameter);
    require_that(!std::isnan(value), name, "has no value in the study; give it a first value");
    for (const double limit : {one.low, one.high})
      scaled(problem.study, one.parameter, limit / value);
  }
}

/// Search for the parameters in coordinates x with θ = √(low·high)·(high/low)^(sin(x)/2).
class Search {
 public:
  Search(const DesignProblem& problem, const Progress& progress)
      : problem_(problem),
        study_(for_search(problem), progress),
        output_(index_of(problem.target.output)) {}

  std::vector<double> start(double fraction) const {
    std::vector<double> x;
    for (const FreeParameter& one : problem_.free) {
      const double at = std::log(value_of(problem_.study, one.parameter) / one.low) /
                        std::log(one.high / one.low);
      // Not at a limit, where x has no effect.
      x.push_back(std::asin(2 * (fraction < 0 ? std::clamp(at, 0.1, 0.9) : fraction) - 1));
    }
    return x;
  }

  double theta(std::size_t parameter, double x) const {
    const FreeParameter& one = problem_.free[parameter];
    return std::sqrt(one.low * one.high) * std::pow(one.high / one.low, std::sin(x) / 2);
  }

  /// The study with these parameters.
  StudyConfiguration at(StudyConfiguration study, const std::vector<double>& thetas) const {
    for (std::size_t p = 0; p < thetas.size(); ++p) {
      const StudyParameter parameter = problem_.free[p].parameter;
      const double factor = thetas[p] / value_of(study, parameter);
      study = scaled(std::move(study), parameter, factor);
    }
    return study;
  }

  /// Residuals ln(⟨Y⟩/value)/ln(1 + tolerance) at each force, for each set of parameters; NaN where
  /// there is no number, and for a spectrum that no surface can have.
  std::vector<std::vector<double>> residuals(const std::vector<std::vector<double>>& sets) {
    const std::size_t forces = problem_.target.force.size();
    std::vector<std::vector<double>> found(sets.size(),
                                           std::vector<double>(forces, detail::unknown));
    std::vector<StudyVariant> variants;
    std::vector<std::size_t> of_variant;
    for (std::size_t s = 0; s < sets.size(); ++s) try {
        variants.push_back({.configuration = at(study_.base(), sets[s]), .surface = {}});
        of_variant.push_back(s);
      } catch (const InvalidInput&) {
      }
    studies += int(variants.size());
    const auto numbers = study_.of(variants);
    if (numbers.size() < variants.size()) throw Interrupted("design: interrupted");
    for (std::size_t v = 0; v < variants.size(); ++v)
      for (std::size_t k = 0; k < forces; ++k)
        if (const double mean = student_mean(values(numbers[v], k)).mean; mean > 0)
          found[of_variant[v]][k] =
              std::log(mean / problem_.target.value(k)) / std::log1p(problem_.target.tolerance);
    return found;
  }

  std::vector<double> values(const std::vector<BoundaryElementNumbers::OfSurface>& surfaces,
                             std::size_t k) const {
    std::vector<double> list;
    for (const auto& surface : surfaces) list.push_back(surface[output_][k]);
    return list;
  }

  /// The residual that the search takes where there is none: the target is far.
  static constexpr double far = 50;

  /// The minimum that a start leads to.
  struct Minimum {
    std::vector<double> thetas;
    double worst = 0;  ///< largest |residual|
  };
  Minimum minimum(std::vector<double> x) {
    const std::size_t n = problem_.target.force.size(), p = x.size();
    gsl_multifit_nlinear_fdf functions{};
    functions.f = [](const gsl_vector* at, void* self, gsl_vector* f) {
      return static_cast<Search*>(self)->guarded([&](Search& search) {
        const auto found = search.residuals({search.thetas_of(at)}).front();
        for (std::size_t k = 0; k < found.size(); ++k)
          gsl_vector_set(f, k, std::isnan(found[k]) ? far : found[k]);
      });
    };
    functions.df = [](const gsl_vector* at, void* self, gsl_matrix* j) {
      return static_cast<Search*>(self)->guarded([&](Search& search) {
        const auto slopes = search.slopes(search.thetas_of(at));
        for (std::size_t q = 0; q < slopes.size(); ++q) {
          const FreeParameter& one = search.problem_.free[q];
          const double factor = std::log(one.high / one.low) / 2 * std::cos(gsl_vector_get(at, q));
          for (std::size_t k = 0; k < slopes[q].size(); ++k)
            gsl_matrix_set(j, k, q, std::isnan(slopes[q][k]) ? 0 : factor * slopes[q][k]);
        }
      });
    };
    functions.n = n;
    functions.p = p;
    functions.params = this;
    const gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)>
        workspace(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, p),
                  &gsl_multifit_nlinear_free);
    const gsl_vector_view first = gsl_vector_view_array(x.data(), p);
    gsl_multifit_nlinear_init(&first.vector, &functions, workspace.get());
    rethrow();
    for (int step = 0; step < 10; ++step) {
      const int status = gsl_multifit_nlinear_iterate(workspace.get());
      rethrow();
      // A change of the parameters by a hundredth of their range is what single cells do.
      int info = 0;
      if (status != GSL_SUCCESS ||
          gsl_multifit_nlinear_test(1e-2, 1e-2, 1e-2, &info, workspace.get()) == GSL_SUCCESS)
        break;
    }
    Minimum found{.thetas = thetas_of(gsl_multifit_nlinear_position(workspace.get()))};
    const gsl_vector* left = gsl_multifit_nlinear_residual(workspace.get());
    for (std::size_t k = 0; k < n; ++k)
      found.worst = std::max(found.worst, std::abs(gsl_vector_get(left, k)));
    return found;
  }

  /// d residual/d ln θ [parameter][force]; NaN where a side has no residual.
  std::vector<std::vector<double>> slopes(const std::vector<double>& thetas) {
    const double step = SensitivityOptions().step;
    std::vector<std::vector<double>> sets;
    for (std::size_t q = 0; q < thetas.size(); ++q)
      for (const double side : {step, -step}) {
        sets.push_back(thetas);
        const FreeParameter& one = problem_.free[q];
        sets.back()[q] = std::clamp(thetas[q] * std::exp(side), one.low, one.high);
      }
    const auto found = residuals(sets);
    std::vector<std::vector<double>> slopes(thetas.size());
    for (std::size_t q = 0; q < thetas.size(); ++q)
      for (std::size_t k = 0; k < found.front().size(); ++k)
        slopes[q].push_back((found[2 * q][k] - found[2 * q + 1][k]) /
                            std::log(sets[2 * q][q] / sets[2 * q + 1][q]));
    return slopes;
  }

  BoundaryElementNumbers& study() { return study_; }
  int studies = 0;

  /// The study of the problem at the forces of its target.
  static StudyConfiguration with_forces(const DesignProblem& problem) {
    StudyConfiguration study = problem.study;
    const double area = std::get<GeneratedSurfaces>(study.surfaces).grid.area();
    study.pressures.clear();
    for (const double force : problem.target.force) study.pressures.push_back(force / area);
    study.relative_pressures = false;
    study.pressures_below_hardness = false;
    return study;
  }

 private:
  static StudyConfiguration for_search(const DesignProblem& problem) {
    StudyConfiguration study = with_forces(problem);
    // A contact needs no oscillation, and most outputs no stick.
    if (!is_loss(problem.target.output)) {
      study.intervals = 0;
      study.stick = study.stick && problem.target.output == "tangential_stiffness";
    }
    return study;
  }

  std::vector<double> thetas_of(const gsl_vector* x) const {
    std::vector<double> thetas;
    for (std::size_t q = 0; q < problem_.free.size(); ++q)
      thetas.push_back(theta(q, gsl_vector_get(x, q)));
    return thetas;
  }

  /// Runs a function that GSL calls; its exception waits for rethrow(), because it must not pass
  /// through GSL.
  template <class Function>
  int guarded(const Function& function) {
    try {
      if (!failure_) function(*this);
    } catch (...) {
      failure_ = std::current_exception();
    }
    return failure_ ? GSL_EFAILED : GSL_SUCCESS;
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  const DesignProblem& problem_;
  BoundaryElementNumbers study_;
  const std::size_t output_;
  std::exception_ptr failure_;
};

}  // namespace

Dimension dimension_of_output(std::string_view output) {
  constexpr std::array<Dimension, BoundaryElementNumbers::outputs.size()> dimensions{
      Dimension::length,    Dimension::dimensionless, Dimension::stiffness,
      Dimension::stiffness, Dimension::energy,        Dimension::damping};
  return dimensions[index_of(output)];
}

DesignProblem read_design_problem(const std::filesystem::path& file) {
  constexpr std::uint64_t most = 4 << 20;
  auto root = detail::TomlTable::parse(detail::InputFile(file).content(most), file.string());
  DesignProblem problem;
  const auto study = root.text("study");
  root.check(study.has_value(), "study", "not given; name the file of a study");
  problem.study = read_study_configuration(file.parent_path() / *study);
  auto target = root.required_table("target");
  const auto output = target.text("output");
  target.check(output.has_value(), "output", "not given; give one, such as \"damping_constant\"");
  problem.target.output = *output;
  const Dimension dimension = target.located([&] { return dimension_of_output(*output); });
  problem.target.values = target.values("value", dimension);
  problem.target.tolerance =
      target.quantity("tolerance", Dimension::dimensionless).value_or(problem.target.tolerance);
  problem.target.force = target.values("force", Dimension::force);
  if (auto& force = problem.target.force;
      force.size() == 2 && force[0] > 0 && force[1] > force[0]) {
    const double ratio = std::cbrt(force[1] / force[0]);
    force = {force[0], force[0] * ratio, force[0] * ratio * ratio, force[1]};
  }
  target.require_no_other_keys();
  target.located([&] { validate(problem.target); });
  auto free = root.required_table("free");
  for (const auto& [parameter, name] : EnumNames<StudyParameter>::values) {
    if (parameter == StudyParameter::pressure && !free.has(name)) continue;
    const std::vector<double> limits = free.values(name, dimension_of(parameter));
    if (limits.empty()) continue;
    free.check(limits.size() == 2, name, "must be a pair of limits, such as [0.6, 0.9]");
    problem.free.push_back({parameter, limits[0], limits[1]});
  }
  free.require_no_other_keys();
  root.require_no_other_keys();
  root.located([&] { validate_study(problem); });
  free.located([&] { validate_free(problem); });
  return problem;
}

Design design(const DesignProblem& problem, const Progress& progress) {
  validate(problem.target);
  validate_study(problem);
  validate_free(problem);
  detail::quiet_gsl();
  Search search(problem, progress);
  Design found;
  try {
    std::optional<Search::Minimum> best;
    for (const double start : {-1.0, 0.75, 0.25}) {
      Search::Minimum minimum = search.minimum(search.start(start));
      if (!best || minimum.worst < best->worst) best = std::move(minimum);
      // Other surfaces need some room.
      if (best->worst < 0.8) break;
    }
    const auto slopes = search.slopes(best->thetas);
    const double room = std::log1p(problem.target.tolerance);
    for (std::size_t q = 0; q < problem.free.size(); ++q) {
      const FreeParameter& one = problem.free[q];
      double sum = 0, largest = 0;
      for (const double slope : slopes[q]) {
        sum += slope * room;
        largest = std::max(largest, std::abs(slope) * room);
      }
      const double range = std::log(one.high / one.low);
      const double from_low = std::log(best->thetas[q] / one.low) / range;
      found.parameters.push_back({.parameter = std::string(name_of(one.parameter)),
                                  .value = best->thetas[q],
                                  .low = one.low,
                                  .high = one.high,
                                  .sensitivity = sum / double(slopes[q].size()),
                                  .at_limit = from_low < 0.01 || from_low > 0.99,
                                  .matters = std::isnan(sum) || largest * range > room});
    }
    found.study = search.at(Search::with_forces(problem), best->thetas);
    // Other surfaces than those of the search judge the design.
    std::vector<std::uint64_t> seeds = search.study().seeds();
    const std::uint64_t last = *std::ranges::max_element(seeds);
    for (std::size_t s = 0; s < seeds.size(); ++s) seeds[s] = last + 1 + s;
    search.study().set_seeds(std::move(seeds));
    const auto numbers = search.study().of(
        {{.configuration = search.at(search.study().base(), best->thetas), .surface = {}}});
    ++search.studies;
    if (numbers.empty()) throw Interrupted("design: interrupted");
    for (std::size_t k = 0; k < problem.target.force.size(); ++k) {
      const std::vector<double> values = search.values(numbers.front(), k);
      found.points.push_back({.force = problem.target.force[k],
                              .pressure = found.study.pressures[k],
                              .target = problem.target.value(k),
                              .output = student_mean(values),
                              .surface = prediction(values)});
      const double off = std::abs(found.points.back().output.mean / problem.target.value(k) - 1);
      const bool known = !std::isnan(off + found.deviation);
      found.deviation = known ? std::max(found.deviation, off) : detail::unknown;
    }
    found.met = found.deviation <= problem.target.tolerance;
  } catch (const Interrupted&) {
    found = {};
    found.interrupted = true;
  }
  found.studies = search.studies;
  return found;
}

}  // namespace salebra
