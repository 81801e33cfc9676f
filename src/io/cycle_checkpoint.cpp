// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <salebra/base/error.hpp>
#include <salebra/io/cycle_checkpoint.hpp>
#include <salebra/io/result_file.hpp>

namespace salebra {
namespace {

struct NumberMember {
  const char* name;
  double CycleState::*value;
  const char* units;
  const char* text;
};
constexpr std::array number_members{
    NumberMember{"tangential", &CycleState::tangential, "m", "tangential position"},
    NumberMember{"period_start", &CycleState::period_start, "m",
                 "tangential position at the start of the period"},
    NumberMember{"work", &CycleState::work, "J", "work of the tangential force in the period"},
    NumberMember{"released_energy", &CycleState::released_energy, "J",
                 "energy released in the period"},
    NumberMember{"energy_at_period_start", &CycleState::energy_at_period_start, "J",
                 "stored energy at the start of the period"},
    NumberMember{"last_work", &CycleState::last_work, "J", "loss of the period before"}};

struct SampleMember {
  const char* name;
  double CycleSample::*value;
  const char* units;
};
constexpr std::array sample_members{
    SampleMember{"time", &CycleSample::t, "1"},
    SampleMember{"indentation", &CycleSample::indentation, "m"},
    SampleMember{"tangential", &CycleSample::tangential, "m"},
    SampleMember{"tangential_force", &CycleSample::tangential_force, "N"},
    SampleMember{"normal_force", &CycleSample::normal_force, "N"},
    SampleMember{"work", &CycleSample::work, "J"},
    SampleMember{"released_energy", &CycleSample::released_energy, "J"},
    SampleMember{"contact_area", &CycleSample::contact_area, "m^2"}};

ContactSet set_of(const Field& field) { return field > 0.5; }

}  // namespace

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
                            const CycleSettings& settings, const Provenance& provenance) {
  ResultFile output(file, provenance, {.overwrite = true});
  ResultGroup agreed = output.group("settings");
  for (const auto& [name, value] : settings) agreed.attribute(name, value);

  ResultGroup group = output.group("state");
  group.attribute("period", state.period);
  group.attribute("step", state.step);
  group.attribute("iterations", std::int64_t{state.iterations});
  group.attribute("fft_count", std::int64_t{state.fft_count});
  group.attribute("converged", state.converged ? 1 : 0);
  for (const NumberMember& member : number_members)
    group.scalar(member.name, state.*member.value, member.units, member.text);
  group.index("x", static_cast<std::size_t>(state.contact.rows()), "cell along x");
  group.index("y", static_cast<std::size_t>(state.contact.cols()), "cell along y");
  const auto field = [&](const char* name, const Field& values, const char* units,
                         const char* text) { group.dataset(name, values, "x", "y", units, text); };
  field("contact", state.contact.cast<double>(), "1", "1 in contact");
  field("smallest", state.smallest.cast<double>(), "1", "1 in contact at every step so far");
  field("largest", state.largest.cast<double>(), "1", "1 in contact at any step so far");
  field("displacement_x", state.displacement.x, "m", "displacement of cells in contact along x");
  field("displacement_y", state.displacement.y, "m", "displacement of cells in contact along y");
  field("traction_x", state.traction.x, "Pa", "shear traction along x");
  field("traction_y", state.traction.y, "Pa", "shear traction along y");
  field("unit_traction_x", state.unit_traction.x, "Pa/m", "traction along x of a unit move");
  field("unit_traction_y", state.unit_traction.y, "Pa/m", "traction along y of a unit move");

  ResultGroup samples = output.group("samples");
  samples.index("sample", state.samples.size(), "steps of the period so far");
  for (const SampleMember& member : sample_members) {
    std::vector<double> values;
    for (const CycleSample& sample : state.samples) values.push_back(sample.*member.value);
    samples.dataset(member.name, values, {"sample"}, member.units, member.name);
  }
  output.commit();
}

CycleState read_cycle_checkpoint(const std::filesystem::path& file, const CycleSettings& settings) {
  const ResultReader reader(file);
  require(reader.has("settings") && reader.has("state") && reader.has("samples"), file.string(), "",
          "is no checkpoint of a cycle; name the file that --checkpoint wrote");
  for (const auto& [name, value] : settings) {
    const std::optional<std::string> then = reader.text_attribute("settings", name);
    if (!then || *then != value)
      throw InvalidInput(
          fmt::format("{}: {} was {} in the checkpoint and is {} now; resume with the settings of "
                      "the first run "
                      "or remove the file",
                      file.string(), name, then ? *then : "not there", value));
  }
  const auto whole = [&](const char* name) {
    const std::optional<double> value = reader.number_attribute("state", name);
    require(value.has_value(), file.string(), name, "is missing; remove the damaged file");
    return static_cast<long>(*value);
  };
  const auto field = [&](const char* name) { return reader.field(std::string("state/") + name); };
  CycleState state;
  state.period = static_cast<int>(whole("period"));
  state.step = static_cast<int>(whole("step"));
  state.iterations = whole("iterations");
  state.fft_count = whole("fft_count");
  state.converged = whole("converged") != 0;
  for (const NumberMember& member : number_members)
    state.*member.value = reader.number(std::string("state/") + member.name);
  state.contact = set_of(field("contact"));
  state.smallest = set_of(field("smallest"));
  state.largest = set_of(field("largest"));
  state.displacement = {field("displacement_x"), field("displacement_y")};
  state.traction = {field("traction_x"), field("traction_y")};
  state.unit_traction = {field("unit_traction_x"), field("unit_traction_y")};
  for (const SampleMember& member : sample_members) {
    const std::vector<double> values = reader.numbers(std::string("samples/") + member.name);
    state.samples.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) state.samples[k].*member.value = values[k];
  }
  return state;
}

}  // namespace salebra
