// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/io/write_surface.hpp>

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
          "is not for this command; name the new file as its second argument");
  require_output(arguments.to, session.write_options());
  if (arguments.surface.detrend.empty()) arguments.surface.detrend = "none";
  write_surface(arguments.to, arguments.surface.read(), session.provenance(),
                session.write_options());
  session.answer({{"file", arguments.to}});
}

}  // namespace

void add_convert_command(Program& program) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App& command = program.add_command(
      "convert", "write a surface in another format",
      {"salebra convert scan.txt scan.h5",
       "salebra convert heights.npy rough.h5 --size-x 10um --size-y 10um --detrend plane"},
      [arguments](Session& session) { run(*arguments, session); });
  arguments->surface.add_to(command);
  command.add_option("OUT", arguments->to, "new file; its extension decides on the format")
      ->required()
      ->type_name("FILE");
}

}  // namespace salebra::cli
