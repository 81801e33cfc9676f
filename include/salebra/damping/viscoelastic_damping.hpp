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
  double work_per_cycle = 0;  ///< total loss, J: the sum of the next three
  /// Loss in the material under the normal motion, J: ∮F dδ. It also exists without tangential
  /// motion.
  double normal_material_work = 0;
  double tangential_material_work =
      0;  ///< loss in the material of springs in contact under the tangential motion, J
  /// Energy of springs that separate while stretched, J, minus what they still hold when they touch
  /// again. It is lost at once and by recovery of the free surface, and tends to the relaxation
  /// damping of an elastic body.
  double relaxation_work = 0;
  double power = 0;  ///< work_per_cycle over the period, W
  /// Damping constant from tangential_material_work and relaxation_work over ⟨ẋ²⟩, N s/m; NaN for a
  /// motion without ẋ.
  double damping_constant = 0;
  std::vector<double> force;      ///< F at the samples of the trajectory, N
  double mean_force = 0;          ///< mean of F over the period, N
  double min_contact_radius = 0;  ///< of the permanent contact, m
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

/// Computes the steady state of a viscoelastic body under a periodic trajectory without slip
/// (docs/theory.md, section 9).
///
///     auto loss = viscoelastic_damping(law, prony, sample(motion, 1e-8, 512));
///
/// The springs of the foundation are those of viscoelastic_indentation(), with G* for the
/// tangential stiffness in place of E*; a spring that separates loses its tangential force at once.
/// The periodic state of each spring is found by Newton's method, without waiting for it; springs
/// in permanent contact are treated as one. With drift (case (b)) their force grows without bound,
/// but their loss does not.
/// law, prony  as in viscoelastic_indentation(); G* must be known
/// trajectory  one period, straight between the samples; second order in their number
/// springs     over the ring that opens and closes, second order
/// throws      InvalidInput as viscoelastic_indentation(), and for a trajectory that is not valid;
///             Interrupted where on_progress, which counts springs, says stop
/// cost        about 10 × samples × springs × terms
ViscoelasticDamping viscoelastic_damping(const IndenterLaw& law, const PronySeries& prony,
                                         const SampledMotion& trajectory, int springs = 200,
                                         const Progress& on_progress = {});

/// The same for a named motion, with the moduli at its frequency and the loss of the elastic body
/// of the relaxed modulus.
struct ViscoelasticLoss {
  double angular_frequency = 0;                  ///< ω of the normal motion, rad/s
  double storage_modulus = 0, loss_modulus = 0;  ///< of the shear modulus at this frequency, Pa
  double elastic_work = 0;                       ///< loss of the elastic body, J
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
  int springs = 200;  ///< over the ring that opens and closes
  Progress on_progress = {};
};

/// Computes the losses of a motion about an indentation, m.
/// throws  as relaxation_damping() for the elastic body, which is computed first, and as
///         viscoelastic_damping()
ViscoelasticLoss viscoelastic_loss(const IndenterLaw& law, const PronySeries& prony,
                                   const Oscillation& motion, double indentation,
                                   const ViscoelasticOptions& options = {});

}  // namespace salebra
