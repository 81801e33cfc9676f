// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <salebra/base/communicator.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/base/error.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Converts values to bytes and back, for stored realisations of a study, checksums, Python's
/// pickle and the comparison ==. A described struct is written member by member in the order of
/// declaration. One function, archive(), handles reading and writing; it takes any archive class
/// that has a member function raw().
namespace salebra::detail {

/// Collects bytes by appending them.
class ByteWriter {
 public:
  static constexpr bool reads = false;
  void raw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Takes bytes from the front of its input. Reading beyond the end throws InvalidInput that names
/// the field given to the constructor.
class ByteReader {
 public:
  static constexpr bool reads = true;
  ByteReader(std::string_view bytes, std::string_view field) : rest_(bytes), field_(field) {}
  void raw(void* data, std::size_t size) {
    require(size <= rest_.size());
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  std::size_t left() const { return rest_.size(); }
  void require(bool sound) const {
    if (!sound) throw InvalidInput(field_, "is truncated or damaged; make it again");
  }

 private:
  std::string_view rest_, field_;
};

template <class T>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<std::vector<T>> = true;
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

/// Whether a member of type T is not stored: progress callbacks and communicators belong to a call,
/// not to the value. Other types may say so by a member type left_out.
template <class T>
constexpr bool is_left_out = is_function<T> || std::is_same_v<T, Communicator> ||
                             std::is_empty_v<T> || requires { typename T::left_out; };

/// Minimum number of bytes that an archived value of type T takes. A damaged file whose element
/// count does not fit into the remaining bytes is thus detected.
template <class T>
constexpr std::size_t min_bytes() {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return sizeof(T);
  } else if constexpr (requires(T pair) { pair.first, pair.second; }) {
    return min_bytes<typename T::first_type>() + min_bytes<typename T::second_type>();
  } else if constexpr (std::is_same_v<T, std::string> || is_vector<T> || is_variant<T>) {
    return sizeof(std::size_t);
  } else if constexpr (Described<T>) {
    std::size_t sum = 0;
    for_each_member<T>([&](auto member) {
      sum += min_bytes<std::remove_cvref_t<decltype(std::declval<T&>().*member)>>();
    });
    return sum;
  } else {
    return is_left_out<T> ? 0 : 1;
  }
}

/// Archives a string or list as a count followed by the elements. A count that is too large for the
/// remaining bytes is detected before memory is allocated for the elements.
template <class Archive, class List>
void archive_list(Archive& through, List& list) {
  using Item = std::remove_cvref_t<decltype(*list.begin())>;
  std::size_t count = list.size();
  through.raw(&count, sizeof count);
  if constexpr (Archive::reads) {
    through.require(count <= through.left() / std::max<std::size_t>(min_bytes<Item>(), 1));
    list.resize(count);
  }
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
    through.require(choose(std::make_index_sequence<std::variant_size_v<T>>()));
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
    through.require(rows >= 0 && columns >= 0 && (columns == 0 || rows <= left / columns));
    value.resize(rows, columns);
  }
  through.raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
}

template <class Archive, class T>
void archive(Archive& through, T& value) {
  using Plain = std::remove_const_t<T>;
  // A writer does not change the value; the cast lets writers and readers share this function.
  auto& own = const_cast<Plain&>(value);
  if constexpr (std::is_same_v<Plain, bool>) {
    unsigned char truth = own;
    through.raw(&truth, sizeof truth);
    if constexpr (Archive::reads) {
      through.require(truth <= 1);
      own = truth == 1;
    }
  } else if constexpr (std::is_arithmetic_v<Plain> || std::is_enum_v<Plain>) {
    through.raw(&own, sizeof own);
  } else if constexpr (std::is_same_v<Plain, std::string> || is_vector<Plain>) {
    archive_list(through, own);
  } else if constexpr (std::is_same_v<Plain, std::filesystem::path>) {
    std::string text = own.string();
    archive_list(through, text);
    if constexpr (Archive::reads) own = text;
  } else if constexpr (requires { own.emplace(), own.has_value(); }) {
    bool there = own.has_value();
    archive(through, there);
    if constexpr (Archive::reads) {
      if (!there) own.reset();
      if (there && !own) own.emplace();
    }
    if (own) archive(through, *own);
  } else if constexpr (requires { own.reset(), own.has_value(); }) {
    // An optional object without members, such as a linear body, is archived only where it is
    // absent.
    bool there = own.has_value();
    archive(through, there);
    if (there)
      throw InvalidInput("copy", "a configuration with a body",
                         "cannot be pickled or copied; make it again from its text");
    if constexpr (Archive::reads) own.reset();
  } else if constexpr (requires { own.first, own.second; }) {
    archive(through, own.first);
    archive(through, own.second);
  } else if constexpr (is_variant<Plain>) {
    archive_alternative(through, own);
  } else if constexpr (std::is_base_of_v<Eigen::DenseBase<Plain>, Plain>) {
    archive_field(through, own);
  } else if constexpr (!is_left_out<Plain>) {
    static_assert(describes_all<Plain>(), "describe every member, in the order of declaration");
    for_each_member<Plain>([&](auto member) { archive(through, own.*member); });
  }
}

template <class... T>
std::string bytes_of(const T&... values) {
  ByteWriter writer;
  (archive(writer, values), ...);
  return writer.bytes();
}

/// Returns the value at the start of `bytes`, which bytes_of() has made. Throws InvalidInput that
/// names `field` if the number of bytes does not match; other damage is not detected.
template <class T>
T from_bytes(std::string_view bytes, std::string_view field) {
  T value;
  ByteReader reader(bytes, field);
  archive(reader, value);
  return value;
}

}  // namespace salebra::detail
