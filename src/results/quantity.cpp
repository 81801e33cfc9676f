// SPDX-License-Identifier: GPL-3.0-or-later
// The glossary: dimension and long name of each quantity in the described structs.
#include <algorithm>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/mdr/adhesive_indenter.hpp>
#include <salebra/contact/normal/adhesive_cycle.hpp>
#include <salebra/contact/normal/conductance.hpp>
#include <salebra/contact/normal/distributions.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/interval_quadrature.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/filters.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/profile_parameters.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/twin.hpp>
#include <vector>

#include "columns.hpp"
#include "cycle_fields.hpp"

namespace salebra {
namespace {

/// The column of that name in the first of the listed structs that has one; nullptr if none has.
const Column* entry_of(std::string_view name) {
  return find_column<
      Surface, HeightStatistics, SpectralMoments, Summit, SummitStatistics, SummitEnsemble,
      ArealParameters, PowerSpectrum, RadialSpectrum, ProfilePsd, Correlation, ScaleDependence,
      ReliabilityLimit, HeightHistogram, SelfAffineParameters, Material, ForceCurve, ForceSample,
      NormalContactState, FirstLoading, ExponentialFit, ExponentialTest, LawDescription,
      WindowSensitivity, LocalDecayLength, CycleSample, CycleResult, SlipEffect, CouplingEffect,
      CycleFrame, CycleMesh, IntervalQuadratureResult, OscillationLoss, ExponentialLoss,
      SampledMotion, EqualFrequency, Drag, DampingResult, CommonPeriod, ContactParameters,
      MaxMotion, Assumption, Loss, TrajectoryDamping, JointLoss, SteadySliding, SlidingPoint,
      RegimePoint, Slider, SliderMotion, SliderStability, SliderThresholds, OscillatorDecay,
      FrictionMap, StressMap, RegimeMap, PronyTerm, PronySeries, ViscoelasticLoss,
      ViscoelasticCycle, ViscoelasticPoint, SurfaceDamping, Anisotropy, NonGaussianSurface,
      Conductances, ContactDistributions, FlowFactors, AdhesionOfState, AdhesiveCycle,
      AdhesivePoint, SurfaceLay, TwinDraw, ProfileParameters, GaussianFilters>(name);
}

}  // namespace

Quantity find_quantity(std::string_view name) {
  const Column* found = entry_of(name);
  return found ? Quantity{found->name, found->dimension, found->long_name}
               : Quantity{name, Dimension::dimensionless, name};
}

bool is_quantity(std::string_view name) { return entry_of(name) != nullptr; }

}  // namespace salebra
