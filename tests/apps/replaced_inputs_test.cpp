// SPDX-License-Identifier: GPL-3.0-or-later
// --overwrite replaces no file that the same command reads, whoever names it.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "run_program.hpp"

namespace {

namespace fs = std::filesystem;

const std::string material = " --contact-modulus 10GPa --poisson 0.3 ";
const std::string recipe =
    "[surface]\npoints = 16\nsize_x = \"1um\"\nhurst = 0.8\nrolloff = \"0.5um\"\n"
    "short_cutoff = \"0.2um\"\nrms_height = \"1nm\"\nseeds = [1]\n";

std::string study_of(const std::string& surface) {
  return "[surface]\npoints = 16\nsize_x = \"4um\"\nseeds = [1]\n" + surface +
         "\n[material]\ncontact_modulus = \"10GPa\"\npoisson = 0.3\n[contact]\n"
         "pressures = \"1MPa:10MPa:4\"\n[damping]\nnormal_amplitude = \"0.1nm\"\n"
         "drag_velocity = \"1mm/s\"\nfrequency = \"20kHz\"\n";
}

}  // namespace

TEST_CASE("No output replaces a file that the command reads", "[hostile]") {
  const ProgramTest test;
  const auto surface = [&](const std::string& name) {
    test.done(
        "generate --points 16 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.6um "
        "--rms-height 1nm -o " +
        name);
  };
  surface("scan.h5");
  surface("scan.npy");
  test.write("table.h5", "1e6 1e-30\n3e6 1e-31\n1e7 1e-33\n");
  test.write("table.toml", study_of("psd_table = \"table.h5\""));
  fs::copy_file(test.folder() / "scan.h5", test.folder() / "twin.h5");
  test.write("twin.toml", study_of("twin = \"twin.h5\""));
  test.write("scans.toml",
             "[[measurement]]\nfile = \"scan.h5\"\ninstrument = \"ideal\"\ndetrend = \"none\"\n");
  test.write("recipe.h5", recipe);
  fs::create_hard_link(test.folder() / "scan.h5", test.folder() / "hard.h5");
  fs::create_symlink("scan.h5", test.folder() / "soft.h5");
  test.done("contact scan.h5 --pressure 1MPa" + material + "-o start.h5 --overwrite");

  const Names before = test.files();
  for (const auto& [command, input] : std::vector<std::pair<std::string, std::string>>{
           {"study table.toml --no-report -o table.h5", "table.h5"},
           {"study twin.toml --no-report -o twin.h5", "twin.h5"},
           {"twin scans.toml --form corner -o scan.h5", "scan.h5"},
           {"twin scans.toml --form corner -o hard.h5", "scan.h5"},
           {"twin scans.toml --form corner -o soft.h5", "scan.h5"},
           {"contact --recipe recipe.h5 --pressure 1MPa" + material + "-o recipe.h5", "recipe.h5"},
           {"convert scan.npy.json scan.npy --size-x 1um --size-y 1um", "scan.npy.json"},
           {"contact scan.h5 --pressure 1MPa" + material +
                "-o result.h5 --initial start.h5 --checkpoint start.h5",
            "start.h5"}}) {
    INFO(command);
    const std::string content = test.read(input);
    const auto result = test.run(command + " --overwrite");
    INFO(result.err);
    check_refused(result, "");
    CHECK(test.read(input) == content);
    CHECK(test.files() == before);
  }
  // What an output replaces of its own kind is no input.
  test.done("contact scan.h5 --pressure 2MPa" + material +
            "-o result.h5 --initial start.h5 --checkpoint going.h5 --overwrite");
}

TEST_CASE("A file that only its owner may read stays so when it is replaced", "[files]") {
  const ProgramTest test;
  const std::string command =
      "generate --points 16 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um "
      "--rms-height 1nm --overwrite -o ";
  for (const std::string name : {"s.h5", "s.npy", "s.txt"}) {
    INFO(name);
    const auto mode = [&] { return fs::status(test.folder() / name).permissions(); };
    test.done(command + name);
    const fs::perms as_made = mode();
    CHECK((as_made & fs::perms::group_read) == fs::perms::group_read);
    for (const auto kept : {fs::perms::owner_read | fs::perms::owner_write, as_made}) {
      fs::permissions(test.folder() / name, kept);
      test.done(command + name);
      CHECK(mode() == kept);
    }
  }
}
