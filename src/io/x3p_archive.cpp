// SPDX-License-Identifier: GPL-3.0-or-later
// Members of an X3P archive (ISO 25178-72), unpacked with limits on their size.
#include <zip.h>

#include <memory>

#include "x3p.hpp"

namespace salebra::detail {
namespace {

/// The largest member that is accepted in an archive of this size, bytes. Deflate compresses zeros
/// a thousandfold, but measured heights hardly fourfold; the factor 8 also allows for integers of
/// two bytes that become doubles.
std::uint64_t max_bytes(std::uint64_t archive_size) {
  return (std::uint64_t{32} << 20) + 8 * archive_size;
}

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseMember {
  void operator()(zip_file_t* member) const { zip_fclose(member); }
};

using Archive = std::unique_ptr<zip_t, CloseArchive>;

Archive opened(const std::filesystem::path& file, std::string_view content) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(content.data(), content.size(), 0, &error);
  zip_t* archive = source ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
  if (!archive) {
    if (source) zip_source_free(source);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    refuse(file, "is a truncated or damaged ZIP archive (" + reason + "); copy or save it again");
  }
  zip_error_fini(&error);
  return Archive(archive);
}

std::optional<std::string> extracted(const std::filesystem::path& file, zip_t* archive,
                                     const std::string& name, std::optional<std::uint64_t> bytes,
                                     std::uint64_t archive_size) {
  const auto index = zip_name_locate(archive, name.c_str(), 0);
  if (index < 0) return {};
  const auto number = static_cast<std::uint64_t>(index);
  zip_stat_t about;
  constexpr std::uint64_t needed = ZIP_STAT_SIZE;
  if (zip_stat_index(archive, number, 0, &about) != 0 || (about.valid & needed) != needed)
    refuse(file, "does not state the size of its member " + name + "; it is damaged");
  if (bytes && about.size != *bytes)
    refuse(file, "holds " + std::to_string(about.size) + " bytes in its member " + name +
                     " but its main.xml states " + std::to_string(*bytes) +
                     "; it is truncated or damaged");
  if (about.size > (bytes ? *bytes : max_xml_size) || about.size > max_bytes(archive_size))
    refuse(file, "declares " + std::to_string(about.size) + " bytes for its member " + name +
                     ", more than it can hold; it is damaged or malicious");
  const std::unique_ptr<zip_file_t, CloseMember> stream(zip_fopen_index(archive, number, 0));
  if (!stream)
    refuse(file, "has a member " + name + " that cannot be unpacked (" + zip_strerror(archive) +
                     "); save it without encryption, deflated or stored");
  std::string content(about.size, '\0');
  std::uint64_t filled = 0;
  while (filled < about.size) {
    const auto got = zip_fread(stream.get(), content.data() + filled, about.size - filled);
    if (got <= 0) break;
    filled += static_cast<std::uint64_t>(got);
  }
  // Reads beyond the end of the member, because libzip compares the checksum only there.
  char beyond;
  if (filled < about.size || zip_fread(stream.get(), &beyond, 1) != 0)
    refuse(file, "has a damaged member " + name + "; copy or save it again");
  return content;
}

/// The folder of main.xml within the archive, with a slash at its end. If a user packs a folder by
/// hand, the names of all members begin with this folder.
std::string folder_of(const std::filesystem::path& file, zip_t* archive) {
  constexpr std::string_view end = "/main.xml";
  if (zip_name_locate(archive, "main.xml", 0) >= 0) return "";
  std::string folder;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    const char* found = zip_get_name(archive, static_cast<zip_uint64_t>(i), 0);
    const std::string_view name = found ? found : "";
    if (!name.ends_with(end)) continue;
    if (!folder.empty())
      refuse(file, "holds several folders with a main.xml; pack the surface of one of them");
    folder = name.substr(0, name.size() - end.size() + 1);
  }
  return folder;
}

}  // namespace

LoadedSurface read_x3p(const std::filesystem::path& file, std::string_view content,
                       const std::string&) {
  const Archive archive = opened(file, content);
  const std::string folder = folder_of(file, archive.get());
  return x3p_surface(file, [&](const std::string& name, std::optional<std::uint64_t> bytes) {
    return extracted(file, archive.get(), folder + name, bytes, content.size());
  });
}

}  // namespace salebra::detail
