// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

/// The files of the folder report/ and plotly.js (the plotting library of the page), embedded when
/// the library was built.
namespace salebra::detail::assets {

std::string_view html();
std::string_view css();
std::string_view javascript();
/// The text of plotly.js; empty if the library was built without it.
std::string_view plotly();

}  // namespace salebra::detail::assets
