// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/fit.hpp>
#include <string>

namespace salebra::cli {

/// One sentence: "F ~ exp(-gap/l) is a poor description of this surface: …". what: "this surface",
/// "this curve".
std::string in_words(const LawDescription& law, const std::string& what);

}  // namespace salebra::cli
