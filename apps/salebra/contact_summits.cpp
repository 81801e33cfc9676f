// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra contact --model gw_…`: Greenwood-Williamson curves of a surface or of given parameters.
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>  // analysis/ has no problem for it
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>

#include "contact_command.hpp"
#include "results/columns.hpp"

namespace salebra::cli {
namespace {

/// A Greenwood–Williamson model, and the ensemble of summits that describes the surface.
struct DescribedModel {
  std::unique_ptr<AsperityModel> model;
  SummitEnsemble ensemble;
};

DescribedModel statistical(const SummitEnsemble& ensemble, const Material& material, double area) {
  return {std::make_unique<StatisticalSummits>(ensemble, material, area), ensemble};
}

DescribedModel of_surface(const ContactArguments& arguments, const Material& material,
                          Session& session) {
  arguments.command->require_none_of(
      "Summits without a surface",
      "given together with a surface, which has its own summits; leave out one of the two");
  const Surface surface = arguments.surface.read(session);
  const HeightStatistics heights = height_statistics(surface);
  if (surface.undefined_points() == 0)
    session.warn(warnings_of_lay(
        surface_lay(surface), arguments.model == "gw_moments" ? significant_skewness(surface) : 0,
        "the summits of the model are spheres, and its surface is isotropic",
        "the summit density, radius and heights of the model follow from moments of a Gaussian "
        "surface"));
  if (arguments.model == "gw_deterministic") {
    const SummitList list = find_summits(surface);
    SummitEnsemble ensemble = summit_ensemble(summit_statistics(list), heights.mean);
    ensemble.rms_height = heights.rms_height;
    return {std::make_unique<DeterministicSummits>(list.summits, material, list.searched_area,
                                                   heights.mean, heights.rms_height),
            ensemble};
  }
  surface.require_complete("spectral moments");
  const SpectralMoments moments = surface_moments(surface);
  SummitEnsemble ensemble = summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
  ensemble.distribution = *parse_enum<SummitDistribution>(arguments.distribution);
  ensemble.rms_height = heights.rms_height;
  return statistical(ensemble, material, surface.grid.area());
}

DescribedModel of_parameters(const ContactArguments& arguments, const Material& material) {
  constexpr std::string_view reason = "without a SURFACE it must be given";
  require_that(arguments.model == "gw_moments", "--model",
               arguments.model + " takes the summits of a surface; give SURFACE (or --recipe)");
  SummitEnsemble ensemble;
  ensemble.summit_density = required(arguments.summit_density, "--summit-density", reason);
  ensemble.radius = required(arguments.radius, "--radius", reason);
  ensemble.summit_rms = required(arguments.summit_rms, "--summit-rms", reason);
  ensemble.distribution = *parse_enum<SummitDistribution>(arguments.distribution);
  const double size_x = arguments.surface.size_x.value_or(1);
  const double size_y = arguments.surface.size_y.value_or(1);
  require_positive(size_x, "--size-x");
  require_positive(size_y, "--size-y");
  return statistical(ensemble, material, size_x * size_y);
}

ForceCurve curve_of(const ContactArguments& arguments, const AsperityModel& model) {
  const AsperityModel::Common& common = model.common();
  const std::vector<double> pressures = arguments.pressures_on(common.nominal_area);
  if (!pressures.empty()) return curve_at_pressures(model, pressures);
  std::vector<double> separations;
  for (const double gap : arguments.at.mean_gap) separations.push_back(gap - common.mean_height);
  for (const double depth : arguments.at.indentation)
    separations.push_back(common.first_touch - depth);
  return curve_at_separations(model, separations);
}

}  // namespace

void press_summits(const ContactArguments& arguments, Session& session) {
  session.require_one_process("--model " + arguments.model);
  const Material material = arguments.material.material();
  const auto [model, ensemble] = arguments.surface.given()
                                     ? of_surface(arguments, material, session)
                                     : of_parameters(arguments, material);
  const ForceCurve curve = curve_of(arguments, *model);
  Json parameters = json_of(ensemble);
  parameters["distribution"] = name_of(ensemble.distribution);
  answer_curve(arguments, curve, Json{{"parameters", parameters}, {"curve", to_json(curve)}},
               session);
}

}  // namespace salebra::cli
