// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace salebra::detail {

/// MD5 of the bytes as 32 hexadecimal digits in lower case [RFC 1321]. X3P files and sidecars of
/// NPY files carry it to tell damage; against intent it protects nothing. Cost: one pass, about 0.5
/// GB/s.
std::string md5(std::string_view bytes);
/// MD5 of two pieces, one after the other.
std::string md5(const std::array<std::string_view, 2>& parts);

}  // namespace salebra::detail
