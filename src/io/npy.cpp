// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of NumPy arrays (.npy); their size and unit come from the JSON file (sidecar) next to
// them.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/checksum.hpp"
#include "header_words.hpp"
#include "input_file.hpp"
#include "loaded_surface.hpp"
#include "sidecar.hpp"
#include "stored_number.hpp"

namespace salebra::detail {
namespace {

/// What the header of an array says. It is the text of a Python dict: {'descr': '<f8',
/// 'fortran_order': False, 'shape': (2, 3), }.
struct NpyHeader {
  std::string type;  ///< type of the numbers, such as "<f8"
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
};

class NpyHeaderParser {
 public:
  NpyHeaderParser(const std::filesystem::path& file, std::string_view text)
      : file_(file), text_(text) {}

  NpyHeader parse() {
    NpyHeader header;
    bool has_type = false, has_order = false, has_shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr") {
        if (peek() == '[')
          refuse(file_, "holds records instead of an array of real numbers; save one field");
        header.type = quoted();
        has_type = true;
      } else if (key == "fortran_order") {
        header.fortran_order = boolean();
        has_order = true;
      } else if (key == "shape") {
        header.shape = tuple();
        has_shape = true;
      } else {
        broken();
      }
      if (!accept(',') && peek() != '}') broken();
    }
    if (!has_type || !has_order || !has_shape) broken();
    return header;
  }

 private:
  [[noreturn]] void broken() const {
    refuse(file_, "has a broken NPY header; save the array again");
  }
  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char symbol) {
    if (peek() != symbol) return false;
    ++at_;
    return true;
  }
  void expect(char symbol) {
    if (!accept(symbol)) broken();
  }
  std::string quoted() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') broken();
    const auto end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) broken();
    std::string result(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return result;
  }
  bool boolean() {
    peek();
    for (const auto& [word, value] : {std::pair("True", true), std::pair("False", false)}) {
      if (text_.substr(at_).starts_with(word)) {
        at_ += std::strlen(word);
        return value;
      }
    }
    broken();
  }
  std::vector<std::uint64_t> tuple() {
    std::vector<std::uint64_t> numbers;
    expect('(');
    while (!accept(')')) {
      peek();
      std::uint64_t number = 0;
      const auto [end, status] =
          std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
      if (status != std::errc{}) broken();
      at_ = static_cast<std::size_t>(end - text_.data());
      numbers.push_back(number);
      if (!accept(',') && peek() != ')') broken();
    }
    return numbers;
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

void read_sidecar(const std::filesystem::path& file, std::string_view content,
                  LoadedSurface& surface) {
  const std::filesystem::path sidecar = sidecar_of(file);
  if (!std::filesystem::exists(sidecar)) return;
  constexpr std::uint64_t most = 1 << 20;
  const auto json = nlohmann::json::parse(InputFile(sidecar).content(most), nullptr, false);
  try {
    // The sidecar may belong to another array: a crash may have replaced only one of the two files,
    // or the array was saved again later.
    if (json.contains("checksum") &&
        json.at("checksum").get<std::string>() != Checksum(content).digits())
      refuse(sidecar, "describes a different array than " + file.filename().string() +
                          ": its checksum differs; write both again, or remove the entry checksum "
                          "if the size is right");
    // Entries that the reader uses, or that only describe the origin. Any other entry might change
    // how to read the array.
    constexpr std::array known{"size_x",       "size_y",        "periodic", "units",     "checksum",
                               "origin",       "program",       "version",  "libraries", "created",
                               "command_line", "configuration", "seed"};
    for (const auto& [key, value] : json.items())
      if (std::ranges::find(known, key) == known.end() &&
          is_about_numbers(key, value.is_string() ? value.get<std::string>() : value.dump()))
        refuse(sidecar, "has an entry '" + key +
                            "', which salebra does not apply; apply it and remove the entry");
    if (json.contains("size_x")) surface.size_x = json.at("size_x").get<double>();
    if (json.contains("size_y")) surface.size_y = json.at("size_y").get<double>();
    if (json.contains("periodic")) surface.periodic = json.at("periodic").get<bool>();
    if (json.contains("units")) surface.unit = json.at("units").get<std::string>();
  } catch (const nlohmann::json::exception&) {
    refuse(sidecar,
           "is not the JSON object {size_x, size_y, periodic, units}; correct or remove it");
  }
}

}  // namespace

LoadedSurface read_npy(const std::filesystem::path& file, std::string_view content,
                       const std::string&) {
  constexpr std::size_t magic = 6;
  const auto byte = [&](std::size_t i) -> std::size_t {
    if (i >= content.size()) refuse(file, "ends within its NPY header; it is truncated");
    return static_cast<unsigned char>(content[i]);
  };
  const std::size_t version = byte(magic);
  if (version < 1 || version > 3)
    refuse(file, "has NPY version " + std::to_string(version) + "; versions 1 to 3 are known");
  const std::size_t length_bytes = version == 1 ? 2 : 4, start = magic + 2 + length_bytes;
  std::size_t header_length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) header_length |= byte(magic + 2 + i) << (8 * i);
  if (header_length > content.size() - start)
    refuse(file, "ends within its NPY header; it is truncated");
  const NpyHeader header = NpyHeaderParser(file, content.substr(start, header_length)).parse();

  const char order = header.type.empty() ? '\0' : header.type.front();
  const StoredType* type = order == '<' || order == '>' || order == '=' || order == '|'
                               ? stored_type(std::string_view(header.type).substr(1))
                               : nullptr;
  if (!type)
    refuse(file, "holds elements of type '" + header.type +
                     "'; save real numbers (float64, float32 or integers)");
  if (header.shape.size() != 2 || header.shape[0] == 0 || header.shape[1] == 0)
    refuse(file,
           "holds an array that is not two-dimensional with nx, ny >= 1; save heights[nx, ny]");

  std::uint64_t points = 0, bytes = 0;
  const std::string_view data = content.substr(start + header_length);
  if (__builtin_mul_overflow(header.shape[0], header.shape[1], &points) ||
      __builtin_mul_overflow(points, type->bytes(), &bytes) || bytes > data.size())
    refuse(file, "declares " + std::to_string(header.shape[0]) + " x " +
                     std::to_string(header.shape[1]) +
                     " points, more than it holds; it is truncated");

  const auto nx = static_cast<Index>(header.shape[0]), ny = static_cast<Index>(header.shape[1]);
  const auto endian = order == '<'   ? std::endian::little
                      : order == '>' ? std::endian::big
                                     : std::endian::native;
  LoadedSurface surface;
  surface.heights = heights_of(file, nx, ny);
  for (Index ix = 0; ix < nx; ++ix) {
    for (Index iy = 0; iy < ny; ++iy) {
      const auto index =
          static_cast<std::size_t>(header.fortran_order ? iy * nx + ix : ix * ny + iy);
      surface.heights(ix, iy) = type->read(data.data() + index * type->bytes(), endian);
    }
  }
  read_sidecar(file, content, surface);
  return surface;
}

}  // namespace salebra::detail
