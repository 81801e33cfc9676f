// SPDX-License-Identifier: GPL-3.0-or-later
// Options of checkpoints, resumption and fields of a simulated cycle.
#include "record_options.hpp"

#include <cmath>
#include <filesystem>
#include <salebra/base/error.hpp>

namespace salebra::cli {

void RecordOptions::add_to(Command& app) {
  app.add_option("--checkpoint", checkpoint,
                 "file in which the state of the cycle is kept while it runs; removed at its end")
      ->file(FileUse::output);
  add_quantity(app, "--checkpoint-every", checkpoint_every, Dimension::time,
               "time between checkpoints; default 60 s, 0 for every step");
  app.add_flag("--resume", resume,
               "continue an interrupted run from its checkpoint, to the same result");
  app.add_option("--fields", fields,
                 "write PREFIX.xdmf for ParaView with its HDF5 files: contact, tractions, "
                 "displacements, pressure, gap")
      ->type_name("PREFIX");
  add_values(app, "--field-steps", field_steps, Dimension::dimensionless,
             "steps at which fields are written; default nine over the cycle");
}

void RecordOptions::check(int steps, const std::vector<std::string>& cycles,
                          Session& session) const {
  require_that(!resume || !checkpoint.empty(), "--resume",
               "given without --checkpoint; name the checkpoint");
  require(!checkpoint_every || *checkpoint_every >= 0, "--checkpoint-every",
          checkpoint_every.value_or(0), "must be >= 0");
  if (!fields.empty()) {
    const WriteOptions writing = resume ? WriteOptions{.overwrite = true} : session.write_options();
    require_output(fields + ".xdmf", writing);
    for (const std::string& cycle : cycles)
      for (const auto& file : CycleFields::files(fields + cycle, steps_of_fields(steps)))
        session.writes("--fields", file);
  }
  if (checkpoint.empty()) return;
  require_output(checkpoint, {.overwrite = true});
  const bool there = std::filesystem::exists(checkpoint);
  require(there || !resume, "--resume", checkpoint,
          "does not exist; leave out --resume to start the cycle");
  require_that(!there || resume || session.write_options().overwrite, checkpoint,
               "exists already; add --resume to continue from it, or --overwrite to start again");
}

CycleRecordOptions RecordOptions::options(int steps, const Session& session) const {
  CycleRecordOptions options{.checkpoint = checkpoint,
                             .resume = resume,
                             .fields = fields,
                             .field_steps = steps_of_fields(steps),
                             .writing = session.write_options()};
  if (checkpoint_every) options.checkpoint_every = *checkpoint_every;
  return options;
}

std::vector<int> RecordOptions::steps_of_fields(int steps) const {
  std::vector<int> chosen;
  if (field_steps.empty())
    for (int k = 0; k <= 8; ++k) chosen.push_back(k * steps / 8);
  for (const double step : field_steps) {
    require(step == std::floor(step) && step >= 0 && step <= steps, "--field-steps", step,
            "is not one of the steps; give whole numbers from 0 to --steps");
    chosen.push_back(static_cast<int>(step));
  }
  return chosen;
}

}  // namespace salebra::cli
