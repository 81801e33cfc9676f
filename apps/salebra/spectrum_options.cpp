// SPDX-License-Identifier: GPL-3.0-or-later
// Options that describe the power spectrum of a random surface.
#include "spectrum_options.hpp"

#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <utility>

#include "answers.hpp"
#include "io/number_table.hpp"
#include "options.hpp"
#include "results/answer_json.hpp"

namespace salebra::cli {
namespace {

/// Throws InvalidInput if an option was given that this kind of spectrum does not use.
void require_absent(const std::optional<double>& value, std::string_view option,
                    const std::string& kind) {
  require_that(!value, option, "given, but " + kind + " has none; leave it out");
}

}  // namespace

void SpectrumOptions::add_to(Command& app) {
  const Heading under(app, "Spectrum");
  add_quantity(app, "--hurst", hurst, Dimension::dimensionless,
               "self-affine: Hurst exponent, 0 < H <= 1");
  add_quantity(
      app, "--long-cutoff", long_cutoff, Dimension::length,
      "self-affine: longest wavelength; default: the longer side, with --rolloff no limit");
  add_quantity(app, "--rolloff", rolloff, Dimension::length,
               "self-affine: wavelength where the plateau ends; default: --long-cutoff");
  add_quantity(app, "--short-cutoff", short_cutoff, Dimension::length,
               "shortest wavelength, at least two cells");
  add_quantity(app, "--rms-height", rms_height, Dimension::length,
               "rms height of the spectrum; or give --rms-slope");
  add_quantity(app, "--rms-slope", rms_slope, Dimension::dimensionless,
               "rms slope of the spectrum, sqrt(<|grad h|^2>)");
  add_choice(app, "--correlation", correlation, {"gaussian", "exponential"},
             "correlation function instead of --hurst, with --correlation-length and --rms-height");
  add_quantity(app, "--correlation-length", correlation_length, Dimension::length,
               "distance over which the correlation falls to 1/e");
  app.add_option("--psd-table", table,
                 "file with two columns, wave number in rad/m and density, instead of --hurst; "
                 "--rms-height scales it")
      ->file(FileUse::input);
  add_choice(app, "--convention", convention, {"salebra", "surface-topography", "gwyddion"},
             "convention of --psd-table; default salebra, rms_height^2 = integral of C d^2q");
  add_quantity(app, "--stretch-along", stretch_along, Dimension::dimensionless,
               "factor on the correlation length along the lay; default 1");
  add_quantity(app, "--stretch-across", stretch_across, Dimension::dimensionless,
               "the same across the lay; default 1");
  add_quantity(app, "--lay-angle", lay_angle, Dimension::angle,
               "angle from the x axis to the lay; default 0");
}

SelfAffineParameters SpectrumOptions::self_affine(double cell) const {
  return {.hurst =
              required(hurst, "--hurst",
                       "a spectrum is needed; give --hurst, --correlation, --psd-table or --shape"),
          .long_cutoff = long_cutoff || rolloff ? long_cutoff : cell,
          .rolloff = rolloff,
          .short_cutoff = required(short_cutoff, "--short-cutoff",
                                   "a self-affine spectrum needs a shortest wavelength"),
          .rms_height = rms_height,
          .rms_slope = rms_slope};
}

std::shared_ptr<const IsotropicSpectrum> SpectrumOptions::tabulated() const {
  // The radial spectrum of Gwyddion is that of a profile, in m³.
  const Dimension density =
      convention == "gwyddion" ? Dimension::length_cubed : Dimension::length_to_the_fourth;
  auto columns = read_number_table(table, spectrum_columns(density)).columns;
  for (std::size_t k = 0; k < columns[1].size(); ++k) {
    constexpr double turn = 2 * std::numbers::pi;
    if (convention == "surface-topography") columns[1][k] /= turn * turn;
    if (convention == "gwyddion") columns[1][k] /= turn * columns[0][k];
  }
  TabulatedSpectrum spectrum(columns[0], columns[1]);
  if (rms_height) {
    require_positive(*rms_height, "--rms-height");
    const double factor = *rms_height / spectrum.moments().rms_height();
    for (double& density : columns[1]) density *= factor * factor;
    spectrum = TabulatedSpectrum(columns[0], columns[1]);
  }
  return std::make_shared<TabulatedSpectrum>(std::move(spectrum));
}

std::shared_ptr<const IsotropicSpectrum> SpectrumOptions::isotropic(double cell) const {
  const std::string kind = !table.empty()         ? "--psd-table"
                           : !correlation.empty() ? "--correlation " + correlation
                                                  : "--hurst";
  if (kind == "--hurst") {
    require_absent(correlation_length, "--correlation-length", "a self-affine spectrum");
    return std::make_shared<SelfAffineSpectrum>(self_affine(cell));
  }
  require_that(table.empty() || correlation.empty(), "--correlation",
               "given together with --psd-table; give one of them");
  for (const auto& [value, option] :
       {std::pair{&hurst, "--hurst"}, std::pair{&long_cutoff, "--long-cutoff"},
        std::pair{&rolloff, "--rolloff"}, std::pair{&rms_slope, "--rms-slope"}})
    require_absent(*value, option, kind);
  if (!table.empty()) {
    require_absent(correlation_length, "--correlation-length", kind);
    require_absent(short_cutoff, "--short-cutoff", kind);
    return tabulated();
  }
  const double height = required(rms_height, "--rms-height", kind + " needs it");
  const double length = required(correlation_length, "--correlation-length", kind + " needs it");
  if (correlation == "gaussian") {
    require_absent(short_cutoff, "--short-cutoff", kind);
    return std::make_shared<FunctionSpectrum>(gaussian_correlation_spectrum(height, length));
  }
  return std::make_shared<FunctionSpectrum>(exponential_correlation_spectrum(
      height, length, required(short_cutoff, "--short-cutoff", kind + " needs it")));
}

std::shared_ptr<const Spectrum> SpectrumOptions::spectrum(double cell) const {
  if (!stretch_along && !stretch_across) {
    require_that(!lay_angle, "--lay-angle", "given without --stretch-along or --stretch-across");
    return isotropic(cell);
  }
  return std::make_shared<AnisotropicSpectrum>(isotropic(cell),
                                               Anisotropy{.along = stretch_along.value_or(1),
                                                          .across = stretch_across.value_or(1),
                                                          .angle = lay_angle.value_or(0)});
}

SelfAffineProfileSpectrum SpectrumOptions::profile_spectrum(double cell) const {
  require_that(table.empty() && correlation.empty(), "--profile",
               "given with a spectrum of surfaces, but profiles are self-affine; give --hurst");
  require_that(!stretch_along && !stretch_across && !lay_angle, "--profile",
               "given with a lay, which a profile does not have");
  return SelfAffineProfileSpectrum(self_affine(cell));
}

Json SpectrumOptions::anisotropy() const {
  if (!stretch_along && !stretch_across) return nullptr;
  Lay lay{{stretch_along.value_or(1), stretch_across.value_or(1), lay_angle.value_or(0)},
          correlation_length,
          {},
          {}};
  if (correlation_length) {
    lay.correlation_length_along = lay.along * *correlation_length;
    lay.correlation_length_across = lay.across * *correlation_length;
  }
  return answer_json(lay);
}

}  // namespace salebra::cli
