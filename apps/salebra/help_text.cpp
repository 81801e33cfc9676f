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

/// What the help of a command says beyond its one line: what it needs, what it computes, and where
/// one goes from there.
struct CommandHelp {
  std::string_view name;
  std::string_view group;  ///< under which the screen of all commands has it; empty: not there
  std::string_view used;   ///< the options most used, which come first
  std::string_view text;   ///< paragraphs, parted by an empty line
};

constexpr std::string_view start = "Start", surfaces = "Surface", contact = "Contact",
                           damping = "Damping";

constexpr std::array descriptions{
    CommandHelp{
        "init", start, "--surface",
        "Writes a study file in which every key is explained: of generated surfaces, or of the "
        "measured one that --surface names. It runs as it is; edit it to ask your own question.\n\n"
        "Next: salebra study FILE --dry-run estimates its time and memory, salebra study FILE runs "
        "it."},
    CommandHelp{
        "study", start,
        "--surface --pressures --hardness --friction-coefficient --excursion --dry-run",
        "For each surface of a study file, or one measured surface: statistics, contact by "
        "boundary elements and Greenwood-Williamson, the fit of F ~ exp(-gap/l), and relaxation "
        "damping. Reports means with 95 % intervals. Surfaces run side by side, one on each "
        "thread. With --output, --resume continues a run that was stopped. Several processes or "
        "machines share a study by --shard, and --merge puts the result together.\n\n"
        "New here? salebra init writes a file to start with, --dry-run estimates time and memory."},
    CommandHelp{
        "report", start, "",
        "Makes one offline HTML page of the results of a study: figures, tables, settings."},
    CommandHelp{"verify", start, "",
                "Solves problems whose solutions are known and compares: a few seconds after an "
                "installation or an update. Exit status 1 where one is off."},
    CommandHelp{
        "generate", surfaces, "--points --size-x --hurst --rolloff --short-cutoff --rms-height",
        "Makes a rough surface with a given power spectrum, a profile, or an analytic shape. One "
        "seed gives one surface on any grid and any number of threads. Reports what was requested, "
        "what the grid holds in the mean, and what came out. Warns where a grid cannot carry the "
        "spectrum.\n\n"
        "Next: salebra statistics measures it, salebra contact presses it."},
    CommandHelp{
        "statistics", surfaces, "--all --fill --plot --size-x --size-y --detrend",
        "Size, roughness, moments, summits and self-affine law of a surface, and the shortest "
        "wavelength that the instrument leaves reliable. With --all, or into a file, also ISO "
        "25178-2 parameters, power spectra, correlation, structure function, slope and curvature "
        "by scale, bearing curve and distribution of heights. Nothing but the trend (--detrend) "
        "is removed, and holes are filled on request only (--fill).\n\n"
        "Next: salebra contact presses the surface, salebra study computes its damping."},
    CommandHelp{
        "twin", surfaces, "--files --form",
        "Finds the one self-affine surface that several scans are pieces of: optical maps, stylus "
        "and AFM scans of any size. Blur, tip, noise, calibration, drift and levelling of each "
        "instrument are part of the fit. Reports Hurst exponent, roll-off, cut-off, rms height and "
        "slope with joint 95 % limits, says what no scan sees, and what changes without each "
        "instrument.\n\n"
        "FILE has a table for each scan:\n"
        "  [[measurement]]\n"
        "  file = \"wli.sur\"\n"
        "  instrument = \"optical\"    # or stylus, afm, ideal\n"
        "  resolution = \"1.5um\"      # of stylus and afm: tip_radius\n\n"
        "salebra twin init LIST --files SCAN … writes it with every key explained.\n\n"
        "Next: salebra study STUDY --twin OUT draws surfaces of the part."},
    CommandHelp{"convert", surfaces, "--fill",
                "Reads a surface and writes it in the format that the extension of OUT names. "
                "docs/formats.md lists what each format keeps."},
    CommandHelp{
        "contact", contact, "--pressure --contact-modulus --young --poisson --stiffness --model",
        "Presses a surface by boundary elements. One operating point gives area, gap, pressure, "
        "energy, "
        "and the stiffness on request; several pressures give a force-gap curve, with K and K_t, "
        "which damping needs, on request. Periodic surfaces fill the plane; --boundary free takes "
        "a surface by itself. --model gw_moments and gw_deterministic are the fast theory of "
        "Greenwood and Williamson, good at light loads only: salebra compare shows how good on "
        "your surface.\n\n"
        "Next: salebra fit for the decay length, salebra damping --curve for the damping."},
    CommandHelp{
        "fit", contact, "--pressure-window --plot",
        "The decay length l of p = p0 exp(-gap/l) of a curve in a file, with its interval, and "
        "whether the law holds at all."},
    CommandHelp{
        "compare", contact, "--surface --pressures --models --dry-run",
        "Boundary elements, four kinds of Greenwood-Williamson and Persson's theory on the same "
        "surfaces, from the force-gap curve to the damping constant, with intervals. Takes what "
        "study takes, and about twice its time, which --dry-run estimates."},
    CommandHelp{
        "damping", damping,
        "--law --curve --surface --normal-amplitude --drag-velocity --frequency "
        "--friction-coefficient",
        "What a contact loses in a cycle, by any law, curve or surface: without slip by the "
        "theorem "
        "for any amplitude, beside the small-amplitude Eqs (12), (15) and (16); with a coefficient "
        "of friction also with slip. One quantity may be a range, and is then drawn by --plot. Of "
        "slow tangential motions it is a damper that one tunes by its amplitude: a map over "
        "amplitudes and frequencies, the decay of an oscillator, the amplitude that keeps a slider "
        "from stick-slip. An indenter without a motion is at rest: force, contact radius, "
        "stiffness."},
    CommandHelp{
        "sliding", damping, "--law --curve --surface --friction-coefficient --velocities --mass",
        "A contact that slides while it oscillates in the normal direction. Reports mean friction "
        "over velocity, the velocity from which nothing sticks, and two damping constants: of slow "
        "sliding, and of relaxation without slip. With --mass and --spring-stiffness a spring "
        "drags "
        "a mass over the contact: stick-slip or steady sliding, by the full equation of motion and "
        "by its average over a normal oscillation, and the amplitude and frequency from which the "
        "oscillation keeps sliding stable."},
    CommandHelp{
        "joint", damping,
        "--curve --surface --tangential-forces --tangential-amplitudes --friction-coefficient",
        "A contact under a tangential force or displacement that oscillates: what partial slip "
        "loses, secant, storage and loss stiffness, with a constant or an oscillating normal "
        "force."},
    CommandHelp{
        "viscoelastic", damping,
        "--law --radius --indentation --prony --normal-amplitude --frequency",
        "An axisymmetric indenter that oscillates on a viscoelastic body without slip. Reports "
        "what "
        "the material loses by the normal and by the tangential motion, and what relaxation "
        "damping loses, over frequency or another quantity."},
    CommandHelp{
        "oscillate", damping, "--shape --surface --pressure --normal-amplitude --phase --friction",
        "The direct experiment in three dimensions: a contact is moved through its cycle and the "
        "work is counted, by time steps or by contact levels. Friction may be finite, and normal "
        "and tangential directions coupled. Several shapes stand side by side, as in the paper's "
        "Fig. 3. Minutes, not seconds."},
    CommandHelp{
        "export", damping,
        "--to --units --friction-coefficient --pressure --nominal-area --sliders --law",
        "Writes pressure over clearance, with friction where its coefficient is given, as input of "
        "finite-element programs, or a joint as sliders in parallel. Of a study of several "
        "surfaces the mean and two whole surfaces, low and high. The header of each deck has "
        "units, assumptions, range and what the clearance is counted from. Decks may be used in any "
        "program (MIT-0); docs/howto/decks.md says what each format is."},
    CommandHelp{
        "completion", "", "",
        "Prints the script that lets a shell complete commands, options, and their choices with "
        "the Tab key. An installed package has it in place; for a build of your own:\n"
        "  bash: source <(salebra completion bash)\n"
        "  zsh:  salebra completion zsh > \"${fpath[1]}/_salebra\""},
};

constexpr std::string_view chart =
    // At 80 columns a longer line would be wrapped, and lose its place in the chart.
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
    "  rubber or a polymer      losses under an indenter         viscoelastic\n"
    "  doubts about a model     all models on your surface       compare\n\n"
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

/// "  --option TYPE   what it is", the help below where the left half is too long.
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

/// The options under a heading, but those that were shown before.
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
