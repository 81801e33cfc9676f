// SPDX-License-Identifier: GPL-3.0-or-later
#include <hdf5.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/result_file.hpp>
#include <sstream>

#include "damping/islands.hpp"
#include "results/cycle_checkpoint.hpp"
#include "results/cycle_fields.hpp"
#include "results/cycle_recorder.hpp"
#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

const Grid2D grid{12, 9, 1.2e-3, 0.7e-3};

std::vector<CycleState> states_of_a_cycle() {
  std::vector<CycleState> states;
  CycleOptions options{.steps = 8, .direction = 0.6};
  options.on_state = [&](CycleState state) { states.push_back(std::move(state)); };
  simulate_cycle(island_contact_sets(grid), grid, Material::of_contact_modulus(1e9, 0.3),
                 trajectory_of(EqualFrequency{0.4, 1e-6, 0.9}, 0.5), options);
  return states;
}

std::vector<CycleState> states_with_friction() {
  std::vector<CycleState> states;
  CycleOptions options{.friction_coefficient = 0.3, .steps = 8, .max_periods = 2, .direction = 0.6};
  options.on_state = [&](CycleState state) { states.push_back(std::move(state)); };
  simulate_frictional_cycle(island_pressures(grid), grid, Material::of_contact_modulus(1e9, 0.3),
                            trajectory_of(EqualFrequency{0.4, 1e-6, 0.9}, 0.5), options);
  return states;
}

// A state of a coupled cycle with a different value in every member.
CycleState coupled_state() {
  CycleState state = states_with_friction()[12];
  CoupledState body{.sliding = std::get<SlidingState>(state.body),
                    .gap = Field::Random(grid.nx, grid.ny),
                    .indentation = 1.5e-6,
                    .normal_work = 2.5e-9,
                    .gap_work = -3.5e-12,
                    .termination = Termination::stalled};
  state.normal_work_at_period_start = 4.5e-9;
  state.gap_work_at_period_start = 5.5e-12;
  state.body = std::move(body);
  return state;
}

void check_same(const Field& a, const Field& b) { CHECK((a == b).all()); }
void check_same(const ContactSet& a, const ContactSet& b) { CHECK((a == b).all()); }
void check_same(const TangentialField& a, const TangentialField& b) {
  check_same(a.x, b.x);
  check_same(a.y, b.y);
}
void check_same(const StuckState& a, const StuckState& b) {
  check_same(a.contact, b.contact);
  check_same(a.displacement, b.displacement);
  check_same(a.traction, b.traction);
  check_same(a.unit_traction, b.unit_traction);
  CHECK(a.work == b.work);
  CHECK(a.released == b.released);
  CHECK(a.termination == b.termination);
  CHECK(a.iterations == b.iterations);
  CHECK(a.fft_count == b.fft_count);
}
void check_same(const SlidingState& a, const SlidingState& b) {
  check_same(a.contact_pressure, b.contact_pressure);
  check_same(a.shift, b.shift);
  check_same(a.traction, b.traction);
  check_same(a.displacement, b.displacement);
  check_same(a.loss, b.loss);
  check_same(a.prepared, b.prepared);
  CHECK(a.motion_scale == b.motion_scale);
  CHECK(a.slipping == b.slipping);
  CHECK(a.work == b.work);
  CHECK(a.released == b.released);
  CHECK(a.termination == b.termination);
  CHECK(a.iterations == b.iterations);
  CHECK(a.fft_count == b.fft_count);
}
void check_same(const CoupledState& a, const CoupledState& b) {
  check_same(a.sliding, b.sliding);
  check_same(a.gap, b.gap);
  CHECK(a.indentation == b.indentation);
  CHECK(a.normal_work == b.normal_work);
  CHECK(a.gap_work == b.gap_work);
  CHECK(a.termination == b.termination);
}

// Compares every member of two states, and every column of their samples.
template <class Body>
void check_same(const CycleState& a, const CycleState& b) {
  CHECK(a.period == b.period);
  CHECK(a.step == b.step);
  check_same(a.smallest, b.smallest);
  check_same(a.largest, b.largest);
  CHECK(a.tangential == b.tangential);
  CHECK(a.energy_at_period_start == b.energy_at_period_start);
  CHECK(a.work_at_period_start == b.work_at_period_start);
  CHECK(a.normal_work_at_period_start == b.normal_work_at_period_start);
  CHECK(a.gap_work_at_period_start == b.gap_work_at_period_start);
  check_same(a.loss_at_period_start, b.loss_at_period_start);
  CHECK(a.last_work == b.last_work);
  REQUIRE(a.samples.size() == b.samples.size());
  for (std::size_t k = 0; k < a.samples.size(); ++k)
    for (double CycleSample::*value :
         {&CycleSample::t, &CycleSample::indentation, &CycleSample::tangential,
          &CycleSample::tangential_force, &CycleSample::normal_force, &CycleSample::work,
          &CycleSample::dissipated, &CycleSample::contact_area, &CycleSample::slip_area})
      CHECK(a.samples[k].*value == b.samples[k].*value);
  REQUIRE(std::holds_alternative<Body>(a.body));
  REQUIRE(std::holds_alternative<Body>(b.body));
  check_same(std::get<Body>(a.body), std::get<Body>(b.body));
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("A checkpoint gives the states of its cycles back to the last bit", "[io]") {
  const Scratch scratch;
  const auto file = scratch / "cycle.h5";
  const CycleState stuck = states_of_a_cycle()[5];
  const CycleState slipping = states_with_friction()[12];  // in the second period
  const CycleState coupled = coupled_state();
  REQUIRE(std::get<SlidingState>(slipping.body).loss.sum() > 0);
  REQUIRE(std::get<SlidingState>(slipping.body).slipping > 0);
  const Field& traction = std::get<StuckState>(stuck.body).traction.x;
  const CycleSettings settings{{"steps", "8"}, {"surface", fingerprint(traction)}};
  Field last_changed = traction;
  last_changed(grid.nx - 1, grid.ny - 1) += 1e-9;
  CHECK(fingerprint(last_changed) != settings.back().second);

  write_cycle_checkpoint(file, std::vector{states_of_a_cycle()[2]}, settings, {});
  write_cycle_checkpoint(file, std::vector{stuck}, settings, {});  // replaces the previous one
  const std::vector<CycleState> one = read_cycle_checkpoint(file, settings);
  REQUIRE(one.size() == 1);
  check_same<StuckState>(one[0], stuck);
  CHECK(one[0].samples.back().tangential_stiffness == stuck.samples.back().tangential_stiffness);

  write_cycle_checkpoint(file, std::vector{stuck, slipping, coupled}, settings, {});
  const std::vector<CycleState> all = read_cycle_checkpoint(file, settings);
  REQUIRE(all.size() == 3);
  check_same<StuckState>(all[0], stuck);
  CHECK(all[1].step == 3);
  CHECK(all[1].period == 1);
  check_same<SlidingState>(all[1], slipping);
  check_same<CoupledState>(all[2], coupled);
}

TEST_CASE("Everything that decides a bit of a cycle is a setting of its checkpoint", "[io]") {
  const Scratch scratch;
  const auto file = scratch / "friction.h5";
  const Grid2D grid{16, 12, 2, 1.5};
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const Drag drag{1e-6, 1e-3, 1e4};
  CycleOptions options{.friction_coefficient = 0.3, .steps = 10};
  const auto settings_of = [&] { return cycle_settings(grid, material, drag, 2e-6, options); };
  const CycleSettings settings = settings_of();
  write_cycle_checkpoint(file, std::vector{states_with_friction()[12]}, settings, {});
  CHECK(read_cycle_checkpoint(file, settings).size() == 1);

  const auto differs = [&](const CycleSettings& other, const std::string& name) {
    CHECK_THROWS_WITH(read_cycle_checkpoint(file, other), Contains("friction.h5: " + name));
  };
  differs(cycle_settings({16, 12, 2, 1.6}, material, drag, 2e-6, options), "size_y");
  differs(cycle_settings(grid, Material::of_contact_modulus(1e9, 0.2), drag, 2e-6, options),
          "cerruti");
  differs(cycle_settings(grid, material, Drag{1e-6, 2e-3, 1e4}, 2e-6, options), "drag_velocity");
  differs(cycle_settings(grid, material, EqualFrequency{1e-6, 1e-6, 0}, 2e-6, options),
          "tangential_amplitude");
  differs(cycle_settings(grid, material, drag, 3e-6, options), "indentation");
  options.stick.tolerance = 1e-9;
  differs(settings_of(), "tolerance");
  options = {.friction_coefficient = 0.4, .steps = 10};
  differs(settings_of(), "friction_coefficient");
  options = {.friction_coefficient = 0.3, .steps = 12};
  differs(settings_of(), "steps");
  options = {.friction_coefficient = 0.3, .steps = 10, .max_periods = 7};
  differs(settings_of(), "max_periods");
  options = {.friction_coefficient = 0.3, .steps = 10, .steady_tolerance = 1e-4};
  differs(settings_of(), "steady_tolerance");
  options = {.friction_coefficient = 0.3, .steps = 10, .coupling_constant = 1e-10};
  differs(settings_of(), "coupling_constant");
  options = {.friction_coefficient = 0.3, .steps = 10};
  const std::string here = arithmetic();
  setenv("SALEBRA_VECTOR_WIDTH", "baseline", 1);  // acts like another processor
  if (arithmetic() != here) differs(settings_of(), "arithmetic");
  unsetenv("SALEBRA_VECTOR_WIDTH");
}

TEST_CASE("A checkpoint of other settings, or what is none, is refused in one line", "[io]") {
  const Scratch scratch;
  const auto file = scratch / "cycle.h5";
  write_cycle_checkpoint(file, std::vector{states_of_a_cycle()[2]}, {{"steps", "64"}, {"nx", "12"}},
                         {});
  CHECK_THROWS_WITH(read_cycle_checkpoint(file, {{"nx", "12"}, {"steps", "32"}}),
                    Catch::Contains("steps is 64") && Catch::Contains("but 32 now"));
  CHECK_THROWS_WITH(read_cycle_checkpoint(file, {{"phase", "1"}}),
                    Catch::Contains("phase is not there"));
  ResultFile other(scratch / "other.h5", {});
  other.group("curve").index("sample", 3, "samples");
  other.commit();
  CHECK_THROWS_WITH(read_cycle_checkpoint(scratch / "other.h5", {}),
                    Catch::Contains("is not a checkpoint"));
  CHECK_THROWS_AS(read_cycle_checkpoint(scratch.file("text.h5", "not an HDF5"), {}), InvalidInput);
}

TEST_CASE("A checkpoint of another version, or with a field that is not finite, is refused",
          "[io]") {
  const Scratch scratch;
  const auto file = scratch / "cycle.h5";
  CycleState state = states_of_a_cycle()[5];
  write_cycle_checkpoint(file, std::vector{state}, {}, {});
  CHECK(read_cycle_checkpoint(file, {}).size() == 1);
  {
    const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t attribute = H5Aopen(opened, "version", H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    const char* other = "7.0";
    REQUIRE(H5Awrite(attribute, type, &other) >= 0);
    H5Tclose(type);
    H5Aclose(attribute);
    REQUIRE(H5Fclose(opened) >= 0);
  }
  CHECK_THROWS_WITH(
      read_cycle_checkpoint(file, {}),
      Contains("version is 7.0") && Contains("but " + std::string(version()) + " now"));

  std::get<StuckState>(state.body).traction.x(3, 2) = std::nan("");
  write_cycle_checkpoint(file, std::vector{state}, {}, {});
  CHECK_THROWS_WITH(read_cycle_checkpoint(file, {}),
                    Contains("traction_x has values that are not finite"));
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
  normal.contact_pressure = Field::Random(grid.nx, grid.ny);
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
  // A raw ampersand or bracket would be malformed XML.
  CHECK_FALSE(std::regex_search(list, std::regex("&(?!amp;|lt;)")));

  // The value of cell (ix, iy) has the same index as the point (x, y) of that cell.
  const ResultReader mesh(scratch / "a&b-mesh.h5");
  const std::vector<double> points = mesh.numbers("mesh/cells");
  const ResultReader frame(scratch / "a&b-0004.h5");
  const Field traction = frame.field("fields/traction_x");
  const StuckState& fourth = std::get<StuckState>(states[4].body);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const auto at = static_cast<std::size_t>(3 * (ix * grid.ny + iy));
      CHECK(points[at] == static_cast<double>(ix) * grid.dx());
      CHECK(points[at + 1] == static_cast<double>(iy) * grid.dy());
      CHECK(traction(ix, iy) == fourth.traction.x(ix, iy));
    }
  check_same(frame.field("fields/traction_y"), fourth.traction.y);
  check_same(frame.field("fields/displacement_x"), fourth.displacement.x);
  check_same(frame.field("fields/displacement_y"), fourth.displacement.y);
  // Without a normal solution, the gap is that of undeformed bodies that just touch.
  CHECK(frame.field("fields/gap").minCoeff() == 0);
  const ResultReader last(scratch / "a&b-0006.h5");
  CHECK((last.field("fields/contact_pressure") == normal.contact_pressure).all());
  CHECK((last.field("fields/gap") == normal.gap).all());
  const ContactSet& contact = std::get<StuckState>(states[6].body).contact;
  check_same(last.field("fields/contact"), contact.cast<double>());
  REQUIRE((contact != states[6].largest).any());
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
  const std::vector<CycleState> states = states_with_friction();
  Surface surface;
  surface.grid = grid;
  surface.heights = Field::Random(grid.nx, grid.ny);
  const CycleState& state = states[12];
  CycleFields(scratch / "f-friction", surface, {}).write(state, 0.375, {});
  const ResultReader frame(scratch / "f-friction-0003.h5");
  const Field loss = frame.field("fields/loss");
  const SlidingState& body = std::get<SlidingState>(state.body);
  const Field lost = body.loss - state.loss_at_period_start;
  CHECK(loss.sum() * grid.cell_area() == Approx(lost.sum()));
  check_same(frame.field("fields/contact_pressure"), body.contact_pressure);
  check_same(frame.field("fields/traction_y"), body.traction.y);
  check_same(frame.field("fields/displacement_x"), body.displacement.x);
  CHECK((frame.field("fields/contact") == (body.contact_pressure > 0).cast<double>()).all());
  CHECK(text_of(scratch / "f-friction.xdmf").find("f-friction-0003.h5:/fields/loss") !=
        std::string::npos);
  // A coupled contact takes the gap from its state.
  const CycleState coupled = coupled_state();
  CycleFields(scratch / "f-coupled", surface, {}).write(coupled, 0.375, {});
  const ResultReader with_gap(scratch / "f-coupled-0003.h5");
  check_same(with_gap.field("fields/gap"), std::get<CoupledState>(coupled.body).gap);
  check_same(with_gap.field("fields/loss"), loss);
  // A resumed run lists the fields that the existing files contain.
  CycleFields resumed(scratch / "f-friction", surface, {}, {.overwrite = true});
  resumed.keep(3, 0.375);
  CHECK(text_of(scratch / "f-friction.xdmf").find("f-friction-0003.h5:/fields/loss") !=
        std::string::npos);
}

TEST_CASE("A recorded cycle that fails or is stopped resumes from its last step", "[io]") {
  const Scratch scratch;
  const CycleRecordOptions record{
      .checkpoint = scratch / "cycle.h5", .checkpoint_every = 1e9, .resume = true};
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const Trajectory motion = trajectory_of(EqualFrequency{0.4, 1e-6, 0.9}, 0.5);
  // Runs both cycles. The second one is interrupted, fails with an exception, or finishes.
  struct Runs {
    CycleResult stuck, frictional;
    int first_step = 0;  // of the second cycle
  };
  const auto run = [&](int stop_at, bool fail) {
    CycleRecorder recorder(record, {{"steps", "8"}}, {});
    Runs runs;
    runs.stuck = recorder.run({.steps = 8}, [&](const CycleOptions& options) {
      return simulate_cycle(island_contact_sets(grid), grid, material, motion, options);
    });
    runs.first_step = -1;
    CycleOptions options{.friction_coefficient = 0.3, .steps = 8, .max_periods = 2};
    options.on_progress = [&](const ProgressReport& report) {
      if (runs.first_step < 0) runs.first_step = report.step;
      if (fail && report.step == stop_at) throw InvalidInput("step", "is broken");
      return report.step != stop_at;
    };
    runs.frictional = recorder.run(options, [&](const CycleOptions& with_states) {
      return simulate_frictional_cycle(island_pressures(grid), grid, material, motion, with_states);
    });
    if (runs.frictional.termination != Termination::interrupted) recorder.done();
    return runs;
  };
  const Runs whole = run(-1, false);
  CHECK_FALSE(std::filesystem::exists(record.checkpoint));
  CHECK(run(3, false).frictional.termination == Termination::interrupted);
  REQUIRE(std::filesystem::exists(record.checkpoint));
  CHECK_THROWS_WITH(CycleRecorder({.checkpoint = record.checkpoint}, {}, {}),
                    Contains("cycle.h5: exists; resume from it"));
  CHECK_THROWS_WITH(run(5, true), Contains("broken"));
  const Runs resumed = run(-1, false);
  CHECK(resumed.first_step == 5);
  CHECK(resumed.stuck.work_per_cycle == whole.stuck.work_per_cycle);
  CHECK(resumed.stuck.fft_count == whole.stuck.fft_count);
  CHECK(resumed.frictional.work_per_cycle == whole.frictional.work_per_cycle);
  CHECK(resumed.frictional.fft_count == whole.frictional.fft_count);
  check_same(resumed.frictional.loss, whole.frictional.loss);
  CHECK_FALSE(std::filesystem::exists(record.checkpoint));
}
