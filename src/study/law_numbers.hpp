// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
#include <vector>

#include "boundary_element_numbers.hpp"
#include "gap_gradient.hpp"

namespace salebra::detail {

// The numbers of one surface of a study from a smooth law of its contacts, and those after small
// changes of the surface, its loads and its motion, which need no further contacts. The gap and
// ln of the area are polynomials of ln F, fitted to contacts at the pressures of the study, between
// them, and over the range that the oscillation passes. K follows from the slope of the gap,
// K_t is (G*/E*)K, and the losses are those of this law.
class LawNumbers {
 public:
  // Whether the contacts of a study have such a law: on half-spaces without plasticity.
  static bool possible(const StudyConfiguration& configuration);

  // Solves the contacts. Throws NotConverged if fewer than four converge, and Interrupted if
  // progress says stop.
  LawNumbers(const Surface& surface, const StudyConfiguration& configuration,
             const Progress& progress);

  const GapGradient& gradient() const { return gradient_; }
  // What becomes of the contacts, without new ones: their forces and gaps are multiplied by factors,
  // which similarity gives, and the gaps change by amounts, m, which the response of the gap gives.
  struct Change {
    double force_factor = 1, gap_factor = 1;
    std::vector<double> gap_change = {};
  };
  // Fits that show the error of the law: with polynomials of fewer degrees, or without each contact
  // number `omitted`, `omitted` + 4, … between the ends.
  struct Fit {
    Index fewer_degrees = 0, omitted = 4;
  };
  // Numbers at the pressures and with the motion of a configuration.
  BoundaryElementNumbers::OfSurface numbers(const StudyConfiguration& configuration,
                                            const Change& change, const Fit& fit) const;

 private:
  GapGradient gradient_;
  double modulus_ratio_, area_;
};

}  // namespace salebra::detail
