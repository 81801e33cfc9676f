// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What the fuzzers and the replay of their corpora have in common.
namespace salebra::fuzz {

/// Names of the readers, which are also the names of the folders of the corpus.
const std::vector<std::string>& readers();

/// Hands an input to one reader, its first bytes replaced by those that lead to it. An input may be
/// read or refused with InvalidInput in one line; returns whether it was read. Anything else is a
/// defect: another exception leaves this function, and a result that no file may give throws
/// std::logic_error.
bool read_input(std::string_view reader, std::string input);

}  // namespace salebra::fuzz
