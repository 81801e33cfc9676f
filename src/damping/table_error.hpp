// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/loss.hpp>
#include <utility>

namespace salebra::detail {

/// Returns the errors of a loss that was computed from the law of a table, J: `intervals` is the
/// change of the loss without every other sample, the larger of both halves, and for a motion that is
/// narrower than the distance between two samples also the scatter of the slope of ln K about
/// it, `first_touch` its change if the table continues
/// exponentially below its lowest sample. Unknown for a law that is not a table. Throws InvalidInput
/// if the springs below the lowest sample decide on the loss, so that it is a guess.
/// swing     lowest and highest indentation of the motion
/// lowest    lowest indentation of the springs that lose energy; −infinity: all of them
/// work      the loss, J
/// measure   the loss as loss_of() returns it, in any unit
/// loss_of   computes the loss of another law
ErrorBudget error_of_table(const ContactLaw& law, std::pair<double, double> swing, double lowest,
                           double work, double measure,
                           const std::function<double(const ContactLaw&)>& loss_of);

/// d ln(K_t/K)/d ln F of a law about an indentation, over a factor of two of the force below it.
double stiffness_ratio_exponent(const ContactLaw& law, double indentation);

}  // namespace salebra::detail
