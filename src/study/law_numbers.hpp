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
  // Numbers at the pressures and with the motion of a configuration if at given forces the gaps of
  // the contacts change by gap_change, m, and ln A as if the forces fell by the factor exp(area_shift).
  // coarser: with a polynomial of two degrees less, whose results show the error of the fit.
  BoundaryElementNumbers::OfSurface numbers(const StudyConfiguration& configuration,
                                            const std::vector<double>& gap_change,
                                            double area_shift, bool coarser) const;

 private:
  GapGradient gradient_;
  double modulus_ratio_, area_;
};

}  // namespace salebra::detail
