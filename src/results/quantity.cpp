// SPDX-License-Identifier: GPL-3.0-or-later
// Table of result names: dimension and long name of each quantity in files and answers.
#include <algorithm>
#include <salebra/results/contact.hpp>
#include <salebra/results/damping.hpp>
#include <salebra/results/spectrum.hpp>
#include <salebra/results/surface.hpp>
#include <vector>

namespace salebra {
namespace {

using enum Dimension;
/// Names of results that no struct describes yet.
const Quantity others[] = {
    Quantity{"x", length, "position along x"},
    Quantity{"y", length, "position along y"},
    Quantity{"heights", length, "height, positive out of the material"},
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
    Quantity{"wavelength", length, "wavelength"},
    Quantity{"wavelength_low", length, "wavelength, lower 95 % limit"},
    Quantity{"wavelength_high", length, "wavelength, upper 95 % limit"},
    Quantity{"correlation_length", length, "correlation length"},
    Quantity{"modulus_ratio", dimensionless, "G*/E*"},
    Quantity{"max_pressure", pressure, "largest contact pressure"},
    Quantity{"elastic_energy", energy, "elastic energy"},
    Quantity{"curvature", curvature, "second derivative of force by indentation"},
    Quantity{"seconds", Dimension::time, "wall time"},
    Quantity{"decay_length_by_weights", length, "decay length for each way to weight the loads"},
    Quantity{"local_decay_length", length, "local decay length -d(mean gap)/d ln(pressure)"},
    Quantity{"frequency", frequency, "frequency"},
    Quantity{"force_amplitude", force, "amplitude of the normal force"},
    Quantity{"mean_force", force, "normal force, mean over a cycle"},
    Quantity{"tangential_frequency", frequency, "frequency of the tangential motion"},
    Quantity{"normal_cycles", dimensionless, "normal cycles in the common period"},
    Quantity{"tangential_cycles", dimensionless, "tangential cycles in the common period"},
    Quantity{"slow_limit_power", Dimension::power, "mean power if the tangential motion were slow"},
    Quantity{"work_per_cycle", energy, "energy dissipated in a cycle"},
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
    Quantity{"work_over_elastic_energy", dimensionless,
             "energy dissipated in a cycle over the largest tangential elastic energy"},
    Quantity{"dissipated", energy, "energy dissipated in a cycle, summed over the cells"},
    Quantity{"stored_energy_change", energy, "change of the elastic energy in a cycle"},
    Quantity{"normal_work", energy, "work of the normal force in a cycle"},
    Quantity{"gap_work", energy, "work across gaps that close and open within a step"},
    Quantity{"tangential", length, "tangential displacement"},
    Quantity{"work", energy, "work of the tangential force since the start"},
    Quantity{"contact_area_min", length_squared, "least contact area of a cycle"},
    Quantity{"contact_area_max", length_squared, "greatest contact area of a cycle"},
    Quantity{"closed_form", energy, "energy dissipated in a cycle, closed form"},
    Quantity{"power", Dimension::power, "mean dissipated power"},
    Quantity{"damping_constant", damping, "damping constant P/v^2"},
    Quantity{"contact_radius", length, "contact radius"},
    Quantity{"least_contact_radius", length, "contact radius at the least indentation"},
    Quantity{"relaxation_work", energy,
             "energy dissipated in a cycle by springs that open and close"},
    Quantity{"slip_work", energy, "energy dissipated in a cycle by slip in permanent contact"},
    Quantity{"full_stick_work", energy, "energy dissipated in a cycle without slip"},
    Quantity{"small_amplitude_work", energy, "energy dissipated in a cycle, small-amplitude form"},
    Quantity{"storage_stiffness", stiffness, "mean tangential stiffness in phase with the motion"},
    Quantity{"loss_factor", dimensionless, "energy dissipated over 2 pi times energy stored"},
    Quantity{"contact_stiffness", stiffness, "tangential stiffness of what is always in contact"},
    Quantity{"natural_frequency", angular_frequency, "natural angular frequency of the oscillator"},
    Quantity{"damping_ratio", dimensionless, "damping over critical damping"},
    Quantity{"quality_factor", dimensionless, "quality factor"},
    Quantity{"decay_time", Dimension::time, "time in which the amplitude falls by e"},
    Quantity{"logarithmic_decrement", dimensionless, "logarithmic decrement"},
    Quantity{"mass", mass, "mass of the oscillator"},
    Quantity{"spring_stiffness", stiffness, "stiffness of the spring beside the contact"},
    Quantity{"falling_slope", damping, "decrease of friction with velocity"},
    Quantity{"stabilising_amplitude", length, "least normal amplitude that stabilises the slider"},
    Quantity{"friction_number", dimensionless, "M = mu E* u_z/(G* u_x)"},
    Quantity{"tangential_force", force, "tangential force"},
    Quantity{"velocity", velocity, "sliding velocity"},
    Quantity{"mean_tangential_force", force, "tangential force, mean over a cycle"},
    Quantity{"friction_coefficient", dimensionless, "mean tangential over mean normal force"},
    Quantity{"static_friction_coefficient", dimensionless, "friction coefficient as v -> 0"},
    Quantity{"critical_velocity", velocity, "velocity from which nothing sticks"},
    Quantity{"low_speed_damping", damping, "damping constant of slow sliding, Eq. (S2)"},
    Quantity{"relaxation_damping", damping, "damping constant without slip, case (b)"},
    Quantity{"shear", pressure, "tangential stress"},
};

template <class... Structs>
std::vector<Quantity> columns_of() {
  std::vector<Quantity> all;
  const auto add = [&](const auto&, const Quantity& quantity) { all.push_back(quantity); };
  (for_each_column<Structs>(add), ...);
  all.insert(all.end(), std::begin(others), std::end(others));
  return all;
}

/// The entry of a name, or none.
const Quantity* entry_of(std::string_view name) {
  static const std::vector<Quantity> quantities =
      columns_of<Grid2D, HeightStatistics, SpectralMoments, SummitStatistics, SummitEnsemble,
                 SelfAffineParameters, Material, ForceCurve, ForceSample, ExponentialFit,
                 ExponentialTest, WindowSensitivity, EqualFrequency, Drag>();
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
