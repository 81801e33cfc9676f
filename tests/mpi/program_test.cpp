// SPDX-License-Identifier: GPL-3.0-or-later
// salebra-mpi as a user runs it: by the launcher, in a folder of its own. SALEBRA_PROGRAM of
// run_program.cpp is the launcher.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <regex>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/result_file.hpp>
#include <sstream>
#include <thread>
#include <tuple>

#include "apps/run_program.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

const std::string surface =
    "--points 96,50 --size-x 1um --hurst 0.8 --short-cutoff 100nm --rms-height 1nm --seed 7 ";
const std::string quiet = "--quiet --threads 1 ";

const std::string environment = "export " SALEBRA_MPI_ENVIRONMENT ";";

// The launcher with these arguments. Of standard error the result has the lines of the program alone:
// those of the launcher are apart from those of the processes, and there the MPI library and hwloc
// begin theirs with who speaks, in brackets.
ProgramTest::Result launched(const ProgramTest& test, const std::string& arguments,
                             const std::string& before = "") {
  const ProgramTest file;
  ProgramTest::Result result = test.run(
      arguments, fmt::format("export SALEBRA_MPI_STDERR='{}/err';", file.folder().string()) +
                     environment + before);
  CHECK_THAT(result.err, Contains("a line of the launcher"));
  std::istringstream lines(file.read("err"));
  result.err.clear();
  bool library = false;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("[")) {
      library = true;
    } else {
      result.err += line + "\n";
    }
  CHECK(library);
  return result;
}

// Runs so many processes of salebra-mpi with these arguments.
ProgramTest::Result run(const ProgramTest& test, int ranks, const std::string& arguments) {
  return launched(
      test, fmt::format(SALEBRA_MPI_QUIET " -n {} {} {}", ranks, SALEBRA_MPI_PROGRAM, arguments));
}

// The same with two processes, in each of which the shell runs this first; $rank says in which.
ProgramTest::Result run_two(const ProgramTest& test, const std::string& each,
                            const std::string& arguments) {
  return launched(test,
                  fmt::format(SALEBRA_MPI_QUIET " -n 2 {} {}", SALEBRA_MPI_PROGRAM, arguments),
                  fmt::format("export SALEBRA_MPI_EACH='{}';", each));
}

// Runs salebra, without the launcher.
ProgramTest::Result run_alone(const ProgramTest& test, const std::string& arguments) {
  return test.run("", fmt::format("exec {} {};", SALEBRA_ALONE_PROGRAM, arguments));
}

bool same_heights(const ProgramTest& test, const std::string& a, const std::string& b) {
  const Surface first = read_surface(test.folder() / a), second = read_surface(test.folder() / b);
  return first.grid == second.grid && first.periodic == second.periodic && first.origin != "" &&
         std::memcmp(first.heights.data(), second.heights.data(),
                     static_cast<std::size_t>(first.heights.size()) * sizeof(double)) == 0;
}

const std::string study =
    "[surface]\npoints = 128\nsize_x = \"10um\"\nhurst = 0.8\nrolloff = \"5um\"\n"
    "short_cutoff = \"0.6um\"\nrms_height = \"50nm\"\nfirst_seed = 1\nseed_count = 1\n"
    "[material]\ncontact_modulus = \"1GPa\"\npoisson = 0.3\n"
    "[contact]\nrelative_pressures = \"1e-3:0.1:4\"\n"
    "[damping]\nnormal_amplitude = \"0.5nm\"\ndrag_velocity = \"1um/s\"\n"
    "frequency = \"20kHz\"\n";

// An answer without what depends on the processes and their speed.
std::string numbers_of(const ProgramTest::Result& result) {
  INFO(result.err);
  REQUIRE(result.status == 0);
  nlohmann::json answer = result.json();
  for (const char* name : {"seconds", "ranks", "threads", "groups", "warnings"}) answer.erase(name);
  return answer.dump();
}

// Bad input as all processes see it: one line of the root.
void check_refused_once(const ProgramTest::Result& result, const std::string& part) {
  CHECK(result.status == 2);
  CHECK(result.out.empty());
  CHECK_THAT(result.err, Catch::StartsWith("salebra-mpi: error: "));
  CHECK_THAT(result.err, Contains(part));
  CHECK(std::ranges::count(result.err, '\n') == 1);
}

}  // namespace

TEST_CASE("A surface that processes generate has the bits of one process", "[mpi]") {
  const ProgramTest test;
  const auto alone = run_alone(test, "generate " + surface + "-o alone.h5 --json --quiet");
  REQUIRE(alone.status == 0);
  CHECK_FALSE(alone.json().contains("ranks"));
  for (const int ranks : {1, 2, 4}) {
    const std::string file = fmt::format("spread{}.h5", ranks);
    const auto spread = run(test, ranks, "generate " + surface + "--json -o " + file + " " + quiet);
    INFO(spread.err);
    REQUIRE(spread.status == 0);
    CHECK(spread.err.empty());
    CHECK(spread.json()["ranks"] == ranks);
    CHECK(spread.json()["threads"] == 1);
    CHECK(spread.json()["lattice"] == alone.json()["lattice"]);
    CHECK(spread.json()["realised"] == alone.json()["realised"]);
    CHECK(same_heights(test, file, "alone.h5"));
  }
}

TEST_CASE("A contact and a force curve over processes have the numbers of one process", "[mpi]") {
  const ProgramTest test;
  test.write("study.toml", study);
  const std::string pressed =
      "contact --recipe study.toml --seed 5 --pressure 1MPa --contact-modulus 1GPa --stiffness "
      "--json ";
  const std::string swept =
      "contact --recipe study.toml --seed 5 --pressure 1MPa,4MPa --contact-modulus 1GPa --poisson "
      "0.3 --stiffness --stick --json ";
  const std::string contact = numbers_of(run_alone(test, pressed + "-o alone.h5 " + quiet));
  const std::string curve = numbers_of(run_alone(test, swept + quiet));
  const ResultReader alone(test.folder() / "alone.h5");
  for (const int ranks : {2, 3}) {
    const std::string file = fmt::format("spread{}.h5", ranks);
    CHECK(numbers_of(run(test, ranks, pressed + "-o " + file + " " + quiet)) == contact);
    CHECK(numbers_of(run(test, ranks, swept + quiet)) == curve);
    const ResultReader spread(test.folder() / file);
    for (const char* field : {"contact/contact_pressure", "contact/gap"})
      CHECK((spread.field(field) == alone.field(field)).all());
  }
  // A start from a file, of which each process reads its rows.
  const std::string started = numbers_of(run_alone(test, pressed + "--initial alone.h5 " + quiet));
  CHECK(numbers_of(run(test, 2, pressed + "--initial alone.h5 " + quiet)) == started);
}

TEST_CASE("Statistics of a surface over processes have the numbers of one process", "[mpi]") {
  const ProgramTest test;
  REQUIRE(run_alone(test, "generate " + surface + "-o rough.h5 --quiet").status == 0);
  const auto alone = run_alone(test, "statistics rough.h5 --all --json " + quiet);
  INFO(alone.err);
  REQUIRE(alone.status == 0);
  nlohmann::json expected = alone.json();
  REQUIRE(expected["psd"]["modes"].size() > 8);
  // What needs the surface whole.
  for (const char* table : {"correlation", "correlation_x", "correlation_y", "bearing", "histogram",
                            "profiles_x", "profiles_y"})
    expected.erase(table);
  for (const char* name :
       {"Sal", "Str", "Str_max", "Std", "Sk", "Spk", "Svk", "Smr1", "Smr2", "Spd", "Spc"})
    expected["areal"][name] = nullptr;
  for (const int ranks : {2, 3}) {
    const std::string file = fmt::format("spread{}.json", ranks);
    const auto spread = run(test, ranks, "statistics rough.h5 --all --threads 1 --json -o " + file);
    INFO(spread.err);
    REQUIRE(spread.status == 0);
    CHECK_THAT(spread.err, Contains("with several processes there are no correlation"));
    CHECK(std::ranges::count(spread.err, '\n') <= 2);
    nlohmann::json found = spread.json();
    for (const char* name : {"ranks", "threads", "warnings"}) found.erase(name);
    CHECK(found == expected);
    CHECK(nlohmann::json::parse(test.read(file)) == expected);
  }
  check_refused_once(run(test, 2, "statistics rough.h5 --fill " + quiet), "--fill: is computed by");
  check_refused_once(run(test, 2, "statistics rough.h5 --detrend lines " + quiet),
                     "detrending line by line needs it whole");
  check_refused_once(run(test, 2, "statistics " + quiet), "SURFACE (or --recipe)");
}

TEST_CASE("Groups of processes sweep with the numbers of one process", "[mpi]") {
  const ProgramTest test;
  test.write("study.toml", study);
  const std::string swept =
      "contact --recipe study.toml --seed 5 --pressure 1MPa,2MPa,4MPa --contact-modulus 1GPa "
      "--poisson 0.3 --stiffness --json ";
  const std::string curve = numbers_of(run_alone(test, swept + quiet));
  for (const auto& [ranks, given, groups] : {std::tuple(4, "--groups 2 ", 2), {3, "", 3}}) {
    const auto result = run(test, ranks, swept + given + quiet);
    CHECK(numbers_of(result) == curve);
    CHECK(result.json()["groups"] == groups);
  }
  // A file, which each group reads.
  REQUIRE(run_alone(test, "generate " + surface + "-o a.h5 --quiet").status == 0);
  const std::string read = "contact a.h5 --pressure 1MPa,4MPa --contact-modulus 1GPa --json ";
  CHECK(numbers_of(run(test, 2, read + "--groups 2 " + quiet)) ==
        numbers_of(run_alone(test, read + quiet)));
}

TEST_CASE("A study over processes has the numbers of one process", "[mpi]") {
  const ProgramTest test;
  std::string smaller = std::regex_replace(study, std::regex("points = 128"), "points = 64");
  smaller = std::regex_replace(smaller, std::regex("seed_count = 1"), "seed_count = 2");
  test.write("study.toml", smaller);
  const auto of = [](const ProgramTest::Result& result) {
    nlohmann::json answer = nlohmann::json::parse(numbers_of(result));
    answer.erase("files");
    return answer.dump();
  };
  const std::string job = "study study.toml --json " + quiet;
  const std::string alone = of(run_alone(test, job + "-o alone.h5"));
  // The first surface by two processes, the second by one.
  const auto spread = run(test, 3, job + "-o spread.h5 --groups 2");
  CHECK(of(spread) == alone);
  CHECK(spread.json()["ranks"] == 3);
  CHECK(test.read("spread.html").size() > 1000);
  const ResultReader a(test.folder() / "alone.h5"), b(test.folder() / "spread.h5");
  for (const char* field : {"picture/gap", "picture/contact_pressure"})
    CHECK((a.field(field) == b.field(field)).all());
  CHECK(test.files() ==
        std::set<std::string>{"study.toml", "alone.h5", "alone.html", "spread.h5", "spread.html"});
  check_refused_once(run(test, 2, "study study.toml --hardness 5GPa " + quiet),
                     "--hardness: 5000000000 needs each whole surface in one process");
}

TEST_CASE("A dry run states the memory that processes take", "[mpi]") {
  const ProgramTest test;
  test.write("study.toml", std::regex_replace(study, std::regex("points = 128"), "points = 1536"));
  const std::string pressed =
      "contact --recipe study.toml --pressure 1MPa --contact-modulus 1GPa --tolerance 1e-3 --json ";
  const auto plan = run(test, 2, pressed + "--dry-run " + quiet).json();
  CHECK(plan["ranks"] == 2);
  CHECK(plan["nodes"] == 1);
  REQUIRE(run(test, 2, pressed + quiet).status == 0);
  // The most that any process which ended here had; the launcher is smaller.
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const double peak = 1024.0 * static_cast<double>(usage.ru_maxrss);
  CHECK(plan["memory_bytes_of_node"].get<double>() / 2 == Approx(peak).epsilon(0.15));
}

TEST_CASE("More threads than the machine has cores are warned of once", "[mpi]") {
  const ProgramTest test;
  // Bound to nothing, as Open MPI 4 and 5 each call it: two processes see the same cores.
  const auto result = launched(
      test,
      fmt::format(SALEBRA_MPI_QUIET " -n 2 {} generate {} --threads {} --json", SALEBRA_MPI_PROGRAM,
                  surface, std::max(1U, std::thread::hardware_concurrency())),
      "export OMPI_MCA_hwloc_base_binding_policy=none "
      "PRTE_MCA_hwloc_default_binding_policy=none;");
  INFO(result.err);
  CHECK(result.status == 0);
  CHECK(result.json()["ranks"] == 2);
  CHECK_THAT(result.err, Contains("salebra-mpi: warning: 2 processes with"));
  const std::size_t first = result.err.find("processes with");
  CHECK(result.err.find("processes with", first + 1) == std::string::npos);
}

TEST_CASE("Bad input is said once, with status 2, and leaves no file", "[mpi]") {
  const ProgramTest test;
  check_refused_once(run(test, 2, "fit none.h5"), "is computed by one process only");
  check_refused_once(run(test, 2, "generate " + surface + "-o none/a.h5 " + quiet),
                     "does not exist; create it first");
  check_refused_once(
      run(test, 2, "contact none.h5 --pressure 1MPa --contact-modulus 1GPa " + quiet),
      "none.h5: does not exist");
  CHECK(test.files().empty());
}

TEST_CASE("A failure of one process alone names it and ends the others", "[mpi]") {
  const ProgramTest test;
  test.write("study.toml", study);
  const auto result = run_two(
      test, "if [ $rank = 1 ]; then export SALEBRA_VECTOR_WIDTH=odd; fi",
      "contact --recipe study.toml --pressure 1MPa --contact-modulus 1GPa -o a.h5 " + quiet);
  CHECK(result.status == 2);
  CHECK_THAT(result.err,
             Contains("salebra-mpi: error: process 2 of 2: SALEBRA_VECTOR_WIDTH: odd must be"));
  CHECK(test.files() == std::set<std::string>{"study.toml"});
}

TEST_CASE(
    "SIGUSR1, to one process or all, leaves a checkpoint that any number of processes continues",
    "[mpi]") {
  const ProgramTest test;
  REQUIRE(run_alone(test,
                    "generate --points 512 --size-x 4um --hurst 0.8 --short-cutoff 0.1um "
                    "--rms-height 10nm --seed 3 -o rough.h5 --quiet")
              .status == 0);
  const std::string press =
      "contact rough.h5 --contact-modulus 10GPa --json --pressure 20MPa --precision full " + quiet;
  // The signal goes to the launcher, which hands it on, and to one process alone, not the first. It
  // is sent when the first checkpoint appears; one after each iteration leaves time enough.
  for (const std::string target : {"$launcher", "$(cat pid)"}) {
    const auto stopped = launched(
        test, "",
        fmt::format("rm -f c.h5 pid; export SALEBRA_MPI_EACH='[ $rank != 2 ] || echo $$ > pid';"
                    "{2} " SALEBRA_MPI_QUIET
                    " -n 3 {0} {1} --checkpoint c.h5 --checkpoint-every 0 -o r.h5 & "
                    "launcher=$!; while [ ! -e c.h5 ] && [ -e /proc/$launcher ]; do sleep "
                    "0.05; done; kill -USR1 {3}; wait $launcher; exit $?;",
                    SALEBRA_MPI_PROGRAM, press, SALEBRA_PROGRAM, target));
    INFO(target);
    CHECK(stopped.status == 130);
    CHECK(stopped.err ==
          "salebra-mpi: error: contact: interrupted; continue with --initial c.h5\n");
    REQUIRE(test.files() == std::set<std::string>{"c.h5", "pid", "rough.h5"});
  }
  const auto numbers_of = [](const ProgramTest::Result& result) {
    INFO(result.err);
    REQUIRE(result.status == 0);
    nlohmann::json answer = result.json();
    for (const char* name : {"seconds", "ranks", "threads"}) answer.erase(name);
    return answer.dump();
  };
  const std::string continued = numbers_of(run_alone(test, press + "--initial c.h5"));
  for (const int ranks : {1, 2})
    CHECK(numbers_of(run(test, ranks, press + "--initial c.h5")) == continued);
}

TEST_CASE("Processes with other arguments, or other files of one name, are refused", "[mpi]") {
  const ProgramTest test;
  const std::string make = "generate " + surface;
  for (const std::string second : {make + "-o a.h5 --threads 1", std::string("verify")})
    check_refused_once(
        run_two(test, fmt::format("if [ $rank = 1 ]; then set -- {}; fi", second),
                make + "-o a.h5"),
        "process 2: has different arguments or a different version of the program than process 1");

  // One relative name in two folders, as on machines that do not share a disk.
  for (const char* folder : {"one", "two"})
    std::filesystem::create_directory(test.folder() / folder);
  const auto in_folders = [&](const std::string& arguments) {
    return run_two(test, "if [ $rank = 0 ]; then cd one; else cd two; fi", arguments);
  };
  REQUIRE(run_alone(test, make + quiet + "-o one/s.h5").status == 0);
  const std::string other = std::regex_replace(make, std::regex("--seed 7"), "--seed 8");
  REQUIRE(run_alone(test, other + quiet + "-o two/s.h5").status == 0);
  const std::string contact = "contact s.h5 --pressure 1MPa --contact-modulus 1GPa --json " + quiet;
  check_refused_once(in_folders(contact),
                     "s.h5: is a different file for process 2 than for process 1");
  // A copy is the same file.
  std::filesystem::copy_file(test.folder() / "one/s.h5", test.folder() / "two/s.h5",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK(numbers_of(in_folders(contact)) ==
        numbers_of(run_alone(
            test, "contact one/s.h5 --pressure 1MPa --contact-modulus 1GPa --json " + quiet)));
  std::filesystem::remove(test.folder() / "two/s.h5");
  check_refused_once(in_folders(contact), "s.h5: is a different file for process 2");
  test.write("one/study.toml", study);
  test.write("two/study.toml", study + "# of another seed\n");
  check_refused_once(in_folders("study study.toml --json " + quiet),
                     "study.toml: is a different file");
}
