// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the data of a report from damaged result files.
#include <catch2/catch.hpp>
#include <filesystem>
#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/study/study_file.hpp>

#include "apps/hostile_files.hpp"
#include "report/payload.hpp"
#include "scratch.hpp"
#include "small_study.hpp"

using namespace salebra;
using Catch::Contains;

// Tests only the data, not the page: every build makes them, also one without plotly.js.
TEST_CASE("Results with parts missing, empty or short are refused, not read beyond their end",
          "[report][hostile]") {
  const Scratch scratch;
  const std::filesystem::path whole = scratch / "whole.h5", file = scratch / "damaged.h5";
  write_study(whole, run_study(small_study()), {});
  CHECK_NOTHROW(detail::report_payload(ResultReader(whole)));
  const auto refused = [&](const std::string& part, const auto& edit) {
    INFO(part);
    std::filesystem::copy_file(whole, file, std::filesystem::copy_options::overwrite_existing);
    edit();
    CHECK_THROWS_WITH(detail::report_payload(ResultReader(file)),
                      Contains(part) && Contains("the file is damaged"));
  };
  for (const std::string name : {"solution/damping_constant_error", "solution/slip_share",
                                 "picture/x", "picture/first_load", "curve/converged"}) {
    refused(name + " is missing", [&] { hostile::remove(file, name); });
    refused(name + " has no values", [&] { hostile::set_numbers(file, name, {}); });
  }
  refused("fit/law_off_at_min_gap has",
          [&] { hostile::set_numbers(file, "fit/law_off_at_min_gap", {}); });
  refused("picture/heights has 1 values",
          [&] { hostile::set_numbers(file, "picture/heights", {1e-9}); });
  refused("assumptions/inertia is missing", [&] { hostile::remove(file, "assumptions/inertia"); });
}
