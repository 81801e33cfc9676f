// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra init`: a commented study file to start from.
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
# A line that begins with "# " and a key is a choice that was not made: take the sign away to make it.

)";

constexpr std::string_view generated_surface =
    R"([surface]                    # self-affine random surfaces, one for each seed
points = 512                 # cells along x and y; [nx, ny] for a rectangle
size_x = "10um"              # the period
# size_y = "10um"            # without it cells are square
hurst = 0.8                  # Hurst exponent: C(q) ~ q^(-2 - 2H) between roll-off and cut-off
rolloff = "1.25um"           # wavelength where the plateau ends; at most an eighth of the size, or surfaces scatter much
# long_cutoff = "10um"       # longest wavelength; without it the plateau reaches the size
short_cutoff = "156.25nm"    # shortest wavelength: eight cells, fewer make the contact area too large
rms_height = "30nm"          # without rms_slope
# rms_slope = 0.2            # instead of rms_height
# twin = "surface.h5"        # instead of hurst to rms_height: what `salebra twin` made of several scans of a part
# psd_table = "psd.txt"      # instead of hurst to rms_height: two columns, q in rad/m and C(q) in m^4
method = "filtered-noise"    # Gaussian surfaces; "random-phase" has the same rms height for every seed
seed_count = 4               # 20 and more for intervals that one may publish
first_seed = 1               # of consecutive ones
# seeds = [1, 2, 3, 4]       # instead of seed_count and first_seed

# [ensemble]                 # lists take the index of a key of [surface]: every combination, with all seeds
# hurst = [0.3, 0.5, 0.8]    # also: rolloff, short_cutoff, size_x (cells keep their size), points (the surface keeps its size)
# target_precision = "2%"    # enough surfaces where the 95 % intervals of l/h_rms and of the area slope are so narrow
# min_realisations = 8       # before the precision is looked at
)";

constexpr std::string_view measured_surface =
    R"([surface]
file = {file}
{size_x}
{size_y}
{height_unit}
{rest}{detrend}
# A measured surface is continued periodically after its plane is removed; the study says how high the step at the seam is.
)";

constexpr std::string_view rest = R"(
[material]
contact_modulus = "115GPa"   # E* of both bodies together: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; this is steel on steel
poisson = 0.3                # of one elastic body on a rigid one, for G*
# tangential_modulus = "95GPa"  # G*, instead of poisson
# friction_coefficient = 0.3    # with it the damping constant is that with slip; density = 7800 (kg/m^3) is to judge inertia
# hardness = "7GPa"             # the surface is first loaded to the largest pressure, and flows where the local one reaches this
# young = ["210GPa", "70GPa"]   # instead of contact_modulus; then poisson = [0.3, 0.33]

[contact]
relative_pressures = "5e-4:0.2:16"   # from, to, how many (evenly in the logarithm), in units of E* times the rms slope
# pressures = "10MPa:1GPa:16"        # instead, nominal pressures
tolerance = 1e-8                     # of each contact: gap times pressure over mean pressure and rms height
tangential_stiffness = "stick"       # K_t by a solve on each contact; "proportional": (G*/E*)K, faster, exact at nu = 0 without coupling
# flow_factors = true                # of the gap of each contact

# [conduction]               # conductance of the contacts
# conductivity = 50          # thermal, W/(m K): one value for both bodies, or two
# resistivity = 2e-7         # electrical, ohm m: as conductivity

# [adhesion]                 # in index of [damping]: contacts that adhere
# work_of_adhesion = "50mJ/m^2"  # of both surfaces together
# range = "5nm"                  # of the attraction; a cell must be short against range^2 E*/work_of_adhesion
# potential = "exponential"      # or "maugis", "van_der_waals"
# cycle = "20nm:2nm:12"          # mean gaps, in and out, for pull-off and hysteresis
# force_coarse = false           # true: also where the cell is too long

# [fit]
# pressure_window = ["50MPa", "500MPa"]  # of the exponential law; without it mean gaps from 1 to 2.5 rms heights

# [compare]
# models = ["gw_moments", "gw_deterministic", "gw_monte_carlo", "gw_interacting", "persson"]  # of salebra compare

[damping]
mode = "drag"                # slow tangential motion under a normal oscillation, Eqs (13) to (16)
normal_amplitude = {amplitude}     # small against the decay length l (about half the rms height) for Eq. (16) to hold
drag_velocity = "100nm/s"    # of a slow oscillation, far below (mu E*/G*) u_z omega; a drag without end slides
# excursion = "0.1nm"          # of the slow oscillation, from one turning point to the other: decides its slip
frequency = "20kHz"          # of the normal oscillation
# angular_frequency = 125664   # rad/s, instead of frequency
# mode = "equal-frequency"     # both directions oscillate, Eq. (12); then, instead of drag_velocity:
# tangential_amplitude = "1nm"  # of its tangential motion
# phase = "90deg"               # between the two
hold = "indentation"         # of the mean indentation; "force" for a dead weight
# amplitude = "small"        # the limit u_z -> 0, to compare with Eq. (16); else "finite"
# relative_error = "5%"      # of each damping constant: halves the cells until it is met
# intervals = 4                 # intervals between contacts inside the oscillation: 4, 8, 16 or 32; 0: none, the loss from the curve between loads
# seam_error = "window"      # adds the error of the seam of a scan that is continued; or "free"
)";

/// What to do with the file, at its head.
std::string file_heading(const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  const std::pair<std::string, const char*> commands[] = {
      {"salebra study " + file + " --dry-run", "what this would cost"},
      {"salebra study " + file + " -o " + stem + ".h5", "run it; --resume continues after Ctrl-C"},
      {"salebra compare " + file + " -o " + stem + ".h5", "the same with every contact model"}};
  std::size_t longest = 0;
  for (const auto& [command, what] : commands) longest = std::max(longest, command.size());
  std::string text = "# A study of salebra: from surfaces through contact to relaxation damping.\n";
  for (const auto& [command, what] : commands)
    text += fmt::format("#   {:<{}}   {}\n", command, longest, what);
  return text + std::string(conventions);
}

/// Keys for what was given beside size and unit, and otherwise that they are there.
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
  return lines.empty()
             ? "# transpose, pixel_size, lateral_unit, channel, despike, crop, fill: as the "
               "options of that name\n"
             : lines;
}

struct Arguments {
  std::string file = "study.toml";
  SurfaceOptions surface;
};

/// Also reads the surface: what study would refuse is refused here, and its roughness sets the
/// amplitude.
std::string measured(const Arguments& arguments, std::string& amplitude, Session& session) {
  const SurfaceOptions& given = arguments.surface;
  const Surface surface = given.read(session);
  const double rms_height = height_statistics(surface).rms_height;
  require(rms_height > 0, "--surface", given.file, "is flat; there is no roughness to study");
  // A thirtieth of the rms height, to one digit.
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
                                       "where the file does not know its size")),
      fmt::arg("size_y", key_or_choice("size_y", size(given.size_y), "\"10um\"",
                                       "without it cells are square")),
      fmt::arg("height_unit", key_or_choice("height_unit", text(given.height_unit), "\"nm\"",
                                            "where the file names none")),
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
                 fmt::format("{0} is written, each key with a comment. Next:\n"
                             "  salebra study {0} --dry-run\n  salebra study {0} -o {1}.h5\n",
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
