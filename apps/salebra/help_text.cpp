// SPDX-License-Identifier: GPL-3.0-or-later
// Help of each command beyond its one line, of help_text.hpp.
#include "help_text.hpp"

#include <algorithm>
#include <array>

namespace salebra::cli {
namespace {

constexpr std::string_view start = "Start here", surfaces = "Surfaces", contact = "Contact",
                           damping = "Damping", shell = "For the shell";

constexpr std::array descriptions{
    CommandHelp{
        "init", start,
        "Writes a study file in which every key is explained: of generated surfaces, or of the "
        "measured one that --surface names. It runs as it is; edit it to ask your own question.\n\n"
        "Next: salebra study FILE --dry-run estimates its time and memory, salebra study FILE runs "
        "it."},
    CommandHelp{
        "study", start,
        "For each surface of a study file, or one measured surface: statistics, contact by "
        "boundary elements and Greenwood-Williamson, the fit of F ~ exp(-gap/l), and relaxation "
        "damping. Reports means with 95 % intervals. Surfaces run side by side, one on each "
        "thread. With --output, --resume continues a run that was stopped. Several processes or "
        "machines share a study by --shard, and --merge puts the result together.\n\n"
        "New here? salebra init writes a file to start with, --dry-run estimates time and memory."},
    CommandHelp{
        "report", start,
        "Makes one offline HTML page of the results of a study: figures, tables, settings."},
    CommandHelp{"verify", start,
                "Solves problems whose solutions are known and compares: a few seconds after an "
                "installation or an update. Exit status 1 where one is off."},
    CommandHelp{
        "generate", surfaces,
        "Makes a rough surface with a given power spectrum, a profile, or an analytic shape. One "
        "seed gives one surface on any grid and any number of threads. Reports what was requested, "
        "what the grid holds in the mean, and what came out. Warns where a grid cannot carry the "
        "spectrum.\n\n"
        "Next: salebra info and statistics measure it, salebra contact presses it."},
    CommandHelp{
        "info", surfaces,
        "Size, roughness, moments, summits and Hurst exponent of a surface in any readable file. "
        "A file that does not state its size needs --size-x and --size-y.\n\n"
        "Next: salebra statistics for spectra and ISO 25178-2 parameters."},
    CommandHelp{
        "statistics", surfaces,
        "Power spectra, correlation, structure function, slope and curvature by scale, bearing "
        "curve, ISO 25178-2 parameters, and the self-affine law fitted to the spectrum. Reports "
        "the "
        "shortest wavelength that the instrument leaves reliable. Nothing but the trend "
        "(--detrend) is removed, and holes are filled on request only (--fill)."},
    CommandHelp{"convert", surfaces,
                "Reads a surface and writes it in the format that the extension of OUT names. "
                "docs/formats.md lists what each format keeps."},
    CommandHelp{
        "contact", contact,
        "Presses a surface by boundary elements. One position gives area, gap, pressure, energy, "
        "and the stiffness on request; several pressures give a force-gap curve, with K and K_t, "
        "which damping needs, on request. Periodic surfaces fill the plane; --boundary free takes "
        "a surface by itself. --model gw_moments and gw_deterministic are the fast theory of "
        "Greenwood and Williamson, good at light loads only: salebra compare shows how good on "
        "your surface.\n\n"
        "Next: salebra fit for the decay length, salebra damping --curve for the damping."},
    CommandHelp{
        "fit", contact,
        "The decay length l of p = p0 exp(-gap/l) of a curve in a file, with its interval, and "
        "whether the law holds at all."},
    CommandHelp{
        "compare", contact,
        "Boundary elements, four kinds of Greenwood-Williamson and Persson's theory on the same "
        "surfaces, from the force-gap curve to the damping constant, with intervals. Takes what "
        "study takes, and about twice its time, which --dry-run estimates."},
    CommandHelp{
        "damping", damping,
        "Relaxation damping of any contact law or curve: the energy that a contact without slip "
        "loses in a cycle. Eqs (12), (15) and (16) hold for small amplitudes, the theorem for any. "
        "One quantity may be a range, and is then drawn by --plot."},
    CommandHelp{
        "mdr", damping,
        "An axisymmetric contact by the method of dimensionality reduction: force, stiffness, "
        "stresses, and losses with and without friction, along any trajectory."},
    CommandHelp{
        "damper", damping,
        "The contact as a damper that one tunes by its amplitude: decay of an oscillator, and an "
        "estimate of the amplitude that keeps a slider from stick-slip."},
    CommandHelp{
        "sliding", damping,
        "A contact that slides while it oscillates in the normal direction. Reports mean friction "
        "over velocity, the velocity from which nothing sticks, and two damping constants: of slow "
        "sliding, and of relaxation without slip. With --mass and --spring-stiffness a spring "
        "drags "
        "a mass over the contact: stick-slip or steady sliding, by the full equation of motion and "
        "by its average over a normal oscillation, and the amplitude and frequency from which the "
        "oscillation keeps sliding stable."},
    CommandHelp{
        "joint", damping,
        "A contact under a tangential force or displacement that oscillates: what partial slip "
        "loses, secant, storage and loss stiffness, with a constant or an oscillating normal "
        "force."},
    CommandHelp{
        "viscoelastic", damping,
        "An axisymmetric indenter that oscillates on a viscoelastic body without slip. Reports "
        "what "
        "the material loses by the normal and by the tangential motion, and what relaxation "
        "damping loses, over frequency or another quantity."},
    CommandHelp{
        "oscillate", damping,
        "The direct experiment in three dimensions: a contact is moved through its cycle and the "
        "work is counted, by time steps or by contact levels. Friction may be finite, and normal "
        "and tangential directions coupled. Several shapes stand side by side, as in the paper's "
        "Fig. 3. Minutes, not seconds."},
    CommandHelp{
        "completion", shell,
        "Prints the script that lets a shell complete commands, options, and their choices with "
        "the Tab key. An installed package has it in place; for a build of your own:\n"
        "  bash: source <(salebra completion bash)\n"
        "  zsh:  salebra completion zsh > \"${fpath[1]}/_salebra\""},
};

}  // namespace

const CommandHelp* find_help(std::string_view command) {
  const auto found = std::ranges::find(descriptions, command, &CommandHelp::name);
  return found == descriptions.end() ? nullptr : &*found;
}

std::string_view first_steps() {
  // At 80 columns a longer line would be wrapped, and lose its place in the chart.
  return "Which command?\n"
         "  you have                you want                           command\n"
         "  a measured surface      its roughness and spectrum         info, statistics\n"
         "                          its contact at one load            contact\n"
         "                          its force-gap curve, decay length  contact, fit\n"
         "                          everything down to its damping     study --surface\n"
         "  a spectrum, no file     a surface with it                  generate\n"
         "                          the damping of such surfaces,\n"
         "                          with an interval                   init, study\n"
         "  a force-gap curve       its decay length                   fit\n"
         "                          its damping for any motion         damping --curve\n"
         "  a sphere, cone, profile force, stresses, losses, slip      mdr\n"
         "                          the same in three dimensions       oscillate\n"
         "  a sliding contact       its friction under vibration,\n"
         "                          stick-slip, and what stops it      sliding\n"
         "  an oscillator           its decay under vibration          damper\n"
         "  a joint                 losses in partial slip, W(T)       joint\n"
         "  rubber or a polymer     losses under an indenter           viscoelastic\n"
         "  several contact models  which one holds for your surface   compare\n"
         "  results of a study      a page to read and send            report\n\n"
         "First steps:\n"
         "  salebra verify                        check this installation\n"
         "  salebra init study.toml               a study file with every key explained\n"
         "  salebra study study.toml --dry-run    what it would cost\n"
         "  salebra study study.toml -o study.h5  surfaces, contact, damping, intervals\n"
         "  salebra info scan.x3p                 what is in a measured surface\n"
         "  salebra init --surface scan.x3p       a study file for it\n\n"
         "salebra help COMMAND explains a command and ends with two examples.\n"
         "Exit status: 0 done, 1 failed while running, 2 bad usage or input, 3 surfaces are "
         "missing "
         "(study --merge), 130 interrupted.";
}

}  // namespace salebra::cli
