// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/io/result_file.hpp>
#include <string>
#include <vector>

namespace salebra::detail {

/// The groups of one study in a results file, or of one point of its parameter grid.
class StudyGroups {
 protected:
  /// where: path in front of the names of the groups.
  StudyGroups(const ResultReader& file, const std::string& where) : file_(file), where_(where) {}

  bool has(const std::string& name) const { return file_.has(where_ + name); }

  std::string text(const std::string& group, const char* name) const {
    return file_.text_attribute(where_ + group, name).value_or("");
  }
  double attribute(const std::string& group, const char* name) const {
    return file_.number_attribute(where_ + group, name).value_or(ForceSample::unknown);
  }
  std::optional<std::vector<double>> column(const std::string& name) const {
    if (!has(name)) return {};
    return file_.numbers(where_ + name);
  }

  [[noreturn]] void refuse_damaged(const std::string& name, const std::string& what) const {
    throw InvalidInput(file_.file().string(),
                       fmt::format("{} {}; the file is damaged", where_ + name, what));
  }

  /// The values of a dataset that must exist, because related datasets do. Refuses the file as
  /// damaged if the dataset is missing or empty.
  std::vector<double> required(const std::string& name) const {
    std::optional<std::vector<double>> values = column(name);
    if (!values || values->empty()) refuse_damaged(name, values ? "has no values" : "is missing");
    return std::move(*values);
  }

  /// A dataset consists of equal blocks of `size` values, such as one for each model. Returns one
  /// block; refuses the file as damaged if the dataset is too short.
  std::vector<double> part(const std::string& name, std::size_t block, std::size_t size) const {
    const std::vector<double> values = required(name);
    // Divides, because the product block · size of two numbers from the file may overflow.
    if (size > 0 && block >= values.size() / size)
      refuse_damaged(name, fmt::format("has {} values, {}{} are needed", values.size(),
                                       block > 0 ? fmt::format("{} times ", block + 1) : "", size));
    const auto begin = values.begin() + std::ptrdiff_t(block * size);
    return {begin, begin + std::ptrdiff_t(size)};
  }

  const ResultReader& file_;
  const std::string where_;
};

}  // namespace salebra::detail
