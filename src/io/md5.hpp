// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace salebra::detail {

/// MD5 of the bytes as 32 hexadecimal digits in lower case [RFC 1321]. X3P files carry it to tell damage; against intent it
/// protects nothing. Cost: one pass, about 0.5 GB/s.
std::string md5(std::string_view bytes);

}  // namespace salebra::detail
