// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "run_program.hpp"

/// Two points of so many surfaces, of few loads and without stick solves.
std::string study_of(int seeds);

/// The finished surfaces in a folder of parts, which may go meanwhile.
std::size_t parts_in(const std::filesystem::path& folder);

/// `salebra study study.toml -o result.h5 OPTIONS` in a process that goes on by itself and prints
/// nothing.
pid_t start_study(const ProgramTest& test, const std::vector<const char*>& options);
