// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of X3P files: main.xml, heights, valid points and checksums in a ZIP archive.
#include <fmt/format.h>
#include <zip.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <utility>
#include <vector>

#include "atomic_file.hpp"
#include "md5.hpp"
#include "surface_writers.hpp"

namespace salebra::detail {
namespace {

using Member = std::pair<std::string, std::string>;  ///< name and content

std::string heights_of(const Surface& surface) {
  static_assert(std::endian::native == std::endian::little);
  const Field by_rows = surface.heights.transpose();
  return {reinterpret_cast<const char*>(by_rows.data()),
          static_cast<std::size_t>(by_rows.size()) * sizeof(double)};
}

/// A bit for each point, the least significant first, in the order of the heights.
std::string valid_points_of(const Surface& surface) {
  const Grid2D& grid = surface.grid;
  std::string bits((static_cast<std::size_t>(grid.points()) + 7) / 8, '\0');
  for (Index iy = 0; iy < grid.ny; ++iy) {
    for (Index ix = 0; ix < grid.nx; ++ix) {
      if (std::isnan(surface.heights(ix, iy))) continue;
      const auto place = static_cast<std::size_t>(iy * grid.nx + ix);
      bits[place / 8] =
          static_cast<char>(static_cast<unsigned char>(bits[place / 8]) | 1u << place % 8);
    }
  }
  return bits;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char symbol : text) {
    if (symbol == '&')
      result += "&amp;";
    else if (symbol == '<')
      result += "&lt;";
    else if (symbol == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(symbol) >= ' ' || symbol == '\n')
      result += symbol;
  }
  return result;
}

std::string data_link(const std::vector<Member>& members) {
  std::string link = fmt::format(
      "      <PointDataLink>{}</PointDataLink>\n"
      "      <MD5ChecksumPointData>{}</MD5ChecksumPointData>\n",
      members[0].first, md5(members[0].second));
  if (members.size() > 1)
    link += fmt::format(
        "      <ValidPointsLink>{}</ValidPointsLink>\n"
        "      <MD5ChecksumValidPoints>{}</MD5ChecksumValidPoints>\n",
        members[1].first, md5(members[1].second));
  return link;
}

std::string main_xml(const Surface& surface, const Provenance& provenance,
                     const std::vector<Member>& members) {
  const Grid2D& grid = surface.grid;
  const std::string created = provenance.created.empty() ? utc_now() : provenance.created;
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 http://www.opengps.eu/2008/ISO5436_2/ISO5436_2.xsd">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>SUR</FeatureType>
    <Axes>
      <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{}</Increment><Offset>0</Offset></CX>
      <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{}</Increment><Offset>0</Offset></CY>
      <CZ><AxisType>A</AxisType><DataType>D</DataType></CZ>
    </Axes>
  </Record1>
  <Record2>
    <Date>{}</Date>
    <Instrument>
      <Manufacturer>salebra</Manufacturer>
      <Model>salebra</Model>
      <Serial>not available</Serial>
      <Version>{}</Version>
    </Instrument>
    <CalibrationDate>{}</CalibrationDate>
    <ProbingSystem><Type>Software</Type><Identification>salebra</Identification></ProbingSystem>
    <Comment>{}</Comment>
  </Record2>
  <Record3>
    <MatrixDimension><SizeX>{}</SizeX><SizeY>{}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink>
{}    </DataLink>
  </Record3>
  <Record4>
    <ChecksumFile>md5checksum.hex</ChecksumFile>
  </Record4>
</p:ISO5436_2>
)",
      grid.dx(), grid.dy(), created, version(), created,
      escaped(description_of(surface, provenance).dump()), grid.nx, grid.ny, data_link(members));
}

void require_zip(bool worked, const char* what) {
  if (!worked) throw IoError(std::string("cannot ") + what + " of an X3P file");
}

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};

/// The archive as bytes. libzip would write a file of its own beside AtomicFile's.
std::string zipped(const std::vector<Member>& members) {
  zip_error_t error;
  zip_error_init(&error);
  const std::unique_ptr<zip_source_t, FreeSource> target(
      zip_source_buffer_create(nullptr, 0, 0, &error));
  require_zip(target != nullptr, "begin the archive");
  zip_source_keep(target.get());
  zip_t* archive = zip_open_from_source(target.get(), ZIP_TRUNCATE, &error);
  if (!archive) zip_source_free(target.get());
  require_zip(archive != nullptr, "begin the archive");
  for (const auto& [name, content] : members) {
    zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
    const auto index = source ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
      if (source) zip_source_free(source);
      zip_discard(archive);
    }
    require_zip(index >= 0, "add a member");
    // Doubles with noise in their last digits hardly shrink: the fastest level loses nothing but
    // time.
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_DEFLATE, 1);
  }
  const bool closed = zip_close(archive) == 0;
  if (!closed) zip_discard(archive);
  require_zip(closed, "finish the archive");

  zip_stat_t about;
  require_zip(zip_source_stat(target.get(), &about) == 0 && zip_source_open(target.get()) == 0,
              "collect the bytes");
  std::string bytes(about.size, '\0');
  std::uint64_t filled = 0;
  while (filled < bytes.size()) {
    const auto got = zip_source_read(target.get(), bytes.data() + filled, bytes.size() - filled);
    require_zip(got > 0, "collect the bytes");
    filled += static_cast<std::uint64_t>(got);
  }
  zip_source_close(target.get());
  return bytes;
}

}  // namespace

void write_x3p(const std::filesystem::path& file, const Surface& surface,
               const Provenance& provenance, const WriteOptions& options) {
  AtomicFile output(file, options);
  std::vector<Member> members{{"bindata/data.bin", heights_of(surface)}};
  if (surface.undefined_points() > 0)
    members.emplace_back("bindata/valid.bin", valid_points_of(surface));
  std::string xml = main_xml(surface, provenance, members);
  std::string sums = md5(xml) + " *main.xml\n";
  members.emplace(members.begin(), "main.xml", std::move(xml));
  members.emplace_back("md5checksum.hex", std::move(sums));
  output.write(zipped(members));
  output.commit();
}

}  // namespace salebra::detail
