// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra twin`: one surface from several scans, with its uncertainty.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/study/twin_file.hpp>
#include <salebra/surface/moments.hpp>

#include "io/text_file.hpp"
#include "options.hpp"
#include "program.hpp"
#include "results/answer_json.hpp"
#include "terminal.hpp"
#include "text.hpp"
#include "toml_text.hpp"

namespace salebra::cli {
namespace {

struct TwinArguments {
  std::string file, list, form;
  std::vector<std::string> scans;
  std::uint64_t seed = 1;
};

constexpr std::string_view form_in_words(SpectrumForm form) {
  return form == SpectrumForm::corner   ? "a power law with a corner at the roll-off"
         : form == SpectrumForm::smooth ? "a power law with a smooth roll-off"
                                        : "not self-affine, a table";
}

std::vector<std::string> row_of(const char* name, const TwinParameter& one, Dimension dimension) {
  const auto text = [&](double value) {
    return std::isnan(value) ? std::string("n/a") : format_quantity(value, dimension, 3);
  };
  std::string limits = text(one.low) + " … " + text(one.high);
  if (std::isnan(one.high)) limits = "above " + text(one.low);
  if (std::isnan(one.low)) limits = "below " + text(one.high);
  if (std::isnan(one.low) && std::isnan(one.high)) limits = "n/a";
  return {name, text(one.value), limits, one.seen ? "yes" : "no"};
}

std::string twin_text(const SurfaceTwin& twin) {
  std::size_t scans = 0;
  for (const TwinScan& scan : twin.scans) scans += scan.left_out ? 0 : 1;
  std::string text = fmt::format("Surface twin of {} scans in {} groups: {}\n", scans,
                                 twin.groups.size(), form_in_words(twin.form));
  text += to_table({{"quantity", "value", "95 % limits", "seen"},
                    row_of("hurst", twin.hurst, Dimension::dimensionless),
                    row_of("rolloff", twin.rolloff, Dimension::length),
                    row_of("short_cutoff", twin.short_cutoff, Dimension::length),
                    row_of("rms_height", twin.rms_height, Dimension::length),
                    row_of("rms_slope", twin.rms_slope, Dimension::dimensionless),
                    row_of("stretch", twin.stretch, Dimension::dimensionless),
                    row_of("lay_angle", twin.lay_angle, Dimension::angle),
                    row_of("rolloff_along", twin.rolloff_along, Dimension::length),
                    row_of("skewness", twin.skewness, Dimension::dimensionless),
                    row_of("kurtosis", twin.kurtosis, Dimension::dimensionless)},
                   2, true);
  text +=
      fmt::format("\nFit: deviance {:.2g} times the expected one; a law is rejected above {:g}\n",
                  twin.misfit, SurfaceTwin::refused_above);
  std::vector<std::vector<std::string>> rows{
      {"instrument", "scans", "used from", "to", "heights times", "misfit"}};
  for (const TwinGroup& group : twin.groups)
    rows.push_back({group.instrument, fmt::format("{}", group.scans),
                    format_quantity(group.shortest, Dimension::length, 3),
                    format_quantity(group.longest, Dimension::length, 3),
                    fmt::format("{:.3f}", group.gain), fmt::format("{:.2g}", group.misfit)});
  text += to_table(rows, 2, true);
  for (const TwinWithout& other : twin.without)
    text += fmt::format("Without {}: {}\n", other.instrument,
                        other.agrees
                            ? "the parameters change by no more than chance"
                            : "the parameters change by more than chance; check its calibration");
  return text;
}

constexpr std::string_view list_heading =
    R"(# Scans of one surface, each at a random place. Next: salebra twin {0} -o surface.h5
# Lengths are strings with a unit: "1.5um". A line that begins with "# " and a key is an option that is not set: remove
# "# " to set it. Each scan needs an instrument. More keys, like the options of these names: pixel_size, lateral_unit,
# channel, transpose, detrend, despike, crop = ["0um", "0um", "50um", "50um"], fill.
)";

constexpr std::string_view list_entry = R"(
[[measurement]]
file = {0}  # {1}
{2}
{3}
# height_unit = "nm"         # where the file names none
# instrument = "optical"     # heights blurred by a lens:
# resolution = "1.5um"       #   full width at half maximum of the blur
# instrument = "afm"         # or "stylus": heights dilated by a tip, line by line along x
# tip_radius = "50nm"
# line_drift = true          #   lines are offset from each other; default for stylus and afm
# instrument = "ideal"       # heights as they are, with noise
# noise = "0.3nm"            # rms; default: estimated from the spectrum
# height_calibration = "5%"  # standard error of all heights of the instrument
# scan_calibration = "2%"    # standard error of the heights of one scan
# name = "afm in Berlin"     # to tell two instruments of one kind apart: scans with the same name share their calibration
# weight = 1                 # number of scans that it counts as
)";

/// The [[scan]] table for one file in the list of scans. list: name of the file that will hold the
/// list.
std::string entry_of(const std::string& file, const std::string& list) {
  ReadOptions options;
  options.undefined = Undefined::keep;
  std::string comment, size_comment = "overrides the size that the file states";
  try {
    const Surface surface = read_surface(file, options);
    const Grid2D& grid = surface.grid;
    comment =
        fmt::format("{} x {} points, {} x {}, rms height {}", grid.nx, grid.ny,
                    format_quantity(grid.lx, Dimension::length, 4),
                    format_quantity(grid.ly, Dimension::length, 4),
                    format_quantity(height_statistics(surface).rms_height, Dimension::length, 3));
  } catch (const InvalidInput&) {
    // If the file only lacks a size, it can be read with any size. Other errors are thrown here.
    options.size_x = options.size_y = 1e-4;
    const Grid2D grid = read_surface(file, options).grid;
    comment = fmt::format("{} x {} points, size not stated", grid.nx, grid.ny);
    size_comment = "needed: the file states none";
  }
  return fmt::format(fmt::runtime(list_entry), toml_file(file, list), comment,
                     key_or_choice("size_x", "", "\"10um\"", size_comment),
                     key_or_choice("size_y", "", "\"10um\"", "without it cells are square"));
}

void write_list(const TwinArguments& arguments, Session& session) {
  require_options(
      arguments.scans.empty() ? std::vector<std::string>{"--files"} : std::vector<std::string>{},
      "the list of scans");
  require(!session.has_output() && !session.has_plot(), "LIST", arguments.list,
          "is the only file that init writes; leave out --output and --plot");
  session.writes("LIST", arguments.list);
  require_output(arguments.list, session.write_options());
  std::string text = fmt::format(fmt::runtime(list_heading),
                                 std::filesystem::path(arguments.list).filename().string());
  for (const std::string& scan : arguments.scans) text += entry_of(scan, arguments.list);
  write_text_file(arguments.list, text, session.write_options());
  session.answer(Json{{"file", arguments.list}, {"scans", arguments.scans.size()}},
                 fmt::format("{0} is written, with a table for each scan. State the instrument of "
                             "each scan, then run:\n  salebra twin {0} -o surface.h5\n",
                             arguments.list));
}

void run(const TwinArguments& arguments, Session& session) {
  if (arguments.file == "init" && !arguments.list.empty()) return write_list(arguments, session);
  require(arguments.list.empty() && arguments.scans.empty(), "FILE", arguments.file,
          "must be an existing list; write one with: salebra twin init LIST --files SCAN …");
  std::vector<std::string> warnings;
  TwinOptions options{.seed = arguments.seed};
  if (!arguments.form.empty()) options.form = parse_enum<SpectrumForm>(arguments.form);
  const SurfaceTwin twin =
      twin_of(read_twin_measurements(arguments.file), options, session.progress(), &warnings);
  session.warn(warnings);
  if (session.has_output())
    write_twin(session.output(), twin, session.provenance(), session.write_options());
  if (session.has_plot()) session.plot(figures::figure_of(twin));
  Json answer = answer_json(twin);
  answer["groups"] = to_json(twin.groups);
  answer["scans"] = to_json(twin.scans);
  for (const TwinWithout& other : twin.without) answer["without"].push_back(answer_json(other));
  session.warn(twin.warnings);
  session.answer(answer, twin_text(twin));
}

}  // namespace

void add_twin_command(Program& program) {
  auto arguments = std::make_shared<TwinArguments>();
  Command& command = program.add_command(
      "twin", "one surface from several scans, with its uncertainty",
      {"salebra twin scans.toml -o surface.h5 --plot surface.png",
       "salebra twin init scans.toml --files wli.sur afm-1.gwy afm-2.gwy"},
      [arguments](Session& session) { run(*arguments, session); },
      "the spectrum with its 95 % band, and that of each instrument");
  command
      .add_option("FILE", arguments->file,
                  "TOML file with a table [[measurement]] for each scan: file, instrument, and its "
                  "resolution or tip_radius; or init, to write such a file as LIST")
      ->required()
      ->file(FileUse::input);
  command.add_option("LIST", arguments->list, "with init: the list of scans to write")
      ->type_name("LIST");
  command.add_option("--files", arguments->scans, "with init: the scans")->file(FileUse::input);
  add_choice<SpectrumForm>(command, "--form", arguments->form,
                           "how the spectrum falls from its plateau; default: the likelier form");
  add_seed(command, arguments->seed, "seed of the draws; default 1");
}

}  // namespace salebra::cli
