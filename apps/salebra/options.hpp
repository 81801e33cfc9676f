// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/surface/detrend.hpp>
#include <string>
#include <variant>
#include <vector>

#include "command.hpp"
#include "session.hpp"

namespace salebra {
struct Conduction;
struct FirstLoading;
struct OperatingPoints;
}  // namespace salebra

/// Options that several commands share, in groups. Each group is a plain struct that must outlive
/// the parsing of the command line. add_to() declares its options. Its other functions convert
/// their values to types of the library, and throw InvalidInput that names the option.
namespace salebra::cli {

/// Adds an option "--name QUANTITY" whose value is a number with an optional unit.
Option* add_quantity(Command& app, const std::string& name, std::optional<double>& target,
                     Dimension dimension, const std::string& help);
/// Adds an option "--name VALUES" whose value is one quantity, a list of quantities or a range.
Option* add_values(Command& app, const std::string& name, std::vector<double>& target,
                   Dimension dimension, const std::string& help);
/// Adds an option whose value is one of the choices. The present value of `target` is the default.
Option* add_choice(Command& app, const std::string& name, std::string& target,
                   const std::vector<std::string>& choices, const std::string& help);
/// The name of a value of an enumeration as options write it, with "-" for "_".
template <class Enum>
std::string option_word(Enum value) {
  std::string word(name_of(value));
  std::ranges::replace(word, '_', '-');
  return word;
}
/// Adds an option whose value is a name of the enumeration Enum.
template <class Enum>
Option* add_choice(Command& app, const std::string& name, std::string& target,
                   const std::string& help) {
  std::vector<std::string> words;
  for (const auto& [value, word] : EnumNames<Enum>::values) words.push_back(option_word(value));
  return add_choice(app, name, target, words, help);
}

/// Adds --direction, whose value direction_choice() reads. what: what has this direction.
Option* add_direction(Command& app, std::string& target, const std::string& what);

/// Adds --steps, the number of steps of a cycle.
template <class Target>
Option* add_steps(Command& app, Target& target, const std::string& help) {
  return app.add_option("--steps", target, help);
}

/// Adds --seed, whose value is any whole number.
Option* add_seed(Command& app, std::uint64_t& target, const std::string& help);

/// The value of an option that other options need; throws InvalidInput if it was not given. reason:
/// why it is needed.
double required(const std::optional<double>& value, std::string_view option,
                std::string_view reason);

/// Throws InvalidInput that names all options in `missing`, if there are any. reason: what needs
/// them, such as "the material".
void require_options(const std::vector<std::string>& missing, const std::string& reason);

/// Options for the elastic constants of the two bodies.
struct MaterialOptions {
  std::vector<double> young, poisson;
  std::optional<double> contact_modulus, tangential_modulus;
  std::string body_file;  ///< --body, in place of all of these

  void add_to(Command& app);
  /// Adds --body. stiffness: what the help says of the tangential stiffness.
  void add_body_to(Command& app, const std::string& stiffness);
  /// The body of --body, if it was given. Throws InvalidInput if elastic constants are given too.
  std::optional<Body> body_of_file() const;
  /// Adds the datum of the body of --body, if it was given, to an answer.
  void add_datum_to(Json& answer) const;
  /// The body of --body or, without it, material_with_tangential_modulus().
  Body body() const;
  /// Whether elastic constants are given.
  bool given() const {
    return !young.empty() || !poisson.empty() || contact_modulus || tangential_modulus;
  }
  /// The options that were not given and that material() needs or (tangential true)
  /// material_with_tangential_modulus() needs.
  std::vector<std::string> missing(bool tangential) const;
  /// The material with E* and, if it is known, G*. Throws InvalidInput for --body.
  Material material() const;
  /// The material with E* and G*; throws InvalidInput if G* is not known.
  Material material_with_tangential_modulus() const;
  /// G*/E*. If one body is rigid, --poisson of the elastic body is enough.
  double modulus_ratio() const;
  /// The same for a curve, which has K_t of its own if its body is not a half-space: then NaN. Throws
  /// InvalidInput unless the curve is that of this material or body. source: its file.
  double modulus_ratio_of(const ForceCurve& curve, const std::string& source) const;
  /// The coupling constant β/(πE*), 1/Pa, with Dundurs' constant β; from the two bodies of --young
  /// or, if they are not given, from the material.
  double coupling_constant() const;
};

/// Adds --conductivity and --resistivity of the bodies.
void add_conduction(Command& app, Conduction& bodies);

/// The method of generation in words: "filtered noise" or "random phase".
std::string_view title_of(GenerationMethod method);

/// Properties of a surface that are known before it is made.
struct SurfaceOutline {
  Grid2D grid;
  double rms_slope = 0;
  std::string origin;  ///< how it will be made, such as "filtered noise, seed 3"
};

/// Options for the file of a surface (SURFACE), its size and its detrending.
struct SurfaceOptions {
  std::string file;
  std::vector<std::string> names;  ///< of commands that take several surfaces
  std::optional<double> size_x, size_y;
  std::string detrend, height_unit, lateral_unit, channel;
  std::vector<double> pixel_size, crop;
  std::optional<double> despike;
  bool fill = false, transpose = false;
  GaussianFilters filters;
  bool profiles = false;  ///< whether the command also accepts line profiles
  std::string recipe;
  std::uint64_t seed = 1;

  /// needed: whether a surface must be given. field: how help and messages call it, "SURFACE" for
  /// an argument, "--surface" for an option.
  void add_to(Command& app, bool needed = true, const std::string& field = "SURFACE");
  /// Does the same with an argument that takes several files, folders and patterns.
  void add_several_to(Command& app, const std::string& field = "SURFACE");
  /// The files of `names` if they mean several surfaces; otherwise sets `file` to the one name and
  /// returns nothing. table: whether a table was requested even of one surface.
  std::vector<std::string> several(bool table, const std::string& field = "SURFACE");
  /// Adds --recipe and --seed, which generate a surface in place of SURFACE.
  void add_recipe_to(Command& app);
  bool given() const { return !file.empty() || !recipe.empty(); }
  /// Reads or generates the surface, spread over the processes of the session, detrends it by
  /// --detrend or the default for its kind, and applies the filters. points: what to do with undefined points; by default
  /// they are filled if they are few, or all of them with --fill, because contacts need every
  /// point. Warns of cells, sizes and heights that are valid but suspicious.
  Surface read(Session& session, std::optional<Undefined> points = {}) const {
    return read(session, session.communicator(), points);
  }
  /// Does the same with the surface spread over one group of processes, `communicator`.
  Surface read(Session& session, const Communicator& communicator,
               std::optional<Undefined> points = {}) const;
  /// The surface in the form of a study configuration. Throws InvalidInput for lists of the wrong
  /// length.
  MeasuredSurface measured() const;
  /// Size, points and origin of the surface. Reads a file, but does not generate the surface of a
  /// recipe.
  SurfaceOutline outline(Session& session) const;

 private:
  void add_preparation_to(Command& app);
};

/// Warns of cells more than ten times as long as wide, which are valid but probably a mistake.
std::vector<std::string> warnings_of_cells(const Grid2D& grid);

/// Adds the first loading to the answer under the key "first_loading", if there was one.
void add_first_loading(Json& answer, const std::optional<FirstLoading>& loading);

/// Adds --groups, the number of groups of processes; 0: not given. `work` completes the help text
/// "each of which …".
void add_groups(Command& command, int& groups, const std::string& work);

/// Options --dry-run, and the number of processes and machines for which to estimate the cost.
struct DryRunOptions {
  bool dry_run = false;
  int ranks = 0, nodes = 0;  ///< 0: the number of running processes

  /// of_processes: whether to add the options for the number of processes.
  void add_to(Command& command, bool of_processes = true);
};

/// Options for operating points: one control quantity with one value or several.
struct OperatingPointsOptions {
  std::vector<double> force, indentation, mean_gap, pressure;

  void add_to(Command& app, const std::string& heading);
  /// The control quantities that were given, each with its values.
  std::vector<OperatingPoints> given() const;
  /// Throws InvalidInput if several values were given, before any contact is computed: "--pressure:
  /// 3 values given; sliding takes one". demand: the last part of the message.
  void require_one(std::string_view demand) const;
};

constexpr void describe(auto&& visit, std::type_identity<OperatingPointsOptions>) {
  using S = OperatingPointsOptions;
  visit(&S::force, quantity::force);
  visit(&S::indentation, quantity::indentation);
  visit(&S::pressure, Quantity{"pressure", Dimension::pressure, "nominal pressure"});
  visit(&S::mean_gap, Quantity{"mean_gap", Dimension::length, "mean gap"});
}

/// Options for one operating point. At most one of them may be given.
struct OperatingPointOptions {
  std::optional<double> mean_gap, pressure, indentation, force;

  void add_to(Command& app);
  /// Number of options given.
  int count() const;
  /// Nominal pressure from the pressure or the force, Pa; empty if neither was given.
  std::optional<double> nominal_pressure(const Grid2D& grid) const;
};

/// Options for a body that rests on the contact, and for the falling slope of friction that makes
/// its sliding unstable.
struct BodyOptions {
  std::optional<double> mass, spring_stiffness, falling_slope, max_amplitude;

  /// largest: text that describes the default of --max-amplitude.
  void add_to(Command& app, const std::string& largest);
  bool given() const { return mass || spring_stiffness || falling_slope || max_amplitude; }
};

/// Option --frequency or --angular-frequency of the normal motion.
struct FrequencyOptions {
  std::vector<double> frequency, angular_frequency;

  /// one: whether the options take a single value instead of a list or range.
  void add_to(Command& app, const std::string& group, bool one = false);
  bool given() const { return count() > 0; }
  std::size_t count() const { return frequency.size() + angular_frequency.size(); }
  /// Angular frequency ω for each value that was given, rad/s; empty if no frequency was given.
  /// Throws InvalidInput if both options were given, and for values that are not > 0.
  std::vector<double> angular() const;
};

constexpr void describe(auto&& visit, std::type_identity<FrequencyOptions>) {
  using S = FrequencyOptions;
  visit(&S::frequency, Quantity{"frequency", Dimension::frequency, "frequency"});
  visit(&S::angular_frequency, quantity::angular_frequency);
}

/// Name and values of the one quantity that has several values; empty if there is none.
using Varied = std::pair<std::string, std::vector<double>>;
/// Searches the described lists for the one with several values. Throws InvalidInput if a second
/// list has several values.
template <Described Lists>
void find_varied(const Lists& lists, Varied& found) {
  for_each_column<Lists>([&](const auto& list, const Quantity& quantity) {
    const std::vector<double>& values = list(lists);
    if (values.size() < 2) return;
    require(found.second.empty(), quantity.name, std::to_string(values.size()) + " values",
            "given, but `" + found.first + "` has several values too; only one quantity may");
    found = {std::string(quantity.name), values};
  });
}

/// Options of the motion. One of its quantities may be a range or list.
struct MotionOptions {
  std::string mode = "drag";
  bool mode_given = false;
  std::vector<double> normal_amplitude, tangential_amplitude, phase, tangential_frequency,
      drag_velocity;
  FrequencyOptions frequency;

  /// with_two_frequencies: whether to offer --mode two-frequencies too; the motions then come from
  /// all_motions().
  void add_to(Command& app, bool with_two_frequencies = false);
  /// Whether any option of the motion was given.
  bool given() const {
    return mode_given || !normal_amplitude.empty() || !tangential_amplitude.empty() ||
           !phase.empty() || frequency.given() || !tangential_frequency.empty() ||
           !drag_velocity.empty();
  }
  /// A copy in which options that were not given have the values of a known motion, as far as the
  /// mode uses them.
  MotionOptions completed_from(const Oscillation& known) const;
  /// The options that the mode needs and that were not given.
  std::vector<std::string> missing() const;
  /// One motion for each value of the quantity that is a range or list. Throws InvalidInput if two
  /// quantities have several values.
  std::vector<Oscillation> motions() const;
  /// The same motions, for all modes including two-frequencies.
  std::vector<Motion> all_motions() const;
  Varied varied() const;
};

constexpr void describe(auto&& visit, std::type_identity<MotionOptions>) {
  using S = MotionOptions;
  visit(&S::normal_amplitude, quantity::normal_amplitude);
  visit(&S::tangential_amplitude, quantity::tangential_amplitude);
  visit(&S::phase, quantity::phase);
  visit(&S::drag_velocity, quantity::drag_velocity);
  visit(&S::tangential_frequency, Quantity{"tangential_frequency", Dimension::frequency,
                                           "frequency of the tangential motion"});
  visit(&S::frequency, Part{"", "of the normal motion"});
}

}  // namespace salebra::cli
