// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <salebra/study/parts.hpp>
#include <salebra/study/realisation.hpp>
#include <string>
#include <string_view>

namespace salebra::detail {

/// Hash of all input that affects the result of a study with these points of the parameter grid.
std::uint64_t study_key(const std::vector<StudyConfiguration>& points);

/// Hash of all input that affects a realisation: the configuration of the point, the seed, and the
/// version of the program. The other seeds, the requested precision and comments do not affect it.
std::uint64_t realisation_key(const StudyConfiguration& point, std::uint64_t seed);

/// A realisation, and where and how it was computed.
struct Record {
  PartOrigin origin;
  Realisation realisation;
};

/// Encodes a record bit for bit, with its key and a checksum, in the byte order of this machine.
std::string encode(const Record& record, std::uint64_t key);
/// Decodes a record. Throws InvalidInput for anything that encode() did not make with this key.
Record decode(std::string_view bytes, std::uint64_t key);
/// Returns the origin in a record that encode() made with any key; empty for anything else, such as
/// a record that another version wrote in another form.
std::optional<PartOrigin> origin_of(std::string_view bytes);

}  // namespace salebra::detail
