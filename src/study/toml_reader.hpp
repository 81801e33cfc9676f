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

/// One table of a TOML document, read key by key. Keys that were never read count as unknown. Each
/// error is an InvalidInput of the form "FILE:LINE: table.key: value constraint".
class TomlTable {
 public:
  /// Parses a whole document. name: name of its file, for error messages.
  static TomlTable parse(const std::string& text, const std::string& name);

  bool has(std::string_view key) const;
  std::optional<TomlTable> table(std::string_view key);
  TomlTable required_table(std::string_view key);
  /// The tables of an array of tables [[key]], in the order of the document.
  std::vector<TomlTable> tables(std::string_view key);

  std::optional<std::string> text(std::string_view key);
  /// The strings of an array, or a single string.
  std::vector<std::string> texts(std::string_view key);
  std::optional<bool> flag(std::string_view key);
  /// The index in `names` of the text with this key.
  std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string>& names);
  /// A quantity in SI units, given as a number or as a text with a unit.
  std::optional<double> quantity(std::string_view key, Dimension dimension);
  double required_quantity(std::string_view key, Dimension dimension);
  /// A list of quantities, given as one quantity, an array of quantities, or a text that
  /// parse_values() can read.
  std::vector<double> values(std::string_view key, Dimension dimension);
  /// The rows of a matrix of quantities, given as an array of arrays; empty without the key.
  std::vector<std::vector<double>> rows(std::string_view key, Dimension dimension);
  std::vector<std::int64_t> integers(std::string_view key);

  /// Throws InvalidInput that names the line of the key.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// Throws the refusal of the file that the key names, behind the line of the key.
  [[noreturn]] void fail(std::string_view key, const InvalidInput& refusal) const;
  void check(bool ok, std::string_view key, const std::string& message) const;
  /// Runs a check of the library. If it throws, adds to its error the file, and the line of the key
  /// that the error names.
  template <class Action>
  auto located(Action action) const {
    try {
      return action();
    } catch (const InvalidInput& error) {
      rethrow_located(error);
    }
  }

  /// Throws for the first key that was not read.
  void require_no_other_keys() const;

 private:
  struct Content;  // hides the types of the TOML library, which only one source file includes
  struct Access;

  /// line: that of the table header, for errors about missing keys.
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
