// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace salebra::detail {

/// One table of a TOML document, read key by key; what was never asked for is an unknown key.
/// Each error is InvalidInput "FILE:LINE: table.key: value constraint".
class TomlTable {
 public:
  /// The whole of a document; name is its file's, for errors.
  static TomlTable parse(const std::string& text, const std::string& name);

  bool has(std::string_view key) const;
  std::optional<TomlTable> table(std::string_view key);
  TomlTable required_table(std::string_view key);
  /// The tables [[key]] in their order.
  std::vector<TomlTable> tables(std::string_view key);

  std::optional<std::string> text(std::string_view key);
  /// Strings of an array, or one.
  std::vector<std::string> texts(std::string_view key);
  std::optional<bool> flag(std::string_view key);
  /// One of the names, given back as its place in them.
  std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string>& names);
  /// A number, or a string with a unit.
  std::optional<double> quantity(std::string_view key, Dimension dimension);
  double required_quantity(std::string_view key, Dimension dimension);
  /// A quantity, an array of them, or a string as parse_values takes it.
  std::vector<double> values(std::string_view key, Dimension dimension);
  std::vector<std::int64_t> integers(std::string_view key);

  /// Throws InvalidInput at the key's line.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  void check(bool ok, std::string_view key, const std::string& message) const;
  /// Runs the library's own check and adds file and line to what it throws, by the key that it
  /// names.
  template <class Action>
  auto located(Action action) const {
    try {
      return action();
    } catch (const InvalidInput& error) {
      rethrow_located(error);
    }
  }

  /// Throws for the first unused key.
  void require_no_other_keys() const;

 private:
  struct Content;  // types of the TOML library, which one source knows
  struct Access;

  /// line stands for the table itself where it lacks a key.
  TomlTable(std::string file, std::string path, Content content, std::uint32_t line);
  std::uint32_t line_of(std::string_view key) const;
  std::string path_of(std::string_view key) const;
  [[noreturn]] void rethrow_located(const InvalidInput& refusal) const;

  std::string file_, path_;
  std::shared_ptr<const Content> content_;
  std::uint32_t line_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace salebra::detail
