// SPDX-License-Identifier: GPL-3.0-or-later
// MD5 checksum (RFC 1321), as X3P files require it.
#include "md5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace salebra::detail {
namespace {

using Word = std::uint32_t;
constexpr std::size_t block_size = 64;

/// floor(2³² |sin(i + 1)|), as RFC 1321 defines and lists them.
constexpr std::array<Word, 64> sines{
    0xd76aa478, 0xe8c7b756, 0x242070db, 0xc1bdceee, 0xf57c0faf, 0x4787c62a, 0xa8304613, 0xfd469501,
    0x698098d8, 0x8b44f7af, 0xffff5bb1, 0x895cd7be, 0x6b901122, 0xfd987193, 0xa679438e, 0x49b40821,
    0xf61e2562, 0xc040b340, 0x265e5a51, 0xe9b6c7aa, 0xd62f105d, 0x02441453, 0xd8a1e681, 0xe7d3fbc8,
    0x21e1cde6, 0xc33707d6, 0xf4d50d87, 0x455a14ed, 0xa9e3e905, 0xfcefa3f8, 0x676f02d9, 0x8d2a4c8a,
    0xfffa3942, 0x8771f681, 0x6d9d6122, 0xfde5380c, 0xa4beea44, 0x4bdecfa9, 0xf6bb4b60, 0xbebfbc70,
    0x289b7ec6, 0xeaa127fa, 0xd4ef3085, 0x04881d05, 0xd9d4d039, 0xe6db99e5, 0x1fa27cf8, 0xc4ac5665,
    0xf4292244, 0x432aff97, 0xab9423a7, 0xfc93a039, 0x655b59c3, 0x8f0ccc92, 0xffeff47d, 0x85845dd1,
    0x6fa87e4f, 0xfe2ce6e0, 0xa3014314, 0x4e0811a1, 0xf7537e82, 0xbd3af235, 0x2ad7d2bb, 0xeb86d391};

constexpr std::array<std::array<int, 4>, 4> shifts{
    {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}}};

class State {
 public:
  void add(const char* block) {
    std::array<Word, 16> words;
    for (std::size_t i = 0; i < words.size(); ++i) {
      words[i] = 0;
      for (std::size_t byte = 0; byte < 4; ++byte)
        words[i] |= static_cast<Word>(static_cast<unsigned char>(block[4 * i + byte]))
                    << (8 * byte);
    }
    Word a = sum_[0], b = sum_[1], c = sum_[2], e = sum_[3];
    for (std::size_t i = 0; i < 64; ++i) {
      const std::size_t round = i / 16;
      Word mixed = 0;
      std::size_t word = 0;
      if (round == 0) {
        mixed = (b & c) | (~b & e);
        word = i;
      } else if (round == 1) {
        mixed = (b & e) | (c & ~e);
        word = (5 * i + 1) % 16;
      } else if (round == 2) {
        mixed = b ^ c ^ e;
        word = (3 * i + 5) % 16;
      } else {
        mixed = c ^ (b | ~e);
        word = 7 * i % 16;
      }
      const Word turned = std::rotl(a + mixed + sines[i] + words[word], shifts[round][i % 4]);
      a = e;
      e = c;
      c = b;
      b += turned;
    }
    sum_[0] += a;
    sum_[1] += b;
    sum_[2] += c;
    sum_[3] += e;
  }

  std::string digits() const {
    std::string text;
    for (const Word word : sum_)
      for (int shift = 0; shift < 32; shift += 8)
        text += fmt::format("{:02x}", word >> shift & 255);
    return text;
  }

 private:
  std::array<Word, 4> sum_{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
};

}  // namespace

std::string md5(std::string_view bytes) { return md5({bytes, {}}); }

std::string md5(const std::array<std::string_view, 2>& parts) {
  State state;
  std::string end;  // what fills no block
  std::uint64_t bits = 0;
  for (std::string_view part : parts) {
    bits += 8 * static_cast<std::uint64_t>(part.size());
    const std::size_t missing = (block_size - end.size()) % block_size;
    end += part.substr(0, missing);
    part.remove_prefix(std::min(missing, part.size()));
    if (end.size() == block_size) {
      state.add(end.data());
      end.clear();
    }
    for (; part.size() >= block_size; part.remove_prefix(block_size)) state.add(part.data());
    end += part;
  }
  // A one bit, zeros, and the length in bits as the last eight bytes of a block.
  end += '\x80';
  end.append((2 * block_size - 8 - end.size()) % block_size, '\0');
  for (int shift = 0; shift < 64; shift += 8) end += static_cast<char>(bits >> shift & 255);
  for (std::size_t at = 0; at < end.size(); at += block_size) state.add(end.data() + at);
  return state.digits();
}

}  // namespace salebra::detail
