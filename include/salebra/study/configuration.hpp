// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/contact/normal/conductance.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/filters.hpp>
#include <salebra/surface/lay.hpp>
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

/// A contact model: its name in files, JSON and study files (that of the enumerator), its title for
/// people, its cost in seconds per cell and pressure on the machine for which estimate_cost() is
/// calibrated, and the function that computes the contact of a surface with the model. A new model
/// is an enumerator and an entry in src/study/contact_models.cpp.
struct StudyModel {
  ContactModel id;
  const char* name;
  const char* title;
  double seconds_per_cell;
  ModelResult (*press)(detail::ModelWork&);
};

/// Returns all contact models.
std::span<const StudyModel> contact_models();

/// Finds a model by its name. Throws InvalidInput for the field "models" for an unknown name.
ContactModel contact_model(std::string_view name);
std::string_view name_of(ContactModel model);
/// Returns all models without adhesion.
std::vector<ContactModel> all_contact_models();
/// Whether the summits of a model adhere.
constexpr bool is_adhesive(ContactModel model) { return model >= ContactModel::gw_dmt; }
/// Returns the named models, each once, and in any case the boundary elements, which are the
/// reference for all other models.
std::vector<ContactModel> contact_models(const std::vector<std::string>& names);

enum class GenerationMethod { filtered_noise, random_phase };

/// What distinguishes a surface with a lay and skew heights from an isotropic Gaussian one with the
/// same radial spectrum. Heights of other skewness or kurtosis have Johnson's distribution and are
/// samples of a translation process (Exact::process).
struct SurfaceTexture {
  Anisotropy lay;
  double skewness = 0, kurtosis = 3;

  bool gaussian() const { return skewness == 0 && kurtosis == 3; }
};

constexpr void describe(auto&& visit, std::type_identity<SurfaceTexture>) {
  using S = SurfaceTexture;
  visit(&S::lay, Kept{"lay", "stretch of the spectrum"});
  visit(&S::skewness, Kept{"skewness", "skewness of the heights"});
  visit(&S::kurtosis, Kept{"kurtosis", "kurtosis of the heights, 3 for a Gaussian"});
  visit(&S::gaussian, Kept{"gaussian", "whether the heights are Gaussian"});
}

/// An ensemble of random surfaces, one for each seed.
struct GeneratedSurfaces {
  Grid2D grid;
  SelfAffineParameters spectrum;  ///< not used if there are tables
  GenerationMethod method = GenerationMethod::filtered_noise;
  std::vector<std::uint64_t> seeds;  ///< at least one
  /// Tabulated spectra that replace the self-affine spectrum. A single table holds for all
  /// surfaces. If there are several tables, the first one defines the scale of the loads; all later
  /// tables are equally likely draws of a surface twin, assigned to the surfaces by their seeds so
  /// that two consecutive seeds share a table. Such pairs separate the uncertainty that the scans
  /// leave open from the variation from place to place.
  std::vector<SpectrumTable> tables = {};
  /// One texture for all surfaces, or one for each table.
  std::vector<SurfaceTexture> textures = {{}};

  /// Returns the spectrum of the first table or, without tables, the self-affine spectrum.
  std::unique_ptr<const Spectrum> spectrum_of_all() const;
  std::unique_ptr<const Spectrum> spectrum_of(std::uint64_t seed) const;
  const SurfaceTexture& texture_of(std::uint64_t seed) const;
  /// Index of the table of a seed; 0 if all seeds have the same spectrum.
  std::size_t table_of(std::uint64_t seed) const;
};

constexpr void describe(auto&& visit, std::type_identity<GeneratedSurfaces>) {
  using S = GeneratedSurfaces;
  keep(visit, &S::grid, &S::spectrum, &S::method, &S::seeds, &S::tables, &S::textures);
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
  GaussianFilters filters = {};  ///< applied last, after the trend is removed

  /// Returns the options for read_surface().
  ReadOptions reading() const;
};

constexpr void describe(auto&& visit, std::type_identity<MeasuredSurface>) {
  using S = MeasuredSurface;
  keep(visit, &S::file, &S::size_x, &S::size_y, &S::detrend, &S::height_unit, &S::transpose,
       &S::pixel_size, &S::lateral_unit, &S::despike, &S::crop, &S::fill, &S::channel, &S::filters);
}

/// Surface parameters to vary. A parameter whose list is empty keeps its value in the table
/// [surface] of the study file.
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
  std::vector<double> cycle = {};  ///< mean gaps, m, the widest first; empty: no cycle
  bool force_coarse = false;       ///< as AdhesiveContactOptions::force_coarse
};

constexpr void describe(auto&& visit, std::type_identity<AdhesionPlan>) {
  using S = AdhesionPlan;
  keep(visit, &S::adhesion, &S::cycle, &S::force_coarse);
}

/// Everything that determines the result of a study.
struct StudyConfiguration {
  std::variant<GeneratedSurfaces, MeasuredSurface> surfaces;
  Material material;  ///< including G*
  /// A body in place of the half-spaces of `material`; empty: these. Boundary elements alone are
  /// computed on it, without adhesion, conductance or first loading. The results then have in
  /// `material` the modulus E* = pressure_scale()/h' of an equivalent half-space under the first
  /// surface, and no G*.
  std::optional<Body> body = {};
  Body pressed() const { return body.value_or(Body(material)); }  ///< what the surfaces press on
  /// Presses the surfaces on this body: sets `material` if it is half-spaces, otherwise `body`, and
  /// leaves boundary elements as the only model.
  void press_on(const Body& pressed);
  /// Pressures of the sweep with boundary elements, increasing: in Pa or, if relative_pressures is
  /// true, in units of E*h'_rms.
  std::vector<double> pressures;
  bool relative_pressures = false;
  /// true: leaves out pressures above half of the hardness, at which half of the surface would be
  /// flat; false: refuses them. Meant for pressures that the user did not choose.
  bool pressures_below_hardness = false;
  double tolerance = 1e-8;  ///< NormalContactOptions::tolerance of each contact
  /// Computes K_t of the boundary-element curve by a stick solve on each contact; false:
  /// K_t = (G*/E*)K. Moduli that no elastic body has require false.
  bool stick = true;
  /// Window of the exponential fit; empty: mean gaps from 1 to 2.5 h_rms.
  std::optional<PressureWindow> window;
  ParameterLists ensemble;      ///< for generated surfaces only
  double target_precision = 0;  ///< relative precision at which an ensemble ends; 0: use all seeds
  int min_realisations = 8;     ///< >= 2; realisations before the precision is checked
  /// Contact models. They must include the boundary elements, which are the reference for all other
  /// models.
  std::vector<ContactModel> models = {ContactModel::bem, ContactModel::gw_moments,
                                      ContactModel::gw_deterministic};
  /// Contact models that the command `salebra compare` computes.
  std::vector<ContactModel> compared_models = all_contact_models();

  bool has(ContactModel model) const;
  /// Whether surfaces are drawn from a surface twin.
  bool of_twin() const;
  /// Conductivities and resistivities for the conductance of the contacts; they do not affect any
  /// other result.
  Conduction conduction = {};
  bool flow_factors = false;  ///< true: flow factors of each boundary-element contact
  /// Adhesion of the boundary elements, where each load starts from the next smaller load, and of
  /// the summits of gw_dmt and gw_jkr. A study with adhesion has no damping: the motion is ignored.
  std::optional<AdhesionPlan> adhesion = {};
  Oscillation motion;
  DampingOptions damping;
  /// What the motion keeps at all pressures of all surfaces, if damping.hold is automatic:
  /// run_ensembles() finds it from the first surface at its lowest pressure. Empty: not yet found.
  std::optional<Hold> found_hold = {};
  Hold hold() const { return found_hold.value_or(damping.hold); }
  /// Contact parameters (friction, hardness, density, excursion) for the loss and its assumptions.
  /// With a hardness each surface is first loaded to the largest pressure (after_first_loading()),
  /// and all results are those of the residual surface.
  ContactParameters known;
  /// Number of intervals between the contacts solved inside the oscillation, as
  /// SurfaceDampingOptions::intervals. Empty: 4, doubled for a single surface as long as the error
  /// requires it. 0: the loss of the boundary elements is computed from their force curve,
  /// interpolated between loads, as for all other models; it then has no error.
  std::optional<int> intervals = {};
  double relative_error =
      0;  ///< target for each damping constant, reached by halving the cells; 0: none
  std::optional<SeamCheck> seam = {};  ///< adds the error of continuing a scan periodically
  /// Direction of the tangential motion and of K_t of the boundary elements: from the x axis, rad,
  /// or by the lay of the surface. Without stick solves K_t has no direction.
  DirectionChoice direction = LayDirection::automatic;
  std::string text;  ///< text of the file, for provenance
};

constexpr void describe(auto&& visit, std::type_identity<StudyConfiguration>) {
  using S = StudyConfiguration;
  keep(visit, &S::surfaces);
  visit(&S::material, Kept{"material", "elastic constants of the bodies"});
  keep(visit, &S::body);
  keep(visit, &S::pressures, &S::relative_pressures, &S::pressures_below_hardness);
  visit(&S::tolerance, Kept{"tolerance", "of each contact"});
  keep(visit, &S::stick, &S::window, &S::ensemble, &S::target_precision, &S::min_realisations);
  visit(&S::models, Kept{"models", "names of the contact models that are run on each surface"});
  visit(
      &S::compared_models,
      Kept{"compared_models",
           "those that the program's command `compare` runs: all, unless the study file chooses"});
  keep(visit, &S::conduction, &S::flow_factors, &S::adhesion, &S::motion, &S::damping,
       &S::found_hold, &S::known, &S::intervals, &S::relative_error, &S::seam, &S::direction);
  visit(&S::text, Kept{"text", "the file as it was read"});
}

/// Text that says why a study with adhesion has no damping; in messages it follows the name of the
/// input.
extern const char* const no_damping_with_adhesion;

/// Reads a study from a TOML file; the README of data/ explains each key by example. Quantities are
/// numbers in SI units or strings with a unit.
///
///     StudyConfiguration study = read_study_configuration("study.toml");
///
/// throws  InvalidInput, whose message starts with "FILE:LINE: table.key", for an unknown or
///         missing key, a wrong type or a value out of range
StudyConfiguration read_study_configuration(const std::filesystem::path& file);

/// Reads a study from text. `name` replaces the file in error messages; relative paths start from
/// `folder`.
StudyConfiguration parse_study_configuration(const std::string& text, const std::string& name,
                                             const std::filesystem::path& folder = ".");

/// Returns one configuration for each combination of the parameters in configuration.ensemble, with
/// the last parameter (points) changing fastest; the lists in these configurations are empty.
/// Without lists it returns the configuration itself. Throws InvalidInput for a combination that no
/// grid can represent, and for more than 10 000 combinations or 256 MB of settings.
std::vector<StudyConfiguration> parameter_combinations(const StudyConfiguration& configuration);

/// Formats the varied parameters of a point of the parameter grid, e.g. "H = 0.5, roll-off 1.25
/// µm"; empty without lists.
std::string describe_point(const ParameterLists& varied, const StudyConfiguration& point);

/// Returns the configuration with its surfaces replaced by the given measured surface.
StudyConfiguration with_surface(StudyConfiguration configuration, MeasuredSurface surface);

}  // namespace salebra
