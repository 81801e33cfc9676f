// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/mdr/viscoelastic.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

namespace salebra {

/// What a viscoelastic contact that sticks loses in a period of its steady state, and by what.
struct ViscoelasticDamping {
  double work_per_cycle = 0;  ///< all of it, J: the sum of the next three
  /// Work of the material under the normal motion, J: ∮F dδ. It is there without tangential motion
  /// too.
  double normal_material_work = 0;
  double tangential_material_work =
      0;  ///< by the material of springs in contact under the tangential motion, J
  /// By springs that are let go stretched, J: what they hold when they leave, less what they still
  /// hold when they are met again. It is lost at once and by recovery of the free surface, and
  /// tends to the relaxation damping of an elastic body.
  double relaxation_work = 0;
  double power = 0;  ///< work_per_cycle over the period, W
  /// Damping constant of tangential_material_work and relaxation_work over ⟨ẋ²⟩, N s/m; NaN for a
  /// motion without ẋ.
  double damping_constant = 0;
  std::vector<double> force;      ///< F at the samples of the trajectory, N
  double mean_force = 0;          ///< its mean over the period, N
  double min_contact_radius = 0;  ///< of what never leaves contact, m
  double max_contact_radius = 0;  ///< m
  /// Whether the periodic state of each spring was found; round-off hides it where relaxation times
  /// exceed some 1e9 periods.
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

/// Steady state of a viscoelastic body under a periodic trajectory without slip. Springs of the
/// foundation as in viscoelastic_indentation(), of the tangential stiffness G* where they have E*
/// normally; a spring that is let go loses its tangential force at once. Each spring's periodic
/// state is found by Newton's method, not by waiting for it; springs that never leave contact are
/// one. With drift (case (b)) the force of permanent springs grows for ever, their loss does not.
/// docs/theory.md, section 9.
/// law, prony  as in viscoelastic_indentation(); G* is known
/// trajectory  one period, straight between the samples; second order in their number
/// springs     over the ring that opens and closes, second order
/// throws      InvalidInput as viscoelastic_indentation(), and for a trajectory that is not valid;
///             Interrupted where on_progress, told of springs, says stop
/// cost        about 10 × samples × springs × terms
ViscoelasticDamping viscoelastic_damping(const IndenterLaw& law, const PronySeries& prony,
                                         const SampledMotion& trajectory, int springs = 200,
                                         const Progress& on_progress = {});

/// The same for a motion by its name, beside the moduli at its frequency and the loss of the elastic
/// body of the relaxed modulus.
struct ViscoelasticLoss {
  double angular_frequency = 0;                  ///< of the normal motion, rad/s
  double storage_modulus = 0, loss_modulus = 0;  ///< of the shear modulus at it, Pa
  double elastic_work = 0;                       ///< J
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
  int steps = 512;    ///< straight ones of a cycle
  int springs = 200;  ///< over the ring that opens and closes
  Progress on_progress = {};
};

/// throws  as relaxation_damping() of the elastic body, which is computed first, and as
///         viscoelastic_damping()
ViscoelasticLoss viscoelastic_loss(const IndenterLaw& law, const PronySeries& prony,
                                   const Oscillation& motion, double indentation,
                                   const ViscoelasticOptions& options = {});

}  // namespace salebra
