// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra twin`: one surface from several scans, with what they leave open.
#include <fmt/format.h>

#include <memory>
#include <salebra/base/units.hpp>
#include <salebra/study/twin_file.hpp>

#include "options.hpp"
#include "program.hpp"
#include "results/answer_json.hpp"
#include "surface_figure.hpp"
#include "terminal.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct TwinArguments {
  std::string file, form;
  std::uint64_t seed = 1;
};

constexpr std::string_view form_in_words(SpectrumForm form) {
  return form == SpectrumForm::corner   ? "a power law with a corner at the roll-off"
         : form == SpectrumForm::smooth ? "a power law with a smooth roll-off"
                                        : "no self-affine law, a table";
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
                    row_of("rms_slope", twin.rms_slope, Dimension::dimensionless)},
                   2, true);
  text +=
      fmt::format("\nFit: deviance {:.2g} times what is expected; a law is refused above {:g}\n",
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
                        other.agrees ? "nothing moves by more than chance explains"
                                     : "the others say something else; look at its calibration");
  for (const std::string& note : twin.notes) text += wrapped(note + "\n", text_width());
  return text;
}

void run(const TwinArguments& arguments, Session& session) {
  std::vector<std::string> remarks;
  TwinOptions options{.seed = arguments.seed};
  if (!arguments.form.empty()) options.form = value_of<SpectrumForm>(arguments.form);
  const SurfaceTwin twin =
      twin_of(read_twin_measurements(arguments.file), options, session.progress(), &remarks);
  session.warn(remarks);
  if (session.has_output())
    write_twin(session.output(), twin, session.provenance(), session.write_options());
  if (session.has_plot()) session.plot(twin_figure(twin));
  Json answer = answer_json(twin);
  answer["groups"] = to_json(twin.groups);
  answer["scans"] = to_json(twin.scans);
  for (const TwinWithout& other : twin.without) answer["without"].push_back(answer_json(other));
  answer["notes"] = twin.notes;
  session.answer(answer, twin_text(twin));
}

}  // namespace

void add_twin_command(Program& program) {
  auto arguments = std::make_shared<TwinArguments>();
  Command& command = program.add_command(
      "twin", "one surface from several scans of it, with what they leave open",
      {"salebra twin scans.toml -o surface.h5 --plot surface.png",
       "salebra study part.toml --twin surface.h5"},
      [arguments](Session& session) { run(*arguments, session); },
      "the spectrum with its 95 % band, and that of each instrument");
  command
      .add_option("FILE", arguments->file,
                  "TOML file with a table [[measurement]] for each scan: file, instrument, and "
                  "its resolution or tip_radius")
      ->required()
      ->file(FileUse::input);
  add_choice<SpectrumForm>(command, "--form", arguments->form,
                           "how the spectrum falls from its plateau; default: by likelihood");
  add_seed(command, arguments->seed, "of the draws; default 1");
}

}  // namespace salebra::cli
