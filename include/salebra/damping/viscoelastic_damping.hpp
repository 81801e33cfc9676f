// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/mdr/viscoelastic.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

namespace salebra {

/// Loss of a viscoelastic contact in full stick over a period of its steady state, by cause.
struct ViscoelasticDamping {
  double work_per_cycle = 0;  ///< total loss, J: sum of the three parts below
  /// Loss in the material due to the normal motion, ∮F dδ, J. It also occurs without tangential
  /// motion.
  double normal_material_work = 0;
  /// Loss, J, in the material of the springs in contact due to the tangential motion.
  double tangential_material_work = 0;
  /// Tangential energy of springs when they separate, J, minus the energy that they still have when
  /// they touch again. Part of it is lost at once, the rest while the free surface recovers. For an
  /// elastic body it is the relaxation damping.
  double relaxation_work = 0;
  double power = 0;  ///< work_per_cycle divided by the period, W
  /// Damping constant, N s/m: mean power of tangential_material_work + relaxation_work, divided by
  /// ⟨ẋ²⟩. NaN for a motion without tangential velocity.
  double damping_constant = 0;
  std::vector<double> force;      ///< F at the samples of the trajectory, N
  double mean_force = 0;          ///< mean of F over the period, N
  double min_contact_radius = 0;  ///< radius of the permanent contact, m
  double max_contact_radius = 0;  ///< largest of the period, m
  /// Whether the periodic state of each spring was found. Round-off prevents this if relaxation
  /// times exceed some 1e9 periods.
  bool converged = false;
};

constexpr void describe(auto&& visit, std::type_identity<ViscoelasticDamping>) {
  using enum Dimension;
  using S = ViscoelasticDamping;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::normal_material_work,
        Quantity{"normal_material_work", energy,
                 "energy dissipated in a cycle by the material under normal motion"});
  visit(&S::tangential_material_work,
        Quantity{"tangential_material_work", energy,
                 "energy dissipated in a cycle by the material under tangential motion"});
  visit(&S::relaxation_work, quantity::relaxation_work);
  visit(&S::power, quantity::power);
  visit(&S::damping_constant, quantity::damping_constant);
  visit(&S::force,
        Kept{"force", "normal force at the samples of the trajectory", Dimension::force});
  visit(&S::mean_force, quantity::mean_force);
  visit(&S::min_contact_radius,
        Quantity{"min_contact_radius", length, "contact radius at the minimum indentation"});
  visit(&S::max_contact_radius,
        Quantity{"max_contact_radius", length, "contact radius at the maximum indentation"});
  visit(&S::converged, Kept{"converged", "false: do not use the losses"});
}

/// Computes the steady state of a viscoelastic body under a periodic trajectory without slip
/// (docs/theory.md, section 9).
///
///     auto loss = viscoelastic_damping(law, prony, sample(motion, 1e-8, 512));
///
/// The springs of the elastic foundation are those of viscoelastic_indentation(), with a tangential
/// stiffness given by G* instead of E*; a spring that separates loses its tangential force at once.
/// Newton's method finds the periodic state of each spring directly, without simulating many
/// periods. All springs in permanent contact are treated as one spring; with drift (case (b), Drag)
/// its force grows without bound, but its loss does not.
/// law, prony  as in viscoelastic_indentation(); G* must be known
/// trajectory  one period, straight between the samples; the error is of second order in the time
///             step
/// springs     number of springs over the ring that opens and closes; the error is of second order
///             in their width
/// throws      InvalidInput wherever viscoelastic_indentation() does, and for a trajectory that
///             fails SampledMotion::validate(); Interrupted if on_progress, which counts springs,
///             says stop
/// cost        about 10 × samples × springs × terms of the Prony series
ViscoelasticDamping viscoelastic_damping(const IndenterLaw& law, const PronySeries& prony,
                                         const SampledMotion& trajectory, int springs = 200,
                                         const Progress& on_progress = {});

/// Loss of a viscoelastic contact under an Oscillation, with the complex shear modulus at its
/// frequency and, for comparison, the loss of an elastic body with the relaxed modulus.
struct ViscoelasticLoss {
  double angular_frequency = 0;                  ///< ω of the normal motion, rad/s
  double storage_modulus = 0, loss_modulus = 0;  ///< parts G', G'' of the shear modulus at ω, Pa
  double elastic_work = 0;  ///< loss of an elastic body with the relaxed modulus, J
  ViscoelasticDamping damping = {};
};

constexpr void describe(auto&& visit, std::type_identity<ViscoelasticLoss>) {
  using enum Dimension;
  using S = ViscoelasticLoss;
  visit(&S::angular_frequency, quantity::angular_frequency);
  visit(&S::storage_modulus,
        Quantity{"storage_modulus", pressure, "real part of the complex shear modulus"});
  visit(&S::loss_modulus,
        Quantity{"loss_modulus", pressure, "imaginary part of the complex shear modulus"});
  visit(&S::elastic_work,
        Quantity{"elastic_work", energy,
                 "energy dissipated in a cycle by the elastic body of the relaxed modulus"});
  visit(&S::damping, Part{"damping", "losses of the viscoelastic body"});
}

struct ViscoelasticOptions {
  int steps = 512;    ///< straight steps per cycle
  int springs = 200;  ///< number of springs over the ring that opens and closes
  Progress on_progress = {};
};

/// Computes the losses of a motion about an indentation, m.
/// throws  whatever relaxation_damping() throws for the elastic body, which is computed first, and
///         whatever viscoelastic_damping() throws
ViscoelasticLoss viscoelastic_loss(const IndenterLaw& law, const PronySeries& prony,
                                   const Oscillation& motion, double indentation,
                                   const ViscoelasticOptions& options = {});

}  // namespace salebra
