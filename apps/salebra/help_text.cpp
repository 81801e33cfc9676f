// SPDX-License-Identifier: GPL-3.0-or-later
// Help of the program and of its commands: their texts, and how they are laid out.
#include "help_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <salebra/base/error.hpp>
#include <sstream>

#include "terminal.hpp"

namespace salebra::cli {
namespace {

/// The text of a command's help: what it computes, what it needs, and which command to use next.
struct CommandHelp {
  std::string_view name;
  std::string_view group;  ///< heading on the screen of all commands; empty: not listed there
  std::string_view used;   ///< the most used options, listed first
  std::string_view text;   ///< paragraphs, parted by an empty line
};

constexpr std::string_view start = "Start", surfaces = "Surface", contact = "Contact",
                           damping = "Damping";

constexpr std::array descriptions{
    CommandHelp{"init", start, "--surface",
                "Writes a study file in which every key is explained, for generated surfaces or "
                "for the measured surface that --surface names. It runs as it is; edit it for your "
                "own problem.\n\nNext: salebra study FILE --dry-run estimates its time and memory, "
                "salebra study FILE runs it."},
    CommandHelp{"study", start,
                "--surface --pressures --hardness --friction-coefficient --excursion --dry-run",
                "Computes for each surface of a study file, or for one measured surface: "
                "statistics, contact by boundary elements and Greenwood-Williamson, the fit of F ~ "
                "exp(-gap/l), and the damping constant. Reports means with 95 % intervals. "
                "Surfaces run in parallel, one on each thread. If --output was given, --resume "
                "continues a run that was stopped. Several surfaces, a folder or a pattern are "
                "studied one by one and give one table, per nominal area. With --shard several "
                "processes or machines share a study, and --merge puts the result together.\n\nNew "
                "here? salebra init "
                "writes a file to start with, --dry-run estimates time and memory."},
    CommandHelp{
        "design", start, "",
        "Finds roughness, amplitude and other parameters of a study, within limits, for "
        "which a result (damping_constant, normal_stiffness, ...) has a wanted value over a "
        "range of forces. Judges the design on surfaces that the search did not use, and "
        "says what binds and what hardly matters. The exit status is 1 if the target is "
        "not met; the nearest design is printed.\n\nFILE:\n  study = \"study.toml\"\n  "
        "[target]\n  output = \"damping_constant\"\n  value = \"10N s/m\"\n  tolerance = "
        "\"20%\"\n  force = [\"17N\", \"23N\"]\n  [free]\n  rms_height = [\"100nm\", "
        "\"1um\"]\n  normal_amplitude = [\"1nm\", \"20nm\"]\n\nNext: salebra study "
        "--sensitivity shows which parameters decide."},
    CommandHelp{"report", start, "",
                "Makes one HTML page from the results of a study, with figures, tables and "
                "settings. The page needs no network."},
    CommandHelp{"verify", start, "",
                "Solves problems whose solutions are known and compares. Takes a few seconds; run "
                "it after an installation or an update. The exit status is 1 if a check fails."},
    CommandHelp{"generate", surfaces,
                "--points --size-x --hurst --rolloff --short-cutoff --rms-height",
                "Makes a rough surface with a given power spectrum, a profile, or an analytic "
                "shape. A seed gives the same surface on any grid and with any number of threads. "
                "Reports the moments that were requested, their mean on this grid, and those of "
                "the surface. Warns if the grid cannot carry the spectrum.\n\nNext: salebra "
                "statistics measures the surface, salebra contact presses it."},
    CommandHelp{
        "statistics", surfaces, "--all --csv --fill --plot --size-x --size-y --detrend",
        "Reports size, roughness, moments, summits and self-affine law of a surface, and the "
        "shortest wavelength that the instrument resolves reliably. With --all, or in an output "
        "file, also ISO 25178-2 parameters, power spectra, correlation, structure function, slope "
        "and curvature by scale, bearing curve and distribution of heights. With --all also Ra, "
        "Rq, "
        "Rz and Rsm of the profiles along x and y. Only the trend is removed (--detrend); "
        "waves are removed (--s-filter, --l-filter) and holes filled (--fill) only on request. "
        "Several surfaces, a folder or a pattern give one table with mean and standard deviation "
        "(spread) "
        "between the files; --csv writes it with all parameters.\n\nNext: salebra "
        "contact presses the surface, salebra study computes its damping."},
    CommandHelp{"twin", surfaces, "--files --form",
                "Finds the self-affine spectrum of the surface from which several scans were "
                "taken: optical maps, stylus and AFM scans of any size. The fit includes blur, "
                "tip, noise, calibration, drift and levelling of each instrument. Reports Hurst "
                "exponent, roll-off, cut-off, rms height and slope with joint 95 % limits, what no "
                "scan resolves, and what changes without each instrument.\n\nFILE has a table for "
                "each scan:\n  [[measurement]]\n  file = \"wli.sur\"\n  instrument = \"optical\"   "
                " # or stylus, afm, ideal\n  resolution = \"1.5um\"      # of stylus and afm: "
                "tip_radius\n\nsalebra twin init LIST --files SCAN … writes it with every key "
                "explained.\n\nNext: salebra study STUDY --twin OUT draws surfaces of the part."},
    CommandHelp{"convert", surfaces, "--fill",
                "Reads a surface and writes it in the format given by the extension of OUT. "
                "docs/formats.md lists what each format keeps."},
    CommandHelp{
        "contact", contact, "--pressure --contact-modulus --young --poisson --stiffness --model",
        "Presses a surface by boundary elements. One load gives area, gap, pressure and "
        "energy; several loads give a force-gap curve. --stiffness adds the stiffnesses K "
        "and K_t, which the damping needs. Periodic surfaces repeat without end; "
        "--boundary free takes a surface alone. --model gw_moments and gw_deterministic "
        "are the fast theory of Greenwood and Williamson, accurate only at light loads; "
        "salebra compare shows how accurate on your surface. Several surfaces, a folder or a "
        "pattern are pressed to the same pressures and give one table, per nominal area."
        "\n\nNext: salebra fit for the "
        "decay length, salebra damping --curve for the damping."},
    CommandHelp{"fit", contact, "--pressure-window --plot",
                "Fits the decay length l of p = p0 exp(-gap/l) to a curve in a file, with its "
                "interval, and tests whether the law holds at all."},
    CommandHelp{"compare", contact, "--surface --pressures --models --dry-run",
                "Compares boundary elements, four kinds of Greenwood-Williamson and Persson's "
                "theory on the same surfaces, from the force-gap curve to the damping constant, "
                "with intervals. Takes the same study file and options as study, and about twice "
                "its time; --dry-run estimates it."},
    CommandHelp{
        "damping", damping,
        "--law --curve --surface --normal-amplitude --drag-velocity --frequency "
        "--friction-coefficient",
        "Computes the energy that a contact loses in a cycle, and its damping constant, "
        "from a law, a curve or a surface. Without slip the loss follows from the theorem "
        "for any amplitude and is compared with the small-amplitude Eqs (12), (15) and "
        "(16); with a coefficient of friction it includes slip. One quantity may be a "
        "range, which --plot draws. Under slow shear the contact is a damper, tuned by the "
        "vibration amplitude: the command gives a map over amplitudes and frequencies, the "
        "decay of an oscillator, and the amplitude that keeps a slider from stick-slip. "
        "For an indenter without a motion it gives force, contact radius and stiffness. A folder "
        "or a quoted pattern as --surface, such as '*.sur', gives one table of its "
        "surfaces, per nominal area."},
    CommandHelp{"sliding", damping,
                "--law --curve --surface --friction-coefficient --velocities --mass",
                "Computes the friction of a contact that slides while it oscillates in the normal "
                "direction. Reports the mean friction over the velocity, the velocity from which "
                "nothing sticks, and two damping constants: that of slow sliding, and that of "
                "relaxation without slip. With --mass and --spring-stiffness a spring drags a mass "
                "over the contact. Then the command reports stick-slip or steady sliding, from the "
                "full equation of motion and from its average over a normal oscillation, and the "
                "amplitude and frequency from which the oscillation keeps sliding stable."},
    CommandHelp{
        "joint", damping,
        "--curve --surface --tangential-forces --tangential-amplitudes --friction-coefficient",
        "Computes partial slip of a contact under an oscillating tangential force or displacement: "
        "energy loss and secant, storage and loss stiffness, with a constant or an oscillating "
        "normal force."},
    CommandHelp{
        "viscoelastic", damping,
        "SURFACE --law --radius --indentation --prony --body --normal-amplitude --frequency",
        "Computes the losses of an axisymmetric indenter that oscillates on a viscoelastic body "
        "without slip: those of the material under the normal and under the tangential motion, and "
        "that of relaxation damping, over the frequency or another quantity. Of a rough surface "
        "it computes the losses of both motions by steps of boundary elements, on any linear body "
        "that relaxes as a whole."},
    CommandHelp{"oscillate", damping,
                "--shape --surface --pressure --normal-amplitude --phase --friction",
                "Simulates an oscillating contact in three dimensions: moves it through its cycle "
                "and sums the work, by time steps or by intervals of the indentation. Friction may "
                "be finite, "
                "and normal and tangential directions may be coupled. Several shapes can be "
                "compared, as in the paper's Fig. 3. Takes minutes, not seconds."},
    CommandHelp{
        "export", damping,
        "--to --units --friction-coefficient --pressure --nominal-area --sliders --law",
        "Writes pressure over clearance, with friction if its coefficient is given, as input for "
        "finite-element programs, or a joint as sliders in parallel. From a study of several "
        "surfaces it takes the mean and two whole surfaces, low and high. The header of each deck "
        "states units, assumptions, range and the zero of the clearance. Decks may be used in any "
        "program (MIT-0); docs/howto/decks.md describes each format."},
    CommandHelp{
        "completion", "", "",
        "Prints the script with which a shell completes commands, options and their choices on the "
        "Tab key. Installed packages contain it; for a build of your own:\n  bash: source "
        "<(salebra completion bash)\n  zsh:  salebra completion zsh > \"${fpath[1]}/_salebra\""},
};

constexpr std::string_view chart =
    // Lines must fit into 80 columns: a wrapped line would break the table.
    "Which command?\n"
    "  you have                 you want                         command\n"
    "  a measured surface       roughness and spectrum           statistics\n"
    "                           contact, force-gap curve         contact, fit\n"
    "                           damping                          study --surface\n"
    "  a spectrum, no file      such surfaces, their damping     generate, study\n"
    "  a law, a curve           damping for any motion           damping\n"
    "  a sphere, cone, profile  losses, slip; simulation in 3-D  damping, oscillate\n"
    "  a sliding contact        friction, stick-slip             sliding\n"
    "  an oscillator            its decay under vibration        damping\n"
    "  a joint                  losses in partial slip           joint\n"
    "  rubber or a polymer      losses under a contact           viscoelastic\n\n"
    "First steps:\n"
    "  salebra verify                        check this installation\n"
    "  salebra init study.toml               a study file with every key explained\n"
    "  salebra study study.toml -o study.h5  surfaces, contact, damping, intervals\n";

const CommandHelp& help_of(const Command& command) {
  const auto* found = std::ranges::find(descriptions, command.name(), &CommandHelp::name);
  require_that(found != descriptions.end(), command.name(), "has no text in help_text.cpp");
  return *found;
}

std::string title(std::string_view text) {
  return emphasised(text, Emphasis::heading, STDOUT_FILENO);
}

/// A line "  --option TYPE   help text". The help text begins a new line if the left part is too
/// long.
std::string line_of(const Option& option) {
  constexpr std::size_t column = 34;
  std::string line = fmt::format("  {}", fmt::join(option.names(), ", "));
  if (!option.type_name().empty() && !option.positional()) line += " " + option.type_name();
  line += columns_of(line) + 2 > column ? "\n" + std::string(column, ' ')
                                        : std::string(column - columns_of(line), ' ');
  line += option.help();
  if (!option.choices().empty() && !option.help_lists_choices())
    line += fmt::format(": {}", fmt::join(option.choices(), " | "));
  return line + (option.required() && !option.positional() ? " (required)\n" : "\n");
}

/// The options under a heading that were not shown before.
std::string section(const Command& command, const std::string& heading,
                    const std::vector<std::string>& shown) {
  std::string text;
  for (const Option& option : command.options())
    if (!option.positional() && option.group() == heading &&
        std::ranges::find(shown, option.names().back()) == shown.end())
      text += line_of(option);
  return text.empty() ? "" : fmt::format("\n{}:\n{}", title(heading), text);
}

}  // namespace

std::string program_help(const std::deque<Command>& commands) {
  std::string text =
      "Statistics of rough-surface contact and its relaxation damping.\n"
      "Usage: salebra COMMAND [OPTIONS]    salebra help COMMAND: examples and options\n\n";
  std::string_view group;
  for (const Command& command : commands) {
    const CommandHelp& help = help_of(command);
    if (help.group.empty()) continue;
    const std::string_view heading = help.group == group ? "" : group = help.group;
    text += fmt::format("{}{} {:<13} {}\n", title(heading), std::string(8 - heading.size(), ' '),
                        command.name(), command.what());
  }
  return text + "\n" + std::string(chart) +
         "\nOptions of every command, values and exit status: salebra help options.\n";
}

std::string options_help(const Command& command) {
  return section(command, common_options, {}).substr(1) +
         "\nValues take units (10um, 20kHz, 115GPa, 90deg); a bare number is SI. VALUES are one "
         "value, a list a,b,c or a range from:to:count in geometric progression.\n\n"
         "Exit status: 0 done, 1 failed while running, 2 bad usage or input, 3 surfaces missing "
         "(study --merge), 130 interrupted.\n";
}

std::string command_help(const Command& command) {
  const CommandHelp& help = help_of(command);
  std::string arguments, usage = "salebra " + command.name(), text;
  std::vector<std::string> headings{"Options"}, used;
  for (const Option& option : command.options()) {
    if (option.positional()) {
      arguments += line_of(option);
      usage +=
          option.required() ? " " + option.names().front() : " [" + option.names().front() + "]";
    } else if (option.group() != common_options &&
               std::ranges::find(headings, option.group()) == headings.end()) {
      headings.push_back(option.group());
    }
  }
  std::string most;
  std::istringstream words{std::string(help.used)};
  for (std::string word; words >> word;) {
    const auto found = std::ranges::find_if(
        command.options(), [&](const Option& option) { return option.names().back() == word; });
    require_that(found != command.options().end(), word, "is not an option of " + command.name());
    most += line_of(*found);
    used.push_back(word);
  }
  text = fmt::format("{}: {}\n\n{}\n\n{}\n  {} [OPTIONS]\n\n{}\n  {}\n  {}\n",
                     title(command.name()), command.what(), help.text, title("Usage:"), usage,
                     title("Examples:"), command.examples()[0], command.examples()[1]);
  if (!arguments.empty()) text += fmt::format("\n{}\n{}", title("Arguments:"), arguments);
  if (!most.empty()) text += fmt::format("\n{}\n{}", title("Most used:"), most);
  for (const std::string& heading : headings) text += section(command, heading, used);
  return text +
         "\nValues take units (10um, 115GPa, 90deg). Options of every command, such as --output "
         "and --json: salebra help options.\n";
}

}  // namespace salebra::cli
