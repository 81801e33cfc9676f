// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest name by edit distance, for "did you mean" in messages.
#include <algorithm>
#include <salebra/base/suggestion.hpp>
#include <utility>

namespace salebra {
namespace {

std::size_t edits(std::string_view a, std::string_view b) {
  // Rows of the table of distances between beginnings: the last, and the one before it for swaps.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

/// Options and keys of a study file that had another name in version 0.1. Options have "--" and
/// dashes.
constexpr std::pair<std::string_view, std::string_view> renamed[]{
    {"coupling", "dundurs"},
    {"curvature", "force_curvature"},
    {"customary", "default"},
    {"density", "summit_density"},
    {"force", "overwrite"},
    {"force_newton", "normal_force"},
    {"friction", "friction_coefficient"},
    {"least_prominence", "min_prominence"},
    {"least_realisations", "min_realisations"},
    {"precision", "target_precision"},
};

/// Of an option, the key of the same name.
std::string key_of(std::string_view name) {
  std::string key(name.substr(std::min(name.find_first_not_of('-'), name.size())));
  std::ranges::replace(key, '-', '_');
  return key;
}

bool was_called(std::string_view name, std::string_view old) {
  return std::ranges::find(renamed, std::pair(old, name)) != std::end(renamed);
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  // Shorter beginnings say too little, and words of two letters are all alike.
  constexpr std::size_t least_beginning = 3;
  const std::size_t limit = word.size() / 3;
  std::size_t least = limit + 1;
  std::string nearest;
  const std::string old = key_of(word);
  for (const std::string& name : names) {
    if (was_called(key_of(name), old)) return name;
    const bool begun =
        word.size() >= least_beginning && name.size() > word.size() && name.starts_with(word);
    const std::size_t distance = begun ? 1 : edits(word, name);
    if (distance == 0 || distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(word, names);
  return nearest.empty() ? "" : " (did you mean " + nearest + "?)";
}

}  // namespace salebra
