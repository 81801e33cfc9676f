// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra statistics`: roughness parameters, spectra and correlations of a surface.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/fill.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/profile_fit.hpp>
#include <salebra/surface/profile_parameters.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/summits.hpp>
#include <string_view>
#include <utility>

#include "answers.hpp"
#include "options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "results/answer_json.hpp"
#include "several_files.hpp"
#include "surface/asymmetry.hpp"
#include "surface/psd_convention.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct StatisticsArguments {
  SurfaceOptions surface;
  std::string window = "default", convention = "salebra", csv;
  bool all = false;
  bool in_table = false;  ///< whether the surface is one of several
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

std::vector<ResultTable> height_tables(const BearingCurve& curve) {
  BearingTable bearing;
  for (int percent = 0; percent <= 100; ++percent) {
    bearing.area_fraction.push_back(percent / 100.0);
    bearing.height.push_back(curve.height(percent / 100.0));
  }
  return {table_of("bearing", lists_of(bearing)),
          table_of("histogram", lists_of(height_histogram(curve)))};
}

const std::vector<std::string> spectrum_tables{"psd", "profile_psd_x", "profile_psd_y"};
const std::vector<std::string> other_tables{
    "correlation", "correlation_x", "correlation_y", "scale_x", "scale_y", "bearing", "histogram"};

constexpr std::string_view needs_whole =
    "with several processes there are no correlation, bearing curve, histogram, Sal, Str, Std, Sk, "
    "Spk, Svk, Smr1, Smr2, Spd and Spc, because they need the whole surface";

constexpr std::string_view no_hurst =
    "no Hurst exponent: in no range of reliable wavelengths the spectrum follows a self-affine law "
    "closely enough for an interval";

/// Notes which waves the fit of the Hurst exponent left out, and why. asymmetric: share of these
/// waves, see PowerSpectrum.
void note_asymmetry(const StatisticsArguments& arguments, double asymmetric, Session& session) {
  if (arguments.tip_radius || arguments.resolution || asymmetric == 0) return;
  const std::string waves =
      std::isinf(asymmetric) ? "no wave enters"
                             : fmt::format("waves below {:.3g} um do not enter", 1e6 * asymmetric);
  session.inform("peaks and valleys differ, as they do under a scanning tip: " + waves +
                 " the fit of the Hurst exponent; --tip-radius or --resolution gives the shortest "
                 "reliable wavelength");
}

ReliabilityLimit reliability(const StatisticsArguments& arguments, const Surface& surface) {
  return short_wavelength_limit(
      surface, {.tip_radius = arguments.tip_radius, .resolution = arguments.resolution});
}

/// Shortest wavelength, m, that the instrument resolves; shorter waves are artefacts. 0 if the
/// instrument is not known.
double reliable_wavelength(const StatisticsArguments& arguments, const Surface& surface) {
  return arguments.tip_radius || arguments.resolution ? reliability(arguments, surface).wavelength()
                                                      : 0;
}

constexpr std::string_view law_of_unfiltered =
    "the fitted law (hurst, rolloff, short_cutoff) and the reliable wavelength are those of the "
    "heights before the filters";

/// Adds the cut-offs of the filters to the answer, as far as they were given.
void add_filters(Json& answer, const GaussianFilters& filters) {
  if (filters.s_filter) answer["s_filter"] = *filters.s_filter;
  if (filters.l_filter) answer["l_filter"] = *filters.l_filter;
}

/// The surface before and after the filters. Without filters `measured` is empty.
struct FilteredSurface {
  Surface rough;
  std::optional<Surface> measured = {};

  const Surface& unfiltered() const { return measured ? *measured : rough; }
};

FilteredSurface read_surface_of(const StatisticsArguments& arguments, Session& session) {
  SurfaceOptions options = arguments.surface;
  const GaussianFilters filters = std::exchange(options.filters, {});
  Surface measured = options.read(session, Undefined::keep);
  if (!filters.given()) return {std::move(measured)};
  Surface rough = filtered(measured, filters);
  return {std::move(rough), std::move(measured)};
}

/// The self-affine law of a surface: across and along its lay, if it has one, which the mean over
/// all directions does not describe.
struct FittedLaw {
  SelfAffineFit mean;
  std::optional<DirectionalSelfAffineFit> of_lay = {};

  bool found() const { return of_lay ? of_lay->across.hurst.found() : mean.hurst.found(); }
};

void add_law(Json& answer, const SelfAffineFit& law) {
  answer["hurst"] = to_json<IntervalEstimate>(law.hurst);
  answer["rolloff"] = to_json(law.rolloff);
  answer["short_cutoff"] = to_json(law.short_cutoff);
}

/// Grid, roughness and Hurst exponent: the part of the answer that is always printed.
Json summary(const StatisticsArguments& arguments, const FilteredSurface& surfaces, Index undefined,
             const FittedLaw& fit, const SurfaceLay& lay) {
  const Surface& surface = surfaces.rough;
  const HeightStatistics heights = height_statistics(surface);
  Json answer = json_of(surface.grid);
  add_filters(answer, arguments.surface.filters);
  answer.add(json_of(SurfacePoints{surface.periodic, undefined,
                                   arguments.surface.fill ? undefined : 0, heights.mean}));
  answer.add(json_of(heights));
  answer.add(json_of(undefined > 0 ? difference_moments(surface) : surface_moments(surface)));
  answer.add(json_of(lay));
  if (fit.of_lay) {
    add_law(answer["across"], fit.of_lay->across);
    add_law(answer["along"], fit.of_lay->along);
  } else {
    add_law(answer, fit.mean);
  }
  answer["summits"] = json_of(summit_statistics(find_summits(surface)));
  answer["reliability"] = json_of(reliability(arguments, surfaces.unfiltered()));
  return answer;
}

/// Tables of the spectra of a surface without undefined points.
std::vector<ResultTable> spectra(const Surface& complete, const PowerSpectrum& spectrum,
                                 Window window, PsdConvention convention) {
  const RadialSpectrum radial = radial_spectrum(spectrum);
  std::vector<ResultTable> tables{
      psd_table("psd", converted(radial, complete.grid, convention), radial.modes)};
  // The conventions with integer wave numbers and with cycles per sample exist only for surfaces,
  // not for profiles.
  const bool of_profiles =
      convention != PsdConvention::tamaas && convention != PsdConvention::rfgen;
  for (const Axis axis : {Axis::x, Axis::y}) {
    const ProfilePsd profiles = profile_psd(complete, axis, window);
    if (profiles.wavenumber.empty()) continue;
    tables.push_back(psd_table(
        axis == Axis::x ? "profile_psd_x" : "profile_psd_y",
        converted(profiles, of_profiles ? convention : PsdConvention::salebra), profiles.modes));
  }
  return tables;
}

/// Computes areal parameters, and adds to `tables`, unless it is nullptr, those that a surface with
/// undefined points has too. spectrum: of the surface with its default window; nullptr if it has undefined points.
ArealParameters other_statistics(const Surface& surface, const PowerSpectrum* spectrum,
                                 std::vector<ResultTable>* tables) {
  std::optional<CorrelationMap> map;
  std::optional<BearingCurve> curve;
  if (surface.communicator.alone()) {
    map = correlation_map(surface);
    curve.emplace(surface);
  }
  const ArealParameters areal =
      areal_parameters(surface, {map ? &*map : nullptr, spectrum, curve ? &*curve : nullptr});
  if (!tables) return areal;
  if (map) {
    tables->push_back(table_of("correlation", lists_of(radial_correlation(*map))));
    tables->push_back(table_of("correlation_x", lists_of(profile_correlation(*map, Axis::x))));
    tables->push_back(table_of("correlation_y", lists_of(profile_correlation(*map, Axis::y))));
  }
  tables->push_back(table_of("scale_x", lists_of(scale_dependence(surface, Axis::x))));
  tables->push_back(table_of("scale_y", lists_of(scale_dependence(surface, Axis::y))));
  if (curve)
    for (ResultTable& table : height_tables(*curve)) tables->push_back(std::move(table));
  return areal;
}

void analyse(const StatisticsArguments& arguments, const FilteredSurface& surfaces,
             Session& session) {
  const Surface& surface = surfaces.rough;
  const PsdConvention convention = *parse_enum<PsdConvention>(arguments.convention);
  const Window window = *parse_enum<Window>(arguments.window);
  const bool all = arguments.all || session.has_output();
  const Index undefined = surface.grid.points() - height_statistics(surface).defined_points;
  std::vector<ResultTable> tables;
  std::optional<PowerSpectrum> spectrum, other;
  double asymmetric = 0;
  FittedLaw fit;
  SurfaceLay lay;
  if (undefined == 0 || arguments.surface.fill) {
    Surface without_holes;
    const Surface& complete = undefined == 0 ? surface : (without_holes = filled(surface));
    spectrum = power_spectrum(complete, window);
    lay = surface_lay(complete);
    // A lay makes the law that of profiles, whose spectrum needs a window on every surface.
    const bool windowless =
        window == Window::none || (window == Window::automatic && complete.periodic);
    const Window of_law = lay.found() && complete.periodic && windowless ? Window::hann : window;
    if (surfaces.measured || of_law != window)
      other = power_spectrum(!surfaces.measured ? complete
                             : undefined == 0   ? *surfaces.measured
                                                : filled(*surfaces.measured),
                             of_law);
    const PowerSpectrum& fitted = other ? *other : *spectrum;
    asymmetric = fitted.asymmetric_wavelength;
    // Without a window, the spectrum of a surface that is not periodic contains the steps between
    // opposite edges, which would falsify the fit.
    const double reliable = reliable_wavelength(arguments, surfaces.unfiltered());
    if (lay.found() && fitted.windowed)
      fit.of_lay = fit_self_affine(fitted, lay, reliable);
    else if (complete.periodic || fitted.windowed)
      fit.mean = fit_self_affine(fitted, reliable);
    if (all) tables = spectra(complete, *spectrum, window, convention);
  }
  const Json answer = summary(arguments, surfaces, undefined, fit, lay);
  if (lay.found()) session.inform(lay_in_words(lay));
  // Only surfaces with this many points in each direction get a note if no exponent was found.
  constexpr Index expected = 32;
  if (spectrum && std::min(surface.grid.nx, surface.grid.ny) >= expected) {
    if (!fit.found())
      session.inform(surface.periodic || spectrum->windowed ? no_hurst
                                                            : "no Hurst exponent without a window");
    note_asymmetry(arguments, asymmetric, session);
  }
  if (!spectrum)
    session.inform(fmt::format(
        "no power spectrum, because {} undefined; --fill fills in the smoothest surface",
        undefined == 1 ? "1 point is" : fmt::format("{} points are", undefined)));
  if (surfaces.measured) session.inform(law_of_unfiltered);
  Json whole = answer;
  if (all || arguments.in_table) {
    if (!surface.communicator.alone()) session.inform(needs_whole);
    const bool own = undefined == 0 && window == Window::automatic;
    whole["areal"] =
        json_of(other_statistics(surface, own ? &*spectrum : nullptr, all ? &tables : nullptr));
    if (surface.communicator.alone())
      for (const auto& [axis, name] : {std::pair(Axis::x, "profiles_x"), {Axis::y, "profiles_y"}})
        whole[name] =
            json_of(profile_parameters(surfaces.unfiltered(), axis, arguments.surface.filters));
    whole["differences"] = json_of(difference_moments(surface));
  }
  write_tables(session, "statistics", whole, tables);
  if (session.has_plot())
    // The spectra across and along a lay are those with a window.
    session.plot(figures::figure_of(
        surface,
        {fit.of_lay && other && !surfaces.measured ? std::move(other) : std::move(spectrum),
         fit.mean, fit.of_lay, lay}));
  if (!arguments.all) return session.answer(arguments.in_table ? whole : answer);
  std::string text = to_text(whole);
  for (const ResultTable& table : tables)
    if (table.name == "psd" || table.name == "correlation") text += to_text(table);
  session.answer(with_tables(whole, tables), text);
}

/// The command line that generates an isotropic surface with the fitted spectrum of a profile. The
/// shortest wave has four points. The surface is as long as the profile if 2048 points are enough.
std::string generation(const Grid2D& line, const ProfileFit& fit) {
  const auto text = [](double length) { return fmt::format("{:.3g}um", 1e6 * length); };
  const double shortest = std::isnan(fit.short_cutoff) ? 2 * line.dx() : fit.short_cutoff;
  const double step = shortest / 4;
  Index points = 256;
  while (points < 2048 && static_cast<double>(points) * step < line.lx) points *= 2;
  std::string command = fmt::format(
      "salebra generate --points {} --size-x {} --hurst {:.2f} --short-cutoff {} --rms-slope "
      "{:.3g}",
      points, text(static_cast<double>(points) * step), std::clamp(fit.hurst.value, 0.01, 1.0),
      text(shortest), fit.surface_slope);
  if (!std::isnan(fit.rolloff)) command += " --rolloff " + text(fit.rolloff);
  return command + " -o surface.h5";
}

/// Answers for a line profile with its own statistics, and with the parameters of the isotropic
/// surface that has such profiles.
void analyse_profile(const StatisticsArguments& arguments, const FilteredSurface& profiles,
                     Session& session) {
  const Surface& measured = profiles.unfiltered();
  const Surface& profile = profiles.rough;
  const Index undefined = profile.undefined_points();
  const Surface complete = undefined == 0 ? profile : filled(profile);
  const Surface unfiltered = undefined == 0 ? measured : filled(measured);
  ProfileFit fit = fit_profile(unfiltered, reliable_wavelength(arguments, unfiltered));
  if (const auto trend = parse_enum<Detrend>(arguments.surface.detrend);
      profiles.measured || trend == Detrend::none || trend == Detrend::mean) {
    // Rms height and slope are those of the filtered heights and, without detrending, include the
    // straight line that fit_profile() removes.
    const Index n = complete.grid.nx;
    fit.rms_height = height_statistics(complete).rms_height;
    fit.rms_slope = std::sqrt((complete.heights.bottomRows(n - 1) - complete.heights.topRows(n - 1))
                                  .square()
                                  .mean()) /
                    complete.grid.dx();
  }
  const ProfilePsd psd = profile_psd(complete, Axis::x, *parse_enum<Window>(arguments.window));
  Json answer{
      {"nx", profile.grid.nx}, {"size_x", profile.grid.lx}, {"undefined_points", undefined}};
  add_filters(answer, arguments.surface.filters);
  answer.add(json_of(fit));
  answer["hurst"] = to_json<IntervalEstimate>(fit.hurst);
  answer["rolloff"] = fit.rolloff;
  answer["short_cutoff"] = fit.short_cutoff;
  answer["profiles_x"] =
      json_of(profile_parameters(unfiltered, Axis::x, arguments.surface.filters));
  if (arguments.tip_radius || arguments.resolution)
    answer["reliability"] = json_of(reliability(arguments, unfiltered));
  if (profiles.measured) session.inform(law_of_unfiltered);
  if (undefined > 0) session.inform(fmt::format("{} undefined points were filled", undefined));
  if (!fit.hurst.found()) session.inform(no_hurst);
  note_asymmetry(arguments, detail::asymmetric_wavelength(unfiltered), session);
  const std::vector<ResultTable> tables{
      psd_table("profile_psd_x", converted(psd, *parse_enum<PsdConvention>(arguments.convention)),
                psd.modes)};
  write_tables(session, "statistics", answer, tables);
  session.answer(answer);
  if (fit.hurst.found())
    session.inform("For an isotropic surface with such profiles: " + generation(profile.grid, fit));
}

void analyse_one(const StatisticsArguments& arguments, Session& session) {
  for (const auto& [given, option] :
       {std::pair(arguments.surface.fill, "--fill"), {session.has_plot(), "--plot"}})
    if (given) session.require_one_process(option);
  if (!arguments.surface.given()) require_options({"SURFACE (or --recipe)"}, "statistics");
  std::vector<std::string> names = spectrum_tables;
  names.insert(names.end(), other_tables.begin(), other_tables.end());
  require_tables(session, names);
  const FilteredSurface surfaces = read_surface_of(arguments, session);
  const Surface& surface = surfaces.rough;
  if (surface.grid.ny == 1 && surface.grid.nx > 1)
    return analyse_profile(arguments, surfaces, session);
  try {
    analyse(arguments, surfaces, session);
  } catch (const InvalidInput& refusal) {
    // A grid of two rows has no curvature. The statistics name `nx` or `ny` in this error, and not
    // the file.
    if (refusal.field() != "nx" && refusal.field() != "ny") throw;
    throw InvalidInput(
        arguments.surface.file.empty() ? arguments.surface.recipe : arguments.surface.file,
        refusal.what());
  }
}

/// A number of points or a length along x and y, "512 x 512".
FileColumn pair_column(const std::string& heading, const std::string& along_x,
                       const std::string& along_y) {
  return {.heading = heading,
          .name = "",
          .value = [=](const Json& answer, std::size_t) -> Json {
            const Json x = member(answer, along_x, 0), y = member(answer, along_y, 0);
            const auto text = [](const Json& value) {
              return value.is_number_integer()
                         ? value.dump()
                         : format_quantity(value.number(), Dimension::length, 3);
            };
            if (x.is_null()) return {};
            return y.is_null() ? text(x) : text(x) + " x " + text(y);
          },
          .averaged = false};
}

/// The lay as in "5.9 at 12°"; "none" if the surface has none.
FileColumn lay_column() {
  return {.heading = "lay",
          .name = "",
          .value = [](const Json& answer, std::size_t) -> Json {
            const Json has = member(answer, "has_lay", 0), ratio = member(answer, "lay_ratio", 0);
            if (has.is_null() || !ratio.is_number() || std::isnan(ratio.number())) return {};
            if (!has.truth()) return "none";
            const double degrees = member(answer, "lay_angle", 0).number() * 180 / std::numbers::pi;
            return std::isinf(ratio.number())
                       ? fmt::format("> {:.2g} at {:.0f}°",
                                     member(answer, "lay_ratio_low", 0).number(), degrees)
                       : fmt::format("{:.2g} at {:.0f}°", ratio.number(), degrees);
          },
          .averaged = false};
}

/// A parameter of the fitted law with its 95 % limits, which are often wide: "0.73 (0.51 … 0.89)";
/// across the lay if the surface has one.
FileColumn fitted_column(const std::string& heading, const std::string& name) {
  return {.heading = heading,
          .name = "",
          .value = [name](const Json& answer, std::size_t) -> Json {
            const bool has_lay = member(answer, "across", 0).is_object();
            const Json whole = member(answer, has_lay ? "across." + name : name, 0);
            const Dimension dimension = quantity_of(name).dimension;
            const auto text = [&](const Json& value) {
              return format_quantity(value.number(), dimension, 2);
            };
            const Json value = whole.is_object() ? member(whole, "value", 0) : whole;
            if (!value.is_number() || std::isnan(value.number())) return {};
            return whole.is_object() ? fmt::format("{} ({} … {})", text(value), text(whole["low"]),
                                                   text(whole["high"]))
                                     : text(value);
          },
          .averaged = false};
}

FileTable table_of_files(const std::string& csv) {
  FileTable table{
      .columns = {pair_column("points", "nx", "ny"), pair_column("size", "size_x", "size_y"),
                  column("", "nx", "nx"), column("", "ny", "ny"), column("", "size_x", "size_x"),
                  column("", "size_y", "size_y"),
                  column("", "undefined_points", "undefined_points")},
      .csv = csv};
  for (const char* name : {"Sq", "Sa", "Ssk", "Sku", "Sdq"})
    table.columns.push_back(column(name, std::string("areal.") + name, name));
  for (const char* name : {"Sz", "Sal", "Str", "Str_max", "Std", "Sdr", "Sk", "Spk", "Svk"})
    table.columns.push_back(column("", std::string("areal.") + name, name));
  for (const char* axis : {"x", "y"})
    for (const char* name : {"Ra", "Rq", "Rz", "Rsm", "Ra_deviation", "Rq_deviation",
                             "Rz_deviation", "Rsm_deviation"}) {
      const bool shown = std::string_view(name) == "Ra" || std::string_view(name) == "Rz";
      table.columns.push_back(column(shown ? fmt::format("{} {}", name, axis) : "",
                                     fmt::format("profiles_{}.{}", axis, name),
                                     fmt::format("{}_{}", name, axis)));
    }
  table.columns.push_back(lay_column());
  for (const char* name : {"lay_ratio", "lay_ratio_low", "lay_ratio_high", "lay_angle", "has_lay"})
    table.columns.push_back(column("", name, name));
  for (const auto& [heading, name] :
       {std::pair("H", "hurst"), {"roll-off", "rolloff"}, {"cut-off", "short_cutoff"}}) {
    table.columns.push_back(fitted_column(heading, name));
    table.columns.push_back(column("", name, name));
    // A profile has no limits of its roll-off and shortest wave.
    table.columns.back().value = [name = std::string(name)](const Json& answer, std::size_t) {
      const Json whole = member(answer, name, 0);
      return whole.is_object() ? member(whole, "value", 0) : whole;
    };
    for (const char* limit : {"low", "high"})
      table.columns.push_back(
          column("", fmt::format("{}.{}", name, limit), fmt::format("{}_{}", name, limit)));
    for (const char* direction : {"across", "along"})
      for (const char* part : {"value", "low", "high"})
        table.columns.push_back(column("", fmt::format("{}.{}.{}", direction, name, part),
                                       std::string_view(part) == "value"
                                           ? fmt::format("{}_{}", name, direction)
                                           : fmt::format("{}_{}_{}", name, direction, part)));
  }
  return table;
}

void run(StatisticsArguments arguments, Session& session) {
  const std::vector<std::string> files = arguments.surface.several(!arguments.csv.empty());
  if (files.empty()) {
    require_that(arguments.csv.empty(), "--csv", "needs the files of surfaces; give SURFACE");
    return analyse_one(arguments, session);
  }
  require_options_of_one(session, {{!arguments.surface.recipe.empty(), "--recipe"}});
  arguments.in_table = true;
  answer_files(files, table_of_files(arguments.csv), session, [&](const std::string& file) {
    arguments.surface.file = file;
    analyse_one(arguments, session);
  });
}

}  // namespace

void add_statistics_command(Program& program) {
  auto arguments = std::make_shared<StatisticsArguments>();
  Command& command = program.add_command(
      "statistics", "size, roughness and spectra of a surface",
      {"salebra statistics scan.txt",
       "salebra statistics scan.sur --detrend quadratic --fill --tip-radius 10nm --convention "
       "surface-topography -o scan.csv --plot scan.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "heights, power spectral density with the fitted law, distribution of heights",
      OutputCheck::any_name);
  arguments->surface.add_several_to(command);
  arguments->surface.add_recipe_to(command);
  arguments->surface.profiles = true;
  add_table_file(command, arguments->csv);
  command.add_flag(
      "--all", arguments->all,
      "also print areal parameters, spectra and all other tables; an output file always has them");
  add_choice<Window>(command, "--window", arguments->window,
                     "window of the spectra; default none if periodic, hann if not");
  add_choice<PsdConvention>(command, "--convention", arguments->convention,
                            "convention of the power spectral density; default salebra, "
                            "rms_height^2 = integral of C d^2q");
  add_quantity(
      command, "--tip-radius", arguments->tip_radius, Dimension::length,
      "radius of the scanning probe: gives the wavelength below which the probe distorts the scan");
  add_quantity(command, "--resolution", arguments->resolution, Dimension::length,
               "lateral resolution of the instrument");
}

}  // namespace salebra::cli
