// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace salebra {

/// Reads the columns of a text table of numbers in SI units: profiles (r, f), trajectories (t, δ,
/// x). Values are separated by blanks, ',' or ';'; lines that are empty or begin with '#' are
/// passed over, and one line of titles may come first.
/// columns   how many there must be in each line
/// most      the first line may have up to so many, and then each does
/// throws    InvalidInput naming file and line
std::vector<std::vector<double>> read_number_table(const std::filesystem::path& file,
                                                   std::size_t columns, std::size_t most = 0);

}  // namespace salebra
