// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Maps of a page: every stride-th point, as bytes in base64.
namespace salebra::detail {

static_assert(std::endian::native == std::endian::little,
              "maps are embedded as they are in memory");

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += j <= count ? digits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

template <class T>
std::string base64(const std::vector<T>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

/// Distance of the points of a map of at most `side` points along each axis.
inline Index stride_of(Index rows, Index columns, Index side) {
  return std::max<Index>(1, (std::max(rows, columns) + side - 1) / side);
}

/// of(value) at every stride-th point along both axes.
template <class Of>
auto every(Index stride, Index rows, Index columns, const std::vector<double>& values,
           const Of& of) {
  std::vector<decltype(of(0.))> map;
  for (Index i = 0; i < rows; i += stride)
    for (Index j = 0; j < columns; j += stride)
      map.push_back(of(values[std::size_t(i * columns + j)]));
  return map;
}

}  // namespace salebra::detail
