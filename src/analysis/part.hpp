// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <string>

/// A part that is larger or smaller than the sample whose law is known. At the same pressure part
/// and sample have the same indentation; forces and stiffnesses are proportional to the area.
namespace salebra {

/// The curve of a part with this nominal area, m² > 0. A curve that has only pressures, and no
/// forces or stiffnesses, needs no area of its own.
/// source  name of the curve in error messages
/// throws  InvalidInput if the curve has forces or stiffnesses and does not state its nominal area
ForceCurve curve_of_part(ForceCurve curve, double area, const std::string& source);

/// The law of a part whose area is `ratio` times that of the sample.
std::unique_ptr<const ContactLaw> law_of_part(std::shared_ptr<const ContactLaw> sample,
                                              double ratio);

}  // namespace salebra
