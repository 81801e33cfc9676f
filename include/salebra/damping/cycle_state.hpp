// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/tangential/coupled_contact.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/cycle.hpp>
#include <variant>
#include <vector>

namespace salebra {

/// A restart point of a simulated cycle: a simulation continued from it gives bit-identical
/// results.
///
///     options.on_state = [&](CycleState state) { saved = std::move(state); };
struct CycleState {
  int period = 0;                ///< periods finished
  int step = 0;                  ///< index of the last sample, from 0 to CycleOptions::steps
  ContactSet smallest, largest;  ///< cells in contact at every, and at any step of the period so
                                 ///< far
  double tangential = 0;         ///< x of the trajectory, m
  double energy_at_period_start = 0;       ///< stored elastic energy, J
  double work_at_period_start = 0;         ///< ∫F_x dx, J
  double normal_work_at_period_start = 0;  ///< ∫F dδ, J
  double gap_work_at_period_start = 0;     ///< J
  Field loss_at_period_start;              ///< (nx, ny), J in each cell; empty without slip
  double last_work = 0;                    ///< work_per_cycle of the previous period, J
  std::vector<CycleSample> samples;        ///< samples of the current period
  std::variant<StuckState, SlidingState, CoupledState> body;
};

constexpr void describe(auto&& visit, std::type_identity<CycleState>) {
  using enum Dimension;
  using S = CycleState;
  visit(&S::period, Kept{"period", "periods finished"});
  visit(&S::step, Kept{"step", "of the last sample"});
  visit(&S::smallest, Kept{"smallest", "1 in contact at every step of the period"});
  visit(&S::largest, Kept{"largest", "1 in contact at any step of the period"});
  visit(&S::tangential, Kept{"tangential", "tangential position", length});
  visit(&S::energy_at_period_start,
        Kept{"energy_at_period_start", "stored energy at the start of the period", energy});
  visit(&S::work_at_period_start,
        Kept{"work_at_period_start", "work of the tangential force before the period", energy});
  visit(&S::normal_work_at_period_start,
        Kept{"normal_work_at_period_start", "work of the normal force before the period", energy});
  visit(&S::gap_work_at_period_start,
        Kept{"gap_work_at_period_start", "work across gaps before the period", energy});
  visit(&S::loss_at_period_start,
        Kept{"loss_at_period_start", "energy dissipated in each cell before the period", energy});
  visit(&S::last_work, Kept{"last_work", "work_per_cycle of the period before", energy});
  visit(&S::samples, Table{"samples", "of the period"});
  visit(&S::body, Kept{"body", "what the contact remembers"});
}

}  // namespace salebra
