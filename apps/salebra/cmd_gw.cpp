// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra gw`: Greenwood-Williamson curves of a surface or of given parameters.
#include <fmt/format.h>

#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/results/columns.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>

#include "curve_figure.hpp"
#include "curve_json.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct GwArguments {
  SurfaceOptions surface;
  MaterialOptions material;
  std::string summits = "moments";
  std::optional<double> summit_density, radius, summit_rms;
  std::string distribution = "gaussian";
  std::vector<double> separations, pressures;
};

/// A model with the parameters that describe it.
struct DescribedLaw {
  std::unique_ptr<AsperityModel> model;
  Json parameters;
};

Json summits_json(const SummitEnsemble& ensemble) {
  Json object = json_of(ensemble);
  object["distribution"] = word_of(ensemble.distribution);
  return object;
}

DescribedLaw of_surface(const GwArguments& arguments, const Material& material, Session& session) {
  for (const auto& [option, given] :
       {std::pair{"--summit-density", arguments.summit_density.has_value()},
        {"--radius", arguments.radius.has_value()},
        {"--summit-rms", arguments.summit_rms.has_value()}})
    require_that(!given, option,
                 "given together with a surface, which has its own summits; leave out one of them");
  const Surface surface = arguments.surface.read(session);
  const HeightStatistics heights = height_statistics(surface);
  if (arguments.summits == "deterministic") {
    const SummitList list = find_summits(surface);
    SummitEnsemble ensemble = summit_ensemble(summit_statistics(list), heights.mean);
    ensemble.rms_height = heights.rms_height;
    return {std::make_unique<DeterministicSummits>(list.summits, material, list.searched_area,
                                                   heights.mean, heights.rms_height),
            summits_json(ensemble)};
  }
  surface.require_complete("spectral moments");
  const SpectralMoments moments = surface_moments(surface);
  SummitEnsemble ensemble = summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
  ensemble.distribution = *value_of<SummitDistribution>(arguments.distribution);
  ensemble.rms_height = heights.rms_height;
  return {std::make_unique<StatisticalSummits>(ensemble, material, surface.grid.area()),
          summits_json(ensemble)};
}

DescribedLaw of_parameters(const GwArguments& arguments, const Material& material) {
  constexpr std::string_view reason = "there is no SURFACE to take it from";
  SummitEnsemble ensemble;
  ensemble.summit_density = required(arguments.summit_density, "--summit-density", reason);
  ensemble.radius = required(arguments.radius, "--radius", reason);
  ensemble.summit_rms = required(arguments.summit_rms, "--summit-rms", reason);
  if (arguments.distribution == "exponential") {
    ensemble.distribution = SummitDistribution::exponential;
  }
  const double size_x = arguments.surface.size_x.value_or(1);
  const double size_y = arguments.surface.size_y.value_or(1);
  require_positive(size_x, "--size-x");
  require_positive(size_y, "--size-y");
  return {std::make_unique<StatisticalSummits>(ensemble, material, size_x * size_y),
          summits_json(ensemble)};
}

void run(const GwArguments& arguments, Session& session) {
  require_one(!arguments.pressures.empty(), "--pressures", !arguments.separations.empty(),
              "--separations");
  for (const double pressure : arguments.pressures) require_positive(pressure, "--pressures");
  const Material material = arguments.material.material();
  const DescribedLaw described = arguments.surface.given()
                                     ? of_surface(arguments, material, session)
                                     : of_parameters(arguments, material);
  const ForceCurve curve = arguments.pressures.empty()
                               ? curve_at_separations(*described.model, arguments.separations)
                               : curve_at_pressures(*described.model, arguments.pressures);
  if (session.has_output())
    write_force_curve(session.output(), curve, session.provenance(), session.write_options());
  if (session.has_plot()) session.plot(curve_figure(curve));
  session.answer(Json{{"parameters", described.parameters}, {"curve", to_json(curve)}});
}

}  // namespace

void add_gw_command(Program& program) {
  auto arguments = std::make_shared<GwArguments>();
  Command& command = program.add_command(
      "gw", "Greenwood-Williamson contact of a surface or of given summits",
      {"salebra gw rough.h5 --summits deterministic --pressures 1:100MPa:16 --contact-modulus "
       "115GPa --poisson 0.3",
       "salebra gw --summit-density 10/um2 --radius 100nm --summit-rms 10nm --distribution "
       "exponential "
       "--separations 10nm,20nm,40nm --contact-modulus 115GPa"},
      [arguments](Session& session) { run(*arguments, session); },
      "pressure over gap, area, stiffness", OutputCheck::curve);
  arguments->surface.add_to(command, false);
  add_choice(command, "--summits", arguments->summits, {"moments", "deterministic"},
             "of a surface; default moments");
  add_quantity(command, "--summit-density", arguments->summit_density,
               Dimension::inverse_length_squared, "summits per area, without a surface");
  add_quantity(command, "--radius", arguments->radius, Dimension::length,
               "of the summits, without a surface");
  add_quantity(command, "--summit-rms", arguments->summit_rms, Dimension::length,
               "of summit heights, without a surface");
  add_choice(command, "--distribution", arguments->distribution, {"gaussian", "exponential"},
             "of summit heights; default gaussian");
  add_values(command, "--separations", arguments->separations, Dimension::length,
             "smooth plane to mean plane of summits");
  add_values(command, "--pressures", arguments->pressures, Dimension::pressure,
             "nominal pressures, instead of --separations");
  arguments->material.add_to(command);
}

}  // namespace salebra::cli
