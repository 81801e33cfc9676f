// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra convert`: a surface from one file format to another.
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/surface/fill.hpp>

#include "io/surface_formats.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct ConvertArguments {
  SurfaceOptions surface;
  std::string to;
};

void run(ConvertArguments& arguments, Session& session) {
  require(!session.has_output(), "--output", session.output().string(),
          "is not an option of convert; name the new file as its second argument");
  require_surface_name(arguments.to);
  require_output(arguments.to, session.write_options());
  if (arguments.surface.detrend.empty()) arguments.surface.detrend = "none";
  Surface surface = arguments.surface.read(session, Undefined::keep);
  Json answer = {{"file", arguments.to}};
  if (arguments.surface.fill) {
    answer["filled_points"] = surface.undefined_points();
    surface = filled(std::move(surface));
  }
  write_surface(arguments.to, surface, session.provenance(), session.write_options());
  if (session.has_plot()) session.plot(figures::figure_of(surface, figures::spectrum_of(surface)));
  session.answer(answer);
}

}  // namespace

void add_convert_command(Program& program) {
  auto arguments = std::make_shared<ConvertArguments>();
  Command& command = program.add_command(
      "convert", "write a surface in another format",
      {"salebra convert scan.sur scan.h5 --fill",
       "salebra convert heights.npy rough.h5 --size-x 10um --size-y 10um --detrend plane"},
      [arguments](Session& session) { run(*arguments, session); },
      "heights, power spectral density with the fitted law, distribution of heights",
      OutputCheck::any_name);
  arguments->surface.add_to(command);
  command
      .add_option("OUT", arguments->to,
                  "new file; its extension decides on the format: " + written_extensions())
      ->required()
      ->file(FileUse::output);
}

}  // namespace salebra::cli
