// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace salebra {

/// A JSON value to write: null, boolean, number, text, array, or object whose members keep the
/// order in which they were added.
///     Json answer{{"area", 0.1}, {"spots", spots}}; // members; arrays come from std::vector
///     answer["unit"] = "m^2";                       // null becomes an object; push_back: an array
/// throws    std::logic_error if a value is not of the requested kind
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;

  /// The null value. It has copy functions of its own to avoid a fault of the standard library of
  /// GCC 12. That library assumes that a variant of trivial types, strings and vectors always has a
  /// value. If memory runs out during a copy, the process then ends with signal 11 instead of
  /// throwing std::bad_alloc. A variant that contains a type with its own copy functions is not
  /// affected.
  struct Null {
    Null() = default;
    Null(const Null&) noexcept {}
    Null& operator=(const Null&) noexcept { return *this; }
  };

  Json() = default;
  Json(std::nullptr_t) {}
  Json(bool truth) : value_(truth) {}
  template <std::integral T>
    requires(!std::same_as<T, bool>)
  Json(T number) {
    if constexpr (std::signed_integral<T>)
      value_ = static_cast<std::int64_t>(number);
    else
      value_ = static_cast<std::uint64_t>(number);
  }
  Json(double number) : value_(number) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string_view text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  template <class T>
  Json(const std::vector<T>& values) : value_(Array(values.begin(), values.end())) {}
  /// An object. If two members have the same key, the last one counts.
  Json(std::initializer_list<std::pair<std::string_view, Json>> members);
  /// An empty array and an empty object.
  static Json array();
  static Json object();

  bool is_null() const { return std::holds_alternative<Null>(value_); }
  bool is_boolean() const { return std::holds_alternative<bool>(value_); }
  bool is_number() const { return is_number_integer() || is_number_float(); }
  bool is_number_integer() const {
    return std::holds_alternative<std::int64_t>(value_) ||
           std::holds_alternative<std::uint64_t>(value_);
  }
  bool is_number_float() const { return std::holds_alternative<double>(value_); }
  bool is_string() const { return std::holds_alternative<std::string>(value_); }
  bool is_array() const { return std::holds_alternative<Array>(value_); }
  bool is_object() const { return std::holds_alternative<Object>(value_); }
  bool is_structured() const { return is_array() || is_object(); }

  bool truth() const;
  double number() const;
  const std::string& text() const;

  /// Number of members of an object or elements of an array; 0 for null, 1 for other values.
  std::size_t size() const;
  bool empty() const { return size() == 0; }
  bool contains(std::string_view key) const;

  /// The member with this key. If there is none, a member with the value null is added.
  Json& operator[](std::string_view key);
  const Json& operator[](std::string_view key) const;
  Json& operator[](std::size_t index);
  const Json& operator[](std::size_t index) const;
  void push_back(Json value);
  /// Adds those members of another object whose keys this object does not have.
  void add(const Json& object);
  /// Removes the member with this key, if there is one.
  void erase(std::string_view key);

  /// Pairs of key and value.
  Object& items() &;
  const Object& items() const&;
  const Object& items() const&& = delete;  // a loop over a temporary's items would outlive it
  /// Elements of an array.
  Array& elements() &;
  const Array& elements() const&;
  const Array& elements() const&& = delete;

  /// JSON text; on one line if indent < 0. Bytes that are not UTF-8, as in a file name, become
  /// U+FFFD; a number that is not finite becomes null.
  std::string dump(int indent = -1) const;

  using Value =
      std::variant<Null, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object>;
  const Value& value() const { return value_; }

 private:
  Value value_;
};

}  // namespace salebra
