// SPDX-License-Identifier: GPL-3.0-or-later
// The surfaces of a study, and the loads on them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <string>
#include <utility>

#include "case_run.hpp"
#include "contact_models.hpp"
#include "surface/plausibility.hpp"

namespace salebra {
namespace {

Surface generate(const GeneratedSurfaces& recipe, std::uint64_t seed, const Progress& progress,
                 const Communicator& communicator) {
  const auto spectrum = recipe.spectrum_of(seed);
  if (const SurfaceTexture& texture = recipe.texture_of(seed); !texture.gaussian()) {
    require_that(communicator.size() == 1, "skewness",
                 "heights that are not Gaussian are made by a single process only");
    NonGaussianSurface made =
        non_gaussian(recipe.grid, *spectrum, johnson_heights(texture.skewness, texture.kurtosis),
                     seed, {.exact = Exact::process, .on_progress = progress});
    return std::move(made.surface);
  }
  return recipe.method == GenerationMethod::random_phase
             ? random_phase(recipe.grid, *spectrum, seed, progress, communicator)
             : filtered_noise(recipe.grid, *spectrum, seed, progress, communicator);
}

}  // namespace

Surface measured_surface(const MeasuredSurface& recipe, const Communicator& communicator,
                         std::vector<std::string>* warnings) {
  require_that(!recipe.file.empty(), "surface",
               "not given; name a file, or describe surfaces to generate");
  ReadOptions options = recipe.reading();
  options.warnings = warnings;
  Surface surface = read_surface(recipe.file, options, communicator);
  collectively(communicator, [&] { surface.require_complete_rows("a study"); });
  const Detrend trend = recipe.detrend.value_or(default_detrend(surface));
  return filtered(detrended(std::move(surface), trend), recipe.filters);
}

Surface study_surface(const StudyConfiguration& configuration, std::uint64_t seed,
                      const Progress& progress, const Communicator& communicator) {
  if (const auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces))
    return generate(*recipe, seed, progress, communicator);
  return measured_surface(std::get<MeasuredSurface>(configuration.surfaces), communicator);
}

namespace {

/// Removes default loads above half of the hardness, and warns of it. Throws if the largest load
/// exceeds the hardness.
void require_below_hardness(const StudyConfiguration& configuration, StudyLoads& loads) {
  const double hardness = configuration.known.hardness;
  std::vector<double>& pressures = loads.pressures;
  const auto text = [](double pressure) {
    return format_quantity(pressure, Dimension::pressure, 3);
  };
  const auto below =
      std::ranges::count_if(pressures, [&](double pressure) { return !(pressure > hardness / 2); });
  constexpr std::ptrdiff_t least = 4;  // number of loads that a curve needs
  if (configuration.pressures_below_hardness && below < std::ssize(pressures) && below >= least) {
    loads.warnings.push_back(fmt::format(
        "loads end at {}, {} of the default {}, because they are limited to half of the hardness "
        "of {}",
        text(pressures[std::size_t(below) - 1]), below, pressures.size(), text(hardness)));
    pressures.resize(std::size_t(below));
  }
  require(!(pressures.back() > hardness), "hardness", text(hardness),
          fmt::format(
              "is below the largest load, {}; choose loads below it{}", text(pressures.back()),
              loads.contact_scale > 0 ? fmt::format(", which is {:.2g} of E* times the rms slope",
                                                    hardness / loads.contact_scale)
                                      : ""));
}

/// The lay that a recipe asks for.
SurfaceLay lay_of(const SurfaceTexture& texture) {
  const Anisotropy& stretch = texture.lay;
  SurfaceLay lay;
  const double peklenik = stretch.peklenik();
  lay.ratio = lay.ratio_low = lay.ratio_high = std::max(peklenik, 1 / peklenik);
  lay.angle = stretch.angle + (peklenik < 1 ? std::numbers::pi / 2 : 0);
  lay.angle_error = 0;
  lay.significant = lay.ratio > 1;
  return lay;
}

/// The lay of the surfaces of a study. That of a recipe is known, so no surface has a lay by chance.
SurfaceLay lay_of(const StudyConfiguration& configuration, const Surface& surface) {
  const auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
  return recipe ? lay_of(recipe->textures.front()) : surface_lay(surface);
}

/// Warns of a lay and of skew heights, on which the results of these models depend.
void warn_of_lay(const SurfaceLay& lay, double skewness, const StudyConfiguration& configuration,
                 StudyLoads& loads) {
  const bool theories = std::ranges::any_of(
      configuration.models, [](ContactModel model) { return model != ContactModel::bem; });
  const bool stick = stick_solves(configuration);
  std::string by_lay;
  if (!stick)
    by_lay =
        "the tangential stiffness and the damping constant are those of an isotropic surface, "
        "(G*/E*)K; along and across the lay they differ, as stick solves show";
  if (theories)
    by_lay += by_lay.empty() ? "the models other than boundary elements assume an isotropic surface"
                             : ". The models other than boundary elements do too";
  std::ranges::move(
      warnings_of_lay(
          lay, skewness, by_lay,
          theories ? "the models other than boundary elements assume Gaussian heights" : ""),
      std::back_inserter(loads.warnings));
}

/// E* of the half-spaces, or pressure_scale()/h' of the first surface on another body. Throws
/// InvalidInput for what is not computed on such a body.
double modulus_of(const StudyConfiguration& configuration, const Communicator& communicator) {
  if (!configuration.body) return configuration.material.contact_modulus;
  const Conduction& conduction = configuration.conduction;
  for (const auto& [given, what] :
       {std::pair{configuration.models != std::vector{ContactModel::bem}, "the models of summits"},
        {!conduction.conductivity.empty() || !conduction.resistivity.empty(), "conductance"},
        {!std::isnan(configuration.known.hardness), "a `hardness`"},
        {configuration.damping.amplitude == Amplitude::small, "the small amplitude"},
        {!configuration.stick, "tangential stiffness in proportion to K"}})
    require_that(!given, "body",
                 fmt::format("given together with {}, known for homogeneous half-spaces only; "
                             "leave one of them out",
                             what));
  const Surface first =
      study_surface(configuration, detail::seeds_of(configuration).front(), {}, communicator);
  return pressure_scale(first, *configuration.body) / surface_moments(first).rms_slope();
}

}  // namespace

double detail::lay_angle_of(const StudyConfiguration& configuration, const Surface& surface) {
  const SurfaceLay lay = lay_of(configuration, surface);
  return lay.found() ? lay.angle : SurfaceLay::unknown;
}

std::vector<double> directions_of(const StudyConfiguration& configuration, const Surface& surface) {
  const bool chosen = configuration.direction != DirectionChoice(LayDirection::automatic);
  require_that(stick_solves(configuration) || !chosen, "direction",
               "given without stick solves: (G*/E*)K has no direction; leave it out");
  if (!stick_solves(configuration) || (configuration.adhesion && !chosen)) return {0};
  std::vector<double> directions =
      directions_of(configuration.direction, lay_of(configuration, surface));
  require(!configuration.adhesion || directions.size() == 1, "direction", "both",
          "gives two directions; a study with adhesion takes one");
  return directions;
}

StudyLoads study_loads(const StudyConfiguration& configuration, const Communicator& communicator) {
  StudyLoads loads{.pressures = configuration.pressures};
  std::optional<std::string> warning;
  double slope = 0;
  Grid2D grid;
  if (const auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces)) {
    slope = recipe->spectrum_of_all()->lattice_moments(recipe->grid).rms_slope();
    warning = warning_of_slope(slope);
    grid = recipe->grid;
    const SurfaceTexture& texture = recipe->textures.front();
    warn_of_lay(lay_of(texture), texture.skewness, configuration, loads);
  } else {
    const auto& measured = std::get<MeasuredSurface>(configuration.surfaces);
    const Surface surface = measured_surface(measured, communicator, &loads.warnings);
    slope = surface_moments(surface).rms_slope();
    grid = surface.grid;
    warn_of_lay(surface_lay(surface), significant_skewness(surface), configuration, loads);
  }
  const double modulus = modulus_of(configuration, communicator);
  const bool adhesive = configuration.adhesion.has_value();
  require(adhesive || std::ranges::none_of(configuration.models, is_adhesive), "models",
          "gw_dmt, gw_jkr", "need adhesion; give [adhesion] in the study file");
  require(!adhesive || std::isnan(configuration.known.hardness), "hardness",
          configuration.known.hardness,
          "with adhesion needs a single first loading, which `contact` computes; leave out one of "
          "them");
  if (adhesive)
    if (const auto coarse =
            warning_of_process_zone(configuration.adhesion->adhesion, grid, modulus))
      loads.warnings.push_back(*coarse);
  loads.contact_scale = modulus * slope;
  loads.contact_modulus = modulus;
  if (configuration.relative_pressures)
    for (double& pressure : loads.pressures) pressure *= loads.contact_scale;
  // Relative pressures are too large if the slope is too large; then the warning about the slope is
  // enough.
  if (!warning && !(configuration.relative_pressures && slope > 1))
    warning = warning_of_pressure(loads.pressures.back(), modulus);
  if (warning) loads.warnings.push_back(*warning);
  require_below_hardness(configuration, loads);
  require(
      configuration.intervals != 0 || !(configuration.relative_error > 0 || configuration.seam),
      "intervals", 0,
      "intervals give no error; use 4 or more, or leave out `relative_error` and the error of the "
      "seam");
  if (const auto& window = configuration.window) {
    const auto inside = std::ranges::count_if(
        loads.pressures, [&](double pressure) { return window->contains(pressure); });
    require(inside >= 3, "pressure_window", inside,
            "pressures lie in it, but a fit needs 3; widen it or compute more pressures");
  }
  return loads;
}

}  // namespace salebra
