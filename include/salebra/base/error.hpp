// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace salebra {

/// Base class of all exceptions that salebra throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's value or file is unusable; nothing was computed or written. The CLI exits with 2.
/// what() is one line, "field: value constraint; remedy", without empty parts. A program that has
/// other names for the fields, such as options, can compose its own message from field(), value(),
/// constraint() and remedy().
///     throw InvalidInput("width", "-1", "must be > 0; leave it out for none");
class InvalidInput : public Error {
 public:
  /// demand: "constraint; remedy", which continues the sentence after the value, e.g. "must be > 0;
  /// leave it out for none".
  InvalidInput(std::string_view field, std::string_view value, std::string_view demand);
  /// Error without a value, e.g. if the field is a file and the demand says what is wrong with the
  /// file: "holds no numbers".
  InvalidInput(std::string_view field, std::string_view demand) : InvalidInput(field, "", demand) {}

  const std::string& field() const noexcept { return parts_->field; }  ///< an argument or a file
  const std::string& value() const noexcept { return parts_->value; }
  const std::string& constraint() const noexcept { return parts_->constraint; }
  const std::string& remedy() const noexcept { return parts_->remedy; }
  std::string statement() const;  ///< what() without the field: "value constraint; remedy"

 private:
  struct Parts {
    std::string field, value, constraint, remedy;
  };
  std::shared_ptr<const Parts> parts_;  // a copy of an exception must not throw
};

/// The operating system refused a read or a write (disk full, no permission, broken disk). The CLI
/// exits with 1.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A computation did not reach its tolerance, and no result object can report it. The CLI exits
/// with 1.
class NotConverged : public Error {
 public:
  using Error::Error;
};

/// A progress callback returned false, and the computation has no usable result. The CLI exits with
/// 130.
class Interrupted : public Error {
 public:
  using Error::Error;
};

/// Throws InvalidInput(field, value, demand) unless ok.
template <class T>
void require(bool ok, std::string_view field, const T& value, std::string_view demand) {
  if (ok) return;
  std::ostringstream text;
  text.precision(12);
  text << value;
  throw InvalidInput(field, text.str(), demand);
}

/// Throws InvalidInput(field, demand) unless ok, for errors without a value, e.g. with the demand
/// "given together with size_x; give one of them".
void require_that(bool ok, std::string_view field, std::string_view demand);

/// Throws InvalidInput unless exactly one of two inputs is given; `field` and `other` are their
/// names.
void require_one(bool given, std::string_view field, bool other_given, std::string_view other);

/// Throws InvalidInput unless value is > 0 and finite.
void require_positive(double value, std::string_view field);

}  // namespace salebra
