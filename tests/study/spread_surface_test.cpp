// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/tangential/coupled_contact.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/generators/composite.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/fill.hpp>
#include <salebra/surface/peaks.hpp>

#include "ranks_in_threads.hpp"
#include "results/cycle_fields.hpp"

using namespace salebra;

// The most likely mistake is to take the number of rows of one process for that of the surface.
// Functions that accept surfaces spread over processes are compared with one process elsewhere
// (spread_contact_test.cpp, spread_statistics_test.cpp and spread_study_test.cpp in tests,
// generators/tests); all other functions that take a surface must refuse them.
TEST_CASE("What needs a surface whole refuses one that is spread over processes") {
  salebra::testing::run_ranks(2, [](const Communicator& all) {
    Surface surface{{32, 32, 32, 32}, {}, true, "test", all};
    surface.heights = Field::Random(surface.partition().count(), 32);
    const Material material = Material::of_contact_modulus(1, 0.3);
    const NormalContactState state = press(surface, 1, at_pressure(0.1));
    const std::vector<std::pair<const char*, std::function<void()>>> calls{
        {"require_complete", [&] { surface.require_complete("a test"); }},
        {"boundary_element_contact_sets", [&] { boundary_element_contact_sets(surface, 1, {}); }},
        {"boundary_element_pressures", [&] { boundary_element_pressures(surface, 1, {}); }},
        {"simulate_coupled_cycle", [&] { simulate_coupled_cycle(surface, material, {}, {}, {}); }},
        {"CycleFields", [&] { CycleFields("nowhere/cycle", surface, {}, {}); }},
        {"CoupledContact", [&] { CoupledContact(surface, material); }},
        {"residual_surface", [&] { residual_surface(surface, 1, state, {}); }},
        {"after_first_loading", [&] { after_first_loading(surface, 1, 0.1, {}, 0); }},
        {"detrended", [&] { detrended(surface, Detrend::lines); }},
        {"BearingCurve", [&] { BearingCurve{surface}; }},
        {"correlation_map", [&] { correlation_map(surface); }},
        {"filled", [&] { filled(surface); }},
        {"significant_peaks", [&] { significant_peaks(surface, 0.1); }},
        {"composite_surface", [&] { composite_surface(surface, surface); }},
        {"crop_surface", [&] { crop_surface(surface, 0, 0, 8, 8); }}};
    for (const auto& [name, call] : calls) {
      try {
        call();
        throw Error(std::string(name) + " takes a spread surface");
      } catch (const InvalidInput& error) {
        if (error.statement().find("is spread over 2 processes") == std::string::npos)
          throw Error(std::string(name) + ": " + error.what());
      }
    }
  });
}
