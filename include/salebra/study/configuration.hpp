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
#include <salebra/damping/premises.hpp>
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

/// A contact model: the name that files, JSON and study files have for it, that of the enumerator;
/// what people call it; what it costs for each cell and pressure, s, on the machine of
/// estimate_cost(); and the function that presses a surface with it. A new model is an enumerator
/// and an entry in src/study/contact_models.cpp.
struct StudyModel {
  ContactModel id;
  const char* name;
  const char* title;
  double seconds_per_cell;
  ModelResult (*press)(detail::ModelWork&);
};

/// All of them.
std::span<const StudyModel> contact_models();

/// Finds a model by its name. Throws InvalidInput "models: …" for another.
ContactModel contact_model(std::string_view name);
std::string_view word_of(ContactModel model);
/// Without those of adhesion.
std::vector<ContactModel> all_contact_models();
/// Whether a model is of summits that adhere.
constexpr bool is_adhesive(ContactModel model) { return model >= ContactModel::gw_dmt; }
/// The models of the names, each once, and the boundary elements, which the others are measured by.
std::vector<ContactModel> contact_models(const std::vector<std::string>& names);

enum class GenerationMethod { filtered_noise, random_phase };

/// An ensemble of random surfaces, one for each seed.
struct GeneratedSurfaces {
  Grid2D grid;
  SelfAffineParameters spectrum;  ///< not looked at where there are tables
  GenerationMethod method = GenerationMethod::filtered_noise;
  std::vector<std::uint64_t> seeds;  ///< at least one
  /// In place of the self-affine spectrum. One is that of all surfaces. Of several the first is the
  /// one by which loads are counted, and the others, of a surface twin, are equally likely: surfaces
  /// have them by their seeds, two in turn the same, which tells what the scans leave open from what
  /// differs from place to place.
  std::vector<SpectrumTable> tables = {};

  /// That of the best table, or the self-affine one.
  std::unique_ptr<const IsotropicSpectrum> spectrum_of_all() const;
  std::unique_ptr<const IsotropicSpectrum> spectrum_of(std::uint64_t seed) const;
  /// Place among the tables of the one that a seed has; 0 where all have the same.
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
  // As ReadOptions has them; few undefined points are filled without `fill`.
  bool transpose = false;
  std::optional<std::pair<double, double>> pixel_size = {};
  std::string lateral_unit = {};
  std::optional<double> despike = {};
  std::optional<Rectangle> crop = {};
  bool fill = false;
  std::string channel = {};

  /// How read_surface() is to read it.
  ReadOptions reading() const;
};

constexpr void describe(auto&& visit, std::type_identity<MeasuredSurface>) {
  using S = MeasuredSurface;
  keep(visit, &S::file, &S::size_x, &S::size_y, &S::detrend, &S::height_unit, &S::transpose,
       &S::pixel_size, &S::lateral_unit, &S::despike, &S::crop, &S::fill, &S::channel);
}

/// Parameters that take several values each; an empty list leaves the value of the surface table.
struct ParameterLists {
  std::vector<double> hurst;
  std::vector<double> rolloff, short_cutoff;  ///< wavelengths, m
  std::vector<double> size_x;  ///< m; cells keep their size, so that the number of points follows
  std::vector<Index> points;   ///< along x; the surface keeps its size, so that cells follow

  bool empty() const {
    return hurst.empty() && rolloff.empty() && short_cutoff.empty() && size_x.empty() &&
           points.empty();
  }
};

constexpr void describe(auto&& visit, std::type_identity<ParameterLists>) {
  using S = ParameterLists;
  keep(visit, &S::hurst, &S::rolloff, &S::short_cutoff, &S::size_x, &S::points);
}

/// Adhesion of the contacts of a study, and the cycle of each surface.
struct AdhesionPlan {
  Adhesion adhesion;
  std::vector<double> cycle = {};  ///< mean gaps, m, from the widest; none: no cycle
  bool force_coarse = false;       ///< as AdhesiveContactOptions has it
};

constexpr void describe(auto&& visit, std::type_identity<AdhesionPlan>) {
  using S = AdhesionPlan;
  keep(visit, &S::adhesion, &S::cycle, &S::force_coarse);
}

/// Everything that decides the result of a study.
struct StudyConfiguration {
  std::variant<GeneratedSurfaces, MeasuredSurface> surfaces;
  Material material;  ///< with G*
  std::vector<double>
      pressures;  ///< of the BEM sweep, increasing: Pa, or in units of E*h'_rms if relative
  bool relative_pressures = false;
  /// Pressures above half of the hardness are left out, instead of being refused: half of the
  /// surface would be flat. For pressures that the user did not choose.
  bool pressures_below_hardness = false;
  double tolerance = 1e-8;  ///< e_c of each contact
  /// K_t of the boundary-element curve by a stick solve on each contact; false: (G*/E*)K. Moduli
  /// that no elastic body has leave only the latter.
  bool stick = true;
  std::optional<PressureWindow>
      window;               ///< of the exponential fit; empty: 1 … 2.5 h_rms in mean gap
  ParameterLists ensemble;  ///< for generated surfaces only
  double target_precision =
      0;                     ///< relative, at which an ensemble is large enough; 0: use all seeds
  int min_realisations = 8;  ///< >= 2, before the precision is looked at
  /// The boundary elements, which all others are measured by, must be among them.
  std::vector<ContactModel> models = {ContactModel::bem, ContactModel::gw_moments,
                                      ContactModel::gw_deterministic};
  /// What `salebra compare` takes in their place.
  std::vector<ContactModel> compared_models = all_contact_models();

  bool has(ContactModel model) const;
  /// Whether surfaces are drawn from a surface twin.
  bool of_twin() const;
  /// For the conductance of the contacts. It is no part of what is computed of a surface.
  Conduction conduction = {};
  bool flow_factors = false;  ///< of each contact of the boundary elements
  /// The boundary elements adhere, each load following from the one below, and so do the summits of
  /// gw_dmt and gw_jkr. There is no damping then: the motion is not looked at.
  std::optional<AdhesionPlan> adhesion = {};
  Oscillation motion;
  DampingOptions damping;
  /// Friction, hardness, density and excursion, for the premises of the damping. With a hardness
  /// each surface is first loaded to the largest pressure, after_first_loading(), and the study is
  /// of the residual surface.
  ContactFacts known;
  /// Intervals between the contacts inside the oscillation, SurfaceDampingOptions::levels; empty:
  /// 4, doubled for one surface where they do not suffice. 0: none, the loss of the boundary
  /// elements is that of their curve between loads, without an error, as the loss of every other
  /// model.
  std::optional<int> levels = {};
  double relative_error =
      0;  ///< of each damping constant, for which the cells are halved; 0: does not
  std::optional<SeamCheck> seam = {};  ///< adds the error of a continued scan's seam
  std::string text;                    ///< the file as it was read, for provenance
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
       &S::levels, &S::relative_error, &S::seam);
  visit(&S::text, Kept{"text", "the file as it was read"});
}

/// Why a study with adhesion has no damping, after the name of what asks for it.
extern const char* const no_damping_with_adhesion;

/// Reads a TOML file; README of data/ explains each key by example. Lengths, pressures and so on
/// are numbers in SI units or strings with a unit.
/// throws  InvalidInput "FILE:LINE: table.key: …" for an unknown key, a missing one, a wrong type
///         or a value out of range
StudyConfiguration read_study_configuration(const std::filesystem::path& file);

/// Reads from text; `name` stands for the file in errors, relative paths are taken from `folder`.
StudyConfiguration parse_study_configuration(const std::string& text, const std::string& name,
                                             const std::filesystem::path& folder = ".");

/// The configurations of all combinations of the ensemble's lists, the last parameter (points)
/// changing fastest, their own lists empty; the configuration itself where it has none. Throws
/// InvalidInput for a combination that no grid can carry, and before it makes any for more than 10
/// 000 combinations or 256 MB of settings.
std::vector<StudyConfiguration> parameter_combinations(const StudyConfiguration& configuration);

/// "H = 0.5, roll-off 1.25 µm, …": the parameters that the ensemble's lists vary, as this point has
/// them; empty without lists.
std::string describe_point(const ParameterLists& varied, const StudyConfiguration& point);

/// `file` in place of the surfaces of the configuration, which keeps everything else.
StudyConfiguration with_surface(StudyConfiguration configuration, MeasuredSurface surface);

}  // namespace salebra
