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
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/level_quadrature.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/premises.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/summits.hpp>
#include <vector>

#include "columns.hpp"
#include "cycle_fields.hpp"

namespace salebra {
namespace {

using enum Dimension;
/// Names of results that no struct describes yet.
const Quantity others[] = {
    Quantity{"filled_points", dimensionless, "points whose height was filled in"},
    Quantity{"mean", length, "mean height"},
    Quantity{"area_fraction", dimensionless, "part of the surface above"},
    Quantity{"correlation_length", length, "correlation length"},
    Quantity{"correlation_length_along", length, "correlation length along the lay"},
    Quantity{"correlation_length_across", length, "correlation length across the lay"},
    Quantity{"max_pressure", pressure, "largest contact pressure"},
    Quantity{"seconds", Dimension::time, "wall time"},
    Quantity{"decay_length_by_weights", length, "decay length for each way to weight the loads"},
    Quantity{"frequency", frequency, "frequency"},
    Quantity{"force_amplitude", force, "amplitude of the normal force"},
    Quantity{"tangential_frequency", frequency, "frequency of the tangential motion"},
    Quantity{"slow_limit_power", Dimension::power, "mean power if the tangential motion were slow"},
    Quantity{"cells", length, "middles of the cells"},
    Quantity{"stabilising_amplitude", length,
             "minimum normal amplitude that stabilises the slider"},
    Quantity{"transverse", length, "displacement along y"},
    Quantity{"limit_5_percent", dimensionless, "value at which the loss changes by 5 %"},
    Quantity{"limit_20_percent", dimensionless, "value at which the loss changes by 20 %"},
    Quantity{"onset", dimensionless, "value from which the contact flows, in place of both limits"},
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
  static const std::vector<Quantity> quantities = quantities_of<
      Surface, HeightStatistics, SpectralMoments, Summit, SummitStatistics, SummitEnsemble,
      ArealParameters, PowerSpectrum, RadialSpectrum, ProfilePsd, Correlation, ScaleDependence,
      ReliabilityLimit, HeightHistogram, SelfAffineParameters, Material, ForceCurve, ForceSample,
      NormalContactState, FirstLoading, ExponentialFit, ExponentialTest, LawDescription,
      WindowSensitivity, LocalDecayLength, CycleSample, CycleResult, SlipEffect, CouplingEffect,
      CycleFrame, LevelQuadratureResult, OscillationLoss, ExponentialLoss, SampledMotion,
      EqualFrequency, Drag, DampingResult, CommonPeriod, ContactFacts, LargestMotion, LossWithSlip,
      TrajectoryDamping, JointLoss, SteadySliding, SlidingPoint, RegimePoint, Slider, SliderMotion,
      SliderStability, SliderThresholds, OscillatorDecay, FrictionMap, StressMap, RegimeMap,
      PronyTerm, PronySeries, ViscoelasticLoss, SurfaceDamping, Anisotropy, NonGaussianSurface>();
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
