// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the scans of a surface twin from a TOML file, and reads and writes the twin as a file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/study/twin_file.hpp>
#include <salebra/surface/moments.hpp>

#include "io/input_file.hpp"
#include "results/quantity_group.hpp"
#include "surface_table.hpp"

namespace salebra {
namespace {

using detail::TomlTable;

double positive(TomlTable& table, const char* key, Dimension dimension, double otherwise) {
  const auto value = table.quantity(key, dimension);
  if (value) table.check(*value > 0, key, fmt::format("{} must be > 0", *value));
  return value.value_or(otherwise);
}

TwinMeasurement read_measurement(TomlTable& table, const std::filesystem::path& folder) {
  TwinMeasurement measurement;
  if (!table.has("file")) table.fail("file", "is missing; name the file of the scan");
  measurement.surface = detail::read_measured(table, folder);
  ScanInstrument& instrument = measurement.instrument;
  const auto kind = table.choice("instrument", names_of<Instrument>());
  if (!kind)
    table.fail("instrument",
               "is missing; give optical, stylus or afm, or ideal for heights as "
               "they are");
  instrument.kind = EnumNames<Instrument>::values[*kind].first;
  instrument.resolution = positive(table, "resolution", Dimension::length, 0);
  instrument.tip_radius = positive(table, "tip_radius", Dimension::length, 0);
  table.check((instrument.kind == Instrument::optical) == (instrument.resolution > 0), "resolution",
              "must be given for an optical instrument and for no other: the full width at half "
              "maximum of its blur");
  table.check(instrument.has_tip() == (instrument.tip_radius > 0), "tip_radius",
              "must be given for a stylus or afm and for no other");
  instrument.noise = positive(table, "noise", Dimension::length, instrument.noise);
  instrument.height_calibration = positive(table, "height_calibration", Dimension::dimensionless,
                                           instrument.height_calibration);
  instrument.scan_calibration =
      positive(table, "scan_calibration", Dimension::dimensionless, instrument.scan_calibration);
  instrument.line_drift = table.flag("line_drift");
  instrument.name = table.text("name").value_or("");
  measurement.weight = positive(table, "weight", Dimension::dimensionless, 1);
  table.require_no_other_keys();
  return measurement;
}

/// Limits for the contents of a twin file. A fit usually has five knots (wavenumbers of the
/// tabulated spectrum) per decade and a thousand draws.
constexpr Index max_draws = 20000;
constexpr std::size_t max_knots = 64;

/// The names of the parameters of a twin.
constexpr std::pair<const char*, TwinParameter SurfaceTwin::*> parameters[] = {
    {"hurst", &SurfaceTwin::hurst},
    {"rolloff", &SurfaceTwin::rolloff},
    {"short_cutoff", &SurfaceTwin::short_cutoff},
    {"rms_height", &SurfaceTwin::rms_height},
    {"rms_slope", &SurfaceTwin::rms_slope},
    {"stretch", &SurfaceTwin::stretch},
    {"lay_angle", &SurfaceTwin::lay_angle},
    {"rolloff_along", &SurfaceTwin::rolloff_along},
    {"skewness", &SurfaceTwin::skewness},
    {"kurtosis", &SurfaceTwin::kurtosis}};

constexpr std::pair<const char*, double TwinDraw::*> numbers_of_draw[] = {
    {"hurst", &TwinDraw::hurst},
    {"rolloff", &TwinDraw::rolloff},
    {"short_cutoff", &TwinDraw::short_cutoff},
    {"rms_height", &TwinDraw::rms_height},
    {"rms_slope", &TwinDraw::rms_slope}};

/// Numbers of a draw that files of version 2.0 lack, whose surfaces are isotropic and Gaussian, and
/// their bounds.
struct AddedNumber {
  const char* name;
  double TwinDraw::*member;
  double low, high;
};
constexpr AddedNumber added_numbers[] = {{"stretch", &TwinDraw::stretch, 1, 1e3},
                                         {"lay_angle", &TwinDraw::lay_angle, 0, std::numbers::pi},
                                         {"skewness", &TwinDraw::skewness, -10, 10},
                                         {"kurtosis", &TwinDraw::kurtosis, 1, 1000}};

/// The wavenumbers of a draw. A draw that is a power law has only one, the reference wavenumber of
/// its amplitude. log_psd_of() gives ln C at these wavenumbers.
std::vector<double> knots_of(const TwinDraw& draw) {
  return draw.form == SpectrumForm::table ? draw.knots : std::vector{draw.reference};
}
std::vector<double> log_psd_of(const TwinDraw& draw) {
  return draw.form == SpectrumForm::table ? draw.log_psd : std::vector{draw.amplitude};
}

void write_draws(ResultGroup plain, const std::vector<TwinDraw>& draws) {
  plain.index("draw", draws.size(), "draw of the posterior");
  const std::vector<double> knots = knots_of(draws.front());
  plain.coordinate("knot", knots, "rad/m", "wave number of the amplitude");
  std::vector<double> log_psd;
  for (const TwinDraw& draw : draws)
    for (const double value : log_psd_of(draw)) log_psd.push_back(value);
  plain.dataset("log_psd", log_psd, {"draw", "knot"}, "1",
                "natural logarithm of the spectral density in m^4, or of its power law");
  QuantityGroup group(std::move(plain));
  const auto write = [&](const char* name, double TwinDraw::*member) {
    std::vector<double> values;
    for (const TwinDraw& draw : draws) values.push_back(draw.*member);
    group.dataset(name, values, {"draw"});
  };
  for (const auto& [name, member] : numbers_of_draw) write(name, member);
  for (const AddedNumber& number : added_numbers) write(number.name, number.member);
}

}  // namespace

std::vector<TwinMeasurement> read_twin_measurements(const std::filesystem::path& file) {
  constexpr std::uint64_t most = 4 << 20;
  TomlTable root = TomlTable::parse(detail::InputFile(file).content(most), file.string());
  std::vector<TwinMeasurement> measurements;
  for (TomlTable& table : root.tables("measurement"))
    measurements.push_back(read_measurement(table, file.parent_path()));
  root.require_no_other_keys();
  if (measurements.empty())
    root.fail("measurement", "is missing; add a table [[measurement]] for each scan");
  return measurements;
}

std::vector<ScanSpectrum> spectra_of(const std::vector<TwinMeasurement>& measurements,
                                     const Progress& progress, std::vector<std::string>* warnings) {
  std::vector<ScanSpectrum> scans;
  for (const TwinMeasurement& one : measurements) {
    const Surface surface = measured_surface(one.surface, {}, warnings);
    const std::string name = one.surface.file.filename().string();
    scans.push_back(scan_spectrum(surface.heights, surface.grid, one.instrument, one.weight, name));
    const auto done = static_cast<double>(scans.size());
    if (progress && !progress({"scans", done / static_cast<double>(measurements.size()),
                               static_cast<int>(scans.size()), 0}))
      throw Interrupted("twin: stopped before all scans were read");
  }
  return scans;
}

SurfaceTwin twin_of(const std::vector<TwinMeasurement>& measurements, const TwinOptions& options,
                    const Progress& progress, std::vector<std::string>* warnings) {
  return fit_twin(spectra_of(measurements, progress, warnings), options);
}

void write_twin(const std::filesystem::path& path, const SurfaceTwin& twin,
                const Provenance& provenance, const WriteOptions& options) {
  require(std::ssize(twin.draws) <= max_draws, "draws", twin.draws.size(),
          fmt::format("must be at most {} in a file", max_draws));
  ResultFile file(path, provenance, options);
  ResultGroup plain = file.group("twin");
  plain.attribute("form", name_of(twin.form));
  for (const auto& [name, member] : parameters) {
    const TwinParameter& one = twin.*member;
    const Quantity quantity = find_quantity(name);
    const std::string unit(si_unit(quantity.dimension)), meaning(quantity.long_name);
    plain.scalar(name, one.value, unit, meaning);
    plain.scalar(std::string(name) + "_low", one.low, unit, meaning + ", lower 95 % limit");
    plain.scalar(std::string(name) + "_high", one.high, unit, meaning + ", upper 95 % limit");
  }
  plain.scalar("misfit", twin.misfit, "1", "deviance of the spectra over what is expected");
  ResultGroup spectrum = file.group("twin/spectrum");
  spectrum.coordinate("wavenumber", twin.spectrum.wavenumber, "rad/m", "wave number");
  for (const auto& [name, values] : {std::pair{"psd", &twin.spectrum.psd},
                                     {"psd_low", &twin.spectrum.low},
                                     {"psd_high", &twin.spectrum.high}})
    spectrum.dataset(name, *values, {"wavenumber"}, "m^4", "spectral density");
  write_draws(file.group("twin/draws"), twin.draws);
  file.commit();
}

std::vector<TwinDraw> read_twin_draws(const std::filesystem::path& path) {
  const ResultReader file(path);
  const std::optional<std::string> word =
      file.has("twin") ? file.text_attribute("twin", "form") : std::nullopt;
  const std::optional<SpectrumForm> form = word ? parse_enum<SpectrumForm>(*word) : std::nullopt;
  if (!form)
    throw InvalidInput(path.string(),
                       "is not a surface twin; name a file that `salebra twin` wrote");
  const std::string draws_group = "twin/draws/";
  const bool table = *form == SpectrumForm::table;
  // Checks the sizes before reading, because a compressed file may contain more numbers than fit
  // into memory.
  const auto count_of = [&](const std::string& name) {
    std::size_t count = 1;
    for (const Index extent : file.shape(draws_group + name)) {
      require(extent <= max_draws, path.string(), extent,
              fmt::format("values of {}{} along one dimension must be at most {}", draws_group,
                          name, max_draws));
      count *= static_cast<std::size_t>(extent);
    }
    return count;
  };
  const std::size_t knots_of_draw = count_of("knot"), values_of_draws = count_of("log_psd");
  require(table ? knots_of_draw >= 2 && knots_of_draw <= max_knots : knots_of_draw == 1,
          path.string(), knots_of_draw,
          table ? fmt::format("knots in {}knot must be from 2 to {}", draws_group, max_knots)
                : fmt::format("knots in {}knot must be one for the form {}", draws_group, *word));
  const std::size_t count = values_of_draws / knots_of_draw;
  require(count > 0 && count * knots_of_draw == values_of_draws, path.string(), values_of_draws,
          fmt::format("values of {}log_psd make no draws of {} knots", draws_group, knots_of_draw));
  const auto require_one_a_draw = [&](const char* name) {
    require(count_of(name) == count, path.string(), count_of(name),
            fmt::format("values of {} belong to {} draws", name, count));
  };
  for (const auto& [name, member] : numbers_of_draw) require_one_a_draw(name);
  // Reads numbers and checks that they lie between `low` and `high`. The limits used below include
  // all real surfaces and exclude overflow.
  const auto within = [&](const std::string& name, double low, double high) {
    std::vector<double> values = file.numbers(draws_group + name);
    for (const double value : values)
      require(value >= low && value <= high, path.string(), value,
              fmt::format("in {}{} must be from {:g} to {:g}", draws_group, name, low, high));
    return values;
  };
  const std::vector<double> knots = within("knot", 1e-6, 1e15),
                            log_psd = within("log_psd", -400, 400);
  require(std::ranges::is_sorted(knots, std::less_equal()), path.string(), "",
          fmt::format("has knots in {}knot that do not rise", draws_group));
  std::vector<TwinDraw> draws(count);
  for (const auto& [name, member] : numbers_of_draw) {
    // A tabulated spectrum has neither a Hurst exponent nor a roll-off.
    const bool unused = table && (member == &TwinDraw::hurst || member == &TwinDraw::rolloff);
    const std::vector<double> values = unused ? file.numbers(draws_group + name)
                                       : member == &TwinDraw::hurst     ? within(name, -1, 3)
                                       : member == &TwinDraw::rms_slope ? within(name, 0, 1e6)
                                                                        : within(name, 1e-15, 1e6);
    for (std::size_t i = 0; i < count; ++i) draws[i].*member = values[i];
  }
  for (const AddedNumber& number : added_numbers) {
    if (!file.has(draws_group + number.name)) continue;
    require_one_a_draw(number.name);
    const std::vector<double> values = within(number.name, number.low, number.high);
    for (std::size_t i = 0; i < count; ++i) draws[i].*number.member = values[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    TwinDraw& draw = draws[i];
    require(draw.kurtosis > draw.skewness * draw.skewness + 1, path.string(), draw.kurtosis,
            fmt::format("in {}kurtosis must exceed skewness^2 + 1", draws_group));
    draw.form = *form;
    const auto first = log_psd.begin() + static_cast<std::ptrdiff_t>(i * knots.size());
    if (table) {
      draw.knots = knots;
      draw.log_psd.assign(first, first + static_cast<std::ptrdiff_t>(knots.size()));
    } else {
      draw.reference = knots.front();
      draw.amplitude = *first;
    }
  }
  return draws;
}

namespace {

/// The draw with the median slope, which stands for all, followed by all draws.
std::vector<TwinDraw> with_median(const std::vector<TwinDraw>& draws) {
  std::vector<TwinDraw> by_slope = draws;
  const auto middle = by_slope.begin() + static_cast<std::ptrdiff_t>(by_slope.size() / 2);
  std::ranges::nth_element(by_slope, middle, {}, &TwinDraw::rms_slope);
  std::vector<TwinDraw> all{*middle};
  all.insert(all.end(), draws.begin(), draws.end());
  return all;
}

}  // namespace

std::vector<SpectrumTable> tables_of(const std::vector<TwinDraw>& draws, const Grid2D& grid) {
  const double lowest = std::numbers::pi / std::max(grid.lx, grid.ly);
  const double nyquist = std::numbers::pi / std::max(grid.dx(), grid.dy());
  std::vector<SpectrumTable> tables;
  for (TwinDraw& draw : with_median(draws)) {
    // Cuts the spectrum at waves of two cells, the shortest ones on this grid.
    draw.short_cutoff = std::max(draw.short_cutoff, 2 * std::numbers::pi / nyquist);
    tables.push_back(tabulated(draw, lowest));
    // An AnisotropicSpectrum multiplies by the stretch, so that it keeps the rms height.
    for (double& psd : tables.back().psd) psd /= draw.stretch;
  }
  return tables;
}

std::vector<SurfaceTexture> textures_of(const std::vector<TwinDraw>& draws) {
  std::vector<SurfaceTexture> textures;
  for (const TwinDraw& draw : with_median(draws))
    textures.push_back({.lay = {.along = draw.stretch, .across = 1, .angle = draw.lay_angle},
                        .skewness = draw.skewness,
                        .kurtosis = draw.kurtosis});
  return textures;
}

}  // namespace salebra
