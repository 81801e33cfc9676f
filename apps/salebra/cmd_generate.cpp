// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra generate`: random surfaces, analytic shapes and profiles.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/generators/composite.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/fourier_modes.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/moments.hpp>

#include "base/memory.hpp"
#include "dry_run.hpp"
#include "io/number_table.hpp"
#include "options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "shape_options.hpp"
#include "spectrum_options.hpp"

namespace salebra::cli {
namespace {

struct GenerateArguments {
  std::string points, crop, composite, heights_from, method, fourier, exact = "heights";
  std::optional<double> size_x, size_y, skewness, kurtosis, weibull, fourier_unit;
  SpectrumOptions spectrum;
  ShapeOptions shape;
  bool profile = false;
  DryRunOptions dry_run;
  std::uint64_t seed = 1;

  bool non_gaussian() const { return skewness || kurtosis || weibull || !heights_from.empty(); }
};

/// Reads "NX,NY" or "N"; with one whole number the second is the same.
std::pair<Index, Index> counts_of(const std::string& text, const std::string& option) {
  const auto values = parse_values(text, Dimension::dimensionless, option);
  for (const double count : values)
    require(count == std::floor(count) && count >= 1 && count <= 1 << 20, option, text,
            "must be one or two whole numbers >= 1, NX[,NY]");
  require(values.size() <= 2, option, text, "has too many numbers; write NX[,NY]");
  return {static_cast<Index>(values.front()), static_cast<Index>(values.back())};
}

Grid2D grid_of(const GenerateArguments& arguments) {
  Grid2D grid;
  std::tie(grid.nx, grid.ny) = counts_of(arguments.points, "--points");
  grid.lx = *arguments.size_x;
  grid.ly = arguments.size_y.value_or(grid.lx * double(grid.ny) / double(grid.nx));
  grid.validate();
  return grid;
}

Json rms_of(const SpectralMoments& moments) {
  return Json{{"rms_height", moments.rms_height()}, {"rms_slope", moments.rms_slope()}};
}

Json all_of(const SpectralMoments& moments) {
  Json object = rms_of(moments);
  object.add(json_of(moments));
  return object;
}

/// JSON of the moments that were requested (target) and of their mean values on the grid (lattice).
Json asked(std::uint64_t seed, const std::string& method, const Json& target, const Json& lattice) {
  return {{"seed", seed}, {"method", method}, {"target", target}, {"lattice", lattice}};
}

/// Reads the heights of a file whose lateral size does not matter.
Surface read_unsized(const std::string& file) {
  ReadOptions options;
  options.size_x = 1;
  options.size_y = 1;
  return read_surface(file, options);
}

/// The distribution of heights that the options describe; empty for Gaussian heights.
std::optional<HeightDistribution> distribution_of(const GenerateArguments& arguments) {
  if (!arguments.non_gaussian()) return {};
  const bool johnson = arguments.skewness || arguments.kurtosis;
  require_that(johnson + arguments.weibull.has_value() + !arguments.heights_from.empty() == 1,
               "--skewness",
               "given together with --weibull or --heights-from; give one distribution");
  if (arguments.weibull) return weibull_heights(*arguments.weibull);
  if (johnson)
    return johnson_heights(arguments.skewness.value_or(0),
                           required(arguments.kurtosis, "--kurtosis", "--skewness needs it"));
  const Surface measured = read_unsized(arguments.heights_from);
  return sampled_heights(BearingCurve(detrended(measured, default_detrend(measured))).heights());
}

void report_memory(const Grid2D& grid, std::size_t bytes, Session& session) {
  require_memory(grid, static_cast<double>(bytes), "a surface", session.communicator());
  const NodeMemory memory = memory_of_nodes(static_cast<double>(bytes), session.communicator());
  session.inform(fmt::format("memory: {} needed, {} available{}", memory_text(memory.needed),
                             memory_text(memory.available),
                             memory.nodes > 1 ? " on node " + memory.node : ""));
}

std::string method_of(const GenerateArguments& arguments) {
  return !arguments.method.empty()  ? arguments.method
         : arguments.non_gaussian() ? "random-phase"
                                    : "filtered-noise";
}

/// Makes a random surface and adds its description to the answer.
Surface random_surface(const GenerateArguments& arguments, const Grid2D& grid, Session& session,
                       Json& answer) {
  const std::shared_ptr<const Spectrum> spectrum =
      arguments.spectrum.spectrum(std::max(grid.lx, grid.ly));
  const std::optional<HeightDistribution> distribution = distribution_of(arguments);
  // Refuses a grid that does not fit the spectrum before the sums over all modes, which take long.
  spectrum->require_carried_by(grid);
  report_memory(grid,
                arguments.non_gaussian() ? non_gaussian_memory(grid)
                                         : generation_memory(grid, session.communicator()),
                session);
  Forecast expected;
  collectively(session.communicator(),
               [&] { expected = forecast(grid, *spectrum, session.progress()); });
  session.warn(expected.warnings);
  const std::string method = method_of(arguments);
  answer.add(asked(arguments.seed, arguments.non_gaussian() ? "non-gaussian" : method,
                   rms_of(expected.target), all_of(expected.lattice)));
  if (const Json lay = arguments.spectrum.anisotropy(); !lay.is_null()) answer["anisotropy"] = lay;
  if (arguments.non_gaussian()) {
    require(method == "random-phase", "--method", method,
            "makes only Gaussian heights; leave it out with a distribution");
    NonGaussianSurface made = non_gaussian(
        grid, *spectrum, *distribution, arguments.seed,
        {.exact = *parse_enum<Exact>(arguments.exact), .on_progress = session.progress()});
    if (made.termination == Termination::interrupted)
      throw Interrupted("generate: interrupted; no surface was written");
    if (!made.converged())
      throw NotConverged(
          fmt::format("generate: the spectrum still changes after {} iterations; choose heights "
                      "closer to Gaussian ones",
                      made.iterations));
    answer["distribution"] = {{"name", distribution->name}};
    answer["distribution"].add(json_of(made));
    return std::move(made.surface);
  }
  if (method == "random-phase")
    return random_phase(grid, *spectrum, arguments.seed, session.progress(),
                        session.communicator());
  if (method == "exact-rms")
    return exact_rms(grid, *spectrum, arguments.seed,
                     arguments.spectrum.rms_slope ? Rms::slope : Rms::height, session.progress(),
                     session.communicator());
  return filtered_noise(grid, *spectrum, arguments.seed, session.progress(),
                        session.communicator());
}

/// Makes a surface of the Fourier modes in a file. Each row has the whole numbers i and j of waves
/// along x and y, and the real and imaginary part of the amplitude ĥ.
Surface surface_of_file(const GenerateArguments& arguments, const Grid2D& grid) {
  const double unit = arguments.fourier_unit.value_or(1);
  require_positive(unit, "--fourier-unit");
  const auto [columns, has_units] =
      read_number_table(arguments.fourier, {{"i", Dimension::dimensionless, {"nx"}},
                                            {"j", Dimension::dimensionless, {"ny"}},
                                            {"real", Dimension::length, {"re"}},
                                            {"imaginary", Dimension::length, {"im", "imag"}}});
  require(!has_units || !arguments.fourier_unit, "--fourier-unit", unit,
          "given, but the column titles of the file state units; leave it out");
  std::vector<FourierMode> modes;
  for (std::size_t k = 0; k < columns[0].size(); ++k) {
    for (const double wave : {columns[0][k], columns[1][k]})
      require(wave == std::floor(wave) && std::abs(wave) < 1 << 20, "--fourier", wave,
              "is not a whole number of waves in the period");
    modes.push_back(
        {Index(columns[0][k]), Index(columns[1][k]), {unit * columns[2][k], unit * columns[3][k]}});
  }
  return surface_of_modes(grid, modes);
}

Surface cropped(const GenerateArguments& arguments, const Surface& surface) {
  const auto [nx, ny] = counts_of(arguments.crop, "--crop");
  return crop_surface(surface, 0, 0, nx, ny);
}

void make_profile(const GenerateArguments& arguments, Session& session) {
  require_tables(session, {"profile"});
  const auto [points, lines] = counts_of(arguments.points, "--points");
  require_that(
      lines == points && !arguments.size_y && arguments.crop.empty() &&
          arguments.composite.empty() && !arguments.non_gaussian() && !session.has_plot(),
      "--profile",
      "given together with an option that applies only to surfaces; leave that option out");
  const double length = *arguments.size_x;
  const SelfAffineProfileSpectrum spectrum = arguments.spectrum.profile_spectrum(length);
  const std::string method = arguments.method.empty() ? "filtered-noise" : arguments.method;
  require(method != "exact-rms", "--method", method,
          "applies only to surfaces; the rms value of a random-phase profile is exact anyway");
  const Profile profile = method == "random-phase"
                              ? random_phase_profile(points, length, spectrum, arguments.seed)
                              : filtered_noise_profile(points, length, spectrum, arguments.seed);
  // Treats the profile as a surface of one row, whose moments along y are 0.
  Surface line{{points, 1, length, length}, Field(points, 1), true, profile.origin};
  std::vector<double> x;
  for (Index k = 0; k < points; ++k) {
    line.heights(k, 0) = profile.heights[static_cast<std::size_t>(k)];
    x.push_back(static_cast<double>(k) * profile.dx());
  }
  Json answer{{"points", points}, {"size_x", length}};
  answer.add(asked(arguments.seed, method, rms_of(spectrum.moments()),
                   rms_of(spectrum.lattice_moments(points, length))));
  answer["realised"] = rms_of(spectral_moments(line));
  if (!session.has_output())
    session.inform("no file was written; add --output FILE.csv, .json or .h5 to keep the profile");
  write_tables(
      session, "generate", answer,
      {{"profile", {{"x", x}, {"heights", profile.heights}}, "periodic, " + profile.origin}});
  session.answer(answer);
}

/// Throws InvalidInput for options that need the whole surface if it is spread over processes.
void require_spreadable(const GenerateArguments& arguments, const Session& session) {
  for (const auto& [given, option] : {std::pair(arguments.shape.given(), "--shape"),
                                      {arguments.profile, "--profile"},
                                      {!arguments.fourier.empty(), "--fourier"},
                                      {arguments.non_gaussian(), "a distribution of heights"},
                                      {!arguments.composite.empty(), "--composite"},
                                      {!arguments.crop.empty(), "--crop"},
                                      {session.has_plot(), "--plot"}})
    if (given) session.require_one_process(option);
}

void estimate(const GenerateArguments& arguments, const Grid2D& grid, Session& session) {
  require(
      !arguments.shape.given() && !arguments.non_gaussian(), "--dry-run", "generate",
      "estimates only Gaussian random surfaces; leave out --shape and distributions of heights");
  answer_dry_run(planned(arguments.dry_run, grid, session),
                 fmt::format("{}, seed {}", method_of(arguments), arguments.seed), session);
}

void require_one_surface(const GenerateArguments& arguments) {
  const bool random = arguments.spectrum.given() || arguments.profile || arguments.non_gaussian() ||
                      !arguments.method.empty();
  require(!arguments.shape.given() || !random, "--shape", arguments.shape.shape,
          "cannot be combined with a spectrum; give one of them");
  require(arguments.fourier.empty() || !(arguments.shape.given() || random), "--fourier",
          arguments.fourier, "defines the whole surface; leave out shape and spectrum");
  require_that(!arguments.fourier_unit || !arguments.fourier.empty(), "--fourier-unit",
               "given without --fourier");
}

void run(const GenerateArguments& arguments, Session& session) {
  require_spreadable(arguments, session);
  require_one_surface(arguments);
  if (arguments.profile) return make_profile(arguments, session);
  if (session.has_output()) require_surface_name(session.output());
  const Grid2D grid = grid_of(arguments);
  session.warn(warnings_of_cells(grid));
  if (arguments.dry_run.dry_run) return estimate(arguments, grid, session);
  Json answer = Json::object();
  Surface surface;
  if (arguments.shape.given()) {
    surface = arguments.shape.surface(grid);
    answer["shape"] = arguments.shape.shape;
  } else if (!arguments.fourier.empty()) {
    surface = surface_of_file(arguments, grid);
    answer["fourier"] = arguments.fourier;
  } else {
    surface = random_surface(arguments, grid, session, answer);
  }
  if (!arguments.composite.empty()) {
    std::vector<std::string> warnings;
    ReadOptions options;
    options.warnings = &warnings;
    const Surface second = read_surface(arguments.composite, options);
    session.warn(warnings);
    surface = composite_surface(surface, second);
    answer["composite"] = arguments.composite;
  }
  if (!arguments.crop.empty()) {
    surface = cropped(arguments, surface);
    answer["periodic"] = surface.periodic;
  }
  // surface_moments() uses the spectrum of a periodic surface, and differences between neighbouring
  // points of any other surface, which needs three points in each direction.
  if (surface.periodic || (surface.grid.nx >= 3 && surface.grid.ny >= 3))
    answer["realised"] = all_of(surface_moments(surface));
  if (arguments.non_gaussian()) answer["realised"].add(json_of(height_statistics(surface)));
  if (session.stopped()) throw Interrupted("generate: interrupted; no surface was written");
  if (session.has_output()) {
    Provenance provenance = session.provenance();
    if (!arguments.shape.given() && arguments.fourier.empty()) provenance.seed = arguments.seed;
    provenance.configuration = surface.origin;
    write_surface(session.output(), surface, provenance, session.write_options());
  } else {
    session.inform("no file was written; add --output FILE to keep the surface");
  }
  if (session.has_plot()) session.plot(figures::figure_of(surface, figures::spectrum_of(surface)));
  Json whole = json_of(surface.grid);
  whole.add(answer);
  session.answer(whole);
}

void add_heights(Command& command, GenerateArguments& arguments) {
  command.under("Non-Gaussian heights");
  add_quantity(command, "--skewness", arguments.skewness, Dimension::dimensionless,
               "skewness of the heights, Johnson's distribution; default 0");
  add_quantity(command, "--kurtosis", arguments.kurtosis, Dimension::dimensionless,
               "kurtosis of the heights; 3 for a Gaussian");
  add_quantity(command, "--weibull", arguments.weibull, Dimension::dimensionless,
               "shape parameter of a Weibull distribution of heights");
  command
      .add_option("--heights-from", arguments.heights_from,
                  "take the distribution of heights from this surface, less its trend")
      ->file(FileUse::input);
  add_choice<Exact>(
      command, "--exact", arguments.exact,
      "whether the heights or the spectrum are exact, or both belong to the random process "
      "that is sampled; default heights");
}

}  // namespace

void add_generate_command(Program& program) {
  auto arguments = std::make_shared<GenerateArguments>();
  Command& command = program.add_command(
      "generate", "make a random surface, a profile or an analytic shape",
      {"salebra generate --points 512 --size-x 10um --hurst 0.8 --rolloff 2um --short-cutoff 160nm "
       "--rms-height 30nm -o rough.h5",
       "salebra generate --points 256,128 --size-x 1mm --correlation gaussian --correlation-length "
       "50um --stretch-along 3 --rms-height 1um --skewness -1 --kurtosis 5 --seed 7 --json"},
      [arguments](Session& session) { run(*arguments, session); },
      "heights, power spectral density with the fitted law, distribution of heights",
      OutputCheck::any_name);
  command.add_option("--points", arguments->points, "cells along x and y, NX[,NY]")
      ->required()
      ->type_name("NX[,NY]");
  add_quantity(command, "--size-x", arguments->size_x, Dimension::length, "period along x")
      ->required();
  add_quantity(command, "--size-y", arguments->size_y, Dimension::length,
               "period along y; default: square cells");
  add_choice(command, "--method", arguments->method,
             {"filtered-noise", "random-phase", "exact-rms"},
             "Gaussian process, exact mode powers, or exact rms; default filtered-noise");
  add_seed(command, arguments->seed, "seed, any whole number >= 0; default 1");
  arguments->spectrum.add_to(command);

  command.under("Fourier coefficients");
  command
      .add_option("--fourier", arguments->fourier,
                  "file that gives the surface by rows of i, j, Re h, Im h, with i and j waves in "
                  "the period along x and y")
      ->file(FileUse::input);
  add_quantity(command, "--fourier-unit", arguments->fourier_unit, Dimension::length,
               "unit of the coefficients, such as 0.1mm; default 1 m");

  add_heights(command, *arguments);
  arguments->shape.add_to(command);

  command.under("Post-processing");
  command.add_flag("--profile", arguments->profile,
                   "make a self-affine line profile instead of a surface, with --points N");
  command
      .add_option("--composite", arguments->composite,
                  "add the heights of this surface, which must have the same points")
      ->file(FileUse::input);
  command
      .add_option("--crop", arguments->crop,
                  "keep this many points, as a surface that is not periodic")
      ->type_name("NX[,NY]");
  arguments->dry_run.add_to(command);
}

}  // namespace salebra::cli
