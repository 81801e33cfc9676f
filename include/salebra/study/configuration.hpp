// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/contact/normal/conductance.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/twin.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace salebra {

struct ModelResult;
namespace detail {
struct ModelWork;
}

/// The contact models of a study, in the order of contact_models().
enum class ContactModel {
  bem,
  gw_moments,
  gw_deterministic,
  gw_monte_carlo,
  gw_interacting,
  persson,
  greenwood_tripp,
  gw_dmt,
  gw_jkr
};

/// A contact model with its name in files, JSON and study files (that of the enumerator), its title
/// for people, its cost per cell and pressure, s, on the machine of estimate_cost(), and the
/// function that presses a surface with it. A new model is an enumerator and an entry in
/// src/study/contact_models.cpp.
struct StudyModel {
  ContactModel id;
  const char* name;
  const char* title;
  double seconds_per_cell;
  ModelResult (*press)(detail::ModelWork&);
};

/// Returns all contact models.
std::span<const StudyModel> contact_models();

/// Finds a model by its name. Throws InvalidInput "models: …" for an unknown name.
ContactModel contact_model(std::string_view name);
std::string_view name_of(ContactModel model);
/// Returns all models without adhesion.
std::vector<ContactModel> all_contact_models();
/// Whether the summits of a model adhere.
constexpr bool is_adhesive(ContactModel model) { return model >= ContactModel::gw_dmt; }
/// Returns the named models, each once, and the boundary elements, which are the reference for the
/// others.
std::vector<ContactModel> contact_models(const std::vector<std::string>& names);

enum class GenerationMethod { filtered_noise, random_phase };

/// An ensemble of random surfaces, one for each seed.
struct GeneratedSurfaces {
  Grid2D grid;
  SelfAffineParameters spectrum;  ///< ignored where there are tables
  GenerationMethod method = GenerationMethod::filtered_noise;
  std::vector<std::uint64_t> seeds;  ///< at least one
  /// Replace the self-affine spectrum. A single table holds for all surfaces. With several, the
  /// first defines the scale of the loads; the others are equally likely draws of a surface twin,
  /// assigned to the surfaces by their seeds, the same to two consecutive ones. Pairs with one
  /// spectrum separate what the scans leave open from the variation from place to place.
  std::vector<SpectrumTable> tables = {};

  /// Returns the spectrum of the first table, or the self-affine one.
  std::unique_ptr<const IsotropicSpectrum> spectrum_of_all() const;
  std::unique_ptr<const IsotropicSpectrum> spectrum_of(std::uint64_t seed) const;
  /// Index of the table of a seed; 0 where all have the same.
  std::size_t table_of(std::uint64_t seed) const;
};

constexpr void describe(auto&& visit, std::type_identity<GeneratedSurfaces>) {
  using S = GeneratedSurfaces;
  keep(visit, &S::grid, &S::spectrum, &S::method, &S::seeds, &S::tables);
}

/// One surface from a file.
struct MeasuredSurface {
  std::filesystem::path file;
  std::optional<double> size_x = {}, size_y = {};  ///< m, for files that do not state their size
  std::optional<Detrend> detrend = {};             ///< empty: default_detrend() of the surface
  std::string height_unit = {};  ///< such as "nm", for files that do not name one; empty: m
  // As in ReadOptions; a few undefined points are filled even without `fill`.
  bool transpose = false;
  std::optional<std::pair<double, double>> pixel_size = {};
  std::string lateral_unit = {};
  std::optional<double> despike = {};
  std::optional<Rectangle> crop = {};
  bool fill = false;
  std::string channel = {};

  /// Returns the options for read_surface().
  ReadOptions reading() const;
};

constexpr void describe(auto&& visit, std::type_identity<MeasuredSurface>) {
  using S = MeasuredSurface;
  keep(visit, &S::file, &S::size_x, &S::size_y, &S::detrend, &S::height_unit, &S::transpose,
       &S::pixel_size, &S::lateral_unit, &S::despike, &S::crop, &S::fill, &S::channel);
}

/// Parameters to vary; an empty list keeps the value of the surface table.
struct ParameterLists {
  std::vector<double> hurst;
  std::vector<double> rolloff, short_cutoff;  ///< wavelengths, m
  std::vector<double> size_x;  ///< m; the cell size is kept, so the number of points follows
  std::vector<Index> points;   ///< along x; the size of the surface is kept, so the cells follow

  bool empty() const {
    return hurst.empty() && rolloff.empty() && short_cutoff.empty() && size_x.empty() &&
           points.empty();
  }
};

constexpr void describe(auto&& visit, std::type_identity<ParameterLists>) {
  using S = ParameterLists;
  keep(visit, &S::hurst, &S::rolloff, &S::short_cutoff, &S::size_x, &S::points);
}

/// Adhesion of the contacts of a study, and the loading cycle of each surface.
struct AdhesionPlan {
  Adhesion adhesion;
  std::vector<double> cycle = {};  ///< mean gaps, m, from the widest; empty: no cycle
  bool force_coarse = false;       ///< see AdhesiveContactOptions
};

constexpr void describe(auto&& visit, std::type_identity<AdhesionPlan>) {
  using S = AdhesionPlan;
  keep(visit, &S::adhesion, &S::cycle, &S::force_coarse);
}

/// Everything that determines the result of a study.
struct StudyConfiguration {
  std::variant<GeneratedSurfaces, MeasuredSurface> surfaces;
  Material material;  ///< including G*
  std::vector<double>
      pressures;  ///< of the BEM sweep, increasing: Pa, or in units of E*h'_rms if relative
  bool relative_pressures = false;
  /// Leaves out pressures above half of the hardness, where half of the surface would be flat,
  /// instead of refusing them. For pressures that the user did not choose.
  bool pressures_below_hardness = false;
  double tolerance = 1e-8;  ///< error e_c of each contact
  /// Computes K_t of the boundary-element curve by a stick solve on each contact; false:
  /// K_t = (G*/E*)K. Only the latter is possible for moduli that no elastic body has.
  bool stick = true;
  std::optional<PressureWindow>
      window;                   ///< for the exponential fit; empty: 1 … 2.5 h_rms in mean gap
  ParameterLists ensemble;      ///< for generated surfaces only
  double target_precision = 0;  ///< relative precision at which an ensemble ends; 0: use all seeds
  int min_realisations = 8;     ///< >= 2, before the precision is checked
  /// Must contain the boundary elements, which are the reference for the others.
  std::vector<ContactModel> models = {ContactModel::bem, ContactModel::gw_moments,
                                      ContactModel::gw_deterministic};
  /// The models of `salebra compare`.
  std::vector<ContactModel> compared_models = all_contact_models();

  bool has(ContactModel model) const;
  /// Whether surfaces are drawn from a surface twin.
  bool of_twin() const;
  /// For the conductance of the contacts; does not affect what is computed for a surface.
  Conduction conduction = {};
  bool flow_factors = false;  ///< computes them for each contact of the boundary elements
  /// Makes the boundary elements adhere, each load following from the one below, and the summits of
  /// gw_dmt and gw_jkr. Such a study has no damping: the motion is ignored.
  std::optional<AdhesionPlan> adhesion = {};
  Oscillation motion;
  DampingOptions damping;
  /// Friction, hardness, density and excursion, for the assumptions of the damping. With a hardness
  /// each surface is first loaded to the largest pressure (after_first_loading()), and the study is
  /// that of the residual surface.
  ContactParameters known;
  /// Intervals between the contacts inside the oscillation, SurfaceDampingOptions::levels; empty:
  /// 4, doubled for a single surface where they do not suffice. With 0 the loss of the boundary
  /// elements, as that of every other model, is computed from their curve between loads, without an
  /// error.
  std::optional<int> intervals = {};
  double relative_error =
      0;  ///< target for each damping constant, reached by halving the cells; 0: none
  std::optional<SeamCheck> seam = {};  ///< adds the error of continuing a scan periodically
  std::string text;                    ///< text of the file, for provenance
};

constexpr void describe(auto&& visit, std::type_identity<StudyConfiguration>) {
  using S = StudyConfiguration;
  keep(visit, &S::surfaces);
  visit(&S::material, Kept{"material", "elastic constants of the bodies"});
  keep(visit, &S::pressures, &S::relative_pressures, &S::pressures_below_hardness);
  visit(&S::tolerance, Kept{"tolerance", "of each contact"});
  keep(visit, &S::stick, &S::window, &S::ensemble, &S::target_precision, &S::min_realisations);
  visit(&S::models, Kept{"models", "names of the contact models that are run on each surface"});
  visit(
      &S::compared_models,
      Kept{"compared_models",
           "those that the program's command `compare` runs: all, unless the study file chooses"});
  keep(visit, &S::conduction, &S::flow_factors, &S::adhesion, &S::motion, &S::damping, &S::known,
       &S::intervals, &S::relative_error, &S::seam);
  visit(&S::text, Kept{"text", "the file as it was read"});
}

/// Sentence on why a study with adhesion has no damping, to follow the name of the input.
extern const char* const no_damping_with_adhesion;

/// Reads a study from a TOML file; the README of data/ explains each key by example. Quantities are
/// numbers in SI units or strings with a unit.
///
///     StudyConfiguration study = read_study_configuration("study.toml");
///
/// throws  InvalidInput "FILE:LINE: table.key: …" for an unknown key, a missing one, a wrong type
///         or a value out of range
StudyConfiguration read_study_configuration(const std::filesystem::path& file);

/// Reads a study from text. `name` replaces the file in error messages; relative paths start from
/// `folder`.
StudyConfiguration parse_study_configuration(const std::string& text, const std::string& name,
                                             const std::filesystem::path& folder = ".");

/// Returns the configurations of all combinations of the ensemble's lists, with the last parameter
/// (points) changing fastest and their own lists empty; without lists the configuration itself.
/// Throws InvalidInput for a combination that no grid can represent and, before it makes any, for
/// more than 10 000 combinations or 256 MB of settings.
std::vector<StudyConfiguration> parameter_combinations(const StudyConfiguration& configuration);

/// Formats the varied parameters of a point, "H = 0.5, roll-off 1.25 µm, …"; empty without lists.
std::string describe_point(const ParameterLists& varied, const StudyConfiguration& point);

/// Returns the configuration with its surfaces replaced by a measured one.
StudyConfiguration with_surface(StudyConfiguration configuration, MeasuredSurface surface);

}  // namespace salebra
