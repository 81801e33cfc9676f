// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "loaded_surface.hpp"

/// X3P, ISO 25178-72: a ZIP archive with main.xml, which describes the axes and names the files of
/// heights and of valid points. The MD5 sums in the archive are not read, since ZIP has checksums
/// of its own.
namespace salebra::detail {

/// Returns the content of the member `name` of the archive; nothing if there is no such member. The
/// content must have exactly `bytes` bytes or, if `bytes` is not given, at most max_xml_size.
/// Throws InvalidInput if the member is damaged or has another size. Whatever size its header
/// declares, no more memory is allocated than `bytes` and the size of the archive allow.
using X3pMember = std::function<std::optional<std::string>(const std::string& name,
                                                           std::optional<std::uint64_t> bytes)>;

constexpr std::uint64_t max_xml_size = 16u << 20;

/// The surface that main.xml describes, in metres. In the binary file the index along x varies
/// fastest.
LoadedSurface x3p_surface(const std::filesystem::path& file, const X3pMember& member);

}  // namespace salebra::detail
