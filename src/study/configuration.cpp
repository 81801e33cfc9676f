// SPDX-License-Identifier: GPL-3.0-or-later
// Study configuration from TOML: tables, defaults, checks, and names of the contact models.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/error.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/study/twin_file.hpp>
#include <unordered_set>

#include "body_table.hpp"
#include "io/input_file.hpp"
#include "io/number_table.hpp"
#include "surface_table.hpp"
#include "toml_reader.hpp"

namespace salebra {

const char* const no_damping_with_adhesion =
    "cannot be combined with adhesion, because points may separate in another order than they "
    "touched and then the loss is not known; leave it out, or leave out [adhesion]";

namespace {

using detail::TomlTable;

void check_positive(const TomlTable& table, std::string_view key, double value) {
  table.check(value > 0, key, fmt::format("{} must be > 0", value));
}

double required_positive(TomlTable& table, std::string_view key, Dimension dimension) {
  const double value = table.required_quantity(key, dimension);
  check_positive(table, key, value);
  return value;
}

template <class Enum>
std::optional<Enum> enumerated(TomlTable& table, std::string_view key) {
  const auto index = table.choice(key, names_of<Enum>());
  return index ? std::optional(EnumNames<Enum>::values[*index].first) : std::nullopt;
}

Grid2D read_grid(TomlTable& table) {
  const auto points = table.integers("points");
  if (points.empty() || points.size() > 2) {
    table.fail("points", "must be one whole number or two, [nx, ny]");
  }
  for (const auto count : points) {
    table.check(count >= 2 && count <= 65536, "points",
                fmt::format("{} must be from 2 to 65536", count));
  }
  Grid2D grid;
  grid.nx = points.front();
  grid.ny = points.back();
  grid.lx = required_positive(table, "size_x", Dimension::length);
  const auto size_y = table.quantity("size_y", Dimension::length);
  if (size_y) check_positive(table, "size_y", *size_y);
  grid.ly = size_y.value_or(grid.lx * double(grid.ny) / double(grid.nx));
  return grid;
}

std::vector<std::uint64_t> read_seeds(TomlTable& table) {
  const auto given = table.integers("seeds");
  const auto count = table.integers("seed_count");
  const auto first = table.integers("first_seed");
  table.check(given.empty() || (count.empty() && first.empty()), "seeds",
              "cannot be combined with first_seed and seed_count; give one of the two");
  std::vector<std::uint64_t> seeds;
  std::unordered_set<std::uint64_t> known;
  for (const auto seed : given) {
    table.check(seed >= 0, "seeds", fmt::format("{} must be >= 0", seed));
    table.check(known.insert(std::uint64_t(seed)).second, "seeds",
                fmt::format("{} occurs twice; an ensemble needs different surfaces", seed));
    seeds.push_back(std::uint64_t(seed));
  }
  if (!count.empty()) {
    table.check(count.size() == 1 && count[0] >= 1 && count[0] <= 100000, "seed_count",
                "must be one whole number from 1 to 100000");
    const auto start = first.empty() ? 1 : first[0];
    constexpr auto largest = std::numeric_limits<std::int64_t>::max();
    table.check(start >= 0 && start <= largest - (count[0] - 1), "first_seed",
                fmt::format("{} must be from 0 to {}, so that all {} seeds are below 2^63", start,
                            largest - (count[0] - 1), count[0]));
    for (std::int64_t i = 0; i < count[0]; ++i) seeds.push_back(std::uint64_t(start + i));
  }
  if (seeds.empty()) table.fail("seeds", "is missing; add seeds = [1, 2, 3] or seed_count = 3");
  return seeds;
}

ParameterLists read_lists(TomlTable& table) {
  ParameterLists lists;
  lists.hurst = table.values("hurst", Dimension::dimensionless);
  lists.rolloff = table.values("rolloff", Dimension::length);
  lists.short_cutoff = table.values("short_cutoff", Dimension::length);
  lists.size_x = table.values("size_x", Dimension::length);
  for (const auto count : table.integers("points")) {
    table.check(count >= 2 && count <= 65536, "points",
                fmt::format("{} must be from 2 to 65536", count));
    lists.points.push_back(count);
  }
  for (const auto& [key, values] : {std::pair{"hurst", &lists.hurst},
                                    {"rolloff", &lists.rolloff},
                                    {"short_cutoff", &lists.short_cutoff},
                                    {"size_x", &lists.size_x}}) {
    for (const double value : *values) check_positive(table, key, value);
  }
  return lists;
}

void read_ensemble(TomlTable& table, StudyConfiguration& configuration) {
  configuration.ensemble = read_lists(table);
  if (const auto precision = table.quantity("target_precision", Dimension::dimensionless)) {
    table.check(*precision > 0 && *precision < 1, "target_precision",
                fmt::format("{} must be between 0 and 1, such as \"2%\"", *precision));
    configuration.target_precision = *precision;
  }
  if (const auto least = table.integers("min_realisations"); !least.empty()) {
    table.check(least.size() == 1 && least[0] >= 2 && least[0] <= 100000, "min_realisations",
                "must be one whole number from 2 to 100000");
    configuration.min_realisations = int(least[0]);
  }
  table.require_no_other_keys();
}

/// Reads a parameter that must be given in this table if `list` is empty, and must not be given if
/// the ensemble varies it by `list`.
double required_unless(TomlTable& table, const char* key, Dimension dimension,
                       const std::vector<double>& list) {
  if (list.empty()) return table.required_quantity(key, dimension);
  table.check(!table.has(key), key, "is varied by [ensemble]; give it in only one of the two");
  return list.front();
}

SelfAffineParameters read_self_affine(TomlTable& table, const ParameterLists& lists) {
  SelfAffineParameters spectrum;
  spectrum.hurst = required_unless(table, "hurst", Dimension::dimensionless, lists.hurst);
  spectrum.long_cutoff = table.quantity("long_cutoff", Dimension::length);
  if (lists.rolloff.empty()) {
    spectrum.rolloff = table.quantity("rolloff", Dimension::length);
  } else {
    spectrum.rolloff = required_unless(table, "rolloff", Dimension::length, lists.rolloff);
  }
  spectrum.short_cutoff =
      required_unless(table, "short_cutoff", Dimension::length, lists.short_cutoff);
  spectrum.rms_height = table.quantity("rms_height", Dimension::length);
  spectrum.rms_slope = table.quantity("rms_slope", Dimension::dimensionless);
  return spectrum;
}

/// Reads a spectrum from two columns of a file: the wavenumber q in rad/m and the spectral density
/// C in m⁴.
SpectrumTable read_psd_table(TomlTable& table, const std::filesystem::path& folder) {
  const auto columns = read_number_table(folder / *table.text("psd_table"),
                                         spectrum_columns(Dimension::length_to_the_fourth))
                           .columns;
  SpectrumTable psd{columns[0], columns[1]};
  table.located([&] { TabulatedSpectrum(psd.wavenumber, psd.psd); });
  return psd;
}

SurfaceTexture read_texture(TomlTable& table) {
  SurfaceTexture texture;
  for (const auto& [key, stretch] :
       {std::pair{"stretch_along", &texture.lay.along}, {"stretch_across", &texture.lay.across}})
    if (const auto given = table.quantity(key, Dimension::dimensionless)) {
      check_positive(table, key, *given);
      *stretch = *given;
    }
  if (const auto angle = table.quantity("lay_angle", Dimension::angle)) {
    table.check(table.has("stretch_along") || table.has("stretch_across"), "lay_angle",
                "is given without stretch_along or stretch_across; a lay needs one of them");
    texture.lay.angle = *angle;
  }
  const auto skewness = table.quantity("skewness", Dimension::dimensionless),
             kurtosis = table.quantity("kurtosis", Dimension::dimensionless);
  table.check(!skewness || kurtosis, "skewness",
              "needs kurtosis, which is 3 for Gaussian heights; give both");
  texture.skewness = skewness.value_or(0);
  texture.kurtosis = kurtosis.value_or(3);
  if (!texture.gaussian())
    table.located([&] { johnson_heights(texture.skewness, texture.kurtosis); });
  return texture;
}

/// Takes the spectra and textures of a surface twin.
void read_twin(GeneratedSurfaces& surfaces, const std::filesystem::path& file) {
  const std::vector<TwinDraw> draws = read_twin_draws(file);
  surfaces.tables = tables_of(draws, surfaces.grid);
  surfaces.textures = textures_of(draws);
}

/// twin: file with the spectra of a surface twin, which replace the spectrum in the table; empty:
/// none.
GeneratedSurfaces read_generated(TomlTable& table, const ParameterLists& lists,
                                 const std::filesystem::path& folder,
                                 const std::filesystem::path& twin) {
  GeneratedSurfaces surfaces;
  surfaces.grid = read_grid(table);
  if (!twin.empty()) {
    if (!table.text("psd_table") && !table.text("twin")) {
      read_self_affine(table, lists);
      read_texture(table);
    }
    read_twin(surfaces, twin);
  } else if (table.has("psd_table")) {
    table.check(lists.hurst.empty() && lists.rolloff.empty() && lists.short_cutoff.empty(),
                "psd_table", "has no hurst, rolloff or short_cutoff that [ensemble] could vary");
    surfaces.tables.push_back(read_psd_table(table, folder));
  } else if (table.has("twin")) {
    table.check(lists.empty(), "twin", "fixes the spectrum, so [ensemble] has nothing to vary");
    read_twin(surfaces, folder / *table.text("twin"));
  } else {
    surfaces.spectrum = read_self_affine(table, lists);
  }
  if (const auto method = table.choice("method", {"filtered-noise", "random-phase"})) {
    surfaces.method =
        *method == 0 ? GenerationMethod::filtered_noise : GenerationMethod::random_phase;
  }
  if (surfaces.tables.size() < 2) surfaces.textures = {read_texture(table)};
  for (const SurfaceTexture& texture : surfaces.textures)
    table.check(texture.gaussian() || surfaces.method == GenerationMethod::filtered_noise, "method",
                "random-phase makes only Gaussian heights; leave it out with a skewness");
  surfaces.seeds = read_seeds(table);
  // If the ensemble varies sizes or points, each combination is checked later; this checks the
  // spectrum on the grid of the table.
  table.located([&] {
    const auto checked = surfaces.spectrum_of_all();
    if (lists.size_x.empty() && lists.points.empty()) checked->require_carried_by(surfaces.grid);
  });
  return surfaces;
}

}  // namespace

MeasuredSurface detail::read_measured(TomlTable& table, const std::filesystem::path& folder) {
  MeasuredSurface surface;
  surface.file = folder / *table.text("file");
  for (const auto& [key, size] :
       {std::pair{"size_x", &surface.size_x}, {"size_y", &surface.size_y}}) {
    *size = table.quantity(key, Dimension::length);
    if (*size) check_positive(table, key, **size);
  }
  surface.height_unit = table.text("height_unit").value_or("");
  surface.transpose = table.flag("transpose").value_or(false);
  if (const auto steps = table.values("pixel_size", Dimension::length); !steps.empty()) {
    table.check(steps.size() <= 2, "pixel_size", "must be one length or two, [dx, dy]");
    for (const double step : steps) check_positive(table, "pixel_size", step);
    surface.pixel_size = {steps.front(), steps.back()};
  }
  surface.lateral_unit = table.text("lateral_unit").value_or("");
  surface.channel = table.text("channel").value_or("");
  surface.despike = table.quantity("despike", Dimension::dimensionless);
  surface.fill = table.flag("fill").value_or(false);
  if (const auto sides = table.values("crop", Dimension::length); !sides.empty()) {
    table.check(sides.size() == 4, "crop", "must be four lengths, [x0, y0, x1, y1]");
    surface.crop = {sides[0], sides[1], sides[2], sides[3]};
  }
  surface.detrend = enumerated<Detrend>(table, "detrend");
  return surface;
}

namespace {

// Reads a parameter of the bodies or the motion that only the assumptions of the damping need; NaN
// if it is not given.
double read_fact(TomlTable& table, const char* key, Dimension dimension) {
  const auto value = table.quantity(key, dimension);
  if (!value) return ContactParameters::unknown;
  check_positive(table, key, *value);
  return *value;
}

Material read_material(TomlTable table, ContactParameters& known, bool moduli) {
  known.friction_coefficient = read_fact(table, "friction_coefficient", Dimension::dimensionless);
  known.hardness = read_fact(table, "hardness", Dimension::pressure);
  known.density = read_fact(table, "density", Dimension::mass_density);
  if (!moduli) {
    for (const char* key : {"young", "poisson", "contact_modulus", "tangential_modulus"})
      table.check(!table.has(key), key, "is given together with [body]; leave one of them out");
    table.require_no_other_keys();
    return {};
  }
  const auto young = table.values("young", Dimension::pressure);
  const auto poisson = table.values("poisson", Dimension::dimensionless);
  const auto modulus = table.quantity("contact_modulus", Dimension::pressure);
  const auto tangential = table.quantity("tangential_modulus", Dimension::pressure);
  table.require_no_other_keys();
  return table.located([&] {
    if (!young.empty()) {
      table.check(!modulus && !tangential, "young",
                  "cannot be combined with contact_modulus or tangential_modulus; give one kind");
      table.check(young.size() <= 2 && poisson.size() == young.size(), "poisson",
                  "must have one value for each of the one or two of young");
      return Material::of_bodies({young[0], poisson[0]}, young.size() == 2
                                                             ? ElasticBody{young[1], poisson[1]}
                                                             : ElasticBody{});
    }
    if (!modulus) table.fail("contact_modulus", "is missing; add it, or young and poisson");
    if (tangential) {
      table.check(poisson.empty(), "poisson",
                  "cannot be combined with tangential_modulus; give one");
      return Material::of_moduli(*modulus, *tangential);
    }
    table.check(poisson.size() == 1, "poisson",
                "must be one value, because G* is needed; or give tangential_modulus");
    return Material::of_contact_modulus(*modulus, poisson[0]);
  });
}

void read_conduction(TomlTable table, StudyConfiguration& configuration) {
  configuration.conduction = {table.values("conductivity", Dimension::thermal_conductivity),
                              table.values("resistivity", Dimension::resistivity)};
  table.located([&] { configuration.conduction.validate(); });
  table.require_no_other_keys();
}

void read_contact(TomlTable table, StudyConfiguration& configuration) {
  const bool relative = table.has("relative_pressures");
  table.check(!relative || !table.has("pressures"), "pressures",
              "cannot be combined with relative_pressures; give one of them");
  const char* key = relative ? "relative_pressures" : "pressures";
  configuration.relative_pressures = relative;
  configuration.pressures = relative ? table.values("relative_pressures", Dimension::dimensionless)
                                     : table.values("pressures", Dimension::pressure);
  const auto& pressures = configuration.pressures;
  table.check(pressures.size() >= 4, key,
              fmt::format("{} values given; a curve needs at least 4", pressures.size()));
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    check_positive(table, key, pressures[i]);
    table.check(i == 0 || pressures[i] > pressures[i - 1], key, "must increase");
  }
  if (const auto tolerance = table.quantity("tolerance", Dimension::dimensionless)) {
    table.check(*tolerance >= 1e-14 && *tolerance <= 1e-1, "tolerance",
                fmt::format("{} must be from 1e-14 to 0.1", *tolerance));
    configuration.tolerance = *tolerance;
  }
  if (const auto stick = table.choice("tangential_stiffness", {"stick", "proportional"}))
    configuration.stick = *stick == 0;
  configuration.flow_factors = table.flag("flow_factors").value_or(false);
  table.require_no_other_keys();
}

void read_fit(TomlTable table, StudyConfiguration& configuration) {
  const auto window = table.values("pressure_window", Dimension::pressure);
  if (!window.empty()) {
    table.check(window.size() == 2 && window[0] > 0 && window[1] > window[0], "pressure_window",
                "must be two pressures, 0 < lower < upper");
    configuration.window = PressureWindow{window[0], window[1], 0};
    if (!configuration.relative_pressures) {
      const auto inside = std::ranges::count_if(configuration.pressures, [&](double pressure) {
        return configuration.window->contains(pressure);
      });
      table.check(
          inside >= 3, "pressure_window",
          fmt::format("holds {} of the pressures of [contact]; a fit needs at least 3", inside));
    }
  }
  table.require_no_other_keys();
}

void read_compare(TomlTable table, StudyConfiguration& configuration) {
  if (table.has("models"))
    configuration.compared_models =
        table.located([&] { return contact_models(table.texts("models")); });
  table.require_no_other_keys();
}

void read_adhesion(TomlTable table, StudyConfiguration& configuration) {
  AdhesionPlan plan;
  plan.adhesion.work = required_positive(table, "work_of_adhesion", Dimension::energy_per_area);
  plan.adhesion.range = required_positive(table, "range", Dimension::length);
  if (const auto potential = enumerated<AdhesionPotential>(table, "potential"))
    plan.adhesion.potential = *potential;
  plan.cycle = table.values("cycle", Dimension::length);
  table.check(plan.cycle.size() != 1, "cycle",
              "1 mean gap given; a cycle needs several, such as \"8um:0.1um:24\"");
  for (std::size_t k = 0; k < plan.cycle.size(); ++k) {
    check_positive(table, "cycle", plan.cycle[k]);
    table.check(k == 0 || plan.cycle[k] < plan.cycle[k - 1], "cycle",
                "must be mean gaps from the largest to the smallest");
  }
  plan.force_coarse = table.flag("force_coarse").value_or(false);
  table.require_no_other_keys();
  configuration.adhesion = std::move(plan);
  configuration.intervals = 0;
  configuration.compared_models.insert(configuration.compared_models.end(),
                                       {ContactModel::gw_dmt, ContactModel::gw_jkr});
}

void read_damping(TomlTable table, StudyConfiguration& configuration) {
  const std::size_t mode = table.choice("mode", {"drag", "equal-frequency"}).value_or(0);
  const double normal_amplitude = required_positive(table, "normal_amplitude", Dimension::length);
  std::optional<double> omega = table.quantity("angular_frequency", Dimension::angular_frequency);
  const auto frequency = table.quantity("frequency", Dimension::frequency);
  configuration.known.excursion = read_fact(table, "excursion", Dimension::length);
  table.check(!omega || !frequency, "frequency",
              "cannot be combined with angular_frequency; give one");
  if (omega) check_positive(table, "angular_frequency", *omega);
  if (frequency) {
    check_positive(table, "frequency", *frequency);
    omega = 2 * std::numbers::pi * *frequency;
  }
  if (!omega) table.fail("frequency", "is missing; add it, or angular_frequency");
  if (mode == 0) {
    configuration.motion =
        Drag{.normal_amplitude = normal_amplitude,
             .drag_velocity = required_positive(table, "drag_velocity", Dimension::velocity),
             .angular_frequency = *omega};
  } else {
    EqualFrequency motion{
        .normal_amplitude = normal_amplitude,
        .tangential_amplitude = required_positive(table, "tangential_amplitude", Dimension::length),
        .phase = table.required_quantity("phase", Dimension::angle),
        .angular_frequency = *omega};
    configuration.motion = motion;
  }
  if (const auto hold = enumerated<Hold>(table, "hold")) configuration.damping.hold = *hold;
  if (const auto amplitude = enumerated<Amplitude>(table, "amplitude"))
    configuration.damping.amplitude = *amplitude;
  if (const auto intervals = table.quantity("intervals", Dimension::dimensionless)) {
    table.check(*intervals == 0 || allowed_intervals(*intervals), "intervals",
                fmt::format("{} must be 0, 4, 8, 16 or 32", *intervals));
    configuration.intervals = static_cast<int>(*intervals);
  }
  if (const auto error = table.quantity("relative_error", Dimension::dimensionless)) {
    table.check(*error > 0 && *error < 1, "relative_error",
                fmt::format("{} must lie between 0 and 1, such as \"5%\"", *error));
    configuration.relative_error = *error;
  }
  if (const auto direction = table.text("direction"))
    configuration.direction =
        table.located([&] { return direction_choice(*direction, "direction"); });
  configuration.seam = enumerated<SeamCheck>(table, "seam_error");
  table.require_no_other_keys();
}

}  // namespace

namespace {

const SurfaceTexture& texture_at(const GeneratedSurfaces& surfaces, std::size_t index) {
  return surfaces.textures[surfaces.textures.size() == 1 ? 0 : index];
}

std::unique_ptr<const IsotropicSpectrum> radial_spectrum_at(const GeneratedSurfaces& surfaces,
                                                            std::size_t index) {
  if (surfaces.tables.empty()) return std::make_unique<SelfAffineSpectrum>(surfaces.spectrum);
  const SpectrumTable& table = surfaces.tables[index];
  return std::make_unique<TabulatedSpectrum>(table.wavenumber, table.psd);
}

std::unique_ptr<const Spectrum> spectrum_at(const GeneratedSurfaces& surfaces, std::size_t index) {
  std::unique_ptr<const IsotropicSpectrum> radial = radial_spectrum_at(surfaces, index);
  const Anisotropy& lay = texture_at(surfaces, index).lay;
  if (lay.along == 1 && lay.across == 1) return radial;
  return std::make_unique<AnisotropicSpectrum>(std::move(radial), lay);
}

}  // namespace

std::unique_ptr<const Spectrum> GeneratedSurfaces::spectrum_of_all() const {
  return spectrum_at(*this, 0);
}

std::unique_ptr<const Spectrum> GeneratedSurfaces::spectrum_of(std::uint64_t seed) const {
  return spectrum_at(*this, table_of(seed));
}

const SurfaceTexture& GeneratedSurfaces::texture_of(std::uint64_t seed) const {
  return texture_at(*this, table_of(seed));
}

std::size_t GeneratedSurfaces::table_of(std::uint64_t seed) const {
  return tables.size() < 2 ? 0 : 1 + seed / 2 % (tables.size() - 1);
}

bool StudyConfiguration::has(ContactModel model) const {
  return std::ranges::find(models, model) != models.end();
}

void StudyConfiguration::press_on(const Body& pressed) {
  if (const std::optional<Material>& half_spaces = pressed.half_space_material()) {
    material = *half_spaces;
    body.reset();
  } else {
    body = pressed;
    models = {ContactModel::bem};
  }
}

bool StudyConfiguration::of_twin() const {
  const auto* generated = std::get_if<GeneratedSurfaces>(&surfaces);
  return generated && generated->tables.size() > 1;
}

namespace {

std::string content_of_study(const std::filesystem::path& file) {
  constexpr std::uint64_t most = 4 << 20;
  return detail::InputFile(file).content(most);
}

StudyConfiguration parse(const std::string& text, const std::string& name,
                         const std::filesystem::path& folder, const std::filesystem::path& twin) {
  TomlTable root = TomlTable::parse(text, name);
  // Reports a misspelt name of a table as such, before its keys are found to be missing.
  for (const char* table : {"surface", "ensemble", "material", "conduction", "contact", "adhesion",
                            "fit", "damping", "compare", "body"})
    root.table(table);
  root.require_no_other_keys();
  StudyConfiguration configuration;
  configuration.text = text;
  configuration.surfaces = MeasuredSurface{};
  auto ensemble = root.table("ensemble");
  if (ensemble) read_ensemble(*ensemble, configuration);
  if (auto surface = root.table("surface")) {
    if (surface->has("file")) {
      MeasuredSurface measured = detail::read_measured(*surface, folder);
      for (const auto& [key, cutoff] : {std::pair{"s_filter", &measured.filters.s_filter},
                                        {"l_filter", &measured.filters.l_filter}}) {
        *cutoff = surface->quantity(key, Dimension::length);
        if (*cutoff) check_positive(*surface, key, **cutoff);
      }
      configuration.surfaces = std::move(measured);
    } else {
      configuration.surfaces = read_generated(*surface, configuration.ensemble, folder, twin);
    }
    surface->require_no_other_keys();
  }
  if (ensemble) ensemble->located([&] { parameter_combinations(configuration); });
  std::optional<Body> body;
  if (auto table = root.table("body")) body = detail::read_body_table(*table, folder);
  if (!body || root.has("material"))
    configuration.material = read_material(root.required_table("material"), configuration.known,
                                           /*moduli=*/!body);
  if (body) configuration.press_on(*body);
  if (auto conduction = root.table("conduction")) read_conduction(*conduction, configuration);
  read_contact(root.required_table("contact"), configuration);
  if (auto fit = root.table("fit")) read_fit(*fit, configuration);
  if (auto adhesion = root.table("adhesion")) {
    root.check(!root.has("damping"), "damping", no_damping_with_adhesion);
    read_adhesion(*adhesion, configuration);
  } else {
    read_damping(root.required_table("damping"), configuration);
  }
  if (auto compare = root.table("compare")) read_compare(*compare, configuration);
  return configuration;
}

}  // namespace

StudyConfiguration parse_study_configuration(const std::string& text, const std::string& name,
                                             const std::filesystem::path& folder) {
  return parse(text, name, folder, {});
}

StudyConfiguration read_study_configuration(const std::filesystem::path& file) {
  return parse(content_of_study(file), file.string(), file.parent_path(), {});
}

StudyConfiguration detail::read_study_of_twin(const std::filesystem::path& file,
                                              const std::filesystem::path& twin) {
  return parse(content_of_study(file), file.string(), file.parent_path(), twin);
}

ReadOptions MeasuredSurface::reading() const {
  ReadOptions options;
  options.transpose = transpose;
  options.size_x = size_x;
  options.size_y = size_y;
  options.pixel_size = pixel_size;
  options.lateral_unit = lateral_unit;
  options.height_unit = height_unit;
  options.channel = channel;
  options.despike = despike;
  options.crop = crop;
  options.undefined = fill ? Undefined::fill : Undefined::fill_few;
  return options;
}

StudyConfiguration with_surface(StudyConfiguration configuration, MeasuredSurface surface) {
  configuration.surfaces = std::move(surface);
  return configuration;
}

}  // namespace salebra
