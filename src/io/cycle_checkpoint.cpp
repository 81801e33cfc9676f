// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of simulated cycles in HDF5, with the settings that a resumed run must match.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/cycle_checkpoint.hpp>
#include <salebra/io/result_file.hpp>

namespace salebra {
namespace {

template <class State>
struct Number {
  const char* name;
  double State::*value;
  const char* units;
  const char* text;
};
constexpr std::array cycle_numbers{
    Number<CycleState>{"tangential", &CycleState::tangential, "m", "tangential position"},
    Number<CycleState>{"period_start", &CycleState::period_start, "m",
                       "tangential position at the start of the period"},
    Number<CycleState>{"work", &CycleState::work, "J",
                       "work of the tangential force in the period"},
    Number<CycleState>{"released_energy", &CycleState::released_energy, "J",
                       "energy released in the period"},
    Number<CycleState>{"energy_at_period_start", &CycleState::energy_at_period_start, "J",
                       "stored energy at the start of the period"},
    Number<CycleState>{"last_work", &CycleState::last_work, "J", "loss of the period before"}};
constexpr std::array friction_numbers{
    Number<FrictionalCycleState>{"tangential", &FrictionalCycleState::tangential, "m",
                                 "tangential position"},
    Number<FrictionalCycleState>{"energy_at_period_start",
                                 &FrictionalCycleState::energy_at_period_start, "J",
                                 "stored energy at the start of the period"},
    Number<FrictionalCycleState>{"work_at_period_start",
                                 &FrictionalCycleState::work_at_period_start, "J",
                                 "work of the tangential force before the period"},
    Number<FrictionalCycleState>{"normal_work_at_period_start",
                                 &FrictionalCycleState::normal_work_at_period_start, "J",
                                 "work of the normal force before the period"},
    Number<FrictionalCycleState>{"last_work", &FrictionalCycleState::last_work, "J",
                                 "loss of the period before"}};
constexpr std::array sliding_numbers{
    Number<SlidingState>{"work", &SlidingState::work, "J", "work of the tangential force"},
    Number<SlidingState>{"released", &SlidingState::released, "J", "energy dissipated by cells as they opened"}};

template <class Sample>
struct Column {
  const char* name;
  double Sample::*value;
  const char* units;
};
constexpr std::array cycle_columns{
    Column<CycleSample>{"time", &CycleSample::t, "1"},
    Column<CycleSample>{"indentation", &CycleSample::indentation, "m"},
    Column<CycleSample>{"tangential", &CycleSample::tangential, "m"},
    Column<CycleSample>{"tangential_force", &CycleSample::tangential_force, "N"},
    Column<CycleSample>{"normal_force", &CycleSample::normal_force, "N"},
    Column<CycleSample>{"work", &CycleSample::work, "J"},
    Column<CycleSample>{"released_energy", &CycleSample::released_energy, "J"},
    Column<CycleSample>{"contact_area", &CycleSample::contact_area, "m^2"},
    Column<CycleSample>{"tangential_stiffness", &CycleSample::tangential_stiffness, "N/m"}};
constexpr std::array friction_columns{
    Column<FrictionalSample>{"time", &FrictionalSample::t, "1"},
    Column<FrictionalSample>{"indentation", &FrictionalSample::indentation, "m"},
    Column<FrictionalSample>{"tangential", &FrictionalSample::tangential, "m"},
    Column<FrictionalSample>{"tangential_force", &FrictionalSample::tangential_force, "N"},
    Column<FrictionalSample>{"normal_force", &FrictionalSample::normal_force, "N"},
    Column<FrictionalSample>{"work", &FrictionalSample::work, "J"},
    Column<FrictionalSample>{"dissipated", &FrictionalSample::dissipated, "J"},
    Column<FrictionalSample>{"contact_area", &FrictionalSample::contact_area, "m^2"},
    Column<FrictionalSample>{"slip_area", &FrictionalSample::slip_area, "m^2"}};

template <class State, std::size_t count>
void write_numbers(ResultGroup& group, const State& state,
                   const std::array<Number<State>, count>& numbers) {
  for (const Number<State>& number : numbers)
    group.scalar(number.name, state.*number.value, number.units, number.text);
}

template <class State, std::size_t count>
void read_numbers(const ResultReader& reader, const std::string& group, State& state,
                  const std::array<Number<State>, count>& numbers) {
  for (const Number<State>& number : numbers)
    state.*number.value = reader.number(group + "/" + number.name);
}

template <class Sample, std::size_t count>
void write_samples(ResultGroup group, const std::vector<Sample>& samples,
                   const std::array<Column<Sample>, count>& columns) {
  group.index("sample", samples.size(), "steps of the period so far");
  for (const Column<Sample>& column : columns) {
    std::vector<double> values;
    for (const Sample& sample : samples) values.push_back(sample.*column.value);
    group.dataset(column.name, values, {"sample"}, column.units, column.name);
  }
}

template <class Sample, std::size_t count>
std::vector<Sample> read_samples(const ResultReader& reader, const std::string& group,
                                 const std::array<Column<Sample>, count>& columns) {
  std::vector<Sample> samples;
  for (const Column<Sample>& column : columns) {
    const std::vector<double> values = reader.numbers(group + "/" + column.name);
    samples.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) samples[k].*column.value = values[k];
  }
  return samples;
}

// A group of fields on the cells.
class FieldGroup {
 public:
  FieldGroup(ResultGroup& group, const Field& any) : group_(group) {
    group_.index("x", static_cast<std::size_t>(any.rows()), "cell along x");
    group_.index("y", static_cast<std::size_t>(any.cols()), "cell along y");
  }
  void write(const char* name, const Field& values, const char* units, const char* text) {
    group_.dataset(name, values, "x", "y", units, text);
  }
  void write(const char* name, const ContactSet& set, const char* text) {
    write(name, set.cast<double>(), "1", text);
  }

 private:
  ResultGroup& group_;
};

long whole(const ResultReader& reader, const std::string& group, const char* name) {
  const std::optional<double> value = reader.number_attribute(group, name);
  require(value.has_value(), reader.file().string(), name, "is missing; remove the damaged file");
  return static_cast<long>(*value);
}

ContactSet set_of(const Field& field) { return field > 0.5; }

template <class Options>
CycleSettings settings_of(const Grid2D& grid, const Material& material, const Oscillation& motion,
                          double mean_indentation, const Options& options) {
  CycleSettings settings{{"version", std::string(version())}, {"arithmetic", arithmetic()}};
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
  add("steps", options.steps);
  add("tolerance", options.stick.tolerance);
  add("max_iterations", options.stick.max_iterations);
  settings.emplace_back("boundary", options.stick.boundary == Boundary::free ? "free" : "periodic");
  settings.emplace_back("lateral", options.stick.hold_lateral ? "held" : "free");
  return settings;
}

void write_settings(ResultFile& output, const CycleSettings& settings) {
  ResultGroup agreed = output.group("settings");
  for (const auto& [name, value] : settings) agreed.attribute(name, value);
}

void require_settings(const ResultReader& reader, const CycleSettings& settings) {
  for (const auto& [name, value] : settings) {
    const std::optional<std::string> then = reader.text_attribute("settings", name);
    if (!then || *then != value)
      throw InvalidInput(
          fmt::format("{}: {} was {} in the checkpoint and is {} now; resume with the settings of "
                      "the first run or remove the file",
                      reader.file().string(), name, then ? *then : "not there", value));
  }
}

void write_friction(ResultFile& output, const FrictionalCycleState& state) {
  const SlidingState& contact = state.contact;
  ResultGroup group = output.group("friction");
  group.attribute("period", state.period);
  group.attribute("step", state.step);
  group.attribute("slipping", std::int64_t{contact.slipping});
  group.attribute("iterations", std::int64_t{contact.iterations});
  group.attribute("fft_count", std::int64_t{contact.fft_count});
  group.attribute("converged", contact.converged ? 1 : 0);
  write_numbers(group, state, friction_numbers);
  FieldGroup fields(group, contact.pressure);
  fields.write("smallest", state.smallest, "1 in contact at every step of the period");
  fields.write("largest", state.largest, "1 in contact at any step of the period");
  fields.write("pressure", contact.pressure, "Pa", "pressure");
  fields.write("shift_x", contact.shift.x, "m", "displacement along x by other causes");
  fields.write("shift_y", contact.shift.y, "m", "displacement along y by other causes");
  fields.write("traction_x", contact.traction.x, "Pa", "shear traction along x");
  fields.write("traction_y", contact.traction.y, "Pa", "shear traction along y");
  fields.write("displacement_x", contact.displacement.x, "m",
               "displacement of cells in contact along x");
  fields.write("displacement_y", contact.displacement.y, "m",
               "displacement of cells in contact along y");
  fields.write("loss", contact.loss, "J", "energy dissipated by each cell since the start");
  fields.write("loss_at_period_start", state.loss_at_period_start, "J",
               "energy dissipated by each cell before the period");
  ResultGroup sums = output.group("friction/contact");
  write_numbers(sums, contact, sliding_numbers);
  write_samples(output.group("friction/samples"), state.samples, friction_columns);
}

FrictionalCycleState read_friction(const ResultReader& reader) {
  const auto count = [&](const char* name) { return whole(reader, "friction", name); };
  const auto field = [&](const char* name) {
    return reader.field(std::string("friction/") + name);
  };
  FrictionalCycleState state;
  state.period = static_cast<int>(count("period"));
  state.step = static_cast<int>(count("step"));
  SlidingState& contact = state.contact;
  contact.slipping = count("slipping");
  contact.iterations = count("iterations");
  contact.fft_count = count("fft_count");
  contact.converged = count("converged") != 0;
  read_numbers(reader, "friction", state, friction_numbers);
  read_numbers(reader, "friction/contact", contact, sliding_numbers);
  contact.pressure = field("pressure");
  contact.shift = {field("shift_x"), field("shift_y")};
  contact.traction = {field("traction_x"), field("traction_y")};
  contact.displacement = {field("displacement_x"), field("displacement_y")};
  contact.loss = field("loss");
  state.loss_at_period_start = field("loss_at_period_start");
  state.smallest = set_of(field("smallest"));
  state.largest = set_of(field("largest"));
  state.samples = read_samples(reader, "friction/samples", friction_columns);
  return state;
}

}  // namespace

CycleSettings cycle_settings(const Grid2D& grid, const Material& material,
                             const Oscillation& motion, double mean_indentation,
                             const CycleOptions& options) {
  return settings_of(grid, material, motion, mean_indentation, options);
}

CycleSettings cycle_settings(const Grid2D& grid, const Material& material,
                             const Oscillation& motion, double mean_indentation,
                             const FrictionalCycleOptions& options) {
  CycleSettings settings = settings_of(grid, material, motion, mean_indentation, options);
  settings.emplace_back("friction", fmt::format("{}", options.friction_coefficient));
  settings.emplace_back("max_periods", fmt::format("{}", options.max_periods));
  settings.emplace_back("steady_tolerance", fmt::format("{}", options.steady_tolerance));
  return settings;
}

std::string fingerprint(const Field& values) {
  // FNV-1a over the bits.
  std::uint64_t hash = 14695981039346656037u;
  for (Index k = 0; k < values.size(); ++k) {
    auto bits = std::bit_cast<std::uint64_t>(values.data()[k]);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) hash = (hash ^ (bits & 0xff)) * 1099511628211u;
  }
  return fmt::format("{:016x}", hash);
}

void write_cycle_checkpoint(const std::filesystem::path& file, const CycleState& state,
                            const CycleSettings& settings, const Provenance& provenance,
                            const FrictionalCycleState* friction) {
  ResultFile output(file, provenance, {.overwrite = true});
  write_settings(output, settings);
  ResultGroup group = output.group("state");
  group.attribute("period", state.period);
  group.attribute("step", state.step);
  group.attribute("iterations", std::int64_t{state.iterations});
  group.attribute("fft_count", std::int64_t{state.fft_count});
  group.attribute("converged", state.converged ? 1 : 0);
  write_numbers(group, state, cycle_numbers);
  FieldGroup fields(group, state.traction.x);
  fields.write("contact", state.contact, "1 in contact");
  fields.write("smallest", state.smallest, "1 in contact at every step so far");
  fields.write("largest", state.largest, "1 in contact at any step so far");
  fields.write("displacement_x", state.displacement.x, "m",
               "displacement of cells in contact along x");
  fields.write("displacement_y", state.displacement.y, "m",
               "displacement of cells in contact along y");
  fields.write("traction_x", state.traction.x, "Pa", "shear traction along x");
  fields.write("traction_y", state.traction.y, "Pa", "shear traction along y");
  fields.write("unit_traction_x", state.unit_traction.x, "Pa/m", "traction along x of a unit move");
  fields.write("unit_traction_y", state.unit_traction.y, "Pa/m", "traction along y of a unit move");
  write_samples(output.group("samples"), state.samples, cycle_columns);
  if (friction) write_friction(output, *friction);
  output.commit();
}

CycleState read_cycle_checkpoint(const std::filesystem::path& file, const CycleSettings& settings) {
  const ResultReader reader(file);
  require(reader.has("settings") && reader.has("state") && reader.has("samples"), file.string(), "",
          "is no checkpoint of a cycle; name the file that --checkpoint wrote");
  require_settings(reader, settings);
  const auto count = [&](const char* name) { return whole(reader, "state", name); };
  const auto field = [&](const char* name) { return reader.field(std::string("state/") + name); };
  CycleState state;
  state.period = static_cast<int>(count("period"));
  state.step = static_cast<int>(count("step"));
  state.iterations = count("iterations");
  state.fft_count = count("fft_count");
  state.converged = count("converged") != 0;
  read_numbers(reader, "state", state, cycle_numbers);
  state.contact = set_of(field("contact"));
  state.smallest = set_of(field("smallest"));
  state.largest = set_of(field("largest"));
  state.displacement = {field("displacement_x"), field("displacement_y")};
  state.traction = {field("traction_x"), field("traction_y")};
  state.unit_traction = {field("unit_traction_x"), field("unit_traction_y")};
  state.samples = read_samples(reader, "samples", cycle_columns);
  return state;
}

std::optional<FrictionalCycleState> read_friction_checkpoint(const std::filesystem::path& file) {
  const ResultReader reader(file);
  if (!reader.has("friction")) return {};
  return read_friction(reader);
}

void write_friction_checkpoint(const std::filesystem::path& file, const FrictionalCycleState& state,
                               const CycleSettings& settings, const Provenance& provenance) {
  ResultFile output(file, provenance, {.overwrite = true});
  write_settings(output, settings);
  write_friction(output, state);
  output.commit();
}

FrictionalCycleState read_friction_checkpoint(const std::filesystem::path& file,
                                              const CycleSettings& settings) {
  const ResultReader reader(file);
  require(reader.has("settings") && reader.has("friction"), file.string(), "",
          "is no checkpoint of a cycle with friction; name one, or remove the file");
  require_settings(reader, settings);
  return read_friction(reader);
}

}  // namespace salebra
