// SPDX-License-Identifier: GPL-3.0-or-later
// One TOML table read key by key, with errors that name file, line and key.
#include "toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <salebra/base/error.hpp>
#include <salebra/base/suggestion.hpp>
#include <sstream>

namespace salebra::detail {
namespace {

std::string written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  std::string one_line = text.str();
  std::ranges::replace(one_line, '\n', ' ');
  return one_line;
}

}  // namespace

TomlTable::TomlTable(std::string file, std::string path, const toml::table& table,
                     std::uint32_t line)
    : file_(std::move(file)), path_(std::move(path)), table_(&table), line_(line) {}

std::string TomlTable::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

std::uint32_t TomlTable::line_of(std::string_view key) const {
  for (const auto& [name, node] : *table_) {
    if (name.str() == key) return name.source().begin.line;
  }
  return line_;
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  throw InvalidInput(fmt::format("{}:{}: {}: {}", file_, line_of(key), path_of(key), message));
}

void TomlTable::check(bool ok, std::string_view key, const std::string& message) const {
  if (!ok) fail(key, message);
}

void TomlTable::rethrow_located(const std::string& message) const {
  const auto colon = message.find(": ");
  if (colon == std::string::npos) {
    throw InvalidInput(fmt::format("{}:{}: {}", file_, line_, message));
  }
  fail(message.substr(0, colon), message.substr(colon + 2));
}

const toml::node* TomlTable::find(std::string_view key) {
  asked_.emplace(key);
  return table_->get(key);
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return {};
  check(node->is_table(), key,
        fmt::format("{} must be a table; write [{}]", written(*node), path_of(key)));
  return TomlTable(file_, path_of(key), *node->as_table(), node->source().begin.line);
}

TomlTable TomlTable::required_table(std::string_view key) {
  auto found = table(key);
  if (!found) fail(key, fmt::format("this table is missing; add [{}]", path_of(key)));
  return *found;
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return {};
  check(node->is_string(), key, written(*node) + " must be a string; put it in quotes");
  return node->value<std::string>();
}

std::vector<std::string> TomlTable::texts(std::string_view key) {
  const toml::node* node = find(key);
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

double TomlTable::quantity_of(const toml::node& node, std::string_view key,
                              Dimension dimension) const {
  if (const auto number = node.value<double>(); number && (node.is_number())) {
    check(std::isfinite(*number), key, "must be a finite number");
    return *number;
  }
  check(node.is_string(), key, written(node) + " must be a number, or a string with a unit");
  try {
    return parse_quantity(*node.value<std::string>(), dimension, key);
  } catch (const InvalidInput& error) {
    rethrow_located(error.what());
  }
}

std::optional<double> TomlTable::quantity(std::string_view key, Dimension dimension) {
  const toml::node* node = find(key);
  if (!node) return {};
  return quantity_of(*node, key, dimension);
}

double TomlTable::required_quantity(std::string_view key, Dimension dimension) {
  const auto value = quantity(key, dimension);
  if (!value) {
    // A misspelt key is no other than the missing one.
    for (const auto& [name, node] : *table_)
      if (!nearest_name(name.str(), {std::string(key)}).empty())
        fail(name.str(), fmt::format("this key is not known (did you mean {}?)", key));
    throw InvalidInput(
        fmt::format("{}:{}: {}: is missing; add it to [{}]", file_, line_, path_of(key), path_));
  }
  return *value;
}

std::vector<double> TomlTable::values(std::string_view key, Dimension dimension) {
  const toml::node* node = find(key);
  if (!node) return {};
  std::vector<double> all;
  if (const toml::array* array = node->as_array()) {
    for (const toml::node& item : *array) all.push_back(quantity_of(item, key, dimension));
    check(!all.empty(), key, "must not be empty");
  } else if (node->is_string()) {
    try {
      all = parse_values(*node->value<std::string>(), dimension, key);
    } catch (const InvalidInput& error) {
      rethrow_located(error.what());
    }
  } else {
    all.push_back(quantity_of(*node, key, dimension));
  }
  return all;
}

std::vector<std::int64_t> TomlTable::integers(std::string_view key) {
  const toml::node* node = find(key);
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
  for (const auto& [name, node] : *table_) {
    const std::string key(name.str());
    if (!asked_.contains(key)) {
      const std::vector<std::string> known(asked_.begin(), asked_.end());
      fail(key, fmt::format("this key is not known{}; known here are {}", did_you_mean(key, known),
                            fmt::join(known, ", ")));
    }
  }
}

}  // namespace salebra::detail
