// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest name by edit distance, for "did you mean" in messages.
#include "suggestion.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace salebra {
namespace {

std::size_t edits(std::string_view a, std::string_view b) {
  // Rows of the table of edit distances: the current row, the last one, and the one before the
  // last, which swaps of two letters need.
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

/// Other words for options, keys and commands: from other programs, from the literature, or from
/// version 0.1.0. Options begin with "--" and contain dashes. If a program knows none of the names
/// in a line, the next line with the same word is used.
struct Synonym {
  std::string_view word;
  std::array<std::string_view, 3> names;
};
constexpr Synonym synonyms[]{
    {"closed_form", {"small_amplitude_work"}},
    {"e", {"contact_modulus", "young"}},
    {"ellipsoid", {"elliptic_paraboloid"}},
    {"force", {"normal_force", "pressure", "pressures"}},
    {"force", {"overwrite"}},
    {"friction", {"friction_coefficient"}},
    {"full_stick_work", {"work_per_cycle_without_slip"}},
    {"largest_amplitude", {"max_amplitude"}},
    {"level_error", {"interval_error"}},
    {"levels", {"intervals"}},
    {"load", {"normal_force", "pressure", "pressures"}},
    {"most_cycles", {"max_cycles"}},
    {"mu", {"friction_coefficient", "friction"}},
    {"nu", {"poisson"}},
    {"precision", {"target_precision"}},
    {"predicted", {"small_amplitude_work"}},
    {"predicted_finite", {"work_by_force"}},
    {"roughness", {"statistics"}},
    {"scatter_error", {"noise_error"}},
    {"separation", {"mean_gap"}},
    {"separations", {"mean_gap"}},
    {"smallest_force", {"min_force"}},
    {"small_damping_constant", {"small_amplitude_damping_constant"}},
    {"small_work_per_cycle", {"small_amplitude_work"}},
    {"summits", {"model"}},
    {"velocity", {"drag_velocity", "velocities"}},
};

/// Converts the name of an option to the name of its key, in lower case.
std::string key_of(std::string_view name) {
  std::string key(name.substr(std::min(name.find_first_not_of('-'), name.size())));
  for (char& symbol : key)
    if (symbol == '-')
      symbol = '_';
    else if (symbol >= 'A' && symbol <= 'Z')
      symbol = static_cast<char>(symbol - 'A' + 'a');
  return key;
}

/// The known names that the word is a synonym of.
std::vector<std::string> names_for(std::string_view word, const std::vector<std::string>& names) {
  const std::string key = key_of(word);
  std::vector<std::string> found;
  for (const Synonym& synonym : synonyms) {
    if (synonym.word != key || !found.empty()) continue;
    for (const std::string_view meant : synonym.names)
      for (const std::string& name : names)
        if (!meant.empty() && name != word && key_of(name) == meant) found.push_back(name);
  }
  return found;
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  if (const auto meant = names_for(word, names); !meant.empty()) return meant.front();
  // Minimum length of a beginning of a name: shorter beginnings are ambiguous, and words of two
  // letters all resemble each other.
  constexpr std::size_t min_beginning = 3;
  const std::size_t limit = word.size() / 3;
  std::size_t least = limit + 1;
  std::string nearest;
  for (const std::string& name : names) {
    const bool begun =
        word.size() >= min_beginning && name.size() > word.size() && name.starts_with(word);
    const std::size_t distance = begun ? 1 : edits(word, name);
    if (distance == 0 || distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  std::vector<std::string> meant = names_for(word, names);
  if (meant.empty()) meant = {nearest_name(word, names)};
  std::string text;
  for (const std::string& name : meant) text += (text.empty() ? "" : " or ") + name;
  return text.empty() ? "" : " (did you mean " + text + "?)";
}

}  // namespace salebra
