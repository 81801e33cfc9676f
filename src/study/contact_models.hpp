// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/summits.hpp>
#include <vector>

#include "damping/surface_contacts.hpp"

namespace salebra::detail {

/// Input of a contact model. The model returns its force curve and those members of ModelResult
/// that only this model knows. The boundary-element model presses a surface that may be spread over
/// processes. All other models need only numbers, and only the first process computes them.
struct ModelWork {
  const StudyConfiguration& configuration;
  const Surface& surface;
  /// The summits of the surface in all processes, gathered in the first one.
  const SummitList& summits;
  const std::vector<RoughnessShell>& shells;  ///< for Persson's theory; empty if not requested
  const std::vector<double>& pressures;
  const std::vector<double>& directions;  ///< of the tangential motion, from the x axis, rad
  double lay_angle;                       ///< of the flow factors, rad; NaN: no lay
  /// Has the statistics of the surface. The boundary-element model adds its contact patches, and
  /// marks the cells in contact in the picture.
  Realisation& realisation;
  /// Progress of this model. After a stop the model throws Interrupted or returns any result.
  Progress progress;
  /// Receives the contacts of the boundary-element model, if not null.
  KeptContacts* contacts = nullptr;
};

/// Direction of the lay of a surface of a study, from the x axis, rad; NaN without a lay.
/// Collective.
double lay_angle_of(const StudyConfiguration& configuration, const Surface& surface);

/// The modes of the surface, grouped in rings of the wavenumber. All processes must call.
std::vector<RoughnessShell> shells_of(const Surface& surface);

}  // namespace salebra::detail
