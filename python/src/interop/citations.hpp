// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace salebra::python {

/// Records that this session used these works. They are named by their keys in salebra._citations.
/// The caller must hold the interpreter's lock.
void cite(std::initializer_list<const char*> keys);

/// The keys recorded so far, in the order of their first use.
const std::vector<std::string>& cited();
void forget_citations();

}  // namespace salebra::python
