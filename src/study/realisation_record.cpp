// SPDX-License-Identifier: GPL-3.0-or-later
// Binary record of a realisation with its key and checksum.
#include "realisation_record.hpp"

#include <cstring>
#include <filesystem>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <type_traits>

#include "case_run.hpp"
#include "io/checksum.hpp"
#include "io/input_file.hpp"
#include "io/sidecar.hpp"

namespace salebra::detail {
namespace {

constexpr std::string_view magic = "salebra realisation 8\n";

std::uint64_t checksum(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

/// Appends the bytes of numbers, and of lists and texts after their lengths.
class Writer {
 public:
  template <class... Items>
  void operator()(const Items&... items) {
    (put(items), ...);
  }
  std::string bytes;

 private:
  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void put(const Number& number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void put(const std::string& text) {
    put(std::uint64_t(text.size()));
    bytes += text;
  }
  template <class Item>
  void put(const std::vector<Item>& items) {
    put(std::uint64_t(items.size()));
    for (const Item& item : items) put(item);
  }
  template <class Item>
  void put(const std::optional<Item>& item) {
    put(item.has_value());
    if (item) put(*item);
  }
  template <Described Struct>
  void put(const Struct& value) {
    for_each_member<Struct>([&](auto member) { put(value.*member); });
  }
};

/// The inverse of Writer.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class... Items>
  void operator()(Items&... items) {
    (get(items), ...);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size()) throw InvalidInput("realisation", "is cut short");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void get(Number& number) { std::memcpy(&number, take(sizeof number).data(), sizeof number); }
  void get(std::string& text) {
    std::uint64_t size = 0;
    get(size);
    text = take(size);
  }
  template <class Item>
  void get(std::vector<Item>& items) {
    std::uint64_t size = 0;
    get(size);
    // An item has at least a byte: a wrong length must not reserve the memory of the machine.
    if (size > bytes_.size()) throw InvalidInput("realisation", "is cut short");
    items.resize(size);
    for (Item& item : items) get(item);
  }
  template <Described Struct>
  void get(Struct& value) {
    for_each_member<Struct>([&](auto member) { get(value.*member); });
  }

  std::string_view bytes_;
};

// A member without a line in its description would be lost.
static_assert(describes_all<Realisation>() && describes_all<Grid2D>() &&
              describes_all<HeightStatistics>() && describes_all<SpectralMoments>() &&
              describes_all<SummitStatistics>() && describes_all<SummitEnsemble>() &&
              describes_all<HeightDensityPoint>() && describes_all<ModelResult>() &&
              describes_all<ForceCurve>() && describes_all<ForceSample>() &&
              describes_all<FirstLoading>() && describes_all<ExponentialFit>() &&
              describes_all<ExponentialTest>() && describes_all<WindowSensitivity>() &&
              describes_all<PressureWindow>() && describes_all<LocalDecayLength>() &&
              describes_all<DampingPoint>() && describes_all<SpotStatistics>() &&
              describes_all<SurfacePicture>() && describes_all<SelfAffineParameters>() &&
              describes_all<Material>() && describes_all<EqualFrequency>() &&
              describes_all<Drag>());

/// Checksum of a file; 0 where there is none.
std::uint64_t checksum_of(const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? InputFile(file).checksum() : 0;
}

std::string header(std::uint64_t key, std::uint64_t length, std::uint64_t sum) {
  Writer writer;
  writer(key, length, sum);
  return std::string(magic) + writer.bytes;
}

}  // namespace

std::uint64_t realisation_key(const StudyConfiguration& point, std::uint64_t seed) {
  Writer writer;
  writer(std::string(magic), std::string(version()), seed, wants_picture(point, seed),
         point.surfaces.index());
  if (const auto* generated = std::get_if<GeneratedSurfaces>(&point.surfaces)) {
    writer(generated->grid, generated->spectrum, generated->method);
  } else {
    const auto& measured = std::get<MeasuredSurface>(point.surfaces);
    writer(checksum_of(measured.file), checksum_of(sidecar_of(measured.file)), measured.size_x,
           measured.size_y, measured.detrend, measured.height_unit);
  }
  writer(point.material, point.pressures, point.relative_pressures, point.tolerance, point.stick,
         point.window, point.models, point.known.hardness, point.motion.index());
  std::visit([&](const auto& motion) { writer(motion); }, point.motion);
  writer(point.damping.hold, point.damping.amplitude, point.damping.tolerance);
  // The first of several surfaces states the error of all.
  writer(point.levels, point.relative_error, point.seam, seeds_of(point).size() == 1,
         seed == seeds_of(point).front());
  return checksum(writer.bytes);
}

std::uint64_t study_key(const std::vector<StudyConfiguration>& points) {
  Writer writer;
  for (const StudyConfiguration& point : points) {
    for (const std::uint64_t seed : seeds_of(point)) writer(realisation_key(point, seed));
    writer(point.target_precision, point.min_realisations);
    const ContactFacts& known = point.known;
    writer(known.friction_coefficient, known.density, known.excursion);
  }
  return checksum(writer.bytes);
}

std::string encode(const Record& record, std::uint64_t key) {
  const PartOrigin& origin = record.origin;
  Writer writer;
  writer(origin.version, origin.arithmetic, origin.host, origin.shard, record.realisation);
  return header(key, writer.bytes.size(), checksum(writer.bytes)) + writer.bytes;
}

Record decode(std::string_view bytes, std::uint64_t key) {
  const std::string_view payload = bytes.substr(std::min(bytes.size(), header(0, 0, 0).size()));
  if (bytes.substr(0, bytes.size() - payload.size()) !=
      header(key, payload.size(), checksum(payload)))
    throw InvalidInput("realisation", "its checksum is wrong");
  Record record;
  PartOrigin& origin = record.origin;
  Reader reader(payload);
  reader(origin.version, origin.arithmetic, origin.host, origin.shard, record.realisation);
  if (!reader.at_end()) throw InvalidInput("realisation", "is longer than it should be");
  return record;
}

std::optional<PartOrigin> origin_of(std::string_view bytes) {
  const std::size_t start = header(0, 0, 0).size();
  if (bytes.size() < start || !bytes.starts_with(magic)) return {};
  PartOrigin origin;
  try {
    Reader(bytes.substr(start))(origin.version, origin.arithmetic, origin.host, origin.shard);
  } catch (const InvalidInput&) {
    return {};
  }
  return origin;
}

}  // namespace salebra::detail
