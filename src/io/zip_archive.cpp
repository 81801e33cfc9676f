// SPDX-License-Identifier: GPL-3.0-or-later
// Writes ZIP archives in memory.
#include "zip_archive.hpp"

#include <zip.h>

#include <memory>
#include <salebra/base/error.hpp>

namespace salebra::detail {
namespace {

constexpr zip_uint16_t first_date = (1 << 5) | 1;  // 1980-01-01 in the form of MS-DOS

struct CloseSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct DiscardArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

[[noreturn]] void refuse(const std::string& reason) {
  throw IoError("the archive cannot be made (" + reason + ")");
}

void add(zip_t* archive, const ZipMember& member) {
  zip_source_t* content =
      zip_source_buffer(archive, member.content.data(), member.content.size(), 0);
  const zip_int64_t index =
      content != nullptr ? zip_file_add(archive, member.name.c_str(), content, ZIP_FL_ENC_UTF_8)
                         : -1;
  if (index < 0) {
    zip_source_free(content);
    refuse(zip_strerror(archive));
  }
  if (zip_file_set_dostime(archive, zip_uint64_t(index), 0, first_date, 0) != 0)
    refuse(zip_strerror(archive));
}

}  // namespace

std::string zip_archive(const std::vector<ZipMember>& members) {
  zip_error_t error;
  zip_error_init(&error);
  const std::unique_ptr<zip_source_t, CloseSource> source(
      zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!source) refuse(zip_error_strerror(&error));
  std::unique_ptr<zip_t, DiscardArchive> archive(
      zip_open_from_source(source.get(), ZIP_TRUNCATE, &error));
  if (!archive) refuse(zip_error_strerror(&error));
  zip_source_keep(source.get());  // the archive frees one reference when it is closed
  for (const ZipMember& member : members) add(archive.get(), member);
  if (zip_close(archive.get()) != 0) refuse(zip_strerror(archive.get()));
  static_cast<void>(archive.release());  // zip_close() has freed it
  zip_stat_t about;
  if (zip_source_stat(source.get(), &about) != 0 || zip_source_open(source.get()) != 0)
    refuse(zip_error_strerror(zip_source_error(source.get())));
  std::string bytes(about.size, '\0');
  const zip_int64_t got = zip_source_read(source.get(), bytes.data(), bytes.size());
  zip_source_close(source.get());
  if (got != zip_int64_t(bytes.size())) refuse("it cannot be read back");
  return bytes;
}

}  // namespace salebra::detail
