// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/error.hpp>
#include <salebra/study/realisation.hpp>
#include <string>
#include <string_view>

namespace salebra::detail {

/// CRC-64/XZ: any error of up to 64 bits in a row is found.
std::uint64_t checksum(std::string_view bytes);

/// A number for everything that decides the realisation: the point's configuration, the seed, and the program's version. What
/// does not (other seeds, precision, comments) is not in it.
/// Of everything that decides the result of a study with these points.
std::uint64_t study_key(const std::vector<StudyConfiguration>& points);

std::uint64_t realisation_key(const StudyConfiguration& point, std::uint64_t seed);

/// A whole realisation, but with other last digits than this program would have computed: what() is the arithmetic() of its own.
class OtherArithmetic : public Error {
 public:
  using Error::Error;
};

/// Every bit of a realisation with its key, the arithmetic() that it comes from and a checksum; for this machine's byte order.
std::string encode(const Realisation& realisation, std::uint64_t key);
/// Throws InvalidInput for anything but what encode() made with this key, and OtherArithmetic.
Realisation decode(std::string_view bytes, std::uint64_t key);

}  // namespace salebra::detail
