// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra init`: writes a commented study file to start from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/surface/moments.hpp>

#include "io/text_file.hpp"
#include "options.hpp"
#include "program.hpp"
#include "toml_text.hpp"

namespace salebra::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view conventions =
    R"(# Quantities are numbers in SI units or strings with a unit: "10um", "115GPa", "20kHz", "90deg".
# A line that begins with "# " and a key is an option that is not set: remove "# " to set it.

)";

constexpr std::string_view generated_surface =
    R"([surface]                    # self-affine random surfaces, one for each seed
points = 512                 # cells along x and y; [nx, ny] for different numbers
size_x = "10um"              # period along x
# size_y = "10um"            # without it cells are square
hurst = 0.8                  # Hurst exponent: C(q) ~ q^(-2 - 2H) between roll-off and cut-off
rolloff = "1.25um"           # wavelength where the plateau ends; at most an eighth of the size, otherwise surfaces scatter widely
# long_cutoff = "10um"       # longest wavelength; without it the plateau extends to the size
short_cutoff = "156.25nm"    # shortest wavelength: eight cells; with fewer the contact area is too large
rms_height = "30nm"          # or give rms_slope
# rms_slope = 0.2            # instead of rms_height
# stretch_along = 5          # a lay: correlation length along it over that across it, to which rolloff and short_cutoff belong
# lay_angle = "0deg"         # from the x axis to the lay
# skewness = -1              # of heights that are not Gaussian; with kurtosis, which is 3 for Gaussian ones
# kurtosis = 4.5             # of the same heights, at least skewness^2 + 1
# twin = "surface.h5"        # instead of hurst to rms_height: result of `salebra twin` for several scans of a part
# psd_table = "psd.txt"      # instead of hurst to rms_height: two columns, q in rad/m and C(q) in m^4
method = "filtered-noise"    # Gaussian surfaces; "random-phase" has the same rms height for every seed
seed_count = 4               # use 20 or more for intervals to publish
first_seed = 1               # the seeds are consecutive
# seeds = [1, 2, 3, 4]       # instead of seed_count and first_seed

# [ensemble]                 # lists for keys of [surface]: every combination runs with all seeds
# hurst = [0.3, 0.5, 0.8]    # also: rolloff, short_cutoff, size_x (cells keep their size), points (the surface keeps its size)
# target_precision = "2%"    # stop once the 95 % intervals of l/h_rms and of the area slope are this narrow
# min_realisations = 8       # number of surfaces before the precision is checked
)";

constexpr std::string_view measured_surface =
    R"([surface]
file = {file}
{size_x}
{size_y}
{height_unit}
{rest}{detrend}
# A measured surface is continued periodically after its plane is removed; the study reports the height of the step at its edges.
)";

constexpr std::string_view rest = R"(
[material]
contact_modulus = "115GPa"   # E* of both bodies together: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; this is steel on steel
poisson = 0.3                # of an elastic body on a rigid one; gives G*
# tangential_modulus = "95GPa"  # G*, instead of poisson
# friction_coefficient = 0.3    # with it the damping constant includes slip; density = 7800 (kg/m^3) serves to check for inertia
# hardness = "7GPa"             # the surface is first loaded to the largest pressure, and yields where the local pressure reaches this
# young = ["210GPa", "70GPa"]   # instead of contact_modulus; then poisson = [0.3, 0.33]

[contact]
relative_pressures = "5e-4:0.2:16"   # from:to:count in geometric progression, in units of E* times the rms slope
# pressures = "10MPa:1GPa:16"        # nominal pressures, instead of relative_pressures
tolerance = 1e-8                     # of each contact: gap times pressure over mean pressure and rms height
tangential_stiffness = "stick"       # K_t from solving each contact in full stick; "proportional": K_t = (G*/E*)K, faster, exact at nu = 0 without coupling
# flow_factors = true                # adds the flow factors of the gap of each contact

# [conduction]               # conductance of the contacts
# conductivity = 50          # thermal conductivity, W/(m K): one value for both bodies, or two
# resistivity = 2e-7         # electrical resistivity, ohm m: one value or two

# [adhesion]                 # instead of [damping]: contacts that adhere
# work_of_adhesion = "50mJ/m^2"  # of both surfaces together
# range = "5nm"                  # range of the attraction; cells must be much shorter than range^2 E*/work_of_adhesion
# potential = "exponential"      # or "maugis", "van_der_waals"
# cycle = "20nm:2nm:12"          # mean gaps, closing and opening, for pull-off and hysteresis
# force_coarse = false           # true: compute even if cells are too long

# [fit]
# pressure_window = ["50MPa", "500MPa"]  # where the exponential law is fitted; default: mean gaps from 1 to 2.5 rms heights

# [compare]
# models = ["gw_moments", "gw_deterministic", "gw_monte_carlo", "gw_interacting", "persson"]  # models of salebra compare

[damping]
mode = "drag"                # slow tangential motion under a normal oscillation, Eqs (13) to (16)
normal_amplitude = {amplitude}     # Eq. (16) holds if it is much smaller than the decay length l (about half the rms height)
drag_velocity = "100nm/s"    # of a slow oscillation, far below (mu E*/G*) u_z omega; a motion that never reverses ends in sliding
# excursion = "0.1nm"          # of the slow oscillation, from one turning point to the other; determines its slip
frequency = "20kHz"          # of the normal oscillation
# angular_frequency = 125664   # rad/s, instead of frequency
# mode = "equal-frequency"     # both directions oscillate, Eq. (12); then, instead of drag_velocity:
# tangential_amplitude = "1nm"  # amplitude of the tangential motion
# phase = "90deg"               # phase between the two motions
hold = "auto"                # "force" keeps the mean force, "indentation" the mean indentation; auto: force if the contact lifts off
# direction = "across"       # of the tangential motion: across or along the lay, both, or an angle such as "30deg"; default both where there is a lay, else along x
# amplitude = "small"        # the limit u_z -> 0, to compare with Eq. (16); default "finite"
# relative_error = "5%"      # error allowed for each damping constant; cells are halved until it is met
# intervals = 4              # intervals between the contacts solved inside the oscillation: 4, 8, 16 or 32; 0: solve none, take the loss from the curve between loads
# seam_error = "window"      # adds the error of continuing a scan periodically; or "free"
)";

/// Comment lines at the top of the file, with the commands that use the file.
std::string file_heading(const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  const std::pair<std::string, const char*> commands[] = {
      {"salebra study " + file + " --dry-run", "estimates time and memory"},
      {"salebra study " + file + " -o " + stem + ".h5", "runs it; --resume continues after Ctrl-C"},
      {"salebra compare " + file + " -o " + stem + ".h5", "runs it with every contact model"}};
  std::size_t longest = 0;
  for (const auto& [command, what] : commands) longest = std::max(longest, command.size());
  std::string text = "# A study of salebra: from surfaces through contact to relaxation damping.\n";
  for (const auto& [command, what] : commands)
    text += fmt::format("#   {:<{}}   {}\n", command, longest, what);
  return text + std::string(conventions);
}

/// Lines for the options of reading other than size and unit that were given or, if there are none,
/// a comment that names them.
std::string preparation(const MeasuredSurface& surface) {
  std::string lines;
  if (surface.transpose) lines += "transpose = true\n";
  if (const auto& step = surface.pixel_size)
    lines +=
        fmt::format("pixel_size = [{}, {}]\n", toml_length(step->first), toml_length(step->second));
  if (!surface.lateral_unit.empty())
    lines += fmt::format("lateral_unit = {}\n", toml_string(surface.lateral_unit));
  if (!surface.channel.empty())
    lines += fmt::format("channel = {}\n", toml_string(surface.channel));
  if (surface.despike) lines += fmt::format("despike = {}\n", *surface.despike);
  if (const auto& part = surface.crop)
    lines += fmt::format("crop = [{}, {}, {}, {}]\n", toml_length(part->x0), toml_length(part->y0),
                         toml_length(part->x1), toml_length(part->y1));
  if (surface.fill) lines += "fill = true\n";
  if (const auto& cutoff = surface.filters.s_filter)
    lines += fmt::format("s_filter = {}\n", toml_length(*cutoff));
  if (const auto& cutoff = surface.filters.l_filter)
    lines += fmt::format("l_filter = {}\n", toml_length(*cutoff));
  return lines.empty() ? "# transpose, pixel_size, lateral_unit, channel, despike, crop, fill, "
                         "s_filter, l_filter: like the options of these names\n"
                       : lines;
}

struct Arguments {
  std::string file = "study.toml";
  SurfaceOptions surface;
};

/// The [surface] table of a measured surface. Reads the surface, so that an input that `study`
/// would refuse is refused now. Sets `amplitude` to a normal amplitude that suits its roughness.
std::string measured(const Arguments& arguments, std::string& amplitude, Session& session) {
  const SurfaceOptions& given = arguments.surface;
  const Surface surface = given.read(session);
  const double rms_height = height_statistics(surface).rms_height;
  require(rms_height > 0, "--surface", given.file, "is flat; there is no roughness to study");
  // 1/30 of the rms height, to one digit.
  const double wanted = rms_height / 30, digit = std::pow(10, std::floor(std::log10(wanted)));
  amplitude = toml_length(std::round(wanted / digit) * digit);
  const auto size = [](const std::optional<double>& value) {
    return value ? toml_length(*value) : std::string();
  };
  const auto text = [](const std::string& value) {
    return value.empty() ? value : toml_string(value);
  };
  return fmt::format(
      fmt::runtime(measured_surface),
      fmt::arg("file", toml_file(given.file, arguments.file) + "  # from this file's folder"),
      fmt::arg("size_x", key_or_choice("size_x", size(given.size_x), "\"10um\"",
                                       "if the file does not state its size")),
      fmt::arg("size_y", key_or_choice("size_y", size(given.size_y), "\"10um\"",
                                       "without it cells are square")),
      fmt::arg("height_unit", key_or_choice("height_unit", text(given.height_unit), "\"nm\"",
                                            "if the file names none")),
      fmt::arg("rest", preparation(given.measured())),
      fmt::arg("detrend", key_or_choice("detrend", text(given.detrend), "\"plane\"",
                                        fmt::format("{}", fmt::join(names_of<Detrend>(), ", ")))));
}

void run(Arguments arguments, Session& session) {
  if (session.has_output())
    arguments.file = session.output().string();
  else
    session.writes("FILE", arguments.file);
  require_output(arguments.file, session.write_options());
  std::string amplitude = toml_string("1nm");
  const std::string surface = arguments.surface.given() ? measured(arguments, amplitude, session)
                                                        : std::string(generated_surface);
  write_text_file(arguments.file,
                  file_heading(fs::path(arguments.file).filename().string()) + surface +
                      fmt::format(fmt::runtime(rest), fmt::arg("amplitude", amplitude)),
                  session.write_options());
  session.answer(Json{{"file", arguments.file}},
                 fmt::format("{0} is written, with a comment for each key. Next:\n  salebra study "
                             "{0} --dry-run\n  salebra study {0} -o {1}.h5\n",
                             arguments.file, fs::path(arguments.file).stem().string()));
}

}  // namespace

void add_init_command(Program& program) {
  auto arguments = std::make_shared<Arguments>();
  Command& command = program.add_command(
      "init", "write a study file in which every key is explained",
      {"salebra init study.toml",
       "salebra init scan.toml --surface scan.txt --size-x 10um --size-y 10um"},
      [arguments](Session& session) { run(*arguments, session); }, "", OutputCheck::any_name);
  command.add_option("FILE", arguments->file, "study file to write, study.toml by default")
      ->type_name("FILE");
  arguments->surface.add_to(command, false, "--surface");
}

}  // namespace salebra::cli
