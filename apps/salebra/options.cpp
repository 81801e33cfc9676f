// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several commands share: quantities, material, surface, operating point, motion.
#include "options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <numbers>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/coupling.hpp>  // coupling_constant(bodies)
#include <salebra/io/read_surface.hpp>
#include <salebra/study/body_file.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/moments.hpp>

#include "io/surface_formats.hpp"
#include "results/columns.hpp"
#include "several_files.hpp"
#include "surface/plausibility.hpp"

namespace salebra::cli {

namespace {

template <class Target>
Option* add_one(Command& app, const std::string& name, Target& target, Dimension dimension,
                const std::string& help) {
  return app
      .add_option_function(
          name,
          [&target, dimension, name](const std::string& text) {
            target = {parse_quantity(text, dimension, name)};
          },
          help)
      ->type_name(dimension == Dimension::dimensionless ? "NUMBER"
                                                        : std::string(si_unit(dimension)));
}

}  // namespace

Option* add_quantity(Command& app, const std::string& name, std::optional<double>& target,
                     Dimension dimension, const std::string& help) {
  return add_one(app, name, target, dimension, help);
}

Option* add_values(Command& app, const std::string& name, std::vector<double>& target,
                   Dimension dimension, const std::string& help) {
  return app
      .add_option_function(
          name,
          [&target, dimension, name](const std::string& text) {
            target = parse_values(text, dimension, name);
          },
          help)
      ->type_name(dimension == Dimension::dimensionless
                      ? "VALUES"
                      : fmt::format("VALUES in {}", si_unit(dimension)));
}

Option* add_choice(Command& app, const std::string& name, std::string& target,
                   const std::vector<std::string>& choices, const std::string& help) {
  return app.add_option(name, target, fmt::format("{}: {}", help, fmt::join(choices, " | ")))
      ->type_name("NAME")
      ->choices(choices);
}

double required(const std::optional<double>& value, std::string_view option,
                std::string_view reason) {
  if (!value) throw InvalidInput(option, fmt::format("not given, but {}", reason));
  return *value;
}

void require_options(const std::vector<std::string>& missing, const std::string& reason) {
  if (missing.empty()) return;
  const bool one = missing.size() == 1;
  throw InvalidInput(fmt::format("{}", fmt::join(missing, ", ")),
                     fmt::format("not given, but {} needs {}; give {}", reason, one ? "it" : "them",
                                 one ? "it" : "all of them"));
}

void MaterialOptions::add_to(Command& app) {
  const Heading under(app, "Material");
  add_values(app, "--young", young, Dimension::pressure,
             "Young's modulus E1[,E2]; with one value the other body is rigid");
  add_values(app, "--poisson", poisson, Dimension::dimensionless, "Poisson's ratio NU1[,NU2]");
  add_quantity(app, "--contact-modulus", contact_modulus, Dimension::pressure,
               "contact modulus E*, instead of --young");
  add_quantity(app, "--tangential-modulus", tangential_modulus, Dimension::pressure,
               "tangential modulus G*, with --contact-modulus");
}

void add_conduction(Command& app, Conduction& bodies) {
  const Heading under(app, "Conductance");
  add_values(app, "--conductivity", bodies.conductivity, Dimension::thermal_conductivity,
             "thermal conductivity K1[,K2], one value for both bodies: adds thermal_conductance "
             "per nominal area");
  add_values(app, "--resistivity", bodies.resistivity, Dimension::resistivity,
             "electrical resistivity R1[,R2], one value for both bodies: adds "
             "electrical_conductance per nominal area");
}

void MaterialOptions::add_body_to(Command& app, const std::string& stiffness) {
  const Heading under(app, "Material");
  app.add_option(
         "--body", body_file,
         "file of a layered, graded or anisotropic body in place of the material; " + stiffness)
      ->file(FileUse::input);
}

std::optional<Body> MaterialOptions::body_of_file() const {
  if (body_file.empty()) return {};
  require(!given(), "--body", body_file,
          "cannot be combined with --young, --poisson, --contact-modulus or --tangential-modulus; "
          "give one of them");
  return read_body(body_file);
}

void MaterialOptions::add_datum_to(Json& answer) const {
  if (const std::optional<Body> body = body_of_file())
    answer["datum"] = std::string(name_of(body->datum()));
}

Body MaterialOptions::body() const {
  if (const std::optional<Body> body = body_of_file()) return *body;
  return material_with_tangential_modulus();
}

std::vector<std::string> MaterialOptions::missing(bool tangential) const {
  std::vector<std::string> options;
  if (!body_file.empty()) return options;
  if (young.empty() && !contact_modulus)
    options.emplace_back("--contact-modulus (or --young with --poisson)");
  if (!young.empty() && poisson.empty()) options.emplace_back("--poisson");
  if (tangential && young.empty() && poisson.empty() && !tangential_modulus)
    options.emplace_back("--poisson (or --tangential-modulus)");
  return options;
}

namespace {

/// Throws InvalidInput if --poisson has more values than there are elastic bodies (`bodies`).
void require_bodies(const std::vector<double>& poisson, std::size_t bodies) {
  require(poisson.size() <= bodies, "--poisson", fmt::format("{}", fmt::join(poisson, ",")),
          fmt::format("has {} values for {} elastic {}. A comma separates two bodies; write a "
                      "decimal point, as in 0.3",
                      poisson.size(), bodies, bodies == 1 ? "body" : "bodies"));
}

}  // namespace

Material MaterialOptions::material() const {
  body_of_file();  // refuses elastic constants beside it
  require(body_file.empty(), "--body", body_file,
          "is for contacts of a surface; give the elastic constants");
  if (!young.empty()) {
    require(!contact_modulus && !tangential_modulus, "--young", fmt::format("{}", young.front()),
            "cannot be combined with --contact-modulus or --tangential-modulus; give one kind");
    require(young.size() <= 2, "--young", young.size(), "values given; it takes E1 or E1,E2");
    require_options(missing(false), "--young");
    require_bodies(poisson, young.size());
    require(poisson.size() == young.size(), "--poisson", poisson.front(),
            "is one value for two bodies; give one for each value of --young");
    return Material::of_bodies({young[0], poisson[0]}, young.size() == 2
                                                           ? ElasticBody{young[1], poisson[1]}
                                                           : ElasticBody{});
  }
  require_options(missing(false), "the material");
  const double modulus = *contact_modulus;
  require(poisson.empty() || !tangential_modulus, "--tangential-modulus",
          tangential_modulus.value_or(0), "cannot be combined with --poisson; give one of them");
  require_bodies(poisson, 1);
  if (tangential_modulus) return Material::of_moduli(modulus, *tangential_modulus);
  if (!poisson.empty()) return Material::of_contact_modulus(modulus, poisson[0]);
  return Material::of_contact_modulus(modulus);
}

Material MaterialOptions::material_with_tangential_modulus() const {
  require_options(missing(true), "the tangential stiffness");
  return material();
}

double MaterialOptions::modulus_ratio() const {
  if (young.empty() && !contact_modulus && !tangential_modulus && poisson.size() == 1) {
    return Material::of_contact_modulus(1, poisson[0]).modulus_ratio();
  }
  return material_with_tangential_modulus().modulus_ratio();
}

double MaterialOptions::modulus_ratio_of(const ForceCurve& curve, const std::string& source) const {
  const std::optional<Body> body = body_of_file();
  const std::string wanted = body ? body->fingerprint() : "";
  require(wanted == curve.body, "--curve", source,
          curve.body.empty()
              ? "has no body, as curves of half-spaces; compute it with contact --body and "
                "--stiffness, or leave out --body"
          : wanted.empty() ? "is of a body that is not a half-space; give it with --body"
                           : "is of another body, or of another datum, than --body");
  return body ? body->modulus_ratio() : modulus_ratio();
}

double MaterialOptions::coupling_constant() const {
  if (young.size() != 2) return salebra::coupling_constant(material());
  return salebra::coupling_constant(ElasticBody{young[0], poisson[0]},
                                    ElasticBody{young[1], poisson[1]});
}

namespace {

std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), seed);
  require(status == std::errc{} && end == text.data() + text.size(), "--seed", text,
          "must be a whole number from 0 to 2^64 - 1");
  return seed;
}

}  // namespace

Option* add_direction(Command& app, std::string& target, const std::string& what) {
  return app.add_option("--direction", target,
                        what +
                            ": across or along the lay of the surface, both, or an angle from "
                            "the x axis, such as 30deg; default both where the surface has a "
                            "lay, else 0deg");
}

Option* add_seed(Command& app, std::uint64_t& target, const std::string& help) {
  return app
      .add_option_function(
          "--seed", [&target](const std::string& text) { target = seed_of(text); }, help)
      ->type_name("INTEGER");
}

void SurfaceOptions::add_to(Command& app, bool needed, const std::string& field) {
  app.add_option(field, file, "file with heights, recognised by its content: " + read_extensions())
      ->required(needed)
      ->file(FileUse::input);
  add_preparation_to(app);
}

void SurfaceOptions::add_several_to(Command& app, const std::string& field) {
  app.add_option(field, names,
                 "files with heights, recognised by their content: " + read_extensions() +
                     ". Several files, a folder or a quoted pattern such as '*.sur' give one "
                     "table; files that fail are listed after it (exit status 1, or 2 if all fail)")
      ->file(FileUse::input);
  add_preparation_to(app);
}

std::vector<std::string> SurfaceOptions::several(bool table, const std::string& field) {
  if (names.empty()) return {};
  if (table || are_several(names)) return files_of(names, field);
  file = names.front();
  return {};
}

void SurfaceOptions::add_preparation_to(Command& app) {
  const Heading under(app, "Surface");
  add_quantity(app, "--size-x", size_x, Dimension::length,
               "length along x, for files that do not state it");
  add_quantity(app, "--size-y", size_y, Dimension::length,
               "length along y, for files that do not state it");
  add_values(app, "--pixel-size", pixel_size, Dimension::length,
             "distance between points, DX or DX,DY, instead of the lengths");
  app.add_option(
         "--lateral-unit", lateral_unit,
         "unit of the positions, such as um, for XYZ points that do not name one; default m")
      ->type_name("UNIT");
  app.add_option("--height-unit", height_unit,
                 "unit of the heights, such as nm, for files that do not name one; default m")
      ->type_name("UNIT");
  app.add_option(
         "--channel", channel,
         "surface to read from a file with several; default: the first whose unit is a length")
      ->type_name("NAME|NUMBER");
  app.add_flag("--transpose", transpose, "exchange x and y of the file before any other step");
  add_quantity(app, "--despike", despike, Dimension::dimensionless,
               "make single points undefined that are this many robust standard deviations away "
               "from their neighbours; 6 if no number is given")
      ->value_without("6");
  add_values(app, "--crop", crop, Dimension::length,
             "X0,Y0,X1,Y1: use only this part; spikes are removed before cropping, undefined "
             "points filled after it");
  app.add_flag("--fill", fill,
               "fill all undefined points with the smoothest surface; without it contacts fill "
               "them only if they are few");
  add_choice<Detrend>(
      app, "--detrend", detrend,
      "trend to remove; default: plane if measured, mean if generated. lines and "
      "median-differences flatten a scan line by line, which changes statistics along y");
  add_quantity(app, "--s-filter", filters.s_filter, Dimension::length,
               "Gaussian S-filter of ISO 16610 after the trend: removes waves shorter than this "
               "cut-off, such as noise");
  add_quantity(app, "--l-filter", filters.l_filter, Dimension::length,
               "Gaussian L-filter of ISO 16610 after the trend: removes waves longer than this "
               "cut-off, the waviness");
}

void SurfaceOptions::add_recipe_to(Command& app) {
  const Heading under(app, "Surface");
  app.add_option("--recipe", recipe,
                 "study file that describes the surface to generate, instead of SURFACE")
      ->file(FileUse::input);
  add_seed(app, seed, "seed of the surface of --recipe; default 1");
}

namespace {

StudyConfiguration recipe_of(const SurfaceOptions& options, const Communicator& communicator) {
  require_that(options.file.empty() && !options.size_x && !options.size_y &&
                   options.height_unit.empty() && options.pixel_size.empty() &&
                   options.lateral_unit.empty() && options.channel.empty() &&
                   options.crop.empty() && !options.despike && !options.fill && !options.transpose,
               "--recipe", "given together with a file or with options of files; give one of them");
  StudyConfiguration study;
  collectively(communicator, [&] { study = read_study_configuration(options.recipe); });
  require(std::holds_alternative<GeneratedSurfaces>(study.surfaces), "--recipe", options.recipe,
          "does not describe generated surfaces; name the file of its surface as SURFACE");
  return study;
}

}  // namespace

MeasuredSurface SurfaceOptions::measured() const {
  if (size_x) require_positive(*size_x, "--size-x");
  if (size_y) require_positive(*size_y, "--size-y");
  MeasuredSurface surface;
  surface.file = file;
  surface.size_x = size_x;
  surface.size_y = size_y;
  surface.detrend = parse_enum<Detrend>(detrend);
  surface.height_unit = height_unit;
  surface.lateral_unit = lateral_unit;
  surface.channel = channel;
  surface.transpose = transpose;
  surface.despike = despike;
  surface.fill = fill;
  surface.filters = filters;
  if (!pixel_size.empty()) {
    require(pixel_size.size() <= 2, "--pixel-size", pixel_size.size(),
            "values given; it takes DX or DX,DY");
    surface.pixel_size = {pixel_size.front(), pixel_size.back()};
  }
  if (!crop.empty()) {
    require(crop.size() == 4, "--crop", crop.size(), "values given; it takes X0,Y0,X1,Y1");
    surface.crop = {crop[0], crop[1], crop[2], crop[3]};
  }
  return surface;
}

Surface SurfaceOptions::read(Session& session, const Communicator& communicator,
                             std::optional<Undefined> points) const {
  if (!recipe.empty()) {
    Surface made =
        study_surface(recipe_of(*this, communicator), seed, session.progress(), communicator);
    session.warn(warnings_of_cells(made.grid));
    session.warn_if(warning_of_heights(made));
    const Detrend trend = parse_enum<Detrend>(detrend).value_or(default_detrend(made));
    return filtered(detrended(std::move(made), trend), filters);
  }
  ReadOptions options = measured().reading();
  if (points) options.undefined = *points;
  options.profiles = profiles;
  std::vector<std::string> warnings;
  options.warnings = &warnings;
  Surface surface = read_surface(file, options, communicator);
  session.warn(warnings);
  session.warn(warnings_of_cells(surface.grid));
  const Detrend method = parse_enum<Detrend>(detrend).value_or(default_detrend(surface));
  return filtered(detrended(std::move(surface), method), filters);
}

std::string_view title_of(GenerationMethod method) {
  return method == GenerationMethod::filtered_noise ? "filtered noise" : "random phase";
}

SurfaceOutline SurfaceOptions::outline(Session& session) const {
  if (!recipe.empty()) {
    const StudyConfiguration study = recipe_of(*this, session.communicator());
    const auto& generated = std::get<GeneratedSurfaces>(study.surfaces);
    return {generated.grid, generated.spectrum_of_all()->moments().rms_slope(),
            fmt::format("{}, seed {}", title_of(generated.method), seed)};
  }
  session.require_one_process("--dry-run of a file");
  const Surface surface = read(session);
  surface.require_complete("a contact calculation");
  return {surface.grid, surface_moments(surface).rms_slope(), file};
}

std::vector<std::string> warnings_of_cells(const Grid2D& grid) {
  const auto [shorter, longer] = std::minmax({grid.dx(), grid.dy()});
  if (longer <= 10 * shorter) return {};
  const double ratio = longer / shorter;
  return {fmt::format(
      "cells of {} x {} have an aspect ratio of {}; check the lengths and the number of points",
      format_quantity(grid.dx(), Dimension::length), format_quantity(grid.dy(), Dimension::length),
      ratio < 100 ? fmt::format("{:.2g}", ratio) : fmt::format("{:.0f}", ratio))};
}

void add_first_loading(Json& answer, const std::optional<FirstLoading>& loading) {
  if (loading) answer["first_loading"] = json_of(*loading);
}

void add_groups(Command& command, int& groups, const std::string& work) {
  command
      .add_option("--groups", groups,
                  "number of groups of salebra-mpi processes, each of which " + work)
      ->range(1, 1 << 20);
}

void DryRunOptions::add_to(Command& command, bool of_processes) {
  const Heading under(command, "Estimate");
  command.add_flag("--dry-run", dry_run,
                   "print what would run, with its memory and time, and run nothing");
  if (!of_processes) return;
  command
      .add_option(
          "--ranks", ranks,
          "with --dry-run: number of salebra-mpi processes; default: those that are running")
      ->range(1, 1 << 20);
  command.add_option("--nodes", nodes, "with --dry-run: number of machines")->range(1, 1 << 20);
}

void OperatingPointsOptions::add_to(Command& app, const std::string& heading) {
  const Heading under(app, heading);
  add_values(app, "--normal-force", force, Dimension::force, "normal force");
  add_values(app, "--indentation", indentation, Dimension::length, "indentation from first touch");
  add_values(app, "--pressure", pressure, Dimension::pressure,
             "nominal pressure on a surface or a curve");
  add_values(
      app, "--mean-gap", mean_gap, Dimension::length,
      "mean gap of a surface or a curve; with summits, the mean gap of the undeformed surfaces");
}

std::vector<OperatingPoints> OperatingPointsOptions::given() const {
  std::vector<OperatingPoints> kinds{{ControlQuantity::normal_force, force},
                                     {ControlQuantity::indentation, indentation},
                                     {ControlQuantity::mean_gap, mean_gap},
                                     {ControlQuantity::pressure, pressure}};
  std::erase_if(kinds, [](const OperatingPoints& kind) { return kind.values.empty(); });
  return kinds;
}

void OperatingPointsOptions::require_one(std::string_view demand) const {
  for (const auto& [quantity, values] : given())
    require(values.size() == 1, "--" + option_word(quantity), values.size(),
            "values given; " + std::string(demand));
}

void BodyOptions::add_to(Command& app, const std::string& largest) {
  add_quantity(app, "--mass", mass, Dimension::mass,
               "mass m of a body on the contact, held or dragged by a spring");
  add_quantity(app, "--spring-stiffness", spring_stiffness, Dimension::stiffness,
               "stiffness k of the spring, without the contact");
  add_quantity(app, "--falling-slope", falling_slope, Dimension::damping,
               "slope b of a friction force that falls with velocity");
  add_quantity(app, "--max-amplitude", max_amplitude, Dimension::length,
               "largest u_z to try in the search for stable sliding; default " + largest);
}

void OperatingPointOptions::add_to(Command& app) {
  const Heading under(app, "Operating point");
  add_quantity(app, "--pressure", pressure, Dimension::pressure, "nominal pressure");
  add_quantity(app, "--mean-gap", mean_gap, Dimension::length, "mean gap of the deformed surfaces");
  add_quantity(app, "--normal-force", force, Dimension::force, "normal force");
  add_quantity(app, "--indentation", indentation, Dimension::length,
               "indentation from first touch");
}

int OperatingPointOptions::count() const {
  return mean_gap.has_value() + pressure.has_value() + indentation.has_value() + force.has_value();
}

std::optional<double> OperatingPointOptions::nominal_pressure(const Grid2D& grid) const {
  if (force) return *force / grid.area();
  return pressure;
}

void FrequencyOptions::add_to(Command& app, const std::string& group, bool one) {
  const Heading under(app, group);
  struct {
    const char* name;
    std::vector<double>& values;
    Dimension dimension;
    const char* help;
  } const both[]{
      {"--frequency", frequency, Dimension::frequency, "frequency of the normal motion, in Hz"},
      {"--angular-frequency", angular_frequency, Dimension::angular_frequency,
       "angular frequency in rad/s, instead of --frequency"}};
  for (const auto& [name, values, dimension, help] : both)
    (one ? add_one(app, name, values, dimension, help)
         : add_values(app, name, values, dimension, help));
}

std::vector<double> FrequencyOptions::angular() const {
  require_that(frequency.empty() || angular_frequency.empty(), "--angular-frequency",
               "given together with --frequency; give one of them");
  for (const double value : frequency) require_positive(value, "--frequency");
  for (const double value : angular_frequency) require_positive(value, "--angular-frequency");
  std::vector<double> omega = angular_frequency;
  for (const double hertz : frequency) omega.push_back(2 * std::numbers::pi * hertz);
  return omega;
}

void MotionOptions::add_to(Command& app, bool with_two_frequencies) {
  const std::string group = "Motion (one quantity may be a range from:to:count or a list)";
  const Heading under(app, group);
  std::vector<std::string> modes = {"drag", "equal-frequency"};
  if (with_two_frequencies) modes.push_back("two-frequencies");
  app.add_option_function(
         "--mode",
         [this](const std::string& name) {
           mode = name;
           mode_given = true;
         },
         fmt::format("kind of motion; drag: slow tangential oscillation; default {}: {}", mode,
                     fmt::join(modes, " | ")))
      ->type_name("NAME")
      ->choices(modes);
  add_values(app, "--normal-amplitude", normal_amplitude, Dimension::length,
             "amplitude u_z of the normal motion");
  add_values(app, "--tangential-amplitude", tangential_amplitude, Dimension::length,
             "amplitude u_x of the tangential motion, not with drag");
  add_values(app, "--phase", phase, Dimension::angle,
             "phase of x at a maximum of z, not with drag");
  add_values(app, "--drag-velocity", drag_velocity, Dimension::velocity,
             "drag: velocity v of the slow tangential motion");
  frequency.add_to(app, group);
  if (with_two_frequencies)
    add_values(app, "--tangential-frequency", tangential_frequency, Dimension::frequency,
               "two-frequencies: frequency of the tangential motion, in Hz");
}

Varied MotionOptions::varied() const {
  Varied found;
  find_varied(*this, found);
  return found;
}

MotionOptions MotionOptions::completed_from(const Oscillation& known) const {
  MotionOptions all = *this;
  const auto fill = [](std::vector<double>& values, double value) {
    if (values.empty()) values = {value};
  };
  const auto fill_both = [&](const auto& motion) {
    fill(all.normal_amplitude, motion.normal_amplitude);
    if (!frequency.given() && motion.angular_frequency > 0)
      all.frequency.angular_frequency = {motion.angular_frequency};
  };
  if (const auto* drag = std::get_if<Drag>(&known)) {
    fill_both(*drag);
    if (mode == "drag") fill(all.drag_velocity, drag->drag_velocity);
  } else {
    const auto& equal = std::get<EqualFrequency>(known);
    fill_both(equal);
    if (!mode_given && drag_velocity.empty()) all.mode = "equal-frequency";
    if (all.mode != "drag") {
      fill(all.tangential_amplitude, equal.tangential_amplitude);
      fill(all.phase, equal.phase);
    }
  }
  return all;
}

std::vector<std::string> MotionOptions::missing() const {
  const bool drag = mode == "drag", two = mode == "two-frequencies";
  std::vector<std::string> options;
  const auto need = [&](bool wanted, bool given, const char* option) {
    if (wanted && !given) options.emplace_back(option);
  };
  need(true, !normal_amplitude.empty(), "--normal-amplitude");
  need(!drag, !tangential_amplitude.empty(), "--tangential-amplitude");
  need(!drag, !phase.empty(), "--phase");
  need(drag, !drag_velocity.empty(), "--drag-velocity");
  need(two, !tangential_frequency.empty(), "--tangential-frequency");
  need(drag || two, frequency.given(), "--frequency (or --angular-frequency)");
  return options;
}

std::vector<Motion> MotionOptions::all_motions() const {
  const bool drag = mode == "drag", two = mode == "two-frequencies";
  require_options(missing(), "--mode " + mode);
  const auto check = [&](const std::vector<double>& values, std::string_view option, bool wanted) {
    require_that(values.empty() || wanted, option,
                 "given, but --mode " + mode + " has none; leave it out");
  };
  check(tangential_amplitude, "--tangential-amplitude", !drag);
  check(phase, "--phase", !drag);
  check(drag_velocity, "--drag-velocity", drag);
  check(tangential_frequency, "--tangential-frequency", two);

  std::vector<double> omega = frequency.angular();
  // The loss per cycle at equal frequencies does not depend on the frequency, so ω = 0 stands for
  // an unknown frequency.
  if (omega.empty()) omega = {0};
  for (const double value : tangential_frequency) require_positive(value, "--tangential-frequency");
  const std::size_t count = std::max<std::size_t>(1, varied().second.size());
  const auto at = [](const std::vector<double>& values, std::size_t i) {
    return values.size() == 1 ? values.front() : values.at(i);
  };
  std::vector<Motion> all;
  for (std::size_t i = 0; i < count; ++i) {
    if (drag) {
      all.emplace_back(Drag{.normal_amplitude = at(normal_amplitude, i),
                            .drag_velocity = at(drag_velocity, i),
                            .angular_frequency = at(omega, i)});
    } else if (two) {
      all.emplace_back(TwoFrequencies{
          .normal_amplitude = at(normal_amplitude, i),
          .tangential_amplitude = at(tangential_amplitude, i),
          .phase = at(phase, i),
          .normal_angular_frequency = at(omega, i),
          .tangential_angular_frequency = 2 * std::numbers::pi * at(tangential_frequency, i)});
    } else {
      all.emplace_back(EqualFrequency{.normal_amplitude = at(normal_amplitude, i),
                                      .tangential_amplitude = at(tangential_amplitude, i),
                                      .phase = at(phase, i),
                                      .angular_frequency = at(omega, i)});
    }
  }
  return all;
}

std::vector<Oscillation> MotionOptions::motions() const {
  std::vector<Oscillation> all;
  for (const Motion& motion : all_motions()) {
    if (const auto* drag = std::get_if<Drag>(&motion))
      all.emplace_back(*drag);
    else
      all.emplace_back(std::get<EqualFrequency>(motion));
  }
  return all;
}

}  // namespace salebra::cli
