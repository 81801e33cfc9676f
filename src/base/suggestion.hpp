// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// The name that a misspelt word probably means. It is the nearest name by insertions, deletions,
/// replacements and swaps of neighbours (Damerau's distance, each part of the word edited once), at
/// a distance of at least one edit and at most a third of the word's length. A name that begins
/// with the word has distance one. Among equally near names the first is taken. Synonyms, such as
/// "load" for "normal_force", and names of version 0.1.0 take precedence over near names. Empty if
/// there is no such name.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// Text for an error message: " (did you mean rolloff?)", or all names that a word is a synonym of:
/// " (did you mean normal_force or pressure?)". Empty if no name is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace salebra
