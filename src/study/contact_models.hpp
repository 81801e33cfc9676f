// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/summits.hpp>
#include <vector>

namespace salebra::detail {

/// What a contact model presses. It returns its curve, and what only it knows of a ModelResult.
/// Boundary elements press a surface that is spread over processes; all other models are of
/// numbers, and computed by the first process.
struct ModelWork {
  const StudyConfiguration& configuration;
  const Surface& surface;
  const SummitList& summits;                  ///< of all processes, in the first one
  const std::vector<RoughnessShell>& shells;  ///< of Persson's theory; empty where nobody asked
  const std::vector<double>& pressures;
  Realisation&
      realisation;    ///< has its statistics; boundary elements add spots and marks in the picture
  Progress progress;  ///< of this model; a stop throws Interrupted or returns anything
};

/// The modes that the surface has, ring by ring. Collective.
std::vector<RoughnessShell> shells_of(const Surface& surface);

}  // namespace salebra::detail
