// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of invalid input: their parts, and the checks that all modules share.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>

#include "printable.hpp"

namespace salebra {
namespace {

// Maximum bytes of the field's name, of its value and of the demand in an error message. Without
// these limits, a whole file given in place of a number would be quoted.
constexpr std::size_t longest_part = 255, longest_demand = 1000;

std::string joined(const std::string& first, std::string_view between, const std::string& second) {
  return first.empty() || second.empty() ? first + second : first + std::string(between) + second;
}

std::string text_of(std::string_view field, std::string_view value, std::string_view demand) {
  return joined(shortened(field, longest_part), ": ",
                joined(shortened(value, longest_part), " ", shortened(demand, longest_demand)));
}

}  // namespace

InvalidInput::InvalidInput(std::string_view field, std::string_view value, std::string_view demand)
    : Error(text_of(field, value, demand)) {
  const std::string whole = shortened(demand, longest_demand);
  const std::size_t end = std::min(whole.find("; "), whole.size());
  parts_ =
      std::make_shared<const Parts>(Parts{.field = shortened(field, longest_part),
                                          .value = shortened(value, longest_part),
                                          .constraint = whole.substr(0, end),
                                          .remedy = whole.substr(std::min(end + 2, whole.size()))});
}

std::string InvalidInput::statement() const {
  return joined(value(), " ", joined(constraint(), "; ", remedy()));
}

void require_that(bool ok, std::string_view field, std::string_view demand) {
  if (!ok) throw InvalidInput(field, demand);
}

void require_one(bool given, std::string_view field, bool other_given, std::string_view other) {
  if (given == other_given)
    throw InvalidInput(field, (given ? "given together with " : "not given, nor is ") +
                                  std::string(other) + "; give one of them");
}

void require_positive(double value, std::string_view field) {
  require(std::isfinite(value) && value > 0, field, value, "must be a finite number > 0");
}

}  // namespace salebra
