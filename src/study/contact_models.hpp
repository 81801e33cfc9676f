// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/summits.hpp>
#include <vector>

namespace salebra::detail {

/// What a contact model presses. It returns its curve, and what only it knows of a ModelResult.
struct ModelWork {
  const StudyConfiguration& configuration;
  const Surface& surface;
  const SummitList& summits;
  const std::vector<double>& pressures;
  Realisation&
      realisation;    ///< has its statistics; boundary elements add spots and marks in the picture
  Progress progress;  ///< of this model; a stop throws Interrupted or returns anything
};

}  // namespace salebra::detail
