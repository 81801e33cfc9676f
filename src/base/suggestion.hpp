// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// The name that a misspelt word was probably meant to be: the nearest by insertions, deletions,
/// replacements and swaps of neighbours (Damerau's distance, each part of the word edited once), at
/// most a third of the word's length away and at least one edit; one that the word begins is as
/// near as one edit. Of equally near names the first. Another word for a name, as "load" for
/// "normal_force", comes before all that are near, and so does a name that it had in 0.1.0. Empty
/// where none is.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// " (did you mean rolloff?)", to stand in an error message; all names that a word is another word
/// for: " (did you mean normal_force or pressure?)". Empty where no name is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace salebra
