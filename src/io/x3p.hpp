// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "loaded_surface.hpp"

/// X3P, ISO 25178-72: a ZIP archive of main.xml, which describes the axes and names the files of
/// heights and of valid points. Its MD5 sums are not read: the archive has sums of its own.
namespace salebra::detail {

/// A member of the archive by its name: its content, which must be of exactly `bytes` bytes, or of
/// any number up to max_xml_size if `bytes` is absent. Nothing if there is no such member. Throws
/// InvalidInput where it is damaged or of another size; whatever its header declares, no more is
/// allocated than `bytes` and the archive allow.
using X3pMember = std::function<std::optional<std::string>(const std::string& name,
                                                           std::optional<std::uint64_t> bytes)>;

constexpr std::uint64_t max_xml_size = 16u << 20;

/// The surface that main.xml describes. Metres; x fastest in the file.
LoadedSurface x3p_surface(const std::filesystem::path& file, const X3pMember& member);

}  // namespace salebra::detail
