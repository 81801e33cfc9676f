// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <utility>
#include <vector>

namespace salebra::detail {

// Contacts of one surface, and how their mean gap responds to small changes of the heights. At a
// given force and with the pressure w of a flat punch on the contact set,
//     d⟨gap⟩ = Σ w dh/Σ w − ⟨dh⟩,
// so that a change needs no contact of its own: the pressures dp of the changed contact meet
// G dp = dh − dD on the set and Σ dp = 0, with the approach dD, and Gw = 1 there. Cells that enter or
// leave change the gap in second order.
class GapGradient {
 public:
  // Solves contacts at more loads, each with one punch solve; those that do not converge are left
  // out. Throws Interrupted if progress says stop.
  void solve(const Surface& surface, const Body& body, const std::vector<double>& pressures,
             const NormalContactOptions& options);

  struct Contact {
    ForceSample sample;                             // with K, without K_t
    std::vector<std::pair<Index, double>> weights;  // cells in contact and w/Σw there
  };
  // With increasing forces.
  const std::vector<Contact>& contacts() const { return contacts_; }
  // d⟨gap⟩/dε, m, of each contact for the heights h + ε·change.
  std::vector<double> response(const Field& change) const;

 private:
  std::vector<Contact> contacts_;
};

}  // namespace salebra::detail
