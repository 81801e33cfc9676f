// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra verify`: checks the installation against known solutions.
#include <fmt/format.h>

#include <algorithm>
#include <salebra/base/error.hpp>
#include <salebra/study/verification.hpp>

#include "program.hpp"
#include "results/columns.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

void run(Session& session) {
  session.require_no_output("verify");
  const auto checks = verify_installation(session.progress());
  Json list = Json::array();
  std::vector<std::vector<std::string>> rows{{"check", "value", "expected", "tolerance", "result"}};
  for (const Check& check : checks) {
    list.push_back(json_of(check));
    rows.push_back({check.name, fmt::format("{:.12g}", check.value),
                    fmt::format("{:.12g}", check.expected), fmt::format("{:.0e}", check.tolerance),
                    check.passed() ? "passed" : "FAILED"});
  }
  const auto failed =
      std::ranges::count_if(checks, [](const Check& check) { return !check.passed(); });
  session.answer(
      Json{{"checks", std::move(list)}},
      to_table(rows, 0, true) + fmt::format("{} of {} checks passed\n",
                                            checks.size() - std::size_t(failed), checks.size()));
  if (failed > 0)
    throw Error(fmt::format("verify: {} checks failed; do not use this build", failed));
}

}  // namespace

void add_verify_command(Program& program) {
  program.add_command("verify", "compare this installation with analytic solutions",
                      {"salebra verify", "salebra verify --json"},
                      [](Session& session) { run(session); });
}

}  // namespace salebra::cli
