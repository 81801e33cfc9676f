// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

/// The files of the repository's report/ and plotly.js, as they were when the library was built.
namespace salebra::detail::assets {

std::string_view html();
std::string_view css();
std::string_view javascript();
/// Empty where the build had none.
std::string_view plotly();

}  // namespace salebra::detail::assets
