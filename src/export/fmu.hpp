// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "formats.hpp"

namespace salebra::detail {

/// The C header of a deck with springs, in the units of the deck.
std::string header_of_c(const Deck& deck);

/// A co-simulation unit of FMI 3.0 (Functional Mock-up Interface 3.0, chapters 2 and 4) that takes
/// the steps of the C header: a ZIP archive of modelDescription.xml, the sources in C99 with
/// buildDescription.xml, and deck.library, if there is one, for platform().
std::string fmu(const Deck& deck);

/// The shared library of such a unit, compiled by the program `cc` in the folders of PATH; empty if
/// there is none, if it fails, or on a platform without a name in FMI.
std::string fmu_library(const Deck& deck);

/// The platform of this program in the words of FMI, such as "x86_64-linux"; empty if unknown.
std::string_view platform();

}  // namespace salebra::detail
