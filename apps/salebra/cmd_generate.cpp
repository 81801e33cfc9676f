// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/surface/moments.hpp>

#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct GenerateArguments {
  std::string points;
  std::optional<double> size_x, size_y, hurst, long_cutoff, rolloff, short_cutoff, rms_height,
      rms_slope;
  std::string method = "filtered-noise";
  std::uint64_t seed = 1;
};

Grid2D grid_of(const GenerateArguments& arguments) {
  Grid2D grid;
  const auto points = parse_values(arguments.points, Dimension::dimensionless, "--points");
  for (const double count : points) {
    require(count == std::floor(count) && count >= 1 && count <= 1 << 20, "--points",
            arguments.points, "must be one or two whole numbers >= 1, NX[,NY]");
  }
  require(points.size() <= 2, "--points", arguments.points, "has too many numbers; write NX[,NY]");
  grid.nx = Index(points.front());
  grid.ny = Index(points.back());
  grid.lx = *arguments.size_x;
  grid.ly = arguments.size_y.value_or(grid.lx * double(grid.ny) / double(grid.nx));
  grid.validate();
  return grid;
}

std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), seed);
  require(status == std::errc{} && end == text.data() + text.size(), "--seed", text,
          "must be a whole number from 0 to 2^64 - 1");
  return seed;
}

Json rms_of(const SpectralMoments& moments) {
  return {{"rms_height", moments.rms_height()}, {"rms_slope", moments.rms_slope()}};
}

Json all_of(const SpectralMoments& moments) {
  Json object = rms_of(moments);
  object["moment0"] = moments.moment0;
  object["moment2"] = moments.moment2();
  object["moment4"] = moments.moment4();
  object["nayak"] = moments.nayak();
  return object;
}

void run(const GenerateArguments& arguments, Session& session) {
  const Grid2D grid = grid_of(arguments);
  const SelfAffineSpectrum spectrum({.hurst = *arguments.hurst,
                                     .long_cutoff = arguments.long_cutoff,
                                     .rolloff = arguments.rolloff,
                                     .short_cutoff = *arguments.short_cutoff,
                                     .rms_height = arguments.rms_height,
                                     .rms_slope = arguments.rms_slope});
  const Forecast expected = forecast(grid, spectrum);
  for (const std::string& warning : expected.warnings) session.warn(warning);
  const Surface surface = arguments.method == "random-phase"
                              ? random_phase(grid, spectrum, arguments.seed)
                              : filtered_noise(grid, spectrum, arguments.seed);
  if (session.has_output()) {
    Provenance provenance = session.provenance();
    provenance.seed = arguments.seed;
    provenance.configuration = spectrum.description();
    write_surface(session.output(), surface, provenance, session.write_options());
  } else {
    session.note("no file was written; add --output FILE to keep the surface");
  }
  session.answer({{"nx", grid.nx},
                  {"ny", grid.ny},
                  {"size_x", grid.lx},
                  {"size_y", grid.ly},
                  {"seed", arguments.seed},
                  {"method", arguments.method},
                  {"target", rms_of(expected.target)},
                  {"lattice", all_of(expected.lattice)},
                  {"realised", all_of(surface_moments(surface))}});
}

}  // namespace

void add_generate_command(Program& program) {
  auto arguments = std::make_shared<GenerateArguments>();
  CLI::App& command = program.add_command(
      "generate", "make a self-affine random surface",
      {"salebra generate --points 512 --size-x 10um --hurst 0.8 --rolloff 2um --short-cutoff 160nm "
       "--rms-height 30nm -o rough.h5",
       "salebra generate --points 256,128 --size-x 1mm --hurst 0.5 --long-cutoff 0.5mm "
       "--short-cutoff 40um --rms-slope 0.1 --method random-phase --seed 7 --json"},
      [arguments](Session& session) { run(*arguments, session); });
  command.add_option("--points", arguments->points, "cells along x and y, NX[,NY]")
      ->required()
      ->type_name("NX[,NY]");
  add_quantity(command, "--size-x", arguments->size_x, Dimension::length, "period along x")
      ->required();
  add_quantity(command, "--size-y", arguments->size_y, Dimension::length,
               "period along y; default: square cells");
  add_quantity(command, "--hurst", arguments->hurst, Dimension::dimensionless,
               "Hurst exponent, 0 < H <= 1")
      ->required();
  add_quantity(command, "--long-cutoff", arguments->long_cutoff, Dimension::length,
               "longest wavelength; default: the cell");
  add_quantity(command, "--rolloff", arguments->rolloff, Dimension::length,
               "wavelength where the plateau ends; default: --long-cutoff");
  add_quantity(command, "--short-cutoff", arguments->short_cutoff, Dimension::length,
               "shortest wavelength, at least two cells")
      ->required();
  add_quantity(command, "--rms-height", arguments->rms_height, Dimension::length,
               "of the spectrum; or --rms-slope");
  add_quantity(command, "--rms-slope", arguments->rms_slope, Dimension::dimensionless,
               "of the spectrum, sqrt(<|grad h|^2>)");
  add_choice(command, "--method", arguments->method, {"filtered-noise", "random-phase"},
             "default filtered-noise");
  command
      .add_option_function<std::string>(
          "--seed", [arguments](const std::string& text) { arguments->seed = seed_of(text); },
          "any whole number >= 0; default 1")
      ->type_name("INTEGER");
}

}  // namespace salebra::cli
