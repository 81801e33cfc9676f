// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of a contact while it is solved (contact_checkpoint.hpp).
#include "contact_checkpoint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <new>
#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>

#include "named_files.hpp"
#include "options.hpp"
#include "results/quantity_group.hpp"

namespace salebra::cli {
namespace {

/// Whether the first process sees the file; all processes get its answer.
bool is_there(const Session& session, const std::string& file) {
  return session.communicator().all_agree(!session.communicator().is_root() ||
                                          std::filesystem::exists(file));
}

constexpr const char* mark = "checkpoint";

bool is_checkpoint(const std::string& file) {
  return ResultReader(file).text_attribute("contact", mark).has_value();
}

}  // namespace

void ContactCheckpoint::add_to(Command& command) {
  command
      .add_option("--checkpoint", file,
                  "file in which the pressure is kept while the contact is solved, to continue "
                  "with --initial; removed once the contact has converged")
      ->file(FileUse::output, "--initial");
  add_quantity(command, "--checkpoint-every", every, Dimension::time,
               "time between checkpoints; default 10 min, 0 for every iteration");
}

void ContactCheckpoint::check(const Session& session, const std::string& initial) const {
  require_that(!every || !file.empty(), "--checkpoint-every",
               "given without --checkpoint; name the checkpoint");
  if (every)
    require(*every >= 0 && std::isfinite(*every), "--checkpoint-every", *every, "must be >= 0");
  if (file.empty()) return;
  collectively(session.communicator(), [&] {
    if (!session.communicator().is_root()) return;
    const bool replaces = session.write_options().overwrite || same_file(file, initial);
    require_that(replaces || !std::filesystem::exists(file), file,
                 "exists already; continue from it with --initial " + file +
                     ", or add --overwrite to start anew");
    // A checkpoint is removed at the end of the run. If --initial names the same file, it must be a
    // checkpoint and not a result that the user wants to keep.
    require(
        !same_file(file, initial) || !std::filesystem::exists(file) || is_checkpoint(file),
        "--checkpoint", file,
        "is a result that --initial reads, and the checkpoint would replace it; name another file");
    require_output(file, {.overwrite = true});
  });
}

bool ContactCheckpoint::starts_anew(const Session& session, const std::string& initial) const {
  return !file.empty() && same_file(file, initial) && !is_there(session, file);
}

void ContactCheckpoint::add_to(NormalContactOptions& options, Session& session,
                               const Grid2D& grid) const {
  if (file.empty()) return;
  options.on_checkpoint = [this, &session, &grid](const Field& pressure) {
    write(session, grid, pressure);
  };
  if (every) options.checkpoint_every = *every;
}

bool ContactCheckpoint::write(Session& session, const Grid2D& grid, const Field& pressure) const {
  const bool empty = session.communicator().all_agree(!(pressure > 0).any());
  if (file.empty() || empty) return false;
  try {
    std::optional<ResultFile> result;
    collectively(session.communicator(), [&] {
      result.emplace(file, session.provenance(), WriteOptions{.overwrite = true},
                     session.communicator());
      QuantityGroup group(result->group("contact"));
      group.axes(grid);
      group.plain().attribute(mark, std::string("yes"));
      group.dataset("contact_pressure", pressure, "x", "y", FieldType::float32);
    });
    result->commit();
    return true;
  } catch (const IoError& error) {
    session.warn(fmt::format("--checkpoint: {}; the earlier checkpoint is kept", error.what()));
  } catch (const std::bad_alloc&) {
    session.warn(fmt::format(
        "--checkpoint: {}: not enough memory to write it; the earlier checkpoint is kept", file));
  }
  return false;
}

void ContactCheckpoint::remove(const Session& session) const {
  std::error_code ignored;
  if (!file.empty() && session.communicator().is_root()) std::filesystem::remove(file, ignored);
}

}  // namespace salebra::cli
