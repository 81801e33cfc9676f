// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/cycle_checkpoint.hpp>
#include <salebra/io/cycle_fields.hpp>
#include <salebra/io/result_file.hpp>
#include <sstream>

#include "damping/islands.hpp"
#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

const Grid2D grid{12, 9, 1.2e-3, 0.7e-3};

std::vector<CycleState> states_of_a_cycle() {
  std::vector<CycleState> states;
  CycleOptions options{.steps = 8, .direction = 0.6};
  options.on_state = [&](const CycleState& state) { states.push_back(state); };
  simulate_cycle(island_levels(grid), grid, Material::of_contact_modulus(1e9, 0.3),
                 trajectory_of(EqualFrequency{0.4, 1e-6, 0.9}, 0.5), options);
  return states;
}

std::vector<FrictionalCycleState> states_with_friction() {
  std::vector<FrictionalCycleState> states;
  FrictionalCycleOptions options{
      .friction_coefficient = 0.3, .steps = 8, .max_periods = 2, .direction = 0.6};
  options.on_state = [&](const FrictionalCycleState& state) { states.push_back(state); };
  simulate_frictional_cycle(island_pressures(grid), grid, Material::of_contact_modulus(1e9, 0.3),
                            trajectory_of(EqualFrequency{0.4, 1e-6, 0.9}, 0.5), options);
  return states;
}

bool same_bits(const TangentialField& a, const TangentialField& b) {
  return (a.x == b.x).all() && (a.y == b.y).all();
}

// Every column of a period's samples.
void check_same(const std::vector<CycleSample>& a, const std::vector<CycleSample>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    for (double CycleSample::*value :
         {&CycleSample::t, &CycleSample::indentation, &CycleSample::tangential,
          &CycleSample::tangential_force, &CycleSample::normal_force, &CycleSample::work,
          &CycleSample::released_energy, &CycleSample::contact_area,
          &CycleSample::tangential_stiffness})
      CHECK(a[k].*value == b[k].*value);
}
void check_same(const std::vector<FrictionalSample>& a, const std::vector<FrictionalSample>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    for (double FrictionalSample::*value :
         {&FrictionalSample::t, &FrictionalSample::indentation, &FrictionalSample::tangential,
          &FrictionalSample::tangential_force, &FrictionalSample::normal_force,
          &FrictionalSample::work, &FrictionalSample::dissipated, &FrictionalSample::contact_area,
          &FrictionalSample::slip_area})
      CHECK(a[k].*value == b[k].*value);
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("A checkpoint gives a cycle's state back to the last bit", "[io]") {
  const Scratch scratch;
  const CycleState state = states_of_a_cycle()[5];
  const CycleSettings settings{{"steps", "8"}, {"surface", fingerprint(state.traction.x)}};
  Field last_changed = state.traction.x;
  last_changed(grid.nx - 1, grid.ny - 1) += 1e-9;
  CHECK(fingerprint(last_changed) != settings.back().second);
  const auto file = scratch / "cycle.h5";
  write_cycle_checkpoint(file, states_of_a_cycle()[2], settings, {});
  write_cycle_checkpoint(file, state, settings, {});  // replaces the last one
  const CycleState read = read_cycle_checkpoint(file, settings);
  CHECK(read.step == 5);
  CHECK(read.period == state.period);
  CHECK(read.iterations == state.iterations);
  CHECK(read.fft_count == state.fft_count);
  CHECK(read.converged == state.converged);
  CHECK(read.tangential == state.tangential);
  CHECK(read.period_start == state.period_start);
  CHECK(read.work == state.work);
  CHECK(read.released_energy == state.released_energy);
  CHECK(read.energy_at_period_start == state.energy_at_period_start);
  CHECK(read.last_work == state.last_work);
  CHECK((read.contact == state.contact).all());
  CHECK((read.smallest == state.smallest).all());
  CHECK((read.largest == state.largest).all());
  CHECK(same_bits(read.displacement, state.displacement));
  CHECK(same_bits(read.traction, state.traction));
  CHECK(same_bits(read.unit_traction, state.unit_traction));
  REQUIRE(read.samples.size() == 6);
  check_same(read.samples, state.samples);
}

TEST_CASE("A cycle with friction has checkpoints of its own, of its own settings", "[io]") {
  const Scratch scratch;
  const auto file = scratch / "friction.h5";
  const FrictionalCycleState state = states_with_friction()[12];
  const Grid2D grid{16, 12, 2, 1.5};
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const Drag drag{1e-6, 1e-3, 1e4};
  FrictionalCycleOptions options{.friction_coefficient = 0.3, .steps = 10};
  const CycleSettings settings = cycle_settings(grid, material, drag, 2e-6, options);
  write_friction_checkpoint(file, state, settings, {});
  const FrictionalCycleState read = read_friction_checkpoint(file, settings);
  CHECK(read.step == state.step);
  CHECK(read.last_work == state.last_work);
  CHECK(same_bits(read.contact.traction, state.contact.traction));
  CHECK((read.contact.loss == state.contact.loss).all());
  CHECK(read.samples.size() == state.samples.size());

  // Everything that decides a bit is a setting.
  const auto differs = [&](const CycleSettings& other, const std::string& name) {
    CHECK_THROWS_WITH(read_friction_checkpoint(file, other), Contains("friction.h5: " + name));
  };
  differs(cycle_settings({16, 12, 2, 1.6}, material, drag, 2e-6, options), "size_y");
  differs(cycle_settings(grid, Material::of_contact_modulus(1e9, 0.2), drag, 2e-6, options),
          "cerruti");
  differs(cycle_settings(grid, material, Drag{1e-6, 2e-3, 1e4}, 2e-6, options), "drag_velocity");
  differs(cycle_settings(grid, material, EqualFrequency{1e-6, 1e-6, 0}, 2e-6, options),
          "tangential_amplitude");
  differs(cycle_settings(grid, material, drag, 3e-6, options), "indentation");
  options.stick.tolerance = 1e-9;
  differs(cycle_settings(grid, material, drag, 2e-6, options), "tolerance");
  options = {.friction_coefficient = 0.4, .steps = 10};
  differs(cycle_settings(grid, material, drag, 2e-6, options), "friction");
  options = {.friction_coefficient = 0.3, .steps = 12};
  differs(cycle_settings(grid, material, drag, 2e-6, options), "steps");
  options = {.friction_coefficient = 0.3, .steps = 10, .max_periods = 7};
  differs(cycle_settings(grid, material, drag, 2e-6, options), "max_periods");
  options = {.friction_coefficient = 0.3, .steps = 10};
  const std::string here = arithmetic();
  setenv("SALEBRA_VECTOR_WIDTH", "baseline", 1);  // as another processor would go on
  if (arithmetic() != here)
    differs(cycle_settings(grid, material, drag, 2e-6, options), "arithmetic");
  unsetenv("SALEBRA_VECTOR_WIDTH");
  write_cycle_checkpoint(scratch / "stuck.h5", states_of_a_cycle()[2], {}, {});
  CHECK_THROWS_WITH(read_friction_checkpoint(scratch / "stuck.h5", {}),
                    Contains("no checkpoint of a cycle with friction"));
}

TEST_CASE("A checkpoint keeps the cycle with friction beside the one without", "[io]") {
  const Scratch scratch;
  const auto file = scratch / "cycle.h5";
  const CycleState stuck = states_of_a_cycle()[8];
  write_cycle_checkpoint(file, stuck, {}, {});
  CHECK_FALSE(read_friction_checkpoint(file).has_value());
  const FrictionalCycleState state = states_with_friction()[12];  // in the second period
  REQUIRE(state.contact.loss.sum() > 0);
  REQUIRE(state.contact.slipping > 0);
  write_cycle_checkpoint(file, stuck, {}, {}, &state);
  CHECK(read_cycle_checkpoint(file, {}).work == stuck.work);
  const std::optional<FrictionalCycleState> read = read_friction_checkpoint(file);
  REQUIRE(read.has_value());
  CHECK(read->step == 3);
  CHECK(read->period == 1);
  CHECK(read->tangential == state.tangential);
  CHECK(read->energy_at_period_start == state.energy_at_period_start);
  CHECK(read->work_at_period_start == state.work_at_period_start);
  CHECK(read->normal_work_at_period_start == state.normal_work_at_period_start);
  CHECK(read->last_work == state.last_work);
  CHECK((read->smallest == state.smallest).all());
  CHECK((read->largest == state.largest).all());
  CHECK((read->loss_at_period_start == state.loss_at_period_start).all());
  const SlidingState &then = state.contact, &now = read->contact;
  CHECK((now.pressure == then.pressure).all());
  CHECK((now.loss == then.loss).all());
  CHECK(same_bits(now.shift, then.shift));
  CHECK(same_bits(now.traction, then.traction));
  CHECK(same_bits(now.displacement, then.displacement));
  CHECK(now.slipping == then.slipping);
  CHECK(now.work == then.work);
  CHECK(now.released == then.released);
  CHECK(now.converged == then.converged);
  CHECK(now.iterations == then.iterations);
  CHECK(now.fft_count == then.fft_count);
  REQUIRE(read->samples.size() == 4);
  check_same(read->samples, state.samples);
}

TEST_CASE("A checkpoint of other settings, or what is none, is refused in one line", "[io]") {
  const Scratch scratch;
  const auto file = scratch / "cycle.h5";
  write_cycle_checkpoint(file, states_of_a_cycle()[2], {{"steps", "64"}, {"nx", "12"}}, {});
  CHECK_THROWS_WITH(read_cycle_checkpoint(file, {{"nx", "12"}, {"steps", "32"}}),
                    Catch::Contains("steps was 64") && Catch::Contains("is 32 now"));
  CHECK_THROWS_WITH(read_cycle_checkpoint(file, {{"phase", "1"}}),
                    Catch::Contains("phase was not there"));
  ResultFile other(scratch / "other.h5", {});
  other.group("curve").index("sample", 3, "samples");
  other.commit();
  CHECK_THROWS_WITH(read_cycle_checkpoint(scratch / "other.h5", {}),
                    Catch::Contains("is no checkpoint"));
  CHECK_THROWS_AS(read_cycle_checkpoint(scratch.file("text.h5", "no HDF5"), {}), InvalidInput);
}

TEST_CASE("The XDMF list names datasets that are there, with their sizes, and every point's place",
          "[io]") {
  const Scratch scratch;
  const std::vector<CycleState> states = states_of_a_cycle();
  Surface surface;
  surface.grid = grid;
  surface.heights = Field::Random(grid.nx, grid.ny);
  CycleFields fields(scratch / "a&b", surface, {});
  for (const std::size_t k : {4u, 0u}) fields.write(states[k], 0.125 * double(k), {});
  NormalContactState normal;
  normal.pressure = Field::Random(grid.nx, grid.ny);
  normal.gap = Field::Random(grid.nx, grid.ny);
  fields.write(states[6], 0.75, normal);

  const std::string list = text_of(scratch / "a&b.xdmf");
  const std::regex item(
      "<DataItem Dimensions=\"([0-9 ]+)\"[^>]*Format=\"HDF\">([^:<]+):([^<]+)</DataItem>");
  int items = 0;
  for (std::sregex_iterator at(list.begin(), list.end(), item), end; at != end; ++at, ++items) {
    const std::string name = std::regex_replace((*at)[2].str(), std::regex("&amp;"), "&");
    const ResultReader reader(scratch / name);
    std::string shape;
    for (const Index extent : reader.shape((*at)[3].str().substr(1)))
      shape += (shape.empty() ? "" : " ") + std::to_string(extent);
    CHECK(shape == (*at)[1].str());
  }
  CHECK(items == 3 * 9);  // points, heights and seven fields of each step
  std::vector<std::string> times;
  const std::regex time("<Time Value=\"([^\"]+)\"/>");
  for (std::sregex_iterator at(list.begin(), list.end(), time), end; at != end; ++at)
    times.push_back((*at)[1]);
  CHECK(times == std::vector<std::string>{"0", "0.5", "0.75"});
  CHECK(list.find("TopologyType=\"2DSMesh\" Dimensions=\"12 9\"") != std::string::npos);
  // An ampersand or a bracket left as it is would end the parsing.
  CHECK_FALSE(std::regex_search(list, std::regex("&(?!amp;|lt;)")));

  // The value of cell (ix, iy) stands beside the point (x, y) of that cell.
  const ResultReader mesh(scratch / "a&b-mesh.h5");
  const std::vector<double> points = mesh.numbers("mesh/points");
  const ResultReader frame(scratch / "a&b-0004.h5");
  const Field traction = frame.field("fields/traction_x");
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const auto at = static_cast<std::size_t>(3 * (ix * grid.ny + iy));
      CHECK(points[at] == static_cast<double>(ix) * grid.dx());
      CHECK(points[at + 1] == static_cast<double>(iy) * grid.dy());
      CHECK(traction(ix, iy) == states[4].traction.x(ix, iy));
    }
  CHECK((frame.field("fields/traction_y") == states[4].traction.y).all());
  CHECK((frame.field("fields/displacement_x") == states[4].displacement.x).all());
  CHECK((frame.field("fields/displacement_y") == states[4].displacement.y).all());
  // Without pressures to tell, the gap is that of undeformed bodies that just touch.
  CHECK(frame.field("fields/gap").minCoeff() == 0);
  const ResultReader last(scratch / "a&b-0006.h5");
  CHECK((last.field("fields/pressure") == normal.pressure).all());
  CHECK((last.field("fields/gap") == normal.gap).all());
  CHECK((last.field("fields/contact") == states[6].contact.cast<double>()).all());
  REQUIRE((states[6].contact != states[6].largest).any());
}

TEST_CASE("Fields of an interrupted cycle stay in the list of the resumed one", "[io]") {
  const Scratch scratch;
  const std::vector<CycleState> states = states_of_a_cycle();
  Surface surface;
  surface.grid = grid;
  surface.heights = Field::Zero(grid.nx, grid.ny);
  CycleFields(scratch / "f", surface, {}).write(states[2], 0.25, {});
  CHECK_THROWS_AS(CycleFields(scratch / "f", surface, {}), InvalidInput);
  CycleFields resumed(scratch / "f", surface, {}, {.overwrite = true});
  resumed.keep(1, 0.125);  // never written
  resumed.keep(2, 0.25);
  resumed.write(states[3], 0.375, {});
  const std::string list = text_of(scratch / "f.xdmf");
  CHECK(list.find("step 2") != std::string::npos);
  CHECK(list.find("step 3") != std::string::npos);
  CHECK(list.find("step 1") == std::string::npos);
  // A later period writes the step again, and it is listed once.
  resumed.write(states[3], 0.375, {});
  const std::string again = text_of(scratch / "f.xdmf");
  CHECK(again.find("step 3") == again.rfind("step 3"));
}

TEST_CASE("Fields of a cycle with friction say where it was lost", "[io]") {
  const Scratch scratch;
  const std::vector<FrictionalCycleState> states = states_with_friction();
  Surface surface;
  surface.grid = grid;
  surface.heights = Field::Random(grid.nx, grid.ny);
  const FrictionalCycleState& state = states[12];
  CycleFields(scratch / "f-friction", surface, {}).write(state, 0.375, {});
  const ResultReader frame(scratch / "f-friction-0003.h5");
  const Field loss = frame.field("fields/loss");
  const Field lost = state.contact.loss - state.loss_at_period_start;
  CHECK(loss.sum() * grid.cell_area() == Approx(lost.sum()));
  CHECK((frame.field("fields/pressure") == state.contact.pressure).all());
  CHECK((frame.field("fields/traction_y") == state.contact.traction.y).all());
  CHECK((frame.field("fields/displacement_x") == state.contact.displacement.x).all());
  CHECK((frame.field("fields/contact") == (state.contact.pressure > 0).cast<double>()).all());
  CHECK(text_of(scratch / "f-friction.xdmf").find("f-friction-0003.h5:/fields/loss") !=
        std::string::npos);
  // A resumed run lists what is there, whatever its fields.
  CycleFields resumed(scratch / "f-friction", surface, {}, {.overwrite = true});
  resumed.keep(3, 0.375);
  CHECK(text_of(scratch / "f-friction.xdmf").find("f-friction-0003.h5:/fields/loss") !=
        std::string::npos);
}
