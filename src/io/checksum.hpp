// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace salebra::detail {

/// Checksum of a stream of bytes, however it is cut into pieces: the one of the tree, for sidecars,
/// kept surfaces and checkpoints. Archives and HDF5 have those of their formats, by their libraries.
/// Each step is a bijection of the state for a given word and of the word for a given state: streams
/// of one length that differ within a single aligned word of eight bytes never agree. It tells
/// damage, not intent. Cost: one pass, several GB/s.
class Checksum {
 public:
  Checksum() = default;
  explicit Checksum(std::string_view bytes) { add(bytes); }
  void add(std::string_view bytes) {
    size_ += bytes.size();
    while (!bytes.empty()) {
      if (filled_ == 0 && bytes.size() >= sizeof word_) {
        std::memcpy(&word_, bytes.data(), sizeof word_);
        bytes.remove_prefix(sizeof word_);
        take_word();
      } else {
        word_ |= std::uint64_t{static_cast<unsigned char>(bytes.front())} << 8 * filled_;
        bytes.remove_prefix(1);
        if (++filled_ == sizeof word_) take_word();
      }
    }
  }

  /// The checksum in 64 bits of the bytes so far and their number.
  std::uint64_t value() const {
    Checksum whole = *this;
    whole.take_word();
    whole.word_ = size_;
    whole.take_word();
    return whole.state_;
  }
  /// The same as 16 hexadecimal digits.
  std::string digits() const {
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[value() >> shift & 15];
    return text;
  }

 private:
  void take_word() {
    state_ = (state_ ^ word_) * 0x9e3779b97f4a7c15;
    state_ ^= state_ >> 32;
    word_ = 0;
    filled_ = 0;
  }

  std::uint64_t state_ = 0, size_ = 0, word_ = 0;
  unsigned filled_ = 0;
};

}  // namespace salebra::detail
