// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace salebra {

/// Root of everything that salebra throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's value or file is unusable; nothing was computed or written. The CLI exits with 2.
/// The message is one line: "<field or file>: <value> <violated constraint>; <what to do>".
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// The operating system refused a read or a write (disk full, no permission, broken disk). The CLI exits with 1.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A computation ended without reaching the tolerance asked, where no result object could say so. The CLI exits with 1.
class NotConverged : public Error {
 public:
  using Error::Error;
};

/// A progress callback returned false where the work so far is of no use. The CLI exits with 130.
class Interrupted : public Error {
 public:
  using Error::Error;
};

/// Throws InvalidInput "<field>: <value> <constraint>" unless ok.
/// constraint reads on from the value: "must be > 0", "is not a number; remove or fill undefined points".
template <class T>
void require(bool ok, std::string_view field, const T& value, std::string_view constraint) {
  if (ok) return;
  std::ostringstream message;
  message.precision(12);
  message << field << ": " << value << ' ' << constraint;
  throw InvalidInput(message.str());
}

/// require(value > 0 and finite).
void require_positive(double value, std::string_view field);

}  // namespace salebra
