// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <salebra/base/communicator.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Values as bytes and back, for pickle and for ==: every member of a struct in the order of its
/// declaration, which its description lists. One function walks a value for both directions.
namespace salebra::python {

/// What stands for any member when those of an aggregate are counted. Not for an optional: it would
/// be made of this in two ways.
struct AnyMember {
  template <class T>
  requires(!requires(T value) { value.has_value(); }) operator T() const;
};

template <class T, class... Members>
consteval std::size_t member_count() {
  if constexpr (requires { T{Members{}..., AnyMember{}}; })
    return member_count<T, Members..., AnyMember>();
  else
    return sizeof...(Members);
}

/// visit(members…) of an aggregate without bases.
template <class T, class Visitor>
void visit_members(T& value, Visitor&& visit) {
  constexpr std::size_t count = member_count<std::remove_const_t<T>>();
  static_assert(count >= 1 && count <= 32, "add a line below");
#define SALEBRA_MEMBERS(number, ...) \
  if constexpr (count == (number)) { \
    auto& [__VA_ARGS__] = value;     \
    visit(__VA_ARGS__);              \
  }
  SALEBRA_MEMBERS(1, a)
  SALEBRA_MEMBERS(2, a, b)
  SALEBRA_MEMBERS(3, a, b, c)
  SALEBRA_MEMBERS(4, a, b, c, d)
  SALEBRA_MEMBERS(5, a, b, c, d, e)
  SALEBRA_MEMBERS(6, a, b, c, d, e, f)
  SALEBRA_MEMBERS(7, a, b, c, d, e, f, g)
  SALEBRA_MEMBERS(8, a, b, c, d, e, f, g, h)
  SALEBRA_MEMBERS(9, a, b, c, d, e, f, g, h, i)
  SALEBRA_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
  SALEBRA_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
  SALEBRA_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
  SALEBRA_MEMBERS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
  SALEBRA_MEMBERS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
  SALEBRA_MEMBERS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
  SALEBRA_MEMBERS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
  SALEBRA_MEMBERS(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
  SALEBRA_MEMBERS(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
  SALEBRA_MEMBERS(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
  SALEBRA_MEMBERS(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
  SALEBRA_MEMBERS(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
  SALEBRA_MEMBERS(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
  SALEBRA_MEMBERS(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
  SALEBRA_MEMBERS(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
  SALEBRA_MEMBERS(25, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y)
  SALEBRA_MEMBERS(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z)
  SALEBRA_MEMBERS(27, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                  aa)
  SALEBRA_MEMBERS(28, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                  aa, bb)
  SALEBRA_MEMBERS(29, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                  aa, bb, cc)
  SALEBRA_MEMBERS(30, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                  aa, bb, cc, dd)
  SALEBRA_MEMBERS(31, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                  aa, bb, cc, dd, ee)
  SALEBRA_MEMBERS(32, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                  aa, bb, cc, dd, ee, ff)
#undef SALEBRA_MEMBERS
}

/// Appends what it is given.
class Writer {
 public:
  static constexpr bool reads = false;
  void raw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Takes from the front of what it was made of. Throws InvalidInput beyond its end.
class Reader {
 public:
  static constexpr bool reads = true;
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  void raw(void* data, std::size_t size) {
    if (size > rest_.size())
      throw InvalidInput("pickle", "ends too early; pickle the object again");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

template <class T>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<std::vector<T>> = true;
template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;
template <class T>
constexpr bool is_pair = false;
template <class A, class B>
constexpr bool is_pair<std::pair<A, B>> = true;
template <class T>
constexpr bool is_function = false;
template <class T>
constexpr bool is_function<std::function<T>> = true;
template <class T>
constexpr bool is_variant = false;
template <class... T>
constexpr bool is_variant<std::variant<T...>> = true;

template <class Archive, class T>
void archive(Archive& through, T& value);

/// A count of things of `size` bytes at least; a reader that has no such number left says so before
/// anything is allocated.
template <class Archive>
std::size_t archive_count(Archive& through, std::size_t count, std::size_t size) {
  through.raw(&count, sizeof count);
  if constexpr (Archive::reads)
    if (count > through.left() / size)
      throw InvalidInput("pickle", "ends too early; pickle the object again");
  return count;
}

/// Texts, lists and arrays: a count and what follows it.
template <class Archive, class List>
void archive_list(Archive& through, List& list) {
  using Item = std::remove_cvref_t<decltype(*list.begin())>;
  const std::size_t count = archive_count(through, list.size(), 1);
  if constexpr (Archive::reads) list.resize(count);
  if constexpr (std::is_arithmetic_v<Item> && !std::is_same_v<Item, bool>)
    through.raw(list.data(), count * sizeof(Item));
  else
    for (auto& item : list) archive(through, item);
}

template <class Archive, class T>
void archive_alternative(Archive& through, T& value) {
  std::size_t index = value.index();
  through.raw(&index, sizeof index);
  if constexpr (Archive::reads) {
    const auto choose = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return ((index == I && (value.template emplace<I>(), true)) || ...);
    };
    if (!choose(std::make_index_sequence<std::variant_size_v<T>>()))
      throw InvalidInput("pickle", "is damaged; pickle the object again");
  }
  std::visit([&](auto& held) { archive(through, held); }, value);
}

template <class Archive, class T>
void archive_field(Archive& through, T& value) {
  Eigen::Index rows = value.rows(), columns = value.cols();
  through.raw(&rows, sizeof rows);
  through.raw(&columns, sizeof columns);
  if constexpr (Archive::reads) {
    const auto left = static_cast<Eigen::Index>(through.left() / sizeof(typename T::Scalar));
    if (rows < 0 || columns < 0 || (columns > 0 && rows > left / columns))
      throw InvalidInput("pickle", "ends too early; pickle the object again");
    value.resize(rows, columns);
  }
  through.raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
}

template <class Archive, class T>
void archive(Archive& through, T& value) {
  using Plain = std::remove_const_t<T>;
  // A writer's values are constants by intent: it takes them as they are.
  auto& own = const_cast<Plain&>(value);
  if constexpr (std::is_arithmetic_v<Plain> || std::is_enum_v<Plain>) {
    through.raw(&own, sizeof own);
  } else if constexpr (std::is_same_v<Plain, std::string> || is_vector<Plain>) {
    archive_list(through, own);
  } else if constexpr (std::is_same_v<Plain, std::filesystem::path>) {
    std::string text = own.string();
    archive_list(through, text);
    if constexpr (Archive::reads) own = text;
  } else if constexpr (is_optional<Plain>) {
    bool there = own.has_value();
    through.raw(&there, sizeof there);
    if constexpr (Archive::reads) {
      if (there)
        own.emplace();
      else
        own.reset();
    }
    if (own) archive(through, *own);
  } else if constexpr (is_pair<Plain>) {
    archive(through, own.first);
    archive(through, own.second);
  } else if constexpr (is_variant<Plain>) {
    archive_alternative(through, own);
  } else if constexpr (std::is_base_of_v<Eigen::DenseBase<Plain>, Plain>) {
    archive_field(through, own);
  } else if constexpr (is_function<Plain> || std::is_same_v<Plain, Communicator>) {
    // Who is told of the progress and which processes are at work belongs to a call, not to the
    // value.
  } else if constexpr (requires { archive_members(through, own); }) {
    archive_members(through, own);
  } else if constexpr (Described<Plain>) {
    static_assert(describes_all<Plain>(), "describe every member, in the order of declaration");
    for_each_member<Plain>([&](auto member) { archive(through, own.*member); });
  } else {
    visit_members(own, [&](auto&... members) { (archive(through, members), ...); });
  }
}

template <class T>
std::string bytes_of(const T& value) {
  Writer writer;
  archive(writer, value);
  return writer.bytes();
}

template <class T>
T value_of(std::string_view bytes) {
  T value;
  Reader reader(bytes);
  archive(reader, value);
  return value;
}

}  // namespace salebra::python
