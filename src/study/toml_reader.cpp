// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a TOML table key by key, with errors that name file, line and key.
#include "toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <salebra/base/error.hpp>
#include <sstream>

#include "base/suggestion.hpp"

namespace salebra::detail {
namespace {

std::string written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  std::string one_line = text.str();
  std::ranges::replace(one_line, '\n', ' ');
  return one_line;
}

/// Refuses a key of many parts, such as a.b.c. The TOML library makes a table of each part and
/// destroys these tables by recursion, so a key of 60,000 parts would exhaust the stack. (The
/// library itself limits the nesting of values.) Dots in strings count as parts too; decimal points
/// do not.
void require_shallow_keys(std::string_view text, const std::string& name) {
  constexpr int most = 32;
  const auto is_word = [](char symbol) {
    return std::isalnum(static_cast<unsigned char>(symbol)) || symbol == '_' || symbol == '-' ||
           symbol == '+' || symbol == '.';
  };
  int parts = 0, line = 1;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\n') {
      ++line;
      parts = 0;
    }
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = std::find_if_not(begin, text.end(), is_word);
    int dots = 0;  // groups of dots in this key
    for (auto at = begin; at != end; ++at) dots += *at == '.' && (at == begin || at[-1] != '.');
    const bool number = dots == 1 && std::isdigit(static_cast<unsigned char>(*begin));
    if (!number) parts += std::min(dots, most + 1);
    if (parts > most)
      throw InvalidInput(fmt::format("{}:{}", name, line),
                         fmt::format("has a key of more than {} parts; correct it", most));
    i = std::max(i + 1, static_cast<std::size_t>(end - text.begin()));
  }
}

}  // namespace

/// A table, and the document to which it belongs.
struct TomlTable::Content {
  std::shared_ptr<const toml::table> document;
  const toml::table* table;
};

struct TomlTable::Access {
  static const toml::node* find(TomlTable& table, std::string_view key) {
    table.asked_.emplace(key);
    return table.content_->table->get(key);
  }
  static double quantity_of(const TomlTable& table, const toml::node& node, std::string_view key,
                            Dimension dimension);
};

TomlTable::TomlTable(std::string file, std::string path, Content content, std::uint32_t line)
    : file_(std::move(file)),
      path_(std::move(path)),
      content_(std::make_shared<const Content>(std::move(content))),
      line_(line) {}

TomlTable TomlTable::parse(const std::string& text, const std::string& name) {
  require_shallow_keys(text, name);
  try {
    auto document = std::make_shared<const toml::table>(toml::parse(text, name));
    return TomlTable(name, "", {document, document.get()}, 1);
  } catch (const toml::parse_error& error) {
    throw InvalidInput(fmt::format("{}:{}", name, error.source().begin.line),
                       fmt::format("is not TOML: {}", error.description()));
  }
}

bool TomlTable::has(std::string_view key) const { return content_->table->contains(key); }

std::string TomlTable::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

std::uint32_t TomlTable::line_of(std::string_view key) const {
  for (const auto& [name, node] : *content_->table) {
    if (name.str() == key) return name.source().begin.line;
  }
  return line_;
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  throw InvalidInput(fmt::format("{}:{}: {}", file_, line_of(key), path_of(key)), message);
}

void TomlTable::fail(std::string_view key, const InvalidInput& refusal) const {
  throw InvalidInput(
      fmt::format("{}:{}: {}: {}", file_, line_of(key), path_of(key), refusal.field()),
      refusal.statement());
}

void TomlTable::check(bool ok, std::string_view key, const std::string& message) const {
  if (!ok) fail(key, message);
}

void TomlTable::rethrow_located(const InvalidInput& refusal) const {
  fail(refusal.field(), refusal.statement());
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  check(node->is_table(), key,
        fmt::format("{} must be a table; write [{}]", written(*node), path_of(key)));
  return TomlTable(file_, path_of(key), {content_->document, node->as_table()},
                   node->source().begin.line);
}

TomlTable TomlTable::required_table(std::string_view key) {
  auto found = table(key);
  if (!found) fail(key, fmt::format("this table is missing; add [{}]", path_of(key)));
  return *found;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = Access::find(*this, key);
  std::vector<TomlTable> all;
  if (!node) return all;
  check(node->is_array_of_tables(), key, "must be tables; write [[" + path_of(key) + "]]");
  for (const toml::node& one : *node->as_array())
    all.push_back(TomlTable(file_, path_of(key), {content_->document, one.as_table()},
                            one.source().begin.line));
  return all;
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  check(node->is_string(), key, written(*node) + " must be a string; put it in quotes");
  return node->value<std::string>();
}

std::optional<bool> TomlTable::flag(std::string_view key) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  check(node->is_boolean(), key, written(*node) + " must be true or false");
  return node->value<bool>();
}

std::vector<std::string> TomlTable::texts(std::string_view key) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  std::vector<std::string> all;
  const auto add = [&](const toml::node& item) {
    check(item.is_string(), key, written(item) + " must be a string; put it in quotes");
    all.push_back(*item.value<std::string>());
  };
  if (const toml::array* array = node->as_array()) {
    for (const toml::node& item : *array) add(item);
  } else {
    add(*node);
  }
  return all;
}

std::optional<std::size_t> TomlTable::choice(std::string_view key,
                                             const std::vector<std::string>& names) {
  const auto given = text(key);
  if (!given) return {};
  const auto found = std::ranges::find(names, *given);
  check(found != names.end(), key,
        fmt::format("'{}' is not known{}; write one of {}", *given, did_you_mean(*given, names),
                    fmt::join(names, ", ")));
  return std::size_t(found - names.begin());
}

double TomlTable::Access::quantity_of(const TomlTable& table, const toml::node& node,
                                      std::string_view key, Dimension dimension) {
  table.check(node.is_number() || node.is_string(), key,
              written(node) + " must be a number, or a string with a unit");
  const auto number = node.is_number() ? node.value<double>() : std::nullopt;
  table.check(std::isfinite(number.value_or(0)), key, "must be a finite number");
  try {
    if (number) {
      require_squarable(*number, fmt::format("{}", *number), key);
      return *number;
    }
    return parse_quantity(*node.value<std::string>(), dimension, key);
  } catch (const InvalidInput& error) {
    table.rethrow_located(error);
  }
}

std::optional<double> TomlTable::quantity(std::string_view key, Dimension dimension) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  return Access::quantity_of(*this, *node, key, dimension);
}

double TomlTable::required_quantity(std::string_view key, Dimension dimension) {
  const auto value = quantity(key, dimension);
  if (!value) {
    // If a key of the table has a similar name, it is the required key, misspelt.
    for (const auto& [name, node] : *content_->table)
      if (!nearest_name(name.str(), {std::string(key)}).empty())
        fail(name.str(), fmt::format("this key is not known (did you mean {}?)", key));
    throw InvalidInput(fmt::format("{}:{}: {}", file_, line_, path_of(key)),
                       fmt::format("is missing; add it to [{}]", path_));
  }
  return *value;
}

std::vector<double> TomlTable::values(std::string_view key, Dimension dimension) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  std::vector<double> all;
  if (const toml::array* array = node->as_array()) {
    std::string list;
    bool texts = false;
    for (const toml::node& item : *array) {
      all.push_back(Access::quantity_of(*this, item, key, dimension));
      texts = texts || item.is_string();
      list += (list.empty() ? "" : ",") +
              (item.is_string() ? *item.value<std::string>() : fmt::format("{}", all.back()));
    }
    check(!all.empty(), key, "must not be empty");
    try {
      if (texts) all = parse_values(list, dimension, key);
    } catch (const InvalidInput& error) {
      rethrow_located(error);
    }
  } else if (node->is_string()) {
    try {
      all = parse_values(*node->value<std::string>(), dimension, key);
    } catch (const InvalidInput& error) {
      rethrow_located(error);
    }
  } else {
    all.push_back(Access::quantity_of(*this, *node, key, dimension));
  }
  return all;
}

std::vector<std::vector<double>> TomlTable::rows(std::string_view key, Dimension dimension) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  std::vector<std::vector<double>> all;
  const toml::array* outer = node->as_array();
  check(outer != nullptr, key, "must be an array of rows, such as [[1, 2], [3, 4]]");
  for (const toml::node& item : *outer) {
    const toml::array* row = item.as_array();
    check(row != nullptr, key, written(item) + " must be a row, such as [1, 2]");
    all.emplace_back();
    for (const toml::node& number : *row)
      all.back().push_back(Access::quantity_of(*this, number, key, dimension));
  }
  return all;
}

std::vector<std::int64_t> TomlTable::integers(std::string_view key) {
  const toml::node* node = Access::find(*this, key);
  if (!node) return {};
  std::vector<std::int64_t> all;
  const auto add = [&](const toml::node& item) {
    check(item.is_integer(), key, written(item) + " must be a whole number");
    all.push_back(*item.value<std::int64_t>());
  };
  if (const toml::array* array = node->as_array()) {
    for (const toml::node& item : *array) add(item);
    check(!all.empty(), key, "must not be empty");
  } else {
    add(*node);
  }
  return all;
}

void TomlTable::require_no_other_keys() const {
  for (const auto& [name, node] : *content_->table) {
    const std::string key(name.str());
    if (!asked_.contains(key)) {
      const std::vector<std::string> known(asked_.begin(), asked_.end());
      fail(key, fmt::format("this key is not known{}; known here are {}", did_you_mean(key, known),
                            fmt::join(known, ", ")));
    }
  }
}

}  // namespace salebra::detail
