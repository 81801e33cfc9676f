// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/contact_element.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {

struct CHeaderOptions {
  std::string name = "contact";           ///< prefix of every name in the header
  std::vector<std::string> comment = {};  ///< sentences at the top: licence, source, units
  double length_unit = 1;                 ///< of the header, m
  double force_unit = 1;                  ///< of the header, N
};

/// A header of C99, valid in C++ too, that needs only math.h of the standard: tables of the springs,
/// and <name>_state, <name>_start(), <name>_step() with the forces and derivatives of
/// ContactElement, up to round-off. Throws InvalidInput for a name that is not valid in C.
std::string c_header(const LawSprings& springs, const CHeaderOptions& options = {});

/// Replaces every `from` in the text.
void replace_all(std::string& text, std::string_view from, std::string_view to);

}  // namespace salebra
