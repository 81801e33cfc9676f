// SPDX-License-Identifier: GPL-3.0-or-later
// Binary record of a realisation with its key and checksum.
#include "realisation_record.hpp"

#include <array>
#include <cstring>
#include <filesystem>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <type_traits>

#include "io/input_file.hpp"
#include "io/sidecar.hpp"
#include "point_run.hpp"

namespace salebra::detail {
namespace {

constexpr std::string_view magic = "salebra realisation 4\n";

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
  template <class Struct>
  requires std::is_class_v<Struct>
  void put(const Struct& value) { fields(*this, value); }
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
    if (count > bytes_.size()) throw InvalidInput("realisation: is cut short");
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
    if (size > bytes_.size()) throw InvalidInput("realisation: is cut short");
    items.resize(size);
    for (Item& item : items) get(item);
  }
  template <class Struct>
  requires std::is_class_v<Struct>
  void get(Struct& value) { fields(*this, value); }

  std::string_view bytes_;
};

/// fields(archive, struct): its members, in the order of their declaration. S is the struct or its const form.
template <class S, class T>
concept Of = std::is_same_v<std::remove_const_t<S>, T>;

// Extend these when a struct grows; the static_assert is a reminder.
static_assert(sizeof(ForceSample) == 9 * 8 && sizeof(DampingPoint) == 8 * 8 &&
              sizeof(ExponentialFit) == 9 * 8 && sizeof(ExponentialTest) == 8 * 8 &&
              sizeof(HeightStatistics) == 7 * 8 && sizeof(SpectralMoments) == 5 * 8 &&
              sizeof(SummitStatistics) == 4 * 8);

template <class A, Of<Grid2D> S>
void fields(A& archive, S& s) {
  archive(s.nx, s.ny, s.lx, s.ly);
}
template <class A, Of<HeightStatistics> S>
void fields(A& archive, S& s) {
  archive(s.defined_points, s.minimum, s.maximum, s.mean, s.rms_height, s.skewness, s.kurtosis);
}
template <class A, Of<SpectralMoments> S>
void fields(A& archive, S& s) {
  archive(s.moment0, s.moment2_x, s.moment2_y, s.moment4_x, s.moment4_y);
}
template <class A, Of<SummitStatistics> S>
void fields(A& archive, S& s) {
  archive(s.density, s.mean_height, s.rms_height, s.mean_radius);
}
template <class A, Of<HeightDensityPoint> S>
void fields(A& archive, S& s) {
  archive(s.height, s.density);
}
template <class A, Of<SummitEnsemble> S>
void fields(A& archive, S& s) {
  archive(s.density, s.radius, s.summit_rms, s.mean_height, s.distribution, s.rms_height, s.table);
}
template <class A, Of<ForceSample> S>
void fields(A& archive, S& s) {
  archive(s.indentation, s.mean_gap, s.separation, s.force, s.pressure, s.contact_area_fraction,
          s.normal_stiffness, s.tangential_stiffness, s.converged);
}
template <class A, Of<ForceCurve> S>
void fields(A& archive, S& s) {
  archive(s.model, s.nominal_area, s.rms_height, s.samples);
}
template <class A, Of<PressureWindow> S>
void fields(A& archive, S& s) {
  archive(s.pressure_min, s.pressure_max, s.points);
}
template <class A, Of<ExponentialFit> S>
void fields(A& archive, S& s) {
  archive(s.decay_length, s.decay_length_low, s.decay_length_high, s.reference_pressure,
          s.r_squared, s.window, s.decay_length_over_rms_height);
}
template <class A, Of<ExponentialTest> S>
void fields(A& archive, S& s) {
  archive(s.quadratic, s.standard_error, s.significance, s.decay_length_closest,
          s.decay_length_farthest, s.window);
}
template <class A, Of<WindowSensitivity> S>
void fields(A& archive, S& s) {
  archive(s.decay_length_min, s.decay_length_max, s.windows);
}
template <class A, Of<LocalDecayLength> S>
void fields(A& archive, S& s) {
  archive(s.mean_gap, s.decay_length);
}
template <class A, Of<DampingPoint> S>
void fields(A& archive, S& s) {
  archive(s.pressure, s.force, s.law_work, s.law_damping_constant, s.small_work,
          s.small_damping_constant, s.curve_work, s.curve_damping_constant);
}
template <class A, Of<ModelResult> S>
void fields(A& archive, S& s) {
  archive(s.curve, s.fit, s.test, s.sensitivity, s.local, s.area_slope, s.damping);
}
template <class A, Of<SpotStatistics> S>
void fields(A& archive, S& s) {
  archive(s.count, s.corrected_area_fraction, s.largest_area, s.mean_area, s.sizes);
}
template <class A, Of<SurfacePicture> S>
void fields(A& archive, S& s) {
  archive(s.origin, s.stride, s.nx, s.ny, s.step_x, s.step_y, s.heights, s.first_load, s.wavenumber,
          s.density, s.law_density, s.law, s.hurst, s.hurst_low, s.hurst_high, s.height,
          s.height_density);
}
template <class A, Of<Realisation> S>
void fields(A& archive, S& s) {
  archive(s.seed, s.grid, s.periodic, s.seam_step, s.heights, s.moments, s.summits, s.ensemble,
          s.bem, s.gw_moments, s.gw_deterministic, s.gw_monte_carlo, s.gw_interacting, s.persson,
          s.spots, s.corrected_area_slope, s.persson_decay_length, s.picture);
}

// What follows is only ever written, into keys.
template <class A, Of<SelfAffineParameters> S>
void fields(A& archive, S& s) {
  archive(s.hurst, s.long_cutoff, s.rolloff, s.short_cutoff, s.rms_height, s.rms_slope);
}
template <class A, Of<Material> S>
void fields(A& archive, S& s) {
  archive(s.contact_modulus, s.tangential_modulus, s.cerruti_isotropic, s.cerruti_directed);
}
template <class A, Of<EqualFrequency> S>
void fields(A& archive, S& s) {
  archive(s.normal_amplitude, s.tangential_amplitude, s.phase, s.angular_frequency);
}
template <class A, Of<Drag> S>
void fields(A& archive, S& s) {
  archive(s.normal_amplitude, s.drag_velocity, s.angular_frequency);
}

/// Empty where there is no such file.
std::string contents(const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? InputFile(file).content() : std::string();
}

std::string header(std::uint64_t key, std::uint64_t length, std::uint64_t sum) {
  Writer writer;
  writer(key, length, sum);
  return std::string(magic) + writer.bytes;
}

}  // namespace

std::uint64_t checksum(std::string_view bytes) {
  static const auto table = [] {
    constexpr std::uint64_t polynomial = 0xc96c5795d7870f42;  // ECMA-182, bits reversed
    std::array<std::uint64_t, 256> entries;
    for (std::uint64_t i = 0; i < 256; ++i) {
      entries[i] = i;
      for (int bit = 0; bit < 8; ++bit)
        entries[i] = (entries[i] >> 1) ^ ((entries[i] & 1) ? polynomial : 0);
    }
    return entries;
  }();
  std::uint64_t sum = ~std::uint64_t{0};
  for (const char byte : bytes)
    sum = table[(sum ^ static_cast<unsigned char>(byte)) & 0xff] ^ (sum >> 8);
  return ~sum;
}

std::uint64_t realisation_key(const StudyConfiguration& point, std::uint64_t seed) {
  Writer writer;
  writer(std::string(magic), std::string(version()), seed, wants_picture(point, seed),
         point.surfaces.index());
  if (const auto* generated = std::get_if<GeneratedSurfaces>(&point.surfaces)) {
    writer(generated->grid, generated->spectrum, generated->method);
  } else {
    const auto& measured = std::get<MeasuredSurface>(point.surfaces);
    writer(contents(measured.file), contents(sidecar_of(measured.file)), measured.size_x,
           measured.size_y, measured.detrend, measured.height_unit);
  }
  writer(point.material, point.pressures, point.relative_pressures, point.tolerance, point.stick,
         point.window, point.models, point.motion.index());
  std::visit([&](const auto& motion) { writer(motion); }, point.motion);
  writer(point.damping.hold, point.damping.amplitude, point.damping.tolerance);
  return checksum(writer.bytes);
}

std::uint64_t study_key(const std::vector<StudyConfiguration>& points) {
  Writer writer;
  for (const StudyConfiguration& point : points) {
    for (const std::uint64_t seed : seeds_of(point)) writer(realisation_key(point, seed));
    writer(point.precision, point.least_realisations);
  }
  return checksum(writer.bytes);
}

std::string encode(const Realisation& realisation, std::uint64_t key) {
  Writer writer;
  writer(arithmetic(), realisation);
  return header(key, writer.bytes.size(), checksum(writer.bytes)) + writer.bytes;
}

Realisation decode(std::string_view bytes, std::uint64_t key) {
  const std::string expected_size = header(0, 0, 0);
  const std::string_view payload = bytes.substr(std::min(bytes.size(), expected_size.size()));
  if (bytes.substr(0, expected_size.size()) != header(key, payload.size(), checksum(payload)))
    throw InvalidInput("realisation: its checksum is wrong");
  Realisation realisation;
  Reader reader(payload);
  std::string computed_by;
  reader(computed_by);
  if (computed_by != arithmetic()) throw OtherArithmetic(computed_by);
  reader(realisation);
  if (!reader.at_end()) throw InvalidInput("realisation: is longer than it should be");
  return realisation;
}

}  // namespace salebra::detail
