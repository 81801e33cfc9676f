// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_input.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <stdexcept>

#include "../../src/io/loaded_surface.hpp"
#include "../../src/io/plain_content.hpp"
#include "../../src/io/surface_format.hpp"
#include "../../src/io/x3p.hpp"
#include "io/number_table.hpp"

namespace salebra::fuzz {
namespace {

/// A file, in memory where the system has such a folder for this user, for what is read through a
/// path.
class ScratchFile {
 public:
  ScratchFile() {
    const std::filesystem::path memory = "/dev/shm";
    name_ = (access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path()) /
            "salebra-fuzz-XXXXXX";
    descriptor_ = mkstemp(name_.data());
    if (descriptor_ < 0) throw std::runtime_error("no scratch file");
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() {
    close(descriptor_);
    unlink(name_.c_str());
  }

  void fill(const std::string& content) {
    if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, content.data(), content.size(), 0) !=
                                              static_cast<ssize_t>(content.size()))
      throw std::runtime_error("cannot fill the scratch file");
  }
  const std::string& path() const { return name_; }

 private:
  std::string name_;
  int descriptor_ = -1;
};

void require_possible(const Surface& surface) {
  surface.grid.validate();
  if (surface.heights.rows() != surface.grid.nx || surface.heights.cols() != surface.grid.ny ||
      surface.heights.isInf().any())
    throw std::logic_error("a reader returned a surface that cannot be");
}

void complete(const std::string& name, detail::LoadedSurface loaded) {
  // Sizes that a file states are judged; where it states none, they are given.
  ReadOptions options;
  if (!loaded.size_x) options.size_x = 1;
  if (!loaded.size_y) options.size_y = 1;
  require_possible(detail::completed(name, std::move(loaded), options).surface);
}

/// Members of an X3P archive without the archive: its checksums would leave nothing to a mutation.
/// The input is main.xml and the heights, parted by a NUL byte; the mask, where one is asked for,
/// is the end of the heights.
void read_x3p_parts(const std::string& input) {
  const auto parted = input.find('\0');
  const std::string xml = input.substr(0, parted),
                    data = parted == std::string::npos ? "" : input.substr(parted + 1);
  const auto member = [&](const std::string& name,
                          std::optional<std::uint64_t> bytes) -> std::optional<std::string> {
    if (name == "main.xml") return xml;
    if (!bytes) return {};
    if (*bytes > data.size()) detail::refuse("input", "declares more than it holds");
    return name.ends_with("valid.bin") ? data.substr(data.size() - *bytes) : data.substr(0, *bytes);
  };
  complete("input", detail::x3p_surface("input", member));
}

void read_through_file(const std::string& input,
                       const std::function<void(const std::filesystem::path&)>& read) {
  static ScratchFile file;
  file.fill(input);
  read(file.path());
}

struct Target {
  std::vector<std::string_view> heads;  ///< the first is put in place of other first bytes
  std::function<void(const std::string&)> read;
};

const std::map<std::string, Target, std::less<>>& targets() {
  static const auto surface = [](detail::SurfaceFormatEntry::Read* read) {
    return [read](const std::string& input) { complete("input", read("input", input, "")); };
  };
  static const std::map<std::string, Target, std::less<>> all = [] {
    std::map<std::string, Target, std::less<>> some{
        {"x3p-parts", {{}, read_x3p_parts}},
        {"any", {{}, surface(detail::read_content)}},
        {"gzip",
         {{"\x1f\x8b\x08", "\xff\xfe", "\xfe\xff"},
          [](const std::string& input) {
            const auto plain = detail::plain_content("input", input);
            complete("input", detail::read_content("input", plain.value_or(input)));
          }}},
        {"table",
         {{},
          [](const std::string& input) {
            read_through_file(input, [](const auto& file) {
              read_number_table(file,
                                {{"r", Dimension::length, {"x"}}, {"f", Dimension::length, {"z"}}});
            });
          }}},
        {"curve",
         {{},
          [](const std::string& input) {
            read_through_file(input, [](const auto& file) { read_force_curve(file); });
          }}},
        {"hdf5",
         {{"\x89HDF\r\n\x1a\n"},
          [](const std::string& input) {
            read_through_file(
                input, [](const auto& file) { complete(file.string(), detail::read_hdf5(file)); });
          }}},
    };
    for (const detail::SurfaceFormatEntry& format : detail::surface_format_table())
      if (format.read) some[std::string(format.keyword)] = {format.heads, surface(format.read)};
    return some;
  }();
  return all;
}

}  // namespace

const std::vector<std::string>& readers() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, target] : targets()) all.push_back(name);
    return all;
  }();
  return names;
}

bool read_input(std::string_view reader, std::string input) {
  const auto found = targets().find(reader);
  if (found == targets().end()) throw std::logic_error("no such reader: " + std::string(reader));
  const auto& heads = found->second.heads;
  if (!heads.empty() &&
      std::ranges::none_of(heads, [&](auto head) { return input.starts_with(head); })) {
    input.resize(std::max(input.size(), heads.front().size()));
    input.replace(0, heads.front().size(), heads.front());
  }
  try {
    found->second.read(input);
    return true;
  } catch (const InvalidInput& error) {
    if (std::string_view(error.what()).find_first_of("\n\r\x1b") != std::string_view::npos)
      throw std::logic_error("a message of several lines or with control characters");
    return false;
  }
}

}  // namespace salebra::fuzz
