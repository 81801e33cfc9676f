// SPDX-License-Identifier: GPL-3.0-or-later
// Binary record of a realisation, with its key and a checksum.
#include "realisation_record.hpp"

#include <filesystem>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>

#include "base/archive.hpp"
#include "base/checksum.hpp"
#include "case_run.hpp"
#include "io/input_file.hpp"
#include "io/sidecar.hpp"

namespace salebra::detail {
namespace {

constexpr std::string_view magic = "salebra realisation 16\n";

/// Checksum of a file; 0 if the file does not exist.
std::uint64_t checksum_of(const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? InputFile(file).checksum() : 0;
}

std::string header(std::uint64_t key, std::uint64_t length, std::uint64_t sum) {
  return std::string(magic) + bytes_of(key, length, sum);
}

}  // namespace

std::uint64_t realisation_key(const StudyConfiguration& point, std::uint64_t seed) {
  std::string bytes = bytes_of(std::string(magic), std::string(version()), seed,
                               wants_picture(point, seed), point.surfaces.index());
  if (const auto* generated = std::get_if<GeneratedSurfaces>(&point.surfaces)) {
    bytes += bytes_of(generated->grid, generated->spectrum, generated->method, generated->tables,
                      generated->textures);
  } else {
    const auto& measured = std::get<MeasuredSurface>(point.surfaces);
    bytes += bytes_of(checksum_of(measured.file), checksum_of(sidecar_of(measured.file)),
                      measured.size_x, measured.size_y, measured.detrend, measured.height_unit,
                      measured.transpose, measured.pixel_size, measured.lateral_unit,
                      measured.despike, measured.crop, measured.fill, measured.channel,
                      measured.filters.s_filter, measured.filters.l_filter);
  }
  // The last two entries say whether the surface is the only one, and whether it is the first. A
  // study of one surface drops uncertain losses, and the first of several surfaces computes the
  // numerical error for all.
  bytes += bytes_of(
      point.body ? Material{} : point.material, point.pressures, point.relative_pressures,
      point.tolerance, point.stick, point.flow_factors, point.window, point.models, point.adhesion,
      point.known.hardness, point.known.friction_coefficient, point.known.excursion, point.motion,
      point.damping.hold, point.damping.amplitude, point.damping.tolerance, point.intervals,
      point.relative_error, point.seam, point.direction.index(),
      std::visit([](auto value) { return static_cast<double>(value); }, point.direction),
      seeds_of(point).size() == 1, seed == seeds_of(point).front());
  if (point.body) bytes += bytes_of(point.body->fingerprint());
  return Checksum(bytes).value();
}

std::uint64_t study_key(const std::vector<StudyConfiguration>& points) {
  std::string bytes;
  for (const StudyConfiguration& point : points) {
    for (const std::uint64_t seed : seeds_of(point))
      bytes += bytes_of(realisation_key(point, seed));
    bytes += bytes_of(point.target_precision, point.min_realisations, point.known.density,
                      point.conduction);
  }
  return Checksum(bytes).value();
}

std::string encode(const Record& record, std::uint64_t key) {
  const std::string payload = bytes_of(record.origin, record.realisation);
  return header(key, payload.size(), Checksum(payload).value()) + payload;
}

Record decode(std::string_view bytes, std::uint64_t key) {
  const std::string_view payload = bytes.substr(std::min(bytes.size(), header(0, 0, 0).size()));
  ByteReader reader(payload, "realisation");
  reader.require(bytes.substr(0, bytes.size() - payload.size()) ==
                 header(key, payload.size(), Checksum(payload).value()));
  Record record;
  archive(reader, record.origin);
  archive(reader, record.realisation);
  reader.require(reader.left() == 0);
  return record;
}

std::optional<PartOrigin> origin_of(std::string_view bytes) {
  const std::size_t start = header(0, 0, 0).size();
  if (bytes.size() < start || !bytes.starts_with(magic)) return {};
  try {
    return from_bytes<PartOrigin>(bytes.substr(start), "realisation");
  } catch (const InvalidInput&) {
    return {};
  }
}

}  // namespace salebra::detail
