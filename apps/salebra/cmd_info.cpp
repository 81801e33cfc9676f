// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>

#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

void run(const SurfaceOptions& options, Session& session) {
  const Surface surface = options.read();
  const HeightStatistics heights = height_statistics(surface);
  const SpectralMoments moments =
      surface.undefined_points() > 0 ? difference_moments(surface) : surface_moments(surface);
  const SummitStatistics summits = summit_statistics(find_summits(surface));
  session.answer({{"nx", surface.grid.nx},
                  {"ny", surface.grid.ny},
                  {"size_x", surface.grid.lx},
                  {"size_y", surface.grid.ly},
                  {"undefined_points", surface.undefined_points()},
                  {"mean", heights.mean},
                  {"rms_height", heights.rms_height},
                  {"rms_slope", moments.rms_slope()},
                  {"skewness", heights.skewness},
                  {"kurtosis", heights.kurtosis},
                  {"moment0", moments.moment0},
                  {"moment2", moments.moment2()},
                  {"moment4", moments.moment4()},
                  {"nayak", moments.nayak()},
                  {"hurst", {{"value", nullptr}, {"low", nullptr}, {"high", nullptr}}},
                  {"summits",
                   {{"density", summits.density},
                    {"mean_height", summits.mean_height},
                    {"rms_height", summits.rms_height},
                    {"mean_radius", summits.mean_radius}}}});
}

}  // namespace

void add_info_command(Program& program) {
  auto options = std::make_shared<SurfaceOptions>();
  CLI::App& command = program.add_command(
      "info", "size and statistics of a surface",
      {"salebra info scan.txt",
       "salebra info heights.npy --size-x 10um --size-y 10um --detrend none --json"},
      [options](Session& session) { run(*options, session); });
  options->add_to(command);
}

}  // namespace salebra::cli
