// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <string>

/// A part is larger or smaller than the sample that its law was found on. Under the same pressure it
/// has the same indentations, and forces and stiffnesses in proportion to its area.
namespace salebra {

/// The curve of a part of this area, m² > 0. A curve of pressures alone needs no area of its own.
/// source  what messages call the curve
/// throws  InvalidInput where the curve has forces or stiffnesses and does not state their area
ForceCurve curve_of_part(ForceCurve curve, double area, const std::string& source);

/// The law of a part of `ratio` times the area of the sample.
std::unique_ptr<const ContactLaw> law_of_part(std::shared_ptr<const ContactLaw> sample,
                                              double ratio);

}  // namespace salebra
