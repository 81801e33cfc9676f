// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <salebra/study/parts.hpp>
#include <salebra/study/realisation.hpp>
#include <string>
#include <string_view>

namespace salebra::detail {

/// A number for everything that decides the realisation: the point's configuration, the seed, and
/// the program's version. What does not (other seeds, precision, comments) is not in it.
/// The key of everything that decides the result of a study with these points.
std::uint64_t study_key(const std::vector<StudyConfiguration>& points);

std::uint64_t realisation_key(const StudyConfiguration& point, std::uint64_t seed);

/// A realisation and where it was computed.
struct Record {
  PartOrigin origin;
  Realisation realisation;
};

/// Every bit of a record with its key and a checksum; for this machine's byte order.
std::string encode(const Record& record, std::uint64_t key);
/// Throws InvalidInput for anything but what encode() made with this key.
Record decode(std::string_view bytes, std::uint64_t key);
/// The origin of what encode() made with any key; empty for anything else, such as the record of
/// another version whose form differs.
std::optional<PartOrigin> origin_of(std::string_view bytes);

}  // namespace salebra::detail
