// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gsl/gsl_errno.h>

namespace salebra::detail {

/// Switches GSL's error handler off, once. The handler would end the program on an underflow of a
/// Bessel function or a failed allocation. Without a handler, GSL returns a status that the caller
/// must check. A handler that a program sets later stays in effect.
inline void quiet_gsl() {
  static const auto previous_handler = gsl_set_error_handler_off();
  static_cast<void>(previous_handler);
}

}  // namespace salebra::detail
