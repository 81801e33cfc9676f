// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of the results of a study to its parameters and to bands of waves: from the laws of
// its surfaces and the responses of their gaps, or by differences between surfaces with the same
// random numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/study/sensitivity.hpp>

#include "base/convolution.hpp"
#include "base/special_values.hpp"
#include "boundary_element_numbers.hpp"
#include "estimate.hpp"
#include "law_numbers.hpp"

namespace salebra {
namespace {

using detail::BoundaryElementNumbers;
using detail::infinity;
using detail::LawNumbers;
using detail::unknown;

/// The surface with the amplitudes of waves that are longer than `shortest`, up to and with
/// `longest`, multiplied by a factor.
Surface with_waves_scaled(Surface surface, double shortest, double longest, double factor) {
  const Grid2D& grid = surface.grid;
  Convolution2D<double> convolution({grid.nx, grid.ny, grid.nx, grid.ny});
  convolution.set_symbol(0, 0, [&](Index i, Index j) {
    const double inverse = std::hypot(double(i) / grid.lx, double(j) / grid.ly);
    constexpr double rounding = 1e-9;
    // The mean of the heights stays: its product 0·∞ is not a number, so the comparison fails.
    return inverse * shortest < 1 - rounding && inverse * longest >= 1 - rounding ? factor : 1.0;
  });
  convolution.apply(surface.heights.data(), surface.heights.data());
  return surface;
}

/// A change of a study in two directions: the surfaces and the configuration with which they are
/// pressed, for the change δ of ln(parameter).
struct Change {
  // What changes: the motion alone, the load, the scale of lengths or moduli, or the shape of the
  // surfaces.
  enum class Of { motion, load, scale, shape } kind;
  ParameterSensitivity of;
  std::function<StudyConfiguration(double change)> configuration;
  std::function<Surface(Surface, double change)> surface = {};  // empty: that of the configuration
};

Change::Of kind_of(StudyParameter parameter) {
  using enum StudyParameter;
  if (parameter == pressure) return Change::Of::load;
  if (parameter == rms_height || parameter == contact_modulus) return Change::Of::scale;
  if (parameter == hurst || parameter == rolloff || parameter == short_cutoff)
    return Change::Of::shape;
  return Change::Of::motion;
}

Change change_of(const StudyConfiguration& base, StudyParameter parameter) {
  return {
      .kind = kind_of(parameter),
      .of = {.parameter = std::string(name_of(parameter)),
             .value = value_of(base, parameter),
             .outputs = {}},
      .configuration = [=](double change) { return scaled(base, parameter, std::exp(change)); }};
}

Change change_of_waves(const StudyConfiguration& base, std::string name, double value,
                       double shortest, double longest) {
  return {.kind = Change::Of::shape,
          .of = {.parameter = std::move(name),
                 .value = value,
                 .shortest = shortest,
                 .longest = longest,
                 .outputs = {}},
          .configuration = [=](double) { return base; },
          .surface =
              [=](Surface surface, double change) {
                return with_waves_scaled(std::move(surface), shortest, longest, std::exp(change));
              }};
}

/// The octaves of wavelengths that a surface has, from the shortest to its longer side.
std::vector<std::pair<double, double>> octaves_of(const StudyConfiguration& base,
                                                  const Grid2D& grid) {
  double shortest = 2 * std::max(grid.dx(), grid.dy());
  const auto* recipe = std::get_if<GeneratedSurfaces>(&base.surfaces);
  if (recipe && recipe->tables.empty() && recipe->textures.front().lay.peklenik() == 1)
    shortest = recipe->spectrum.short_cutoff;
  std::vector<std::pair<double, double>> octaves;
  const double longest = std::max(grid.lx, grid.ly);
  for (double from = shortest; from < longest * (1 - 1e-9); from *= 2)
    octaves.emplace_back(from, std::min(2 * from, longest));
  // Without a range of wavelengths all waves are one band.
  if (octaves.empty()) octaves.emplace_back(0, longest);
  // All shorter waves, such as those along the diagonal of the cells, belong to the first octave.
  octaves.front().first = 0;
  return octaves;
}

/// widest: the largest change of ln(parameter) to each side.
std::vector<Change> changes_of(const StudyConfiguration& base, const Grid2D& grid, bool waves,
                               double widest, std::vector<std::string>& left_out) {
  std::vector<Change> changes;
  for (const auto& [parameter, name] : EnumNames<StudyParameter>::values) {
    if (parameter == StudyParameter::rms_height) {
      changes.push_back(
          change_of_waves(base, std::string(name), value_of(base, parameter), 0, infinity));
      changes.back().kind = Change::Of::scale;
      changes.back().of.shortest = changes.back().of.longest = unknown;
      continue;
    }
    if (std::isnan(value_of(base, parameter))) continue;
    Change change = change_of(base, parameter);
    try {
      for (const double side : {-widest, widest}) change.configuration(side);
      changes.push_back(std::move(change));
    } catch (const InvalidInput& refusal) {
      left_out.push_back(fmt::format("{} cannot change by {:.2g} %: {}", name,
                                     100 * std::expm1(widest), refusal.what()));
    }
  }
  if (waves)
    for (const auto& [shortest, longest] : octaves_of(base, grid))
      changes.push_back(change_of_waves(base, "waves", unknown, shortest, longest));
  return changes;
}

/// r of study_sensitivity() with its interval, from the results of each surface on both sides.
EnsembleMean derivative(const std::vector<double>& above, const std::vector<double>& below,
                        double step) {
  double sum_above = 0, sum_below = 0, count = 0;
  const auto known = [&](std::size_t i) { return !std::isnan(above[i] + below[i]); };
  for (std::size_t i = 0; i < above.size(); ++i)
    if (known(i)) sum_above += above[i], sum_below += below[i], ++count;
  if (!(sum_above > 0 && sum_below > 0)) return {};
  const double slope = std::log(sum_above / sum_below) / (2 * step);
  std::vector<double> slopes;
  for (std::size_t i = 0; i < above.size(); ++i)
    if (known(i))
      slopes.push_back(slope + count * (above[i] / sum_above - below[i] / sum_below) / (2 * step));
  return student_mean(slopes, Sign::either);
}

/// The numbers of all surfaces at one value of a parameter. A law gives smooth derivatives at small
/// steps; contact areas need steps over which cells enter.
struct Side {
  double step = 0, area_step = 0;  ///< of ln θ
  LawNumbers::Fit fit = {};
  std::vector<BoundaryElementNumbers::OfSurface> surfaces = {};

  double step_of(std::size_t output) const { return output == area_output ? area_step : step; }
  static constexpr std::size_t area_output = 1;
};
/// Pairs of both sides of a value: one and, of a single surface, more that show its error. The second
/// pair has twice the step or a law of fewer degrees; the others have laws without some contacts.
using Sides = std::vector<Side>;

constexpr double law_step = 1e-3;

// K_t of a law is in a constant ratio to K. This is the largest response of ln(K_t/K) that stick
// solves showed: on surfaces with H = 0.8 at ν = 0.3 (0.015), at ν = 0.49 (0.04), and with a lay of
// 4:1, along and across it (0.034), at up to 80 % of contact.
constexpr double ratio_response = 0.04;

/// The numbers of one surface by the law of its contacts.
class SurfaceSides {
 public:
  SurfaceSides(const BoundaryElementNumbers& study, std::size_t index, const Progress& progress)
      : study_(study),
        index_(index),
        progress_(progress),
        surface_(study.surface(study.base(), study.seeds()[index])),
        law_(surface_, study.base(), progress) {}

  /// Writes the numbers of this surface into the sides of a change.
  void put(const Change& change, Sides& sides) const {
    std::vector<double> response;
    std::vector<std::vector<double>> areas;
    if (change.kind == Change::Of::shape) {
      Field slope = Field::Zero(surface_.grid.nx, surface_.grid.ny);
      for (std::size_t side = 0; side < std::min<std::size_t>(sides.size(), 4); ++side) {
        const Surface changed = this->changed(change, sides[side].area_step);
        // Of amplitudes that change by the factor e^s this is the slope at any s.
        if (side < 2) slope += changed.heights / (2 * std::sinh(sides[side].area_step));
        areas.push_back(areas_of(changed));
      }
      response = law_.gradient().response(slope);
    }
    for (std::size_t side = 0; side < sides.size(); ++side) {
      const double step = sides[side].step;
      LawNumbers::Change contacts;
      for (const double one : response) contacts.gap_change.push_back(step * one);
      // The contacts of (sh, E*, sF) and of (h, sE*, sF) have the sets of (h, E*, F), and their gaps
      // are s times that of it, and the same.
      if (change.kind == Change::Of::scale) {
        contacts.force_factor = std::exp(step);
        if (change.surface) contacts.gap_factor = contacts.force_factor;
      }
      auto& numbers = sides[side].surfaces[index_];
      numbers = law_.numbers(change.configuration(step), contacts, sides[side].fit);
      if (!areas.empty()) numbers[Side::area_output] = areas[side < 4 ? side : side % 2];
    }
  }

 private:
  Surface changed(const Change& change, double step) const {
    return change.surface ? change.surface(surface_, step)
                          : study_.surface(change.configuration(step), study_.seeds()[index_]);
  }

  std::vector<double> areas_of(const Surface& surface) const {
    const StudyConfiguration& study = study_.base();
    const ForceCurve curve = sweep_pressures(
        surface, study.pressed(), study.pressures,
        {.contact = {.tolerance = study.tolerance, .on_progress = progress_}, .stiffness = false});
    if (curve.samples.size() < study.pressures.size()) throw Interrupted("study: interrupted");
    std::vector<double> areas;
    for (const ForceSample& sample : curve.samples)
      areas.push_back(sample.converged ? sample.contact_area_fraction : unknown);
    return areas;
  }

  const BoundaryElementNumbers& study_;
  const std::size_t index_;
  const Progress& progress_;
  const Surface surface_;
  const LawNumbers law_;
};

/// The sides of each change; empty if progress says stop.
std::vector<Sides> sides_of(const BoundaryElementNumbers& study, const std::vector<Change>& changes,
                            bool by_law, double step) {
  Sides sides;
  const auto surfaces = std::size_t(study.surfaces());
  const auto add = [&](double factor, const LawNumbers::Fit& fit) {
    for (const double side : {factor, -factor})
      sides.push_back({.step = by_law ? std::copysign(law_step, side) : side * step,
                       .area_step = side * step,
                       .fit = fit,
                       .surfaces = std::vector<BoundaryElementNumbers::OfSurface>(surfaces)});
  };
  add(1, {});
  if (surfaces == 1) add(2, {.fewer_degrees = 2});
  if (surfaces == 1 && by_law)
    for (Index omitted = 0; omitted < 4; ++omitted) add(1, {.omitted = omitted});
  std::vector<Sides> all(changes.size(), sides);
  if (by_law) {
    for (std::size_t c = 0; c < changes.size(); ++c)
      if (changes[c].kind != Change::Of::shape)
        for (Side& side : all[c]) side.area_step = side.step;
    const bool finished = study.run(surfaces, [&](std::size_t index, const Progress& going_on) {
      const SurfaceSides of_surface(study, index, going_on);
      for (std::size_t c = 0; c < changes.size(); ++c) of_surface.put(changes[c], all[c]);
    });
    return finished ? all : std::vector<Sides>{};
  }
  std::vector<detail::StudyVariant> variants;
  for (const Change& change : changes)
    for (const Side& side : sides) {
      variants.push_back({.configuration = change.configuration(side.step), .surface = {}});
      if (change.surface)
        variants.back().surface = [&change, step = side.step](Surface surface) {
          return change.surface(std::move(surface), step);
        };
    }
  auto numbers = study.of(variants);
  if (numbers.empty()) return {};
  for (std::size_t v = 0; v < variants.size(); ++v)
    all[v / sides.size()][v % sides.size()].surfaces = std::move(numbers[v]);
  return all;
}

/// r of study_sensitivity() for an output at a pressure.
EnsembleMean derivative(const Sides& sides, std::size_t output, std::size_t pressure) {
  const auto slope_of = [&](std::size_t first) {
    const auto values = [&](const Side& side) {
      std::vector<double> list;
      for (const auto& numbers : side.surfaces) list.push_back(numbers[output][pressure]);
      return list;
    };
    return derivative(values(sides[first]), values(sides[first + 1]), sides[first].step_of(output));
  };
  EnsembleMean slope = slope_of(0);
  if (sides.size() > 2) {
    // Twice the standard error of a jackknife of four groups, √(3/4 Σ(rⱼ − r)²).
    double square = std::pow(slope_of(2).mean - slope.mean, 2);
    for (std::size_t pair = 4; pair < sides.size(); pair += 2)
      square += 3 * std::pow(slope_of(pair).mean - slope.mean, 2);
    // No number without its error.
    if (!std::isfinite(square)) return {};
    slope.low = slope.mean - std::sqrt(square), slope.high = slope.mean + std::sqrt(square);
  }
  return slope;
}

}  // namespace

Dimension dimension_of(StudyParameter parameter) {
  using enum StudyParameter;
  switch (parameter) {
    case hurst:
    case friction_coefficient:
      return Dimension::dimensionless;
    case contact_modulus:
    case pressure:
      return Dimension::pressure;
    default:
      return Dimension::length;
  }
}

double value_of(const StudyConfiguration& configuration, StudyParameter parameter) {
  using enum StudyParameter;
  const auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
  const SelfAffineParameters* spectrum =
      recipe && recipe->tables.empty() ? &recipe->spectrum : nullptr;
  const auto* equal = std::get_if<EqualFrequency>(&configuration.motion);
  const double amplitude =
      equal ? equal->normal_amplitude : std::get<Drag>(configuration.motion).normal_amplitude;
  const auto positive = [](double value) { return value > 0 ? value : unknown; };
  switch (parameter) {
    case rms_height:
      return spectrum ? spectrum->rms_height.value_or(unknown) : unknown;
    case hurst:
      return spectrum ? spectrum->hurst : unknown;
    case rolloff:
      return spectrum ? spectrum->rolloff.value_or(unknown) : unknown;
    case short_cutoff:
      return spectrum ? spectrum->short_cutoff : unknown;
    case contact_modulus:
      return configuration.body ? unknown : configuration.material.contact_modulus;
    case friction_coefficient:
      return std::isfinite(configuration.known.friction_coefficient)
                 ? positive(configuration.known.friction_coefficient)
                 : unknown;
    case pressure:
      return configuration.relative_pressures || configuration.pressures.empty()
                 ? unknown
                 : configuration.pressures.back();
    case normal_amplitude:
      return positive(amplitude);
    default:
      return equal ? positive(equal->tangential_amplitude) : unknown;
  }
}

StudyConfiguration scaled(StudyConfiguration configuration, StudyParameter parameter,
                          double factor) {
  using enum StudyParameter;
  require_positive(factor, "factor");
  if (parameter == rms_height) {
    auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
    require_that(recipe && recipe->tables.empty(), "rms_height",
                 "belongs to surfaces with a self-affine spectrum");
    for (auto* amplitude : {&recipe->spectrum.rms_height, &recipe->spectrum.rms_slope})
      if (*amplitude) **amplitude *= factor;
    return configuration;
  }
  require_that(!std::isnan(value_of(configuration, parameter)), name_of(parameter),
               "has no value in this study");
  auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
  const auto scale_spectrum = [&](double& value) {
    value *= factor;
    recipe->spectrum_of_all()->require_carried_by(recipe->grid);
  };
  auto* equal = std::get_if<EqualFrequency>(&configuration.motion);
  Material& material = configuration.material;
  switch (parameter) {
    case hurst:
      scale_spectrum(recipe->spectrum.hurst);
      break;
    case rolloff:
      scale_spectrum(*recipe->spectrum.rolloff);
      break;
    case short_cutoff:
      scale_spectrum(recipe->spectrum.short_cutoff);
      break;
    case contact_modulus:
      material.contact_modulus *= factor;
      material.tangential_modulus *= factor;
      material.cerruti_isotropic /= factor;
      material.cerruti_directed /= factor;
      break;
    case friction_coefficient:
      configuration.known.friction_coefficient *= factor;
      break;
    case pressure:
      for (double& pressure : configuration.pressures) pressure *= factor;
      if (configuration.window) {
        configuration.window->pressure_min *= factor;
        configuration.window->pressure_max *= factor;
      }
      break;
    case normal_amplitude:
      (equal ? equal->normal_amplitude : std::get<Drag>(configuration.motion).normal_amplitude) *=
          factor;
      break;
    default:
      equal->tangential_amplitude *= factor;
  }
  return configuration;
}

const OutputSensitivity* StudySensitivity::find(std::string_view parameter,
                                                std::string_view output) const {
  for (const ParameterSensitivity& one : parameters)
    if (one.parameter == parameter)
      for (const OutputSensitivity& found : one.outputs)
        if (found.output == output) return &found;
  return nullptr;
}

std::vector<std::string> StudySensitivity::outputs() const {
  std::vector<std::string> names;
  for (const ParameterSensitivity& one : parameters)
    for (const OutputSensitivity& found : one.outputs)
      if (std::ranges::find(names, found.output) == names.end()) names.push_back(found.output);
  return names;
}

double StudySensitivity::factor_of(const std::vector<std::pair<StudyParameter, double>>& tolerances,
                                   std::string_view output, std::size_t pressure) const {
  double sum = 0;
  for (const auto& [parameter, tolerance] : tolerances) {
    const OutputSensitivity* found = find(name_of(parameter), output);
    sum +=
        found ? std::abs(found->at_pressures.at(pressure).mean) * std::log1p(tolerance) : unknown;
  }
  return std::exp(sum);
}

std::string StudySensitivity::sentence(std::string_view output, std::size_t pressure) const {
  require(pressure < pressures.size(), "index", pressure,
          fmt::format("must be below {}, the number of pressures", pressures.size()));
  struct Share {
    double shortest, longest, size;
  };
  std::vector<Share> shares;
  double sum = 0;
  for (const ParameterSensitivity& one : parameters)
    if (one.parameter == "waves")
      for (const OutputSensitivity& found : one.outputs)
        if (found.output == output) {
          const double size = std::abs(found.at_pressures.at(pressure).mean);
          shares.push_back({one.shortest, one.longest, std::isnan(size) ? 0 : size});
          sum += shares.back().size;
        }
  if (shares.empty() || !(sum > 0)) return "";
  const auto length = [](double value) { return format_quantity(value, Dimension::length, 3); };
  const Share& most = *std::ranges::max_element(shares, {}, &Share::size);
  std::string text =
      fmt::format("at {} the waves {} {} give {:.0f} % of the response of {} to all waves",
                  format_quantity(pressures.at(pressure), Dimension::pressure, 3),
                  most.shortest > 0 ? "of " + length(most.shortest) + " to" : "below",
                  length(most.longest), 100 * most.size / sum, output);
  const Share& first = shares.front();
  const double share = first.size / sum;
  if (shares.size() > 1 && &first != &most)
    text += fmt::format("; those below {} give {:.0f} %", length(first.longest), 100 * share);
  if (share > 0.1) text += ", so that waves that are shorter than those of the surfaces may matter";
  return text;
}

StudySensitivity study_sensitivity(const StudyConfiguration& configuration,
                                   const SensitivityOptions& options) {
  require(options.step >= 1e-3 && options.step <= 0.2, "step", options.step,
          "must be between 0.001 and 0.2");
  const detail::BoundaryElementNumbers study(configuration, options.on_progress);
  StudySensitivity result{.pressures = study.base().pressures,
                          .surfaces = study.surfaces(),
                          .step = options.step,
                          .parameters = {},
                          .left_out = {}};
  // A single surface is also changed by two steps.
  const double widest = (result.surfaces == 1 ? 2 : 1) * options.step;
  const std::vector<Change> changes =
      changes_of(study.base(), study.grid(), options.waves, widest, result.left_out);
  const bool by_law = LawNumbers::possible(study.base());
  const std::vector<Sides> sides = sides_of(study, changes, by_law, options.step);
  if (sides.empty()) {
    result.interrupted = true;
    return result;
  }
  const bool ratio_kept = by_law && stick_solves(study.base());
  for (std::size_t c = 0; c < changes.size(); ++c) {
    ParameterSensitivity& found = result.parameters.emplace_back(changes[c].of);
    for (std::size_t output = 0; output < BoundaryElementNumbers::outputs.size(); ++output) {
      OutputSensitivity one{std::string(BoundaryElementNumbers::outputs[output]), {}};
      const bool tangential = output > 2;  // K_t and the losses
      for (std::size_t k = 0; k < result.pressures.size(); ++k) {
        EnsembleMean& slope = one.at_pressures.emplace_back(derivative(sides[c], output, k));
        if (ratio_kept && tangential && changes[c].kind != Change::Of::motion)
          slope.low -= ratio_response, slope.high += ratio_response;
      }
      if (std::ranges::any_of(one.at_pressures,
                              [](const EnsembleMean& slope) { return !std::isnan(slope.mean); }))
        found.outputs.push_back(std::move(one));
    }
  }
  return result;
}

}  // namespace salebra
