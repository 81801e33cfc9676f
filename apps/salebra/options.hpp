// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/units.hpp>
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

/// Option groups that several commands share. Each is a plain struct that must outlive the parsing;
/// add_to() declares the options, the other functions turn what was given into the library's types
/// and throw InvalidInput that names the option.
namespace salebra::cli {

/// --name QUANTITY, with a unit.
Option* add_quantity(Command& app, const std::string& name, std::optional<double>& target,
                     Dimension dimension, const std::string& help);
/// --name VALUES: one quantity, a list or a range.
Option* add_values(Command& app, const std::string& name, std::vector<double>& target,
                   Dimension dimension, const std::string& help);
/// --name NAME out of a few; the target's present value is the default.
Option* add_choice(Command& app, const std::string& name, std::string& target,
                   const std::vector<std::string>& choices, const std::string& help);
/// The word of a value, as options have it.
template <class Enum>
std::string option_word(Enum value) {
  std::string word(name_of(value));
  std::ranges::replace(word, '_', '-');
  return word;
}
/// The choices are the words of an enumeration.
template <class Enum>
Option* add_choice(Command& app, const std::string& name, std::string& target,
                   const std::string& help) {
  std::vector<std::string> words;
  for (const auto& [value, word] : EnumNames<Enum>::values) words.push_back(option_word(value));
  return add_choice(app, name, target, words, help);
}

/// --steps of a cycle.
template <class Target>
Option* add_steps(Command& app, Target& target, const std::string& help) {
  return app.add_option("--steps", target, help);
}

/// --seed, any whole number.
Option* add_seed(Command& app, std::uint64_t& target, const std::string& help);

/// The value of an option that the other options make necessary.
double required(const std::optional<double>& value, std::string_view option,
                std::string_view reason);

/// Throws InvalidInput that names all missing options at once, if there is any; reason: "the
/// material".
void require_options(const std::vector<std::string>& missing, const std::string& reason);

/// The two bodies.
struct MaterialOptions {
  std::vector<double> young, poisson;
  std::optional<double> contact_modulus, tangential_modulus;

  void add_to(Command& app);
  bool given() const {
    return !young.empty() || !poisson.empty() || contact_modulus || tangential_modulus;
  }
  /// The options that material(), or material_with_tangential_modulus(), lacks.
  std::vector<std::string> missing(bool tangential) const;
  /// E*, and G* where it is known.
  Material material() const;
  /// E* and G*; an error where G* was not given one way or another.
  Material material_with_tangential_modulus() const;
  /// G*/E*; --poisson alone is enough, for one elastic body.
  double modulus_ratio() const;
  /// β/(πE*), 1/Pa, of the two bodies of --young, else of the material.
  double coupling_constant() const;
};

/// --conductivity and --resistivity.
void add_conduction(Command& app, Conduction& bodies);

/// "filtered noise" or "random phase".
std::string_view title_of(GenerationMethod method);

/// What a surface is, before it is there.
struct SurfaceOutline {
  Grid2D grid;
  double rms_slope = 0;
  std::string origin;  ///< "filtered noise, seed 3"
};

/// SURFACE with its size and detrending.
struct SurfaceOptions {
  std::string file;
  std::optional<double> size_x, size_y;
  std::string detrend, height_unit, lateral_unit, channel;
  std::vector<double> pixel_size, crop;
  std::optional<double> despike;
  bool fill = false, transpose = false;
  bool profiles = false;  ///< the command takes line profiles too
  std::string recipe;
  std::uint64_t seed = 1;

  /// field: "SURFACE", or "--surface" to make it an option.
  void add_to(Command& app, bool needed = true, const std::string& field = "SURFACE");
  /// --recipe and --seed, in place of SURFACE.
  void add_recipe_to(Command& app);
  bool given() const { return !file.empty() || !recipe.empty(); }
  /// Read or made, over the processes of the session, and, with --detrend or else as is customary
  /// for its kind, detrended. points: by default filled where they are few, as contacts
  /// need it, and all with --fill. Warns of cells, sizes and heights that are most likely a mistake.
  Surface read(Session& session, std::optional<Undefined> points = {}) const {
    return read(session, session.communicator(), points);
  }
  /// Does so over one group of the processes.
  Surface read(Session& session, const Communicator& communicator,
               std::optional<Undefined> points = {}) const;
  /// Returns the surface of a file. Throws InvalidInput for lists of another length.
  MeasuredSurface measured() const;
  /// Reads a file; a recipe is not generated.
  SurfaceOutline outline(Session& session) const;
};

/// Cells ten times as long as wide, which are allowed and most likely a mistake.
std::vector<std::string> warnings_of_cells(const Grid2D& grid);

/// Adds its columns under "first_loading", where there was one.
void add_first_loading(Json& answer, const std::optional<FirstLoading>& loading);

/// --groups of processes; 0: not given. `work` says what each of them does.
void add_groups(Command& command, int& groups, const std::string& work);

/// --dry-run, and the processes that it is for.
struct DryRunOptions {
  bool dry_run = false;
  int ranks = 0, nodes = 0;  ///< 0: those that run

  /// of_processes: several may share the work.
  void add_to(Command& command, bool of_processes = true);
};

/// Operating points of contacts: one control quantity is given, with one value or several.
struct OperatingPointsOptions {
  std::vector<double> force, indentation, mean_gap, pressure;

  void add_to(Command& app, const std::string& heading);
  /// The kinds that were given.
  std::vector<OperatingPoints> given() const;
  /// Throws InvalidInput where several values are given, "--pressure: 3 values given; sliding
  /// takes one", before any contact is computed.
  void require_one(std::string_view demand) const;
};

constexpr void describe(auto&& visit, std::type_identity<OperatingPointsOptions>) {
  using S = OperatingPointsOptions;
  visit(&S::force, quantity::force);
  visit(&S::indentation, quantity::indentation);
  visit(&S::pressure, Quantity{"pressure", Dimension::pressure, "nominal pressure"});
  visit(&S::mean_gap, Quantity{"mean_gap", Dimension::length, "mean gap"});
}

/// Where a contact stands. At most one is given.
struct OperatingPointOptions {
  std::optional<double> mean_gap, pressure, indentation, force;

  void add_to(Command& app);
  /// Number of control quantities given.
  int count() const;
  /// Pa, where it or the force was given.
  std::optional<double> nominal_pressure(const Grid2D& grid) const;
};

/// A body on the contact, and what makes its steady sliding unstable.
struct BodyOptions {
  std::optional<double> mass, spring_stiffness, falling_slope, max_amplitude;

  /// largest: the default of the last one.
  void add_to(Command& app, const std::string& largest);
  bool given() const { return mass || spring_stiffness || falling_slope || max_amplitude; }
};

/// --frequency or --angular-frequency of the normal motion.
struct FrequencyOptions {
  std::vector<double> frequency, angular_frequency;

  /// one: no list or range.
  void add_to(Command& app, const std::string& group, bool one = false);
  bool given() const { return count() > 0; }
  std::size_t count() const { return frequency.size() + angular_frequency.size(); }
  /// ω, rad/s, of each; empty: none was given. Throws InvalidInput where both were, and for values
  /// that are not > 0.
  std::vector<double> angular() const;
};

constexpr void describe(auto&& visit, std::type_identity<FrequencyOptions>) {
  using S = FrequencyOptions;
  visit(&S::frequency, Quantity{"frequency", Dimension::frequency, "frequency"});
  visit(&S::angular_frequency, quantity::angular_frequency);
}

/// Name and values of the quantity with several values; empty if there is none.
using Varied = std::pair<std::string, std::vector<double>>;
/// Looks among described lists. Throws InvalidInput for a second one.
template <Described Lists>
void find_varied(const Lists& lists, Varied& found) {
  for_each_column<Lists>([&](const auto& list, const Quantity& quantity) {
    const std::vector<double>& values = list(lists);
    if (values.size() < 2) return;
    require(found.second.empty(), quantity.name, std::to_string(values.size()) + " values",
            "are a second range; only one quantity may be a range");
    found = {std::string(quantity.name), values};
  });
}

/// What moves; any one quantity may be a range.
struct MotionOptions {
  std::string mode = "drag";
  bool mode_given = false;
  std::vector<double> normal_amplitude, tangential_amplitude, phase, tangential_frequency,
      drag_velocity;
  FrequencyOptions frequency;

  /// with_two_frequencies: offers --mode two-frequencies; then use all_motions().
  void add_to(Command& app, bool with_two_frequencies = false);
  /// Whether any of them was.
  bool given() const {
    return mode_given || !normal_amplitude.empty() || !tangential_amplitude.empty() ||
           !phase.empty() || frequency.given() || !tangential_frequency.empty() ||
           !drag_velocity.empty();
  }
  /// Takes what was not given from a known motion, as far as the mode has it.
  MotionOptions completed_from(const Oscillation& known) const;
  /// The options that the mode lacks.
  std::vector<std::string> missing() const;
  /// Motions of all combinations, which is one line of them: throws InvalidInput if two quantities
  /// have several values.
  std::vector<Oscillation> motions() const;
  /// The motions, --mode two-frequencies among them.
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
