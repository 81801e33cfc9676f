// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of simulated cycles: states and settings in an HDF5 file
// (results/cycle_checkpoint.hpp).
#include "cycle_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/result_file.hpp>

#include "base/archive.hpp"
#include "base/checksum.hpp"

namespace salebra {
namespace {

std::string unit(const auto& line) { return std::string(si_unit(line.dimension)); }

/// Writes a state of a cycle as a group of the file: counts, booleans and names as attributes,
/// numbers and fields as datasets, samples and body as groups within it.
class StateWriter {
 public:
  StateWriter(ResultFile& file, const std::string& path)
      : file_(file), path_(path), group_(file.group(path)) {}

  template <Described State>
  void write(const State& state) {
    describe([&](auto member, const auto& line) { put(line, state.*member); },
             std::type_identity<State>{});
  }

 private:
  template <std::integral Count>
  void put(const Kept& line, Count count) {
    group_.attribute(std::string(line.name), static_cast<std::int64_t>(count));
  }
  template <class Enum>
    requires std::is_enum_v<Enum>
  void put(const Kept& line, Enum value) {
    group_.attribute(std::string(line.name), std::string(name_of(value)));
  }
  void put(const Kept& line, double number) {
    group_.scalar(std::string(line.name), number, unit(line), std::string(line.meaning));
  }
  void put(const Kept& line, const Field& values, const std::string& end = "",
           const std::string& direction = "") {
    if (values.size() == 0) return;
    if (!has_axes_) {
      group_.index("x", static_cast<std::size_t>(values.rows()), "cell along x");
      group_.index("y", static_cast<std::size_t>(values.cols()), "cell along y");
      has_axes_ = true;
    }
    group_.dataset(std::string(line.name) + end, values, "x", "y", unit(line),
                   std::string(line.meaning) + direction);
  }
  void put(const Kept& line, const ContactSet& set) { put(line, Field(set.cast<double>())); }
  void put(const Kept& line, const TangentialField& field) {
    put(line, field.x, "_x", " along x");
    put(line, field.y, "_y", " along y");
  }
  template <class... Body>
  void put(const Kept& line, const std::variant<Body...>& bodies) {
    StateWriter within(file_, path_ + "/" + std::string(line.name));
    std::visit([&](const auto& body) { within.write(body); }, bodies);
  }
  void put(const Part&, const auto& inner) { write(inner); }
  template <Described Row>
  void put(const Table& line, const std::vector<Row>& rows) {
    ResultGroup table = file_.group(path_ + "/" + std::string(line.name));
    table.index("sample", rows.size(), "steps of the period so far");
    describe(
        [&](auto member, const Quantity& column) {
          std::vector<double> values;
          for (const Row& row : rows) values.push_back(row.*member);
          table.dataset(std::string(column.name), values, {"sample"}, unit(column),
                        std::string(column.long_name));
        },
        std::type_identity<Row>{});
  }

  ResultFile& file_;
  std::string path_;
  ResultGroup group_;
  bool has_axes_ = false;
};

/// Reads a state that StateWriter wrote.
class StateReader {
 public:
  StateReader(const ResultReader& reader, std::string path)
      : reader_(reader), path_(std::move(path)) {}

  template <Described State>
  void read(State& state) {
    describe([&](auto member, const auto& line) { get(line, state.*member); },
             std::type_identity<State>{});
  }

 private:
  template <std::integral Count>
  void get(const Kept& line, Count& count) {
    const std::string name(line.name);
    const std::optional<double> found = reader_.number_attribute(path_, name);
    require(found.has_value(), reader_.file().string(), name,
            "is missing; remove the damaged file");
    // Refuses a number that the integer type cannot hold; converting it would be undefined
    // behaviour.
    constexpr std::uint64_t most =
        std::min<std::uint64_t>(std::numeric_limits<Count>::max(), std::uint64_t{1} << 53);
    require(std::abs(*found) <= static_cast<double>(most), reader_.file().string(), name,
            "is out of range; remove the damaged file");
    count = static_cast<Count>(*found);
  }
  template <class Enum>
    requires std::is_enum_v<Enum>
  void get(const Kept& line, Enum& value) {
    const std::string name(line.name);
    const std::optional<Enum> found =
        parse_enum<Enum>(reader_.text_attribute(path_, name).value_or(""));
    require(found.has_value(), reader_.file().string(), name,
            "is missing; remove the damaged file");
    value = *found;
  }
  void get(const Kept& line, double& number) {
    number = reader_.number(within(line));
    require_finite(std::isfinite(number), std::string(line.name));
  }
  void get(const Kept& line, Field& values, const std::string& end = "") {
    const std::string path = within(line) + end;
    if (!reader_.has(path)) return;
    values = reader_.field(path);
    require_finite(values.isFinite().all(), std::string(line.name) + end);
  }
  void get(const Kept& line, ContactSet& set) {
    Field values;
    get(line, values);
    set = values > 0.5;
  }
  void get(const Kept& line, TangentialField& field) {
    get(line, field.x, "_x");
    get(line, field.y, "_y");
  }
  template <class... Body>
  void get(const Kept& line, std::variant<Body...>& bodies) {
    std::visit([&](auto& body) { StateReader(reader_, within(line)).read(body); }, bodies);
  }
  void get(const Part&, auto& inner) { read(inner); }
  template <Described Row>
  void get(const Table& line, std::vector<Row>& rows) {
    describe(
        [&](auto member, const Quantity& column) {
          const std::vector<double> values =
              reader_.numbers(within(line) + "/" + std::string(column.name));
          rows.resize(values.size());
          for (std::size_t k = 0; k < values.size(); ++k) rows[k].*member = values[k];
        },
        std::type_identity<Row>{});
  }

  std::string within(const auto& line) const { return path_ + "/" + std::string(line.name); }
  void require_finite(bool finite, const std::string& name) const {
    require(finite, reader_.file().string(), name,
            "has values that are not finite; remove the damaged file");
  }

  const ResultReader& reader_;
  std::string path_;
};

/// A visitor of described states that computes the checksum of their data instead of storing them.
struct StateSum {
  static constexpr bool reads = false;
  detail::Checksum sum = {};
  void raw(const void* data, std::size_t size) { sum.add({static_cast<const char*>(data), size}); }
};

std::string checksum_of(std::span<const CycleState> states) {
  StateSum bytes;
  for (const CycleState& state : states) detail::archive(bytes, state);
  return bytes.sum.digits();
}

// Names of the kinds of bodies, in the order of the types in CycleState::body.
constexpr std::array kinds{"stuck", "frictional", "coupled"};

}  // namespace

CycleSettings cycle_settings(const Grid2D& grid, const Body& body, const Oscillation& motion,
                             double mean_indentation, const CycleOptions& options) {
  CycleSettings settings{{"arithmetic", arithmetic()}};
  const auto add = [&](const char* name, double value) {
    settings.emplace_back(name, fmt::format("{}", value));
  };
  add("nx", static_cast<double>(grid.nx));
  add("ny", static_cast<double>(grid.ny));
  add("size_x", grid.lx);
  add("size_y", grid.ly);
  if (const auto& material = body.half_space_material()) {
    add("contact_modulus", material->contact_modulus);
    add("cerruti_isotropic", material->cerruti_isotropic);
    add("cerruti_directed", material->cerruti_directed);
  } else {
    settings.emplace_back("body", body.fingerprint());
  }
  add("indentation", mean_indentation);
  if (const auto* drag = std::get_if<Drag>(&motion)) {
    add("normal_amplitude", drag->normal_amplitude);
    add("drag_velocity", drag->drag_velocity);
    add("angular_frequency", drag->angular_frequency);
  } else {
    const auto& equal = std::get<EqualFrequency>(motion);
    add("normal_amplitude", equal.normal_amplitude);
    add("tangential_amplitude", equal.tangential_amplitude);
    add("phase", equal.phase);
  }
  add("direction", options.direction);
  add("friction_coefficient", options.friction_coefficient);
  if (options.coupling_constant) add("coupling_constant", *options.coupling_constant);
  add("steps", options.steps);
  add("max_periods", options.max_periods);
  add("steady_tolerance", options.steady_tolerance);
  add("tolerance", options.stick.tolerance);
  add("max_iterations", options.stick.max_iterations);
  settings.emplace_back("boundary", name_of(options.stick.boundary));
  settings.emplace_back("lateral", options.stick.hold_lateral ? "held" : "free");
  return settings;
}

std::string fingerprint(const Field& values) {
  return detail::Checksum({reinterpret_cast<const char*>(values.data()),
                           static_cast<std::size_t>(values.size()) * sizeof(double)})
      .digits();
}

void write_cycle_checkpoint(const std::filesystem::path& file, std::span<const CycleState> states,
                            const CycleSettings& settings, const Provenance& provenance) {
  ResultFile output(file, provenance, {.overwrite = true});
  ResultGroup agreed = output.group("settings");
  for (const auto& [name, value] : settings) agreed.attribute(name, value);
  agreed.attribute("checksum", checksum_of(states));
  for (const CycleState& state : states)
    StateWriter(output, kinds[state.body.index()]).write(state);
  output.commit();
}

std::vector<CycleState> read_cycle_checkpoint(const std::filesystem::path& file,
                                              const CycleSettings& settings) {
  const ResultReader reader(file);
  const auto holds = [&](const char* kind) { return reader.has(kind); };
  require(reader.has("settings") && std::ranges::any_of(kinds, holds), file.string(), "",
          "is not a checkpoint of a cycle; name a file that a simulation wrote");
  const auto require_same = [&](const char* group, const std::string& name,
                                std::string_view value) {
    const std::optional<std::string> then = reader.text_attribute(group, name);
    if (!then || *then != value)
      throw InvalidInput(file.string(),
                         fmt::format("{} is {} in the checkpoint but {} now; resume with the "
                                     "settings of the first run or remove the file",
                                     name, then ? *then : "not there", value));
  };
  require_same("/", "version", version());
  for (const auto& [name, value] : settings) require_same("settings", name, value);
  std::vector<CycleState> states;
  const auto read = [&]<class Body>(const char* kind, std::type_identity<Body>) {
    if (!holds(kind)) return;
    CycleState& state = states.emplace_back();
    state.body.emplace<Body>();
    StateReader(reader, kind).read(state);
  };
  read(kinds[0], std::type_identity<StuckState>{});
  read(kinds[1], std::type_identity<SlidingState>{});
  read(kinds[2], std::type_identity<CoupledState>{});
  require(reader.text_attribute("settings", "checksum") == checksum_of(states), file.string(), "",
          "is damaged: its states do not match their checksum; remove it to start the cycle again");
  return states;
}

}  // namespace salebra
