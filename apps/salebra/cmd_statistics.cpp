// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra statistics`: roughness parameters, spectra and correlations of a surface.
#include <fmt/format.h>

#include <limits>
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

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<double> as_numbers(const std::vector<Index>& counts) {
  return {counts.begin(), counts.end()};
}

ResultTable psd_table(const std::string& name, const ConvertedPsd& psd,
                      const std::vector<Index>& modes) {
  return {name,
          {{"wavenumber", psd.wavenumber, psd.wavenumber_unit},
           {name == "psd" ? "psd" : "profile_psd", psd.psd, psd.psd_unit},
           {"modes", as_numbers(modes)}},
          psd.normalisation};
}

ResultTable correlation_table(const std::string& name, const Correlation& correlation) {
  return {name,
          {{"distance", correlation.distance},
           {"autocorrelation", correlation.autocorrelation},
           {"structure", correlation.structure},
           {"pairs", correlation.pairs}}};
}

ResultTable scale_table(const std::string& name, const ScaleDependence& scales) {
  return {name,
          {{"spacing", scales.spacing},
           {"profile_slope", scales.profile_slope},
           {"profile_curvature", scales.profile_curvature},
           {"min_curvature", scales.min_curvature},
           {"stencils", as_numbers(scales.stencils)}}};
}

std::vector<ResultTable> height_tables(const Surface& surface) {
  const BearingCurve curve(surface);
  const HeightHistogram histogram = height_histogram(curve);
  std::vector<double> fraction, height;
  for (int percent = 0; percent <= 100; ++percent) {
    fraction.push_back(percent / 100.0);
    height.push_back(curve.height(fraction.back()));
  }
  return {{"bearing", {{"area_fraction", fraction}, {"height", height}}},
          {"histogram",
           {{"height", histogram.height},
            {"height_density", histogram.height_density},
            {"points", as_numbers(histogram.points)}}}};
}

Json areal_json(const ArealParameters& p) {
  return Json{{"Sa", p.Sa},     {"Sq", p.Sq},     {"Ssk", p.Ssk}, {"Sku", p.Sku}, {"Sp", p.Sp},
              {"Sv", p.Sv},     {"Sz", p.Sz},     {"Sal", p.Sal}, {"Str", p.Str}, {"Std", p.Std},
              {"Sdq", p.Sdq},   {"Sdr", p.Sdr},   {"Sk", p.Sk},   {"Spk", p.Spk}, {"Svk", p.Svk},
              {"Smr1", p.Smr1}, {"Smr2", p.Smr2}, {"Spd", p.Spd}, {"Spc", p.Spc}};
}

Json moments_json(const SpectralMoments& moments) {
  return Json{{"rms_height", moments.rms_height()}, {"rms_slope", moments.rms_slope()},
              {"moment0", moments.moment0},         {"moment2", moments.moment2()},
              {"moment4", moments.moment4()},       {"nayak", moments.nayak()}};
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
  Json answer = {{"nx", surface.grid.nx},
                 {"ny", surface.grid.ny},
                 {"size_x", surface.grid.lx},
                 {"size_y", surface.grid.ly},
                 {"periodic", surface.periodic},
                 {"undefined_points", undefined},
                 {"filled_points", arguments.fill ? undefined : 0},
                 {"filter", "none"},
                 {"areal", areal_json(areal_parameters(surface))},
                 {"differences", moments_json(difference_moments(surface))}};
  if (surface.periodic && undefined == 0)
    answer["spectral"] = moments_json(spectral_moments(surface));
  const SummitStatistics summits = summit_statistics(find_summits(surface));
  answer["summits"] = {{"summit_density", summits.density},
                       {"mean_height", summits.mean_height},
                       {"rms_height", summits.rms_height},
                       {"mean_radius", summits.mean_radius}};
  const ReliabilityLimit limit = short_wavelength_limit(
      surface, {.tip_radius = arguments.tip_radius, .resolution = arguments.resolution});
  answer["reliability"] = {{"pixel_limit", limit.pixel},
                           {"tip_limit", limit.tip.value_or(none)},
                           {"resolution", limit.resolution.value_or(none)},
                           {"wavelength", limit.wavelength()}};

  std::vector<ResultTable> tables;
  Surface without_holes;
  std::optional<PowerSpectrum> spectrum;
  SelfAffineFit fit;
  fit.hurst.value = fit.hurst.low = fit.hurst.high = none;
  fit.rolloff = fit.short_cutoff = {none, none, none};
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
  answer["hurst"] = {{"value", fit.hurst.value}, {"low", fit.hurst.low}, {"high", fit.hurst.high}};
  answer["rolloff"] = interval_json(fit.rolloff);
  answer["short_cutoff"] = interval_json(fit.short_cutoff);
  if (whole) {
    const CorrelationMap map = correlation_map(surface);
    tables.push_back(correlation_table("correlation", radial_correlation(map)));
    tables.push_back(correlation_table("correlation_x", profile_correlation(map, Axis::x)));
    tables.push_back(correlation_table("correlation_y", profile_correlation(map, Axis::y)));
  } else {
    session.note(needs_whole);
  }
  tables.push_back(scale_table("scale_x", scale_dependence(surface, Axis::x)));
  tables.push_back(scale_table("scale_y", scale_dependence(surface, Axis::y)));
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
