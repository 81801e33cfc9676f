// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace salebra::detail {

/// Checksum of a stream of bytes; it does not depend on how the stream is cut into pieces. It is
/// used for sidecars, kept surfaces and checkpoints (archives and HDF5 files have checksums of
/// their own, which their libraries check). Each step maps the state one to one for a given word,
/// and the word one to one for a given state. Two streams of equal length that differ only within
/// one aligned word of eight bytes therefore always have different sums. It detects damage, not
/// forgery. Cost: one pass, several GB/s.
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

  /// The 64-bit checksum of the bytes that were added so far, and of their number.
  std::uint64_t value() const {
    Checksum whole = *this;
    whole.take_word();
    whole.word_ = size_;
    whole.take_word();
    return whole.state_;
  }
  /// value() as 16 hexadecimal digits.
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
