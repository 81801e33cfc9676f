// SPDX-License-Identifier: GPL-3.0-or-later
// What the program hands to salebra-import, and how it ends it. A script stands for the helper.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <string>

#include "hostile_files.hpp"
#include "run_program.hpp"

namespace {

namespace fs = std::filesystem;

/// A folder with a helper that notes that it was called, and then does what is said.
void lay_helper(const ProgramTest& test, const std::string& folder, const std::string& script) {
  fs::create_directories(test.folder() / folder);
  const fs::path helper = test.folder() / folder / "salebra-import";
  test.write(fs::relative(helper, test.folder()).string(),
             "#!/bin/sh\ntouch '" + (test.folder() / "called").string() + "'\n" + script);
  fs::permissions(helper, fs::perms::owner_all);
}

bool was_called(const ProgramTest& test) { return fs::exists(test.folder() / "called"); }

/// Bytes of no format that salebra knows.
std::string noise() {
  std::string bytes;
  for (int k = 0; k < 256; ++k) bytes += static_cast<char>(k);
  return bytes;
}

const std::string first = "PATH=\"$PWD/bin:$PATH\";";

}  // namespace

TEST_CASE("The helper is told which channel the user wants", "[import]") {
  const ProgramTest test;
  lay_helper(test, "bin", "echo \"salebra-import: error: $1: was asked for $3\" >&2\nexit 2\n");
  test.write("noise.bin", noise());
  check_refused(test.run("statistics noise.bin --channel=-1", first), "was asked for --channel=-1");
}

TEST_CASE("No file with the signature of HDF5 is handed to the helper", "[hostile]") {
  const ProgramTest test;
  lay_helper(test, "bin", "exit 1\n");
  test.write("noise.bin", noise());
  check_refused(test.run("statistics noise.bin", first), "failed with status 1");
  REQUIRE(was_called(test));
  fs::remove(test.folder() / "called");
  test.write("secret.txt", hostile::secret);
  for (const hostile::File& file : hostile::write_hdf5_files(test.folder())) {
    INFO(file.name);
    test.run("statistics " + file.name, first);
    CHECK_FALSE(was_called(test));
  }
  const std::string signature = "\x89HDF\r\n\x1a\n";
  for (const std::size_t place : {0, 512, 1024, 65536}) {
    INFO(place);
    std::string content = noise();
    content.resize(place, 'x');
    test.write("behind.bin", content + signature + noise());
    check_refused(test.run("statistics behind.bin", first), "behind.bin");
    CHECK_FALSE(was_called(test));
  }
}

TEST_CASE("A signal ends a helper that never ends", "[hostile]") {
  const ProgramTest test;
  test.write("noise.bin", noise());
  // It would end by itself long after the test has failed.
  lay_helper(test, "bin", "trap '' TERM INT\nsleep 20\n");
  for (const std::string sign : {"INT", "TERM"}) {
    INFO(sign);
    const auto start = std::chrono::steady_clock::now();
    const auto result =
        test.run("statistics noise.bin", first + " me=$$; (sleep 0.3; kill -" + sign + " $me) &");
    CHECK(result.status == 130);
    CHECK(was_called(test));
    // 0.3 s, the start of two programs, and a look each 20 ms.
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
  }
}

TEST_CASE("A second signal of another kind ends the command at once", "[hostile]") {
  const ProgramTest test;
  test.write("noise.bin", noise());
  lay_helper(test, "bin", "sleep 20\n");
  // The first one ends it in order within some 20 ms: the second may come too late, but not always.
  int status = 0;
  for (int k = 0; k < 20 && status != -15; ++k)
    status =
        test.run(
                "statistics noise.bin",
                first +
                    " me=$$; (sleep 0.2; kill -INT $me; sleep 0.003; kill -TERM $me) 2>/dev/null &")
            .status;
  CHECK(status == -15);
}

TEST_CASE("Only absolute folders of PATH are searched for the helper", "[hostile]") {
  const ProgramTest test;
  test.write("noise.bin", noise());
  lay_helper(test, ".", "exit 1\n");
  lay_helper(test, "bin", "exit 1\n");
  for (const std::string path :
       {":/usr/bin:/bin", "/usr/bin::/bin", "/usr/bin:/bin:", ".:/bin", "bin:/bin", ""}) {
    INFO(path);
    check_refused(test.run("statistics noise.bin", "PATH='" + path + "';"),
                  "pip install 'salebra[formats]'");
    CHECK_FALSE(was_called(test));
  }
}
