// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra statistics`: roughness parameters, spectra and correlations of a surface.
#include <fmt/format.h>

#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/fill.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/psd_convention.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/summits.hpp>
#include <string_view>

#include "options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "surface_figure.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct StatisticsArguments {
  SurfaceOptions surface;
  std::string window = "default", convention = "salebra";
  bool fill = false;
  std::optional<double> tip_radius, resolution;
};

ResultTable psd_table(const std::string& name, const ConvertedPsd& psd,
                      const std::vector<Index>& modes) {
  return {name,
          {{"wavenumber", psd.wavenumber, psd.wavenumber_unit},
           {name == "psd" ? "psd" : "profile_psd", psd.psd, psd.psd_unit},
           {"modes", {modes.begin(), modes.end()}}},
          psd.normalisation};
}

std::vector<ResultTable> height_tables(const Surface& surface) {
  const BearingCurve curve(surface);
  std::vector<double> fraction, height;
  for (int percent = 0; percent <= 100; ++percent) {
    fraction.push_back(percent / 100.0);
    height.push_back(curve.height(fraction.back()));
  }
  return {{"bearing", {{"area_fraction", fraction}, {"height", height}}},
          table_of("histogram", lists_of(height_histogram(curve)))};
}

Json moments_json(const SpectralMoments& moments) {
  Json object = {{"rms_height", moments.rms_height()}};
  object.add(json_of(moments));
  return object;
}

Json interval_json(const IntervalEstimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

const std::vector<std::string> spectrum_tables{"psd", "profile_psd_x", "profile_psd_y"};
const std::vector<std::string> other_tables{
    "correlation", "correlation_x", "correlation_y", "scale_x", "scale_y", "bearing", "histogram"};

constexpr std::string_view needs_whole =
    "of several processes: no correlation, bearing curve, histogram, Sal, Str, Std, Sk, Spk, Svk, "
    "Smr1, Smr2, Spd and Spc, which need the surface whole";

void run(const StatisticsArguments& arguments, Session& session) {
  for (const auto& [given, option] :
       {std::pair(arguments.fill, "--fill"), {session.has_plot(), "--plot"}})
    if (given) session.require_one_process(option);
  if (!arguments.surface.given()) require_options({"SURFACE (or --recipe)"}, "statistics");
  std::vector<std::string> names = spectrum_tables;
  names.insert(names.end(), other_tables.begin(), other_tables.end());
  require_tables(session, names);
  const PsdConvention convention = *value_of<PsdConvention>(arguments.convention);

  const Surface surface = arguments.surface.read(session);
  const bool whole = surface.ranks.alone();
  const Index undefined = surface.grid.points() - height_statistics(surface).defined_points;
  Json answer = json_of(surface.grid);
  answer.add({{"periodic", surface.periodic},
              {"undefined_points", undefined},
              {"filled_points", arguments.fill ? undefined : 0},
              {"filter", "none"},
              {"areal", json_of(areal_parameters(surface))},
              {"differences", moments_json(difference_moments(surface))}});
  if (surface.periodic && undefined == 0)
    answer["spectral"] = moments_json(spectral_moments(surface));
  answer["summits"] = json_of(summit_statistics(find_summits(surface)));
  answer["reliability"] = json_of(short_wavelength_limit(
      surface, {.tip_radius = arguments.tip_radius, .resolution = arguments.resolution}));

  std::vector<ResultTable> tables;
  Surface without_holes;
  std::optional<PowerSpectrum> spectrum;
  SelfAffineFit fit;
  if (undefined == 0 || arguments.fill) {
    const Surface& complete = undefined == 0 ? surface : (without_holes = filled(surface));
    const Window window = *value_of<Window>(arguments.window);
    spectrum = power_spectrum(complete, window);
    const RadialSpectrum radial = radial_spectrum(*spectrum);
    fit = fit_self_affine(*spectrum);
    tables.push_back(psd_table("psd", converted(radial, surface.grid, convention), radial.modes));
    // Integer wave numbers and cycles in a sample are conventions of surfaces alone.
    const bool of_profiles =
        convention != PsdConvention::tamaas && convention != PsdConvention::rfgen;
    for (const Axis axis : {Axis::x, Axis::y}) {
      const ProfilePsd profiles = profile_psd(complete, axis, window);
      if (profiles.wavenumber.empty()) continue;
      tables.push_back(psd_table(
          axis == Axis::x ? "profile_psd_x" : "profile_psd_y",
          converted(profiles, of_profiles ? convention : PsdConvention::salebra), profiles.modes));
    }
  } else {
    session.note(fmt::format(
        "{} undefined points: no power spectrum; --fill fills them by the smoothest surface",
        undefined));
  }
  answer["hurst"] = interval_json(fit.hurst);
  answer["rolloff"] = interval_json(fit.rolloff);
  answer["short_cutoff"] = interval_json(fit.short_cutoff);
  if (whole) {
    const CorrelationMap map = correlation_map(surface);
    tables.push_back(table_of("correlation", lists_of(radial_correlation(map))));
    tables.push_back(table_of("correlation_x", lists_of(profile_correlation(map, Axis::x))));
    tables.push_back(table_of("correlation_y", lists_of(profile_correlation(map, Axis::y))));
  } else {
    session.note(needs_whole);
  }
  tables.push_back(table_of("scale_x", lists_of(scale_dependence(surface, Axis::x))));
  tables.push_back(table_of("scale_y", lists_of(scale_dependence(surface, Axis::y))));
  if (whole)
    for (ResultTable& table : height_tables(surface)) tables.push_back(std::move(table));

  write_tables(session, "statistics", answer, tables);
  if (session.has_plot()) session.plot(surface_figure(surface, {std::move(spectrum), fit.hurst}));
  std::string text = to_text(answer);
  for (const ResultTable& table : tables)
    if (table.name == "psd" || table.name == "correlation") text += to_text(table);
  session.answer(with_tables(answer, tables), text);
}

}  // namespace

void add_statistics_command(Program& program) {
  auto arguments = std::make_shared<StatisticsArguments>();
  Command& command = program.add_command(
      "statistics", "spectrum, correlation, bearing curve and areal parameters of a surface",
      {"salebra statistics scan.txt -o scan.csv --plot scan.png",
       "salebra statistics scan.sur --detrend quadratic --fill --tip-radius 10nm --convention "
       "surface-topography --json"},
      [arguments](Session& session) { run(*arguments, session); },
      "heights, power spectral density with the fitted law, distribution of heights",
      OutputCheck::any_name);
  arguments->surface.add_to(command, false);
  arguments->surface.add_recipe_to(command);
  add_choice<Window>(command, "--window", arguments->window,
                     "of the spectra; default none if periodic, hann if not");
  add_choice<PsdConvention>(
      command, "--convention", arguments->convention,
      "of the power spectral density; default salebra, rms_height^2 = integral of C d^2q");
  command.add_flag("--fill", arguments->fill,
                   "fill undefined points by the smoothest surface, for the spectra only");
  add_quantity(command, "--tip-radius", arguments->tip_radius, Dimension::length,
               "of the scanning probe: gives the wavelength below which it shows");
  add_quantity(command, "--resolution", arguments->resolution, Dimension::length,
               "lateral resolution of the instrument");
}

}  // namespace salebra::cli
