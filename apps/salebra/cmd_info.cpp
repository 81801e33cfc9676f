// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra info`: short description of a surface file.
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/results/columns.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>

#include "answer_file.hpp"
#include "options.hpp"
#include "program.hpp"
#include "surface_figure.hpp"

namespace salebra::cli {
namespace {

Json describe(const Surface& surface, const HurstEstimate& hurst) {
  const HeightStatistics heights = height_statistics(surface);
  Json answer = json_of(surface.grid);
  answer["undefined_points"] = surface.undefined_points();
  answer["mean"] = heights.mean;
  answer.add(json_of(heights));
  answer.add(json_of(surface.undefined_points() > 0 ? difference_moments(surface)
                                                    : surface_moments(surface)));
  answer["hurst"] = {{"value", hurst.value}, {"low", hurst.low}, {"high", hurst.high}};
  answer["summits"] = json_of(summit_statistics(find_summits(surface)));
  return answer;
}

void run(const SurfaceOptions& options, Session& session) {
  const Surface surface = options.read(session);
  SurfaceSpectrum spectrum;
  Json answer;
  try {
    spectrum = spectrum_of(surface);
    answer = describe(surface, spectrum.hurst);
  } catch (const InvalidInput& refusal) {
    // Such as a grid of two rows, which has no curvature: the statistics do not know which file it
    // came from.
    throw InvalidInput(options.file, refusal.what());
  }
  write_answer(session, "info", answer);
  if (session.has_plot()) session.plot(surface_figure(surface, spectrum));
  session.answer(answer);
}

}  // namespace

void add_info_command(Program& program) {
  auto options = std::make_shared<SurfaceOptions>();
  Command& command = program.add_command(
      "info", "size and statistics of a surface",
      {"salebra info scan.txt",
       "salebra info heights.npy --size-x 10um --size-y 10um --detrend none --json"},
      [options](Session& session) { run(*options, session); },
      "heights, power spectral density with the fitted law, distribution of heights");
  options->add_to(command);
}

}  // namespace salebra::cli
