// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace salebra::detail {

/// Converts the bytes of a number of the type Stored, which begin at `bytes`, to a double.
template <class Stored>
double stored_number(const char* bytes, std::endian order = std::endian::little) {
  std::array<char, sizeof(Stored)> buffer;
  std::memcpy(buffer.data(), bytes, sizeof(Stored));
  if (order != std::endian::native) std::ranges::reverse(buffer);
  return static_cast<double>(std::bit_cast<Stored>(buffer));
}

/// A type of numbers in files, and the function that converts them.
struct StoredType {
  std::string_view name;  ///< as NumPy writes it: f, i or u, and the number of bytes
  double (*read)(const char* bytes, std::endian order) = nullptr;

  std::size_t bytes() const { return static_cast<std::size_t>(name.back() - '0'); }
};

/// The type with this name; nullptr if there is none.
inline const StoredType* stored_type(std::string_view name) {
  static constexpr std::array types{StoredType{"f8", stored_number<double>},
                                    StoredType{"f4", stored_number<float>},
                                    StoredType{"i1", stored_number<std::int8_t>},
                                    StoredType{"i2", stored_number<std::int16_t>},
                                    StoredType{"i4", stored_number<std::int32_t>},
                                    StoredType{"i8", stored_number<std::int64_t>},
                                    StoredType{"u1", stored_number<std::uint8_t>},
                                    StoredType{"u2", stored_number<std::uint16_t>},
                                    StoredType{"u4", stored_number<std::uint32_t>},
                                    StoredType{"u8", stored_number<std::uint64_t>}};
  const auto* found = std::ranges::find(types, name, &StoredType::name);
  return found == types.end() ? nullptr : found;
}

}  // namespace salebra::detail
