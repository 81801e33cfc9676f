// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gsl/gsl_errno.h>

namespace salebra::detail {

/// GSL's handler of errors ends the program: underflow of a Bessel function, an allocation that
/// fails. Without it they are statuses, and the caller answers for each. Switched off once; a
/// program that sets a handler of its own afterwards keeps it.
inline void quiet_gsl() {
  static const auto previous_handler = gsl_set_error_handler_off();
  static_cast<void>(previous_handler);
}

}  // namespace salebra::detail
