// SPDX-License-Identifier: GPL-3.0-or-later
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <regex>
#include <thread>

#include "base/random.hpp"
#include "run_program.hpp"
#include "same_results.hpp"
#include "skipped.hpp"
#include "study_parts.hpp"

using namespace salebra;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

pid_t start(const ProgramTest& test, const char* shard) {
  return start_study(test, {"--threads", "1", "--shard", shard});
}

/// Four processes with one --shard each, at once, as shell commands; their answers go to 1.json …
/// 4.json beside the folder.
std::string four_at_once(const ProgramTest& test, const std::array<std::string, 4>& shards) {
  std::string commands;
  for (std::size_t i = 0; i < shards.size(); ++i)
    commands += std::string("'") + SALEBRA_PROGRAM +
                "' study study.toml -o result.h5 --quiet --json --threads 1 --shard " + shards[i] +
                " > '" + test.folder().string() + ".streams/" + std::to_string(i) + ".json' & ";
  return commands + "wait;";
}

std::size_t computed_by(const ProgramTest& test, int worker) {
  std::ifstream stream(test.folder().string() + ".streams/" + std::to_string(worker) + ".json");
  return nlohmann::json::parse(stream)["computed"];
}

void check_same_as_whole(const ProgramTest& test) {
  const auto whole = test.done("study study.toml -o whole.h5 --no-report --quiet");
  CHECK(compare_groups(ResultReader(test.folder() / "result.h5"),
                       ResultReader(test.folder() / "whole.h5"), "/") > 200);
}

constexpr const char* merge = "study study.toml -o result.h5 --no-report --quiet --json --merge";

}  // namespace

TEST_CASE("Shards at once, two of them the same, merge to the result of one run", "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(4));
  const auto merged = test.done(merge, four_at_once(test, {"1/3", "2/3", "3/3", "3/3"}));
  CHECK(merged.json()["points"].size() == 2);
  CHECK(computed_by(test, 0) + computed_by(test, 1) == 6);
  CHECK(computed_by(test, 2) + computed_by(test, 3) >= 2);
  CHECK(test.files() == "study.toml result.h5");
  check_same_as_whole(test);
  // Both the merge and a shard that comes late find the result, and nothing to do.
  test.done(merge);
  CHECK_THAT(test.run("study study.toml -o result.h5 --shard 1/3").out,
             Contains("result.h5 is complete already"));
  CHECK(test.files() == "study.toml result.h5 whole.h5");
}

TEST_CASE("Four processes that take any surface compute each once", "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(12));
  const auto merged = test.done(merge, four_at_once(test, {"any", "any", "any", "any"}));
  std::size_t sum = 0;
  for (int worker = 0; worker < 4; ++worker) sum += computed_by(test, worker);
  CHECK(sum == 24);
}

TEST_CASE("Ten of four concurrent processes are killed: all surfaces are computed, and rightly",
          "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(12));
  std::array<pid_t, 4> workers{};
  for (pid_t& worker : workers) worker = start(test, "any");
  for (int k = 0; k < 10; ++k) {
    const RandomPair chance = uniform_pair(21, k, 0);
    std::this_thread::sleep_for(std::chrono::microseconds(int(70000 * chance.first)));
    pid_t& victim = workers[std::size_t(4 * chance.second)];
    kill(victim, SIGKILL);
    waitpid(victim, nullptr, 0);
    victim = start(test, "any");
  }
  for (const pid_t worker : workers) waitpid(worker, nullptr, 0);
  // The claims of dead processes of this host are void at once, so that the survivors have left
  // none.
  CHECK(parts_in(test.folder() / "result.h5.parts") == 24);
  const auto merged = test.done(merge);
  CHECK(test.files() == "study.toml result.h5");
  check_same_as_whole(test);
}

// Two hosts that share the folder: processes of one cannot be seen from the other. A namespace of
// process numbers and one of host names do that on one machine.
TEST_CASE("Workers of two hosts share a study, and go on where one was killed", "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(12));
  const std::string elsewhere =
      "unshare --user --map-root-user --pid --uts --mount-proc --fork --kill-child sh -c ";
  if (salebra::testing::skipped(
          test.run("--version", elsewhere + "'hostname node2' || exit 77;").status == 77,
          "namespaces of processes and host names cannot be made here"))
    return;
  const std::string any = std::string(SALEBRA_PROGRAM) +
                          " study study.toml -o result.h5 --quiet --threads 1 --shard any";
  // On node2 a worker is killed while it computes its first surfaces; should it have none in hand
  // just then, another is started.
  const std::string claims = "ls result.h5.parts/*.claim";
  const std::string killed =
      elsewhere + "'hostname node2; for attempt in 1 2 3 4 5; do " + claims + " && break; " + any +
      " & until " + claims +
      " || ! kill -0 $!; do sleep 0.01; done; kill -9 $!; wait $!; done' > /dev/null 2>&1;";
  // Two more workers, of two hosts, take what it had claimed and finish the study.
  const auto merged = test.run(merge, killed + elsewhere + "'hostname node3; exec " + any + "' & " +
                                          any + " > /dev/null; wait;");
  INFO(merged.err);
  CHECK(merged.status == 0);
  CHECK(test.files() == "study.toml result.h5");
  check_same_as_whole(test);
  // While one of them runs, elsewhere, a merge is refused.
  test.write("again.toml", study_of(12));
  const auto early =
      test.run("study again.toml -o again.h5 --no-report --quiet --merge",
               elsewhere + "'hostname node4; " + std::string(SALEBRA_PROGRAM) +
                   " study again.toml -o again.h5 --quiet --threads 1 --shard any & until ls "
                   "again.h5.parts/*.claim; do sleep 0.01; done; kill -STOP $!; touch stopped; "
                   "for k in $(seq 3000); do [ -e done ] && break; sleep 0.01; done; kill -9 $!' > "
                   "/dev/null 2>&1 & until [ -e stopped ]; do sleep 0.01; done;");
  test.write("done", "");
  check_refused(early, "in use by shards, the latest of them process");
}

TEST_CASE("A merge of too few surfaces says which shards to run, and exits with 3", "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(4));
  const auto none = test.run(merge);
  CHECK(none.status == 3);
  CHECK(none.out.empty());
  CHECK(none.err ==
        "salebra: error: result.h5.parts: 8 of 8 surfaces are missing; run --shard any, or all "
        "shards, then --merge\n");
  CHECK(test.files() == "study.toml");
  for (const char* k : {"2", "3", "8"})
    test.done(std::string("study study.toml -o result.h5 --quiet --shard ") + k + "/8");
  const auto some = test.run(merge);
  CHECK(some.status == 3);
  CHECK_THAT(some.err, Contains("5 of 8 surfaces are missing; run shards 1,4-7 of 8 again, or "
                                "--shard any, then --merge\n"));
  // Parts of other settings are named, not missed.
  std::string other = study_of(4);
  other.replace(other.find("1e-8"), 4, "1e-9");
  test.write("study.toml", other);
  CHECK_THAT(test.run(merge).err,
             Contains("8 of 8 surfaces are missing; run --shard any, or all shards, then --merge "
                      "(3 surfaces there are of other settings or seeds)\n"));
  check_refused(test.run("study study.toml -o result.h5 --shard 1/8"), "none of its 3 surfaces");
  CHECK(test.files() == "study.toml result.h5.parts");
}

TEST_CASE("SIGTERM and SIGUSR1 stop a shard with status 130, its surfaces kept", "[shard]") {
  for (const int signal : {SIGTERM, SIGUSR1}) {
    const ProgramTest test;
    test.write("study.toml", study_of(500));
    const pid_t child = start(test, "1/1");
    while (parts_in(test.folder() / "result.h5.parts") == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
    CHECK(parts_in(test.folder() / "result.h5.parts") >= 1);
  }
}

TEST_CASE("Shards refuse what they cannot do", "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(2));
  const std::string study = "study study.toml ";
  CHECK(test.files() == "study.toml");
  // A folder that cannot be made, one that cannot be written to, and a disk that is full.
  test.write("result.h5.parts", "in the way");
  const auto blocked = test.run(study + "-o result.h5 --shard 1/2");
  CHECK(blocked.status == 1);
  CHECK_THAT(blocked.err, Contains("result.h5.parts: cannot be created"));
  fs::create_directory(test.folder() / "read.h5.parts");
  fs::permissions(test.folder() / "read.h5.parts", fs::perms::owner_read | fs::perms::owner_exec);
  // Root is asked for permission like everybody once it has given up that capability.
  const std::string plain = geteuid() == 0 ? "setpriv --bounding-set -dac_override " : "";
  const auto read_only = test.run(
      "", "exec " + plain + "'" + SALEBRA_PROGRAM + "' " + study + "-o read.h5 --shard 1/2;");
  CHECK(read_only.status == 1);
  CHECK_THAT(read_only.err,
             Catch::Matches("salebra: error: read.h5.parts/.*: cannot be created \\(Permission "
                            "denied\\); check permissions and space\n"));
  const auto full = test.run(study + "-o full.h5 --shard 1/2", "ulimit -f 8;");
  CHECK(full.status == 1);
  CHECK_THAT(full.err, Contains("run the shard again"));
  CHECK(parts_in(test.folder() / "full.h5.parts") == 0);
}

TEST_CASE("One of several tasks writes nothing but a shard", "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(1));
  for (const std::string several :
       {"OMPI_COMM_WORLD_SIZE=64", "PMI_SIZE=64", "SLURM_STEP_NUM_TASKS=64"})
    for (const std::string command :
         {"study study.toml -o result.h5", "study study.toml -o result.h5 --merge",
          "generate --points 64 --size-x 1um --hurst 0.8 --rms-height 1nm --seed 1 -o a.h5",
          "init b.toml"}) {
      INFO(several << ' ' << command);
      check_refused(
          test.run(command, "export " + several + ";"),
          "would be written by each of several tasks: this process is one of 64 tasks; "
          "start only one, or use salebra-mpi for one surface and study --shard for many");
    }
  check_refused(test.run("init b.toml", "export PMIX_RANK=1;"), "one of several tasks");
  test.done("init b.toml", "export SLURM_STEP_NUM_TASKS=1 PMIX_RANK=0;");
  test.done("study study.toml --dry-run", "export PMI_SIZE=64;");
  CHECK(
      test.run("study study.toml -o result.h5 --quiet --shard 1/2", "export PMI_SIZE=64;").status ==
      0);
  CHECK(test.files() == "study.toml b.toml result.h5.parts");
}

TEST_CASE("A dry run proposes shards for a job script", "[shard]") {
  const ProgramTest test;
  test.write("study.toml", study_of(500));
  const auto one = test.answer("study study.toml --dry-run --threads 1 --shard-seconds 10h");
  CHECK(one["shards"]["count"] == 1);
  CHECK(one["shards"]["surfaces"] == 1000);
  CHECK(one["shards"]["seconds"] == Approx(one["seconds"]));
  const double seconds = one["seconds"];
  const auto several = test.done("study study.toml --dry-run --threads 1 --shard-seconds " +
                                 std::to_string(seconds / 10));
  // As exact as the speed of the machine is the same a second time.
  CHECK(std::regex_search(
      several.out,
      std::regex("shards    [0-9]+ of at most [0-9]+ surfaces, each about .* with 1 threads and "
                 ".*\nSlurm     --array=1-[0-9]+ --cpus-per-task=1 --mem=100M --time=00:05:00\n")));
}

TEST_CASE("The examples for GNU parallel and Snakemake make the result of one run", "[shard]") {
  const std::string cluster = std::string(SALEBRA_EXAMPLES) + "/cluster/";
  const std::string path =
      "export PATH=\"" + fs::path(SALEBRA_PROGRAM).parent_path().string() + ":$PATH\";";
  for (const auto& [program, command] :
       {std::pair<std::string, std::string>{"parallel", "bash " + cluster + "parallel.sh"},
        {"snakemake", "XDG_CACHE_HOME=$PWD snakemake --cores 2 --config shards=4 --snakefile " +
                          cluster + "Snakefile"}}) {
    if (std::system(("command -v " + program + " > /dev/null").c_str()) != 0) {
      WARN(program + " is not installed: its example was not run");
      continue;
    }
    const ProgramTest test;
    test.write("study.toml", study_of(4));
    const auto merged = test.done(std::string("study study.toml -o run.h5 --json --quiet --merge"),
                                  path + command + " > log 2>&1 || { cat log >&2; exit 99; };");
    // The example has merged already.
    CHECK(keys(merged.json()) == "files");
    fs::rename(test.folder() / "run.h5", test.folder() / "result.h5");
    check_same_as_whole(test);
  }
}
