// SPDX-License-Identifier: GPL-3.0-or-later
// Unpacks gzip and converts UTF-16 to UTF-8.
#include "plain_content.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <salebra/base/error.hpp>

#include "base/memory.hpp"
#include "loaded_surface.hpp"

namespace salebra::detail {
namespace {

/// The first bytes of gzip, and of UTF-16 in either byte order.
constexpr std::string_view gzip_mark = "\x1f\x8b", big_endian_mark = "\xfe\xff",
                           little_endian_mark = "\xff\xfe";

/// An inflate stream that the destructor closes.
class Inflater {
 public:
  Inflater() {
    constexpr int gzip_of_any_window = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_of_any_window) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }
  z_stream* operator->() { return &stream_; }
  z_stream* get() { return &stream_; }

 private:
  z_stream stream_ = {};
};

/// Number of bytes per height in a binary format, recognised by the first bytes of the content; 0
/// for text.
std::size_t bytes_of_height(std::string_view content) {
  if (content.starts_with("Gwyddion Simple Field")) return 4;
  if (content.starts_with("GWYP")) return 8;
  if (content.starts_with("DIGITAL SURF")) return 2;
  if (!content.starts_with("\x93NUMPY")) return 0;
  const std::size_t type = content.substr(0, 1024).find("descr");
  const std::size_t digit =
      type == content.npos ? type : content.substr(0, 1024).find_first_of("1248", type);
  return digit == content.npos ? 1 : static_cast<std::size_t>(content[digit] - '0');
}

/// An upper bound of the number of heights that a reader will make of the content from index
/// `begin` on.
std::uint64_t doubles_of(std::string_view content, std::size_t begin) {
  if (const std::size_t bytes = bytes_of_height(content)) return (content.size() - begin) / bytes;
  const auto separates = [](char symbol) {
    return symbol == ' ' || (symbol >= '\t' && symbol <= '\r') || symbol == ',' || symbol == ';';
  };
  std::uint64_t words = 0;
  for (std::size_t i = std::max<std::size_t>(begin, 1); i < content.size(); ++i)
    words += static_cast<std::uint64_t>(separates(content[i]) && !separates(content[i - 1]));
  return words;
}

std::string unzipped(const std::filesystem::path& file, std::string_view content) {
  const std::uint64_t most = 64 * std::uint64_t(content.size()) + (std::uint64_t{256} << 20);
  // Limits the heights that a small packed file can make, each of which takes eight bytes of memory
  // or more. A real scan has at least one bit of information per height, so a packed byte contains
  // at most eight heights; 8 million more are allowed.
  const std::uint64_t max_doubles = 8 * std::uint64_t(content.size()) + (std::uint64_t{8} << 20);
  std::uint64_t doubles = 0;
  constexpr std::size_t piece = std::size_t{1} << 20;
  Inflater inflater;
  std::string out;
  std::size_t filled = 0;
  const auto refuse_size = [&] {
    refuse(file, "unpacks to more than " + memory_text(static_cast<double>(filled)) +
                     ", more than is allowed here; unpack the file and crop its content");
  };
  for (int status = Z_OK; status != Z_STREAM_END || !content.empty();) {
    if (status == Z_STREAM_END) {
      // After a member of the gzip file another member or padding may follow.
      if (!content.starts_with(gzip_mark)) break;
      inflateReset(inflater.get());
    }
    if (out.size() - filled < piece) {
      const std::uint64_t wanted =
          std::min(std::max<std::uint64_t>(2 * out.size(), 4 * piece), most + 2 * piece);
      if (!fits_into_memory(static_cast<double>(wanted))) refuse_size();
      out.resize(wanted);
    }
    constexpr std::size_t longest = std::numeric_limits<uInt>::max();
    const auto given = static_cast<uInt>(std::min(content.size(), longest));
    const auto available = static_cast<uInt>(std::min(out.size() - filled, longest));
    // The cast is safe, since inflate() does not write to its input.
    inflater->next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(content.data()));
    inflater->avail_in = given;
    inflater->next_out = reinterpret_cast<Bytef*>(out.data() + filled);
    inflater->avail_out = available;
    status = inflate(inflater.get(), Z_NO_FLUSH);
    content.remove_prefix(given - inflater->avail_in);
    const std::size_t before = filled;
    filled += available - inflater->avail_out;
    doubles += doubles_of(std::string_view(out).substr(0, filled), before);
    if (filled > most || doubles > max_doubles) refuse_size();
    const bool stuck = status == Z_BUF_ERROR && content.empty();
    if (stuck || (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR))
      refuse(file, "is a truncated or damaged gzip file; copy or pack it again");
  }
  out.resize(filled);
  return out;
}

void append_utf8(std::string& text, std::uint32_t symbol) {
  const auto tail = [&](int shift) {
    text += static_cast<char>(0x80 | ((symbol >> shift) & 0x3f));
  };
  if (symbol < 0x80) {
    text += static_cast<char>(symbol);
  } else if (symbol < 0x800) {
    text += static_cast<char>(0xc0 | (symbol >> 6));
    tail(0);
  } else if (symbol < 0x10000) {
    text += static_cast<char>(0xe0 | (symbol >> 12));
    tail(6);
    tail(0);
  } else {
    text += static_cast<char>(0xf0 | (symbol >> 18));
    tail(12);
    tail(6);
    tail(0);
  }
}

std::string utf8_of_utf16(const std::filesystem::path& file, std::string_view content, bool big) {
  const auto unit = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(content[i]),
               second = static_cast<unsigned char>(content[i + 1]);
    return static_cast<std::uint32_t>(big ? first << 8 | second : second << 8 | first);
  };
  if (content.size() % 2 != 0) refuse(file, "is UTF-16 text that is truncated; copy it again");
  std::string text;
  text.reserve(content.size() / 2);
  for (std::size_t i = 2; i < content.size(); i += 2) {
    std::uint32_t symbol = unit(i);
    if (symbol >= 0xd800 && symbol < 0xe000) {
      const bool paired = symbol < 0xdc00 && i + 2 < content.size() && unit(i + 2) >= 0xdc00 &&
                          unit(i + 2) < 0xe000;
      if (!paired) refuse(file, "begins like UTF-16 text but is not; save it as UTF-8");
      symbol = 0x10000 + ((symbol - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
      i += 2;
    }
    append_utf8(text, symbol);
  }
  return text;
}

}  // namespace

bool is_wrapped(std::string_view content) {
  return content.starts_with(gzip_mark) || content.starts_with(big_endian_mark) ||
         content.starts_with(little_endian_mark);
}

std::optional<std::string> plain_content(const std::filesystem::path& file,
                                         std::string_view content) {
  std::optional<std::string> plain;
  if (content.starts_with(gzip_mark)) content = plain.emplace(unzipped(file, content));
  const bool big = content.starts_with(big_endian_mark);
  if (big || content.starts_with(little_endian_mark)) plain = utf8_of_utf16(file, content, big);
  return plain;
}

}  // namespace salebra::detail
