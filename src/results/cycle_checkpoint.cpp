// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of simulated cycles: states and settings in an HDF5 file
// (results/cycle_checkpoint.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/base/words.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/cycle_checkpoint.hpp>

#include "io/checksum.hpp"

namespace salebra {
namespace {

// What a state consists of, for the writer and the reader below.
template <class State, class Visitor>
void describe_cycle(State& state, Visitor& visit) {
  visit("period", state.period);
  visit("step", state.step);
  visit("smallest", state.smallest, "1 in contact at every step of the period");
  visit("largest", state.largest, "1 in contact at any step of the period");
  visit("tangential", state.tangential, "m", "tangential position");
  visit("energy_at_period_start", state.energy_at_period_start, "J",
        "stored energy at the start of the period");
  visit("work_at_period_start", state.work_at_period_start, "J",
        "work of the tangential force before the period");
  visit("normal_work_at_period_start", state.normal_work_at_period_start, "J",
        "work of the normal force before the period");
  visit("gap_work_at_period_start", state.gap_work_at_period_start, "J",
        "work across gaps before the period");
  visit("loss_at_period_start", state.loss_at_period_start, "J",
        "energy dissipated in each cell before the period");
  visit("last_work", state.last_work, "J", "work_per_cycle of the period before");
}

template <class Body, class Visitor>
void describe_body(Body& body, Visitor& visit) {
  if constexpr (requires { body.sliding; }) {  // a coupled body
    describe_body(body.sliding, visit);
    visit("gap", body.gap, "m", "gap between the deformed surfaces");
    visit("indentation", body.indentation, "m", "indentation");
    visit("normal_work", body.normal_work, "J", "work of the normal force");
    visit("gap_work", body.gap_work, "J", "work across gaps");
    visit("increments_converged", body.converged);
  } else {
    visit("traction", body.traction, "Pa", "shear traction");
    visit("displacement", body.displacement, "m", "displacement of cells in contact");
    visit("work", body.work, "J", "work of the tangential force");
    visit("released", body.released, "J", "energy dissipated by cells as they opened");
    visit("iterations", body.iterations);
    visit("fft_count", body.fft_count);
    visit("converged", body.converged);
    if constexpr (requires { body.unit_traction; }) {  // a stuck one
      visit("contact", body.contact, "1 in contact");
      visit("unit_traction", body.unit_traction, "Pa/m", "shear traction of a unit move");
    } else {
      visit("contact_pressure", body.contact_pressure, "Pa", "contact pressure");
      visit("shift", body.shift, "m", "displacement by other causes");
      visit("loss", body.loss, "J", "energy dissipated in each cell since the start");
      visit("prepared", body.prepared, "1 within the window of the kernels");
      visit("motion_scale", body.motion_scale, "m", "displacement that the tolerance refers to");
      visit("slipping", body.slipping);
    }
  }
}

class StateWriter {
 public:
  explicit StateWriter(ResultGroup group) : group_(std::move(group)) {}

  template <std::integral Count>
  void operator()(const char* name, Count value) {
    group_.attribute(name, static_cast<std::int64_t>(value));
  }
  void operator()(const char* name, double value, const char* units, const char* text) {
    group_.scalar(name, value, units, text);
  }
  void operator()(const char* name, const Field& values, const char* units, const char* text) {
    if (values.size() == 0) return;
    if (!has_axes_) {
      group_.index("x", static_cast<std::size_t>(values.rows()), "cell along x");
      group_.index("y", static_cast<std::size_t>(values.cols()), "cell along y");
      has_axes_ = true;
    }
    group_.dataset(name, values, "x", "y", units, text);
  }
  void operator()(const char* name, const ContactSet& set, const char* text) {
    (*this)(name, Field(set.cast<double>()), "1", text);
  }
  void operator()(const std::string& name, const TangentialField& field, const char* units,
                  const std::string& text) {
    (*this)((name + "_x").c_str(), field.x, units, (text + " along x").c_str());
    (*this)((name + "_y").c_str(), field.y, units, (text + " along y").c_str());
  }

 private:
  ResultGroup group_;
  bool has_axes_ = false;
};

class StateReader {
 public:
  StateReader(const ResultReader& reader, std::string group)
      : reader_(reader), group_(std::move(group)) {}

  template <std::integral Count>
  void operator()(const char* name, Count& value) {
    const std::optional<double> found = reader_.number_attribute(group_, name);
    require(found.has_value(), reader_.file().string(), name,
            "is missing; remove the damaged file");
    // The conversion of others is undefined.
    constexpr double most = std::min<double>(std::numeric_limits<Count>::max(), 1LL << 53);
    require(std::abs(*found) <= most, reader_.file().string(), name,
            "is out of range; remove the damaged file");
    value = static_cast<Count>(*found);
  }
  void operator()(const char* name, double& value, const char*, const char*) {
    value = reader_.number(path(name));
    require_finite(std::isfinite(value), name);
  }
  void operator()(const char* name, Field& values, const char*, const char*) {
    if (reader_.has(path(name))) values = field(name);
  }
  void operator()(const char* name, ContactSet& set, const char*) {
    if (reader_.has(path(name))) set = field(name) > 0.5;
  }
  void operator()(const std::string& name, TangentialField& components, const char*,
                  const std::string&) {
    components = {field(name + "_x"), field(name + "_y")};
  }

 private:
  std::string path(const std::string& name) const { return group_ + "/" + name; }
  void require_finite(bool finite, const std::string& name) const {
    require(finite, reader_.file().string(), name,
            "has values that are not finite; remove the damaged file");
  }
  Field field(const std::string& name) const {
    Field values = reader_.field(path(name));
    require_finite(values.isFinite().all(), name);
    return values;
  }

  const ResultReader& reader_;
  std::string group_;
};

// Checksum of everything that describe_cycle() and describe_body() visit, and of the samples.
class StateChecksum {
 public:
  void add(const CycleState& state) {
    number(static_cast<double>(state.body.index()));
    describe_cycle(state, *this);
    std::visit([&](const auto& body) { describe_body(body, *this); }, state.body);
    for (const CycleSample& sample : state.samples)
      describe([&](double CycleSample::*member, const Quantity&) { number(sample.*member); },
               std::type_identity<CycleSample>{});
  }

  template <std::integral Count>
  void operator()(const char*, Count value) {
    number(static_cast<double>(value));
  }
  void operator()(const char*, double value, const char*, const char*) { number(value); }
  void operator()(const char*, const Field& values, const char*, const char*) { array(values); }
  void operator()(const char*, const ContactSet& set, const char*) { array(set); }
  void operator()(const std::string&, const TangentialField& field, const char*,
                  const std::string&) {
    array(field.x);
    array(field.y);
  }

  std::string text() const { return fmt::format("{:016x}", bytes_.value()); }

 private:
  void number(double value) { bytes_.add({reinterpret_cast<const char*>(&value), sizeof value}); }
  template <class Array>
  void array(const Array& values) {
    number(static_cast<double>(values.rows()));
    bytes_.add({reinterpret_cast<const char*>(values.data()),
                static_cast<std::size_t>(values.size()) * sizeof *values.data()});
  }

  detail::Checksum bytes_;
};

std::string checksum_of(std::span<const CycleState> states) {
  StateChecksum sum;
  for (const CycleState& state : states) sum.add(state);
  return sum.text();
}

// Names in the order of CycleState::body.
constexpr std::array kinds{"stuck", "frictional", "coupled"};

void write_state(ResultFile& output, const CycleState& state) {
  const std::string kind = kinds[state.body.index()];
  StateWriter cycle(output.group(kind));
  describe_cycle(state, cycle);
  StateWriter body(output.group(kind + "/body"));
  std::visit([&](const auto& memory) { describe_body(memory, body); }, state.body);
  ResultGroup samples = output.group(kind + "/samples");
  samples.index("sample", state.samples.size(), "steps of the period so far");
  describe(
      [&](double CycleSample::*member, const Quantity& quantity) {
        std::vector<double> values;
        for (const CycleSample& sample : state.samples) values.push_back(sample.*member);
        samples.dataset(std::string(quantity.name), values, {"sample"},
                        std::string(si_unit(quantity.dimension)), std::string(quantity.long_name));
      },
      std::type_identity<CycleSample>{});
}

template <class Body>
CycleState read_state(const ResultReader& reader, const std::string& kind) {
  CycleState state;
  StateReader cycle(reader, kind);
  describe_cycle(state, cycle);
  StateReader memory(reader, kind + "/body");
  Body body;
  describe_body(body, memory);
  state.body = std::move(body);
  describe(
      [&](double CycleSample::*member, const Quantity& quantity) {
        const std::vector<double> values =
            reader.numbers(kind + "/samples/" + std::string(quantity.name));
        state.samples.resize(values.size());
        for (std::size_t k = 0; k < values.size(); ++k) state.samples[k].*member = values[k];
      },
      std::type_identity<CycleSample>{});
  return state;
}

}  // namespace

CycleSettings cycle_settings(const Grid2D& grid, const Material& material,
                             const Oscillation& motion, double mean_indentation,
                             const CycleOptions& options) {
  CycleSettings settings{{"arithmetic", arithmetic()}};
  const auto add = [&](const char* name, double value) {
    settings.emplace_back(name, fmt::format("{}", value));
  };
  add("nx", static_cast<double>(grid.nx));
  add("ny", static_cast<double>(grid.ny));
  add("size_x", grid.lx);
  add("size_y", grid.ly);
  add("contact_modulus", material.contact_modulus);
  add("cerruti_isotropic", material.cerruti_isotropic);
  add("cerruti_directed", material.cerruti_directed);
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
  settings.emplace_back("boundary", word_of(options.stick.boundary));
  settings.emplace_back("lateral", options.stick.hold_lateral ? "held" : "free");
  return settings;
}

std::string fingerprint(const Field& values) {
  detail::Checksum sum;
  sum.add({reinterpret_cast<const char*>(values.data()),
           static_cast<std::size_t>(values.size()) * sizeof(double)});
  return fmt::format("{:016x}", sum.value());
}

void write_cycle_checkpoint(const std::filesystem::path& file, std::span<const CycleState> states,
                            const CycleSettings& settings, const Provenance& provenance) {
  ResultFile output(file, provenance, {.overwrite = true});
  ResultGroup agreed = output.group("settings");
  for (const auto& [name, value] : settings) agreed.attribute(name, value);
  agreed.attribute("checksum", checksum_of(states));
  for (const CycleState& state : states) write_state(output, state);
  output.commit();
}

std::vector<CycleState> read_cycle_checkpoint(const std::filesystem::path& file,
                                              const CycleSettings& settings) {
  const ResultReader reader(file);
  const auto holds = [&](const char* kind) { return reader.has(kind); };
  require(reader.has("settings") && std::ranges::any_of(kinds, holds), file.string(), "",
          "is no checkpoint of a cycle; name a file that a simulation left");
  const auto require_same = [&](const char* group, const std::string& name,
                                std::string_view value) {
    const std::optional<std::string> then = reader.text_attribute(group, name);
    if (!then || *then != value)
      throw InvalidInput(file.string(),
                         fmt::format("{} was {} in the checkpoint and is {} now; resume with the "
                                     "settings of the first run or remove the file",
                                     name, then ? *then : "not there", value));
  };
  require_same("/", "version", version());
  for (const auto& [name, value] : settings) require_same("settings", name, value);
  std::vector<CycleState> states;
  if (holds(kinds[0])) states.push_back(read_state<StuckState>(reader, kinds[0]));
  if (holds(kinds[1])) states.push_back(read_state<SlidingState>(reader, kinds[1]));
  if (holds(kinds[2])) states.push_back(read_state<CoupledState>(reader, kinds[2]));
  require(reader.text_attribute("settings", "checksum") == checksum_of(states), file.string(), "",
          "is damaged: its states do not match their checksum; remove it to begin the cycle anew");
  return states;
}

}  // namespace salebra
