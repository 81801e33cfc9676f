// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of an installation against known solutions: Hertz, Westergaard, Greenwood and Williamson,
// the theorem W = ½∮s² dK_t.
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/study/verification.hpp>
#include <salebra/surface/moments.hpp>

namespace salebra {
namespace {

using std::numbers::pi;
const Material steel = Material::of_bodies({2e11, 0.3});
const Drag drag{.normal_amplitude = 2e-9, .drag_velocity = 1e-3, .angular_frequency = 2 * pi * 2e4};
const EqualFrequency shear{.normal_amplitude = 2e-9,
                           .tangential_amplitude = 3e-9,
                           .phase = 1.1,
                           .angular_frequency = 2 * pi * 2e4};

using Checks = std::vector<Check>;

void check_hertz(Checks& checks) {
  const double radius = 1e-2, indentation = 1e-6, modulus = steel.contact_modulus;
  const IndenterLaw sphere(paraboloid_profile(radius), steel);
  const double force = 4.0 / 3.0 * modulus * std::sqrt(radius * std::pow(indentation, 3));
  const double contact_radius = std::sqrt(radius * indentation);
  // Computed and expected value are the same formula in another order of operations.
  checks.push_back({"Hertz force", sphere.force(indentation), force, 1e-13});
  checks.push_back({"Hertz stiffness 2E*a", sphere.normal_stiffness(indentation),
                    2 * modulus * contact_radius, 1e-13});
  checks.push_back({"Hertz curvature 2E*/g'(a)", sphere.force_curvature(indentation),
                    modulus * radius / contact_radius, 1e-13});
}

void check_hertz_by_boundary_elements(Checks& checks) {
  const Index n = 128;
  const double size = 1e-3, radius = 1e-2, modulus = steel.contact_modulus;
  const double contact_radius = size / 5;
  Surface sphere;
  sphere.grid = {n, n, size, size};
  sphere.heights.resize(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      // The centre is at no point of symmetry of the grid, so the edge of the contact does not
      // follow cell sides.
      const double x = (double(i) - double(n / 2) - 0.31) * size / double(n);
      const double y = (double(j) - double(n / 2) - 0.17) * size / double(n);
      sphere.heights(i, j) = -(x * x + y * y) / (2 * radius);
    }
  }
  const double force = 4.0 / 3.0 * modulus * std::pow(contact_radius, 3) / radius;
  const auto state = press(sphere, modulus, at_pressure(force / sphere.grid.area()),
                           {.tolerance = 1e-8, .boundary = Boundary::free});
  // Tolerances for 26 cells per radius: the error of the indentation is of second order in the cell
  // size, and the maximum pressure depends on where the centre lies in its cell.
  checks.push_back({"Hertz indentation by boundary elements",
                    state.converged() ? state.indentation : ForceSample::unknown,
                    contact_radius * contact_radius / radius, 2e-3});
  checks.push_back({"Hertz peak pressure by boundary elements",
                    state.converged() ? state.contact_pressure.maxCoeff() : ForceSample::unknown,
                    2 * modulus * contact_radius / (pi * radius), 2e-3});
}

void check_westergaard(Checks& checks) {
  const Index n = 64;
  const double size = 1e-3, amplitude = 1e-6, modulus = steel.contact_modulus;
  const double full = pi * modulus * amplitude / size;
  Surface wave;
  wave.grid = {n, n, size, size};
  wave.periodic = true;
  wave.heights.resize(n, n);
  for (Index i = 0; i < n; ++i)
    wave.heights.row(i) = amplitude * std::cos(2 * pi * double(i) / double(n));
  const auto state = press(wave, modulus, at_pressure(1.01 * full), {.tolerance = 1e-12});
  // The pressure is a single Fourier mode, which the grid represents exactly, so only the error of
  // the solver remains.
  checks.push_back({"Westergaard full contact: area fraction", state.contact_area_fraction, 1, 0});
  checks.push_back({"Westergaard full contact: peak pressure",
                    state.converged() ? state.contact_pressure.maxCoeff() : ForceSample::unknown,
                    2.01 * full, 1e-8});
}

void check_greenwood_williamson(Checks& checks) {
  const SummitEnsemble ensemble{.summit_density = 1e12,
                                .radius = 1e-7,
                                .summit_rms = 2e-8,
                                .distribution = SummitDistribution::exponential};
  const GreenwoodWilliamsonLaw law(ensemble, steel, 1e-8);
  const double force = law.force(-3 * ensemble.summit_rms);
  const auto result =
      relaxation_damping(law, at_force(force), drag, {.amplitude = Amplitude::small});
  // Computed and expected value are closed forms.
  checks.push_back(
      {"exponential summits obey Eq. (16) with l = sigma", result.work_per_cycle,
       closed_form::work_per_cycle_rough(steel.modulus_ratio(), force, ensemble.summit_rms, drag),
       1e-10});
}

void check_integrals(Checks& checks) {
  const auto j = [](double k) { return closed_form::drag_integral_scaled(k) * std::exp(k); };
  checks.push_back({"J(0)", j(0), pi * pi - 4, 1e-13});
  // The drag integral J(k). The expected values have ten digits and come from an independent
  // quadrature.
  checks.push_back({"J(1)", j(1), 4.323679579, 3e-10});
  checks.push_back({"J(3)", j(3), 5.056702593, 3e-10});
}

void check_theorem(Checks& checks) {
  const double ratio = steel.modulus_ratio(), force = 1, decay_length = 5e-9;
  const ExponentialLaw rough(force, decay_length, ratio);
  const IndenterLaw cone(cone_profile(0.1), steel);
  const double indentation = 1e-7, curvature = cone.force_curvature(indentation);
  // Compares quadrature with a tolerance of 1e-10 with closed forms.
  const auto compare = [&](const char* name, const ContactLaw& law, double at,
                           const Oscillation& motion, double expected) {
    const auto result = relaxation_damping(law, at_indentation(at), motion);
    checks.push_back(
        {name, result.converged ? result.work_per_cycle : ForceSample::unknown, expected, 1e-9});
  };
  compare("theorem on a cone: Eq. (12)", cone, indentation, shear,
          closed_form::work_per_cycle(ratio, curvature, shear));
  compare("theorem on a cone: Eq. (15)", cone, indentation, drag,
          closed_form::work_per_cycle(ratio, curvature, drag));
  compare("theorem on the exponential law, equal frequencies", rough, 0, shear,
          closed_form::work_per_cycle_exponential(ratio, force, decay_length, shear));
  compare("theorem on the exponential law, drag", rough, 0, drag,
          closed_form::work_per_cycle_exponential(ratio, force, decay_length, drag));
}

void check_generator(Checks& checks) {
  const Grid2D grid{101, 128, 1e-5, 1e-5};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.7, .rolloff = 4e-6, .short_cutoff = 4e-7, .rms_height = 1e-8});
  const SpectralMoments target = spectrum.lattice_moments(grid);
  const SpectralMoments found = surface_moments(random_phase(grid, spectrum, 7));
  // Random phases do not change the power of a mode, so the spectral moments differ only by
  // round-off of the transforms.
  checks.push_back(
      {"random-phase surface: m0 of its spectrum", found.moment0, target.moment0, 1e-11});
  checks.push_back(
      {"random-phase surface: m4 of its spectrum", found.moment4(), target.moment4(), 1e-11});
}

}  // namespace

bool Check::passed() const {
  const double scale = expected == 0 ? 1 : std::abs(expected);
  return std::abs(value - expected) <= tolerance * scale;
}

std::vector<Check> verify_installation(const Progress& progress) {
  const std::vector<std::function<void(Checks&)>> groups{
      check_hertz,       check_hertz_by_boundary_elements,
      check_westergaard, check_greenwood_williamson,
      check_integrals,   check_theorem,
      check_generator};
  Checks checks;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (progress &&
        !progress(
            {.stage = "verify", .fraction = double(i) / double(groups.size()), .step = int(i)})) {
      throw Interrupted("verify: interrupted");
    }
    groups[i](checks);
  }
  return checks;
}

}  // namespace salebra
