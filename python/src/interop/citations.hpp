// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace salebra::python {

/// Remembers that this session used what the keys of salebra._citations stand for. Called with the
/// interpreter's lock.
void cite(std::initializer_list<const char*> keys);

/// The keys in the order of their first use.
const std::vector<std::string>& cited();
void forget_citations();

}  // namespace salebra::python
