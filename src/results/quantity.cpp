// SPDX-License-Identifier: GPL-3.0-or-later
// Table of result names: dimension and long name of each quantity in files and answers.
#include <algorithm>
#include <salebra/base/grid.hpp>
#include <salebra/base/spectral_moments.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/premises.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/results/columns.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>
#include <vector>

namespace salebra {
namespace {

using enum Dimension;
/// Names of results that no struct describes yet.
const Quantity others[] = {
    Quantity{"x", length, "position along x"},
    Quantity{"y", length, "position along y"},
    Quantity{"periodic", dimensionless, "whether the surface repeats itself"},
    Quantity{"heights", length, "height, positive out of the material"},
    Quantity{"points", dimensionless, "number of points"},
    Quantity{"undefined_points", dimensionless, "points without a height"},
    Quantity{"filled_points", dimensionless, "points whose height was filled in"},
    Quantity{"stride", dimensionless, "points from one to the next that is kept"},
    Quantity{"first_load", dimensionless,
             "number of the lowest pressure of the curve at which the point touches; -1: none"},
    Quantity{"mean", length, "mean height"},
    Quantity{"Sa", length, "ISO 25178-2 arithmetic mean height"},
    Quantity{"Sq", length, "ISO 25178-2 root mean square height"},
    Quantity{"Ssk", dimensionless, "ISO 25178-2 skewness"},
    Quantity{"Sku", dimensionless, "ISO 25178-2 kurtosis"},
    Quantity{"Sp", length, "ISO 25178-2 maximum peak height"},
    Quantity{"Sv", length, "ISO 25178-2 maximum pit depth"},
    Quantity{"Sz", length, "ISO 25178-2 maximum height"},
    Quantity{"Sal", length, "ISO 25178-2 autocorrelation length, s = 0.2"},
    Quantity{"Str", dimensionless, "ISO 25178-2 texture aspect ratio, s = 0.2"},
    Quantity{"Std", angle, "ISO 25178-2 texture direction"},
    Quantity{"Sdq", dimensionless, "ISO 25178-2 root mean square gradient"},
    Quantity{"Sdr", dimensionless, "ISO 25178-2 developed interfacial area ratio"},
    Quantity{"Sk", length, "ISO 25178-2 core height"},
    Quantity{"Spk", length, "ISO 25178-2 reduced peak height"},
    Quantity{"Svk", length, "ISO 25178-2 reduced valley depth"},
    Quantity{"Smr1", dimensionless, "ISO 25178-2 material ratio of peaks and core"},
    Quantity{"Smr2", dimensionless, "ISO 25178-2 material ratio of core and valleys"},
    Quantity{"Spd", inverse_length_squared, "ISO 25178-2 density of peaks, pruned at 5 % of Sz"},
    Quantity{"Spc", inverse_length, "ISO 25178-2 mean peak curvature"},
    Quantity{"pixel_limit", length, "two cells, the shortest wavelength of the grid"},
    Quantity{"tip_limit", length, "wavelength below which the tip shows in the curvatures"},
    Quantity{"resolution", length, "lateral resolution of the instrument"},
    Quantity{"wavelength", length, "shortest reliable wavelength"},
    Quantity{"wavenumber", Dimension::wavenumber, "wave number"},
    Quantity{"wavenumber_x", Dimension::wavenumber, "wave number along x"},
    Quantity{"wavenumber_y", Dimension::wavenumber, "wave number along y"},
    Quantity{"psd", length_to_the_fourth,
             "power spectral density C, rms_height^2 = integral of C d^2q"},
    Quantity{"law_psd", length_to_the_fourth, "power spectral density of the self-affine law"},
    Quantity{"profile_psd", length_cubed,
             "power spectral density C1 of profiles, rms_height^2 = integral of C1 dq over all q"},
    Quantity{"modes", dimensionless, "modes in the mean"},
    Quantity{"distance", length, "distance of the points of a pair"},
    Quantity{"autocorrelation", length_squared, "mean of h(x) h(x+r), h from the mean"},
    Quantity{"structure", length_squared, "mean of (h(x+r) - h(x))^2"},
    Quantity{"pairs", dimensionless, "pairs in the mean"},
    Quantity{"spacing", length, "distance s of the differences"},
    Quantity{"profile_slope", dimensionless, "rms of (h(x+s) - h(x))/s"},
    Quantity{"profile_curvature", inverse_length, "rms of (h(x+s) - 2 h(x) + h(x-s))/s^2"},
    Quantity{"min_curvature", inverse_length, "curvature of the sharpest peak"},
    Quantity{"stencils", dimensionless, "stencils of the curvature"},
    Quantity{"area_fraction", dimensionless, "part of the surface above"},
    Quantity{"height", length, "height above the mean"},
    Quantity{"height_density", inverse_length, "share of the points in a bin over its width"},
    Quantity{"hurst_low", dimensionless, "Hurst exponent, lower 95 % limit"},
    Quantity{"hurst_high", dimensionless, "Hurst exponent, upper 95 % limit"},
    Quantity{"correlation_length", length, "correlation length"},
    Quantity{"correlation_length_along", length, "correlation length along the lay"},
    Quantity{"correlation_length_across", length, "correlation length across the lay"},
    Quantity{"stretch_along", dimensionless, "stretch of the spectrum along the lay"},
    Quantity{"stretch_across", dimensionless, "stretch of the spectrum across the lay"},
    Quantity{"lay_angle", angle, "direction of the lay against x"},
    Quantity{"peklenik", dimensionless, "correlation length along x over that along y"},
    Quantity{"spectrum_mismatch", dimensionless, "relative error of the spectrum of the heights"},
    Quantity{"modulus_ratio", dimensionless, "G*/E*"},
    Quantity{"max_pressure", pressure, "largest contact pressure"},
    Quantity{"gap", length, "gap of the deformed surfaces"},
    Quantity{"elastic_energy", energy, "elastic energy"},
    Quantity{"residual", dimensionless, "residual of the contact"},
    Quantity{"iterations", dimensionless, "iterations of the solver"},
    Quantity{"fft_count", dimensionless, "Fourier transforms of the solver, in pairs"},
    Quantity{"ladder_count", dimensionless, "applications of the near-field ladder"},
    Quantity{"relative_pressure", dimensionless, "nominal pressure over E* times rms slope"},
    Quantity{"bearing_area_fraction", dimensionless,
             "part of the undeformed surface above the mean gap of the contact"},
    Quantity{"persson_area_slope", dimensionless, "area slope of Persson's theory"},
    Quantity{"bgt_area_slope", dimensionless, "area slope of Bush, Gibson and Thomas"},
    Quantity{"tangential_stiffness_per_area", Dimension::stiffness_per_area,
             "tangential stiffness in full stick over nominal area"},
    Quantity{"seconds", Dimension::time, "wall time"},
    Quantity{"decay_length_by_weights", length, "decay length for each way to weight the loads"},
    Quantity{"fair", dimensionless, "whether one decay length describes the curve fairly"},
    Quantity{"deviation_min", dimensionless, "minimum deviation over the pressures"},
    Quantity{"deviation_max", dimensionless, "maximum deviation over the pressures"},
    Quantity{"frequency", frequency, "frequency"},
    Quantity{"force_amplitude", force, "amplitude of the normal force"},
    Quantity{"tangential_frequency", frequency, "frequency of the tangential motion"},
    Quantity{"slow_limit_power", Dimension::power, "mean power if the tangential motion were slow"},
    Quantity{"work_per_cycle_with_slip", energy, "energy dissipated in a cycle with friction"},
    Quantity{"work_by_levels", energy, "energy dissipated in a cycle, from contact levels"},
    Quantity{"error_estimate", energy, "estimated error of the energy dissipated in a cycle"},
    Quantity{"work_by_levels_error", energy, "estimated error of the energy from contact levels"},
    Quantity{"work_by_whole_cells", energy,
             "energy dissipated in a cycle, from contact levels of whole cells"},
    Quantity{"predicted", energy, "energy dissipated in a cycle, Eq. (12) or (15)"},
    Quantity{"predicted_finite", energy, "energy dissipated in a cycle by K_t = (G*/E*)K"},
    Quantity{"predicted_exponential", energy,
             "energy dissipated in a cycle, Eq. (12) or (16) with F'' = F/l^2"},
    Quantity{"predicted_exponential_finite", energy,
             "energy dissipated in a cycle by the exponential law at this amplitude"},
    Quantity{"ratio", dimensionless, "energy dissipated in a cycle over the predicted one"},
    Quantity{"ratio_finite", dimensionless, "the same over predicted_finite"},
    Quantity{"ratio_exponential", dimensionless, "the same over predicted_exponential"},
    Quantity{"ratio_exponential_finite", dimensionless,
             "the same over predicted_exponential_finite"},
    Quantity{"work_over_elastic_energy", dimensionless,
             "energy dissipated in a cycle over the largest tangential elastic energy"},
    Quantity{"levels", dimensionless, "contact levels"},
    Quantity{"steps", dimensionless, "steps of a cycle"},
    Quantity{"step", dimensionless, "step of the cycle"},
    Quantity{"periods", dimensionless, "simulated periods"},
    Quantity{"model", dimensionless, "contact model"},
    Quantity{"time", Dimension::time, "time"},
    Quantity{"stored_energy_change", energy, "change of the elastic energy in a cycle"},
    Quantity{"normal_work", energy, "work of the normal force in a cycle"},
    Quantity{"gap_work", energy, "work across gaps that close and open within a step"},
    Quantity{"balance", dimensionless, "energy dissipated by the cells over work_per_cycle"},
    Quantity{"over_stick", dimensionless, "energy dissipated in a cycle over that without slip"},
    Quantity{"work_change", dimensionless, "relative change of work_per_cycle by the coupling"},
    Quantity{"force_change", dimensionless, "relative change of the normal force by the coupling"},
    Quantity{"tangential_force_change", dimensionless,
             "relative change of the tangential force by the coupling"},
    Quantity{"contact", dimensionless, "1 in contact, 0 not"},
    Quantity{"cells", length, "middles of the cells"},
    Quantity{"contact_map", dimensionless,
             "0 never in contact, 1 during a part of the cycle, 2 always"},
    Quantity{"loss", energy_per_area, "energy dissipated in a period by unit area"},
    Quantity{"traction_x", pressure, "shear traction along x"},
    Quantity{"traction_y", pressure, "shear traction along y"},
    Quantity{"displacement_x", length, "displacement of cells in contact along x"},
    Quantity{"displacement_y", length, "displacement of cells in contact along y"},
    Quantity{"contact_area_min", length_squared, "minimum contact area of a cycle"},
    Quantity{"contact_area_max", length_squared, "maximum contact area of a cycle"},
    Quantity{"closed_form", energy, "energy dissipated in a cycle, closed form"},
    Quantity{"damping_constant_with_slip", damping, "damping constant P/v^2 with friction"},
    Quantity{"elastic_work", energy,
             "energy dissipated in a cycle by the elastic body of the relaxed modulus"},
    Quantity{"storage_modulus", pressure, "real part of the complex shear modulus"},
    Quantity{"loss_modulus", pressure, "imaginary part of the complex shear modulus"},
    Quantity{"stiffness_ratio", dimensionless, "stiffness of the contact over that of the spring"},
    Quantity{"stabilising_amplitude", length,
             "minimum normal amplitude that stabilises the slider"},
    Quantity{"stable", dimensionless, "steady sliding is stable"},
    Quantity{"transverse", length, "displacement along y"},
    Quantity{"velocity_ratio", dimensionless, "velocity over critical velocity"},
    Quantity{"regime", dimensionless, "0 no slip, 1 partial slip, 2 sliding, 3 unknown"},
    Quantity{"no_slip_excursion", length,
             "largest excursion without slip; 0: none, n/a: all excursions"},
    Quantity{"threshold_amplitude", length, "minimum normal amplitude at which sliding is stable"},
    Quantity{"threshold_frequency", frequency,
             "minimum frequency of the normal oscillation at which sliding is stable"},
    Quantity{"limit_5_percent", dimensionless, "value at which the loss changes by 5 %"},
    Quantity{"limit_20_percent", dimensionless, "value at which the loss changes by 20 %"},
};

/// Of the first struct that has a name.
template <class... Structs>
std::vector<Quantity> quantities_of() {
  std::vector<Quantity> all;
  for (const std::vector<Column>* columns : {&columns_of<Structs>()...})
    for (const Column& column : *columns)
      all.push_back({column.name, column.dimension, column.long_name});
  all.insert(all.end(), std::begin(others), std::end(others));
  return all;
}

/// The entry of a name, or none.
const Quantity* entry_of(std::string_view name) {
  static const std::vector<Quantity> quantities =
      quantities_of<Grid2D, HeightStatistics, SpectralMoments, SummitStatistics, SummitEnsemble,
                    SelfAffineParameters, Material, ForceCurve, ForceSample, FirstLoading,
                    ExponentialFit, ExponentialTest, WindowSensitivity, LocalDecayLength,
                    CycleSample, EqualFrequency, Drag, DampingResult, CommonPeriod, ContactFacts,
                    LargestMotion, LossWithSlip, TrajectoryDamping, JointLoss, SteadySliding,
                    Slider, SliderMotion, SliderStability, OscillatorDecay, FrictionMap, StressMap,
                    RegimeMap, PronyTerm, PronySeries, ViscoelasticDamping, SurfaceDamping>();
  const auto found = std::ranges::find(quantities, name, &Quantity::name);
  return found != quantities.end() ? &*found : nullptr;
}

}  // namespace

Quantity find_quantity(std::string_view name) {
  const Quantity* found = entry_of(name);
  return found ? *found : Quantity{name, dimensionless, name};
}

bool is_quantity(std::string_view name) { return entry_of(name) != nullptr; }

}  // namespace salebra
